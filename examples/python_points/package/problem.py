# SPDX-License-Identifier: BSL-1.0
"""The way of a model through its load factor: analyses, runs, failure of ground."""
from __future__ import annotations

import dataclasses
import os
import pickle
import time
import warnings
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _points
from ._points import FieldSeries
from .meshes import Mesh, Path, plane_axes
from .model import Floats, Model, model_of

Observer = Callable[["Analysis", Any], Optional[bool]]


@dataclasses.dataclass(frozen=True)
class Run:
    """How far a run came.

    Attributes
    ----------
    load : float
        Load factor of the committed state.
    status, reason : str
        "ok" where the run reached its end, see `scarp.statuses` and `scarp.reasons`.
    why : str
        The end in words: where it stopped and why the last attempt was rejected.
    steps, refused, iterations, inner_steps : int
        Accepted and rejected load steps, iterations of the solver and DEM steps of all points.
    largest_residual : float
        Of the accepted steps.
    material_seconds, seconds : float
        Wall time in the points and of the run [s].
    last_failure : str
        Why the last rejected attempt was rejected.
    worst_point : int
        Its material point, -1 for none.
    """

    load: float
    status: str
    reason: str
    why: str
    steps: int
    refused: int
    iterations: int
    inner_steps: int
    largest_residual: float
    material_seconds: float
    seconds: float
    last_failure: str
    worst_point: int


class NotConverged(RuntimeError):
    """A run that did not reach its load factor; `run` says how far it came and why."""

    def __init__(self, run: Run) -> None:
        advice = "hold it, or correct its material's stiffness" if "nothing holds" in run.why else "take smaller steps, a larger tolerance, or less load"
        super().__init__(f"{run.why}: {advice}; what was reached is committed")
        self.run = run

    def __reduce__(self) -> Any:
        return NotConverged, (self.run,)


@dataclasses.dataclass(frozen=True)
class Collapse:
    """How a load ended that was raised until the ground fails.

    Attributes
    ----------
    failed : bool
        Whether the ground has failed, at the load factor after `load`. A load step that becomes too small is no failure by itself.
    load : float
        Last load factor in equilibrium.
    ratio : float
        Displacement gradient per load of the last attempt over that of the first step.
    run : Run
    """

    failed: bool
    load: float
    ratio: float
    run: Run


@dataclasses.dataclass(frozen=True)
class SafetyFactor:
    """Factor by which a strength can be divided.

    Attributes
    ----------
    stands, fails : float
        Largest factor in equilibrium, smallest one at which the ground fails; 0 where none was found.
    why : str
        How the last run ended that was not in equilibrium.
    """

    stands: float
    fails: float
    why: str


class Analysis:
    """A `Model` on its way: a problem, a solver and threads. The load factor begins at 0 and only grows.

    Parameters
    ----------
    model : Model
    tolerance : float
        Force residual of a load step; by default 1e-6 where all materials have exact tangents, else 5e-3.
    max_iterations : int
        Of a load step.
    first, smallest, largest : float
        Increments of the load factor.
    max_displacement_gradient : float
        Of a step's prediction at any point.
    tangent_floor : float
        Share of the first tangent that is mixed into exact ones, so that ground flows at its limit load; 1e-4 for limit loads.
    threads : int
        0: as many as the process may use.
    """

    def __init__(self, model: Model, tolerance: Optional[float] = None, max_iterations: int = 30, first: float = 0.05, smallest: float = 1e-4,
                 largest: float = 0.1, max_displacement_gradient: float = 0.01, tangent_floor: float = 0.0, threads: int = 0) -> None:
        if not isinstance(model, Model):
            raise TypeError(f"the model is {type(model).__name__} (a scarp.Model is expected): make one")
        self.model = model
        self._settings: Dict[str, Any] = {
            "tolerance": None if tolerance is None else float(tolerance), "max_iterations": max_iterations, "first": float(first), "smallest": float(smallest),
            "largest": float(largest), "max_displacement_gradient": float(max_displacement_gradient), "tangent_floor": float(tangent_floor), "threads": threads}
        self._recipe = (model._made, tuple(model._calls))  # what later calls change in the model is not of this analysis
        self._analysis = (_points.Analysis if model.dim == 2 else _points.AnalysisInSpace)(model._model, *self._settings.values())
        model._has_analysis = True
        self._warn_of_short_lengths()

    def __repr__(self) -> str:
        return f"Analysis({self.model!r}, load factor {self.load:.6g})"

    def _warn_of_short_lengths(self) -> None:
        lengths = {values[0]: values[2] for name, values in self._recipe[1] if name == "material" and values[2] > 0.0}
        for region in sorted(self._analysis.regions_without_means() & lengths.keys()) if lengths else []:
            warnings.warn(f"a length of {lengths[region]} m reaches no neighbour of any point of region '{region}', so that it has none: take a longer one or "
                          "smaller elements", stacklevel=3)

    @property
    def mesh(self) -> Mesh:
        """Mesh of the model, with the nodes where they were at the start."""
        return self.model.mesh

    @property
    def load(self) -> float:
        """Load factor of the committed state."""
        return float(self._analysis.load)

    def to(self, load: float, observers: Union[Observer, Sequence[Observer]] = (), fields: Optional[FieldSeries] = None, progress: bool = False,
           time_limit: Optional[float] = None) -> Run:
        """Raises the load factor.

        Parameters
        ----------
        load : float
        observers : callable or sequence of callables
            Each is called as observer(analysis, step) after every attempt at a load step; `step` has number, load, accepted, status, reason,
            iterations, residual, worst_point and seconds. One that returns True ends the run. One that takes more time than the run itself is named
            in a warning.
        fields : FieldSeries
            Files for ParaView.
        progress : bool
            A bar of tqdm, where it is installed.
        time_limit : float
            Of this call [s]; the iteration that is at work is ended, so that what is committed remains.

        Returns
        -------
        Run

        Raises
        ------
        NotConverged
            Where the load factor is not reached, unless an observer or the time limit has ended the run. What was reached is committed.
        KeyboardInterrupt
            After the present factorisation, within a second in packings; the committed state remains.
        """
        with _Watch(self, observers, load, progress) as watch:
            run = Run(**self._analysis.to(float(load), watch.observer, fields, time_limit))
        watch.warn(run)
        if run.status not in ("ok", "fluid") and run.reason != "interrupted":
            raise NotConverged(run)
        return run

    def find_collapse(self, load: float, observers: Union[Observer, Sequence[Observer]] = (), fields: Optional[FieldSeries] = None, progress: bool = False,
                      time_limit: Optional[float] = None, failed: float = 100.0, failing: float = 10.0) -> Collapse:
        """Raises the load factor until the ground fails: until displacement gradients per load are `failed` times those of the first step that moves,
        of this call and after each knot of the amplitudes, or `failing` times where no equilibrium follows; or until no stiffness is left.
        Ground with friction fails slowly: compare the load with that of `failed=1000`. Other parameters as for `to`; `History` records the curve.

        Returns
        -------
        Collapse
        """
        with _Watch(self, observers, load, progress) as watch:
            end = self._analysis.find_collapse(float(load), float(failed), float(failing), watch.observer, fields, time_limit)
        run = Run(**end.pop("run"))
        watch.warn(run)
        return Collapse(run=run, **end)

    def displacement(self, side: str, axis: int) -> float:
        """Displacement [m] of a boundary's node that has moved farthest along an axis, with its sign."""
        return float(self._analysis.displacement(side, axis))

    def reaction(self, side: str) -> Floats:
        """Force [N] of the support of a boundary, shape (dim,): what its nodes carry less their loads."""
        return self._analysis.reaction(side)

    def boundary_nodes(self, side: str) -> npt.NDArray[np.int32]:
        """Numbers of a boundary's nodes, increasing."""
        return self._analysis.boundary_nodes(side)

    @property
    def positions(self) -> Floats:
        """Positions [m] of the nodes, shape (nodes, dim)."""
        return self._analysis.positions()

    @property
    def pore_pressures(self) -> Floats:
        """Excess pore pressures [Pa] at the nodes, positive in compression, shape (nodes,); ValueError without water."""
        fields = self._analysis.nodal_fields()
        if "excess_pore_pressure" not in fields:
            raise ValueError("the model has no water: give it, model.water(...)")
        return fields["excess_pore_pressure"]

    @property
    def displacements(self) -> Floats:
        """Displacements [m] of the nodes, shape (nodes, dim)."""
        moved: Floats = self.positions - np.asarray(self.mesh.nodes)
        return moved

    @property
    def stresses(self) -> Floats:
        """Cauchy stress [Pa] of the points, tension positive, shape (points, 3 or 6): xx, yy, xy, or xx, yy, zz, yz, zx, xy."""
        return self._analysis.stresses()

    @property
    def deformations(self) -> Floats:
        """Gradient of the present by the initial position at the points, shape (points, dim, dim)."""
        return self._analysis.deformations()

    @property
    def point_positions(self) -> Floats:
        """Positions [m] of the points, shape (points, dim)."""
        return self._analysis.point_positions()

    @property
    def point_elements(self) -> npt.NDArray[np.int32]:
        """Number of each point's element, shape (points,)."""
        return self._analysis.point_elements()

    @property
    def volumes(self) -> Floats:
        """Volumes [m3] of the points, thickness included, shape (points,)."""
        return self._analysis.volumes()

    def quantities(self, point: int) -> Dict[str, float]:
        """Named numbers of a point: p and q [Pa], mean and largest difference of the principal stresses, and those of its material."""
        return self._analysis.quantities(point)

    def picture(self, point: int) -> Any:
        """Cell, grains and contacts of a point's plane packing, see `MaterialPoints.picture`; None for other materials."""
        return self._analysis.picture(point)

    def table(self) -> Any:
        """Positions [m] and stresses [Pa] of the points as a `pandas.DataFrame`."""
        import pandas

        axes = "xyz"[:self.model.dim]
        components = ["xx", "yy", "xy"] if self.model.dim == 2 else ["xx", "yy", "zz", "yz", "zx", "xy"]
        columns: Dict[str, Any] = {axis: self.point_positions[:, k] for k, axis in enumerate(axes)}
        columns.update({f"stress_{name}": self.stresses[:, k] for k, name in enumerate(components)})
        return pandas.DataFrame(columns)

    def at_elements(self, of_points: npt.ArrayLike) -> Floats:
        """Means of numbers of the points over their elements, weighted by volume, shape (elements, ...)."""
        values, count = np.asarray(of_points, dtype=float), len(self.point_elements)
        if values.ndim == 0 or len(values) != count:
            raise ValueError(f"the numbers have the shape {values.shape} (({count}, ...) is expected, for so many points): give one to each")
        sums = np.zeros((len(self.mesh.elements), *values.shape[1:]))
        weights = np.zeros(len(sums))
        volumes = self.volumes
        np.add.at(sums, self.point_elements, values * volumes.reshape(-1, *[1] * (values.ndim - 1)))
        np.add.at(weights, self.point_elements, volumes)
        return sums / weights.reshape(-1, *[1] * (values.ndim - 1))

    def shear_strains(self) -> Floats:
        """Deviatoric logarithmic strain at the points, shape (points,): difference of the principal strains in the plane."""
        stretches = np.linalg.svd(self.deformations, compute_uv=False)
        return np.log(stretches[:, 0] / stretches[:, -1])

    def to_meshio(self) -> Any:
        """The deformed mesh with displacement at the nodes and stress at the elements, as meshio has it."""
        displacement = np.zeros((len(self.positions), 3))
        displacement[:, :self.model.dim] = self.displacements
        return self.mesh.to_meshio(self.positions, {"displacement": displacement, **self._analysis.nodal_fields()},
                                   {"stress": self.at_elements(self.stresses), "shear_strain": self.at_elements(self.shear_strains())})

    def write(self, file: Path) -> None:
        """Writes the deformed mesh and its fields by meshio, in the format of the file's name, such as .vtu."""
        self.to_meshio().write(os.fspath(file))

    def _of_elements(self, values: npt.ArrayLike, at: Optional[str]) -> Floats:
        """Numbers of the elements, from those of elements, points or nodes."""
        shown = np.asarray(values, dtype=float)
        sizes = {"elements": len(self.mesh.elements), "points": len(self.volumes), "nodes": len(self.mesh.nodes)}
        places = [name for name, size in sizes.items() if shown.shape == (size,) and at in (None, name)]
        if not places:
            wanted = " or ".join(f"{size} {name}" for name, size in sizes.items() if at in (None, name)) or "elements, points or nodes"
            raise ValueError(f"values have the shape {shown.shape} (a number for each of {wanted} is expected): take one component")
        if "nodes" in places and len(places) > 1:
            raise ValueError(f"values have the shape {shown.shape} (the mesh has as many {' and '.join(places)}): say which, at=\"{places[0]}\" or at=\"nodes\"")
        if places[0] == "elements":
            return shown
        means: Floats = self.at_elements(shown) if places[0] == "points" else shown[self.mesh.corners].mean(axis=1)
        return means

    def plot(self, values: Optional[npt.ArrayLike] = None, label: str = "", axes: Any = None, at: Optional[str] = None) -> Any:
        """Draws a plane problem: the deformed mesh, coloured by numbers of the elements, points or nodes, by default shear strain.

        `at` says of which, "elements", "points" or "nodes", where a mesh has as many of two.

        Returns
        -------
        matplotlib.axes.Axes
        """
        if self.model.dim != 2:
            raise ValueError("plot draws plane problems (this one is in space): write a file for ParaView, analysis.write(\"ground.vtu\")")
        from matplotlib.collections import PolyCollection

        shown = self._of_elements(self.shear_strains(), "points") if values is None else self._of_elements(values, at)
        axes = plane_axes(axes, 8.0, 4.0)
        filled = PolyCollection(self.positions[self.mesh.corners], array=shown, cmap="cividis", edgecolors="face", linewidths=0.5)
        axes.add_collection(filled)
        axes.autoscale_view()
        axes.figure.colorbar(filled, ax=axes, label=label or ("shear strain" if values is None else ""), shrink=0.6)
        return axes

    def save(self, file: Path) -> None:
        """Saves model and state; `scarp.load_analysis` resumes with the same bits. The file is complete when it appears."""
        saved = pickle.dumps(self)
        path = os.fspath(file)
        part = f"{path}.part{os.getpid()}"
        try:
            with open(part, "wb") as stream:
                stream.write(saved)
            os.replace(part, path)
        finally:
            if os.path.exists(part):
                os.unlink(part)

    def __reduce__(self) -> Any:
        return _analysis, (self._recipe, self._settings, self._analysis.bytes())


class _Watch:
    """Observers of a run, their times and a bar."""

    def __init__(self, analysis: Analysis, observers: Union[Observer, Sequence[Observer]], load: float, progress: bool) -> None:
        self._analysis = analysis
        self._watching = [observers] if callable(observers) else list(observers)
        self._seconds = [0.0] * len(self._watching)
        self._bar = _bar(analysis.load, load) if progress else None
        self.observer = self._attempted if self._watching or self._bar is not None else None

    def _attempted(self, step: _points.Step) -> bool:
        stops = False
        for k, observer in enumerate(self._watching):
            started = time.perf_counter()
            stops = bool(observer(self._analysis, step)) or stops
            self._seconds[k] += time.perf_counter() - started
        if self._bar is not None and step.accepted:
            self._bar.update(step.load - self._bar.n)
        return stops

    def warn(self, run: Run) -> None:
        """Names observers that took more time than the run, and more than a second."""
        for observer, spent in zip(self._watching, self._seconds):
            if spent > max(run.seconds, 1.0):
                name = getattr(observer, "__qualname__", type(observer).__name__)
                warnings.warn(f"the observer {name} took {spent:.1f} s (the run itself {run.seconds:.1f} s): let it do less", stacklevel=3)

    def __enter__(self) -> "_Watch":
        return self

    def __exit__(self, *trouble: object) -> None:
        if self._bar is not None:
            self._bar.close()


def _bar(begin: float, end: float) -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm(total=end, initial=begin, unit="load", bar_format="{l_bar}{bar}| {n:.3g}/{total:.3g} [{elapsed}<{remaining}]")


def _analysis(recipe: Tuple[Any, ...], settings: Mapping[str, Any], state: bytes) -> Analysis:
    analysis = Analysis(model_of(*recipe), **settings)
    analysis._analysis.read(state)
    return analysis


def load_analysis(file: Path, **settings: Any) -> Analysis:
    """The analysis of a file of `Analysis.save`. As a pickle, such a file can run programs: load only your own.

    Parameters
    ----------
    file : path
    settings
        Of `Analysis`, such as a tolerance or threads, instead of those that it was saved with.

    Raises
    ------
    ValueError
        For a file that holds something else.
    """
    with open(file, "rb") as stream:
        try:
            found = pickle.load(stream)
        except (pickle.UnpicklingError, EOFError, AttributeError, ImportError, IndexError) as trouble:
            raise ValueError(f"'{os.fspath(file)}' cannot be read ({trouble}): give a file of Analysis.save, and import the class of a material in Python "
                             "where it was when it was saved") from trouble
    if not isinstance(found, Analysis):
        raise ValueError(f"'{os.fspath(file)}' holds {type(found).__name__} (an analysis is expected): give a file of Analysis.save")
    return _analysis(found._recipe, {**found._settings, **settings}, found._analysis.bytes()) if settings else found


def reduce_strength(make_model: Callable[[float], Model], least: float = 1.0, most: float = 3.0, tolerance: float = 0.01, load: float = 1.0, failed: float = 100.0,
                    failing: float = 10.0, **settings: Any) -> SafetyFactor:
    """Strength reduction: the largest factor by which the strengths of a model can be divided so that it carries a load factor.

    The interval between a factor that stands and one that fails is halved until it is within the tolerance. Use small strain: in large strain
    ground may stiffen by its new shape.

    Parameters
    ----------
    make_model : callable
        make_model(factor) returns a `Model` whose strengths, c and tan(phi), are divided by the factor. A larger factor that the initial stress
        does not bear is too large, but no failure. Ground without cohesion gets a little, such as 100 Pa.
    least, most : float
        Factors that are tried first.
    tolerance : float
        Of the factor, relative.
    load : float
        Load factor that is to be carried.
    failed, failing : float
        What counts as failure, see `Analysis.find_collapse`.
    settings
        Of each `Analysis`; by default those that let Mohr-Coulomb's ground flow.

    Returns
    -------
    SafetyFactor
        `stands` 0 where `least` fails, `fails` 0 where `most` stands, no factor was found that fails, or a run is stopped by something else than
        failure.
    """
    usual: Dict[str, Any] = {"tolerance": 1e-4, "max_iterations": 40, "tangent_floor": 1e-4, "largest": 0.05, "max_displacement_gradient": 0.1}
    why = ""
    stands = fails = 0.0
    high = most
    if not 0.0 < least <= most or not 1e-6 <= tolerance <= 1.0:
        raise ValueError(f"factors from {least} to {most} within {tolerance} are requested (0 < least <= most and a tolerance of 1e-6 to 1 are expected): "
                         "correct them")
    factors = [least, most]
    while factors:
        factor = factors.pop(0)
        model = make_model(factor)
        try:
            analysis = Analysis(model, **{**usual, **settings})
        except ValueError as trouble:  # the stress at rest was within the strength at a smaller factor
            if factor == least:
                raise
            why, high = f"factor {factor:.4g}: {trouble}", factor
        else:
            knot = analysis._analysis.next_knot(load)
            if np.isfinite(knot):
                raise ValueError(f"a factor of safety is requested at the load factor {load} (loads change at {knot}): give it a larger load factor")
            end = analysis.find_collapse(load, failed=failed, failing=failing)
            if end.run.status in ("ok", "fluid") and not end.failed:
                stands = factor
            else:
                why = f"factor {factor:.4g}: {end.run.why}"
                fails = factor if end.failed else 0.0
                high = factor
                if not end.failed or factor == least:
                    break
        if not factors and stands > 0.0 and high > stands * (1.0 + tolerance):
            factors = [(stands + high) / 2.0]
    if not why:
        why = f"it stands at the largest factor, {most}: give a larger one, if make_model uses its factor"
    return SafetyFactor(stands, fails, why)
