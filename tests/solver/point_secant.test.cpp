// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/point_secant.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/solver/frozen_tangent.hpp"
#include "support/approx.hpp"
#include "support/factorisations.hpp"

namespace {

using Strain = scarp::EngineeringStrain<2>;
using Stress = scarp::VoigtStress<2>;
using Tangent = scarp::VoigtTangent<2>;

Tangent elastic() { return scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3).tangent({}); }

double least_eigenvalue(Tangent const& tangent) {
  return samples::eigenvalues((tangent + tangent.transpose()) / 2.0)(0);
}

// Of one update of numbers of order 1e7.
constexpr double round_off = 1e-13;

}  // namespace

TEST_CASE("after an update the tangent maps the last change of strain to the change of stress") {
  scarp::PointSecant const rule;
  Strain const strain(1e-3, -2e-3, 5e-4);
  Stress const stress = 0.7 * elastic() * strain;
  Tangent const updated = rule.update<2>(elastic(), elastic(), strain, stress);
  CHECK(least_eigenvalue(updated) > rule.floor * elastic().trace() / 3.0);  // the floor does not disturb this
  CHECK((updated * strain - stress).norm() < round_off * stress.norm());
  // Analytic (Broyden 1965): directions at right angles to the change keep their answer.
  Strain const across = Strain(2e-3, 1e-3, 0.0);
  REQUIRE(across.dot(strain) == 0.0);
  CHECK((updated * across - elastic() * across).norm() < round_off * (elastic() * across).norm());
}

TEST_CASE("a tangent that softens is raised to the floor") {
  scarp::PointSecant const rule{.floor = 0.1};
  Strain const strain(1e-3, -1e-3, 0.0);
  Tangent const updated = rule.update<2>(elastic(), elastic(), strain, -2.0 * elastic() * strain);
  double const floor = 0.1 * elastic().trace() / 3.0;
  CHECK(least_eigenvalue(updated) == samples::Approx(floor).epsilon(1e-9));
  scarp::PointSecant const no_floor{.floor = -1e300};
  Tangent const lowered = no_floor.update<2>(elastic(), elastic(), strain, -2.0 * elastic() * strain);
  CHECK(least_eigenvalue(lowered) < 0.0);
}

TEST_CASE("a change of strain that is noise teaches nothing") {
  scarp::PointSecant const rule{.least_strain_change = 1e-7};
  Stress const noise(1e3, -2e3, 1e3);
  CHECK(rule.update<2>(elastic(), elastic(), Strain(0.9e-7, 0.0, 0.0), noise) == elastic());
  CHECK(rule.update<2>(elastic(), elastic(), Strain::Zero(), noise) == elastic());
  CHECK(rule.update<2>(elastic(), elastic(), Strain::Constant(std::numeric_limits<double>::quiet_NaN()), noise) ==
        elastic());
  CHECK(rule.update<2>(elastic(), elastic(), Strain(1.1e-7, 0.0, 0.0), noise) != elastic());
}

TEST_CASE("a step starts between what the provider says and what was learned") {
  scarp::PointSecant const rule{.provider_share = 0.25};
  Tangent const learned = 0.2 * elastic();
  CHECK((rule.start<2>(elastic(), learned) - 0.4 * elastic()).norm() < round_off * elastic().norm());
}

TEST_CASE("a frozen tangent stays what the provider said") {
  scarp::FrozenTangent const rule;
  Tangent const other = 2.0 * elastic();
  CHECK(rule.start<2>(elastic(), other) == elastic());
  CHECK(rule.update<2>(elastic(), other, Strain(1e-3, 0.0, 0.0), Stress::Ones()) == elastic());
}
