# SPDX-License-Identifier: MIT
"""Breaks solid objects made of tetrahedra, checks meshes, and converts them.

All lengths are in m, masses in kg, times in s, stresses in Pa. Errors are `sunder.Error`, whose
`findings` say what is wrong and what to do. Long calls let Python's other threads run.
"""

from ._api import Simulation, modes, split, static
from ._sunder import (BodyChange, Check, Error, FaceSplit, Fan, Finding, Fragment, Map, Mesh, StepReport,
                      __version__, ball, box, check, convert, cylinder, read, write)

__all__ = ["BodyChange", "Check", "Error", "FaceSplit", "Fan", "Finding", "Fragment", "Map", "Mesh", "Simulation",
           "StepReport", "ball", "box", "check", "convert", "cylinder", "modes", "read", "split", "static", "write"]
