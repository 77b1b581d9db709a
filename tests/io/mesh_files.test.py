# SPDX-License-Identifier: BSL-1.0
"""[slow] Independent readers, VTK and meshio, find in VTU and Gmsh files what tests/io/mesh_samples.cpp wrote there, and Gmsh
files of meshio are read back. Environment: SCARP_TEST_PROGRAMS, the folder of mesh_samples (skipped, exit 77, without, and
without these packages of Python)."""
import csv
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import meshio
    import numpy
    from vtkmodules import vtkCommonDataModel as vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import reference
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "examples"))
from expectations import expect, finish

PROGRAM = pathlib.Path(os.environ.get("SCARP_TEST_PROGRAMS", "nowhere")) / "mesh_samples"
# element: dimension, VTK's cell type, meshio's names of the element and its side
ELEMENTS = {
    "Tri3": (2, vtk.VTK_TRIANGLE, "triangle", "line"),
    "Quad4": (2, vtk.VTK_QUAD, "quad", "line"),
    "Tet4": (3, vtk.VTK_TETRA, "tetra", "triangle"),
    "Hex8": (3, vtk.VTK_HEXAHEDRON, "hexahedron", "quad"),
    "Tri6": (2, vtk.VTK_QUADRATIC_TRIANGLE, "triangle6", "line3"),
    "Quad8": (2, vtk.VTK_QUADRATIC_QUAD, "quad8", "line3"),
    "Tet10": (3, vtk.VTK_QUADRATIC_TETRA, "tetra10", "triangle6"),
    "Hex20": (3, vtk.VTK_QUADRATIC_HEXAHEDRON, "hexahedron20", "quad8"),
}
QUADRATIC = ("Tri6", "Quad8", "Tet10", "Hex20")
REGIONS = ["lower sand", "upper"]
BOUNDARIES = ["ground", "left", "right side"]
FORMATS = ("22_text", "22_binary", "41_text", "41_binary")
VOLUME = {"straight": 2.0, "bent": 2.0 + 0.1 * 2.0 - 0.04 * 8.0 / 3.0}  # analytic: mesh_samples.hpp
ROUND_OFF = 1e-12


def run(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def mapped_lattice(shape, dim):
    """All places where nodes may be: the maps of mesh_samples.hpp."""
    x, y, z = (grid.ravel() for grid in numpy.meshgrid(numpy.arange(9) / 4, numpy.arange(3) / 2, numpy.arange(3) / 2))
    if shape == "bent":
        points = numpy.column_stack([x * (1 + 0.2 * y), y + 0.1 * x * x, z + 0.1 * x * y + 0.05 * y * y])
    else:
        points = numpy.column_stack([x + 0.3 * y, y, z + 0.2 * x])
    points[:, dim:] = 0.0
    return points


class Tables:
    """The CSV files of a mesh, which the other readers are compared with."""

    def __init__(self, folder, dim):
        with open(folder / "nodes.csv", newline="") as file:
            rows = list(csv.reader(file))
        expect(rows[0] == ["node", "x", "y", "z"][:dim + 1], f"{folder}: nodes.csv has the columns {rows[0]}")
        self.points = numpy.zeros((len(rows) - 1, 3))
        self.points[:, :dim] = [[float(cell) for cell in row[1:]] for row in rows[1:]]
        expect([int(row[0]) for row in rows[1:]] == list(range(len(self.points))), f"{folder}: numbers of nodes")
        with open(folder / "elements.csv", newline="") as file:
            rows = list(csv.reader(file))
        nodes = len(rows[0]) - 2
        expect(rows[0] == ["element", "region"] + [f"n{a}" for a in range(nodes)], f"{folder}: columns of elements.csv")
        self.region = [REGIONS.index(row[1]) for row in rows[1:]]
        self.cells = numpy.array([[int(cell) for cell in row[2:]] for row in rows[1:]])
        with open(folder / "boundaries.csv", newline="") as file:
            rows = list(csv.reader(file))[1:]
        self.sides = {name: numpy.array([[int(cell) for cell in row[1:]] for row in rows if row[0] == name])
                      for name in BOUNDARIES}


def integrated_volume(cell, dim):
    """Volume of a cell, and its smallest Jacobian, from VTK's own map of its reference cell. All the maps are polynomials
    of degree 2 or less in one coordinate: central differences and these Gauss points are exact."""
    simplex = cell.GetNumberOfPoints() in ((3, 6) if dim == 2 else (4, 10))
    gauss, weights = numpy.polynomial.legendre.leggauss(4)
    gauss, weights = (gauss + 1) / 2, weights / 2
    step = 0.25
    values = [0.0] * cell.GetNumberOfPoints()

    def place(xi):
        at = [0.0, 0.0, 0.0]
        cell.EvaluateLocation(reference(0), [*xi, 0.0][:3], at, values)
        return numpy.array(at[:dim])

    total, least = 0.0, numpy.inf
    for numbers in itertools.product(range(4), repeat=dim):
        xi, weight = gauss[list(numbers)], numpy.prod(weights[list(numbers)])
        if simplex:  # collapsed cube
            xi, weight = xi.copy(), weight * (1 - xi[0]) ** (dim - 1) * ((1 - xi[1]) if dim == 3 else 1)
            xi[1] *= 1 - xi[0]
            if dim == 3:
                xi[2] *= 1 - xi[0] - xi[1]
        columns = [(place(xi + step * unit) - place(xi - step * unit)) / (2 * step) for unit in numpy.eye(dim)]
        determinant = numpy.linalg.det(numpy.column_stack(columns))
        total, least = total + weight * determinant, min(least, determinant)
    return total, least


def check_vtu_with_vtk(path, what, name, shape, tables):
    dim, cell_type, _, _ = ELEMENTS[name]
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    expect(reader.GetErrorCode() == 0 and grid.GetNumberOfCells() == len(tables.cells), f"{what}: VTK cannot read it")
    points = vtk_to_numpy(grid.GetPoints().GetData())
    expect(numpy.array_equal(points, tables.points), f"{what}: VTK finds other points")
    cells = [[grid.GetCell(e).GetPointId(a) for a in range(grid.GetCell(e).GetNumberOfPoints())]
             for e in range(grid.GetNumberOfCells())]
    expect(numpy.array_equal(cells, tables.cells), f"{what}: VTK finds other cells")
    expect(all(grid.GetCellType(e) == cell_type for e in range(len(cells))), f"{what}: VTK finds other cell types")
    at_nodes, at_cells = grid.GetPointData(), grid.GetCellData()
    expect(numpy.array_equal(vtk_to_numpy(at_nodes.GetArray("height")), points[:, 1]), f"{what}: node field 'height'")
    moves = numpy.outer(points[:, 0], [1e-3, 2e-3, 3e-3 if dim == 3 else 0.0])
    expect(numpy.allclose(vtk_to_numpy(at_nodes.GetArray("displacement")), moves, rtol=1e-15, atol=0),
           f"{what}: node field 'displacement'")
    expect(numpy.array_equal(vtk_to_numpy(at_cells.GetArray("number")), range(len(cells))), f"{what}: field 'number'")
    expect(numpy.array_equal(vtk_to_numpy(at_cells.GetArray("region")), tables.region), f"{what}: field 'region'")
    volumes, jacobians = zip(*(integrated_volume(grid.GetCell(e), dim) for e in range(len(cells))))
    expect(min(jacobians) > 0, f"{what}: VTK's smallest Jacobian is {min(jacobians)}")
    if shape == "straight" or name in QUADRATIC:
        expect(abs(sum(volumes) - VOLUME[shape]) < ROUND_OFF * VOLUME[shape],
               f"{what}: VTK's map gives the volume {sum(volumes)} for {VOLUME[shape]}")
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    sizes = vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Area" if dim == 2 else "Volume"))
    # The filter takes cells apart into straight simplices: exact for straight sides only.
    tolerance = ROUND_OFF if shape == "straight" else 0.05
    expect(min(sizes) > 0 and numpy.allclose(sizes, volumes, rtol=tolerance, atol=0),
           f"{what}: VTK's cell sizes are {sizes}, those of its maps {volumes}")


def check_meshio_cells(mesh, what, name, tables):
    """Cells of the element and of its sides in the physical groups of a Gmsh file, by name."""
    dim, _, cell_name, side_name = ELEMENTS[name]
    expect(numpy.array_equal(mesh.points, tables.points), f"{what}: meshio finds other points")
    expect({block.type for block in mesh.cells} == {cell_name, side_name}, f"{what}: meshio finds other types")
    found = {}
    for block, groups in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        for cell, group in zip(block.data, groups):
            found.setdefault((block.type, int(group)), []).append(tuple(cell))
    tags = {group: (int(tag), int(own)) for group, (tag, own) in mesh.field_data.items()}
    expect(set(tags) == {*REGIONS, *BOUNDARIES}, f"{what}: meshio finds the groups {sorted(tags)}")
    for number, region in enumerate(REGIONS):
        wanted = [tuple(cell) for cell, own in zip(tables.cells, tables.region) if own == number]
        expect(tags[region][1] == dim and found[cell_name, tags[region][0]] == wanted, f"{what}: cells of '{region}'")
    for boundary in BOUNDARIES:
        wanted = [tuple(side) for side in tables.sides[boundary]]
        expect(tags[boundary][1] == dim - 1 and found[side_name, tags[boundary][0]] == wanted,
               f"{what}: sides of '{boundary}'")


def meshio_mesh(name, tables):
    """The mesh as meshio wants it: one block for each entity, each entity with a node."""
    dim, _, cell_name, side_name = ELEMENTS[name]
    region = numpy.array(tables.region)
    blocks = [(cell_name, tables.cells[region == r]) for r in range(len(REGIONS))]
    blocks += [(side_name, tables.sides[boundary]) for boundary in BOUNDARIES]
    dims = [dim] * len(REGIONS) + [dim - 1] * len(BOUNDARIES)
    tags = range(11, 11 + len(blocks))
    groups = [numpy.full(len(cells), tag) for tag, (_, cells) in zip(tags, blocks)]
    owner = numpy.arange(len(tables.points)) % len(blocks)
    return meshio.Mesh(tables.points, blocks, cell_data={"gmsh:physical": groups, "gmsh:geometrical": groups},
                       point_data={"gmsh:dim_tags": numpy.column_stack([numpy.array(dims)[owner], 11 + owner])},
                       field_data={group: numpy.array([tag, own])
                                   for group, tag, own in zip(REGIONS + BOUNDARIES, tags, dims)})


def check_reading(path, what, name, shape, tables, order):
    """order: the elements of the tables as the file has them"""
    code, said, complaint = run("read", path, name)
    expect(code == 0, f"{what}: ended with {code}\n{complaint}")
    if code != 0:
        return
    read = json.loads(said)
    dim = ELEMENTS[name][0]
    expect(numpy.array_equal(read["coordinates"], tables.points[:, :dim]), f"{what}: other nodes are read")
    expect(numpy.array_equal(read["connectivity"], tables.cells[order]), f"{what}: other elements are read")
    held = {region: tables.region.count(number) for number, region in enumerate(REGIONS)}
    expect(list(read["regions"].items()) == list(held.items()), f"{what}: regions {read['regions']}")
    sides = {boundary: len(tables.sides[boundary]) for boundary in BOUNDARIES}
    expect({key: value[0] for key, value in read["boundaries"].items()} == sides, f"{what}: {read['boundaries']}")
    if shape == "straight" or name in QUADRATIC:
        expect(abs(read["volume"] - VOLUME[shape]) < ROUND_OFF * VOLUME[shape], f"{what}: volume {read['volume']}")


def check_sample(folder, name, shape):
    dim, _, cell_name, _ = ELEMENTS[name]
    stem = folder / f"{name}_{shape}"
    tables = Tables(stem, dim)
    distance = numpy.linalg.norm(tables.points[:, None, :] - mapped_lattice(shape, dim)[None, :, :], axis=2).min(axis=1)
    expect(distance.max() < 1e-15, f"{stem.name}: a node is {distance.max()} m from where it should be")
    check_vtu_with_vtk(f"{stem}.vtu", f"{stem.name}.vtu", name, shape, tables)
    mesh = meshio.read(f"{stem}.vtu")
    expect(numpy.array_equal(mesh.points, tables.points) and list(mesh.cells_dict) == [cell_name]
           and numpy.array_equal(mesh.cells_dict[cell_name], tables.cells), f"{stem.name}.vtu: meshio finds another mesh")
    expect(numpy.array_equal(mesh.cell_data["region"][0].ravel(), tables.region), f"{stem.name}.vtu: meshio's 'region'")
    expect(numpy.array_equal(mesh.point_data["height"].ravel(), tables.points[:, 1]), f"{stem.name}.vtu: meshio's 'height'")
    in_order = list(range(len(tables.cells)))
    by_region = sorted(in_order, key=lambda element: tables.region[element])
    for form in FORMATS:
        own = f"{stem}_{form}.msh"
        check_meshio_cells(meshio.read(own), f"{stem.name}_{form}.msh", name, tables)
        check_reading(own, f"{stem.name}_{form}.msh", name, shape, tables, in_order)
        other = folder / "meshio.msh"
        version, encoding = form.split("_")
        meshio.write(other, meshio_mesh(name, tables), file_format="gmsh22" if version == "22" else "gmsh",
                     binary=encoding == "binary", float_fmt=".17g")
        check_reading(other, f"{stem.name}, {form} by meshio", name, shape, tables, by_region)


def check_without_groups(folder):
    """meshio writes no entities and no groups for a mesh that has none: one region."""
    mesh = meshio.Mesh([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [("triangle", [[0, 1, 2], [0, 2, 3]])])
    for form, binary in itertools.product(("gmsh22", "gmsh"), (False, True)):
        meshio.write(folder / "plain.msh", mesh, file_format=form, binary=binary)
        code, said, complaint = run("read", folder / "plain.msh", "Tri3")
        expect(code == 0 and json.loads(said)["regions"] == {"mesh": 2}, f"no groups, {form}: {said}{complaint}")


def check_complaints(folder):
    code, _, said = run("read", folder / "Tri3_bent_22_text.msh", "Quad4")
    expect(code == 1 and "read it as Tri3" in said, f"triangles as Quad4: ended with {code}, {said}")
    code, _, said = run("read", folder / "Tri3_bent.vtu", "Tri3")
    expect(code == 1 and "Tri3_bent.vtu" in said, f"a VTU file as Gmsh's: ended with {code}, {said}")


if not PROGRAM.exists():
    print(f"skipped: no program {PROGRAM}")
    sys.exit(77)
with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    code, _, said = run("write", scratch)
    expect(code == 0, f"mesh_samples write ended with {code}\n{said}")
    for name, shape in itertools.product(ELEMENTS, VOLUME):
        check_sample(scratch, name, shape)
    check_without_groups(scratch)
    check_complaints(scratch)
finish()
