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
        for row in rows:
            writer.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()})


def plot_grid(rows, path):
    """Every run a dot; within one tau the area stiffness rises from left to right."""
    methods = list(dict.fromkeys(row["name"] for row in rows))
    area_stiffnesses = sorted({row["k_a"] for row in rows})
    tolerances = sorted({row["tolerance"] for row in rows}, reverse=True)
    taus = sorted({row["tau"] for row in rows})
    figure, panels = plt.subplots(1, len(methods), figsize=(11, 4.5), sharey=True, squeeze=False)
    for panel, method in zip(panels[0], methods):
        panel.axhspan(0.01, 10, color="0.93", label="asked: 0.01 to 10")
        for k, tolerance in enumerate(tolerances):
            shade = plt.cm.viridis(k / (len(tolerances) - 0.5))
            runs = [row for row in rows if row["name"] == method and row["tolerance"] == tolerance]
            place = [area_stiffnesses.index(row["k_a"]) - (len(area_stiffnesses) - 1) / 2 + 0.25 * (k - 1) for row in runs]
            panel.scatter([row["tau"] * 10 ** (0.1 * at) for row, at in zip(runs, place)], [row["ratio"] for row in runs], s=7, color=shade, alpha=0.7, linewidths=0)
            panel.scatter([], [], color=shade, label=f"tolerance {tolerance:g}")
        panel.set(xscale="log", yscale="log", xlabel=r"$\tau$", title=method)
        panel.set_xticks(taus, [f"{tau:g}" for tau in taus])
        panel.minorticks_off()
    shown = ", ".join(f"{a:g}" for a in area_stiffnesses)
    figure.text(0.5, -0.03, f"at each $\\tau$, from left to right: $k_a$ = {shown}", ha="center")
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
