# SPDX-License-Identifier: BSL-1.0
"""Meshes as arrays: from files of Gmsh, from meshio, of a box, or of one's own."""
from __future__ import annotations

import dataclasses
import os
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _points

Path = Union[str, "os.PathLike[str]"]
_names_in_meshio = {"tri3": "triangle", "tri6": "triangle6", "quad4": "quad", "quad8": "quad8",
                    "tet4": "tetra", "tet10": "tetra10", "hex8": "hexahedron", "hex20": "hexahedron20"}
_facets_in_meshio = {"tri3": "line", "tri6": "line3", "quad4": "line", "quad8": "line3",
                     "tet4": "triangle", "tet10": "triangle6", "hex8": "quad", "hex20": "quad8"}


@dataclasses.dataclass
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
        Sides of elements.
    notes : list of str
        What a file has and the mesh has in another way or not; a sentence each.

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
        self.nodes = np.asarray(self.nodes, dtype=float)
        self.elements = np.asarray(self.elements)
        if self.element_region is None:
            self.element_region = np.zeros(len(self.elements), dtype=np.int32)
        if not isinstance(self.boundaries, Mapping):
            raise TypeError(f"the boundaries are {type(self.boundaries).__name__} (a dictionary of names and facets is expected): give one")
        self.boundaries = {name: np.asarray(facets) for name, facets in self.boundaries.items()}

    @property
    def dim(self) -> int:
        """2 in the plane, 3 in space."""
        return int(_points.dim_of(self.element))

    @property
    def corners(self) -> npt.NDArray[np.int64]:
        """Node numbers of the elements' corners, shape (elements, corners)."""
        numbers = {"tri": 3, "qua": 4, "tet": 4, "hex": 8}[self.element[:3]]
        return np.asarray(self.elements, dtype=np.int64)[:, :numbers]

    @classmethod
    def from_meshio(cls, mesh: Any) -> "Mesh":
        """A mesh of meshio: its elements of the highest dimension; physical groups of Gmsh and cell sets are regions and boundaries.

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
        used, renumbered = np.unique(np.concatenate(elements), return_inverse=True)
        new = np.full(len(mesh.points), -1)
        new[used] = np.arange(len(used))
        return cls(element, np.ascontiguousarray(mesh.points[used, :dims[kind]], dtype=float),
                   renumbered.reshape(-1, np.concatenate(elements).shape[1]), regions, np.concatenate(element_region),
                   {name: new[np.concatenate(facets)] for name, facets in boundaries.items()})

    def to_meshio(self, nodes: Any = None, point_data: Optional[Mapping[str, Any]] = None, cell_data: Optional[Mapping[str, Any]] = None) -> Any:
        """The mesh as meshio has it, perhaps with other positions of the nodes [m] and with fields.

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
