# SPDX-License-Identifier: BSL-1.0
"""[slow] Graded meshes of fault_rupture: a short --length refines a strip along the rupture, --size and --strip-width override it, meshes of
other directions agree. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import NIGHTLY, example, expect, finish

program = example("fault_rupture")


def run(folder, *options):
    return subprocess.run([program.resolve(), "--soil", "mohr_coulomb", "--frames", "1", "--overwrite", "--output", "out", *options],
                          cwd=folder, capture_output=True, text=True)


def told(folder, *options):
    done = run(folder, *options)
    expect(done.returncode == 0, f"{options}: ended with {done.returncode}: {done.stderr[-500:]}")
    return json.loads(pathlib.Path(folder, "out", "summary.json").read_text()) if done.returncode == 0 else {}


BEGINNING = ("--throw-over-depth", "0.002")
with tempfile.TemporaryDirectory() as scratch:
    graded = told(scratch, "--length", "4")
    surface = pathlib.Path(scratch, "out", "surface.csv").read_text()
    expect(graded["strip_size"] == 0.41 * 4.0 and graded["strip_width"] == 10.0, f"a length chooses the strip: {graded}")
    (left, right), *_, (above_left, above_right) = graded["strip_edges"]
    expect(left < 0.0 < right, f"the tip lies in the strip: {graded['strip_edges']}")
    expect(above_left < graded["surface_x50"] < above_right, f"and the outcrop: {graded['strip_edges']}")
    expect(graded["strip_margin"] > 0.0, f"the band stays in the strip: {graded['strip_margin']}")
    expect(graded["elements"] < 1000, f"far elements stay large: {graded['elements']}")
    expect(graded["vertical_stress_error"] < 1e-2, "the ground at rest carries its weight")
    expect(graded["distorted_element"]["mean_ratio"] > 0.2, f"no element is distorted: {graded['distorted_element']}")
    if NIGHTLY:
        far = run(scratch, "--length", "4", "--throw-over-depth", "0.25")
        expect("warning: element" in far.stderr and "is sheared by" in far.stderr, f"an element that gets thin is told: {far.stderr[-300:]}")
    turned = told(scratch, "--length", "4", "--pattern", "right")
    # Bound of the error budget's part "mesh": 4 % of the depth.
    expect(abs(graded["surface_x50"] - turned["surface_x50"]) < 1.0, f"x50 {graded['surface_x50']} and {turned['surface_x50']}")
    expect(graded["bands"][1]["band_width"] < 9.0, f"the band is of the length, not of the coarse mesh: {graded['bands']}")

    for options in (("--length", "8"), ("--length", "4", "--size", "2.5"), ("--length", "4", "--strip-width", "0")):
        even = told(scratch, *options, *BEGINNING)
        expect("strip_size" not in even and even["elements"] == 960, f"{options}: uniform, {even['elements']} elements")
    if NIGHTLY:
        narrow = told(scratch, "--length", "4", "--strip-width", "0.5")
        expect(narrow["strip_margin"] < 0.0 < told(scratch, "--length", "4", "--strip-width", "24")["strip_margin"],
               "a band that is wider than its strip leaves it")
    wide = told(scratch, "--length", "4", "--strip-width", "16", *BEGINNING)
    expect(wide["elements"] > graded["elements"] and wide["strip_size"] == graded["strip_size"], "a wider strip has more elements")
    own = told(scratch, "--size", "1", "--strip-width", "4", *BEGINNING)
    expect(own["strip_size"] == 1.0 and own["strip_width"] == 4.0, "a strip of any size and width")
    for options in [("--reverse", "--dip", "45"), ("--case", "heavy")] + [("--dip", "75"), ("--case", "light", "--footing", "frictional")] * NIGHTLY:
        found = told(scratch, "--length", "4", *options)
        (left, right), *_, (above_left, above_right) = found["strip_edges"]
        expect(left < 0.0 < right and above_left < found["surface_x50"] < above_right, f"{options}: the strip follows, {found}")
        expect(("strip_margin" in found) == ("--case" not in options), f"{options}: below a footing there is no margin, {found}")
    # A run that goes on makes the same mesh by a pilot run of its own.
    stopped = run(scratch, "--length", "4", "--checkpoint", "saved", "--checkpoint-every", "0", "--time-limit", "1e-6")
    resumed = subprocess.run([program.resolve(), "--soil", "mohr_coulomb", "--frames", "1", "--output", "out", "--length", "4", "--checkpoint", "saved",
                              "--resume"], cwd=scratch, capture_output=True, text=True)
    expect(resumed.returncode == 0 and stopped.returncode == 130 and "resuming" in resumed.stderr, f"it goes on: {resumed.stderr[-500:]}")
    expect(pathlib.Path(scratch, "out", "surface.csv").read_text() == surface, f"and has the same surface as in one go ({graded['surface_x50']})")

    done = run(scratch, "--length", "0.1")
    expect(done.returncode > 0 and "--length is 0.1 m" in done.stderr and "--size" in done.stderr, f"too short a length: {done.stderr}")
finish()
