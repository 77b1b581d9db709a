# SPDX-License-Identifier: BSL-1.0
"""Materials of scarp, packings of grains among them, as points that respond to NumPy arrays."""
import os
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
from ._points import build, load, reasons, statuses
from .meshes import Mesh, box_mesh, read_gmsh
from .micro_simulation import MicroSimulation
from .problem import Analysis, FieldSeries, Model, NotConverged, PythonMaterial, Run, load_analysis


def _maker(kind, spaces):
    def make(dim=spaces[0], **keywords):
        if dim not in spaces:
            raise ValueError(f"dim is {dim!r} (expected is {' or '.join(map(str, spaces))}): correct it")
        return (_points.made if dim == 2 else _points.made_in_space)(kind, keywords)

    known = (_points.defaults if 2 in spaces else _points.defaults_in_space)(kind)
    make.__name__ = make.__qualname__ = kind
    make.__doc__ = "SI units, angles in radians. Keywords and their defaults: " + ", ".join(f"{name}={value!r}" for name, value in known.items())
    return make


linear_elastic = _maker("linear_elastic", (2, 3))
mohr_coulomb = _maker("mohr_coulomb", (2, 3))
umat = _maker("umat", (2, 3))
discs = _maker("discs", (2,))
ellipses = _maker("ellipses", (2,))
ground_of_discs = _maker("ground_of_discs", (2,))
ground_of_ellipses = _maker("ground_of_ellipses", (2,))
spheres = _maker("spheres", (3,))


def packing(sand, **keywords):
    """The sand of a file, with lines `option = value` (examples/sands); keywords as of discs, ellipses and spheres replace its values."""
    known = _points.sand_keywords(os.fspath(sand), set(keywords))
    kinds = {"disc": discs, "ellipse": ellipses, "sphere": spheres}
    if known["shape"] not in kinds:
        raise ValueError(f"the shape is '{known['shape']}' (expected is {', '.join(kinds)}): take another sand")
    make = kinds[known["shape"]]
    own = (_points.defaults_in_space if make is spheres else _points.defaults)(make.__name__)
    return make(**{**{name: value for name, value in known.items() if name in own}, **keywords})


def loads(saved):
    """Points from the bytes of their pickle."""
    return _points.loads(saved)


def MaterialPoints(material, positions, volumes=None, length=None, depths=None, indices=None):
    """Points of a material at positions[n, d] [m]. With a length [m] they see means around them, which volumes[n] [m3] weigh. Depths [m] are
    those of the geostatic stress; indices decide which of several packings a point draws, its number by default."""
    return _points.points(material, positions, volumes, length or 0.0, depths, indices)
