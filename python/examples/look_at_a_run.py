"""Looks at a run in the manner of a notebook: python3 look_at_a_run.py RUN.h5 [FIGURE.png]

The marks "# %%" make cells of it in Jupyter, VS Code and Spyder."""

# %% Open it
import collections
import sys

import numpy as np

from suture_reader import read_run

run = read_run(sys.argv[1])
print(f"{run.path}: {len(run.frames)} frames of {run.tissue.cell_count} cells, written by suture {run.code_version}")
print("status:", run.summary.get("status"))

# %% The wound closes
area = run.observables["wound_area"]
area_um2 = area.value * run.length_um**2
for fraction in (0.5, 0.25, 0.1):
    below = np.flatnonzero(area_um2 <= fraction * area_um2.max())
    when = f"{run.minutes(area.time[below[0]]):.1f} min" if len(below) else "not reached"
    print(f"first sample below {100 * fraction:.0f} %: {when}")

# %% Cells of the last frame
frame = run.frames[-1]
shapes = frame.shape_parameters()
print(f"shape parameter: mean {shapes.mean():.3f}, largest {shapes.max():.3f} (cell {shapes.argmax()})")
print(f"rest lengths: between {frame.rest_length_strains().min():+.2f} and {frame.rest_length_strains().max():+.2f}")

# %% What happened on the way
print(dict(collections.Counter(event.kind for event in run.events)))

# %% A picture
if len(sys.argv) > 2:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import PolyCollection

    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    outlines = [frame.outline(cell) * run.length_um for cell in range(run.tissue.cell_count)]
    cells = left.add_collection(PolyCollection(outlines, array=shapes, cmap="viridis", edgecolor="black", linewidth=0.6))
    figure.colorbar(cells, ax=left, label="shape parameter")
    if len(frame.purse_string):
        ring = np.vstack([frame.purse_string.position, frame.purse_string.position[:1]]) * run.length_um
        left.plot(*ring.T, color="crimson", linewidth=1.5)
    left.set(aspect="equal", xlabel="µm", ylabel="µm", title=f"{run.minutes(frame.time):.1f} min")
    left.autoscale_view()
    right.plot(run.minutes(area.time), area_um2, color="teal")
    right.set(xlabel="time (min)", ylabel="wound area (µm²)", ylim=(0, None))
    figure.savefig(sys.argv[2], dpi=130)
    print("wrote", sys.argv[2])
