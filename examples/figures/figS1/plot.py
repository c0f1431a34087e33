#!/usr/bin/env python3
"""Fig. S1: contact potential and force."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import arguments, column, plt, read, save, select

results, _, picture = arguments()
rows = read(results / "potential.csv")
figure, axes = plt.subplots(1, 2, figsize=(8, 3.4))
for k, depth in enumerate(sorted({row["l1"] for row in rows})):
    these = select(rows, l1=depth)
    for axis, ours, published in zip(axes, "uf", ["published_u", "published_f"]):
        axis.plot(column(these, "d"), column(these, ours), color=f"C{k}", label=f"$l_1$ = {depth:g}")
        axis.plot(column(these, "d")[::12], column(these, published)[::12], "o", ms=3, mfc="none", color=f"C{k}")
axes[0].set(xlabel="distance $d/s$", ylabel="energy $u/\\epsilon$", title="potential")
axes[1].set(xlabel="distance $d/s$", ylabel="force $f s/\\epsilon$", title="force")
for axis in axes:
    axis.axhline(0, color="0.7", lw=0.7)
axes[0].legend(title="lines: ours, circles: published")
save(figure, picture)
for ours, published in [("u", "published_u"), ("f", "published_f")]:
    print(f"largest difference of {ours}: {max(abs(row[ours] - row[published]) for row in rows):.1e}")
