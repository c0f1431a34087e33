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
    """(case, time in min, A/A(0), shape, runs not yet closed at each time, standard error of A/A(0)) of every node with finished runs."""
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
            open_runs = (padded > 0.0).sum(axis=0)
            yield case, time * UNIT_MIN[tissue], area / area[0], node["mean_shape"][:], open_runs, error / area[0]


def published_curves(folder, file, value, curve):
    rows = [r for r in read(folder / file) if r["curve"] == curve]
    return np.array(column(rows, "t_min")) - rows[0]["t_min"], column(rows, value)


def first_time(time, area, level):
    """When the mean wound first falls to `level` of its maximum: in min."""
    below = np.nonzero((area <= level * area.max()) & (np.arange(len(area)) > area.argmax()))[0]
    if not len(below):
        return "never"
    k = below[0]
    return f"{np.interp(level * area.max(), [area[k], area[k - 1]], [time[k], time[k - 1]]):.1f}"


def beside_published(folder, case, time, area, shape, open_runs):
    """How far our means are from the published ones at the published times, as long as half of the runs are open."""
    if case not in PUBLISHED:
        return ""
    half = time[np.nonzero(open_runs * 2 >= open_runs[0])[0][-1]]
    text = []
    for file, column_name, values in [("fig4_wound_area.csv", "area_norm", area), ("fig4_cell_shape.csv", "shape_A", shape)]:
        t, wanted = published_curves(folder, file, column_name, PUBLISHED[case])
        t, wanted = t[t <= half], np.array(wanted)[t <= half]
        known = ~np.isnan(values)
        difference = np.interp(t, time[known], values[known]) - wanted
        text.append(f"{column_name} mean abs. {np.abs(difference).mean():.3f}, largest {difference[np.abs(difference).argmax()]:+.3f}, last {difference[-1]:+.3f}")
    return f"; from the published curves until {t[-1]:.0f} min: " + "; ".join(text)


results, published, picture = arguments()
figure, axes = plt.subplots(2, 2, figsize=(11, 7.5))
for sweep, (style, label) in SWEEPS.items():
    for case, time, area, shape, open_runs, error in means(results, sweep):
        column_index = 0 if case == "embryo" else 1
        name = f"{case.replace('_', ' ')}, {label}, {open_runs[0]} seeds"
        axes[0][column_index].plot(time, area, style, color=COLOURS[case], label=name)
        axes[0][column_index].fill_between(time, area - error, area + error, color=COLOURS[case], alpha=0.2, lw=0)
        # A mean over the few runs that are still open is another quantity: drawn faintly.
        few = open_runs * 2 < open_runs[0]
        axes[1][column_index].plot(time, np.where(few, np.nan, shape), style, color=COLOURS[case], label=name)
        axes[1][column_index].plot(time, np.where(few, shape, np.nan), style, color=COLOURS[case], alpha=0.25, lw=0.8)
        levels = " / ".join(first_time(time, area, level) for level in (0.5, 0.25, 0.1, 0.05))
        print(f"{name}: 50 / 25 / 10 / 5 % after {levels} min, {open_runs[-1] if len(open_runs) else 0} open at the end"
              + beside_published(published, case, time, area, shape, open_runs))
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
