# SPDX-License-Identifier: BSL-1.0
"""Bad input to the example programs gets a message and a non-zero exit, and destroys nothing; a run that is
stopped leaves whole files. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

programs = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve()
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
FAULT = programs / "fault_rupture"
BIAXIAL = programs / "rve_biaxial"  # where it is built
PROGRAMS = [program for program in (FAULT, BIAXIAL) if program.is_file()]
TINY = {"--size": "12", "--grains": "49", "--throw-over-depth": "0.002"}
TINY_BIAXIAL = {"--grains": "60", "--seeds": "1", "--strain": "0.01", "--smoothing": "0.005"}


def run(program, *arguments, folder):
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout + done.stderr


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def old_results(folder):
    """An output folder of an earlier run: names that a new run would write, and one of the user's own."""
    (folder / "fields").mkdir(parents=True)
    for name in ("fields/step_0000.vtu", "fields.pvd", "surface.csv", "probe_A.csv", "probe_B.csv", "convergence.csv",
                 "convergence.jsonl", "packing_grains.csv", "summary.json", "summary.txt", "biaxial.csv", "notes.txt"):
        (folder / name).write_text(f"old {name}\n")


def command(*options):
    """Later options replace earlier ones: the programs refuse one that is given twice."""
    merged = {}
    for given in options:
        merged.update(given)
    return [word for option, value in merged.items() for word in ([option, value] if value is not None else [option])]


def check_refusal(program, title, option, value, named, files=None, without=(), also=()):
    """The program must end with an error that names what is wrong, before it touches the output folder."""
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        old_results(scratch / "out")
        for name, text in (files or {}).items():
            (scratch / name).write_text(text)
        before = contents(scratch)
        tiny = {"--quick": None, **TINY} if program == FAULT else TINY_BIAXIAL
        if files:
            tiny = {name: given for name, given in tiny.items() if name != "--grains"}
        tiny = {**{name: given for name, given in tiny.items() if name not in without}, **dict(also)}
        code, said = run(program, *command(tiny, {"--output": "out", "--overwrite": None}, {option: value}), folder=scratch)
        what = f"{program.name}, {title}"
        expect(code > 0, f"{what}: ended with {code}\n{said}")
        expect(named in said, f"{what}: the message does not name {named}\n{said}")
        expect(contents(scratch) == before, f"{what}: files have changed")


def check_bad_input():
    for program in PROGRAMS:
        check_refusal(program, "unknown option", "--wings", "2", "--wings")
        check_refusal(program, "zero grains", "--grains", "0", "--grains")
        check_refusal(program, "text for a number", "--grains", "many", "--grains")
        check_refusal(program, "number with a zero before it", "--grains", "0100", "--grains")
        check_refusal(program, "seed with a zero before it", "--seed", "010", "--seed")
        check_refusal(program, "number with a tail", "--strain-per-dem-step", "1e-5m", "--strain-per-dem-step")
        check_refusal(program, "NaN", "--strain-per-dem-step", "nan", "--strain-per-dem-step")
        check_refusal(program, "infinity", "--strain-per-dem-step", "inf", "--strain-per-dem-step")
        check_refusal(program, "a step below round-off", "--strain-per-dem-step", "1e-300", "--strain-per-dem-step")
        check_refusal(program, "missing value", "--preparation-friction", None, "--preparation-friction")
        check_refusal(program, "folder below a file", "--output", "out/notes.txt/deep/out", "--output")
        check_refusal(program, "file as folder", "--output", "out/notes.txt", "--output")
        check_refusal(program, "empty folder name", "--output", "", "--output")
        check_refusal(program, "missing config file", "--config", "none.ini", "none.ini")
        for title, text, named in (("unknown key", "wings = 2\n", "wings"), ("bad value", "grains = -5\n", "grains"),
                                   ("text for a number", "grains = many\n", "grains"),
                                   ("no lines", "# nothing yet\n", "has no options"),
                                   ("section", "[ground]\ngrains = 50\n", "'ground' is no section"),
                                   ("dotted key", "sand.grains = 50\n", "'sand' is no section"),
                                   ("no options at all", "\x01\x02 [[[ = = ]]\n<xml>\n", "[[[")):
            check_refusal(program, f"{title} in the config file", "--config", "c.ini", named, {"c.ini": text})
    check_refusal(FAULT, "negative size", "--size", "-1", "--size")
    check_refusal(FAULT, "NaN size", "--size", "nan", "--size")
    check_refusal(FAULT, "dip beyond the vertical", "--dip", "91", "--dip")
    check_refusal(FAULT, "unknown case", "--case", "middling", "--case")
    check_refusal(FAULT, "unknown soil", "--soil", "cheese", "--soil")
    check_refusal(FAULT, "unknown footing", "--footing", "flying", "--footing")
    for option in ("--tolerance", "--max-displacement-gradient", "--unbalanced-tolerance", "--throw-over-depth"):
        check_refusal(FAULT, f"{option} below round-off", option, "1e-300", option)
    check_refusal(FAULT, "negative bearing pressure", "--bearing-pressure", "-1", "--bearing-pressure")
    check_refusal(FAULT, "a footing that no soil bears", "--bearing-pressure", "2e7", "--bearing-pressure")
    for friction in ("0", "1e-12"):
        check_refusal(FAULT, "a footing that nothing holds", "--base-friction", friction, "--base-friction is",
                      also={"--case": "heavy", "--footing": "frictional", "--soil": "mohr_coulomb"})
    check_refusal(FAULT, "a footing in kilopascals", "--bearing-pressure", "91", "--bearing-pressure is 91 Pa", also={"--case": "heavy"})
    check_refusal(FAULT, "a modulus in megapascals", "--young-modulus", "25", "--young-modulus is 25 Pa", also={"--soil": "elastic"})
    check_refusal(FAULT, "ground that carried less", "--overconsolidation-ratio", "0.9", "--overconsolidation-ratio")
    check_refusal(FAULT, "grains wider than long", "--grain-aspect", "1.2", "--grain-aspect")
    check_refusal(FAULT, "NaN width of grains", "--grain-aspect", "nan", "--grain-aspect")
    check_refusal(FAULT, "negative friction of grains", "--grain-friction", "-0.1", "--grain-friction")
    check_refusal(FAULT, "a vertical friction angle", "--peak-friction-angle", "90", "--peak-friction-angle")
    check_refusal(FAULT, "softening at once", "--softening-strain", "0", "--softening-strain")
    check_refusal(FAULT, "a soil without stiffness", "--young-modulus", "0", "--young-modulus")
    check_refusal(FAULT, "a negative K0", "--k0", "-0.4", "--k0")
    on_mohr_coulomb = {"--soil": "mohr_coulomb"}
    check_refusal(FAULT, "more dilation than friction", "--peak-dilation-angle", "35", "--peak-dilation-angle 35", also=on_mohr_coulomb)
    check_refusal(FAULT, "a soil that hardens", "--residual-friction-angle", "35", "--residual-friction-angle 35", also=on_mohr_coulomb)
    check_refusal(FAULT, "negative threads", "--threads", "-2", "--threads")
    check_refusal(FAULT, "a value for a flag", "--quick=false", None, "quick was given", without=["--quick"])
    check_refusal(FAULT, "two sizes at once", "--study", None, "--study")
    check_refusal(FAULT, "a length and none", "--study", None, "--local excludes --study", without=["--quick"], also={"--local": None})
    # These pass the command line; the scene refuses them.
    fixed = {"--left": "-52"}  # without it the ground goes with the tip
    check_refusal(FAULT, "tip outside the domain", "--tip", "100", "fault tip is at x = 100 m", also=fixed)
    check_refusal(FAULT, "tip close to the side", "--tip", "22.9", "22.9", also=fixed)
    check_refusal(FAULT, "a tip whose digits are gone", "--tip", "1e12", "--tip")
    check_refusal(FAULT, "a mean over more than the ground", "--length", "200", "25 m deep")
    check_refusal(FAULT, "kilonewtons", "--unit-weight", "16", "--unit-weight")
    check_refusal(FAULT, "ground without depth", "--depth", "0", "--depth")
    check_refusal(FAULT, "a ground to the left of its fault", "--width", "50", "fault tip is at x = 0 m")
    check_refusal(FAULT, "a single grain", "--grains", "1", "fault_rupture: ")
    check_refusal(FAULT, "an element of another program", "--element", "quad8", "compiled for tri3")
    check_refusal(FAULT, "an unknown pattern", "--pattern", "zigzag", "--pattern")
    check_refusal(FAULT, "whole rectangles of triangles", "--pattern", "quads", "quads")
    check_refusal(FAULT, "a mesh that is not there", "--mesh", "none.msh", "none.msh")
    mesh = (REPOSITORY / "examples/fault_rupture/meshes/unstructured.msh").read_text()
    for title, changed, named in (("a mesh without a surface", mesh.replace('"surface"', '"top"'), "surface"),
                                  ("a mesh without soil", mesh.replace('"soil"', '"rock"'), "soil"),
                                  ("a mesh that is cut off", mesh[:len(mesh) // 2], "m.msh")):
        check_refusal(FAULT, title, "--mesh", "m.msh", named, {"m.msh": changed}, {"--size"})
    check_refusal(FAULT, "a size of a file's elements", "--mesh", "m.msh", "without --strip-width", {"m.msh": mesh})
    check_refusal(FAULT, "a file beside a layer", "--mesh", "m.msh", "excludes --mesh", {"m.msh": mesh}, {"--size"}, {"--depth": "20"})
    check_refusal(FAULT, "a file without a node at the tip", "--tip", "0.3", "put a node there", {"m.msh": mesh},
                  {"--size"}, {"--mesh": "m.msh"})


def check_bad_biaxial():
    check_refusal(BIAXIAL, "a window wider than the test", "--smoothing", "0.05", "window")
    for title, value, named in (("negative friction in a list", "0.1,-1", "'-1' is out of range"),
                                ("text for a friction", "a", "'a' is out of range"),
                                ("text in a list", "0.1,b", "'b' is out of range"),
                                ("NaN in a list", "nan,0.1", "'nan' is out of range"),
                                ("a list that starts with nothing", ",0.1", "--preparation-friction"),
                                ("a hole in a list", "0.1,,0.2", "--preparation-friction"),
                                ("a friction twice", "0.1,0.2,0.1", "preparation friction 0.1 is given twice")):
        check_refusal(BIAXIAL, title, "--preparation-friction", value, named)
    check_refusal(BIAXIAL, "a bad list in the config file", "--config", "c.ini", "'-1' is out of range",
                  {"c.ini": "preparation-friction = 0.1,-1\n"})


def check_help():
    for program in PROGRAMS:
        with tempfile.TemporaryDirectory() as scratch:
            code, said = run(program, "--help", folder=scratch)
            expect(code == 0 and "--grains" in said, f"{program.name} --help ended with {code}\n{said}")
            expect(not list(pathlib.Path(scratch).iterdir()), f"{program.name} --help wrote files")


def check_warnings():
    """What runs and says little is told before it runs."""
    for title, given, told in (("a handful of grains", {"--grains": "9"}, "no sample of the sand"),
                               ("a length below the mesh's", {"--length": "0.1", "--soil": "mohr_coulomb"}, "reaches no neighbour"),
                               ("grains of a soil without", {"--soil": "mohr_coulomb"}, "--grains has no effect"),
                               ("a footing of the free field", {"--soil": "mohr_coulomb", "--footing-width": "8"}, "--footing-width has no effect"),
                               ("a rupture near the side", {"--soil": "mohr_coulomb", "--dip": "30"}, "from an end of the ground"),
                               ("a bound of packings", {"--soil": "mohr_coulomb", "--budget": "volume=0"}, "--budget volume=0 has no effect"),
                               ("a bound of water", {"--soil": "mohr_coulomb", "--budget": "water=1e-9"}, "--budget water=1e-9 has no effect"),
                               ("a mesh too coarse for a length", {"--soil": "mohr_coulomb", "--length": "20"}, "needs elements of at most 8.2 m"),
                               ("a length", {"--length": "20", "--grains": "64", "--size": "8"}, None)):
        with tempfile.TemporaryDirectory() as scratch:
            code, said = run(FAULT, "--quick", *command(TINY, given), "--output", "out", folder=scratch)
            expect(code == 0, f"{title}: ended with {code}\n{said}")
            expect(told in said if told else "warning" not in said, f"{title}: said\n{said}")
    check_refusal(FAULT, "negative length", "--length", "-1", "--length")
    check_refusal(FAULT, "NaN length", "--length", "nan", "--length")
    check_refusal(FAULT, "strip of negative width", "--strip-width", "-1", "--strip-width")


def check_no_balance():
    """A run that ends before the fault moves names the options of the ground at rest."""
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        code, said = run(FAULT, "--quick", "--soil", "elastic", "--max-iterations", "1", "--output", "out", folder=scratch)
        expect(code == 3, f"ground without balance: ended with {code}\n{said}")
        told = (scratch / "out" / "summary.txt").read_text()
        expect(re.search("no balance before the fault moved: .*--unit-weight.*--young-modulus", told), f"ground without balance: {told}")


def check_materials():
    """Each property of the soil changes the answer; its default, given, does not."""
    sand = {"--throw-over-depth": "0.001"}
    plain = {"--soil": "mohr_coulomb", "--throw-over-depth": "0.02"}
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)

        def surface(name, *given):
            code, said = run(FAULT, "--quick", *command(TINY, *given), "--output", name, folder=scratch)
            expect(code == 0, f"{given}: ended with {code}\n{said}")
            return (scratch / name / "surface.csv").read_text() if code == 0 else ""

        for soil, options in ((sand, {"--grain-aspect": ("0.75", "0.6"), "--grain-friction": ("0.55", "0.3"), "--overconsolidation-ratio": ("1.25", "1.3")}),
                              (plain, {"--peak-friction-angle": ("30.8", "35"), "--peak-dilation-angle": ("6.6", "3"), "--residual-friction-angle": (None, "20"),
                                       "--softening-strain": ("0.15", "0.02"), "--young-modulus": ("25e6", "10e6"), "--k0": ("0.4", "0.6")})):
            usual = surface(f"usual{len(options)}", soil)
            given = {option: values[0] for option, values in options.items() if values[0] is not None}
            expect(surface(f"given{len(options)}", soil, given) == usual, f"{given} are not the defaults")
            for option, (_, other) in options.items():
                expect(surface(option.strip("-"), soil, {option: other}) != usual, f"{option} {other} changes nothing")


def check_mesh_file():
    """A rupture in a mesh from a file, of a reverse fault: the hanging wall comes up."""
    with tempfile.TemporaryDirectory() as scratch:
        code, said = run(FAULT, "--soil", "mohr_coulomb", "--mesh",
                         REPOSITORY / "examples/fault_rupture/meshes/unstructured.msh", "--reverse",
                         "--throw-over-depth", "0.002", "--output", "out", folder=scratch)
        expect(code == 0, f"--mesh: ended with {code}\n{said}")
        if code == 0:
            with open(pathlib.Path(scratch) / "out/surface.csv", newline="") as table:
                last = list(csv.DictReader(table))[-1]
            expect(abs(float(last["settlement"]) + 0.002 * 25.0) < 1e-6, f"--reverse: the far side settled by {last}")


def check_config():
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "c.ini").write_text("grains = 49\nseed = 2\nsize = 12\nthrow-over-depth = 0.001\n")
        code, said = run(FAULT, "--quick", "--config", "c.ini", "--grains", "36", "--output", "out", folder=scratch)
        expect(code == 0, f"a config file: ended with {code}\n{said}")
        if code == 0:
            summary = json.loads((scratch / "out/summary.json").read_text())
            expect(summary["seed"] == 2, "the config file does not set an option")
            expect(summary["grains_per_rve"] == 36, "the command line does not override the config file")
            expect(abs(summary["throw_over_depth"] - 0.001) < 1e-9, "the config file does not set the throw")


def check_marked():
    """run.json has the default of an option beside what was given, so that the page of the run marks it."""
    given = {"--depth": "20", "--left": "-40", "--width": "58", "--probe-a-x": "-3", "--probe-a-y": "5", "--probe-b-x": "-15",
             "--probe-b-y": "9", "--case": "light", "--footing-centre": "-8", "--soil": "mohr_coulomb", "--throw-over-depth": "0.001"}
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "own.sand").write_text("shape = ellipse\nfriction = 0.5\n")
        sand = {"--sand": "own.sand", "--grains": "49", "--size": "12", "--throw-over-depth": "0.0005"}
        for name, options in (("site", given), ("sand", sand)):
            code, said = run(FAULT, "--quick", *command(options), "--output", name, folder=scratch)
            expect(code == 0, f"{options}: ended with {code}\n{said}")
            record = json.loads((scratch / name / "run.json").read_text())
            alike = [option for option, value in options.items() if record["defaults"][option[2:]] == value]
            expect(not alike, f"{name}: {alike} have what was given as their default")
            expect(all(record["options"][option[2:]] == value for option, value in options.items()), f"{name}: {record['options']}")


def check_renamed():
    """Options, values and keys by their names before version 0.2 still work, on the command line with a warning and in a file."""
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "old.ini").write_text("soil = mohr_coulomb\nlength = 8\ncase = light\nfooting = sticking\npeak-friction = 33\nthrow-over-depth = 0.0005\n")
        code, said = run(FAULT, "--config", "old.ini", "--triangles", "220", "--most-iterations=40", "--output", "old", folder=scratch)
        expect(code == 0, f"options of before: ended with {code}\n{said}")
        for warning in ("--triangles is now --elements", "--most-iterations is now --max-iterations", "--peak-friction is now --peak-friction-angle",
                        "--footing sticking is now --footing tied"):
            expect(warning in said, f"no warning that {warning}\n{said}")
        new = ["--soil", "mohr_coulomb", "--length", "8", "--case", "light", "--footing", "tied", "--peak-friction-angle", "33",
               "--throw-over-depth", "0.0005", "--elements", "220", "--max-iterations", "40"]
        code, said = run(FAULT, *new, "--output", "new", folder=scratch)
        expect(code == 0 and "is now" not in said, f"options of today: ended with {code}\n{said}")
        if code == 0:
            old, now = (json.loads((scratch / name / "summary.json").read_text()) for name in ("old", "new"))
            expect(old["run"]["options"]["max-iterations"] == "40", "an option is not recorded by its present name")
            for name in ("surface_x50", "rejected_steps", "contact_share"):
                expect(old[name] == now[name], f"{name} differs: {old[name]} and {now[name]}")
            expect(now["pressed_share"] == now["contact_share"], "summary.json has no key of before")


def check_list():
    """Every friction with every seed, in order, the same as each friction by itself."""
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        tiny = command(TINY_BIAXIAL, {"--seeds": "2"})
        (scratch / "c.ini").write_text("preparation-friction = 0.1,0.3\n")
        rows = {}
        for name, given in (("0.1", ["--preparation-friction", "0.1"]), ("0.3", ["--preparation-friction", "0.3"]),
                            ("list", ["--preparation-friction", "0.1,0.3"]), ("file", ["--config", "c.ini"])):
            code, said = run(BIAXIAL, *tiny, *given, "--output", name, folder=scratch)
            expect(code == 0, f"frictions {given}: ended with {code}\n{said}")
            rows[name] = (scratch / name / "biaxial.csv").read_text().splitlines(keepends=True) if code == 0 else [""]
        expect(rows["list"] == rows["0.1"] + rows["0.3"][1:], "a list of frictions is not each of them in turn")
        expect(rows["list"] == rows["file"], "a list of frictions from a config file is another one")
        summary = json.loads((scratch / "list/summary.json").read_text())
        told = [entry["preparation_friction"] for entry in summary["preparation_frictions"]]
        expect(told == [0.1, 0.3], f"summary.json tells of the frictions {told}")
        expect(summary["over_void_ratio"], "summary.json holds no line over the void ratio")


def check_stopped(title, code, said, folder):
    expect(code == 130, f"{title}: ended with {code} instead of 130\n{said[-2000:]}")
    summary = json.loads((folder / "summary.json").read_text())
    expect(summary["status"] == "interrupted", f"{title}: summary.json says {summary['status']}")
    expect(0.0 < summary["throw_over_depth"] < 1.0, f"{title}: stopped at h/H = {summary['throw_over_depth']}")
    expect("INCOMPLETE" in (folder / "summary.txt").read_text(), f"{title}: summary.txt does not say so")
    listed = [entry.get("file") for entry in xml.parse(folder / "fields.pvd").iter("DataSet")]
    expect(len(listed) > 1, f"{title}: {len(listed)} files in fields.pvd")
    for name in listed:
        expect(xml.parse(folder / name).getroot().tag == "VTKFile", f"{title}: {name} is no VTK file")
    expect({f"fields/{path.name}" for path in (folder / "fields").iterdir()} == set(listed),
           f"{title}: fields/ holds other files than fields.pvd lists")
    for table in ("surface.csv", "convergence.csv", "probe_A.csv"):
        lines = (folder / table).read_text().splitlines(keepends=True)
        expect(len(lines) > 1 and lines[-1].endswith("\n"), f"{title}: the last row of {table} is cut off")
    log = [json.loads(line) for line in (folder / "convergence.jsonl").read_text().splitlines()]
    elements = summary["elements"]
    for line in log:
        if line["kind"] == "iteration":
            expect(sum(line["points"].values()) == elements, f"{title}: convergence.jsonl counts {line['points']}")
    steps = sum(line["kind"] == "step" and line["accepted"] for line in log)
    expect(steps == summary["steps"], f"{title}: convergence.jsonl has {steps} accepted steps")


LONG = ["--quick", "--size", "12", "--grains", "49", "--throw-over-depth", "1", "--frames", "100000", "--output", "out"]


def check_interrupt():
    for stop in (signal.SIGINT, signal.SIGTERM):
        with tempfile.TemporaryDirectory() as scratch:
            process = subprocess.Popen([FAULT, *LONG], cwd=scratch, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                       text=True)
            said = ""
            steps = 0
            for line in process.stderr:
                said += line
                steps += len(re.findall(r"^step +\d+ +throw_over_depth", line))
                if steps == 4:
                    process.send_signal(stop)
                    break
            sent = time.monotonic()
            try:
                said += process.communicate(timeout=30)[1]
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                expect(False, f"{stop.name}: still running after 30 s")
                continue
            expect(steps == 4, f"{stop.name}: the run ended by itself\n{said}")
            check_stopped(f"{stop.name} after {time.monotonic() - sent:.1f} s", process.returncode, said,
                          pathlib.Path(scratch) / "out")


def check_time_limit():
    with tempfile.TemporaryDirectory() as scratch:
        code, said = run(FAULT, *LONG, "--time-limit", "1", folder=scratch)
        check_stopped("--time-limit", code, said, pathlib.Path(scratch) / "out")


def check_repeat():
    """A shorter run that may overwrite replaces the older one's series and keeps the user's own files."""
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        old_results(scratch / "out")
        (scratch / "out/fields/step_9999.vtu").write_text("of an older, longer run")
        code, said = run(FAULT, "--quick", *command(TINY), "--frames", "2", "--output", "out", "--overwrite",
                         folder=scratch)
        expect(code == 0, f"a second run: ended with {code}\n{said}")
        listed = [entry.get("file") for entry in xml.parse(scratch / "out/fields.pvd").iter("DataSet")]
        expect({f"fields/{path.name}" for path in (scratch / "out/fields").iterdir()} == set(listed),
               "a second run: files of the older series are left")
        expect((scratch / "out/notes.txt").read_text() == "old notes.txt\n", "a second run: the user's file is gone")


if not FAULT.is_file():
    print(f"skipped: no programs in {programs} (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
checks = [check_help, check_bad_input, check_warnings, check_no_balance, check_materials, check_mesh_file, check_config, check_marked, check_renamed, check_repeat,
          check_time_limit, check_interrupt]
for check in checks + [check_bad_biaxial, check_list] * BIAXIAL.is_file():
    started = time.monotonic()
    check()
    print(f"{check.__name__}: {time.monotonic() - started:.1f} s")
finish()
