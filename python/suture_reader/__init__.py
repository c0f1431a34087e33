"""Reads the run.h5 of suture: https://arxiv.org/abs/2305.12020, docs/reference/output-format.md.

Everything is in model units: lengths in sqrt(a0), areas in a0. Run.length_um and Run.minutes() lead to physical units.
"""

from .run import Event, Frame, PurseString, Run, RunError, Series, Tissue, read_run

__all__ = ["Event", "Frame", "PurseString", "Run", "RunError", "Series", "Tissue", "read_run"]
__version__ = "0.1.0"
