#!/usr/bin/env python3
"""Closure of tissues packed with adhesion on (packing.toml): mean A(t)/A(0) beside the published curves, and a table of closure times.

    packing.py RESULTS PUBLISHED PICTURE.png     RESULTS: folder of `suture sweep packing.toml`

Times are those of the seed-averaged wound area, a closed wound counting as zero; errors are from resampling the wounds. A mean ends where a run
that has not closed ends."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import h5py
import numpy as np
from plotting import arguments, column, plt, read, save

LEVELS = (0.5, 0.25, 0.1, 0.05)
CLOSED = 0.03  # a0: a run that ends below has closed


def wounds(path):
    """{case: (time, one row of wound areas per run)}."""
    found = {}
    with h5py.File(path) as file:
        for name, node in file["nodes"].items():
            runs = [run for run in file["runs"].values() if run.attrs["node"] == int(name) and len(run["wound_area"])]
            if not runs:
                continue
            case = node.attrs["case"]
            series = [run["wound_area"][:] for run in runs]
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
    return result


def main():
    results, published, picture = arguments()
    curves = read(published / "fig4_wound_area.csv")
    figure, axes = plt.subplots(1, 2, figsize=(11, 4))
    random = np.random.default_rng(1)
    for case, (time, areas) in wounds(results / "sweep.h5").items():
        right = int(case.startswith("wing"))
        mean = areas.mean(axis=0) / areas[:, 0].mean()
        error = areas.std(axis=0, ddof=1) / np.sqrt(len(areas)) / areas[:, 0].mean()
        axes[right].plot(time, mean, "--" if "emulation" in case else "-", color="C0" if right else "C3", label=f"{case.replace('_', ' ')}, {len(areas)} seeds")
        axes[right].fill_between(time, mean - error, mean + error, color="C0" if right else "C3", alpha=0.2, lw=0)
        again = [times(time, areas[random.integers(0, len(areas), len(areas))]) for _ in range(400)]
        print(f"| {case} | {len(areas)} | " + " | ".join("not reached" if np.isnan(t) else f"{t:.1f} ± {e:.1f}" for t, e in zip(times(time, areas), np.nanstd(again, axis=0))) + " |")
    for axis, curve in zip(axes, ("embryo", "wing_disc")):
        rows = [r for r in curves if r["curve"] == curve]
        axis.plot(np.array(column(rows, "t_star")) - 10.0, column(rows, "area_norm"), "k:", lw=1.8, label=f"{curve.replace('_', ' ')}, published simulations")
        axis.set(xlabel="time since the string formed", ylabel="A(t)/A(0)", ylim=(0, 1.05), xlim=(0, 200 if curve == "embryo" else 800))
        axis.legend(fontsize=7)
    save(figure, picture)


main()
