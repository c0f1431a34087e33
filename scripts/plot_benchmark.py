#!/usr/bin/env python3
"""Tables and pictures of benchmark.json: scripts/plot_benchmark.py BENCHMARK.json OUT_DIR

grid    -> tolerance_grid.csv, tolerance_grid.png   (error over tolerance)
rivals  -> rivals.csv                               (what 1e-3 l0 costs by each method, without events)
events  -> events.csv, events.png                   (the same in closures)
"""
import csv
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def rows_of(measurements, group):
    return [{"name": m["name"], **m["parameters"], **m["values"]} for m in measurements if m["group"] == group]


def write_csv(rows, path):
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with open(path, "w", newline="") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def plot_grid(rows, path):
    methods = list(dict.fromkeys(row["name"] for row in rows))
    area_stiffnesses = sorted({row["k_a"] for row in rows})
    figure, panels = plt.subplots(1, len(methods), figsize=(9, 4), sharey=True, squeeze=False)
    for panel, method in zip(panels[0], methods):
        panel.axhspan(0.01, 10, color="0.93", label="asked: 0.01 to 10")
        for row in rows:
            if row["name"] != method:
                continue
            shade = plt.cm.viridis(area_stiffnesses.index(row["k_a"]) / (len(area_stiffnesses) - 0.5))
            size = {1e-2: 60, 1e-3: 30, 1e-4: 10}.get(row["tolerance"], 20)
            panel.scatter(row["tau"], row["ratio"], s=size, color=shade, alpha=0.8, linewidths=0)
        for area_stiffness in area_stiffnesses:
            shade = plt.cm.viridis(area_stiffnesses.index(area_stiffness) / (len(area_stiffnesses) - 0.5))
            panel.scatter([], [], color=shade, label=f"$k_a$ = {area_stiffness:g}")
        for tolerance, size in ((1e-2, 60), (1e-3, 30), (1e-4, 10)):
            panel.scatter([], [], s=size, color="0.5", label=f"tolerance {tolerance:g}")
        panel.set(xscale="log", yscale="log", xlabel=r"$\tau$", title=method)
    panels[0][0].set_ylabel("error / tolerance")
    panels[0][-1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False)
    figure.savefig(path, dpi=150, bbox_inches="tight")


def plot_events(rows, path):
    """How many times as long Euler takes, by node of Fig. 3."""
    nodes = [row for row in rows if row["name"].startswith("node") and "euler_over_this" in row]
    methods = [m for m in ("rkc2", "cvode", "auto") if any(row["name"].endswith(": " + m) for row in nodes)]
    finest = {(r["k_a"], r["tau"]) for r in rows if r["name"] == "node: euler" and not r.get("accurate")}  # a bound only
    area_stiffnesses = sorted({row["k_a"] for row in nodes})
    figure, panels = plt.subplots(1, len(methods), figsize=(11, 4), sharey=True, squeeze=False)
    for panel, method in zip(panels[0], methods):
        panel.axhline(3, color="0.6", linewidth=0.8)
        for k, area_stiffness in enumerate(area_stiffnesses):
            shade = plt.cm.viridis(k / (len(area_stiffnesses) - 0.5))
            for row in nodes:
                if row["k_a"] == area_stiffness and row["name"].endswith(": " + method):
                    bound = (row["k_a"], row["tau"]) in finest
                    panel.scatter(row["tau"], row["euler_over_this"], s=30, color=shade, marker="^" if bound else "o")
            panel.scatter([], [], color=shade, label=f"$k_a$ = {area_stiffness:g}")
        panel.scatter([], [], color="0.5", marker="^", label="at least")
        panel.set(xscale="log", yscale="log", xlabel=r"$\tau$", title=method)
    panels[0][0].set_ylabel("Euler's seconds over this method's,\nerror at most 0.001 $l_0$")
    panels[0][-1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False)
    figure.savefig(path, dpi=150, bbox_inches="tight")


def main(source, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    measurements = json.loads(pathlib.Path(source).read_text())["measurements"]
    grid, rivals = rows_of(measurements, "grid"), rows_of(measurements, "rivals")
    if grid:
        write_csv(grid, folder / "tolerance_grid.csv")
        plot_grid(grid, folder / "tolerance_grid.png")
    if rivals:
        write_csv(rivals, folder / "rivals.csv")
    events = rows_of(measurements, "events")
    if events:
        write_csv(events, folder / "events.csv")
    if any(row["name"].startswith("node") and "euler_over_this" in row for row in events):
        plot_events(events, folder / "events.png")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
