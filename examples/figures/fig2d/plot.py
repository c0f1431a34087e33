#!/usr/bin/env python3
"""Fig. 2d: the wounded monolayer and its purse string."""
import itertools
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import arguments, column, plt, read, save

results, _, picture = arguments()
cells, string, parameters = read(results / "cells.csv"), read(results / "string.csv"), read(results / "parameters.csv")[0]
figure, axes = plt.subplots(1, 2, figsize=(11, 5.4), gridspec_kw={"left": 0.01, "right": 0.99, "bottom": 0.01, "top": 0.94, "wspace": 0.03})
x, y = column(string, "x"), column(string, "y")
near = max(range(len(x)), key=lambda j: y[j])  # the close-up: around the topmost vertex of the string
half = 0.55
views = [(-4.6, 4.6, -4.6, 4.6), (x[near] - half, x[near] + half, y[near] - 0.65 * half, y[near] + 1.35 * half)]
for axis, (left, right, low, high) in zip(axes, views):
    axis.set(xlim=(left, right), ylim=(low, high), aspect="equal", xticks=[], yticks=[])
    # The membrane is as wide as the contact distance: cells that touch have their centre lines that far apart.
    membrane = parameters["contact_distance"] / (right - left) * axis.get_position().width * figure.get_figwidth() * 72
    for _, vertices in itertools.groupby(cells, key=lambda row: row["cell"]):
        vertices = list(vertices)
        axis.fill(column(vertices, "x"), column(vertices, "y"), fc="#f6ead2", ec="#dcb988", lw=membrane, joinstyle="round")
    for row in string:
        colour = "C0" if row["mode"] == "attached" else "0.5"
        axis.plot([row["x"], row["tethered_x"]], [row["y"], row["tethered_y"]], color=colour, lw=1.2)
    axis.plot(x + x[:1], y + y[:1], "-", color="C3", lw=1.6)
    for spine in axis.spines.values():
        spine.set_visible(axis is axes[1])
axes[1].plot(x, y, "o", color="C3", ms=4)
axes[1].plot(column(cells, "x"), column(cells, "y"), "o", color="#80602c", ms=3)
axes[0].add_patch(plt.Rectangle((x[near] - half, y[near] - 0.65 * half), 2 * half, 2 * half, fill=False, ec="k", lw=0.8))
axes[0].set_title(f"{parameters['time']:g} units of time after the string formed")
axes[1].set_title("string (red), tethers (blue: pulling, grey: slipped)")
save(figure, picture, tight=False)
slipped = sum(row["mode"] == "slipped" for row in string)
print(f"{len(string)} string vertices, {slipped} tethers slipped")
