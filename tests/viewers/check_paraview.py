"""Opens an export with ParaView's own readers: pvpython check_paraview.py DIRECTORY FRAMES [PICTURE.png]

DIRECTORY holds xdmf/ and vtp/ of a closure with FRAMES frames. Exits 1 with what is wrong."""

import os
import sys

from paraview import servermanager, simple
from paraview.simple import ColorBy, CreateView, Delete, PVDReader, Render, ResetCamera, SaveScreenshot, Show

directory, frames = os.path.abspath(sys.argv[1]), int(sys.argv[2])
problems = []

POINT_FIELDS = {"cells": {"force", "tether", "vertex"}}
CELL_FIELDS = {
    "cells": {"cell", "shape_parameter", "area_strain", "area", "perimeter", "contacts"},
    "segments": {"cell", "length", "rest_length", "rest_length_strain", "membrane_tension"},
    "purse_string": {"tether", "tension", "length", "rest_length", "slipped"},
    "wound": set(),
}


def expect(condition, text):
    if not condition:
        problems.append(text)
        print("FAILED: " + text)


def merged(source, time):
    """The polygons or lines of one time."""
    source.UpdatePipeline(time)
    data = servermanager.Fetch(source)
    while data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    return data


def polygon_area(data, index):
    cell = data.GetCell(index)
    points = [data.GetPoint(cell.GetPointId(k)) for k in range(cell.GetNumberOfPoints())]
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1]))


def check(series, source, what):
    times = list(source.TimestepValues)
    expect(len(times) == frames, f"{what}: {len(times)} times instead of {frames}")
    expect(times == sorted(times) and times[0] == 0.0, f"{what}: times {times[:3]} ...")
    for time in times:
        # Once the wound is closed there is none, and VTP says so with an empty frame.
        closed = time == times[-1] and what.startswith("PVDReader") and series in ("purse_string", "wound")
        if closed and merged(source, time).GetNumberOfPoints() == 0:
            continue
        check_frame(series, merged(source, time), f"{what}, t = {time}")
    if series == "cells":
        first, last = (merged(source, time).GetPoint(0) for time in (times[0], times[-1]))
        expect(first != last, f"{what}: nothing moves")


def check_frame(series, data, what):
    expect(data.GetNumberOfPoints() > 0 and data.GetNumberOfCells() > 0, f"{what}: nothing there")
    names = {data.GetCellData().GetArrayName(i) for i in range(data.GetCellData().GetNumberOfArrays())}
    expect(CELL_FIELDS[series] <= names, f"{what}: element fields {sorted(names)}")
    names = {data.GetPointData().GetArrayName(i) for i in range(data.GetPointData().GetNumberOfArrays())}
    expect(POINT_FIELDS.get(series, set()) <= names, f"{what}: point fields {sorted(names)}")
    if series != "cells":
        return
    # What was computed by suture must be what the geometry says.
    areas = data.GetCellData().GetArray("area")
    for index in range(data.GetNumberOfCells()):
        stored, seen = areas.GetTuple1(index), polygon_area(data, index)
        expect(abs(stored - seen) < 1e-9, f"{what}: cell {index} has area {seen}, stored {stored}")
    force = data.GetPointData().GetArray("force")
    expect(force is not None and force.GetNumberOfComponents() == 3, f"{what}: force is no vector")


readers = [name for name in ("XDMFReader", "Xdmf3ReaderS", "Xdmf3ReaderT") if hasattr(simple, name)]
expect(len(readers) >= 2, f"only the XDMF readers {readers} are here")
os.chdir(os.path.join(directory, "xdmf"))
for series in CELL_FIELDS:
    for reader in readers:
        # "./": without a folder in the name the Xdmf3 readers of ParaView 5.11 abort.
        for path in (os.path.join(directory, "xdmf", series + ".xdmf"), f"./{series}.xdmf"):
            key = "FileNames" if reader == "XDMFReader" else "FileName"
            source = getattr(simple, reader)(**{key: [path]})
            check(series, source, f"{reader} {path}")
            Delete(source)
    check(series, PVDReader(FileName=os.path.join(directory, "vtp", series + ".pvd")), f"PVDReader {series}")

if len(sys.argv) > 3:
    time = float(list(PVDReader(FileName=os.path.join(directory, "vtp", "cells.pvd")).TimestepValues)[frames // 2])
    view = CreateView("RenderView")
    view.ViewSize = [900, 800]
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    view.ViewTime = time

    def show(series, **style):
        source = getattr(simple, readers[-1])(FileName=[os.path.join(directory, "xdmf", series + ".xdmf")])
        display = Show(source, view)
        for name, value in style.items():
            setattr(display, name, value)
        return display

    cells = show("cells")
    ColorBy(cells, ("CELLS", "shape_parameter"))
    cells.RescaleTransferFunctionToDataRange(False)
    cells.SetScalarBarVisibility(view, True)
    segments = show("segments", LineWidth=3)
    ColorBy(segments, ("CELLS", "membrane_tension"))
    ring = show("purse_string", LineWidth=4)
    ColorBy(ring, None)
    ring.DiffuseColor = ring.AmbientColor = [0.83, 0.07, 0.29]
    ResetCamera(view)
    Render(view)
    SaveScreenshot(sys.argv[3], view)

print("paraview: " + (f"{len(problems)} problems" if problems else f"all series right in {', '.join(readers)}, PVDReader"))
sys.exit(1 if problems else 0)
