# SPDX-License-Identifier: BSL-1.0
"""A program that names only linear elasticity contains nothing of the discrete elements.

Environment: see compiled_symbols.py.
"""
import pathlib
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from compiled_symbols import features_of, included_headers, object_symbols

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


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    symbols = object_symbols(scratch, "elastic", elastic)
    found = [line for line in symbols if foreign.search(line)]
    if found or features_of(symbols):
        sys.exit(f"symbols of rooms that the program does not name ({', '.join(features_of(symbols))}):\n" + "\n".join(found))
    for header in ("scarp/dem/", "scarp/contact/", "scarp/shape/", "scarp/homogenise/", "nanoflann.hpp", "boost/hana"):
        if header in included_headers(scratch, "elastic"):
            sys.exit(f"linear elasticity pulls in {header}")
    noticed = object_symbols(scratch, "discrete", discrete)
    for symbol in ("TimeStepper", "rebuild_pairs", "nanoflann", "PairScratch"):
        if symbol not in " ".join(noticed):
            sys.exit(f"the counter-example lacks {symbol}: the names that this test looks for are out of date")
    if features_of(noticed) != {"DEM", "nanoflann"}:
        sys.exit(f"a packing without observer contains {', '.join(sorted(features_of(noticed)))}: DEM and nanoflann would do")
print("linear elasticity contains nothing of the discrete elements; a packing without observer nothing but these")
