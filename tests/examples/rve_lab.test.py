# SPDX-License-Identifier: BSL-1.0
"""`rve_lab replay` sends Yade's packing along Yade's paths (tests/reference/yade: another code, 1e-7 strain per step)
and stays within fractions of the confining stress; packings survive files; bad input gets a message and a non-zero
exit. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

LAB = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve() / "rve_lab"
YADE = pathlib.Path(__file__).resolve().parents[1] / "reference" / "yade"
SUDODEM = YADE.parent / "sudodem"
CELL = "0.19516606047263926,0,0.0008502401980710722,0.19043137125613024"
PRESSURE = 2e5  # [Pa]
FABRIC = (0.5010209421, 0.0004253299)  # xx, xy of Yade's contacts, tests/reference/README.md
INPUT = ["--particles", str(YADE / "particles.csv"), "--contacts", str(YADE / "contacts.csv")]
COMPONENTS = ("sxx", "sxy", "syx", "syy")


def run(*arguments, folder):
    done = subprocess.run([LAB, *map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout + done.stderr


def read(path):
    with open(path, newline="") as file:
        return [{name: float(cell) for name, cell in row.items()} for row in csv.DictReader(file)]


def replay(folder, path, strain, step, *more):
    out = folder / f"{path}.csv"
    code, said = run("replay", *INPUT, "--path", path, "--strain", strain, "--strain-step", step, "--out", out, *more,
                     folder=folder)
    expect(code == 0, f"replay of {path}: ended with {code}\n{said}")
    if code != 0:
        return []
    fabric = [float(number) for number in re.search("fabric of the contacts: xx (.*), xy (.*), yy", said).groups()]
    for ours, theirs in zip(fabric, FABRIC):
        expect(abs(ours - theirs) < 1e-9, f"fabric {fabric}, Yade's is {FABRIC}")
    return read(out)


def rms(ours, theirs, max_strain):
    """Over all components and rows up to a strain, relative to the confining stress."""
    errors = [(a[name] - b[name]) / PRESSURE for a, b in zip(ours, theirs) if b["strain"] <= max_strain * (1.0 + 1e-4)
              for name in COMPONENTS]
    return (sum(error**2 for error in errors) / len(errors)) ** 0.5


def check_paths(folder):
    """Bounds: at 1e-6 per step the codes are 0.04 % (1 % strain) and 0.33 % (2 %) apart; Yade at 1e-6 is 0.02 % and
    0.26 % from Yade at 1e-7, so beyond 1 % single events of the packing count."""
    paths = (("pure_shear", 0.02, ((0.01, 0.002), (0.02, 0.01))), ("isotropic", 0.005, ((0.005, 0.001),)))
    for path, strain, bounds in paths:
        ours = replay(folder, path, strain, "1e-6", "--cell", CELL)
        theirs = read(YADE / f"{path}.csv")
        expect(len(ours) == len(theirs), f"{path}: {len(ours)} rows, Yade has {len(theirs)}")
        if len(ours) != len(theirs):
            continue
        for a, b in zip(ours, theirs):
            for name in ("strain", "Fxx", "Fxy", "Fyx", "Fyy"):
                # Yade multiplies (1 + step) where we take the exponential: a relative strain of half a step.
                expect(abs(a[name] - b[name]) < 1e-6 * strain + 1e-9, f"{path}: {name} is {a[name]}, Yade's {b[name]}")
            expect(abs(a["void_ratio"] - b["void_ratio"]) < 1e-7, f"{path}: void ratio {a['void_ratio']}")
        for name in COMPONENTS:  # Yade's first row has nine digits
            error = abs(ours[0][name] - theirs[0][name])
            expect(error < 1e-8 * PRESSURE, f"{path}: {name} at the start is {ours[0][name]}")
        expect(ours[0]["n_contacts"] == theirs[0]["n_contacts"], f"{path}: {ours[0]['n_contacts']} contacts at first")
        for max_strain, bound in bounds:
            error = rms(ours, theirs, max_strain)
            print(f"{path} to {max_strain}: rms {100.0 * error:.4f} % of the confining stress")
            expect(error < bound, f"{path} to {max_strain}: rms {error} of the confining stress")


def check_cell(folder):
    """The cell follows from the contacts to round-off, and one that contradicts them is refused."""
    given = replay(folder, "isotropic", 1e-4, "1e-6", "--cell", CELL)[0]
    derived = replay(folder, "isotropic", 1e-4, "1e-6")[0]
    for name in (*COMPONENTS, "void_ratio"):
        expect(abs(given[name] - derived[name]) <= 1e-10 * PRESSURE, f"derived cell: {name} is {derived[name]}")
    a1x, a1y, a2x, a2y = CELL.split(",")
    code, said = run("replay", *INPUT, "--path", "isotropic", "--strain", "1e-4", "--strain-step", "1e-6", "--out",
                     "x.csv", "--cell", ",".join((a1x, a2x, a1y, a2y)), folder=folder)
    expect(code == 2 and "elsewhere in the cell" in said, f"transposed cell: ended with {code}\n{said}")
    # A cell in the file of the particles is that of the packing, also beside contacts.
    grains = read(YADE / "particles.csv")
    (folder / "boxed.txt").write_text("##PERIODIC:: 0.5 0.5 1\n" + "".join(f"{g['x']} {g['y']} 0 {g['r']}\n" for g in grains))
    code, said = run("replay", "--particles", "boxed.txt", *INPUT[2:], "--path", "isotropic", "--strain", "1e-4",
                     "--strain-step", "1e-6", "--out", "x.csv", folder=folder)
    expect(code == 2 and "elsewhere in the cell 0.5,0,0,0.5" in said, f"a wrong cell in the file: ended with {code}\n{said}")
    text = (YADE / "particles.csv").read_text().splitlines(keepends=True)
    (folder / "twice.csv").write_text("".join([*text[:2], text[1], *text[2:]]))
    code, said = run("replay", "--particles", "twice.csv", *INPUT[2:], "--path", "isotropic", "--strain", "1e-4",
                     "--strain-step", "1e-6", "--out", "x.csv", folder=folder)
    expect(code == 2 and "an earlier line has the same" in said, f"an id twice: ended with {code}\n{said}")


def check_held_stress(folder):
    for row in replay(folder, "biaxial", 0.01, "1e-5", "--lateral-stress", "2e5"):
        expect(abs(row["sxx"] / -PRESSURE - 1.0) < 0.01, f"lateral stress {row['sxx']} at strain {row['strain']}")


def check_other_stress(folder):
    """A stress other than the packing's is there before the path begins: no ramp is taken for a peak."""
    code, said = run("prepare", "--grains", "100", "--output", "made", folder=folder)
    expect(code == 0, f"prepare: ended with {code}\n{said}")
    for pressure, name in ((4e5, "up"), (1e5, "down")):
        code, said = run("shear", "--packing", "made/packing.packing", "--strain", "0.002", "--strain-step", "1e-5",
                         "--lateral-stress", pressure, "--output", name, folder=folder)
        expect(code == 0, f"--lateral-stress {pressure}: ended with {code}\n{said}")
        rows = read(folder / name / "path.csv") if code == 0 else []
        for column in ("sxx", "syy"):
            expect(rows and abs(rows[0][column] / -pressure - 1.0) < 1e-3, f"{column} begins at {rows[:1]}")
        for row in rows:
            expect(abs(row["mean_sxx"] / -pressure - 1.0) < 0.05, f"lateral stress {row['mean_sxx']} at {row['strain']}")
    # A packing under two stresses keeps their proportion.
    code, said = run("prepare", "--grains", "100", "--vertical-pressure", "3e5", "--k0", "0.5", "--output", "uneven", folder=folder)
    expect(code == 0, f"prepare with K0: ended with {code}\n{said}")
    code, said = run("shear", "--packing", "uneven/packing.packing", "--strain", "1e-4", "--strain-step", "1e-5",
                     "--lateral-stress", "1e5", "--output", "kept/", folder=folder)
    expect(code == 0, f"two stresses: ended with {code}\n{said}")
    rows = read(folder / "kept/path.csv") if code == 0 else []
    expect(rows and abs(rows[0]["sxx"] / -1e5 - 1.0) < 1e-3 and abs(rows[0]["syy"] / -2e5 - 1.0) < 0.02, f"stresses begin at {rows[:1]}")
    code, said = run("shear", "--packing", "made/packing.packing", "--lateral-stress", "1e12", "--output", "crushed",
                     folder=folder)
    expect(code > 0 and "does not come from" in said, f"a stress beyond reach: ended with {code}\n{said}")
    for title, named, arguments in (
            ("a stress that oedometers do not hold", "--lateral-stress", ["--path", "oedometer", "--lateral-stress", "4e5"]),
            ("an amplitude without cycles", "--amplitude", ["--amplitude", "0.1"]),
            ("a strain beside cycles", "--strain", ["--cycles", "1", "--strain", "0.1"]),
            ("a modulus of linear contacts", "--modulus", ["--modulus", "1e9"]),
            ("an aspect of discs", "--aspect", ["--aspect", "0.5"])):
        code, said = run("shear", "--grains", "60", *arguments, "--output", "unused", folder=folder)
        expect(code > 0 and f"{named} is given but not used" in said, f"{title}: ended with {code}\n{said}")
    code, said = run("shear", "--grains", "60", "--cycles", "3", "--amplitude", "4e-5", "--strain-step", "1e-4", "--output", "unused", folder=folder)
    expect(code == 2 and "--amplitude is 4e-05" in said, f"an amplitude below a step: ended with {code}\n{said}")
    code, said = run("shear", "--grains", "60", "--strain", "1e-7", "--strain-step", "1e-5", "--output", "unused", folder=folder)
    expect(code == 2 and "--strain is 1e-07" in said, f"a strain below a step: ended with {code}\n{said}")
    expect(not (folder / "unused").exists(), "options that are not used: something was written")


def check_lengths(folder):
    """Paths end at their strain, whatever the step is."""
    code, said = run("shear", "--grains", "60", "--strain", "1.5e-4", "--strain-step", "1e-4", "--overwrite", "--output", "length", folder=folder)
    strain = read(folder / "length/path.csv")[-1]["strain"] if code == 0 else None
    expect(code == 0 and abs(strain / 1.5e-4 - 1.0) < 1e-6 and "does not divide the strain" in said, f"a path to 1.5e-4 ends at {strain}: {code}\n{said}")


def check_cycles(folder):
    """Cycles turn round at their amplitude, whatever the step is; one that divides it stays."""
    for step, used, steps in ((5e-5, 5e-5, 16), (6.6e-5, 5e-5, 16), (3e-5, 2.5e-5, 32)):
        code, said = run("shear", "--grains", "60", "--path", "simple_shear", "--cycles", "2", "--amplitude", "1e-4", "--strain-step", step,
                         "--row-strain", "1e-5", "--overwrite", "--output", "cyclic", folder=folder)
        expect(code == 0 and ("does not divide the amplitude" in said) == (step != used), f"steps of {step}: ended with {code}\n{said}")
        summary = json.loads((folder / "cyclic/summary.json").read_text())
        expect(summary["steps"] == steps and abs(summary["strain_step"] - used) < 1e-15, f"steps of {step}: {summary['steps']} of {summary['strain_step']}")
        strains = [row["strain"] for row in read(folder / "cyclic/path.csv")]
        expect(all(abs(strain - end) < 1e-12 for strain, end in ((max(strains), 1e-4), (min(strains), -1e-4), (strains[-1], 0.0))),
               f"steps of {step}: turns at {min(strains)} and {max(strains)}, ends at {strains[-1]}")


def check_loose(folder):
    (folder / "loose.csv").write_text("x,y,r\n0.02,0.02,0.005\n0.06,0.06,0.005\n0.06,0.02,0.005\n")
    path = ["--cell", "0.1,0,0,0.1", "--path", "pure_shear", "--strain", "1e-3", "--strain-step", "1e-5", "--out", "x.csv"]
    code, said = run("replay", "--particles", "loose.csv", *path, folder=folder)
    expect(code == 0 and "no grains of 'loose.csv' touch" in said, f"a packing without contacts: ended with {code}\n{said}")
    (folder / "space.csv").write_text("x,y,z,r\n0.02,0.02,0.02,0.005\n0.06,0.06,0.06,0.005\n")
    code, said = run("replay", "--particles", "space.csv", *path, folder=folder)
    expect(code > 0 and "column 'z'" in said, f"grains in space: ended with {code}\n{said}")
    (folder / "mixed.csv").write_text("x,y,r,a,b,angle\n0.02,0.02,0.005,0.005,0.004,0\n0.06,0.06,0.005,0.005,0.004,0\n")
    code, said = run("replay", "--particles", "mixed.csv", *path, folder=folder)
    expect(code == 2 and "has columns r and a, b" in said, f"discs and ellipses in one table: ended with {code}\n{said}")
    code, said = run("replay", "--particles", "loose.csv", *path, "--tolerance", "1e-3", folder=folder)
    expect(code == 2 and "--tolerance is given but not used" in said, f"a tolerance without contacts: ended with {code}\n{said}")
    for more, thickness in (([], 0.2), (["--thickness", "1.5"], 1.5)):
        code, said = run("replay", "--particles", "loose.csv", *path, *more, folder=folder)
        expect(code == 0 and f"thickness {thickness} m, density 2650 kg/m3" in said, f"thickness {more}: ended with {code}\n{said}")
        expect(("--thickness is not given: 0.2 m" in said) == (not more), f"note on the thickness {more}:\n{said}")


def check_relax(folder):
    """Particles alone, without contacts, come to rest at the pressure that is requested."""
    particles = ["--particles", SUDODEM / "G_particles.csv", "--cell", "0.16663676021512222,0,0,0.16670996462691512"]
    path = ["--path", "biaxial", "--strain", "1e-3", "--strain-step", "1e-5", "--out", "relaxed.csv"]
    code, said = run("replay", *particles, *path, "--relax", "2e5", folder=folder)
    expect(code == 0, f"--relax: ended with {code}\n{said}")
    rows = read(folder / "relaxed.csv") if code == 0 else []
    for name in ("sxx", "syy"):
        expect(rows and abs(rows[0][name] / -PRESSURE - 1.0) < 2e-4, f"--relax: {name} is {rows[:1]}")
    expect(rows and abs(rows[0]["void_ratio"] - 0.17294) < 1e-3, f"--relax: void ratio of {rows[:1]}")
    for pressure in ("-1", "0", "nan", "much"):
        code, said = run("replay", *particles, *path, "--relax", pressure, folder=folder)
        expect(code > 0 and "--relax" in said, f"--relax {pressure}: ended with {code}\n{said}")


def check_round_trip(folder):
    """A prepared packing is the same from its exact file and, to the digits of the tables, from its tables."""
    code, said = run("prepare", "--shape", "ellipse", "--grains", "80", "--target-void-ratio", "0.2", "--output",
                     "made", folder=folder)
    expect(code == 0, f"prepare: ended with {code}\n{said}")
    path = ["--path", "pure_shear", "--strain", "0.002", "--strain-step", "1e-5", "--row-strain", "1e-4"]
    code, said = run("shear", "--packing", "made/packing.packing", *path, "--output", "made", folder=folder)
    expect(code == 0, f"shear: ended with {code}\n{said}")
    code, said = run("replay", "--particles", "made/packing_particles.csv", "--contacts",
                     "made/packing_contacts.csv", *path, "--out", "again.csv", folder=folder)
    expect(code == 0, f"replay of our own packing: ended with {code}\n{said}")
    exact = read(folder / "made/path.csv")
    expect(abs(exact[0]["void_ratio"] - 0.2) <= 5e-4, f"void ratio {exact[0]['void_ratio']}")
    worst = max(abs(a[name] - b[name]) for a, b in zip(exact, read(folder / "again.csv"), strict=True) for name in COMPONENTS)
    expect(worst < 1e-4 * PRESSURE, f"tables and exact file differ by {worst} Pa")
    gap = max(abs(row["energy_gap"]) for row in exact)
    expect(gap < 1e-3 * exact[-1]["work_in"], f"energies: gap {gap} J of {exact[-1]['work_in']}")


def check_other_codes(folder):
    """Discs in the forms of Yade and LAMMPS bring their cell and are the same grains as the table's."""
    disc = ["prepare", "--grains", "60"]
    for code_name in ("yade", "lammps"):
        code, said = run(*disc, "--format", code_name, "--output", code_name, folder=folder)
        expect(code == 0, f"prepare --format {code_name}: ended with {code}\n{said}")
    path = ["--path", "isotropic", "--strain", "2e-4", "--strain-step", "1e-6", "--out", "rows.csv"]
    cell = (folder / "yade/packing_cell.csv").read_text().splitlines()[1]
    rows = {}
    for file, more in (("yade/packing_particles.csv", ["--cell", cell]), ("yade/packing.txt", []), ("lammps/packing.data", [])):
        code, said = run("replay", "--particles", file, *more, *path, folder=folder)
        expect(code == 0, f"replay of {file}: ended with {code}\n{said}")
        expect(("column z is not read" in said) == (not more), f"replay of {file}: z in\n{said}")
        rows[file] = read(folder / "rows.csv")
    first, yade, lammps = rows.values()
    expect(first[-1]["n_contacts"] > 60, f"a packing without contacts: {first[-1]}")
    expect(yade == first, f"Yade's file gives other rows: {yade[-1]}, {first[-1]}")
    # LAMMPS's cell is turned: the invariants are the same at first and differ on the way by what round-off does to sliding contacts.
    for a, b, most in ((first[0], lammps[0], 1e-9), (first[-1], lammps[-1], 1e-3)):
        apart = abs(a["sxx"] + a["syy"] - b["sxx"] - b["syy"]) / PRESSURE
        expect(apart < most and a["n_contacts"] == b["n_contacts"], f"LAMMPS's file gives another row: {b}, {a}")
    code, said = run(*disc, "--seed", "2", "--overwrite", "--output", "yade", folder=folder)
    expect(code == 0 and not (folder / "yade/packing.txt").exists(), f"the file for Yade is that of another packing: {said}")
    code, said = run("prepare", "--shape", "ellipse", "--format", "yade", "--output", "none", folder=folder)
    expect(code > 0 and "--format" in said, f"ellipses for Yade: ended with {code}\n{said}")


def check_refusals(folder):
    def refused(title, named, *arguments):
        before = sorted(folder.rglob("*"))
        code, said = run(*arguments, folder=folder)
        expect(code == 2 and named in said, f"{title}: ended with {code}\n{said}")
        expect(sorted(folder.rglob("*")) == before, f"{title}: files have changed")

    good = ["--path", "pure_shear", "--strain", "1e-4", "--strain-step", "1e-6", "--out", "none.csv"]
    particles = INPUT[:2]
    refused("no cell", "--cell", "replay", *particles, *good)
    refused("NaN in the cell", "nan", "replay", *particles, "--cell", "1,nan,0,1", *good)
    refused("left-handed cell", "right-handed", "replay", *particles, "--cell", "0,1,1,0", *good)
    refused("no file", "nowhere.csv", "replay", *particles, "--contacts", "nowhere.csv", *good)
    refused("unknown path", "sideways", "replay", *particles, "--path", "sideways", *good[2:])
    refused("negative strain", "--strain", "replay", *particles, *good[:2], "--strain", "-1", *good[4:])
    refused("NaN strain", "--strain", "replay", *particles, *good[:2], "--strain", "nan", *good[4:])
    lines = (YADE / "particles.csv").read_text().splitlines()
    (folder / "bad.csv").write_text("\n".join([*lines[:4], "3,0.1,wide,0.005", *lines[5:]]) + "\n")
    refused("text for a number", "line 5 of 'bad.csv'", "replay", "--particles", "bad.csv", "--cell", CELL, *good)
    refused("input as output", "written over", "replay", "--particles", "bad.csv", "--cell", CELL, *good[:6],
            "--out", "bad.csv")
    contacts = (YADE / "contacts.csv").read_text().splitlines()
    mixed = [contacts[0] + ",kn"] + [line + ",6e6" for line in contacts[1:-1]] + [contacts[-1] + ",7e6"]
    (folder / "mixed.csv").write_text("\n".join(mixed) + "\n")
    refused("two stiffnesses", "column 'kn'", "replay", *particles, "--contacts", "mixed.csv", *good)
    shear = [",".join("fty" if name == "ftx" else "of_no_use" if name == "fty" else name for name in contacts[0].split(",")), *contacts[1:]]
    (folder / "shear.csv").write_text("\n".join(shear) + "\n")
    refused("fty without ftx", "ftx", "replay", *particles, "--contacts", "shear.csv", *good)
    refused("no packing", "nowhere.packing", "shear", "--packing", "nowhere.packing", "--output", "none")
    refused("unreachable void ratio", "is not reached", "prepare", "--grains", "60", "--target-void-ratio", "0.05",
            "--output", "none")
    refused("law that is not built", "not built", "prepare", "--shape", "ellipse", "--law", "hertz", "--output", "none")


def check_early_end(folder):
    """A packing that is crushed ends the program with its reason, and the rows so far stay."""
    path = ["--grains", "60", "--path", "isotropic", "--strain-step", "1e-3", "--output", "crushed"]
    code, said = run("shear", *path, "--strain", "0.002", folder=folder)
    expect(code == 0 and (folder / "crushed/end.packing").is_file(), f"a packing that is compressed: ended with {code}\n{said}")
    code, said = run("shear", *path, "--strain", "2", "--overwrite", folder=folder)
    left = sorted(file.name for file in (folder / "crushed").iterdir() if file.name.startswith(("end", "peak", "summary")))
    expect(not left, f"results of an older run beside those of one that failed: {left}")
    expect(code == 1 and "too_deep" in said, f"crushed packing: ended with {code}\n{said}")
    expect(len(read(folder / "crushed/path.csv")) > 1, "crushed packing: its rows are gone")


if not LAB.is_file():
    print(f"skipped: there is no '{LAB}' (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
for check in (check_paths, check_cell, check_held_stress, check_other_stress, check_lengths, check_cycles, check_loose, check_relax, check_round_trip, check_other_codes, check_refusals, check_early_end):
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        check(pathlib.Path(scratch))
    print(f"{check.__name__}: {time.monotonic() - started:.1f} s")
finish()
