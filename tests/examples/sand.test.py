# SPDX-License-Identifier: BSL-1.0
"""[slow] A sand is a file: it gives the packing that its options give, wrong files are rejected by line and name, and `rve_lab calibrate` finds
a sand again, resumes with the same result and rejects targets out of reach. Environment: SCARP_EXAMPLES, the folder of the built programs
(skipped, exit 77, without)."""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish

LAB = example("rve_lab")
SANDS = pathlib.Path(__file__).resolve().parents[2] / "examples" / "sands"
FAST = ["--grains", "60", "--strain", "0.02", "--strain-step", "5e-5"]


def run(*arguments, folder):
    done = subprocess.run([*map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=250)
    return done.returncode, done.stdout + done.stderr


def prepared(folder, name, *arguments):
    code, said = run(LAB, "prepare", *arguments, "--output", name, folder=folder)
    expect(code == 0, f"prepare {name}: ended with {code}\n{said}")
    return (folder / name / "packing.packing").read_bytes() if code == 0 else None


def check_file(folder):
    options = ["--shape", "ellipse", "--grains", "60", "--friction", "0.4", "--relative-density", "0.5", "--void-ratio-tolerance", "0.01"]
    by_options = prepared(folder, "options", *options)
    (folder / "own.sand").write_text("# own\r\nshape = ellipse\nfriction 0.4  # between grains\nvoid-ratio = 0.2\n"
                                     "grains=60\nvoid-ratio-tolerance = 0.01\n")
    expect(prepared(folder, "file", "--sand", "own.sand", "--relative-density", "0.5") == by_options, "file and options give two packings")
    expect(prepared(folder, "written", "--sand", folder / "options/packing.sand") == by_options, "a sand that was written is another one")
    for sand in sorted(SANDS.glob("*.sand")):
        prepared(folder, sand.stem, "--sand", sand, "--grains", "60", "--void-ratio-tolerance", "0.02")
    sieved = prepared(folder, "sieved", "--sieve", "0.006 0, 0.010 30, 0.016 100", "--grains", "60")
    expect(sieved is not None, "no packing by a sieve curve")
    with open(folder / "sieved/packing_particles.csv", newline="") as file:
        radii = [float(row["r"]) for row in csv.DictReader(file)]
    expect(min(radii) >= 0.003 and max(radii) <= 0.008, f"radii from {min(radii)} to {max(radii)}")


def check_refusals(folder):
    for text, said in (("shape = ellipse\nviod-ratio = 0.2\n", "line 2: a sand has no 'viod-ratio'"),
                       ("friction = rough\n", "line 1: 'friction' is 'rough'"),
                       ("density\n", "line 1 is 'density'"),
                       ("friction = 0.4\nfriction = 0.5\n", "line 2 gives 'friction' again"),
                       ("friction = -1\n", "friction is -1"),
                       ("aspect = 0.5\n", "'aspect' is given but not used (grains are of the shape 'disc')"),
                       ("void-ratio = 0.2\nrelative-density = 0.5\n", "'relative-density' stands beside another option"),
                       ("sieve = 0.002 0, 0.001 100\n", "sieve"),
                       ("shape = ellipse\nlaw = hertz\n", "'ellipse' grains with law 'hertz' are not built"),
                       ("smallest = 7e-3\n", "largest size 0.006 is below the smallest 0.007")):
        (folder / "wrong.sand").write_text(text)
        code, answer = run(LAB, "prepare", "--sand", "wrong.sand", "--output", "none", folder=folder)
        expect(code > 0 and said in answer, f"{text!r}: ended with {code}\n{answer}")
        expect(not (folder / "none").exists(), f"{text!r}: something was written")


def check_scenes(folder):
    """The file of the reference study is the default of the scene, to the bit; other grains give other results."""
    fault = example("fault_rupture")
    tiny = ["--quick", "--local", "--size", "12", "--grains", "64", "--throw-over-depth", "0.002", "--frames", "1"]
    results = {}
    for name, more in (("default", []), ("file", ["--sand", SANDS / "reference_study.sand"]), ("loose", ["--sand", SANDS / "loose.sand"])):
        code, said = run(fault, *tiny, *more, "--output", name, folder=folder)
        expect(code == 0, f"fault_rupture {name}: ended with {code}\n{said}")
        results[name] = json.loads((folder / name / "summary.json").read_text())["void_ratio_min"] if code == 0 else None
    expect(results["default"] == results["file"] != results["loose"], f"void ratios {results}")
    (folder / "discs.sand").write_text("shape = disc\n")
    code, said = run(fault, *tiny, "--sand", "discs.sand", "--output", "discs", folder=folder)
    expect(code == 2 and "only ellipse linear" in said, f"discs in fault_rupture: ended with {code}\n{said}")


def check_calibration(folder):
    """The void ratio of a few small packings is found again within the scatter, from a target alone."""
    command = [LAB, "calibrate", *FAST, "--shape", "ellipse", "--free", "preparation-friction=0:0.5", "--target", "void-ratio=0.19", "--seeds",
               "3", "--evaluations", "12", "--output", "found"]
    code, said = run(*command, folder=folder)
    if code > 0 and "without NLopt" in said:
        return
    expect(code == 0, f"calibrate: ended with {code}\n{said}")
    summary = json.loads((folder / "found/summary.json").read_text())
    expect(abs(summary["void_ratio"] - 0.19) < 0.003, f"void ratio {summary['void_ratio']} for 0.19")  # the bound of a target that is reached
    table = (folder / "found/evaluations.csv").read_text().splitlines()
    (folder / "found/evaluations.csv").write_text("\n".join(table[:5]) + "\n")
    sand = (folder / "found/calibrated.sand").read_text()
    code, said = run(*command, "--resume", folder=folder)
    expect(code == 0 and said.count("from evaluations.csv") >= 4, f"--resume: ended with {code}\n{said}")
    expect((folder / "found/calibrated.sand").read_text() == sand, "a resumed calibration finds another sand")
    code, said = run(*command[:-1], "found", "--resume", "--seed", "2", folder=folder)
    expect(code > 0 and "of another calibration" in said, f"--resume of another one: ended with {code}\n{said}")
    far = [*command[:-5], "3", "--evaluations", "6", "--output", "far"]
    far[far.index("void-ratio=0.19")] = "void-ratio=0.05"
    code, said = run(*far, folder=folder)
    expect(code > 0 and "out of reach" in said and "preparation-friction at the lower end" in said, f"out of reach: ended with {code}\n{said}")
    expect(not (folder / "far/calibrated.sand").exists(), "a sand out of reach was written")


for check in (check_file, check_refusals, check_scenes, check_calibration):
    with tempfile.TemporaryDirectory() as scratch:
        check(pathlib.Path(scratch))
finish()
