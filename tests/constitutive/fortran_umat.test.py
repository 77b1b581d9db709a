# SPDX-License-Identifier: BSL-1.0
"""A UMAT in Fortran is a provider: compiled by gfortran, it gives what its twin in C++ gives. Environment: see compiler.py."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here.parent / "examples"), str(here.parent)]
from compiler import compiler, include_folders
from expectations import expect, finish

SOURCE = r"""
#include <cstdio>
#include "constitutive/umats.hpp"

extern "C" scarp::Umat umat_;

/// Largest relative difference of stress, tangent and state variables along a path of stretch, shear and rotation.
template <int Dim>
double difference(bool hardens) {
  auto twin = hardens ? umats::hardening<Dim>() : umats::elastic<Dim>();
  auto fortran = twin;
  fortran.umat = umat_;
  auto state = fortran.initial_state({});
  auto expected = twin.initial_state({});
  double worst = 0.0;
  for (int step = 0; step < 20; ++step) {
    scarp::Gradient<Dim> increment = scarp::Gradient<Dim>::Identity() * -1e-4;
    increment(0, 1) = 2e-3;
    increment(1, Dim - 1) += 5e-4;
    auto trial = state;
    auto trial_expected = expected;
    auto const response = fortran.respond(state, increment, trial);
    auto const known = twin.respond(expected, increment, trial_expected);
    if (!response.verdict.acceptable() || !known.verdict.acceptable()) return 1.0;
    state = trial;
    expected = trial_expected;
    worst = std::max({worst, (response.stress - known.stress).norm() / known.stress.norm(),
                      (state.tangent - expected.tangent).norm() / expected.tangent.norm(),
                      std::abs(state.variables[0] - expected.variables[0])});
    if (state.variables[1] != step + 1) return 1.0;
  }
  if (hardens != (state.variables[0] > 1e-2)) return 1.0;
  return worst;
}

int main() {
  for (bool const hardens : {false, true}) std::printf("%g %g\n", difference<2>(hardens), difference<3>(hardens));
}
"""

if not shutil.which("gfortran"):
    print("skipped: no gfortran here (install the package 'gfortran')")
    sys.exit(77)
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    subprocess.run(["gfortran", "-O1", "-c", str(here / "von_mises.f"), "-o", str(folder / "umat.o")], check=True)
    (folder / "main.cpp").write_text(SOURCE)
    flags = ["-std=c++20", "-O1", "-DFMT_HEADER_ONLY", f"-I{here.parent}", *include_folders()]
    subprocess.run([compiler, *flags, "main.cpp", "umat.o", "-o", "program"], cwd=folder, check=True)
    done = subprocess.run([folder / "program"], check=True, capture_output=True, text=True)
print(done.stdout, end="")
differences = [float(number) for number in done.stdout.split()]
expect(len(differences) == 4, f"four differences are expected, these came: {done.stdout}")
for number in differences:
    # The formulas are the same; the compilers may order sums differently: round-off of 20 steps.
    expect(number < 1e-12, f"Fortran and C++ differ by {number}")
finish()
