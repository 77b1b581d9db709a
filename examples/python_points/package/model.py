# SPDX-License-Identifier: BSL-1.0
"""Boundary-value problems as they are written down, and materials in Python."""
from __future__ import annotations

import copy
import warnings
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _points
from .meshes import Mesh

Floats = npt.NDArray[np.float64]
Sides = Union[str, Sequence[str]]
Amplitude = Sequence[Tuple[float, float]]


def _names(sides: Sides) -> List[str]:
    return [sides] if isinstance(sides, str) else list(sides)


def _loaded(sides: Sides) -> List[str]:
    names = _names(sides)
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"the boundary {name!r} is named twice in one call (its load would double): name it once")
    return names


def _knots(amplitude: Optional[Amplitude]) -> Optional[List[Tuple[float, float]]]:
    return None if amplitude is None else [(float(load), float(value)) for load, value in amplitude]


def _water_boundaries(given: Optional[Mapping[str, Any]]) -> Dict[str, Any]:
    def boundary(side: str, value: Any) -> Any:
        if isinstance(value, (int, float, np.number)):
            return float(value)
        try:
            size, amplitude = value
            return float(size), _knots(amplitude)
        except (TypeError, ValueError) as error:
            raise ValueError(f"water at '{side}' is given as {value!r} (a number, or a pair of it and its amplitude, a list of (load factor, value), is "
                             "expected): correct it") from error

    return {side: boundary(side, value) for side, value in (given or {}).items()}


class Model:
    """A boundary-value problem as it is written down: boundaries held and loaded by name, materials by region, weight.

    The materials' initial stresses need not balance the loads: what is missing is held by forces which fade while the load factor goes from 0 to
    1, and the loads grow meanwhile. That is how ground is balanced, and how it is excavated: give the mesh without what is taken away, and the
    stress that was there. An `amplitude` is a list of (load factor, value), linear between them; by default it is the load factor itself for motions,
    and 0 to 1 for loads.

    Parameters
    ----------
    mesh : Mesh
    kinematics : str
        "updated_lagrangian" for large displacements, or "small_strain".
    thickness : float
        Out of the plane [m].

    Raises
    ------
    ValueError
        For an invalid mesh, naming the element or node.

    Examples
    --------
    >>> import scarp
    >>> model = scarp.Model(scarp.box_mesh("quad4", [2.0, 1.0], [4, 2]))
    >>> model.fix(["left", "right"], axis=0)
    >>> model.fix("bottom")
    >>> model.gravity(18e3)
    >>> model.material("soil", scarp.linear_elastic(young=20e6, poisson=0.3, **model.geostatic(0.5)))
    >>> scarp.Analysis(model).to(1.0).steps > 0
    True
    """

    def __init__(self, mesh: Mesh, kinematics: str = "updated_lagrangian", thickness: float = 1.0) -> None:
        if not isinstance(mesh, Mesh):
            raise TypeError(f"the mesh is {type(mesh).__name__} (a scarp.Mesh is expected): make one by scarp.read_gmsh, scarp.box_mesh or scarp.Mesh")
        mesh = copy.deepcopy(mesh)  # what becomes of the caller's is not of this model
        mesh.boundaries = {name: np.asarray(facets) for name, facets in mesh.boundaries.items()}
        for array in (mesh.nodes, mesh.elements, mesh.element_region, *mesh.boundaries.values()):
            array.setflags(write=False)
        self.mesh = mesh
        self._made = (mesh, kinematics, thickness)
        self._calls: List[Tuple[str, Tuple[Any, ...]]] = []
        self._has_analysis = False
        self._level: Optional[float] = None
        make = _points.Model if mesh.dim == 2 else _points.ModelInSpace
        self._model = make(mesh.element, mesh.nodes, mesh.elements, mesh.element_region, mesh.regions, mesh.boundaries, kinematics, float(thickness))

    def __repr__(self) -> str:
        return f"Model({self.mesh!r}, {self._made[1]})"

    def _warn_of_analysis(self, name: str) -> None:
        if self._has_analysis:
            warnings.warn(f"{name} is called after an analysis was made of the model (it does not see the change): make another analysis", stacklevel=4)

    def _do(self, name: str, *values: Any) -> None:
        self._warn_of_analysis(name)
        getattr(self._model, name)(*values)
        self._calls.append((name, values))

    def __reduce__(self) -> Any:
        return model_of, (self._made, self._calls)

    @property
    def dim(self) -> int:
        """2 in the plane, 3 in space."""
        return self.mesh.dim

    def fix(self, sides: Sides, axis: Optional[int] = None) -> None:
        """Holds boundaries along an axis, or along all axes."""
        for one in range(self.dim) if axis is None else [axis]:
            self._do("fix", _names(sides), one)

    def move(self, sides: Sides, axis: int, rate: float, amplitude: Optional[Amplitude] = None) -> None:
        """Moves boundaries along an axis by `rate` [m] times the growth of the amplitude since the load factor 0."""
        self._do("move", _names(sides), axis, float(rate), _knots(amplitude))

    def gravity(self, unit_weight: float, region: Optional[str] = None) -> None:
        """Weight [N/m3] of a region, or of all, downwards along the last axis."""
        self._do("gravity", float(unit_weight), region)

    def traction(self, sides: Sides, force: Sequence[float], amplitude: Optional[Amplitude] = None) -> None:
        """Force per area [Pa], shape (dim,), on boundaries of the initial mesh."""
        self._do("traction", _loaded(sides), np.array(force, dtype=float), _knots(amplitude))

    def surcharge(self, sides: Sides, pressure: float, amplitude: Optional[Amplitude] = None) -> None:
        """Vertical pressure [Pa], downwards, on boundaries of the initial mesh."""
        self._do("surcharge", _loaded(sides), float(pressure), _knots(amplitude))

    def water(self, shear_modulus: float, clock: Amplitude, conductivity: float = 0.0, grain: float = 0.0, void_ratio: float = 0.7,
              bulk_modulus: float = 2.2e9, drained: Sides = (), pressures: Optional[Mapping[str, Any]] = None,
              inflows: Optional[Mapping[str, Any]] = None, table: Optional[float] = None,
              largest_time_error: Optional[float] = None) -> None:
        """Pore water that fills the pores of all elements and flows through them. Stresses of materials are effective ones; weight is that of which
        water carries nothing: below the water table give the buoyant one. Other boundaries than those that are named are impermeable.

        Parameters
        ----------
        shear_modulus : float
            Of the ground, in size [Pa]: it stabilises the pressures and weighs the unknowns.
        clock : list of (float, float)
            Time [s] over the load factor, from 0 s on: equal times are undrained loading, growing ones consolidation.
        conductivity : float
            Hydraulic, constant [m/s].
        grain : float
            Diameter [m] of Kozeny and Carman's permeability, by the void ratio as it evolves, instead.
        void_ratio : float
            At the start.
        bulk_modulus : float
            Of the water [Pa]; infinity for one whose volume does not change.
        drained : str or sequence of str
            Boundaries of zero excess pressure.
        pressures, inflows : dict
            By boundary: an excess pressure [Pa] or an inflow [m/s], or a tuple of it and its amplitude.
        table : float
            Height [m] of the water table: the ground above it has no water, and below it water cavitates at -100 kPa over the air's pressure.
        largest_time_error : float
            Of one step in any pressure [Pa], estimated: it sizes the steps, so that a clock needs no knots between its ends. Sudden loads are
            followed in short steps; let `Analysis` have a `smallest` of 1e-9.

        Examples
        --------
        >>> import scarp
        >>> column = scarp.Model(scarp.box_mesh("quad8", [0.1, 1.0], [1, 10]), kinematics="small_strain")
        >>> column.fix(["left", "right"], axis=0)
        >>> column.fix("bottom")
        >>> column.traction("top", [0.0, -10.0], amplitude=[(0, 0), (1, 1)])
        >>> column.material("soil", scarp.linear_elastic(young=1e3, poisson=0.0))
        >>> column.water(shear_modulus=500.0, conductivity=1e-5, clock=[(0, 0), (1, 0), (2, 100)], drained="top", bulk_modulus=float("inf"))
        >>> analysis = scarp.Analysis(column, largest=1.0)
        >>> undrained = analysis.to(1.0)
        >>> bool(abs(analysis.pore_pressures[analysis.boundary_nodes("bottom")] / 10.0 - 1.0).max() < 1e-6)
        True
        """
        self._do("water", float(shear_modulus), float(conductivity), float(grain), float(void_ratio), float(bulk_modulus),
                 None if table is None else float(table), None if largest_time_error is None else float(largest_time_error),
                 _knots(clock), _names(drained), _water_boundaries(pressures), _water_boundaries(inflows))

    def set_surface_level(self, height: float) -> None:
        """Height [m] from which depths are measured, by default that of the highest node."""
        self._do("set_surface_level", float(height))
        self._level = float(height)

    def geostatic(self, k0: float, region: str = "") -> Dict[str, float]:
        """Stress at rest of level ground, as keywords of a material: `surcharge` [Pa], `unit_weight` [N/m3] and `k0`.

        Weight and surcharges are given before.

        Raises
        ------
        ValueError
            For regions of different weights without a name, one below ground of another weight, and surcharges that differ or press on a part of
            the surface.
        """
        rest: Dict[str, float] = self._model.geostatic(float(k0), region)
        self._calls.append(("geostatic", (float(k0), region)))
        return rest

    def depths(self, region: str = "") -> Floats:
        """Depths [m] of the points of a region, or of all, shape (points,)."""
        return self._model.depths(region)

    def positions(self, region: str = "") -> Floats:
        """Positions [m] of the points of a region, or of all, shape (points, dim)."""
        return self._model.sites(region)

    def dead_load(self) -> Floats:
        """Weight and surcharges [N] in all, shape (dim,)."""
        return self._model.dead_load()

    def material(self, region: str, material: Any, length: float = 0.0, exact_tangent: Optional[bool] = None) -> None:
        """The material of a region's points.

        Parameters
        ----------
        region : str
        material : Material or object
            Of `scarp.linear_elastic` and its kin, or one that is written in Python, see `scarp.PythonMaterial`.
        length : float
            Nonlocal length [m]: points see means of the increments around them; 0 for none.
        exact_tangent : bool
            Of a material in Python: whether its tangents are the derivatives of its stresses; by default its own attribute of that name, else false.
        """
        self._warn_of_analysis("material")
        known = (_points.Material, _points.MaterialInSpace)
        own = material
        if not isinstance(material, known):
            exact = getattr(material, "exact_tangent", False) if exact_tangent is None else exact_tangent
            own = (_points.python_material if self.dim == 2 else _points.python_material_in_space)(material, bool(exact))
            self._require_stress_kept(material, region)
        elif not isinstance(material, known[self.dim - 2]):
            raise ValueError(f"the material of '{region}' has {material.dim} dimensions (the mesh has {self.dim}): make it with dim={self.dim}")
        self._model.material(region, own, float(length))
        self._calls.append(("material", (region, material, length, exact_tangent)))

    def _require_stress_kept(self, material: Any, region: str) -> None:
        """A strain of zero is to change no stress. ValueError"""
        positions = self.positions(region)
        if not len(positions):
            raise ValueError(f"region '{region}' has no elements (a material is for some): leave it out")
        position = positions[0]
        level = float(np.asarray(self.mesh.nodes)[:, -1].max()) if self._level is None else self._level
        begin = material.start(position, max(level - float(position[-1]), 0.0))
        if not isinstance(begin, tuple) or len(begin) not in (2, 3):
            raise ValueError(f"start of the material of '{region}' returned {begin!r} (a tuple of stress, tangent and, where it has some, variables is "
                             "expected): correct it")
        stress, kept = np.array(begin[0], dtype=float), np.array(begin[2] if len(begin) == 3 else [], dtype=float)
        if not np.isfinite(stress).all():
            raise ValueError(f"start of the material of '{region}' returned the stress {stress} Pa (finite numbers are expected): correct it")
        if hasattr(material, "respond"):
            end = material.respond(np.zeros_like(stress), stress.copy(), kept.copy())
        else:
            end = material.respond_all(np.zeros((1, len(stress))), stress[None].copy(), kept[None].copy())
        try:
            found = np.ravel(np.asarray(end[0], dtype=float))
        except (TypeError, ValueError):
            return  # the first response rejects it in words
        size = np.abs(stress).max() + 1e-9 * np.abs(np.asarray(begin[1], dtype=float)).max()
        if found.shape == stress.shape and np.isfinite(found).all() and np.abs(found - stress).max() > 1e-6 * size:
            raise ValueError(f"the material of '{region}' turns the stress {stress} Pa into {found} Pa for a strain of zero (it is expected to keep it): add "
                             "the change of stress to the one that is given")


def model_of(made: Tuple[Any, ...], calls: Sequence[Tuple[str, Tuple[Any, ...]]]) -> Model:
    """A model made anew: its mesh, and what was called."""
    model = Model(*made)
    for name, values in calls:
        if name in ("material", "geostatic", "set_surface_level"):
            getattr(model, name)(*values)
        else:
            model._do(name, *values)
    return model


class PythonMaterial:
    """What a material in Python has; it may derive from this class, or only look like it. Slow: for a law that is tried out.

    `start` and one of `respond` and `respond_all` are expected. Strains are those of the increment since the last commit before its rotation, with
    engineering shear; stresses [Pa] are tension positive and are rotated by scarp; order xx, yy, xy or xx, yy, zz, yz, zx, xy. The functions keep no
    state of their own: what evolves is in `variables`.
    """

    exact_tangent = False

    def start(self, position: Floats, depth: float) -> Tuple[npt.ArrayLike, ...]:
        """Stress, tangent and, where it has some, variables [k] of a point at position [dim] and depth [m]."""
        raise NotImplementedError

    # def respond(self, strain, stress, variables): stress, tangent and variables at the end of the increment
    # def respond_all(self, strains, stresses, variables): the same for arrays, a row to each point
