#!/usr/bin/env python3
"""Fig. 3: healed shape and closure rate over B and tau: printed equations, emulation, published."""
import math
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import numpy as np
from plotting import arguments, plt, read, save

KPA, MIN = 0.04, 16.6667 / 60  # B per k_a and time per unit at a0 = 25 um^2, which the published axes have everywhere
TISSUES = {"embryo": (16 * KPA, 9.6 * MIN, "red"), "wing disc": (32 * KPA, 1228.8 * MIN, "magenta")}
SWEEPS = {"printed equations": "sweep", "emulation": "sweep_published_code"}
QUANTITIES = [("healed_shape_mean", "healed shape", "fig3_shape.csv", 1.2, 1.9),
              ("closure_rate_of_mean_um2_per_min", "closure rate (um$^2$/min), log10", "fig3_rate.csv", -0.8, 1.0)]


def ours(results, sweep, quantity):
    path = results / sweep / "nodes.csv"
    if not path.exists():
        return None
    rows = [row for row in read(path) if row["runs"] > 0]
    return [(r["area.stiffness"], r["plasticity.tau"], r[quantity], r) for r in rows] or None


def shown(quantity, value):
    return math.log10(value) if "rate" in quantity else value


def draw(axis, nodes, quantity, low, high):
    """Filled contours by linear interpolation between the nodes; crosses where the mean wound never closes."""
    values = [(k * KPA, tau * MIN, shown(quantity, v)) for k, tau, v in nodes if v != "" and v > 0]
    open_ = [(k * KPA, tau * MIN) for k, tau, v in nodes if v == ""]
    levels = np.linspace(low, high, 15)
    picture = None
    x, y, z = map(np.array, zip(*values)) if values else ([], [], [])
    # Contours would run across nodes that have no value: then the nodes alone.
    if not open_ and len(values) > 3 and len(set(x)) > 1 and len(set(y)) > 1:
        picture = axis.tricontourf(np.log2(x), np.log10(y), z, levels=levels, cmap="viridis", extend="both")
        picture.axes.scatter(np.log2(x), np.log10(y), c=z, cmap="viridis", vmin=low, vmax=high, ec="k", lw=0.4, s=22)
    elif values:
        picture = axis.scatter(np.log2(x), np.log10(y), c=z, cmap="viridis", vmin=low, vmax=high, ec="k", lw=0.4, s=60)
    for b, tau in open_:
        axis.plot(math.log2(b), math.log10(tau), "kx", ms=6)
    for name, (b, tau, colour) in TISSUES.items():
        axis.plot(math.log2(b), math.log10(tau), "s", mfc="none", mec=colour, ms=10, mew=1.8)
    ticks = [0.04, 0.08, 0.16, 0.32, 0.64, 1.28]
    axis.set(xticks=[math.log2(b) for b in ticks], xticklabels=[f"{b:g}" for b in ticks], xlabel="$B$ (kPa)")
    axis.set(yticks=range(0, 5), yticklabels=[f"$10^{n}$" for n in range(0, 5)], ylim=(0, 4.2), xlim=(-4.9, 1.2))
    return picture


def compare(name, nodes, published, quantity):
    """Mean absolute difference where the published value is determined."""
    found = {(r["ka_star"], r["tau_star"]): r for r in published}
    differences = []
    for k, tau, value, _ in nodes:
        row = found.get((k, tau))
        if row is None or value == "":
            continue
        low, high = (shown(quantity, row["lo"]), shown(quantity, row["hi"])) if row["lo"] > 0 else (None, None)
        if low is not None and high - low < (0.25 if "rate" in quantity else 0.1):
            differences.append(shown(quantity, value) - shown(quantity, row["best"]))
    if differences:
        scale = math.log(10) if "rate" in quantity else 1.0
        print(f"{name}, {quantity}: mean absolute difference {scale * np.mean(np.abs(differences)):.3f}, mean {scale * np.mean(differences):+.3f}"
              f" over {len(differences)} nodes{' (natural logarithm)' if scale != 1.0 else ''}")


results, published_folder, picture_file = arguments()
figure, axes = plt.subplots(2, 3, figsize=(13, 7.5))
for row, (quantity, label, file, low, high) in zip(axes, QUANTITIES):
    published = read(published_folder / file)
    for axis, (name, sweep) in zip(row, SWEEPS.items()):
        nodes = ours(results, sweep, quantity)
        axis.set_title(f"{label.split(' (')[0]}, {name}")
        if nodes is None:
            axis.text(0.5, 0.5, "not run yet", ha="center", transform=axis.transAxes)
            continue
        picture = draw(axis, [n[:3] for n in nodes], quantity, low, high)
        compare(name, nodes, published, quantity)
        if picture is not None:
            figure.colorbar(picture, ax=axis, label=label)
    best = draw(row[2], [(r["ka_star"], r["tau_star"], r["best"]) for r in published], quantity, low, high)
    figure.colorbar(best, ax=row[2], label=label)
    row[2].set_title("published (42 nodes)")
    row[0].set_ylabel("$\\tau$ (min)")
save(figure, picture_file)
