# SPDX-License-Identifier: BSL-1.0
"""A program that names only linear elasticity contains nothing of the discrete elements.

Environment: CXX (default c++), SCARP_INCLUDES (further include folders, separated by ':').
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
foreign = re.compile(r"TimeStepper|rebuild_pairs|fabric|nanoflann|PairScratch|Servo|boost::hana")

elastic = """
#include "scarp/constitutive/linear_elastic.hpp"
scarp::Response<2> run(scarp::Gradient<2> const& gradient) {
  auto const soil = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  scarp::LinearElastic<2>::State trial;
  return soil.respond(soil.initial_state({}), gradient, trial);
}
"""
# The counter-example: the same question to a packing must be noticed, or the test above could not fail.
discrete = """
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/shape/disc.hpp"
using Discs = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
scarp::Response<2> run(scarp::DemRve<Discs, scarp::SamePacking<Discs>> const& sand, scarp::Gradient<2> const& gradient) {
  auto state = sand.initial_state({});
  auto trial = state;
  return sand.respond(state, gradient, trial);
}
"""


def include_folders():
    folders = [root / "include"]
    folders += [pathlib.Path(name) for name in os.environ.get("SCARP_INCLUDES", "").split(":") if name]
    folders += [path for path in map(pathlib.Path, ("/usr/include/eigen3", "/usr/local/include/eigen3")) if path.is_dir()]
    return [f"-I{folder}" for folder in folders]


def object_symbols(folder, name, source):
    written = folder / f"{name}.cpp"
    written.write_text(source)
    compiled = folder / f"{name}.o"
    compiler = os.environ.get("CXX", "c++")
    subprocess.run([compiler, "-std=c++20", "-O0", *include_folders(), "-c", str(written), "-o", str(compiled)], check=True)
    return subprocess.run(["nm", "-C", str(compiled)], check=True, capture_output=True, text=True).stdout.splitlines()


def included_headers(folder, name):
    compiler = os.environ.get("CXX", "c++")
    command = [compiler, "-std=c++20", *include_folders(), "-MM", str(folder / f"{name}.cpp")]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    found = [line for line in object_symbols(scratch, "elastic", elastic) if foreign.search(line)]
    if found:
        sys.exit("symbols of rooms that the program does not name:\n" + "\n".join(found))
    for header in ("scarp/dem/", "scarp/contact/", "scarp/shape/", "scarp/homogenise/", "nanoflann.hpp", "boost/hana"):
        if header in included_headers(scratch, "elastic"):
            sys.exit(f"linear elasticity pulls in {header}")
    noticed = " ".join(object_symbols(scratch, "discrete", discrete))
    for symbol in ("TimeStepper", "rebuild_pairs", "nanoflann", "PairScratch"):
        if symbol not in noticed:
            sys.exit(f"the counter-example lacks {symbol}: the names that this test looks for are out of date")
    if "fabric" in noticed:
        sys.exit("a packing without observer contains the fabric")
print("linear elasticity contains nothing of the discrete elements; a packing without observer contains no fabric")
