# SPDX-License-Identifier: BSL-1.0
"""Materials by their keywords, and points of them."""
from __future__ import annotations

import os
from typing import Any, Callable, Optional, Sequence, Tuple

import numpy.typing as npt

from . import _points
from .meshes import Path


def _maker(kind: str, spaces: Tuple[int, ...], what: str) -> Callable[..., _points.Material]:
    def make(dim: int = spaces[0], **keywords: Any) -> _points.Material:
        if dim not in spaces:
            raise ValueError(f"dim is {dim!r} (expected is {' or '.join(map(str, spaces))}): correct it")
        return (_points.made if dim == 2 else _points.made_in_space)(kind, keywords)

    known = (_points.defaults if 2 in spaces else _points.defaults_in_space)(kind)
    make.__name__ = make.__qualname__ = kind
    make.__doc__ = f"{what} SI units, angles in radians. Keywords and their defaults: " + ", ".join(f"{name}={value!r}" for name, value in known.items())
    return make


_ground = "The initial stress is that of level ground, by `surcharge`, `unit_weight` and `k0`, see `Model.geostatic`."
_packing = "`progress` is called with what is done, what there is to do and a text."
_sand = f"A packing is prepared, or several by so many `threads`; {_packing} `stiffness_floor` is the share of its stiffness that a fluid point keeps."
_level = ("Packings that are compressed through the overburdens of all `depths`, each point gets that of its depth and is rejected at others. "
          f"{_packing} `stiffness_floor` is the share of its stiffness that a fluid point keeps.")
linear_elastic = _maker("linear_elastic", (2, 3), _ground)
mohr_coulomb = _maker("mohr_coulomb", (2, 3), _ground)
umat = _maker("umat", (2, 3), f"A user's UMAT in the shared library `file`; `variables` are STATEV at the start. {_ground}")
discs = _maker("discs", (2,), _sand)
ellipses = _maker("ellipses", (2,), _sand)
spheres = _maker("spheres", (3,), _sand)
ground_of_discs = _maker("ground_of_discs", (2,), _level)
ground_of_ellipses = _maker("ground_of_ellipses", (2,), _level)


def packing(sand: Path, **keywords: Any) -> _points.Material:
    """The sand of a file, with lines `option = value` (examples/sands); keywords as of discs, ellipses and spheres replace its values."""
    known = _points.sand_keywords(os.fspath(sand), set(keywords))
    kinds = {"disc": discs, "ellipse": ellipses, "sphere": spheres}
    if known["shape"] not in kinds:
        raise ValueError(f"the shape is '{known['shape']}' (expected is {', '.join(kinds)}): take another sand")
    make = kinds[known["shape"]]
    own = (_points.defaults_in_space if make is spheres else _points.defaults)(make.__name__)
    return make(**{**{name: value for name, value in known.items() if name in own}, **keywords})


def loads(saved: bytes) -> _points.Points:
    """Points from the bytes of their pickle."""
    return _points.loads(saved)


def MaterialPoints(material: _points.Material, positions: npt.ArrayLike, volumes: Optional[npt.ArrayLike] = None, length: Optional[float] = None,
                   depths: Optional[npt.ArrayLike] = None, indices: Optional[Sequence[int]] = None) -> _points.Points:
    """Points of a material at positions[n, d] [m]. With a length [m] they see means around them, which volumes[n] [m3] weigh. Depths [m] are
    those of the geostatic stress; indices decide which of several packings a point draws, its number by default."""
    return _points.points(material, positions, volumes, length or 0.0, depths, indices)
