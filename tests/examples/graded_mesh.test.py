# SPDX-License-Identifier: BSL-1.0
"""[slow] Graded meshes of fault_rupture: a short --length refines a strip along the rupture, --size and --strip-width override it, meshes of
other directions agree. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import json
import math
import pathlib
import re
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
FILE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "fault_rupture" / "meshes" / "unstructured.msh"
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

    # The mesh of a file: as it is with the length that its elements resolve, or refined for a shorter one.
    as_it_is = told(scratch, "--mesh", FILE, *BEGINNING)
    expect("strip_size" not in as_it_is and as_it_is["depth"] == 25.0, f"a file's mesh stays: {as_it_is}")
    own_length = float(as_it_is["run"]["options"]["length"])
    expect(5.0 < own_length < 8.0, f"elements of 2.5 m along the fault resolve 6 m: {own_length}")
    refined = told(scratch, "--mesh", FILE, "--length", "4")
    expect(refined["strip_size"] == graded["strip_size"] and refined["elements"] > as_it_is["elements"], f"a length refines it: {refined}")
    expect(abs(refined["surface_x50"] - graded["surface_x50"]) < 1.0, f"x50 {refined['surface_x50']} and {graded['surface_x50']}")
    # Bedrock of another height above sea level.
    before, nodes, elements = re.split(r"\$Nodes\n\d+\n|\$EndNodes\n", FILE.read_text())
    places = [line.split() for line in nodes.splitlines()]
    lower = "".join(f"{number} {x} {float(y) - 37.5} {z}\n" for number, x, y, z in places)
    pathlib.Path(scratch, "lower.msh").write_text(f"{before}$Nodes\n{len(places)}\n{lower}$EndNodes\n{elements}")
    shifted = told(scratch, "--mesh", "lower.msh", "--length", "4")
    expect(abs(shifted.get("strip_margin", 0.0) - refined["strip_margin"]) < 0.01, f"margins {shifted.get('strip_margin')}, {refined['strip_margin']}")
    apart = max((abs(a - b) if a is not None else math.inf for one, other in zip(shifted["strip_edges"], refined["strip_edges"])
                 for a, b in zip(one, other)), default=math.inf)
    expect(apart < 1e-6, f"edges of the strip: {shifted['strip_edges']}")
    sized = told(scratch, "--mesh", FILE, "--length", "4", "--size", "2", *BEGINNING)
    expect((sized.get("strip_size"), sized.get("strip_width")) == (2.0, refined["strip_width"]), f"--size overrides that of the strip: {sized}")
    rejected = run(scratch, "--mesh", FILE, "--length", "8", "--size", "2", *BEGINNING)
    expect(rejected.returncode == 2 and "or a --length below 5.6 m" in rejected.stderr, f"a length that the file resolves: {rejected.stderr}")
    idle = run(scratch, "--mesh", FILE, "--length", "8", "--strip-width", "6", *BEGINNING)
    expect(idle.returncode == 0 and "the strip refines nothing" in idle.stderr, f"a strip that refines nothing is told: {idle.stderr[-500:]}")
    busy = run(scratch, "--mesh", FILE, "--length", "4", *BEGINNING)
    expect("the strip refines nothing" not in busy.stderr, "a strip that refines something")
    coarse = run(scratch, "--mesh", FILE, "--length", "4", "--strip-width", "0", *BEGINNING)
    expect(coarse.returncode == 0 and "needs elements of at most 1.6 m" in coarse.stderr, f"too coarse a file is told: {coarse.stderr[-500:]}")

    # Other sites: sizes and places follow the depth, and all of them the tip.
    shallow = told(scratch, "--depth", "12.5", *BEGINNING)
    options = shallow["run"]["options"]
    expect((options["length"], options["size"], options["left"], options["width"]) == ("1", "0.41", "-26", "37.5"), f"half the depth: {options}")
    expect(abs(shallow["fault_line_x50"] + 12.5 / 3.0**0.5) < 1e-9, f"its fault's line comes out at {shallow['fault_line_x50']}")
    far = told(scratch, "--length", "4", "--tip", "5300000")
    expect(abs(far["surface_x50"] - 5300000.0 - graded["surface_x50"]) < 0.01, f"a site far off: {far['surface_x50']} and {graded['surface_x50']}")
    heavier = told(scratch, "--unit-weight", "20000", "--surcharge", "0", "--size", "5", *BEGINNING)
    lighter = told(scratch, "--size", "5", *BEGINNING)
    expect(heavier["vertical_stress_error"] < 1e-2, f"weight and surcharge reach the ground: {heavier['vertical_stress_error']}")
    expect(heavier["reaction"] != lighter["reaction"], "a heavier ground resists otherwise")

    done = run(scratch, "--length", "0.1")
    expect(done.returncode > 0 and "--length is 0.1 m" in done.stderr and "--size" in done.stderr, f"too short a length: {done.stderr}")
finish()
