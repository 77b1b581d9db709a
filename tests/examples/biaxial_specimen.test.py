# SPDX-License-Identifier: BSL-1.0
"""`biaxial_specimen` with Yade's packing (tests/reference/yade) on the smallest mesh of every element that is built: they all
agree with one another and with the packing alone, dry and full of water, whatever the number of threads; bad input gets a
message and a non-zero exit. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

PROGRAMS = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve()
YADE = pathlib.Path(__file__).resolve().parents[1] / "reference" / "yade"
PACKING = ["--particles", str(YADE / "particles.csv"), "--contacts", str(YADE / "contacts.csv")]
COLUMNS = ["step", "axial_strain", "top_force", "mean_sxx", "mean_syy", "mean_sxy", "iterations", "residual"]
CONFINING = 2e5  # [Pa], the packing's own
WIDTH, HEIGHT, THICKNESS = 0.05, 0.1, 0.2  # [m]
RESIDUAL = 1e-3
WATER = "biaxial_specimen_water"
STEPS = 3

# Places in units of width and height; elements by the numbers of their nodes, Gmsh's type first.
CORNERS = [(0, 0), (1, 0), (1, 1), (0, 1)]
MIDDLES = [(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5)]
MESHES = {
    "Tri3": (CORNERS, [(2, 1, 2, 3), (2, 1, 3, 4)]),
    "Tri6": (CORNERS + MIDDLES + [(0.5, 0.5)], [(9, 1, 2, 3, 5, 6, 9), (9, 1, 3, 4, 9, 7, 8)]),
    "Quad4": (CORNERS, [(3, 1, 2, 3, 4)]),
    "Quad8": (CORNERS + MIDDLES, [(16, 1, 2, 3, 4, 5, 6, 7, 8)]),
}


def write_mesh(path, places, elements):
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(places))]
    lines += [f"{k} {x * WIDTH} {y * HEIGHT} 0" for k, (x, y) in enumerate(places, start=1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{k} {kind} 2 0 1 {' '.join(map(str, nodes))}" for k, (kind, *nodes) in enumerate(elements, start=1)]
    path.write_text("\n".join(lines + ["$EndElements", ""]))


def run(program, *arguments, folder):
    done = subprocess.run([PROGRAMS / program, *map(str, arguments)], cwd=folder, capture_output=True, text=True,
                          timeout=300)
    return done.returncode, done.stdout + done.stderr


def compress(folder, name, *more):
    return run("biaxial_specimen", "--mesh", f"{name}.msh", *PACKING, "--steps", STEPS, "--residual", RESIDUAL, "--out",
               "out.csv", *more, folder=folder)


def read(path):
    with open(path, newline="") as file:
        table = csv.DictReader(file)
        return table.fieldnames, [{name: float(cell) for name, cell in row.items()} for row in table]


def check_elements(folder):
    """The packing is everywhere the same and nothing holds the platens back, so that the exact answer is uniform: all
    meshes must find it. Forces may differ by a few residuals, which are relative to the reactions."""
    tables = {}
    for name, mesh in MESHES.items():
        write_mesh(folder / f"{name}.msh", *mesh)
        code, said = compress(folder, name)
        if name in ("Tri6", "Quad4") and code == 2 and "SCARP_BUILD_VERIFICATION" in said:
            continue
        expect(code == 0, f"{name}: ended with {code}\n{said}")
        if code != 0:
            return
        columns, rows = read(folder / "out.csv")
        tables[name] = rows
        expect(columns == COLUMNS and len(rows) == STEPS + 1, f"{name}: {len(rows)} rows of {columns}")
        for k, row in enumerate(rows):
            where = f"{name}, step {k}"
            expect(row["step"] == k and math.isclose(row["axial_strain"], 1e-3 * k), f"{where}: {row}")
            expect(row["residual"] <= RESIDUAL and row["iterations"] >= 1, f"{where}: {row}")
            expect(abs(row["mean_sxx"] + CONFINING) < 3.0 * RESIDUAL * CONFINING, f"{where}: {row}")
            expect(abs(row["mean_sxy"]) < 3.0 * RESIDUAL * CONFINING, f"{where}: {row}")
            expect(row["top_force"] > 0.0, f"{where}: {row}")
            reference = tables["Tri3"][k]["top_force"]
            difference = abs(row["top_force"] - reference)
            expect(difference < 5.0 * RESIDUAL * reference, f"{where}: {row}, Tri3 {reference} N")
        expect(rows[-1]["top_force"] > 1.2 * rows[0]["top_force"], f"{name}: the specimen does not harden: {rows}")
    code, said = run("rve_lab", "replay", *PACKING, "--path", "biaxial", "--strain", -math.log(1.0 - 1e-3 * STEPS),
                     "--strain-step", "1e-5", "--out", "rve.csv", folder=folder)
    expect(code == 0, f"the packing alone: ended with {code}\n{said}")
    if code == 0:
        alone = read(folder / "rve.csv")[1][-1]
        ours = tables["Tri3"][-1]
        # The cell of the path keeps its right angle, the specimen shears until there is no shear stress.
        expect(abs(ours["mean_syy"] - alone["syy"]) < 0.01 * abs(alone["syy"]), f"{ours}, alone {alone}")


def check_ellipses(folder):
    """The laboratory's tables of ellipses, whose contacts carry shear forces already, are at rest here too."""
    code, said = run("rve_lab", "prepare", "--shape", "ellipse", "--grains", 60, "--output", "ellipses", folder=folder)
    expect(code == 0, f"preparation: ended with {code}\n{said}")
    code, said = run("biaxial_specimen", "--mesh", "Quad8.msh", "--particles", "ellipses/packing_particles.csv",
                     "--contacts", "ellipses/packing_contacts.csv", "--steps", 1, "--out", "ellipses.csv",
                     "--fields", "fields", folder=folder)
    expect(code == 0, f"ellipses: ended with {code}\n{said}")
    if code == 0:
        first = read(folder / "ellipses.csv")[1][0]
        expect(abs(first["mean_syy"] + CONFINING) < 3.0 * RESIDUAL * CONFINING, f"ellipses at rest: {first}")
        expect((folder / "fields" / "fields.pvd").read_text().count("<DataSet") == 2, "not two pictures of two rows")


def check_undrained(folder):
    """Packings that are alike everywhere keep their volume, as the packing alone on its undrained path."""
    pore = 1e5
    code, said = run(WATER, "--undrained", "--mesh", "Quad8.msh", *PACKING, "--steps", STEPS, "--residual", RESIDUAL,
                     "--confining", CONFINING + pore, "--pore-pressure", pore, "--out", "undrained.csv", "--fields", "wet", folder=folder)
    expect(code == 0, f"undrained: ended with {code}\n{said}")
    if code != 0:
        return
    columns, rows = read(folder / "undrained.csv")
    expect(columns == [*COLUMNS, "mean_excess_pressure"] and len(rows) == STEPS + 1, f"undrained: {len(rows)} rows of {columns}")
    for row in rows:
        lateral, axial = (row["mean_excess_pressure"] - row[stress] for stress in ("mean_sxx", "mean_syy"))
        expect(abs(lateral - CONFINING) < 3.0 * RESIDUAL * CONFINING, f"total lateral stress: {row}")
        area = WIDTH * THICKNESS / (1.0 - row["axial_strain"])
        expect(abs(row["top_force"] / area - axial - pore) < 3.0 * RESIDUAL * CONFINING, f"force on grains and water: {row}")
    expect("excess_pore_pressure" in (folder / "wet" / "fields" / "step_0000.vtu").read_text(), "pictures lack the pressure")
    code, said = run("rve_lab", "replay", *PACKING, "--path", "undrained", "--strain", -math.log(1.0 - 1e-3 * STEPS),
                     "--strain-step", "1e-5", "--out", "rve.csv", folder=folder)
    expect(code == 0, f"the packing alone, undrained: ended with {code}\n{said}")
    if code == 0:
        alone = read(folder / "rve.csv")[1][-1]
        for ours, theirs in (("mean_sxx", "sxx"), ("mean_syy", "syy")):
            difference = abs(rows[-1][ours] - alone[theirs])
            expect(difference < 0.02 * CONFINING, f"undrained {ours} {rows[-1]}, alone {alone}")


def check_threads(folder):
    tables = []
    for threads in (1, 2):
        code, said = compress(folder, "Quad8", "--threads", threads)
        expect(code == 0, f"{threads} threads: ended with {code}\n{said}")
        tables.append((folder / "out.csv").read_bytes())
    expect(tables[0] == tables[1], "one thread and two give different tables")


def check_exhaustion(folder):
    code, said = compress(folder, "Tri3", "--iterations", 1, "--max-halvings", 0)
    expect(code == 3 and "iterations" in said, f"one iteration: ended with {code}\n{said}")
    expect(len(read(folder / "out.csv")[1]) == 1, "the row at rest is not kept")
    own = ["--columns", 1, "--rows", 1, "--packings", 1, "--grains", 60, "--frames", 1, "--output", "own", "--overwrite"]
    (folder / "own" / "fields").mkdir(parents=True)
    for name in ("fields/step_0099.vtu", "fields/notes.txt"):
        (folder / "own" / name).write_text("old\n")
    code, said = run("biaxial_specimen", *own, "--steps", 30, "--axial-strain-step", 3e-3, "--iterations", 4, "--residual", 1e-5,
                     "--max-halvings", 0, folder=folder)
    expect(code == 3 and "step_too_small" in said, f"four iterations: ended with {code}\n{said}")
    last = read(folder / "own" / "table.csv")[1][-1]["axial_strain"]
    drawn = [float(time) for time in re.findall(r'timestep="([^"]*)"', (folder / "own" / "fields.pvd").read_text())]
    expect(last > 0.0 and math.isclose(drawn[-1], last), f"the last accepted state is at {last}, pictures at {drawn}")
    expect(json.loads((folder / "own" / "run.json").read_text())["state"] == "step_too_small", "run.json does not name the reason")
    left = {path.name for path in (folder / "own" / "fields").iterdir()}
    expect("step_0099.vtu" not in left and "notes.txt" in left, f"pictures of an older test: {left}")


def check_refusals(folder):
    slanting = [(0, 0), (1, 0), (1.1, 1), (0, 1)]
    write_mesh(folder / "slanting.msh", slanting, MESHES["Tri3"][1])
    write_mesh(folder / "mixed.msh", [*CORNERS, (0.5, 1.5)], [*MESHES["Quad4"][1], (2, 4, 3, 5)])
    (folder / "text.msh").write_text("no mesh\n")
    (folder / "long.csv").write_text("x,y,a,b,eps,angle\n0,0,1,1,1,0\n")
    tri3 = ["--mesh", "Tri3.msh"]
    for named, *arguments in (
            ("upright rectangle", "--mesh", "slanting.msh", *PACKING),
            ("one kind of element", "--mesh", "mixed.msh", *PACKING),
            ("line 1 of 'text.msh'", "--mesh", "text.msh", *PACKING),
            ("--cell", *tri3, *PACKING[:2]),
            ("superellipse", *tri3, "--particles", "long.csv", "--cell", "1,0,0,1"),
            ("--mesh", *tri3, *PACKING, "--columns", "3"),
            ("--particles", *tri3, *PACKING[2:]),
            ("--confining", *tri3, *PACKING, "--confining", "nan"),
            ("--width", *PACKING, "--width", "1e-9"),
            ("--axial-strain-step", *tri3, *PACKING, "--axial-strain-step", "1e-300"),
            ("--steps", *tri3, *PACKING, "--steps", "0"),
            ("./examples/run, which builds biaxial_specimen_water", *tri3, *PACKING, "--undrained"),
            ("--undrained", *tri3, *PACKING, "--pore-pressure", "1e5"),
            ("biaxial_specimen_water is started without", WATER, *PACKING),
            ("the grains would carry nothing", WATER, *PACKING, "--undrained", "--pore-pressure", "2e5"),
            ("quadrilaterals of eight nodes", WATER, *tri3, *PACKING, "--undrained"),
            ("--rate", WATER, *PACKING, "--undrained", "--rate", "0"),
            ("an input", *tri3, *PACKING, "--out", "Tri3.msh")):
        program = arguments.pop(0) if arguments[0] == WATER else "biaxial_specimen"
        before = sorted(path.name for path in folder.iterdir())
        if "--out" not in arguments:
            arguments += ["--out", "refused.csv"]
        code, said = run(program, *arguments, folder=folder)
        expect(code not in (0, 3) and named in said, f"{arguments}: ended with {code}\n{said}")
        expect(sorted(path.name for path in folder.iterdir()) == before, f"{arguments} left files behind")


if not (PROGRAMS / "biaxial_specimen").exists():
    print("skipped: no examples are built")
    sys.exit(77)
with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    check_elements(scratch)
    check_ellipses(scratch)
    check_undrained(scratch)
    check_threads(scratch)
    check_exhaustion(scratch)
    check_refusals(scratch)
finish()
