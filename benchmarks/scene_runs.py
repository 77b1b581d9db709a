# SPDX-License-Identifier: BSL-1.0
"""Runs of fault_rupture for a benchmark: the program, and one run unless it has been."""
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def program(element="tri3"):
    """The scene's program for an element: that of SCARP_EXAMPLES, or built."""
    suffix = "" if element == "tri3" else f"_{element}"
    if "SCARP_EXAMPLES" in os.environ:
        return pathlib.Path(os.environ["SCARP_EXAMPLES"]).resolve() / f"fault_rupture{suffix}"
    done = subprocess.run([ROOT / "examples" / "run", "fault_rupture", "--element", element, "--help"], stdout=subprocess.DEVNULL)
    if done.returncode != 0:
        sys.exit(f"fault_rupture for {element} does not build")
    return ROOT / "build" / "release" / "examples" / f"fault_rupture{suffix}"


def has_run(folder):
    file = folder / "summary.json"
    return file.exists() and json.loads(file.read_text())["status"] != "interrupted"


def run_once(command, folder):
    """Runs a scene unless it has been; what it came to is its summary, also where it stopped early."""
    if has_run(folder):
        return
    folder.parent.mkdir(parents=True, exist_ok=True)
    command = [*map(str, command), "--output", str(folder), "--overwrite"]
    done = subprocess.run(command, capture_output=True, text=True)
    if not has_run(folder):
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stderr[-2000:]}")
    print(f"{folder}: {json.loads((folder / 'summary.json').read_text())['status']}", flush=True)
