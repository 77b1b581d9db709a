# SPDX-License-Identifier: BSL-1.0
"""Every arrow between the rooms of include/scarp points downwards, nobody but the room itself and those within it looks into its `detail`, which
has a namespace of its own, and Hana composes in the upper rooms only."""
import pathlib
import re
import sys

# From the bottom to the top: a room may include those before it.
ROOMS = ["core", "simd", "tensor", "element", "shape", "contact", "mesh", "dem", "cuda", "homogenise", "io", "io/gmsh", "io/packings",
         "constitutive", "rve", "points", "bvp", "solver", "run", "observe", "budget", "fault"]
COMPOSES = {"points", "solver", "observe"}
FOLDER = pathlib.Path(__file__).resolve().parents[1] / "include" / "scarp"


def room_of(header):
    """The room of a header given by its path below include/scarp."""
    parts = header.split("/")[:-1]
    return next(("/".join(parts[:n]) for n in (2, 1) if "/".join(parts[:n]) in ROOMS), None)


faults = []
arrows = 0
for path in sorted(FOLDER.rglob("*.hpp")):
    header = path.relative_to(FOLDER).as_posix()
    room = room_of(header)
    text = path.read_text()
    if room is None:
        faults.append(f"{header} lies in no room (name its room in {pathlib.Path(__file__).name})")
        continue
    if "boost/hana" in text and room not in COMPOSES:
        faults.append(f"{header} composes with Hana")
    if "/detail/" in f"/{header}" and re.search(r"^namespace scarp \{", text, re.MULTILINE):
        faults.append(f"{header} puts names into namespace scarp (a detail has its own namespace, scarp::detail; else move the header out)")
    for included in re.findall(r'#include "scarp/([^"]+)"', text):
        other = room_of(included)
        if other == room:
            continue
        arrows += 1
        if ROOMS.index(other) > ROOMS.index(room):
            faults.append(f"{header} includes {included}, from a room above its own")
        if "/detail/" in included and not room.startswith(f"{other}/"):
            faults.append(f"{header} looks into {included}")
for room in ROOMS:
    if not any((FOLDER / room).glob("*.hpp")):
        faults.append(f"the room {room} has no header")
if arrows < 100:
    faults.append(f"only {arrows} arrows found: this test looks for includes in the wrong form")
sys.exit("\n".join(faults) or None)
