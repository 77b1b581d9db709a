# SPDX-License-Identifier: BSL-1.0
"""[slow] A scene pays only for what it names: no discrete elements in an elastic one, no fabric and no files without
observer.

Environment: see compiled_symbols.py.
"""
import concurrent.futures
import pathlib
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from compiled_symbols import features_of, included_headers, object_symbols

DISCRETE = re.compile(r"TimeStepper|rebuild_pairs|nanoflann|pair_forces|PairScratch|Packing|fabric|Servo")
OUTDATED = "the names that this test looks for are out of date"
OBSERVED = re.compile(r"fabric|Vtu|vtu|Pvd|CsvLog|FieldSeries")

# {0}: further headers, {1}: the soil's type, {2}: the observer. Sparse factorisation is left to another unit: it takes
# longest to compile and says nothing here.
SCENE = """
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/solver/frozen_tangent.hpp"
{0}
struct Elsewhere {{
  scarp::Verdict factorize(Eigen::SparseMatrix<double> const& matrix);
  Eigen::VectorXd solve(Eigen::VectorXd const& right) const;
  Eigen::VectorXd solve_transposed(Eigen::VectorXd const& right) const;
}};
scarp::RunReport run({1} const& soil) {{
  scarp::FreeFieldFault<{1}, scarp::QuasiNewton<scarp::FrozenTangent, scarp::PlainStep, Elsewhere>> const scene{{soil}};
  scarp::SerialExecutor serial;
  auto problem = scene.problem(serial);
  {2};
  scene.settle(problem, observer);
  return scene.rupture(problem, observer);
}}
"""
ELASTIC = '#include "scarp/constitutive/linear_elastic.hpp"\n'
SAND = """
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/shape/ellipse.hpp"
using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Sand = scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>;
"""
SERIES = '#include "scarp/observe/field_series.hpp"\n'
NOBODY = "scarp::NoObserver observer"
WATCHED = 'scarp::FieldSeries<scarp::RveQuantities> observer("folder", 1.0, 4, 25.0)'


def expect(truth, message):
    if not truth:
        sys.exit(message)


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    soil = "scarp::LinearElastic<2, scarp::GeostaticStress<2>>"
    programs = {
        "watched": SCENE.format(SAND + SERIES, "Sand", WATCHED),
        "sand": SCENE.format(SAND, "Sand", NOBODY),
        "elastic": SCENE.format(ELASTIC, soil, NOBODY),
    }
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        listed = pool.map(lambda name: object_symbols(scratch, name, programs[name]), programs)
        watched, sand, elastic = listed
    found = [line for line in elastic if DISCRETE.search(line) or OBSERVED.search(line)]
    expect(not found, "an elastic scene without observer contains:\n" + "\n".join(found[:20]))
    found = [line for line in elastic if re.search("SparseLU|Cholesky", line)]
    expect(not found, "a scene with a linear solver of its own contains another one:\n" + "\n".join(found[:20]))
    headers = included_headers(scratch, "elastic")
    for header in ("scarp/dem/", "scarp/shape/", "scarp/contact/", "scarp/homogenise/", "scarp/io/", "nanoflann.hpp"):
        expect(header not in headers, f"an elastic scene without observer pulls in {header}")

    # One program serves twice: as counter-example of the test above, and to have no fabric itself.
    for name in ("TimeStepper", "rebuild_pairs", "nanoflann", "PairScratch", "Packing"):
        expect(any(name in line for line in sand), f"a scene of packings lacks {name}: {OUTDATED}")
    found = [line for line in sand if OBSERVED.search(line)]
    expect(not found, "a scene of packings without observer contains:\n" + "\n".join(found[:20]))

    # With an observer that asks for them they are there, or the check above could not fail.
    for name in ("contact_fabric", "particle_fabric", "write_vtu", "PvdSeries"):
        expect(any(name in line for line in watched), f"an observed scene lacks {name}: {OUTDATED}")
    wanted = {"elastic": set(), "sand": {"DEM", "nanoflann"}, "watched": {"DEM", "nanoflann", "VTU", "fabric"}}
    for (name, features), symbols in zip(wanted.items(), (elastic, sand, watched)):
        found = features_of(symbols)
        expect(found == features, f"the scene '{name}' contains {sorted(found)} (it names {sorted(features)})")
print("an elastic scene contains no discrete elements; one of packings without observer no fabric and no files")
