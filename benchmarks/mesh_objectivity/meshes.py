# SPDX-License-Identifier: BSL-1.0
"""Meshes of the reference study's layer with about as many points for a length, in every direction that a user may choose."""
import dataclasses
import math
import pathlib
import shutil
import subprocess

GEOMETRY = pathlib.Path(__file__).resolve().parents[2] / "examples" / "fault_rupture" / "meshes" / "unstructured.geo"
CELLS = 3.2  # of crossed triangles across a length


@dataclasses.dataclass
class Mesh:
    name: str
    element: str
    options: list


def made(name, element, size, *options):
    return Mesh(name, element, ["--size", f"{size:.4g}", *options])


def of_generator(element, size, folder):
    """Delaunay and frontal triangulations by Gmsh, where it is installed."""
    if shutil.which("gmsh") is None:
        return
    # An edge of the generator's triangles, of the area of those in a crossed cell.
    edge = size * math.sqrt(1.0 / math.sqrt(3.0))
    for name, number in (("delaunay", 5), ("frontal", 6)):
        file = folder / f"{name}-{element}-{size:.4g}.msh"
        if not file.exists():
            folder.mkdir(parents=True, exist_ok=True)
            subprocess.run(["gmsh", "-2", GEOMETRY, "-format", "msh22", "-setnumber", "fine", f"{edge:.6g}", "-setnumber", "algorithm", str(number),
                            "-order", "2" if element == "tri6" else "1", "-o", file], check=True, capture_output=True)
        yield Mesh(f"{element}-{name}", element, ["--mesh", file])


def of_length(length, folder, all_elements):
    """all_elements: quadratic triangles and quadrilaterals too"""
    size = length / CELLS
    found = [made("tri3-crossed", "tri3", size)]
    # Cells of equal area, whatever they are.
    found += [made(f"tri3-crossed-{aspect}", "tri3", size / math.sqrt(aspect), "--aspect", aspect) for aspect in (1.73, 2.5)]
    found += [made(f"tri3-{way}", "tri3", size / math.sqrt(2.0), "--pattern", way) for way in ("left", "right")]
    found += [made(f"tri3-jittered-{seed}", "tri3", size, "--pattern", "jittered", "--mesh-seed", seed) for seed in (1, 2)]
    found += of_generator("tri3", size, folder)
    if not all_elements:
        return found
    found += [made("tri6-crossed", "tri6", 2.0 * size), made("tri6-crossed-1.73", "tri6", 2.0 * size / math.sqrt(1.73), "--aspect", 1.73),
              made("tri6-right", "tri6", 2.0 * size / math.sqrt(2.0), "--pattern", "right")]
    found += of_generator("tri6", 2.0 * size, folder)
    for element, wider in (("quad4", 1.0), ("quad8", 2.0)):
        own = wider * size / math.sqrt(2.0)
        found += [made(f"{element}-quads", element, own), made(f"{element}-quads-1.73", element, own / math.sqrt(1.73), "--aspect", 1.73),
                  made(f"{element}-jittered-1", element, own, "--pattern", "jittered")]
    return found


def quick():
    """Directions that differ most, on meshes that just resolve 8 m."""
    return [made("tri3-crossed", "tri3", 2.5), made("tri3-crossed-2.5", "tri3", 1.75, "--aspect", 2.5),
            made("tri3-right", "tri3", 1.77, "--pattern", "right")]
