# SPDX-License-Identifier: BSL-1.0
"""The fault scene and the laboratory from Python have the command line's bytes, are not run twice, resume after Ctrl-C, and reject in words.
Environment: SCARP_EXAMPLES, the folder of the programs, beside which the module is (skipped, exit 77, without)."""
import doctest
import functools
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import warnings

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish, leave_out, python_module, rejected

FAULT, LAB = example("fault_rupture"), example("rve_lab")
module = python_module()
import numpy as np
import scarp
from scarp import program_options, programs

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A sixth of a second, of the same program as packings.
SOIL = {"quick": True, "soil": "mohr_coulomb", "frames": 2}
WORDS = ["--quick", "--soil", "mohr_coulomb", "--frames", "2"]
# What a run takes, and where it lies.
OF_THE_MOMENT = ("cpu_seconds", "wall_seconds", "peak_memory_bytes", "run", "share_of_time_in_points", "share_of_time_outside_points", "share_of_time_in_rves",
                 "share_of_time_outside_rves", "seconds")


def by_command(program, folder, *words):
    done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, timeout=200)
    expect(done.returncode == 0, f"{words} ended with {done.returncode}: {done.stderr}")


def measures(folder):
    return {key: value for key, value in json.loads((folder / "summary.json").read_text()).items() if key not in OF_THE_MOMENT}


def same_bytes(one, other, *names):
    for name in names:
        expect((one / name).read_bytes() == (other / name).read_bytes(), f"{name} of Python differs from that of the command line")


def changed(path):
    return path.stat().st_mtime_ns


def check_options(folder):
    """Every option that a run's record has is known, with its default."""
    for name, command, record in (("fault_rupture", "", folder / "command/run.json"), ("rve_lab", "shear", folder / "lab/run_shear.json")):
        recorded, known = json.loads(record.read_text())["defaults"], scarp.options(name, command)
        expect({option.name for option in known.values()} == set(recorded), f"options {set(recorded) ^ {option.name for option in known.values()}}")
        for key in ("dip", "frames", "strain-step", "path"):
            expect(key not in known or known[key].default == recorded[key], f"the default of {key} is {known.get(key)}")
    expect(scarp.options("fault_rupture")["dip"].text == "of the fault [degrees]", "the meaning of --dip is lost")
    words = program_options.given("fault_rupture", {"left": np.float64(-52.5), "seeds": [1, 2], "budget": {"residual": 1e-3, "work_gap": 0.1}, "quick": np.True_,
                                                    "local": False, "mirrored_packings": True, "sand": None, "frames": np.int64(3)})
    expect(program_options.command_line(words) == ["--left=-52.5", "--seeds=1,2", "--budget=residual=0.001", "--budget=work_gap=0.1", "--quick",
                                                   "--mirrored-packings=yes", "--frames=3"], f"words {words}")
    words = program_options.given("rve_lab", {"free": {"friction": (0.3, 0.9), "modulus": None}, "table": ["a.csv", pathlib.Path("b.csv")],
                                              "sieve": [(0.002, 0), (0.004, 100)], "held_stress": 1e5}, "calibrate")
    expect(program_options.command_line(words) == ["--free=friction=0.3:0.9,modulus", "--table=a.csv", "--table=b.csv", "--sieve=0.002 0,0.004 100",
                                                   "--lateral-stress=100000.0"], f"words {words}")


def check_refusals(folder):
    run = functools.partial(scarp.fault_rupture, folder / "refused")
    rejected(ValueError, "no option lenght (near are length", lambda: run(lenght=2.0))
    rejected(ValueError, "there are folder, overwrite, progress, and of the program aspect,", lambda: run(output="x"))
    rejected(ValueError, "--dip: '95.0' is out of range (it must be a number from 1 and at most 90)", lambda: run(dip=95.0))
    rejected(ValueError, "'nan' is out of range", lambda: run(dip=float("nan")))
    rejected(TypeError, "quick is 1 (expected is True or False)", lambda: run(quick=1))
    rejected(TypeError, "dip is True (expected is a value like 60)", lambda: run(dip=True))
    rejected(TypeError, "progress is 3 (expected is a function of a line", lambda: run(quick=True, progress=3))
    rejected(ValueError, "no option folder (there are aspect", lambda: scarp.fault_estimate(folder="x"))
    for values in (60, "60", []):
        rejected(TypeError, f"over has dip={values!r} (expected is a sequence", lambda: scarp.study(scarp.fault_rupture, {"dip": values}, folder / "refused"))
    rejected(TypeError, "an option is <object", lambda: run(dip=object()))
    rejected(ValueError, "no program has both", lambda: run(element="tri6", device="cuda"))
    rejected(ValueError, "no program has both", lambda: run(water_table=0, device="cuda"))
    rejected(ValueError, "the command is 'biaxial' (expected is one of prepare, shear", lambda: scarp.rve_lab("biaxial", folder))
    rejected(ValueError, "expected is that of a run", lambda: scarp.FaultRun(folder / "nowhere"))
    expect(not (folder / "refused").exists(), "a run that is rejected leaves a folder")
    # Two iterations more than none: no balance is found, and the run stops.
    rejected(RuntimeError, "INCOMPLETE: stopped at h/H", lambda: scarp.fault_rupture(folder / "stopped", max_iterations=1, tolerance=1e-13, **SOIL))
    expect(not scarp.FaultRun(folder / "stopped").finished, "a run that stopped early has finished")
    before = os.environ.get("SCARP_PROGRAMS")
    os.environ["SCARP_PROGRAMS"] = str(folder)
    broken = folder / "fault_rupture_tri6"
    broken.write_text("#!/bin/sh\necho no such instruction >&2; exit 3\n")
    broken.chmod(0o755)
    rejected(RuntimeError, "ended with 3 (no such instruction): build the program for this machine", lambda: run(element="tri6"))
    rejected(FileNotFoundError, "build it by './examples/run fault_rupture --element quad8 --help'", lambda: run(element="quad8"))
    rejected(FileNotFoundError, "build it by './examples/run fault_rupture --water-table 0 --element quad8 --help'",
             lambda: run(water_table=0, element="quad8"))
    del os.environ["SCARP_PROGRAMS"]
    if before:
        os.environ["SCARP_PROGRAMS"] = before
    rejected(ValueError, "another name of", lambda: program_options.given("rve_lab", {"held_stress": 1e5, "lateral_stress": 3e5}, "shear"))
    for empty in ("", []):
        rejected(ValueError, "a value is expected", lambda: program_options.given("fault_rupture", {"seeds": empty}))
    code = program_options.given("fault_rupture", {"quick": True})
    rejected(ZeroDivisionError, "division", lambda: programs.run("fault_rupture", [*program_options.command_line(code), f"--output={folder / 'told'}"],
                                                                lambda line: 1 / 0))


def check_scene(folder):
    by_command(FAULT, folder, *WORDS, "--output", "command")
    told = []
    run = scarp.fault_rupture(folder / "scene", progress=told.append, **SOIL)
    same_bytes(run.folder, folder / "command", "surface.csv", "probe_A.csv", "fields/step_0001.vtu")
    expect(measures(run.folder) == measures(folder / "command"), "measures of Python differ from those of the command line")
    expect(run.finished and run.within_budget and any("step    1" in line for line in told), f"{run}, {len(told)} lines")
    expect(run.summary.surface_x50 == json.loads((folder / "command/summary.json").read_text())["surface_x50"], "the summary has another x50")
    expect(set(run.error_budget) >= {"residual", "work_gap"} and run.error_budget.residual.value < run.error_budget.residual.bound, f"{run.error_budget}")
    # The surface at rest does not settle, and the throw of 0.085 of 25 m passes below the hanging wall.
    last = run.surface.throw_over_depth == run.surface["throw_over_depth"].max()
    expect(np.abs(run.surface.settlement[run.surface.throw_over_depth == 0.0]).max() == 0.0, "the surface settles at rest")
    expect(abs(run.surface.settlement[last].max() / (0.085 * 25.0) - 1.0) < 0.05, f"{run.surface.settlement[last].max()} m of settlement")
    expect(set(run.probes) == {"A", "B"} and len(run.probes["A"].q) == run.summary.steps, "the probes have other rows than load steps")
    expect(len(run.fields) == 3 and all(path.is_file() for path in run.fields) and not run.grains, f"{run.fields}")
    rejected(AttributeError, "there is no x51 (there are", lambda: run.surface.x51)
    rejected(FileNotFoundError, "footing.csv", lambda: run.footing)
    moment = changed(run.folder / "run.json")
    scarp.fault_rupture(folder / "scene", **{**SOIL, "frames": 2.0, "threads": 1, "dip": None})
    expect(changed(run.folder / "run.json") == moment, "a finished run with the same options is run again")
    rejected(ValueError, "it is of another scene ('dip = 60' there, 'dip = 50' here)", lambda: scarp.fault_rupture(folder / "scene", dip=50, **SOIL))
    rejected(ValueError, "out of range", lambda: scarp.fault_rupture(folder / "scene", dip=950, overwrite=True, **SOIL))
    expect(list((folder / "scene/checkpoints").iterdir()) and changed(run.folder / "run.json") == moment, "a rejected run has changed the one that was there")
    steeper = scarp.fault_rupture(folder / "scene", dip=50, overwrite=True, **SOIL)
    saved = [path.name for path in steeper.folder.glob("checkpoints*")]
    expect(steeper.record.options["dip"] == "50" and saved == ["checkpoints_2"], f"a run was not replaced, {saved}")
    scarp.fault_rupture(folder / "first", overwrite=True, **SOIL)
    expect(list((folder / "first/checkpoints").iterdir()), "a run that replaces nothing has lost its checkpoints")
    # Where a run saved itself is known from its record, also when its folder was moved; bounds of the budget change no state.
    (folder / "scene").rename(folder / "moved")
    expect(scarp.fault_rupture(folder / "moved", dip=50, budget={"residual": 0.5}, **SOIL).error_budget.residual.bound == 0.5, "another bound is not taken")
    by_command(FAULT, folder, *WORDS, "--output", "own", "--checkpoint", "states")
    told.clear()
    scarp.fault_rupture(folder / "own", budget={"residual": 0.5}, progress=told.append, **SOIL)
    expect(any("resuming from" in line for line in told) and not (folder / "own/checkpoints").exists(), "a run of the command line is not resumed")
    try:
        import pandas
        expect(isinstance(run.surface.table(), pandas.DataFrame), "no table of pandas")
    except ImportError:
        rejected(RuntimeError, "pandas is not installed", run.surface.table)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        estimate = scarp.fault_estimate(**SOIL, grains=50)
    expect(estimate.elements == run.summary.elements and estimate.cpu_seconds > 0.0 and estimate.memory > 1e6, f"{estimate}")
    expect(any("--grains has no effect" in str(one.message) for one in warned), "a warning of the program is lost")


def check_packings(folder):
    """A scene with packings is interrupted, and goes on in another process to the bytes of one that was not."""
    by_command(FAULT, folder, "--quick", "--throw-over-depth", "0.04", "--output", "whole")
    call = f"import scarp; print(scarp.fault_rupture({str(folder / 'parts')!r}, quick=True, throw_over_depth=0.04, progress=print).summary.status)"
    environment = {**os.environ, "PYTHONPATH": str(module), "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen([sys.executable, "-B", "-c", call], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        for line in child.stdout:
            if line.startswith("step   15"):
                child.send_signal(signal.SIGINT)
                begin = time.monotonic()
        troubles = child.stderr.read()
    expect(troubles.strip().endswith("KeyboardInterrupt"), f"Ctrl-C: {troubles}")
    expect(time.monotonic() - begin < 20.0, f"Ctrl-C is answered after {time.monotonic() - begin} s")
    run = scarp.FaultRun(folder / "parts")
    expect(run.record.state == "interrupted" and not run.finished and list((folder / "parts/checkpoints").iterdir()), f"{run}")
    done = subprocess.run([sys.executable, "-B", "-c", call], env=environment, capture_output=True, text=True, timeout=200)
    expect("resuming from" in done.stdout and done.stdout.endswith("ok\n"), f"{done.stdout[-300:]} {done.stderr}")
    same_bytes(folder / "parts", folder / "whole", "surface.csv", "probe_A.csv", "packings/A_3_grains.csv")
    expect(measures(folder / "parts") == measures(folder / "whole"), "a resumed run has other measures")
    run = scarp.FaultRun(folder / "parts")
    expect(len(run.grains) == 8 and len(run.grains["A_3"].x) == 100, f"grains {list(run.grains)}")


def check_study(folder):
    told = []
    study = functools.partial(scarp.study, scarp.fault_rupture, {"k0": [0.4, 0.5], "dip": [60, 70]}, folder / "study", progress=told.append, **SOIL)
    runs = study()
    expect([path.name for path in sorted((folder / "study").iterdir())] == [f"k0={k0},dip={dip}" for k0 in (0.4, 0.5) for dip in (60, 70)], "folders of a study")
    table = runs.measures("surface_x50")
    expect(list(table) == ["k0", "dip", "surface_x50"] and table.dip.tolist() == [60.0, 70.0] * 2, f"{table}")
    expect(table.surface_x50[0] != table.surface_x50[1] and np.isfinite(table.surface_x50).all(), f"{table}")
    rejected(ValueError, "no summary has the number x51 (there are", lambda: runs.measures("x51"))
    expect(told and all(line.startswith("k0=") for line in told), "the progress of a study names no member")
    told.clear()
    again = study()
    expect(not told and [one.run.summary for one in again] == [one.run.summary for one in runs], f"finished members are run again: {told[:3]}")
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        some = scarp.study(scarp.fault_rupture, {"max_iterations": [1, 30]}, folder / "some", tolerance=1e-9, **SOIL)
    expect([bool(one.problem) for one in some] == [True, False] and "max_iterations=1 stopped early" in str(warned[0].message), f"{some}")
    expect(np.isnan(some.measures("surface_x50").surface_x50).tolist() == [True, False], "a member that stopped has a measure")
    angles = scarp.study(functools.partial(scarp.rve_lab, "test"), {"friction_angle": [30.0, 33.0]}, folder / "angles", material="mohr-coulomb")
    residual = angles.measures("residual_friction_angle")  # analytic: the material's own
    expect(np.allclose(residual.residual_friction_angle, residual.friction_angle, rtol=1e-3), f"{residual}")
    rejected(ValueError, "two members have the folder 'sand=a'", lambda: scarp.study(scarp.fault_rupture, {"sand": ["x/a.sand", "y/a.sand"]}, folder / "two"))


def check_seeds(folder):
    (folder / "nothing").mkdir()
    expect(not scarp.FaultRun(folder / "nothing").within_budget, "a run that is not there is within its error budget")
    run = scarp.fault_rupture(folder / "seeds", seeds=[1, 2], quick=True, throw_over_depth=0.002)
    expect([one.record.options["seed"] for one in run.members] == ["1", "2"] and run.finished, f"{run} {run.members}")
    expect(run.summary.measures.k0.count == 2 and list(run.surface) == ["x_initial", "settlement", "scatter"], f"{list(run.surface)}")
    moment = changed(run.folder / "run.json")
    scarp.fault_rupture(folder / "seeds", seeds="1,2", quick=True, throw_over_depth=0.002)
    expect(changed(run.folder / "run.json") == moment, "finished seeds are run again")


def check_sand_beside(folder, prepared):
    """A finished test is not that of a packing whose sand has changed since."""
    other = folder / "beside"
    shutil.copytree(prepared.folder, other)
    packing = other / "packing.packing"
    angle = [scarp.rve_lab("shear", other, packing=packing, strain=0.01, overwrite=True).summary.largest_friction_angle]
    sand = packing.with_suffix(".sand")
    sand.write_text(re.sub(r"(?m)^friction = .*", "friction = 0.1", sand.read_text()))
    angle.append(scarp.rve_lab("shear", folder / "fresh", packing=packing, strain=0.01).summary.largest_friction_angle)
    rejected(ValueError, "overwrite", lambda: scarp.rve_lab("shear", other, packing=packing, strain=0.01))
    angle.append(scarp.rve_lab("shear", other, packing=packing, strain=0.01, overwrite=True).summary.largest_friction_angle)
    expect(angle[2] == angle[1] < angle[0], f"friction angles {angle} of the sand, of a softer one twice")


def check_laboratory(folder):
    by_command(LAB, folder, "prepare", "--grains", "60", "--output", "by_command")
    by_command(LAB, folder, "shear", "--packing", "by_command/packing.packing", "--strain", "0.01", "--output", "by_command")
    prepared = scarp.rve_lab("prepare", folder / "lab", grains=60)
    sheared = scarp.rve_lab("shear", folder / "lab", packing=prepared.packing, strain=0.01)
    check_sand_beside(folder, prepared)
    same_bytes(folder / "lab", folder / "by_command", "packing.packing", "packing.sand", "path.csv", "end.packing")
    expect(len(prepared.tables["packing_particles"].x) == 60 and abs(sheared.curve.axial_strain[-1] - 0.01) < 1e-6, f"{sheared.curve.axial_strain[-1]}")
    moment = changed(folder / "lab/run_shear.json")
    scarp.rve_lab("shear", folder / "lab", packing=prepared.packing, strain=0.01)
    expect(changed(folder / "lab/run_shear.json") == moment, "a finished path is sent again")
    rejected(ValueError, "its results would be lost", lambda: scarp.rve_lab("shear", folder / "lab", packing=prepared.packing, strain=0.02))
    rejected(ValueError, "rve_lab shear has no option frames", lambda: scarp.rve_lab("shear", folder / "lab", frames=2))
    rejected(RuntimeError, "could not be consolidated", lambda: scarp.rve_lab("prepare", folder / "no", grains=60, pressure=1e12))
    # Analytic: Mohr-Coulomb material reaches its own friction angle.
    tested = scarp.rve_lab("test", folder / "test", material="mohr-coulomb", friction_angle=33.0, dilation_angle=7.0)
    expect(abs(tested.summary.mean.peak.friction_angle / 33.0 - 1.0) < 1e-3 and len(tested.curve.q) > 100, f"{tested.summary.mean}")
    replayed = scarp.rve_lab("replay", folder / "again", particles=folder / "lab/packing_particles.csv", contacts=folder / "lab/packing_contacts.csv",
                             path="biaxial", strain=1e-3)
    expect(len(replayed.curve.strain) > 5, f"{replayed}")
    rejected(ValueError, "it would be lost", lambda: scarp.rve_lab("replay", folder / "again", particles=folder / "lab/packing_particles.csv"))


def check_calibration(folder):
    """Little is asked: two packings of 60 discs, three evaluations."""
    call = functools.partial(scarp.calibrate, ROOT / "examples/sands/drained.csv", folder / "sand", triaxial=True, shape="ellipse", grains=60, seeds=2, evaluations=3,
                             strain_step=1e-4, free={"friction": (0.2, 0.9)})
    found = call()
    expect(0.2 <= found.parameters.friction.value <= 0.9 and found.sand.is_file() and len(found.curve.sine) > 10, f"{found.parameters}")
    (folder / "sand/run_calibrate.json").unlink()
    told = []
    again = call(progress=told.append)
    expect(again.parameters == found.parameters and "from evaluations.csv" in told[0], f"{told[:2]}")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of another sand the estimate is rough
        expect(scarp.fault_estimate(quick=True, sand=found.sand).points == 220, "a calibrated sand is no sand of the fault scene")
    layered = scarp.fault_estimate(quick=True, layer={12.0: "loose"})
    expect("2 columns of packings" in layered.text, f"a layer that is named without its file: {layered}")
    expect(programs.sand_file("fontainebleau").samefile(ROOT / "examples/sands/fontainebleau.sand"), "a sand is not found by its name")


def check_docstrings(folder):
    """The examples of the docstrings run."""
    here = os.getcwd()
    os.chdir(folder)
    for part in (scarp.fault, scarp.lab, sys.modules["scarp.study"], scarp.results, program_options):
        done = doctest.testmod(part, globs={"scarp": scarp}, optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
        expect(done.failed == 0 and done.attempted > 0, f"{done} in {part.__name__}")
    os.chdir(here)


def check_pictures(folder):
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        leave_out("figures: no matplotlib")
        return
    run = scarp.FaultRun(folder / "command")
    pictures = run.plot()
    expect({"surface", "deformation"} <= set(pictures) and all(path.is_file() for path in pictures.values()), f"{pictures}")
    expect(run.report() == folder / "command/report.html" and "Mohr-Coulomb soil" in run.report().read_text(), "no page")
    expect("curve" in scarp.LabRun(folder / "lab", "shear").plot(), "no curve of a path")


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch).resolve()
    check_scene(scratch)
    check_laboratory(scratch)
    check_options(scratch)
    check_refusals(scratch)
    check_study(scratch)
    check_seeds(scratch)
    check_packings(scratch)
    check_calibration(scratch)
    check_docstrings(scratch)
    check_pictures(scratch)
finish()
