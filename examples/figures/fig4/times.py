#!/usr/bin/env python3
"""When the seed-averaged wounds of a sweep fall to 50, 25, 10 and 5 % of their maximum, in model units: a table with errors from resampling the wounds.

    times.py FOLDER      a folder of `suture sweep`

A closed wound counts as zero; a mean ends where a run that has not closed ends."""
import pathlib
import sys

import h5py
import numpy as np

LEVELS = (0.5, 0.25, 0.1, 0.05)
CLOSED = 0.03  # a0: a run that ends below has closed


def wounds(path):
    """{case: (time, one row of wound areas per run)}."""
    found = {}
    with h5py.File(path) as file:
        for name, node in file["nodes"].items():
            series = [run["wound_area"][:] for run in file["runs"].values() if run.attrs["node"] == int(name) and len(run["wound_area"])]
            if not series:
                continue
            case = node.attrs["case"]
            shortest = min((len(s) for s in series if s[-1] > CLOSED), default=max(map(len, series)))
            rows = [np.pad(s, (0, max(0, shortest - len(s))))[:shortest] for s in series]
            found[case.decode() if isinstance(case, bytes) else case] = node["time"][:shortest], np.array(rows)
    return found


def times(time, areas):
    mean = areas.mean(axis=0)
    after = np.arange(len(mean)) > mean.argmax()
    result = []
    for level in LEVELS:
        below = np.nonzero(after & (mean <= level * mean.max()))[0]
        k = below[0] if len(below) else 0
        result.append(np.interp(level * mean.max(), [mean[k], mean[k - 1]], [time[k], time[k - 1]]) if k else np.nan)
    return np.array(result)


def shown(value, resampled):
    """Resamplings that never get there are left out of the error, which is then too small."""
    known = resampled[~np.isnan(resampled)]
    if np.isnan(value):
        return "never"
    return f"{value:.1f} ± {known.std(ddof=1):.1f}" + ("" if len(known) == len(resampled) else f" (of {100 * len(known) // len(resampled)} %)")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    random = np.random.default_rng(1)
    print("| case | seeds | t_50 | t_25 | t_10 | t_05 | left at the end |\n|---|---|---|---|---|---|---|")
    for case, (time, areas) in wounds(pathlib.Path(sys.argv[1]) / "sweep.h5").items():
        again = np.array([times(time, areas[random.integers(0, len(areas), len(areas))]) for _ in range(400)])
        row = [shown(value, again[:, k]) for k, value in enumerate(times(time, areas))] if len(areas) > 1 else [f"{t:.1f}" for t in times(time, areas)]
        print(f"| {case} | {len(areas)} | " + " | ".join(row) + f" | {areas[:, -1].mean() / areas[:, 0].mean():.3f} |")


main()
