# SPDX-License-Identifier: BSL-1.0
"""Meshes as arrays: from files of Gmsh, from meshio, of a box, or of one's own."""
from __future__ import annotations

import dataclasses
import os
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _points

Path = Union[str, "os.PathLike[str]"]
_names_in_meshio = {"tri3": "triangle", "tri6": "triangle6", "quad4": "quad", "quad8": "quad8",
                    "tet4": "tetra", "tet10": "tetra10", "hex8": "hexahedron", "hex20": "hexahedron20"}
_facets_in_meshio = {"tri3": "line", "tri6": "line3", "quad4": "line", "quad8": "line3",
                     "tet4": "triangle", "tet10": "triangle6", "hex8": "quad", "hex20": "quad8"}
Ints = npt.NDArray[np.int64]


class _Shape(NamedTuple):
    """An element's corners as its edges and sides have them, the sides in the sense of the outward normal."""

    corners: int
    quadratic: str
    edges: Tuple[Tuple[int, int], ...]
    sides: Tuple[Tuple[int, ...], ...]


_shapes = {
    "tri3": _Shape(3, "tri6", ((0, 1), (1, 2), (2, 0)), ((0, 1), (1, 2), (2, 0))),
    "quad4": _Shape(4, "quad8", ((0, 1), (1, 2), (2, 3), (3, 0)), ((0, 1), (1, 2), (2, 3), (3, 0))),
    "tet4": _Shape(4, "tet10", ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)), ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))),
    "hex8": _Shape(8, "hex20", ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
                   ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)))}
_linear = {shape.quadratic: element for element, shape in _shapes.items()}


def _pairs(facets: Ints) -> Ints:
    """Neighbours among the corners of facets in turn, shape (f, 1, 2) of lines, and (f, corners, 2) of others."""
    pairs: Ints = np.stack([facets, np.roll(facets, -1, axis=1)], axis=2)
    return pairs[:, :1] if facets.shape[1] == 2 else pairs


def require_unmasked(values: Any, what: str) -> None:
    """
    Raises
    ------
    ValueError
        For masked numbers.
    """
    rows = values if isinstance(values, (list, tuple)) else [values]
    if any(isinstance(row, np.ma.MaskedArray) and bool(np.any(row.mask)) for row in rows):
        raise ValueError(f"{what} are masked (a mask would be lost): fill the masked numbers")


def _numbers(values: Any, what: str, shape: Tuple[int, ...], bound: int, bounded: str) -> npt.NDArray[Any]:
    """The values as an array of integers from 0 to bound - 1; a length of -1 in the shape is any."""
    require_unmasked(values, what)
    found = np.asarray(values)
    asked = "(" + ", ".join("n" if length < 0 else str(length) for length in shape) + (",)" if len(shape) == 1 else ")")
    if found.dtype.kind not in "iu":
        raise ValueError(f"{what} have the type {found.dtype} (whole numbers of the shape {asked} are expected): give numbers from 0")
    if found.ndim != len(shape) or any(0 <= length != size for length, size in zip(shape, found.shape)):
        raise ValueError(f"{what} have the shape {found.shape} ({asked} is expected): give a row to each")
    if found.size and not 0 <= found.min() <= found.max() < bound:
        wrong = np.argwhere((found < 0) | (found >= bound))[0]
        raise ValueError(f"{what} have the number {found[tuple(wrong)]} in row {wrong[0]} (the mesh has {bounded}): check the numbering")
    return found


def plane_axes(axes: Any, width: float, height: float) -> Any:
    """The axes, by default new ones of this size [inches], for positions in metres."""
    import matplotlib.pyplot as plt

    axes = plt.subplots(figsize=(width, height))[1] if axes is None else axes
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
    return axes


def _require_name(name: Any) -> None:
    if not isinstance(name, str):
        raise TypeError(f"a boundary is named {name!r} (a text is expected): give it one")


@dataclasses.dataclass(eq=False)
class Mesh:
    """Nodes, elements of one kind, the regions that they belong to, and named boundaries.

    Attributes
    ----------
    element : str
        "tri3", "tri6", "quad4", "quad8", "tet4", "tet10", "hex8" or "hex20".
    nodes : array of float, shape (n, dim)
        Positions [m].
    elements : array of int, shape (m, nodes of an element)
        Node numbers from 0, in the order of VTK and meshio.
    regions : list of str
        Names; one region "soil" where none is given.
    element_region : array of int, shape (m,)
        Number of each element's region among `regions`.
    boundaries : dict of str to array of int, shape (f, nodes of a facet)
        Sides of elements: corners in turn, then the nodes between them.
    notes : list of str
        What a file has and the mesh has in another way or not; a sentence each.

    Raises
    ------
    ValueError
        For an unknown element, arrays of other shapes or types, and numbers of nodes and regions that the mesh has not. Elements without volume and
        facets that are no sides are rejected by `Model`.

    Examples
    --------
    >>> square = Mesh("quad4", [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2, 3]], boundaries={"bottom": [[0, 1]]})
    >>> square.dim
    2
    """

    element: str
    nodes: Any
    elements: Any
    regions: List[str] = dataclasses.field(default_factory=lambda: ["soil"])
    element_region: Any = None
    boundaries: Dict[str, Any] = dataclasses.field(default_factory=dict)
    notes: List[str] = dataclasses.field(default_factory=list)

    def __post_init__(self) -> None:
        dim = self.dim
        require_unmasked(self.nodes, "the nodes")
        try:
            self.nodes = np.asarray(self.nodes, dtype=float)
        except (TypeError, ValueError) as trouble:
            raise ValueError(f"the nodes are no array of numbers ({trouble}; shape (n, {dim}) is expected): give a position [m] to each") from trouble
        if self.nodes.ndim != 2 or self.nodes.shape[1] != dim:
            raise ValueError(f"the nodes have the shape {self.nodes.shape} ((n, {dim}) is expected with {self.element}): give a position [m] to each")
        if isinstance(self.regions, str) or not all(isinstance(name, str) for name in self.regions):
            raise TypeError(f"the regions are {self.regions!r} (a list of names is expected): give one")
        self.regions = list(self.regions)
        shape, nodes = self._shape, f"nodes 0 to {len(self.nodes) - 1}"
        between = self.element in _linear
        self.elements = _numbers(self.elements, f"the elements of {self.element}", (-1, shape.corners + between * len(shape.edges)), len(self.nodes), nodes)
        if self.element_region is None:
            self.element_region = np.zeros(len(self.elements), dtype=np.int32)
        self.element_region = _numbers(self.element_region, "the regions of elements", (len(self.elements),), len(self.regions),
                                       f"{len(self.regions)} regions: {', '.join(self.regions)}")
        if not isinstance(self.boundaries, Mapping):
            raise TypeError(f"the boundaries are {type(self.boundaries).__name__} (a dictionary of names and facets is expected): give one")
        for name in self.boundaries:
            _require_name(name)
        facet = len(shape.sides[0])
        facet += between * (facet if facet > 2 else 1)
        self.boundaries = {name: _numbers(facets, f"the facets of the boundary '{name}'", (-1, facet), len(self.nodes), nodes)
                           for name, facets in self.boundaries.items()}

    def __repr__(self) -> str:
        return (f"Mesh({self.element}, {len(self.nodes)} nodes, {len(self.elements)} elements, regions: {', '.join(self.regions)}, "
                f"boundaries: {', '.join(map(str, self.boundaries)) or 'none'})")

    @property
    def _shape(self) -> _Shape:
        return _shapes[_linear.get(self.element, self.element)]

    @property
    def dim(self) -> int:
        """2 in the plane, 3 in space."""
        return int(_points.dim_of(self.element))

    @property
    def corners(self) -> npt.NDArray[np.int64]:
        """Node numbers of the elements' corners, shape (elements, corners)."""
        return np.asarray(self.elements, dtype=np.int64)[:, :self._shape.corners]

    def quadratic(self) -> "Mesh":
        """The mesh with nodes in the middle of its sides too: tri3 becomes tri6, quad4 quad8, tet4 tet10 and hex8 hex20.

        Linear triangles and tetrahedra lock in plastic ground, which flows at nearly constant volume: they carry too much (Nagtegaal et
        al., 1974, doi:10.1016/0045-7825(74)90032-2). A strip footing on 189 nodes carries 12 % more than Prandtl's limit load with tri3, 2 % more with
        tri6 (tests/examples/python_meshes.test.py). Take quadratic elements for soil that yields.

        Corners keep their numbers, edges stay straight, regions and boundaries keep their names.

        Returns
        -------
        Mesh

        Raises
        ------
        ValueError
            For a mesh that is quadratic already, and for a facet of a boundary that is no side of an element.

        Examples
        --------
        >>> Mesh("tri3", [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]], boundaries={"top": [[2, 3]]}).quadratic()
        Mesh(tri6, 9 nodes, 2 elements, regions: soil, boundaries: top)
        """
        if self.element in _linear:
            raise ValueError(f"the mesh has {self.element} (elements without nodes between corners are expected, {', '.join(_shapes)}): use it as it is")
        elements, count = self.corners, len(self.nodes)

        def keys(pairs: Ints) -> Ints:
            return np.asarray(pairs.min(axis=-1) * count + pairs.max(axis=-1), dtype=np.int64)

        edges, numbers = np.unique(keys(elements[:, np.asarray(self._shape.edges)]), return_inverse=True)
        boundaries = {}
        for name, given in self.boundaries.items():
            facets = np.asarray(given, dtype=np.int64)
            sought = keys(_pairs(facets))
            found = np.searchsorted(edges, sought)
            strays = ~np.isin(sought, edges).all(axis=1)
            if strays.any():
                raise ValueError(f"boundary '{name}' holds the facet {facets[strays][0].tolist()} (no element has this side): check its node numbers")
            boundaries[name] = np.hstack([facets, count + found])
        middles = (self.nodes[edges // count] + self.nodes[edges % count]) / 2.0
        return Mesh(self._shape.quadratic, np.vstack([self.nodes, middles]), np.hstack([elements, count + numbers.reshape(-1, len(self._shape.edges))]),
                    list(self.regions), np.array(self.element_region), boundaries, list(self.notes))

    def outline(self) -> Ints:
        """The facets that belong to one element only, shape (f, nodes of a facet), in the sense of the outward normal.

        Returns
        -------
        array of int

        Examples
        --------
        >>> Mesh("tri3", [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]]).outline().tolist()
        [[0, 1], [1, 2], [2, 3], [3, 0]]
        """
        sides = np.asarray(self._shape.sides)
        own = sides
        if self.element in _linear:
            between = {frozenset(edge): self._shape.corners + k for k, edge in enumerate(self._shape.edges)}
            own = np.hstack([sides, [[between[frozenset(pair)] for pair in pairs] for pairs in _pairs(sides).tolist()]])
        corners = np.sort(self.corners[:, sides].reshape(-1, sides.shape[1]), axis=1)
        _, numbers, counts = np.unique(corners, axis=0, return_inverse=True, return_counts=True)
        facets = np.asarray(self.elements, dtype=np.int64)[:, own].reshape(-1, own.shape[1])
        outer: Ints = facets[counts[numbers.reshape(-1)] == 1]
        return outer

    def name_boundary(self, name: str, where: Callable[[npt.NDArray[np.float64]], npt.ArrayLike]) -> None:
        """Adds a boundary: those facets of the outline whose middles are where they are asked for.

        Meshes of nodes and elements alone, such as `scipy.spatial.Delaunay`'s, get their boundaries by this.

        Parameters
        ----------
        name : str
        where : callable
            where(x) gets the middles of all facets [m], means of their nodes, shape (f, dim), and returns a mask, shape (f,). Compare with a
            tolerance, as by `np.isclose`.

        Raises
        ------
        ValueError
            For a name that is there, a mask of another shape or type, and one that has no facet.

        Examples
        --------
        >>> mesh = Mesh("tri3", [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.name_boundary("top", lambda x: x[:, 1] > 0.99)
        >>> mesh.boundaries["top"].tolist()
        [[2, 3]]
        """
        if name in self.boundaries:
            raise ValueError(f"the mesh has a boundary '{name}' (there are {', '.join(map(str, self.boundaries))}): take another name, or remove that one")
        facets = self.outline()
        middles = self.nodes[facets].mean(axis=1)
        mask = np.asarray(where(middles))
        if mask.dtype != bool or mask.shape != (len(facets),):
            raise ValueError(f"the mask of boundary '{name}' has the type {mask.dtype} and the shape {mask.shape} (bool and ({len(facets)},) are expected): "
                             "return one truth value to each middle")
        if not mask.any():
            reach = ", ".join(f"{axis} from {low:.6g} to {high:.6g} m" for axis, low, high in zip("xyz", middles.min(axis=0), middles.max(axis=0)))
            raise ValueError(f"boundary '{name}' has no facet (the outline's middles have {reach}): choose some of them, with a tolerance")
        _require_name(name)
        self.boundaries[name] = facets[mask]

    def plot(self, axes: Any = None) -> Any:
        """Draws a plane mesh: elements by region in pale colours, boundaries as lines with their names.

        Parameters
        ----------
        axes : matplotlib.axes.Axes
            By default new ones.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ValueError
            For a mesh in space.

        Examples
        --------
        >>> import matplotlib
        >>> matplotlib.use("Agg")
        >>> [entry.get_text() for entry in box_mesh("tri6", [2.0, 1.0], [4, 2]).plot().get_legend().get_texts()]
        ['soil', 'bottom', 'left', 'right', 'top']
        """
        if self.dim != 2:
            raise ValueError("plot draws plane meshes (this one is in space): write a file for ParaView, mesh.to_meshio().write(\"mesh.vtu\")")
        import matplotlib.pyplot as plt
        from matplotlib.collections import LineCollection, PolyCollection

        axes = plane_axes(axes, 8.0, 4.0)
        around = self.corners
        if self.element in _linear:
            around = np.stack([around, self.elements[:, self._shape.corners:]], axis=2).reshape(len(self.elements), -1)
        for k, region in enumerate(self.regions):
            axes.add_collection(PolyCollection(self.nodes[around[self.element_region == k]], facecolors=plt.get_cmap("Pastel2")(k % 8), edgecolors="#8a8172",
                                               linewidths=0.4, label=region))
        for k, (name, facets) in enumerate(self.boundaries.items()):
            lines = self.nodes[np.asarray(facets)[:, [0, 2, 1] if self.element in _linear else [0, 1]]]
            axes.add_collection(LineCollection(lines, colors=plt.get_cmap("tab10")(k % 10), linewidths=2.0, label=name))
        axes.autoscale_view()
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
        return axes

    @classmethod
    def from_meshio(cls, mesh: Any) -> "Mesh":
        """A mesh of meshio: its elements of the highest dimension; physical groups of Gmsh and cell sets are regions and boundaries.

        What has no name, or is of another kind, is left out with a sentence in `notes`; `name_boundary` makes boundaries of the outline.

        Parameters
        ----------
        mesh : meshio.Mesh
            With elements of one kind in its highest dimension.

        Raises
        ------
        ValueError
            For elements of several kinds, and of none that scarp has.

        Examples
        --------
        >>> import meshio
        >>> Mesh.from_meshio(meshio.Mesh([[0, 0], [1, 0], [0, 1]], [("triangle", [[0, 1, 2]])])).element
        'tri3'
        """
        known = {name: element for element, name in _names_in_meshio.items()}
        kinds = {block.type for block in mesh.cells if block.type in known}
        dims = {kind: int(_points.dim_of(known[kind])) for kind in kinds}
        kinds = {kind for kind in kinds if dims[kind] == max(dims.values())}
        if len(kinds) != 1:
            found = ", ".join(sorted({block.type for block in mesh.cells})) or "nothing"
            raise ValueError(f"the mesh has {found} (elements of one kind are expected, {', '.join(known)}): mesh it with one kind")
        kind = kinds.pop()
        element = known[kind]
        elements = []
        element_region: List[Any] = []
        names = {(int(tag), int(dim)): name for name, (tag, dim) in mesh.field_data.items()}
        groups = set(names.values()) if "gmsh:physical" in mesh.cell_data else set()  # meshio has them as sets again
        regions: List[str] = []

        def number(name: str) -> int:
            if name not in regions:
                regions.append(name)
            return regions.index(name)

        boundaries: Dict[str, List[Any]] = {}
        nameless = 0
        others: Dict[str, int] = {}
        shared: Dict[str, int] = {}
        physical = mesh.cell_data.get("gmsh:physical")
        for k, block in enumerate(mesh.cells):
            in_sets = {name: np.asarray(numbers[k], dtype=int) for name, numbers in mesh.cell_sets.items()
                       if not name.startswith("gmsh:") and name not in groups and numbers[k] is not None and len(numbers[k])}
            tags = physical[k] if physical is not None else np.zeros(len(block.data), dtype=int)
            if block.type == kind:
                of_block = np.full(len(block.data), -1)
                for tag in np.unique(tags[tags > 0]):
                    of_block[tags == tag] = number(names.get((int(tag), dims[kind]), f"physical_{tag}"))
                for name, chosen in in_sets.items():
                    shared[name] = shared.get(name, 0) + np.count_nonzero(of_block[chosen] >= 0)
                    of_block[chosen] = number(name)
                if (of_block < 0).any():
                    of_block[of_block < 0] = number("mesh" if regions else "soil")
                elements.append(block.data)
                element_region.append(of_block)
            elif block.type == _facets_in_meshio[element]:
                for tag in np.unique(tags[tags > 0]):
                    boundaries.setdefault(names.get((int(tag), dims[kind] - 1), f"physical_{tag}"), []).append(block.data[tags == tag])
                for name, chosen in in_sets.items():
                    boundaries.setdefault(name, []).append(block.data[chosen])
                nameless += np.count_nonzero(np.isin(np.flatnonzero(tags <= 0), np.concatenate([[], *in_sets.values()]), invert=True))
            else:
                others[block.type] = others.get(block.type, 0) + len(block.data)
        notes = [f"cells {other} are left out ({count}): the elements are {kind}, their facets {_facets_in_meshio[element]}" for other, count in others.items()]
        notes += [f"elements of the set {name} are in an earlier one or a physical group too ({count}): they belong to {name}"
                  for name, count in shared.items() if count > 0]
        if nameless > 0:
            notes.append(f"facets {_facets_in_meshio[element]} without a physical group or set are in no boundary ({nameless}): name them by name_boundary")
        if mesh.point_sets:
            notes.append(f"sets of points are left out ({', '.join(mesh.point_sets)}): boundaries are of facets, name them by name_boundary")
        used, renumbered = np.unique(np.concatenate(elements), return_inverse=True)
        spans = np.ptp(np.asarray(mesh.points, dtype=float)[used], axis=0)
        if (spans[dims[kind]:] > 1e-9 * spans.max()).any():
            raise ValueError(f"the nodes of {kind} elements have z from {mesh.points[used, 2].min()} to {mesh.points[used, 2].max()} (a plane mesh has one z): "
                             "turn it into the xy plane")
        new = np.full(len(mesh.points), -1)
        new[used] = np.arange(len(used))
        return cls(element, np.ascontiguousarray(mesh.points[used, :dims[kind]], dtype=float),
                   renumbered.reshape(-1, np.concatenate(elements).shape[1]), regions, np.concatenate(element_region),
                   {name: new[np.concatenate(facets)] for name, facets in boundaries.items()}, notes)

    def to_meshio(self, nodes: Any = None, point_data: Optional[Mapping[str, Any]] = None, cell_data: Optional[Mapping[str, Any]] = None) -> Any:
        """Nodes and elements as meshio has them, perhaps with other positions [m] and with fields; regions and boundaries stay behind.

        Examples
        --------
        >>> box_mesh("tri3", [1, 1], [2, 2]).to_meshio().cells[0].type
        'triangle'
        """
        import meshio

        places = np.asarray(self.nodes if nodes is None else nodes)
        flat = np.zeros((len(places), 3))
        flat[:, :self.dim] = places
        return meshio.Mesh(flat, [(_names_in_meshio[self.element], self.elements)], point_data=dict(point_data or {}),
                           cell_data={name: [np.asarray(values)] for name, values in (cell_data or {}).items()})


def _mesh(arrays: Sequence[Any]) -> Mesh:
    element, nodes, elements, element_region, regions, boundaries, notes = arrays
    return Mesh(element, nodes, elements, regions, element_region, boundaries, notes)


def read_gmsh(file: Path, element: str = "", highest_order: int = 2) -> Mesh:
    """The mesh of a file of Gmsh (MSH 2 to 4.1, text or binary). Physical groups become regions and boundaries.

    Parameters
    ----------
    file : path
    element : str
        Kind of the elements, by default the file's own.
    highest_order : int
        1 leaves out all nodes but corners.

    Raises
    ------
    ValueError
        For what is no such mesh, naming file and line or element.
    """
    return _mesh(_points.read_gmsh(file, element, highest_order))


def box_mesh(element: str, lengths: Sequence[float], cells: Sequence[int]) -> Mesh:
    """A rectangle or box from the origin: region "soil", boundaries "left" and "right" along x, "bottom" and "top" along the last axis, "front" and
    "back" along y in space.

    Parameters
    ----------
    element : str
        Kind of the elements.
    lengths : sequence of float
        Along each axis [m].
    cells : sequence of int
        Number along each axis.

    Examples
    --------
    >>> box_mesh("quad8", [2.0, 1.0], [4, 2]).elements.shape
    (8, 8)
    """
    return _mesh(_points.box_mesh(element, [float(length) for length in lengths], list(cells)))
