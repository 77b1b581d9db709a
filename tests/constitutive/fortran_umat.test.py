# SPDX-License-Identifier: BSL-1.0
"""A UMAT in Fortran is a provider: compiled by gfortran, it gives what its twin in C++ gives, with the routines of Abaqus beside it.
Environment: see compiler.py."""
import pathlib
import re
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

UTILITIES = """
      SUBROUTINE USES(S, E, R, PS, PE, AN, SINV1, SINV2, TS, TE)
      DOUBLE PRECISION S(6), E(4), R(3,3), PS(3), PE(3), AN(3,3)
      DOUBLE PRECISION SINV1, SINV2, TS(6), TE(4)
      CALL SINV(S, SINV1, SINV2, 3, 3)
      CALL SPRIND(S, PS, AN, 1, 3, 3)
      CALL SPRINC(E, PE, 2, 3, 1)
      CALL ROTSIG(S, R, TS, 1, 3, 3)
      CALL ROTSIG(E, R, TE, 2, 3, 1)
      END
      SUBROUTINE GIVES_UP()
      WRITE(*,*) 'no such soil'
      CALL XIT
      END
"""
# Analytic. Stress 5 I + 3 on 13: 2, 5 and 8, the last along (1, 0, 1); its deviator has the norm 3 sqrt 2, hence q = 3 sqrt 3. A shear
# strain of 0.02 has the principal values 0.01. A quarter turn about 3 takes 1 to 2 and 2 to -1: 13 becomes 23, 12 changes its sign.
USER = r"""
#include <cmath>
#include <cstdio>
#include <stdexcept>
extern "C" void uses_(double const*, double const*, double const*, double*, double*, double*, double*, double*, double*, double*);
extern "C" void gives_up_();
int main() {
  double const s[6] = {5, 5, 5, 0, 3, 0}, e[4] = {0, 0, 0, 0.02}, r[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};
  double ps[3], pe[3], an[9], mean, equivalent, ts[6], te[4];
  uses_(s, e, r, ps, pe, an, &mean, &equivalent, ts, te);
  double const found[] = {ps[0] - 2, ps[1] - 5, ps[2] - 8, std::abs(an[2]) - std::sqrt(0.5), an[2] - an[8], an[5], pe[0] + 0.01, pe[2] - 0.01,
                          mean - 5, equivalent - 3 * std::sqrt(3.0), ts[0] - 5, ts[3], ts[4], ts[5] - 3, te[3] + 0.02, te[0]};
  for (double const error : found) std::printf("%g\n", error);
  try {
    gives_up_();
  } catch (std::invalid_argument const& problem) {
    std::puts(problem.what());
  }
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
    (folder / "uses.f").write_text(UTILITIES)
    (folder / "user.cpp").write_text(USER)
    subprocess.run(["gfortran", "-O1", "-c", "uses.f"], cwd=folder, check=True)
    utilities = here.parents[1] / "examples/points_library/umat_utilities.cpp"
    subprocess.run([compiler, *flags, "user.cpp", str(utilities), "uses.o", "-lgfortran", "-o", "user"], cwd=folder, check=True)
    user = subprocess.run([folder / "user"], check=True, capture_output=True, text=True).stdout
errors = [float(line) for line in user.splitlines() if not re.search("[a-z]{2}", line)]
expect(len(errors) == 16 and max(map(abs, errors)) < 1e-14 and "a UMAT called XIT" in user, f"the routines of Abaqus: {user}")
print(done.stdout, end="")
differences = [float(number) for number in done.stdout.split()]
expect(len(differences) == 4, f"four differences are expected, these came: {done.stdout}")
for number in differences:
    # The formulas are the same; the compilers may order sums differently: round-off of 20 steps.
    expect(number < 1e-12, f"Fortran and C++ differ by {number}")
finish()
