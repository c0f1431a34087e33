#!/usr/bin/env python3
"""Wound area against time of the rows of examples/closure_table/sweep.toml, beside the published simulations.

    plot.py FOLDER data/published/fig4_wound_area.csv PICTURE.png
The published table has the columns curve,t_min,t_star,area_norm (Ton et al. 2023, Fig. 4a, digitised; its first sample is the
creation of the purse string). Needs python3-matplotlib.
"""
import csv
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROWS = [("printed", "printed equations", "C0"), ("relative_membrane", "relative membrane", "C2"),
        ("saturating_force", "saturating force", "C1"), ("published_equations", "published equations, accurate", "C4"),
        ("published_code", "published code, emulated", "C3")]


def read(path, *names):
    with open(path, newline="") as stream:
        table = list(csv.DictReader(stream))
    return [[float(row[name] or 0.0) for row in table] for name in names]


def published(path, curve):
    with open(path, newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["curve"] == curve]
    start = float(rows[0]["t_star"])
    return [float(r["t_star"]) - start for r in rows], [float(r["area_norm"]) for r in rows]


def finished_runs(folder, case):
    with open(folder / "sweep.csv", newline="") as stream:
        return [folder / "runs" / row["run"] for row in csv.DictReader(stream)
                if row["case"] == case and row["status"] in ("closed", "reached_t_end")]


def draw(axis, folder, tissue, curve, published_file, end):
    for name, label, colour in ROWS:
        for k, run in enumerate(finished_runs(pathlib.Path(folder), f"{tissue}_{name}")):
            time, area = read(run / "wound.csv", "time", "wound_area")
            axis.plot(time, [a / area[0] for a in area], color=colour, lw=0.9, alpha=0.75, label=label if k == 0 else None)
    time, area = published(published_file, curve)
    axis.plot(time, area, "k--", lw=1.8, label="published, mean of 25 seeds")
    axis.set(xlim=(0, end), ylim=(0, 1.05), xlabel="time since the purse string started (model units)", title=curve.replace("_", " "))


def main():
    folder, published_file, picture = sys.argv[1:4]
    with open(published_file, newline="") as stream:
        curves = sorted({row["curve"] for row in csv.DictReader(stream)})
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2), sharey=True)
    draw(axes[0], folder, "embryo", next(c for c in curves if "embryo" in c), published_file, 200)
    draw(axes[1], folder, "wing", next(c for c in curves if "wing" in c), published_file, 2000)
    axes[0].set_ylabel("wound area / initial area")
    axes[0].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=130)


main()
