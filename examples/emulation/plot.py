#!/usr/bin/env python3
"""Seed-averaged wound area of the rows of examples/emulation/sweep.toml beside the published simulations, and the table.

    plot.py FOLDER data/published/fig4_wound_area.csv PICTURE.png
Times are those of the seed-averaged A(t), as published: a closed wound counts with area 0. Needs python3-matplotlib, numpy.
"""
import csv
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

STEP = 0.5
LEVELS = [0.5, 0.25, 0.1, 0.05]


def published(path, tissue):
    with open(path, newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["curve"].startswith(tissue)]
    start = float(rows[0]["t_star"])
    return np.array([float(r["t_star"]) - start for r in rows]), np.array([float(r["area_norm"]) for r in rows])


def mean_curve(folder, case):
    """Times, mean area over its first value, number of runs, mean and deviation of the healed shape; None without runs."""
    with open(folder / "sweep.csv", newline="") as stream:
        rows = [r for r in csv.DictReader(stream) if r["case"] == case and r["status"] in ("closed", "reached_t_end")]
    if not rows:
        return None
    curves = [np.genfromtxt(folder / "runs" / r["run"] / "wound.csv", delimiter=",", names=True) for r in rows]
    time = np.arange(0.0, max(c["time"][-1] for c in curves) + STEP, STEP)
    area = np.mean([np.interp(time, c["time"], c["wound_area"], right=0.0 if r["status"] == "closed" else c["wound_area"][-1])
                    for c, r in zip(curves, rows)], axis=0)
    shapes = [float(r["healed_shape"]) for r in rows if r["healed_shape"]]
    return time, area / area[0], len(rows), np.mean(shapes), np.std(shapes, ddof=1) if len(shapes) > 1 else float("nan")


def reached(time, area, level):
    below = np.flatnonzero(area < level * area.max())
    if not below.size:
        return None
    k = below[0]
    return float(np.interp(-level * area.max(), [-area[k - 1], -area[k]], [time[k - 1], time[k]]))


def line(name, count, time, area, shape):
    times = " | ".join("never" if t is None else f"{t:.0f}" for t in (reached(time, area, q) for q in LEVELS))
    early = " | ".join(f"{np.interp(t, time, area):.2f}" for t in (4.7, 9.4, 18.7))
    print(f"| {name} | {count} | {early} | {times} | {shape} |")


def cases(folder):
    with open(folder / "sweep.csv", newline="") as stream:
        return list(dict.fromkeys(row["case"] for row in csv.DictReader(stream)))


def main():
    folder, table, picture = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    figure, axes = plt.subplots(1, 3, figsize=(14, 4.3), sharey=True)
    print("| row | seeds | A(4.7) | A(9.4) | A(18.7) | t_50 | t_25 | t_10 | t_05 | healed shape |\n|---|---|---|---|---|---|---|---|---|---|")
    for tissue, shape in (("embryo", "1.72"), ("wing", "1.44")):
        time, area = published(table, tissue)
        line(f"{tissue}, published", 25, time, area, shape)
        for axis in axes[:2] if tissue == "embryo" else axes[2:]:
            axis.plot(time, area, "k--", lw=2, label="published, 25 seeds", zorder=5)
        for k, case in enumerate(c for c in cases(folder) if c.startswith(tissue)):
            curve = mean_curve(folder, case)
            if curve is None:
                continue
            time, area, count, mean, deviation = curve
            line(case, count, time, area, f"{mean:.2f} ± {deviation:.2f}")
            for axis in axes[:2] if tissue == "embryo" else axes[2:]:
                axis.plot(time, area, color=f"C{k}", lw=2.2 if case == tissue else 1.0, label=f"{case}, {count} seeds")
    for axis, end, title in zip(axes, (30, 200, 1000), ("embryo, beginning", "embryo", "wing disc")):
        axis.set(xlim=(0, end), ylim=(0, 1.05), xlabel="time since the purse string started", title=title)
    axes[0].set_ylabel("seed-averaged wound area / first value")
    axes[1].legend(frameon=False, fontsize=7)
    axes[2].legend(frameon=False, fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=130)


if __name__ == "__main__":
    main()
