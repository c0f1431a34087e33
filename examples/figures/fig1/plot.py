#!/usr/bin/env python3
"""Fig. 1: wound area and cell shape in experiments, with fits and moving averages."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from plotting import arguments, column, plt, read, save, select

COLOURS = {"wing_disc": "C0", "embryo": "C3"}
results, published, picture = arguments()
figure, axes = plt.subplots(1, 2, figsize=(10, 3.8))
fits, curves = read(results / "fit.csv"), read(results / "fit_curve.csv")
for tissue, colour in COLOURS.items():
    data = select(read(published / "fig1_wound_area.csv"), tissue=tissue)
    axes[0].plot(column(data, "t_min"), column(data, "area_norm"), ".", ms=3, alpha=0.4, color=colour)
    curve = select(curves, tissue=tissue)
    axes[0].plot(column(curve, "t_min"), column(curve, "fitted"), color=colour, label=f"{tissue.replace('_', ' ')}, our fit")
    axes[0].plot(column(curve, "t_min"), column(curve, "printed"), "k:", lw=1.5)
    p = {row["parameter"]: row for row in select(fits, tissue=tissue)}
    print(tissue + ": " + ", ".join(f"{n} = {p[n]['value']:.4g} +- {p[n]['standard_error']:.2g} (printed {p[n]['printed']:g})"
                                    for n in ["a1", "b1_per_min", "a2", "b2_per_min"]))
axes[0].plot([], [], "k:", label="printed fits")
axes[0].set(xlabel="time (min)", ylabel="A(t)/A(0)", title="wound area", ylim=(0, 1.6))
axes[0].legend()
averages = read(results / "moving_average.csv")
window = averages[0]["window_min"]
drawn = read(published / "fig1_cell_shape_moving_average.csv")
for tissue, colour in COLOURS.items():
    data = select(read(published / "fig1_cell_shape.csv"), tissue=tissue)
    axes[1].plot(column(data, "t_min"), column(data, "shape_A"), ".", ms=3, alpha=0.3, color=colour)
    ours = select(averages, tissue=tissue)
    axes[1].plot(column(ours, "t_min"), column(ours, "shape"), color=colour, label=f"{tissue.replace('_', ' ')}, {window:g} min window")
    theirs = [r for r in drawn if r["tissue"] == tissue and r["version"].startswith("fig1")]
    axes[1].plot(column(theirs, "t_min"), column(theirs, "shape_A"), "k:", lw=1.2)
    at = {round(r["t_min"], 3): r["shape"] for r in ours}
    common = [abs(at[round(r["t_min"], 3)] - r["shape_A"]) for r in theirs if round(r["t_min"], 3) in at]
    if common:
        print(f"{tissue}: moving average differs by at most {max(common):.4f} from the drawn one at {len(common)} common times")
axes[1].plot([], [], "k:", label="as drawn in the paper")
axes[1].set(xlabel="time (min)", ylabel="shape parameter", title="cells beside the wound")
axes[1].legend()
save(figure, picture)
