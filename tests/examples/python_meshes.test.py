# SPDX-License-Identifier: BSL-1.0
"""Meshes in Python: nodes in the middle of sides, outlines and boundaries by place, drawings, what meshio has and a mesh has not, and wrong arrays.
Environment: SCARP_EXAMPLES, beside whose folder the module is (skipped, exit 77, without)."""
import sys

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish, leave_out, python_module, rejected

module = python_module()
import numpy as np
import scarp

quadratic = {"tri3": "tri6", "quad4": "quad8", "tet4": "tet10", "hex8": "hex20"}
young, poisson = 20e6, 0.3


def box(element, **rest):
    return scarp.box_mesh(element, *([2.0, 1.0], [4, 3]) if element in ("tri3", "quad4", "tri6", "quad8") else ([2.0, 1.5, 1.0], [3, 2, 2]), **rest)


def places(mesh, numbers):
    """Positions of rows of nodes, each row in its order, the rows sorted: what does not depend on the numbering of nodes."""
    return np.array(sorted(np.round(mesh.nodes[row], 9).ravel().tolist() for row in numbers))


def unique_facets(facets):
    return sorted(tuple(sorted(row)) for row in np.asarray(facets).tolist())


for linear, name in quadratic.items():
    # The generator of C++ has the same elements, node by node, and the same facets up to the node that they start from.
    mesh, other = box(linear).quadratic(), box(name)
    expect((mesh.element, len(mesh.nodes)) == (name, len(other.nodes)), f"{mesh} is not {other}")
    expect(np.allclose(places(mesh, mesh.elements), places(other, other.elements), rtol=0.0, atol=1e-9), f"{name}: other nodes of elements")
    expect(list(mesh.boundaries) == list(other.boundaries), f"{name}: {list(mesh.boundaries)}")
    for side in other.boundaries:
        expect(np.allclose(places(mesh, mesh.boundaries[side]), places(other, other.boundaries[side]), rtol=0.0, atol=1e-9), f"{name}: other facets of {side}")
    rejected(ValueError, f"the mesh has {name}", mesh.quadratic)

    # All sides of a box are its outline, which runs in the sense of the outward normal: the volume by Gauss's theorem is that of the box.
    for one in (box(linear), mesh, other):
        expect(unique_facets(one.outline()) == unique_facets(np.vstack(list(one.boundaries.values()))), f"{one}: its outline is not its sides")
        corners = one.nodes[one.outline()[:, :(2 if one.dim == 2 else 3 if linear == "tet4" else 4)]] + 1.0  # no side holds the origin
        if one.dim == 2:
            volume = (corners[:, 0, 0] * corners[:, 1, 1] - corners[:, 1, 0] * corners[:, 0, 1]).sum() / 2.0
        else:
            triangles = [corners[:, [0, k, k + 1]] for k in range(1, corners.shape[1] - 1)]
            volume = sum(np.linalg.det(triangle).sum() for triangle in triangles) / 6.0
        expect(abs(volume / np.prod(np.ptp(one.nodes, axis=0)) - 1.0) < 1e-12, f"{one}: the outline holds {volume} m^{one.dim}")
    other.boundaries.clear()
    other.name_boundary("all", lambda x: np.full(len(x), True))
    scarp.Model(other)  # rejects facets whose nodes are in another order than their element's

    # Patch test: a displacement that is linear in the position is exact in elements of any shape, to round-off and the residual of a load step.
    corners = box(linear)
    inner = np.setdiff1d(np.arange(len(corners.nodes)), np.concatenate([facets.ravel() for facets in corners.boundaries.values()]))
    corners.nodes[inner] += 0.08 * np.random.default_rng(1).uniform(-1.0, 1.0, (len(inner), corners.dim))
    expect(len(inner) > 0, f"{linear}: the patch has no inner node")
    del corners.boundaries["top"]
    corners.name_boundary("lid", lambda x: np.isclose(x[:, -1], 1.0))
    mesh = corners.quadratic()
    dim = mesh.dim
    lid = mesh.boundaries["lid"]
    expect(np.allclose(mesh.nodes[lid][:, :, -1], 1.0) and unique_facets(lid) == unique_facets(
        [row for row in mesh.outline() if np.allclose(mesh.nodes[row][:, -1], 1.0)]), f"{name}: the lid has other facets")
    model = scarp.Model(mesh, kinematics="small_strain")
    model.fix("left", axis=0)
    if dim == 3:
        model.fix("front", axis=1)
    model.fix("bottom", axis=dim - 1)
    model.surcharge("lid", 1e4)
    model.material(mesh.regions[0], scarp.linear_elastic(young=young, poisson=poisson, dim=dim))
    analysis = scarp.Analysis(model, tolerance=1e-10)
    analysis.to(1.0)
    # One principal stress; in the plane the strain along the third axis is zero.
    lateral, vertical = ((1.0 + poisson) * poisson / young, (1.0 - poisson**2) / young) if dim == 2 else (poisson / young, 1.0 / young)
    expected = mesh.nodes * (1e4 * np.array([lateral] * (dim - 1) + [-vertical]))
    positions = np.hstack([mesh.nodes, np.ones((len(mesh.nodes), 1))])
    fitted = positions @ np.linalg.lstsq(positions, analysis.displacements, rcond=None)[0]
    bent = np.abs(analysis.displacements - fitted).max() / np.abs(expected).max()
    expect(bent < 1e-10, f"{name}: the displacement is linear in the position to {bent}")
    # The strain of a load step is logarithmic, which differs from the linear one by half of it: at most a tenth of 5e-4 in a step.
    apart = np.abs(analysis.displacements - expected).max() / np.abs(expected).max()
    expect(apart < 2.5e-5, f"{name}: the closed form is met to {apart}")
    expect(abs(analysis.stresses[:, dim - 1] / -1e4 - 1.0).max() < 1e-8, f"{name}: stresses {analysis.stresses[:, dim - 1]}")
    area = 2.0 * (1.5 if dim == 3 else 1.0)
    for side, sign in (("bottom", 1.0), ("lid", 0.0)):
        reaction = analysis.reaction(side)[-1]
        expect(abs(reaction / (1e4 * area) - sign) < 1e-9, f"{name}: {side} carries {reaction} N")

# Regions and notes are those of the corners' mesh, which keeps its own arrays; a quadrilateral's facet may start from any corner.
two = scarp.Mesh("tri3", [[0, 0], [1, 0], [1, 1], [0, 1]], np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint64), ["clay", "sand"], [1, 0], {"top": [[2, 3]]},
                 ["a note"])
six = two.quadratic()
expect(repr(six) == "Mesh(tri6, 9 nodes, 2 elements, regions: clay, sand, boundaries: top)", repr(six))
expect(six.element_region.tolist() == [1, 0] and six.notes == ["a note"] and six.elements.dtype.kind == "i", f"{six.element_region} {six.notes}")
expect(np.allclose(six.nodes[six.boundaries["top"]], [[[1, 1], [0, 1], [0.5, 1]]]), f"{six.boundaries}")
six.nodes[0] = 7.0
six.element_region[0] = 0
six.regions[0] = "silt"
expect(two.nodes[0, 0] == 0.0 and two.element_region[0] == 1 and two.regions[0] == "clay", "both meshes have one array")
turned = box("hex8")
turned.boundaries["top"] = np.roll(turned.boundaries["top"], 1, axis=1)[:, ::-1]
scarp.Model(turned.quadratic())  # rejects facets whose nodes are in another order than their element's
rejected(ValueError, "'top' holds the facet [1, 3]",
        lambda: scarp.Mesh("quad4", [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2, 3]], boundaries={"top": [[2, 3], [1, 3]]}).quadratic())

# Half a strip footing on ground with cohesion alone carries (2 + pi) c by Prandtl. With as many nodes, linear triangles lock and carry more.
carried = {}
for element, cells in (("tri3", [20, 8]), ("tri6", [10, 4])):
    mesh = scarp.box_mesh("tri3", [5.0, 2.0], cells)
    mesh = mesh if element == "tri3" else mesh.quadratic()
    mesh.name_boundary("footing", lambda x: (x[:, 1] > 1.99) & (x[:, 0] < 1.0))
    model = scarp.Model(mesh, kinematics="small_strain")
    model.fix(["left", "right"], axis=0)
    model.fix("bottom")
    model.surcharge("footing", 1e4, amplitude=[(0, 0), (20, 20)])
    model.material("soil", scarp.mohr_coulomb(young=10e6, poisson=0.3, cohesion=1e4))
    analysis = scarp.Analysis(model, tolerance=1e-3, max_iterations=40, tangent_floor=1e-4, largest=0.05, max_displacement_gradient=0.1)
    end = analysis.find_collapse(20.0)
    expect(end.failed and len(mesh.nodes) == 189, f"{element}: {end.run.why}")
    carried[element] = end.load / (2.0 + np.pi)
print(f"Strip footing, limit load over Prandtl's: {carried}")
expect(abs(carried["tri6"] - 1.0) < 0.03 and carried["tri3"] > 1.1, f"limit loads over Prandtl's: {carried}")

# Nodes and triangles alone: a hole has an outline too.
try:
    from scipy.spatial import Delaunay
except ImportError:
    leave_out("scipy is not installed")
else:
    grid = np.stack(np.meshgrid(np.linspace(-1.0, 1.0, 9), np.linspace(-1.0, 1.0, 9)), axis=2).reshape(-1, 2)
    triangles = Delaunay(grid).simplices
    hollow = triangles[np.abs(grid[triangles].mean(axis=1)).max(axis=1) > 0.25]
    used, numbers = np.unique(hollow, return_inverse=True)
    mesh = scarp.Mesh("tri3", grid[used], numbers.reshape(-1, 3))
    mesh.name_boundary("hole", lambda x: np.abs(x).max(axis=1) < 0.3)
    mesh.name_boundary("bottom", lambda x: np.isclose(x[:, 1], -1.0))
    expect(len(mesh.boundaries["hole"]) == 8 and len(mesh.boundaries["bottom"]) == 8 and len(mesh.outline()) == 40, f"{len(mesh.outline())} facets around")
    model = scarp.Model(mesh.quadratic(), kinematics="small_strain")
    model.fix("bottom")
    model.traction("hole", [0.0, -1e3])
    model.material("soil", scarp.linear_elastic(young=young, poisson=poisson))
    analysis = scarp.Analysis(model)
    analysis.to(1.0)
    expect(np.allclose(analysis.reaction("bottom"), [0.0, 2e3], rtol=0.0, atol=1e-2), f"the base carries {analysis.reaction('bottom')} N of 2000 N")

mesh = box("quad4")
rejected(ValueError, "the mesh has a boundary 'left'", lambda: mesh.name_boundary("left", lambda x: x[:, 0] < 1.0))
rejected(ValueError, "x from 0 to 2 m, y from 0 to 1 m", lambda: mesh.name_boundary("far", lambda x: x[:, 0] > 3.0))
for answer in (lambda x: x < 1.0, lambda x: True, lambda x: x[:, 0], lambda x: [True], lambda x: None, lambda x: np.flatnonzero(x[:, 0] < 1.0)):
    rejected(ValueError, "(bool and (14,) are expected)", lambda: mesh.name_boundary("far", answer))
expect(list(mesh.boundaries) == ["bottom", "left", "right", "top"], f"a rejected boundary is there: {list(mesh.boundaries)}")

# What a mesh cannot be is said when it is made.
square = {"element": "quad4", "nodes": [[0, 0], [1, 0], [1, 1], [0, 1]], "elements": [[0, 1, 2, 3]]}
for kind, said, wrong in (
        (ValueError, "there is no element 'quad5'", {"element": "quad5"}),
        (ValueError, "(4, 3) ((n, 2) is expected with quad4)", {"nodes": np.zeros((4, 3))}),
        (ValueError, "(4,) ((n, 2) is expected", {"nodes": [0, 1, 2, 3]}),
        (ValueError, "the nodes are no array of numbers", {"nodes": [[0, 0], [1]]}),
        (ValueError, "the nodes are no array of numbers", {"nodes": object()}),
        (ValueError, "the elements of quad4 have the shape (1, 3) ((n, 4) is expected)", {"elements": [[0, 1, 2]]}),
        (ValueError, "the elements of quad4 have the type float64 (whole numbers of the shape (n, 4)", {"elements": [[0.0, 1.0, 2.0, 3.0]]}),
        (ValueError, "the elements of quad4 have the number 4 in row 0 (the mesh has nodes 0 to 3)", {"elements": [[1, 2, 3, 4]]}),
        (ValueError, "the elements of quad4 have the number -1", {"elements": [[-1, 0, 1, 2]]}),
        (ValueError, "the regions of elements have the shape (2,) ((1,) is expected)", {"element_region": [0, 0]}),
        (ValueError, "the regions of elements have the type float64", {"element_region": [0.0]}),
        (ValueError, "the regions of elements have the number 1 in row 0 (the mesh has 1 regions: soil)", {"element_region": [1]}),
        (ValueError, "(the mesh has 0 regions: )", {"regions": []}),
        (TypeError, "the regions are 'soil' (a list of names", {"regions": "soil"}),
        (TypeError, "the regions are [1] (a list of names", {"regions": [1]}),
        (ValueError, "the facets of the boundary 'top' have the shape (1, 3) ((n, 2) is expected)", {"boundaries": {"top": [[2, 3, 1]]}}),
        (ValueError, "the facets of the boundary 'top' have the number 9", {"boundaries": {"top": [[2, 9]]}}),
        (TypeError, "the boundaries are list", {"boundaries": []})):
    rejected(kind, said, lambda: scarp.Mesh(**{**square, **wrong}))
expect(repr(scarp.Mesh(**square)) == "Mesh(quad4, 4 nodes, 1 elements, regions: soil, boundaries: none)", repr(scarp.Mesh(**square)))

# What meshio has and the mesh has not.
try:
    import meshio
except ImportError:
    leave_out("meshio is not installed")
else:
    flat = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    cells = [("triangle", [[0, 1, 2], [0, 2, 3]]), ("line", [[0, 1], [1, 2], [2, 3]]), ("vertex", [[0], [2]])]
    read = scarp.Mesh.from_meshio(meshio.Mesh(flat, cells))
    expect(read.notes == ["cells vertex are left out (2): the elements are triangle, their facets line",
                          "facets line without a physical group or set are in no boundary (3): name them by name_boundary"], f"{read.notes}")
    read = scarp.Mesh.from_meshio(meshio.Mesh(flat, cells[:2], cell_sets={"bottom": [[], [0]]}, point_sets={"corner": [0]},
                                              field_data={"right": [5, 1]}, cell_data={"gmsh:physical": [np.array([0, 0]), np.array([0, 5, 0])]}))
    expect({name: facets.tolist() for name, facets in read.boundaries.items()} == {"bottom": [[0, 1]], "right": [[1, 2]]}, f"{read.boundaries}")
    expect(len(read.notes) == 2 and "(1): name them" in read.notes[0] and "sets of points are left out (corner)" in read.notes[1], f"{read.notes}")
    whole = meshio.Mesh(flat, cells[:2], cell_sets={"bottom": [[], [0]], "others": [[], [1, 2]]})
    expect(scarp.Mesh.from_meshio(whole).notes == [], f"nothing is lost, but there are {scarp.Mesh.from_meshio(whole).notes}")
    within = scarp.Mesh.from_meshio(meshio.Mesh(flat, cells[:1], cell_sets={"ground": [[0, 1]], "clay": [[1]]}))
    expect((within.regions, within.element_region.tolist()) == (["ground", "clay"], [0, 1]) and "the set clay are in an earlier one" in within.notes[0],
           f"{within.regions} {within.element_region} {within.notes}")
    clockwise = scarp.Mesh.from_meshio(meshio.Mesh(flat, [("triangle", [[0, 2, 1], [0, 2, 3]])]))
    expect(clockwise.elements.tolist() == [[0, 2, 1], [0, 2, 3]], f"elements are turned: {clockwise.elements}")
    slanted = np.column_stack([flat[:, :2], 5.0 * flat[:, 0]])
    rejected(ValueError, "a plane mesh has one z", lambda: scarp.Mesh.from_meshio(meshio.Mesh(slanted, cells)))
    back = scarp.Mesh.from_meshio(box("hex8").quadratic().to_meshio())
    expect((back.element, len(back.elements)) == ("hex20", 12), f"{back}")

# Drawings have a polygon to each element and a line to each facet.
try:
    import matplotlib
except ImportError:
    leave_out("matplotlib is not installed")
else:
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    for mesh in (two, two.quadratic()):
        axes = mesh.plot(plt.subplots()[1])
        sizes = [len(drawn.get_paths()) for drawn in axes.collections]
        expect(sizes == [1, 1, 1], f"{mesh}: {sizes} polygons and lines")
        expect([entry.get_text() for entry in axes.get_legend().get_texts()] == ["clay", "sand", "top"], f"{mesh}: other names in the legend")
        line = axes.collections[2].get_paths()[0].vertices[:, 0]
        expect((np.diff(line) < 0.0).all(), f"{mesh}: the top is drawn through x = {line}")
        outline = axes.collections[0].get_paths()[0].vertices
        expect(np.allclose(outline[:len(outline) - 1:len(outline) // 3], [[0, 0], [1, 1], [0, 1]]), f"{mesh}: clay is drawn as {outline}")
    scarp.Mesh(**{**square, "regions": ["soil", "empty"]}).plot()
    rejected(ValueError, "plot draws plane meshes", box("tet4").plot)
finish()
