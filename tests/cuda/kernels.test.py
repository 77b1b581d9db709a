# SPDX-License-Identifier: BSL-1.0
"""[slow] nvcc compiles the kernels of the study's grains, of spheres in single precision, and of the tutorials' own law and shape as they
stand; registers and memory that registers spill into stay within bounds; a law that forgets constexpr is an error that names it."""
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from nvcc import ONE_BLOCK, TWO_BLOCKS, check, compiled, tutorial

STUDY = '#include "scarp/contact/linear_frictional.hpp"\n#include "scarp/shape/ellipse.hpp"\n'
SPHERES = '#include "scarp/contact/hertz_mindlin.hpp"\n#include "scarp/shape/sphere.hpp"\n'
FORGOTTEN = '''#include "scarp/contact/frictionless.hpp"
#include "scarp/shape/disc.hpp"
struct Forgotten : scarp::Frictionless {
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach, scarp::ContactMemory<Dim, T>& memory) const {
    return scarp::Frictionless::respond(approach, memory);
  }
};
'''

# Spills are of numbers that all threads have alike; bounds are what was measured and a quarter more.
faults = check([
    ("the study's ellipses", TWO_BLOCKS, 700, ("scarp::Ellipse", "scarp::LinearFrictional", "double", STUDY)),
    ("spheres in single precision", TWO_BLOCKS, 560, ("scarp::Sphere", "scarp::HertzMindlin<>", "float", SPHERES)),
    ("the tutorial's law", TWO_BLOCKS, 200, ("scarp::Disc", "Stiffening", "double", tutorial("own_law"))),
    ("the tutorial's shape", ONE_BLOCK, 200, ("Oval", "scarp::LinearFrictional", "double", tutorial("own_shape")))])
said, is_good = compiled("scarp::Disc", "Forgotten", "double", FORGOTTEN)
if is_good or "Forgotten::respond" not in said:
    faults.append(f"a law that forgets constexpr is not named\n{said[-3000:]}")
sys.exit("\n".join(faults) or None)
