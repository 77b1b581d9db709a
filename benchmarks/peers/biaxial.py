# SPDX-License-Identifier: BSL-1.0
"""A biaxial test of packings by Yade's FEMxDEM (with Debian's python3-escript) and by our example biaxial_specimen."""
import csv
import os
import resource
import subprocess
import sys

from comparison import Different, build, here, install, made, root

import numpy  # comparison has installed it where it was missing

WIDTH, TALL, COLUMNS, LINES = 0.05, 0.1, 2, 4  # 8 elements with 4 points each
GRAINS, CONFINING, STRAIN, STEPS, ROUNDS = 400, 2e5, 1e-3, 4, 2
TOLERANCE = 1e-2  # of Yade: the last displacement over all; the default of its examples
SAME_STRESS = 0.01
ESCRIPT = "/usr/lib/python3-escript"


def write_mesh(path):
    nodes = [(WIDTH * i / COLUMNS, TALL * j / LINES) for j in range(LINES + 1) for i in range(COLUMNS + 1)]
    corners = [1 + i + j * (COLUMNS + 1) for j in range(LINES) for i in range(COLUMNS)]
    up = COLUMNS + 1
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes))]
    lines += [f"{number} {x!r} {y!r} 0" for number, (x, y) in enumerate(nodes, 1)]
    lines += ["$EndNodes", "$Elements", str(len(corners))]
    lines += [f"{number} 3 2 1 1 {a} {a + 1} {a + up + 1} {a + up}" for number, a in enumerate(corners, 1)]
    path.write_text("\n".join([*lines, "$EndElements"]) + "\n")


def ours(program, state, folder):
    """CPU seconds of the program as a whole, answers of points, mean vertical stress of each step."""
    write_mesh(folder / "specimen.msh")
    numpy.savetxt(folder / "particles.csv", numpy.column_stack([range(state.grains), state.position, state.radius]), delimiter=",",
                  fmt=["%d", "%.17g", "%.17g", "%.17g"], header="id,x,y,r", comments="")
    table = folder / "ours.csv"
    table.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ran = subprocess.run([str(program), "--mesh", str(folder / "specimen.msh"),
                          "--particles", str(folder / "particles.csv"), "--cell", "{!r},0,0,{!r}".format(*state.box.tolist()), "--confining",
                          repr(CONFINING), "--axial-strain-step", repr(STRAIN), "--steps", str(STEPS), "--threads", "1", "--out", str(table)],
                         capture_output=True, text=True)
    if ran.returncode != 0:
        sys.exit(f"{sys.argv[0]}: biaxial_specimen ended with {ran.returncode}:\n{ran.stderr[-2000:]}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(table) as file:
        rows = list(csv.DictReader(file))
    answers = 4 * COLUMNS * LINES * sum(int(row["iterations"]) for row in rows)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, answers, [float(row["mean_syy"]) for row in rows[1:]]


def yades(state, folder):
    """The same; the seconds are of the load steps alone."""
    start, law, table = folder / "biaxial_start.txt", folder / "biaxial_law.json", folder / "yade_biaxial.txt"
    state.write_for_yade(start, law, 0.0 * state.position, 0.05, damping=0.2, elements=[COLUMNS, LINES], specimen=[WIDTH, TALL],
                         tolerance=TOLERANCE, confining=CONFINING, steps=STEPS, strain=STRAIN)
    paths = {"PYTHONPATH": ESCRIPT, "LD_LIBRARY_PATH": f"{ESCRIPT}/lib", "OMP_NUM_THREADS": "1", "HOME": str(folder)}
    table.unlink(missing_ok=True)
    ran = subprocess.run(["yade", "-n", "-x", "-j1", str(here / "yade_biaxial.py"), str(start), str(law), str(table),
                          str(here / "yade_scene.py")], cwd=folder, env={**os.environ, **paths}, stdin=subprocess.DEVNULL,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    rows = [list(map(float, line.split())) for line in table.read_text().splitlines()] if table.exists() else []
    if len(rows) != STEPS:
        sys.exit(f"{sys.argv[0]}: Yade's FEMxDEM ended after {len(rows)} of {STEPS} steps:\n{ran.stdout[-2000:]}")
    return sum(row[0] for row in rows), int(sum(row[1] for row in rows)), [row[2] for row in rows]


def biaxial(given, folder):
    install("python3-escript")
    program = given.specimen or root / "build" / "release" / "examples" / "biaxial_specimen"
    if not given.specimen:
        build("biaxial_specimen")
    state = made("discs", GRAINS, folder)
    runs = {"scarp": [], "Yade": []}
    for _ in range(ROUNDS):
        runs["scarp"].append(ours(program, state, folder))
        runs["Yade"].append(yades(state, folder))
    worst = max(abs(a / b - 1.0) for a, b in zip(runs["Yade"][0][2], runs["scarp"][0][2]))
    if not worst <= SAME_STRESS:
        raise Different(f"mean vertical stresses of the biaxial tests differ by {worst:.2g} (tolerance {SAME_STRESS})")
    least = {title: min(found) for title, found in runs.items()}
    rows = []
    for title, (seconds, responses, stresses) in least.items():
        rows.append({"program": title, "CPU time per load step [s]": seconds / STEPS, "responses of points": responses,
                     "CPU time per response [ms]": 1e3 * seconds / responses, "Yade over ours, per load step": least["Yade"][0] / seconds,
                     "per response": least["Yade"][0] / least["Yade"][1] / seconds * responses,
                     "vertical stress [kPa]": stresses[-1] / 1e3, "largest difference of the vertical stress": worst})
    return rows
