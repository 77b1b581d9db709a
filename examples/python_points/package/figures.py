# SPDX-License-Identifier: BSL-1.0
"""Drawings by matplotlib: packings, and problems that move."""
from __future__ import annotations

from typing import Any, Callable, List, Mapping, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _points
from .meshes import plane_axes
from .model import Floats
from .problem import Analysis


def plot_packing(picture: Optional[Mapping[str, npt.NDArray[np.float64]]], axes: Any = None) -> Any:
    """Draws a plane packing: its grains, its cell, and its contacts as lines whose width is their normal force.

    Parameters
    ----------
    picture : dict
        Of `Analysis.picture` or `MaterialPoints.picture`.
    axes : matplotlib.axes.Axes
        By default new ones.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        For a point without a packing.

    Examples
    --------
    >>> import matplotlib, scarp
    >>> matplotlib.use("Agg")
    >>> points = scarp.MaterialPoints(scarp.discs(grains=40), [[0.0, 0.0]])
    >>> len(plot_packing(points.picture(0)).collections)
    3
    """
    if picture is None:
        raise ValueError("the point has no packing to be drawn (its material is another one): take a point of a packing")
    from matplotlib.collections import EllipseCollection, LineCollection

    axes = plane_axes(axes, 5.0, 5.0)
    grains, contacts, cell = picture["grains"], picture["contacts"], picture["cell"]
    angle = np.degrees(np.arctan2(grains[:, 5], grains[:, 4]))
    axes.add_collection(EllipseCollection(2.0 * grains[:, 2], 2.0 * grains[:, 3], angle, units="xy", offsets=grains[:, :2], offset_transform=axes.transData,
                                          facecolors="#d9d2c5", edgecolors="#8a8172", linewidths=0.4))
    force = contacts[:, 6] / max(float(contacts[:, 6].mean()), 1e-300) if len(contacts) else contacts[:, 6]
    ends = np.stack([contacts[:, :2], contacts[:, :2] + contacts[:, 2:4]], axis=1)
    axes.add_collection(LineCollection(ends, linewidths=force, colors="#1f3d6b", capstyle="round"))
    corner = grains[:, :2].mean(axis=0) - cell.sum(axis=1) / 2.0
    frame = corner + np.array([[0.0, 0.0], cell[:, 0], cell.sum(axis=1), cell[:, 1], [0.0, 0.0]])
    axes.add_collection(LineCollection([frame], colors="#8a8172", linewidths=0.8, linestyles="dashed"))
    axes.autoscale_view()
    return axes


class History:
    """An observer that records displacement and reaction of a boundary at every accepted load step.

    Parameters
    ----------
    side : str
        Name of the boundary.
    axis : int

    Attributes
    ----------
    loads, displacements, reactions : list of float
        Load factors, displacements [m] of the node that has moved farthest, and forces [N] of the boundary's support along the axis.

    Examples
    --------
    >>> import scarp
    >>> model = scarp.Model(scarp.box_mesh("quad4", [2.0, 1.0], [4, 2]))
    >>> model.fix("bottom")
    >>> model.move("top", 1, -0.01)
    >>> model.material("soil", scarp.linear_elastic(young=20e6, poisson=0.3))
    >>> curve = History("top", 1)
    >>> run = scarp.Analysis(model).to(1.0, observers=curve)
    >>> round(curve.displacements[-1], 6), curve.reactions[-1] < 0.0
    (-0.01, True)
    """

    def __init__(self, side: str, axis: int) -> None:
        self._side, self._axis = side, axis
        self.loads: List[float] = []
        self.displacements: List[float] = []
        self.reactions: List[float] = []

    def __call__(self, analysis: Analysis, step: _points.Step) -> None:
        if step.accepted:
            self.loads.append(step.load)
            self.displacements.append(analysis.displacement(self._side, self._axis))
            self.reactions.append(float(analysis.reaction(self._side)[self._axis]))


class Frames:
    """An observer that keeps what is drawn of every accepted load step, for an animation.

    Parameters
    ----------
    values : callable
        values(analysis) gives numbers of the elements, points or nodes; by default their shear strain.
    label : str
        Of the colours.
    at : str
        Of which the numbers are, "elements", "points" or "nodes", where a mesh has as many of two.

    Examples
    --------
    >>> import matplotlib, scarp
    >>> matplotlib.use("Agg")
    >>> model = scarp.Model(scarp.box_mesh("quad4", [2.0, 1.0], [4, 2]))
    >>> model.fix("bottom")
    >>> model.traction("top", [0.0, -1e4])
    >>> model.material("soil", scarp.linear_elastic(young=20e6, poisson=0.3))
    >>> frames = Frames()
    >>> run = scarp.Analysis(model).to(1.0, observers=frames)
    >>> len(frames.steps) == run.steps
    True
    >>> _ = frames.animation().to_jshtml()
    """

    def __init__(self, values: Optional[Callable[[Analysis], npt.ArrayLike]] = None, label: str = "", at: Optional[str] = None) -> None:
        self._values = values or Analysis.shear_strains
        self._at = at if values else "points"
        self._label = label or ("" if values else "shear strain")
        self._analysis: Optional[Analysis] = None
        self.steps: List[Tuple[float, Floats, Floats]] = []

    def __call__(self, analysis: Analysis, step: _points.Step) -> None:
        if not step.accepted:
            return
        shown = np.asarray(self._values(analysis), dtype=float)
        self._analysis = analysis
        self.steps.append((step.load, analysis.positions, analysis._of_elements(shown, self._at)))

    def animation(self, interval: float = 100.0) -> Any:
        """The steps one after the other, each for `interval` [ms]; in a notebook HTML(frames.animation().to_jshtml()).

        Returns
        -------
        matplotlib.animation.FuncAnimation
        """
        if self._analysis is None:
            raise ValueError("no load step was accepted while these frames observed (nothing is to be drawn): give them to Analysis.to")
        from matplotlib.animation import FuncAnimation

        axes = self._analysis.plot(self.steps[-1][2], self._label, at="elements")
        cells = axes.collections[0]
        ends = [float(end) for _, _, values in self.steps for end in (values.min(), values.max())]
        cells.set_clim(min(0.0, *ends), max(0.0, *ends))

        def draw(k: int) -> Tuple[Any, ...]:
            load, positions, values = self.steps[k]
            assert self._analysis is not None
            cells.set_verts(positions[self._analysis.mesh.corners])
            cells.set_array(values)
            return (axes.set_title(f"load factor {load:.3g}"),)

        return FuncAnimation(axes.figure, draw, frames=len(self.steps), interval=interval)
