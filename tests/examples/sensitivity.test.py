# SPDX-License-Identifier: BSL-1.0
"""[slow] Sensitivity runs of a run: fault_rupture with --sensitivity-runs estimates what the mesh and the load steps are worth, keeps that by
scene, and a later run of the same scene tells it. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit
77, without)."""
import json
import pathlib
import signal
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish

program = example("fault_rupture")


def run(folder, *options):
    done = subprocess.run([program.resolve(), "--quick=true", "--soil", "mohr_coulomb", *([] if "--length" in options else ["--length", "12"]), "--frames", "1",
                           "--sensitivity-file", "known.json", "--output", "out", "--overwrite", *options],
                          cwd=folder, capture_output=True, text=True)
    summary = pathlib.Path(folder, "out", "summary.json")
    return done, json.loads(summary.read_text()) if done.returncode == 0 else {}


with tempfile.TemporaryDirectory() as scratch:
    done, summary = run(scratch)
    expect(done.returncode == 0 and "--sensitivity-runs" in done.stdout, "a run without sensitivity runs says how to get them")
    expect("mesh" not in summary["error_budget"]["parts"], "it claims nothing of the mesh")

    done, summary = run(scratch, "--sensitivity-runs")
    expect(done.returncode == 0, f"sensitivity runs end well: {done.stderr[-500:]}")
    parts = summary["error_budget"]["parts"]
    other = json.loads(pathlib.Path(scratch, "out", "sensitivity_mesh", "summary.json").read_text())
    recorded = json.loads(pathlib.Path(scratch, "out", "sensitivity_mesh", "run.json").read_text())["options"]
    expect(recorded["pattern"] == "right" and recorded["sensitivity-runs"] == "false", f"it records its own options: {recorded}")
    apart = abs(other["surface_x50"] - summary["surface_x50"]) / 25.0
    expect(apart > 1e-4 and abs(parts["mesh"]["value"] - apart) < 1e-12, f"the mesh's part is that of the other mesh: {parts['mesh']}")
    finer = json.loads(pathlib.Path(scratch, "out", "sensitivity_load_step", "summary.json").read_text())
    expect(finer["steps"] >= 1.3 * summary["steps"], "load steps of the sensitivity run are smaller")
    expect(parts["load_step"]["value"] > 0.0, "and change the answer")

    def names(entry):
        return [line.split(" = ")[0] for line in entry["scene"].splitlines()]

    known = json.loads(pathlib.Path(scratch, "known.json").read_text())
    shipped = json.loads((pathlib.Path(__file__).resolve().parents[2] / "examples/fault_rupture/sensitivity.json").read_text())
    expect(all(names(entry) == names(known[0]) for entry in shipped), "scenes of the file that comes with the program have the lines of today")

    for line in ("tolerance = 1e-08", "max-displacement-gradient = 0.02"):
        expect(line in known[0]["scene"].splitlines(), f"what the soil decides stands there as a number: {line}")

    # Known from now on, to the same scene, whatever is written on the way.
    done, later = run(scratch, "--probe-a-x", "-5")
    expect(later["error_budget"]["parts"]["mesh"] == parts["mesh"], "a later run of the same scene tells it")
    expect("--pattern right" in done.stdout and "commit" in done.stdout, "and where it comes from")
    done, another = run(scratch, "--dip", "70")
    expect("mesh" not in another["error_budget"]["parts"], "another scene does not")

    done, local = run(scratch, "--length", "0")
    expect(local["error_budget"]["parts"]["linear_residual"]["bound"] == 1e-8, "factors without a length have to solve exactly")
    expect(summary["error_budget"]["parts"]["linear_residual"]["bound"] > 1e-8, "Krylov's method with one need not")

    own = [program.resolve(), "--quick", "--soil", "mohr_coulomb", "--length", "12", "--frames", "1", "--sensitivity-runs", "--output"]
    kept = subprocess.run([*own, "kept", "--sensitivity-file", "/proc/known.json"], cwd=scratch, capture_output=True, text=True)
    found = json.loads(pathlib.Path(scratch, "kept", "summary.json").read_text())["error_budget"]["parts"]
    expect(kept.returncode == 0 and "mesh is not kept for later runs" in kept.stderr, f"a file that cannot be written: {kept.stderr[-500:]}")
    expect(all(found.get(part, {}).get("value") == parts[part]["value"] for part in ("mesh", "load_step")), f"its runs count: {found}")

    with subprocess.Popen([*own, "ended", "--sensitivity-file", "none.json"], cwd=scratch, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True) as process:
        for line in process.stderr:
            if line.startswith("sensitivity run for"):
                process.send_signal(signal.SIGINT)
                break
        said = process.stderr.read()
    state = json.loads(pathlib.Path(scratch, "ended", "run.json").read_text())["state"]
    expect((process.returncode, state) == (130, "interrupted"), f"a signal in a sensitivity run: {process.returncode}, {state}\n{said[-500:]}")
    expect("has failed" not in said, f"no run has failed: {said[-500:]}")

    pathlib.Path(scratch, "known.json").write_text('{"scene": ')
    done, _ = run(scratch)
    expect(done.returncode == 2 and "known.json" in done.stderr, f"a damaged file is refused: {done.stderr}")
    expect(pathlib.Path(scratch, "known.json").read_text() == '{"scene": ', "and stays as it is")
finish()
