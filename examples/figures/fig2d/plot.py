#!/usr/bin/env python3
"""Fig. 2d: the wounded monolayer and its purse string."""
import itertools
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import arguments, column, plt, read, save

results, _, picture = arguments()
cells, string, parameters = read(results / "cells.csv"), read(results / "string.csv"), read(results / "parameters.csv")[0]
figure, axes = plt.subplots(1, 2, figsize=(11, 5.4))
x, y = column(string, "x"), column(string, "y")
near = max(range(len(x)), key=lambda j: y[j])  # the close-up: around the topmost vertex of the string
for axis, membrane in zip(axes, [1.6, 5.0]):
    for _, vertices in itertools.groupby(cells, key=lambda row: row["cell"]):
        vertices = list(vertices)
        axis.fill(column(vertices, "x"), column(vertices, "y"), fc="#f3e3c3", ec="#a07840", lw=membrane, joinstyle="round", alpha=0.9)
    for row in string:
        colour = "C0" if row["mode"] == "attached" else "0.5"
        axis.plot([row["x"], row["tethered_x"]], [row["y"], row["tethered_y"]], color=colour, lw=1.2)
    axis.plot(x + x[:1], y + y[:1], "-", color="C3", lw=1.6)
    axis.set(aspect="equal", xticks=[], yticks=[])
    for spine in axis.spines.values():
        spine.set_visible(axis is axes[1])
axes[1].plot(x, y, "o", color="C3", ms=4)
axes[1].plot(column(cells, "x"), column(cells, "y"), "o", color="#a07840", ms=3)
half = 0.55
axes[1].set(xlim=(x[near] - half, x[near] + half), ylim=(y[near] - 0.65 * half, y[near] + 1.35 * half))
axes[0].add_patch(plt.Rectangle((x[near] - half, y[near] - 0.65 * half), 2 * half, 2 * half, fill=False, ec="k", lw=0.8))
axes[0].set_title(f"{parameters['time']:g} units of time after the string formed")
axes[1].set_title("string (red), tethers (blue: pulling, grey: slipped)")
save(figure, picture)
slipped = sum(row["mode"] == "slipped" for row in string)
print(f"{len(string)} string vertices, {slipped} tethers slipped")
