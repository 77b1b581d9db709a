# SPDX-License-Identifier: BSL-1.0
"""[nightly] nvcc compiles kernels of all shapes and laws; their registers and what these spill stay within bounds."""
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from nvcc import TWO_BLOCKS, check

ROOMS = "scarp::BlockSize{200, 640}"


def grains(shape, law, shape_header, law_header, scalar="double"):
    """Arguments of compiled(): types that hold commas are named first."""
    return ("Shape", "Law", scalar, f'''#include "scarp/contact/linear_frictional.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/contact/{law_header}.hpp"
#include "scarp/shape/{shape_header}.hpp"
using Shape = scarp::{shape};
using Law = scarp::{law};
''', ROOMS)


sys.exit("\n".join(check([
    ("ellipses in single precision", TWO_BLOCKS, 500, grains("Ellipse", "LinearFrictional", "ellipse", "linear_frictional", "float")),
    ("discs without friction", TWO_BLOCKS, 200, grains("Disc", "Frictionless", "disc", "frictionless")),
    ("superellipses", TWO_BLOCKS, 1800, grains("Superellipse", "LinearFrictional", "superellipse", "linear_frictional")),
    ("dumbbells", TWO_BLOCKS, 200, grains("Dumbbell", "LinearFrictional", "clump", "linear_frictional")),
    ("two species", TWO_BLOCKS, 400, grains("WithSpecies<scarp::Ellipse, 2>", "LawPerSpecies<scarp::LinearFrictional, 2>", "with_species",
                                            "law_per_species")),
    ("bonds", TWO_BLOCKS, 750, grains("Ellipse", "CohesiveBond<scarp::LinearFrictional>", "ellipse", "cohesive_bond")),
    ("rolling resistance", TWO_BLOCKS, 800, grains("Ellipse", "RollingResistance<scarp::LinearFrictional>", "ellipse", "rolling_resistance")),
    ("dashpots", TWO_BLOCKS, 800, grains("Ellipse", "HertzMindlin<scarp::HertzRestitution>", "ellipse", "hertz_mindlin"))])) or None)
