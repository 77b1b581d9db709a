# SPDX-License-Identifier: BSL-1.0
"""Spheres in space through `rve_lab`: packings survive their file, triaxial and oedometer tests hold stress and strain, a void ratio is found
again, and what is not compiled is rejected. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from expectations import example, expect, finish, leave_out

LAB = example("rve_lab")
SPHERES = ["--shape", "sphere", "--grains", "80", "--pressure", "5e4"]
ROLLING = ["--law", "rolling-hertz", "--friction", "0.6", "--rolling-friction", "0.5", "--rolling-stiffness", "1.6", "--preparation-friction", "0.3"]


def run(folder, *arguments):
    done = subprocess.run([LAB, *map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=250)
    return done.returncode, done.stdout + done.stderr


def rows_of(folder, name, *arguments):
    code, said = run(folder, "test", "--output", name, *arguments)
    expect(code == 0, f"{name}: ended with {code}\n{said}")
    with open(folder / name / "test.csv", newline="") as file:
        return [{key: float(cell) for key, cell in row.items()} for row in csv.DictReader(file)]


def check_tests(folder):
    step = ["--strain-step", "5e-5", "--tolerance", "2e-3"]
    code, said = run(folder, "prepare", *SPHERES, *ROLLING, "--output", "packing")
    expect(code == 0, f"prepare: ended with {code}\n{said}")
    rows = rows_of(folder, "drained", "--packing", "packing/packing.packing", "--strain", "0.02", *step)
    expect(json.loads((folder / "drained/summary.json").read_text())["dimension"] == 3, "a packing of spheres is in space")
    # Each row is held within --tolerance times the largest stress, the axial one.
    expect(all(abs(row["lateral_stress"] - rows[0]["lateral_stress"]) < 4e-3 * row["axial_stress"] for row in rows), "the lateral stress is not held")
    expect(rows[-1]["q"] > 2e4, f"q is {rows[-1]['q']} Pa after 2 %, less than 10 degrees of friction give")
    again = rows_of(folder, "prepared", *SPHERES, *ROLLING, "--strain", "0.02", *step)
    expect(again == rows, "a packing from its file is tested otherwise than one that is prepared")
    for law in ("linear", "rolling"):
        rows = rows_of(folder, law, *SPHERES, "--law", law, "--path", "oedometer", "--strain", "0.01", *step)
        void_ratio = (1.0 + rows[0]["void_ratio"]) * math.exp(-0.01) - 1.0
        expect(abs(rows[-1]["void_ratio"] - void_ratio) < 1e-9, f"{law}: void ratio {rows[-1]['void_ratio']}, {void_ratio} without lateral strain")
        at_rest = rows[-1]["lateral_stress"] / rows[-1]["axial_stress"]
        expect(0.2 < at_rest < 0.9, f"{law}: K0 is {at_rest}, by Jaky's formula friction of 53 or of 6 degrees")


def check_calibration(folder):
    """The void ratio is that of a sand within the bounds."""
    command = ["calibrate", *SPHERES, "--free", "preparation-friction=0:0.5", "--strain", "0.03", "--strain-step", "5e-5", "--seeds", "2", "--evaluations", "10"]
    code, said = run(folder, *command, "--target", "void-ratio=0.72", "--output", "found")
    if "without NLopt" in said:
        return leave_out("rve_lab was built without NLopt")
    expect(code == 0, f"calibrate: ended with {code}\n{said}")
    found = json.loads((folder / "found/summary.json").read_text())["void_ratio"]
    expect(abs(found - 0.72) < 0.003, f"void ratio {found} for 0.72")  # the bound of a target that is reached
    expect("triaxial" in (folder / "found/calibrated.sand").read_text(), "the calibrated sand does not name its test")
    code, said = run(folder, *command, "--path", "constant_mean_stress", "--target", "void-ratio=0.72", "--output", "none")
    expect(code == 2 and "drained triaxial compression" in said, f"a path that spheres do not have: ended with {code}\n{said}")


def check_rejections(folder):
    for command, said in (("shear", "the grains are spheres"), ("prepare", "only sphere linear, sphere rolling, sphere rolling-hertz")):
        more = ["--law", "hertz"] if command == "prepare" else []
        code, answer = run(folder, command, *SPHERES, *more, "--output", "none")
        expect(code == 2 and said in answer, f"{command}: ended with {code}\n{answer}")


for check in (check_tests, check_calibration, check_rejections):
    with tempfile.TemporaryDirectory() as scratch:
        check(pathlib.Path(scratch))
finish()
