#!/usr/bin/env python3
"""Fig. 2c: compression of an elastic and a plastic cell."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import arguments, column, plt, read, save, select

results, _, picture = arguments()
outlines, course = read(results / "outlines.csv"), read(results / "course.csv")
figure, axes = plt.subplots(1, 4, figsize=(12, 3.2), gridspec_kw={"width_ratios": [1, 1, 1, 1.5]})
for axis, stage in zip(axes, ["before", "compressed", "released"]):
    for cell, colour in [("elastic", "C0"), ("plastic", "C3")]:
        these = select(outlines, cell=cell, stage=stage)
        x, y = column(these, "x"), column(these, "y")
        axis.plot(x + x[:1], y + y[:1], color=colour, label=cell, lw=2)
    axis.set(xlim=(-0.85, 0.85), ylim=(-0.85, 0.85), aspect="equal", title=stage)
    axis.axis("off")
axes[0].legend(loc="lower center", ncol=2)
for cell, colour in [("elastic", "C0"), ("plastic", "C3")]:
    these = select(course, cell=cell)
    axes[3].plot(column(these, "time"), column(these, "shape_parameter"), color=colour,
                 label=f"{cell}, $\\tau/T$ = {these[0]['tau_over_T']:g}")
    print(f"{cell}: shape {these[0]['shape_parameter']:.3f} before, largest {max(column(these, 'shape_parameter')):.3f}, "
          f"{these[-1]['shape_parameter']:.3f} at the end")
axes[3].axvline(100, color="0.7", lw=0.8)
axes[3].set(xlabel="time", ylabel="shape parameter", title="released at t = T = 100")
axes[3].legend(loc="center", bbox_to_anchor=(0.32, 0.45))
save(figure, picture)
