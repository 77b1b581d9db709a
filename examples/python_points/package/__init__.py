# SPDX-License-Identifier: BSL-1.0
"""Finite elements of which each point carries a packing of grains or another material: problems, and points alone that respond to NumPy arrays."""
import pathlib
import sys

try:
    import numpy
except ImportError as missing:
    raise ImportError(f"scarp needs NumPy ('{sys.executable}' finds none): install it for this Python, or run another one") from missing
try:
    from . import _points
except ImportError as missing:
    _built = ", ".join(path.name for path in pathlib.Path(__file__).parent.glob("_points*")) or "nothing"
    raise ImportError(f"scarp's compiled part does not load in Python {sys.version.split()[0]} ({missing}; there is {_built}): run the Python that it was built "
                      "for, or build it with -D Python_EXECUTABLE=" + sys.executable) from missing
from ._points import FieldSeries, build, load, reasons, statuses
from .fault import FaultRun, fault_estimate, fault_rupture
from .figures import Frames, History, plot_packing
from .lab import LabRun, calibrate, rve_lab
from .materials import (MaterialPoints, discs, ellipses, ground_of_discs, ground_of_ellipses, linear_elastic, loads, mohr_coulomb, packing, spheres,
                        umat)
from .meshes import Mesh, box_mesh, read_gmsh
from .micro_simulation import MicroSimulation
from .model import Model, PythonMaterial
from .problem import Analysis, Collapse, NotConverged, Run, SafetyFactor, load_analysis, reduce_strength
from .program_options import options
from .study import study

__all__ = ["Analysis", "Collapse", "FaultRun", "FieldSeries", "Frames", "History", "LabRun", "MaterialPoints", "Mesh", "MicroSimulation", "Model", "NotConverged",
           "PythonMaterial", "Run", "SafetyFactor", "box_mesh", "build", "calibrate", "discs", "ellipses", "fault_estimate", "fault_rupture",
           "ground_of_discs", "ground_of_ellipses", "linear_elastic", "load", "load_analysis", "loads", "mohr_coulomb", "options", "packing",
           "plot_packing", "read_gmsh", "reasons", "reduce_strength", "rve_lab", "spheres", "statuses", "study", "umat"]
