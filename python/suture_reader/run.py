"""A run as dataclasses of numpy arrays."""

from __future__ import annotations

import collections.abc
import json
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional

import h5py
import numpy as np

SCHEMA = "suture-trajectory"
NEWEST_VERSION = 1


class RunError(Exception):
    """The file is not a run of suture, or one this package is too old for."""


@dataclass(frozen=True)
class Tissue:
    """Who is made of what. Cell i owns the vertices first_vertex[i] to first_vertex[i + 1] - 1, counter-clockwise."""

    first_vertex: np.ndarray  # cells + 1
    initial_rest_length: np.ndarray  # l0(0) of each segment; segment v leads from vertex v to the next of its cell
    material: Dict[str, np.ndarray]  # rest_area, area_stiffness, ..., one value per cell

    @property
    def cell_count(self) -> int:
        return len(self.first_vertex) - 1

    @property
    def vertex_count(self) -> int:
        return int(self.first_vertex[-1])

    def vertices(self, cell: int) -> slice:
        if not 0 <= cell < self.cell_count:
            raise IndexError(f"cell {cell}: the tissue has the cells 0 to {self.cell_count - 1}")
        return slice(int(self.first_vertex[cell]), int(self.first_vertex[cell + 1]))

    def cell_of_vertex(self) -> np.ndarray:
        return np.repeat(np.arange(self.cell_count), np.diff(self.first_vertex))

    def next_vertex(self) -> np.ndarray:
        """For each vertex the next one of its cell."""
        following = np.arange(1, self.vertex_count + 1)
        following[self.first_vertex[1:] - 1] = self.first_vertex[:-1]
        return following


@dataclass(frozen=True)
class PurseString:
    """Vertices of the contractile ring, in boundary order; len() is 0 when there is none."""

    position: np.ndarray  # ring, 2
    vertex: np.ndarray  # cell vertex each is tethered to
    slipped: np.ndarray  # bool: the tether has lost its force

    def __len__(self) -> int:
        return len(self.vertex)


@dataclass(frozen=True)
class Frame:
    time: float  # simulation time
    position: np.ndarray  # vertices, 2
    rest_length: np.ndarray  # l0, one per segment
    purse_string: PurseString
    cells: Dict[str, np.ndarray]  # stored fields, one value per cell
    wound_outline: np.ndarray  # points, 2; counter-clockwise; empty when there is no wound
    tissue: Tissue = field(repr=False)

    def outline(self, cell: int) -> np.ndarray:
        """Vertices of one cell, [n, 2]."""
        return self.position[self.tissue.vertices(cell)]

    def lengths(self) -> np.ndarray:
        """Length of each segment."""
        return np.linalg.norm(self.position[self.tissue.next_vertex()] - self.position, axis=1)

    def rest_length_strains(self) -> np.ndarray:
        """l0/l0(0) - 1 of each segment."""
        return self.rest_length / self.tissue.initial_rest_length - 1.0

    def areas(self) -> np.ndarray:
        """Area of each cell."""
        # Coordinates relative to the cell's first vertex lose no digits far from the origin.
        first = self.position[self.tissue.first_vertex[:-1]][self.tissue.cell_of_vertex()]
        a, b = self.position - first, self.position[self.tissue.next_vertex()] - first
        return 0.5 * self._per_cell(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])

    def perimeters(self) -> np.ndarray:
        return self._per_cell(self.lengths())

    def shape_parameters(self) -> np.ndarray:
        """p^2/(4 pi a) of each cell: 1 for a circle."""
        return self.perimeters() ** 2 / (4.0 * np.pi * np.abs(self.areas()))

    def _per_cell(self, values: np.ndarray) -> np.ndarray:
        return np.add.reduceat(values, self.tissue.first_vertex[:-1])


@dataclass(frozen=True)
class Series:
    name: str
    unit: str  # model unit
    description: str
    time: np.ndarray
    value: np.ndarray


@dataclass(frozen=True)
class Event:
    time: float
    kind: str
    cell: Optional[int]
    vertex: Optional[int]


class Frames(collections.abc.Sequence):
    """Frames, each read from the file when it is asked for."""

    def __init__(self, file: h5py.File, tissue: Optional[Tissue]):
        self._file, self._tissue = file, tissue
        self._count = int(file.attrs["frame_count"])

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(f"frame {index}: the run has {len(self)} frames")
        group = self._file[f"frames/{index % len(self):06}"]
        ring = group["purse_string"]
        return Frame(
            time=float(group["time"][()]),
            position=group["position"][:],
            rest_length=group["rest_length"][:],
            purse_string=PurseString(ring["position"][:], ring["vertex"][:], ring["mode"][:] == 1),
            cells={name: values[:] for name, values in group["cells"].items()},
            wound_outline=group["wound_outline"][:],
            tissue=self._tissue,
        )

    @property
    def times(self) -> np.ndarray:
        return np.array([self._file[f"frames/{i:06}/time"][()] for i in range(len(self))])


@dataclass(frozen=True)
class Run:
    """A run; also a context manager that closes the file."""

    path: str
    length_um: float  # of one model length
    time_min: float  # of one unit of time
    complete: bool  # False: the run goes on, or was killed
    code_version: str
    code_commit: str
    config: str  # TOML with every default filled in
    tissue: Optional[Tissue]  # None when the file holds no frame
    frames: Frames = field(repr=False)
    observables: Dict[str, Series] = field(repr=False)
    events: List[Event] = field(repr=False)
    summary: Dict[str, Any] = field(repr=False)  # summary.json; empty when none was written
    file: h5py.File = field(repr=False)

    @property
    def time_origin(self) -> float:
        """Simulation time at which the purse string started; 0 where there is none."""
        return float(self.summary.get("t_purse_string") or 0.0)

    def minutes(self, time):
        """Physical time since the purse string started."""
        return (np.asarray(time) - self.time_origin) * self.time_min

    def close(self) -> None:
        self.file.close()

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _text(value) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _read_tissue(file: h5py.File) -> Optional[Tissue]:
    if int(file.attrs["frame_count"]) == 0:
        return None
    group = file["tissue"]
    material = {name: values[:] for name, values in group["material"].items()}
    return Tissue(group["first_vertex"][:].astype(np.int64), group["initial_rest_length"][:], material)


def _read_observables(file: h5py.File) -> Dict[str, Series]:
    def series(name, group):
        attributes = group["value"].attrs
        return Series(name, _text(attributes["unit"]), _text(attributes["description"]), group["time"][:], group["value"][:])

    return {name: series(name, group) for name, group in file["observables"].items()}


def _read_events(file: h5py.File) -> List[Event]:
    group = file["events"]
    columns = (group[name][:] for name in ("time", "kind", "cell", "vertex"))
    def known(index):
        return None if index < 0 else int(index)

    return [Event(float(t), _text(kind), known(cell), known(vertex)) for t, kind, cell, vertex in zip(*columns)]


def read_run(path) -> Run:
    """Opens a run.h5. Raises RunError when it is something else, OSError when it cannot be opened."""
    file = h5py.File(path, "r")
    try:
        if _text(file.attrs.get("schema", "")) != SCHEMA:
            raise RunError(f"{path}: not a run of suture")
        version = int(file.attrs["schema_version"])
        if version > NEWEST_VERSION:
            raise RunError(f"{path}: layout {version} is newer than what suture_reader knows ({NEWEST_VERSION})")
        tissue = _read_tissue(file)
        return Run(
            path=str(path),
            length_um=float(file.attrs["length_um"]),
            time_min=float(file.attrs["time_min"]),
            complete=bool(file.attrs["complete"]),
            code_version=_text(file.attrs["code_version"]),
            code_commit=_text(file.attrs["code_commit"]),
            config=_text(file["provenance/resolved_config"][()]),
            tissue=tissue,
            frames=Frames(file, tissue),
            observables=_read_observables(file),
            events=_read_events(file),
            summary=json.loads(_text(file["summary"][()])) if "summary" in file else {},
            file=file,
        )
    except BaseException:
        file.close()
        raise
