# SPDX-License-Identifier: BSL-1.0
"""[slow] A sand is a file: it gives the packing that its options give, wrong files are rejected by line and name, and `rve_lab calibrate` finds
a sand again, resumes with the same result, passes over infeasible evaluations, fits tables and rejects targets out of reach. Environment: SCARP_EXAMPLES, the folder of the built programs
(skipped, exit 77, without)."""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish, leave_out

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
    expect("overconsolidation" not in (folder / "options/packing.sand").read_text(), "a sand without a vertical pressure takes the ground's preload away")
    for sand in sorted(SANDS.glob("*.sand")):
        jumps = ["--void-ratio-tolerance", "0.02"] if "relative-density" in sand.read_text() else []  # as few grains do
        prepared(folder, sand.stem, "--sand", sand, "--grains", "60", *jumps)
    # Options count before a complete file, also where its values are of no use then.
    prepared(folder, "harder", "--sand", folder / "options/packing.sand", "--grains", "60", "--preparation-friction", "0.2")
    (folder / "slight.sand").write_text("shape = ellipse\ngrains = 60\npreparation-friction = 0.02\n")
    expect(prepared(folder, "off", "--sand", "slight.sand", "--void-ratio", "0") == prepared(folder, "slight", "--sand", "slight.sand"),
           "--void-ratio 0 drops the preparation friction of a file")
    (folder / "linear.sand").write_text("shape = disc\nlaw = linear\nnormal-stiffness = 5e6\ntangential-stiffness = 4e6\n")
    prepared(folder, "hertz", "--sand", "linear.sand", "--grains", "60", "--law", "hertz", "--modulus", "1e9")
    code, said = run(LAB, "prepare", "--grains", "60", "--overconsolidation-ratio", "3", "--output", "none", folder=folder)
    expect(code == 2 and "without a vertical-pressure" in said, f"overconsolidated by nothing: ended with {code}\n{said}")
    sieved = prepared(folder, "sieved", "--sieve", "0.006 0, 0.010 30, 0.016 100", "--grains", "60")
    expect(sieved is not None, "no packing by a sieve curve")
    with open(folder / "sieved/packing_particles.csv", newline="") as file:
        radii = [float(row["r"]) for row in csv.DictReader(file)]
    expect(min(radii) >= 0.003 and max(radii) <= 0.008, f"radii from {min(radii)} to {max(radii)}")


def check_refusals(folder):
    for text, said in (("shape = ellipse\nconductivity-void-ratio = 0.6\n", "not used (without a conductivity)"), ("shape = ellipse\nviod-ratio = 0.2\n", "line 2: a sand has no 'viod-ratio'"),
                       ("friction = rough\n", "line 1: 'friction' is 'rough'"),
                       ("density\n", "line 1 is 'density'"),
                       ("friction = 0.4\nfriction = 0.5\n", "line 2 gives 'friction' again"),
                       ("friction = -1\n", "friction is -1"),
                       ("aspect = 0.5\n", "'aspect' is given but not used (grains are of the shape 'disc')"),
                       ("void-ratio = 0.2\nrelative-density = 0.5\n", "'relative-density' stands beside another option"),
                       ("sieve = 0.002 0, 0.001 100\n", "sort the sieves"),
                       ("grains = 300\nsieve = 0.0001 0, 0.001 40, 0.004 100\n", "300 grains cannot have the sieve curve"),
                       ("\ufeffshape = disc\rfriction = 0,5\r", "line 2: 'friction' is '0,5'"),
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
    results, loosest = {}, {}
    for name, more in (("default", []), ("file", ["--sand", SANDS / "reference_study.sand"]), ("loose", ["--sand", SANDS / "loose.sand"]),
                       ("layers", ["--layer", f"8={SANDS / 'loose.sand'}", f"17={SANDS / 'reference_study.sand'}"])):
        code, said = run(fault, *tiny, *more, "--output", name, folder=folder)
        expect(code == 0, f"fault_rupture {name}: ended with {code}\n{said}")
        summary = json.loads((folder / name / "summary.json").read_text()) if code == 0 else {}
        results[name], loosest[name] = (summary.get(f"void_ratio_{end}") for end in ("min", "max"))
    expect(results["default"] == results["file"] != results["loose"], f"void ratios {results}")
    expect(summary["layer_tops"] == [8.0, 17.0] and not summary["repeats_study"], f"a ground of layers: {summary}")
    # Packings of a layer are compressed from its own top on, which is no other stress but other steps.
    expect(abs(results["layers"] - results["default"]) < 1e-4 and results["loose"] < loosest["layers"] < loosest["loose"],
           f"loose sand between 8 and 17 m: {results}, at most {loosest}")
    for layers, what in ((["8"], "write 8=dense.sand"), (["8=none.sand"], "cannot read 'none.sand'"), ([f"25={SANDS / 'loose.sand'}"], "less than 25 m"),
                         ([f"24.9={SANDS / 'loose.sand'}"], "the layer from 24.9 m down has no integration point"),
                         ([f"9={SANDS / 'loose.sand'}", f"8={SANDS / 'loose.sand'}"], "more than 9"),
                         ([f"8={SANDS / 'fontainebleau.sand'}"], "friction 0.707, the ground above it 0.55")):
        code, said = run(fault, *tiny, "--layer", *layers, "--output", "wrong", folder=folder)
        expect(code == 2 and what in said and not (folder / "wrong/summary.json").exists(), f"--layer {layers}: ended with {code}\n{said}")
    (folder / "once_loaded.sand").write_text("shape = ellipse\noverconsolidation-ratio = 2\n")
    code, said = run(fault, *tiny, "--sand", "once_loaded.sand", "--output", "once_loaded", folder=folder)
    expect(code == 0, f"fault_rupture, a sand that carried more: ended with {code}\n{said}")
    ratio = json.loads((folder / "once_loaded/run.json").read_text())["options"]["overconsolidation-ratio"]
    expect(float(ratio) == 1.0, f"--local stands for an overconsolidation ratio of 1 and not {ratio}")
    (folder / "discs.sand").write_text("shape = disc\n")
    code, said = run(fault, *tiny, "--sand", "discs.sand", "--output", "discs", folder=folder)
    expect(code == 2 and "only ellipse linear" in said, f"discs in fault_rupture: ended with {code}\n{said}")


def check_calibration(folder):
    """The void ratio of a few small packings is found again within the scatter, from a target alone."""
    command = [LAB, "calibrate", *FAST, "--shape", "ellipse", "--free", "preparation-friction=0:0.5", "--target", "void-ratio=0.19", "--seeds",
               "3", "--evaluations", "12", "--output", "found"]
    code, said = run(*command, folder=folder)
    if code > 0 and "without NLopt" in said:
        return leave_out("rve_lab was built without NLopt")
    expect(code == 0, f"calibrate: ended with {code}\n{said}")
    summary = json.loads((folder / "found/summary.json").read_text())
    expect(abs(summary["void_ratio"] - 0.19) < 0.003, f"void ratio {summary['void_ratio']} for 0.19")  # the bound of a target that is reached
    table = (folder / "found/evaluations.csv").read_text().splitlines()
    (folder / "found/evaluations.csv").write_text("\n".join(table[:5]) + "\n" + table[5][:20])  # a row that was cut off
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
    (folder / "both").mkdir()
    (folder / "both/summary.json").write_text("{}")  # as shear leaves it
    code, said = run(*command[:-1], "both", folder=folder)
    expect(code > 0 and "results would be lost" in said, f"calibrate beside other results: ended with {code}\n{said}")
    (folder / "discs").mkdir()
    (folder / "discs/calibrated.sand").write_text("friction = 0.5\n")  # of an older run
    discs = [LAB, "calibrate", *FAST, "--free", "friction,relative-density", "--target", "peak-friction=50", "--seeds", "2",
             "--evaluations", "10", "--output", "discs"]
    code, said = run(*discs, folder=folder)
    expect(code > 0 and "out of reach: peak-friction 50" in said, f"50 degrees of discs: ended with {code}\n{said}")
    expect(not (folder / "discs/calibrated.sand").exists(), "the sand of an older run is left beside results of one that failed")
    # Which bound the best of so few draws lies at depends on round-off: what is said must be so.
    ends = [f"{name} at the upper end" for name, value in re.findall(r"^(friction|relative-density) ([0-9.]+)", said, re.M) if float(value) > 0.974]
    expect(all(end in said.split("limited by")[-1] for end in ends or ["no parameter is at its bounds"]),
           f"50 degrees of discs are limited by what?\n{said}")
    code, said = run(*discs, "--window", "0.01", "--resume", folder=folder)
    expect(code > 0 and "of another calibration" in said, f"--resume with another window: ended with {code}\n{said}")
    # A wanted void ratio is that at the isotropic pressure, whatever the path holds.
    code, said = run(LAB, "calibrate", *FAST, "--shape", "ellipse", "--void-ratio", "0.19", "--lateral-stress", "8e5", "--free", "friction=0.4:0.6",
                     "--target", "e50=5e7", "--seeds", "2", "--evaluations", "3", "--output", "held", folder=folder)
    expect("limited by void ratio" not in said, f"a void ratio at another stress: ended with {code}\n{said}")
    with open(folder / "held/evaluations.csv", newline="") as file:
        densities = [float(row["void ratio at the isotropic pressure"]) for row in csv.DictReader(file)]
    expect(densities and all(abs(one - 0.19) < 0.01 for one in densities), f"void ratios {densities} for 0.19")
    for free, target, words in (("friction", "e50=0", "--target e50 is 0"),
                                ("friction", "void-ratio=0.2,void-ratio=0.3", "--target names 'void-ratio' twice"),
                                ("friction,friction=0.2:0.4", "e50=1e7", "--free names 'friction' twice")):
        code, said = run(LAB, "calibrate", *FAST, "--free", free, "--target", target, "--output", "none", folder=folder)
        expect(code > 0 and words in said, f"--free {free} --target {target}: ended with {code}\n{said}")
    code, said = run(LAB, "calibrate", *FAST, "--largest", "0.01", "--free", "smallest=0.007:0.008", "--target", "e50=0", "--output", "none", folder=folder)
    expect("--target e50 is 0" in said, f"bounds beside the largest size that is given: ended with {code}\n{said}")


def check_infeasible(folder):
    """Soft contacts give overlaps that end a preparation: rows with a reason, also when they are resumed. None at all is an error."""
    command = [LAB, "calibrate", *FAST, "--free", "normal-stiffness=1e2:1e7", "--target", "e50=8e6", "--seeds", "2", "--evaluations", "14",
               "--output", "soft"]
    code, said = run(*command, folder=folder)
    if code > 0 and "without NLopt" in said:
        return leave_out("rve_lab was built without NLopt")
    expect(code == 0, f"with infeasible evaluations: ended with {code}\n{said}")
    if code > 0:
        return
    summary = json.loads((folder / "soft/summary.json").read_text())
    with open(folder / "soft/evaluations.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    without = [row for row in rows if row["reason"]]
    expect(0 < len(without) == summary["infeasible_evaluations"] < summary["evaluations"], f"{len(without)} rows with a reason, {summary}")
    expect(all(row["value of e50"] == "" for row in without), f"values of infeasible rows: {without}")
    expect("infeasible, seed" in said and summary["first_infeasible_evaluation"] == without[0]["reason"], f"reasons: {said}")
    expect(abs(summary["targets"]["e50"]["value"] - 8e6) < 0.1 * 8e6, f"E50 for 8 MPa: {summary['targets']}")
    sand = (folder / "soft/calibrated.sand").read_text()
    code, said = run(*command, "--resume", folder=folder)
    expect(code == 0 and (folder / "soft/calibrated.sand").read_text() == sand, f"--resume: ended with {code}\n{said}")
    expect(said.count("from evaluations.csv") == summary["evaluations"], f"--resume evaluates again:\n{said}")
    code, said = run(LAB, "calibrate", "--grains", "60", "--free", "friction=0.3:0.6", "--target", "e50=1.5e7", "--seeds", "2", "--evaluations",
                     "4", "--strain-step", "1e-3", "--strain", "0.5", "--output", "none", folder=folder)
    expect(code > 0 and "none of 4 evaluations has packings" in said and "too_deep" in said, f"none feasible: ended with {code}\n{said}")



def check_tables(folder):
    """A triaxial table: q/p becomes the sine of the friction angle, and both columns count."""
    rows = ["eps1_percent,epsv_percent,q_kPa,p_kPa"]
    rows += [f"{0.1 * k},{0.01 * k},{100 * k / (5 + k)},{200 + 100 * k / (5 + k) / 3}" for k in (*range(21), 20)]  # a hold at the end
    (folder / "drained.csv").write_text("\n".join(rows) + "\n")
    # The same test by strains over its initial height and volume.
    over = [f"{100 * -math.expm1(-k / 1000)},{100 * -math.expm1(-k / 10000)},{row.split(',', 2)[2]}" for k, row in zip((*range(21), 20), rows[1:])]
    (folder / "engineering.csv").write_text("\n".join(["engineering_axial_strain_percent,engineering_volumetric_strain_percent,q_kPa,p_kPa", *over]) + "\n")
    command = [LAB, "calibrate", "--grains", "60", "--strain-step", "5e-5", "--free", "friction", "--seeds", "2", "--evaluations", "3"]
    code, said = run(*command, "--table", "drained.csv", "--triaxial", "--output", "table", folder=folder)
    if code > 0 and "without NLopt" in said:
        return leave_out("rve_lab was built without NLopt")
    expect(code == 0, f"--table --triaxial: ended with {code}\n{said}")
    if code > 0:
        return
    with open(folder / "table/calibration.csv", newline="") as file:
        fitted = list(csv.DictReader(file))
    expect({row["name"] for row in fitted} == {"sine of friction angle", "volumetric strain"}, f"columns {fitted}")
    code, said = run(*command, "--table", "engineering.csv", "--triaxial", "--output", "engineering", folder=folder)
    with open(folder / "engineering/calibration.csv", newline="") as file:
        alike = list(csv.DictReader(file))
    expect(len(alike) == len(fitted) and all(abs(float(a[name]) - float(b[name])) < 1e-12 for a, b in zip(alike, fitted)
                                             for name in ("axial_strain", "wanted")), f"engineering strains: ended with {code}\n{said}")
    last = [row for row in fitted if row["name"] == "sine of friction angle"][-1]
    q = 1e5 * 20 / 25
    ratio = q / (2e5 + q / 3)
    expect(abs(float(last["wanted"]) - 3.0 * ratio / (6.0 + ratio)) < 1e-9, f"sine at the end: {last}")
    expect("a laboratory table; biaxial at 200000 Pa" in (folder / "table/calibrated.sand").read_text(), "the sand does not name its table and stress")
    # Stiffness is free where nothing is said, and a parameter at a bound is said to be there: this sand is weaker.
    unsaid = [one for one in command if one not in ("--free", "friction")]
    code, said = run(*unsaid, "--table", "drained.csv", "--triaxial", "--output", "unsaid", folder=folder)
    found = set(json.loads((folder / "unsaid/summary.json").read_text())["parameters"]) if code == 0 else code
    expect(found == {"friction", "relative-density", "normal-stiffness"}, f"free without --free: {found}\n{said}")
    code, said = run(*unsaid[:-1], "12", "--free", "friction=0.5:0.6", "--table", "drained.csv", "--triaxial", "--output", "bound", folder=folder)
    expect(code == 0 and "at the lower end of its bounds: widen them" in said, f"friction at its bound: ended with {code}\n{said}")
    # Where the path prescribes another strain the tests go on to the axial one of the table.
    code, said = run(*command, "--table", "drained.csv", "--path", "constant_mean_stress", "--output", "mean_stress", folder=folder)
    expect(code == 0, f"--path constant_mean_stress: ended with {code}\n{said}")
    with open(folder / "mean_stress/curve.csv", newline="") as file:
        expect(float(list(csv.DictReader(file))[-1]["axial_strain"]) >= 0.02, "tests at constant mean stress end before the table")
    # Rows are as long as they are to be, also where a step does not divide them.
    coarse = ["3e-4" if one == "5e-5" else one for one in command]
    code, said = run(*coarse, "--table", "drained.csv", "--table", "drained.csv", "--output", "twice", folder=folder)
    expect(code == 0, f"two tables: ended with {code}\n{said}")
    if code > 0:
        return
    with open(folder / "twice/curve.csv", newline="") as file:
        strains = [float(row["axial_strain"]) for row in csv.DictReader(file)]
    apart = [second - first for first, second in zip(strains[1:], strains[2:])]
    expect(strains[-1] >= 0.02 and all(abs(one - 1e-3) < 1e-9 for one in apart), f"rows of a curve with steps of 3e-4: {strains}")
    # Means over the rows of path.csv belong to the middles of these rows: 0.5 % of strain is the end of one row, 0.45 % the middle.
    (folder / "means.csv").write_text("axial_strain,mean_q,mean_p,q,p\n" + "".join(f"{0.001 * k},{2e3 * k},2e5,0,1\n" for k in range(11)))
    code, said = run(*command, "--table", "means.csv", "--output", "means", folder=folder)
    expect(code == 0, f"--table of means: ended with {code}\n{said}")
    with open(folder / "means/calibration.csv", newline="") as file:
        fitted = [(float(row["axial_strain"]), float(row["wanted"])) for row in csv.DictReader(file)]
    expect(any(0.0005 < strain < 0.0095 for strain, _ in fitted), f"strains of {fitted}")
    expect(all(abs(wanted - (strain + 0.0005) / 0.001 * 0.005) < 1e-9 for strain, wanted in fitted if 0.0015 < strain < 0.0095), f"means of {fitted}")
    for arguments, named in ((["--target", "peak-friction=30", "--triaxial"], "--triaxial is given but not used"),
                             (["--target", "void-ratio=0.2", "--window", "0.01"], "--window is given but not used"),
                             (["--target", "peak-friction=30", "--strain", "0.01"], "below the --window"),
                             (["--table", "drained.csv", "--shape", "ellipse", "--law", "hertz"], "are not built")):
        code, said = run(*command, *arguments, "--output", "rejected", folder=folder)
        expect(code > 0 and named in said, f"{arguments}: ended with {code}\n{said}")
        expect(not (folder / "rejected").exists(), f"{arguments}: something was written")


def check_impossible_tables(folder):
    """What no test can give is rejected with what it may be instead."""
    def table(head, row, name="impossible.csv"):
        (folder / name).write_text("\n".join([head, *(",".join(f"{cell:.9g}" for cell in row(0.1 * k)) for k in range(6))]) + "\n")
    ratio = "axial_strain,volumetric_strain,stress_ratio"
    held = ["--lateral-stress", "1e5"]
    for head, row, more, named in (
            (ratio, lambda t: (20 * t, -t, 2 * t), held, "_percent where it is in per cent"),
            (ratio, lambda t: (0.1 * t, -2 * t, t), held, "_percent where it is in per cent"),
            (ratio, lambda t: (0.1 * t, 0.04 - 0.1 * t, t), held, "is 0.04 at an axial strain of 0 (a test begins at 0)"),
            (ratio, lambda t: (0.1 * t * (0.8 - t), 0, t), held, "it is not to decrease"),
            ("axial_strain,q,p", lambda t: (0.1 * t, 4e5 * t, 100 + 133 * t), [], "give q and p in one unit"),
            ("axial_strain,q,p", lambda t: (0.1 * t, 4e5 * t, 2e5), [], "goes from"),
            ("axial_strain,q,p", lambda t: (0.1 * t, 200 * t, 100 + 100 * t), [], "holds 100 Pa by its q and p"),
            ("axial_strain,q_kPa,p_kPa", lambda t: (0.1 * t, 200 * t, 200 + 100 * t), held, "--lateral-stress is 1e+05 Pa"),
            ("axial_strain,volumetric_strain", lambda t: (0.1 * t, 0), [], "give --lateral-stress"),
            ("axial_strain,void_ratio", lambda t: (0.1 * t, 0.7), held, "no stress_ratio, no q and p, and no volumetric_strain (line 1 names axial_strain, void_ratio"),
            ("axial_strain,q,p,volumetric_strain_pct", lambda t: (0.1 * t, 4e5 * t, 4e5 * (1 + t / 2), t), [], "column 'volumetric_strain_pct' that is not read"),
            ("axial_strain,stress_ratio,q,p", lambda t: (0.1 * t, t / (1 + t / 2), 4e5 * t, 4e5 * (1 + t / 2)), ["--strain", "0.01"], "--strain is 0.01 (the tables go to"),
            ("engineering_axial_strain,stress_ratio", lambda t: (2 * t, t), held, "_percent where it is in per cent"),
            ("axial_strain,stress_ratio,engineering_vol_strain", lambda t: (0.1 * t, t, 0.01 * t), held, "engineering_vol_strain' that is not read"),
            ("eps_percent,stress_ratio", lambda t: (0.1 * t, t), held, "(line 1 names eps_percent, stress_ratio; axial_strain, axial_strain_percent, eps1")):
        table(head, row)
        code, said = run(LAB, "calibrate", "--grains", "60", "--table", "impossible.csv", *more, "--output", "none", folder=folder)
        expect(code == 2 and named in said, f"{head}, {named}: ended with {code}\n{said}")
    (folder / "two.csv").write_text("axial_strain,stress_ratio\n0,0\n0.1,1\n")
    code, said = run(LAB, "calibrate", "--grains", "60", "--table", "two.csv", *held, "--output", "none", folder=folder)
    expect(code == 2 and "has 2 rows (three at least" in said, f"two rows: ended with {code}\n{said}")
    for name, stress in (("one.csv", 1e5), ("other.csv", 4e5)):
        table("axial_strain,q,p", lambda t: (0.1 * t, stress * t, stress * (1 + t / 2)), name)
    code, said = run(LAB, "calibrate", "--grains", "60", "--table", "one.csv", "--table", "other.csv", "--output", "none", folder=folder)
    expect(code == 2 and "another table's 1e+05 Pa" in said, f"two stresses: ended with {code}\n{said}")
    expect(not (folder / "none").exists(), "something was written")


def check_ground(folder):
    """Ground of packings takes the grains and the preparation of a sand's file, but for those that are not built; options count first."""
    (folder / "smooth.sand").write_text("shape = ellipse\nfriction = 0.2\npreparation-friction = 0.05\n")
    (folder / "rolling.sand").write_text("shape = disc\nlaw = rolling\n")
    specimen = [example("biaxial_specimen"), "--columns", "1", "--rows", "1", "--packings", "1", "--grains", "40", "--steps", "1",
                "--axial-strain-step", "2e-4"]
    wall = [example("retaining_wall"), "--size", "2", "--grains", "40", "--strain", "0.02"]
    forces = {}
    for name, more in (("default", []), ("smooth", ["--sand", "smooth.sand"]), ("denser", ["--sand", "smooth.sand", "--preparation-friction", "0.02"])):
        code, said = run(*specimen, *more, "--out", f"{name}.csv", folder=folder)
        expect(code == 0, f"biaxial_specimen {name}: ended with {code}\n{said}")
        with open(folder / f"{name}.csv", newline="") as file:
            last = list(csv.DictReader(file))[-1]
        expect(abs(float(last["mean_sxx"]) + 2e5) < 600.0, f"biaxial_specimen {name} is not held at 200 kPa: {last}")
        forces[name] = last["top_force"]
    expect(len(set(forces.values())) == 3, f"forces of three sands: {forces}")
    code, said = run(*wall, "--sand", "smooth.sand", "--output", "wall", folder=folder)
    expect(code == 0, f"retaining_wall --sand: ended with {code}\n{said}")
    summary = json.loads((folder / "wall/summary.json").read_text())
    expect(summary["preparation_friction"] == 0.05 and summary["grains"] == 40, f"the wall's sand: {summary}")
    expect(summary["active"]["friction_angle"] < 40.0, f"friction of smooth ellipses: {summary['active']}")  # rough ones have more than 40
    for program in (specimen, wall):
        code, said = run(*program, "--sand", "rolling.sand", folder=folder)
        expect(code > 0 and "law 'rolling' are not built" in said, f"{program[0].name} --sand rolling.sand: ended with {code}\n{said}")
        code, said = run(*program, "--sand", SANDS / "karlsruhe.sand", folder=folder)
        expect(code > 0 and "grains are spheres (this program is plane)" in said, f"{program[0].name} with spheres: ended with {code}\n{said}")


for check in (check_file, check_refusals, check_scenes, check_calibration, check_infeasible, check_tables, check_impossible_tables, check_ground):
    with tempfile.TemporaryDirectory() as scratch:
        check(pathlib.Path(scratch))
finish()
