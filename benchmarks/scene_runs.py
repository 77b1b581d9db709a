# SPDX-License-Identifier: BSL-1.0
"""Runs of fault_rupture for a benchmark: the programs, and one run unless it has been."""
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]


def example(name, *options, target=None):
    """An example's program: that of SCARP_EXAMPLES, or built.
    options: that examples/run chooses the target by"""
    if "SCARP_EXAMPLES" in os.environ:
        return pathlib.Path(os.environ["SCARP_EXAMPLES"]).resolve() / (target or name)
    done = subprocess.run([ROOT / "examples" / "run", name, *options, "--help"], stdout=subprocess.DEVNULL)
    if done.returncode != 0:
        sys.exit(f"{target or name} does not build")
    return ROOT / "build" / "release" / "examples" / (target or name)


def program(element="tri3"):
    """The scene's program for an element."""
    return example("fault_rupture", "--element", element, target="fault_rupture" if element == "tri3" else f"fault_rupture_{element}")


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
