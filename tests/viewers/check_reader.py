"""suture_reader against h5py and against what suture itself computed: python3 check_reader.py RUN.h5"""

import sys
import tempfile

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"SKIPPED: {missing} (Debian: python3-h5py)")
    sys.exit(77)

from suture_reader import RunError, read_run

path = sys.argv[1]
raw = h5py.File(path, "r")
with read_run(path) as run:
    assert run.complete and run.summary["status"] == "closed"
    assert len(run.frames) == len(raw["frames"]) > 2
    assert (run.frames.times == [raw[f"frames/{name}/time"][()] for name in sorted(raw["frames"])]).all()
    assert run.tissue.cell_count == len(raw["tissue/material/tau"]) > 0
    for frame in run.frames:
        assert np.allclose(frame.shape_parameters(), frame.cells["shape_parameter"], rtol=1e-12)
        assert np.allclose(frame.areas() / run.tissue.material["rest_area"] - 1, frame.cells["area_strain"], atol=1e-12)
        for cell in range(run.tissue.cell_count):
            x, y = frame.outline(cell).T
            assert np.isclose(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)), 2 * frame.areas()[cell])
        assert len(frame.purse_string.position) == len(frame.purse_string)
    assert len(run.frames[0].purse_string) > 0 and len(run.frames[0].wound_outline) > 2
    assert run.frames[-1].time == run.frames[len(run.frames) - 1].time
    assert [f.time for f in run.frames[0:2]] == list(run.frames.times[:2])
    area = run.observables["wound_area"]
    assert area.unit == "area" and len(area.time) == len(area.value)
    assert np.isclose(area.value[0], run.summary["wound_area_initial"])
    assert np.isclose(run.length_um**2 * area.value.max(), run.summary["wound_area_max_um2"])
    assert np.isclose(run.minutes(run.summary["t_closed"] + run.time_origin), run.summary["t_closed_min"])
    assert sum(event.kind == "closed" for event in run.events) == 1
    for wrong in (lambda: run.frames[len(run.frames)], lambda: run.frames[0].outline(run.tissue.cell_count)):
        try:
            wrong()
        except IndexError:
            continue
        raise AssertionError("an index out of range was accepted")

with tempfile.NamedTemporaryFile(suffix=".h5") as other:
    h5py.File(other.name, "w").close()
    try:
        read_run(other.name)
        raise AssertionError("a foreign file was accepted")
    except RunError as error:
        assert "not a run of suture" in str(error)
print("suture_reader: agrees with the file and with suture")
