#!/usr/bin/env python3
"""Fig. 4: wound area and shape of the cells beside the wound, our means of the seeds, published simulations, experiments."""
import pathlib
import sys
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import h5py
import numpy as np
from plotting import arguments, column, plt, read, save, select

UNIT_MIN = {"embryo": 16.6667 / 60, "wing_disc": 13.3333 / 60}
SWEEPS = {"sweep": ("-", "printed equations"), "sweep_published_code": ("--", "emulation")}
COLOURS = {"embryo": "C3", "wing_disc": "C0", "wing_disc_memory_0.1": "C2", "wing_disc_memory_1": "C4", "wing_disc_memory_10": "C5"}
PUBLISHED = {"embryo": "embryo", "wing_disc": "wing_disc"}


def means(results, sweep):
    """(case, time in min, A/A(0), shape, seeds, standard error of A/A(0)) of every node with finished runs."""
    path = results / sweep / "sweep.h5"
    if not path.exists():
        return
    with h5py.File(path) as file:
        for name, node in file["nodes"].items():
            time, area = node["time"][:], node["wound_area"][:]
            if node.attrs["runs"] == 0 or not len(time):
                continue
            case = node.attrs["case"]
            case = case.decode() if isinstance(case, bytes) else case
            seeds = [run["wound_area"][:] for run in file["runs"].values()
                     if run.attrs["node"] == int(name) and len(run["wound_area"])]
            padded = np.array([np.pad(s, (0, len(time) - len(s))) for s in seeds])
            error = padded.std(axis=0, ddof=1) / np.sqrt(len(seeds)) if len(seeds) > 1 else np.zeros_like(time)
            tissue = "embryo" if case == "embryo" else "wing_disc"
            yield case, time * UNIT_MIN[tissue], area / area[0], node["mean_shape"][:], len(seeds), error / area[0]


def published_curves(folder, file, value, curve):
    rows = [r for r in read(folder / file) if r["curve"] == curve]
    return np.array(column(rows, "t_min")) - rows[0]["t_min"], column(rows, value)


results, published, picture = arguments()
figure, axes = plt.subplots(2, 2, figsize=(11, 7.5))
for sweep, (style, label) in SWEEPS.items():
    for case, time, area, shape, seeds, error in means(results, sweep):
        column_index = 0 if case == "embryo" else 1
        name = f"{case.replace('_', ' ')}, {label}, {seeds} seeds"
        axes[0][column_index].plot(time, area, style, color=COLOURS[case], label=name)
        axes[0][column_index].fill_between(time, area - error, area + error, color=COLOURS[case], alpha=0.2, lw=0)
        axes[1][column_index].plot(time, shape, style, color=COLOURS[case], label=name)
        reached = np.nonzero(area / area.max() <= 0.05)[0]
        print(f"{name}: 5 % after " + (f"{time[reached[0]]:.1f} min" if len(reached) else "never") + f", last mean shape {shape[~np.isnan(shape)][-1]:.3f}")
curves = sorted({r["curve"] for r in read(published / "fig4_wound_area.csv")} | {r["curve"] for r in read(published / "fig4_cell_shape.csv")})
for curve in curves:
    k = 0 if "embryo" in curve else 1
    for row, (file, value) in enumerate([("fig4_wound_area.csv", "area_norm"), ("fig4_cell_shape.csv", "shape_A")]):
        if select(read(published / file), curve=curve):
            time, values = published_curves(published, file, value, curve)
            axes[row][k].plot(time, values, "k:", lw=1.8, label=f"{curve.replace('_', ' ')}, published simulations")
drawn = [r for r in read(published / "fig1_cell_shape_moving_average.csv") if r["version"].startswith("fig4")]
for k, tissue in enumerate(["embryo", "wing_disc"]):
    data = select(read(published / "fig1_wound_area.csv"), tissue=tissue)
    axes[0][k].plot(column(data, "t_min"), column(data, "area_norm"), ".", color="0.75", ms=3, zorder=0, label="experiments")
    average = select(drawn, tissue=tissue)
    axes[1][k].plot(column(average, "t_min"), column(average, "shape_A"), color="0.6", lw=2.5, zorder=0, label="experiments, 20 min average")
    axes[0][k].set(title=tissue.replace("_", " "), ylabel="A(t)/A(0)", ylim=(0, 1.5), xlim=(0, 60 if k == 0 else 300))
    axes[1][k].set(xlabel="time (min)", ylabel="shape parameter", ylim=(1.1, 2.0), xlim=(0, 60 if k == 0 else 300))
    axes[0][k].legend(fontsize=7)
    axes[1][k].legend(fontsize=7)
save(figure, picture)
