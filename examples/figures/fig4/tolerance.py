#!/usr/bin/env python3
"""Error bars of Fig. 4: what tolerance and event interval do to the seed-averaged wound area and shape.

    tolerance.py FOLDER PICTURE.png      a folder of `suture sweep tolerance.toml`

Upper row: means over the seeds with their standard error at the finest settings; lower row: mean over the seeds of the difference
from the first setting, seed by seed, with its standard error."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import h5py
import numpy as np
from plotting import plt, save

UNIT_MIN = {"embryo": 16.6667 / 60, "wing_disc": 13.3333 / 60}


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def curves(file):
    """{(tissue, setting): {seed: (wound area over its first value, 0 once closed)}} and the times."""
    found, time = {}, {}
    for name, node in file["nodes"].items():
        tissue = text(node.attrs["case"])
        setting = (float(text(node.attrs["integrator.tolerance"])), float(text(node.attrs["purse_string.event_interval"])))
        runs = {int(run.attrs["seed"]): run["wound_area"][:] for run in file["runs"].values()
                if run.attrs["node"] == int(name) and len(run["wound_area"])}
        if not runs:
            continue
        length = max(map(len, runs.values()))
        found[tissue, setting] = {seed: np.pad(a / a[0], (0, length - len(a))) for seed, a in runs.items()}
        if length > len(time.get(tissue, [])):
            time[tissue] = node["time"][:length] * UNIT_MIN[tissue]
    return found, time


def standard_error(values):
    return values.std(axis=0, ddof=1) / np.sqrt(len(values))


folder, picture = map(pathlib.Path, sys.argv[1:3])
figure, axes = plt.subplots(2, 2, figsize=(11, 6.5), sharex="col")
with h5py.File(folder / "sweep.h5") as file:
    found, time = curves(file)
for column, tissue in enumerate(["embryo", "wing_disc"]):
    settings = [setting for name, setting in found if name == tissue]
    if not settings:
        continue
    first, length = found[tissue, settings[0]], len(time[tissue])
    padded = lambda runs, seeds: np.array([np.pad(runs[s], (0, length - len(runs[s]))) for s in seeds])
    for k, setting in enumerate(settings):
        runs, label = found[tissue, setting], f"tolerance {setting[0]:g}, event interval {setting[1]:g}"
        values = padded(runs, sorted(runs))
        upper, lower = axes[0][column], axes[1][column]
        mean, error = values.mean(axis=0), standard_error(values)
        upper.plot(time[tissue], mean, color=f"C{k}", lw=1, label=f"{label} ({len(runs)} seeds)")
        if k == 0:
            upper.fill_between(time[tissue], mean - error, mean + error, color="0.8", lw=0)
            continue
        both = sorted(set(runs) & set(first))
        difference = padded(runs, both) - padded(first, both)
        mean, error = difference.mean(axis=0), standard_error(difference)
        lower.plot(time[tissue], mean, color=f"C{k}", lw=1)
        lower.fill_between(time[tissue], mean - error, mean + error, color=f"C{k}", alpha=0.15, lw=0)
        print(f"{tissue}, {label}: largest mean difference {np.abs(mean).max():.4f} (there +- {error[np.abs(mean).argmax()]:.4f}), "
              f"rms over time {np.sqrt((mean**2).mean()):.4f}, rms standard error {np.sqrt((error**2).mean()):.4f}, {len(both)} seeds")
    axes[0][column].set(title=tissue.replace("_", " "), ylabel="A(t)/A(0)")
    axes[0][column].legend(fontsize=7)
    axes[1][column].axhline(0.0, color="0.5", lw=0.8)
    axes[1][column].set(xlabel="time (min)", ylabel="difference from the first, mean of the seeds")
save(figure, picture)
