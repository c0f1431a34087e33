#!/usr/bin/env python3
"""Fig. S2: energy and force along paths over corners of a membrane, and what becomes of their steps as the path gets finer."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import arguments, column, plt, read, save, select

SUMS = {"rectangles": ("C1", ":", "rectangles only"), "uncorrected": ("C3", "--", "rectangles and wedges"),
        "corrected": ("C0", "-", "all terms (used)")}
OUTLINE = {"convex": -0.6, "concave": 0.6}

results, _, picture = arguments()
paths, steps = read(results / "paths.csv"), read(results / "refinement.csv")
figure, axes = plt.subplots(2, 4, figsize=(13, 6))
for row, corner in enumerate(["convex", "concave"]):
    draw, energy, force, refinement = axes[row]
    height = OUTLINE[corner]
    draw.fill([-1, -1, 0, 1, 1], [-1.2, height, 0, height, -1.2], color="0.88")
    draw.plot([-1, 0, 1], [height, 0, height], "k.-")
    path = select(paths, corner=corner, sum="corrected")
    draw.plot(column(path, "x"), column(path, "y"), "C2", lw=2, label="path of the vertex")
    draw.set(xlim=(-1.1, 1.1), ylim=(-1.2, 1.3), aspect="equal", title=f"{corner} corner", xlabel="$x/s$", ylabel="$y/s$")
    draw.legend(loc="lower center")
    for name, (colour, style, label) in SUMS.items():
        these = select(paths, corner=corner, sum=name)
        energy.plot(column(these, "x"), column(these, "energy"), style, color=colour, label=label)
        force.plot(column(these, "x"), [(r["fx"] ** 2 + r["fy"] ** 2) ** 0.5 for r in these], style, color=colour, label=label)
        finer = select(steps, corner=corner, sum=name)
        refinement.loglog(column(finer, "spacing"), column(finer, "largest_energy_step"), style, marker="o", ms=3, color=colour,
                          label=f"energy, {label}")
        refinement.loglog(column(finer, "spacing"), column(finer, "largest_force_step"), style, marker="s", ms=3, mfc="none",
                          color=colour, label=f"force, {label}")
    energy.set(xlabel="$x/s$", ylabel="energy / $\\epsilon$", title="energy along the path")
    force.set(xlabel="$x/s$", ylabel="|force| $s/\\epsilon$", title="force along the path")
    refinement.set(xlabel="spacing of the path's points / $s$", ylabel="largest step", title="steps (circles energy, squares force)")
handles, labels = axes[0][1].get_legend_handles_labels()
figure.legend(handles, labels, loc="upper center", ncol=3, bbox_to_anchor=(0.5, 1.04))
save(figure, picture)
