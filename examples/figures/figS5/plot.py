#!/usr/bin/env python3
"""Fig. S5: final shape of a cell pulled by a force dipole against k_a and tau/T."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import arguments, column, plt, read, save

results, _, picture = arguments()
rows = read(results / "dipole.csv")
figure, axes = plt.subplots(1, 3, figsize=(13, 3.8))
ratios = [0.01, 0.02, 0.04, 0.16, 0.64, 2, 2e5]
for k, ratio in enumerate(ratios):
    these = sorted((r for r in rows if r["tau_over_T"] == ratio), key=lambda r: r["k_a"])
    for axis in axes[:2]:
        axis.plot(column(these, "k_a"), column(these, "relative"), "-", color=f"C{k}", label=f"$\\tau/T$ = {ratio:g}")
        axis.plot(column(these, "k_a"), column(these, "published_scheme"), "x", color=f"C{k}", ms=5)
        axis.plot(column(these, "k_a"), column(these, "published"), "o", mfc="none", color=f"C{k}", ms=5)
axes[0].set(xscale="log", xlabel="$k_a$", ylabel="shape parameter at T", ylim=(1.0, 3.4))
axes[1].set(xscale="log", xlabel="$k_a$", ylim=(1.02, 1.36))
axes[0].legend(title="line: overdamped, x: published scheme, o: published", fontsize=7, ncol=4, loc="upper left", bbox_to_anchor=(0.0, 1.35))
VARIANTS = {"relative": ("o", "overdamped"), "inertia": ("x", "inertia of vertices and rest lengths"),
            "published_start": ("+", "the same, published start"), "published_scheme": (".", "the same, step by step")}
for name, (marker, label) in VARIANTS.items():
    axes[2].loglog(column(rows, "tau_over_T"), [abs(r[name] - r["published"]) for r in rows], marker, mfc="none", label=label)
axes[2].axhline(0.02, color="0.6", lw=0.8)
axes[2].set(xlabel="$\\tau/T$", ylabel="|ours - published|", title="difference")
axes[2].legend(fontsize=7)
save(figure, picture)
for name in ["relative", "quadratic", "vertex_inertia", *list(VARIANTS)[1:]]:
    parts = [max(abs(r[name] - r["published"]) for r in rows if low <= r["tau_over_T"] < high) for low, high in [(0.02, 1e9), (0.01, 0.02), (0.0, 0.01)]]
    far = sum(abs(r[name] - r["published"]) > 0.02 for r in rows)
    print(f"{name}: largest difference {parts[0]:.6f} at tau/T >= 0.02, {parts[1]:.6f} at 0.01, {parts[2]:.6f} below; {far} of {len(rows)} beyond 0.02")
for name in ["area", "perimeter"]:
    differences = sorted((abs(r[f"scheme_{name}"] - r[f"published_{name}"]) for r in rows), reverse=True)
    print(f"{name} by the published scheme: largest differences {', '.join(f'{d:.6f}' for d in differences[:5])}")
