// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/mohr_coulomb.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "scarp/constitutive/strength.hpp"
#include "scarp/core/random.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Strength;
using scarp::Tensor;
using scarp::Vector;
using scarp::detail::mohr_coulomb_return;
using scarp::detail::PrincipalReturn;

double degrees(double angle) { return angle * std::numbers::pi / 180.0; }

/// A strength and a trial stress at random; angles include 0, cohesion includes 0, some have a tension cut-off.
struct RandomCase {
  Strength strength;
  scarp::IsotropicElasticity elasticity;
  Vector<3> trial;

  explicit RandomCase(scarp::Random& random) {
    strength.friction = random.uniform() < 0.15 ? 0.0 : degrees(random.uniform(1.0, 50.0));
    strength.dilation = random.uniform() < 0.3 ? 0.0 : strength.friction * random.uniform();
    if (random.uniform() < 0.2) strength.dilation = strength.friction;
    bool const needs_cohesion = strength.friction == 0.0;
    strength.cohesion = !needs_cohesion && random.uniform() < 0.2 ? 0.0 : random.uniform(0.1, 10.0);
    if (random.uniform() < 0.3) strength.tension = strength.cohesion * random.uniform();
    elasticity = scarp::IsotropicElasticity::from_young_poisson(random.uniform(100.0, 1e4), random.uniform(0.0, 0.49));
    double const size = std::pow(10.0, random.uniform(-1.0, 3.0));
    for (int i = 0; i < 3; ++i) trial(i) = size * random.uniform(-1.0, 1.0);
    trial.array() -= size * random.uniform(-0.5, 1.0);
    if (random.uniform() < 0.1) trial(1) = trial(0);
    if (random.uniform() < 0.1) trial(2) = trial(1);
    std::sort(trial.data(), trial.data() + 3, std::greater<>());
  }

  double scale() const { return std::max(strength.cohesion, trial.cwiseAbs().maxCoeff()); }

  /// Largest excess over the surface of all six pairs and three cut-offs, whatever the order of the stresses.
  double excess(Vector<3> const& stress) const {
    double worst = -1e300;
    double const sine = std::sin(strength.friction);
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, stress(i) - strength.cut_off());
      for (int j = 0; j < 3; ++j) {
        if (i == j) continue;
        double const shear = stress(i) - stress(j) + (stress(i) + stress(j)) * sine;
        worst = std::max(worst, shear - 2.0 * strength.cohesion * std::cos(strength.friction));
      }
    }
    return worst;
  }
};

PrincipalReturn return_of(RandomCase const& drawn) {
  return mohr_coulomb_return(drawn.strength, drawn.elasticity.lame_lambda, drawn.elasticity.shear_modulus, drawn.trial);
}

Tensor<3> principal_compliance(scarp::IsotropicElasticity const& elasticity) {
  return elasticity.stiffness<3>().topLeftCorner<3, 3>().inverse();
}

/// The admissible stress that is nearest to the trial stress in the energy norm, by Dykstra's alternating projections
/// onto all nine half-spaces; knows nothing of faces, edges and corners. Boyle and Dykstra 1986.
Vector<3> nearest_admissible(RandomCase const& drawn) {
  Tensor<3> const stiffness = drawn.elasticity.stiffness<3>().topLeftCorner<3, 3>();
  std::vector<std::pair<Vector<3>, double>> planes;
  double const sine = std::sin(drawn.strength.friction);
  for (int i = 0; i < 3; ++i) {
    if (std::isfinite(drawn.strength.cut_off())) planes.emplace_back(Vector<3>::Unit(i), drawn.strength.cut_off());
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      planes.emplace_back((1.0 + sine) * Vector<3>::Unit(i) - (1.0 - sine) * Vector<3>::Unit(j),
                          2.0 * drawn.strength.cohesion * std::cos(drawn.strength.friction));
    }
  }
  std::vector<Vector<3>> kept(planes.size(), Vector<3>::Zero());
  Vector<3> point = drawn.trial;
  for (int sweep = 0; sweep < 20000; ++sweep) {
    double moved = 0.0;  // of the corrections: the point may rest for many sweeps before it goes on
    for (std::size_t k = 0; k < planes.size(); ++k) {
      auto const& [normal, limit] = planes[k];
      Vector<3> const from = point + kept[k];
      double const over = std::max(0.0, normal.dot(from) - limit);
      point = from - over * stiffness * normal / normal.dot(stiffness * normal);
      moved = std::max(moved, (from - point - kept[k]).norm());
      kept[k] = from - point;
    }
    if (moved <= 1e-13 * drawn.scale()) break;
  }
  return point;
}

}  // namespace

TEST_CASE("a hundred thousand random trial stresses return to the surface, dissipating, in order") {
  scarp::Random random(20260101);
  std::array<int, 4> places{};
  for (int draw = 0; draw < 100'000; ++draw) {
    RandomCase const drawn(random);
    auto const returned = return_of(drawn);
    CAPTURE(draw);
    REQUIRE(returned.found);
    ++places[static_cast<std::size_t>(returned.planes)];
    REQUIRE(drawn.excess(returned.stress) <= 1e-10 * drawn.scale());
    if (returned.planes > 0) REQUIRE(drawn.excess(returned.stress) >= -1e-10 * drawn.scale());
    REQUIRE(returned.stress.dot(returned.plastic_strain) >=
            -1e-12 * drawn.scale() * returned.plastic_strain.cwiseAbs().maxCoeff());
    REQUIRE(returned.stress(0) >= returned.stress(1) - 1e-10 * drawn.scale());
    REQUIRE(returned.stress(1) >= returned.stress(2) - 1e-10 * drawn.scale());
    Vector<3> const elastic = principal_compliance(drawn.elasticity) * (drawn.trial - returned.stress);
    REQUIRE((elastic - returned.plastic_strain).norm() <= 1e-9 * (elastic.norm() + 1e-6));
  }
  MESSAGE("elastic " << places[0] << ", faces " << places[1] << ", edges " << places[2] << ", corners " << places[3]);
  for (int const count : places) CHECK(count > 3000);
}

TEST_CASE("associated return is the nearest admissible stress in the energy norm, as alternating projections find it") {
  scarp::Random random(7);
  std::array<int, 4> places{};
  int compared = 0;
  for (int draw = 0; draw < 3000; ++draw) {
    RandomCase drawn(random);
    drawn.strength.dilation = drawn.strength.friction;
    auto const returned = return_of(drawn);
    REQUIRE(returned.found);
    auto const expected = nearest_admissible(drawn);
    // Alternating projections may be slow between nearly parallel planes; where they have not arrived they say nothing.
    if (drawn.excess(expected) > 1e-11 * drawn.scale()) continue;
    ++compared;
    ++places[static_cast<std::size_t>(returned.planes)];
    CAPTURE(draw);
    CHECK((returned.stress - expected).norm() <= 1e-7 * drawn.scale());
  }
  MESSAGE(compared << " compared: faces " << places[1] << ", edges " << places[2] << ", corners " << places[3]);
  CHECK(compared > 2000);
  for (int const count : places) CHECK(count > 100);
}

namespace {

template <class Provider>
struct Derivative {
  double worst = 0.0;
  int compared = 0;
};

/// Largest distance of the consistent tangent from central differences, relative to the elastic stiffness, over random
/// increments whose neighbours return to the same place.
template <int Dim, class StrengthType>
Derivative<StrengthType> tangent_error(StrengthType const& strength, int draws) {
  using Provider = scarp::MohrCoulomb<Dim, scarp::StressFree<Dim>, StrengthType>;
  Provider const soil{scarp::IsotropicElasticity::from_young_poisson(1e4, 0.3), strength, {}};
  scarp::Random random(11);
  Derivative<StrengthType> result;
  for (int draw = 0; draw < draws; ++draw) {
    auto state = soil.initial_state({});
    state.stress.template head<3>().setConstant(-random.uniform(0.0, 40.0));
    if constexpr (StrengthType::changes) state.plastic_shear = random.uniform(0.005, 0.05);
    scarp::Gradient<Dim> increment;
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j) increment(i, j) = 4e-3 * random.uniform(-1.0, 1.0);
    }
    increment = ((increment + increment.transpose()) / 2.0).eval();
    // The strain of the answer is E = 2 (U - I)(U + I)^-1: drive by the U that belongs to a wanted strain.
    auto const stretch_of = [](scarp::Gradient<Dim> const& strain) -> scarp::Gradient<Dim> {
      Tensor<Dim> const identity = Tensor<Dim>::Identity();
      return 2.0 * strain * (2.0 * identity - strain).inverse();
    };
    auto trial = state;
    auto const answer = soil.respond(state, stretch_of(increment), trial);
    REQUIRE(answer.verdict.acceptable());
    auto const tangent = soil.tangent(trial);
    double const step = 1e-7;
    scarp::VoigtTangent<Dim> up;
    scarp::VoigtTangent<Dim> down;
    for (int k = 0; k < scarp::voigt_size<Dim>; ++k) {
      auto const [i, j] = scarp::voigt_indices<Dim>()[static_cast<std::size_t>(k)];
      scarp::Gradient<Dim> unit = scarp::Gradient<Dim>::Zero();
      unit(i, j) += 0.5;
      unit(j, i) += 0.5;
      auto other = state;
      up.col(k) = (soil.respond(state, stretch_of(increment + step * unit), other).stress - answer.stress) / step;
      down.col(k) = (answer.stress - soil.respond(state, stretch_of(increment - step * unit), other).stress) / step;
    }
    double const size = soil.elasticity.template stiffness<Dim>().norm();
    if ((up - down).norm() > 1e-4 * size) continue;  // on a kink between two places
    result.worst = std::max(result.worst, ((up + down) / 2.0 - tangent).norm() / size);
    ++result.compared;
  }
  return result;
}

}  // namespace

TEST_CASE("the consistent tangent is the derivative of the answer") {
  // Central differences: round-off of stresses of 100 Pa over 1e-7 of strain, 1e-7 Pa, relative to 1e4 Pa: 1e-11;
  // curvature, from turning principal axes, 1e-14 times strain^-2.
  Strength const sand{.cohesion = 5.0, .friction = degrees(33.0), .dilation = degrees(7.0)};
  Strength const cut{.cohesion = 5.0, .friction = degrees(33.0), .dilation = degrees(7.0), .tension = 1.0};
  Strength const clay{.cohesion = 5.0};
  for (auto const& strength : {sand, cut, clay}) {
    auto const plane = tangent_error<2>(scarp::ConstantStrength{strength}, 2000);
    auto const space = tangent_error<3>(scarp::ConstantStrength{strength}, 2000);
    MESSAGE("plane " << plane.worst << " in " << plane.compared << ", space " << space.worst << " in "
                     << space.compared);
    CHECK(plane.worst < 1e-6);
    CHECK(space.worst < 1e-6);
    CHECK(plane.compared > 1900);
    CHECK(space.compared > 1900);
  }
}

TEST_CASE("the consistent tangent is the derivative of the answer while strength falls") {
  scarp::SofteningStrength const strength{
      .peak = {.cohesion = 5.0, .friction = degrees(35.0), .dilation = degrees(10.0)},
      .residual = {.cohesion = 1.0, .friction = degrees(28.0), .dilation = 0.0},
      .softening_strain = 0.08};
  auto const plane = tangent_error<2>(strength, 2000);
  auto const space = tangent_error<3>(strength, 2000);
  MESSAGE("plane " << plane.worst << " in " << plane.compared << ", space " << space.worst << " in " << space.compared);
  CHECK(plane.worst < 1e-6);
  CHECK(space.worst < 1e-6);
  CHECK(plane.compared > 1900);
  CHECK(space.compared > 1900);
}

TEST_CASE("the consistent tangent is that of falling strength from the first plastic strain on") {
  constexpr double fall = 1e6;  // [Pa] of cohesion over plastic shear strain
  scarp::SofteningStrength const strength{
      .peak = {.cohesion = 100.0}, .residual = {.cohesion = 50.0}, .softening_strain = 50.0 / fall};
  scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength> const clay{
      scarp::IsotropicElasticity::from_young_poisson(10e6, 0.3), strength, {}};
  double const modulus = clay.elasticity.shear_modulus;
  auto const state = clay.initial_state({});
  for (double const beyond : {1e-8, 2e-7, 5e-6}) {
    CAPTURE(beyond);
    auto trial = state;
    scarp::Gradient<2> shear = scarp::Gradient<2>::Zero();
    shear(0, 1) = shear(1, 0) = (100.0 / modulus + beyond) / 2.0;
    REQUIRE(clay.respond(state, shear, trial).verdict.acceptable());
    REQUIRE(trial.plastic_shear > 0.0);
    // Analytic: tau = c - h (gamma - tau / G), so that its slope is -h / (1 - h / G).
    CHECK(trial.tangent(2, 2) == samples::Approx(-fall / (1.0 - fall / modulus)).epsilon(1e-6));
  }
}

TEST_CASE("strength that softens reaches its residual value and stays there") {
  scarp::SofteningStrength const strength{
      .peak = {.cohesion = 10e3}, .residual = {.cohesion = 4e3}, .softening_strain = 0.02};
  scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength> const clay{
      scarp::IsotropicElasticity::from_young_poisson(10e6, 0.3), strength, {}};
  auto state = clay.initial_state({});
  double highest = 0.0;
  scarp::Gradient<2> shear = scarp::Gradient<2>::Zero();
  shear(0, 1) = shear(1, 0) = 1e-4;
  for (int step = 0; step < 200; ++step) {
    auto trial = state;
    REQUIRE(clay.respond(state, shear, trial).verdict.acceptable());
    state = trial;
    highest = std::max(highest, state.stress(5));
  }
  // Analytic: simple shear of a Tresca material yields at c; steps of 2e-4 of shear may pass the peak by one of them.
  CHECK(highest == samples::Approx(10e3).epsilon(0.1));
  CHECK(state.stress(5) == samples::Approx(4e3).epsilon(1e-9));
}

TEST_CASE("softening too steep for the elastic unloading of a point comes to the residual strength at once") {
  scarp::SofteningStrength const strength{
      .peak = {.cohesion = 10e3}, .residual = {.cohesion = 1e3}, .softening_strain = 1e-5};
  scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength> const clay{
      scarp::IsotropicElasticity::from_young_poisson(10e6, 0.3), strength, {}};
  auto const state = clay.initial_state({});
  auto trial = state;
  scarp::Gradient<2> shear = scarp::Gradient<2>::Zero();
  shear(0, 1) = shear(1, 0) = 2e-3;
  REQUIRE(clay.respond(state, shear, trial).verdict.acceptable());
  // Analytic: 4e-3 of shear strain less the elastic 1e3 / 3.85e6 is far beyond the 1e-5 of the fall.
  CHECK(trial.stress(5) == samples::Approx(1e3).epsilon(1e-9));
}

TEST_CASE("softening just below the rate at which a point snaps back finds its strength") {
  constexpr double modulus = 10e6;
  constexpr double cohesion = 20e3;
  for (auto const& [rate, part] : {std::pair{0.9, 1e-3}, {0.94, 1e-3}, {0.99, 1e-1}, {0.9999, 1e-1}}) {
    double const share = rate;
    CAPTURE(share);
    double const fall = cohesion / (share * modulus);
    scarp::SofteningStrength const strength{{.cohesion = cohesion}, {.cohesion = 0.0}, fall};
    scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength> const clay{
        scarp::IsotropicElasticity::from_lame(modulus, modulus), strength};
    auto const state = clay.initial_state({});
    auto trial = state;
    double const sheared = cohesion / modulus + part * fall * (1.0 - share);
    scarp::Gradient<2> shear = scarp::Gradient<2>::Zero();
    shear(0, 1) = shear(1, 0) = 0.5 * sheared;
    REQUIRE(clay.respond(state, shear, trial).verdict.acceptable());
    // Analytic: G (gamma - kappa) = c - share G kappa; the strain is that of the increment but for the third order.
    double const strain = 2.0 * scarp::RotatedIncrement<2>(shear).strain(0, 1);
    double const exact = (strain - cohesion / modulus) / (1.0 - share);
    CHECK(trial.plastic_shear == samples::Approx(exact).epsilon(1e-8));
  }
}

TEST_CASE("an increment to which no strength belongs is refused with a reason") {
  // Tension of 1 kPa is cut off until 1e-4 of plastic shear, then none. Stretched by 2e-3 the ground yields by 2e-3
  // below the cut-off, so not by so little; without a cut-off its stresses of 26.9 and 11.5 kPa are elastic for a
  // cohesion of 10 kPa.
  scarp::SofteningStrength const strength{
      .peak = {.cohesion = 10e3, .tension = 1e3}, .residual = {.cohesion = 10e3}, .softening_strain = 1e-4};
  scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength> const clay{
      scarp::IsotropicElasticity::from_young_poisson(10e6, 0.3), strength, {}};
  auto const state = clay.initial_state({});
  auto trial = state;
  scarp::Gradient<2> stretch = scarp::Gradient<2>::Zero();
  stretch(0, 0) = 2e-3;
  CHECK(clay.respond(state, stretch, trial).verdict == scarp::Verdict{scarp::Status::failed, scarp::Reason::no_return});
  CHECK(trial.stress == state.stress);
  CHECK(trial.plastic_shear == 0.0);
}

TEST_CASE("stresses return near incompressibility as elsewhere") {
  scarp::Random random(5);
  std::array<int, 4> places{};
  for (double const poisson : {0.495, 0.499, 0.4999, 0.49999, 0.499999}) {
    for (int draw = 0; draw < 5000; ++draw) {
      RandomCase drawn(random);
      drawn.elasticity = scarp::IsotropicElasticity::from_young_poisson(1e4, poisson);
      if (draw % 10 == 0) drawn.strength.friction = drawn.strength.dilation = degrees(89.0);
      CAPTURE(poisson);
      CAPTURE(draw);
      auto const returned = return_of(drawn);
      REQUIRE(returned.found);
      ++places[static_cast<std::size_t>(returned.planes)];
      REQUIRE(drawn.excess(returned.stress) <= 1e-10 * drawn.scale());
      // Analytic: what plastic strain takes away is 2 G of its deviator and K of its trace. Round-off of the strain,
      // 1e-16 of it, times the bulk modulus, at most 5e5 of the shear modulus.
      Vector<3> const taken = drawn.trial - returned.stress;
      double const volume = returned.plastic_strain.sum();
      double const bulk = drawn.elasticity.lame_lambda + 2.0 * drawn.elasticity.shear_modulus / 3.0;
      Vector<3> const deviator = (taken.array() - taken.mean()).matrix();
      Vector<3> const strain = (returned.plastic_strain.array() - volume / 3.0).matrix();
      REQUIRE((deviator - 2.0 * drawn.elasticity.shear_modulus * strain).norm() <= 1e-10 * drawn.scale());
      REQUIRE(std::abs(taken.mean() - bulk * volume) <= 1e-8 * drawn.scale());
    }
  }
  for (int const count : places) CHECK(count > 500);
}

TEST_CASE("at the apex no strain changes the stress, however many planes led there") {
  // Sand without cohesion and Poisson's ratio: two cut-offs take all of a stress in two directions.
  auto const returned = mohr_coulomb_return({.friction = 0.5}, 0.0, 1e6, {2e3, 1e3, 0.0});
  REQUIRE(returned.found);
  CHECK(returned.stress.isZero(1e-9));
  CHECK(returned.tangent.isZero(0.0));
}

TEST_CASE("an initial stress outside the strength is refused with its place and the K0 that would be borne") {
  using Sand = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
  Sand sand{scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3),
            {{.friction = degrees(30.0)}},
            {.surcharge = 4e3, .unit_weight = 16e3, .k0 = 1.0 / 3.0}};  // analytic: just borne, tan^2(45 - phi/2)
  scarp::Site<2> const site{.index = 4, .region = 1, .depth = 10.0};
  CHECK_NOTHROW(sand.initial_state(site));
  for (double const k0 : {0.333, 3.001}) {
    sand.initial.k0 = k0;
    CHECK_REFUSED(sand.initial_state(site), "point 4 in region 1, 10 m deep", "K0 lies between 0.333 and 3.000");
  }
  sand.strength.strength.cohesion = 1e3;
  CHECK_NOTHROW(sand.initial_state(site));
}

TEST_CASE("friction alone carries no tension") {
  CHECK(Strength{.friction = 0.5}.cut_off() == 0.0);
  CHECK(Strength{.cohesion = 2.0, .friction = std::atan(0.5)}.apex() == samples::Approx(4.0).epsilon(1e-15));
}

TEST_CASE("a strength that cannot be is refused") {
  scarp::MohrCoulomb<2> soil{scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3), {}, {}};
  auto const refused = [&](Strength const& wrong, char const* what) {
    soil.strength.strength = wrong;
    CHECK_REFUSED(soil.initial_state({}), what);
  };
  refused({.cohesion = -1.0}, "cohesion is -1");
  refused({.friction = 30.0}, "friction angle is 30 rad");
  refused({.friction = 0.5, .dilation = 0.6}, "dilation is 0.6 rad with a friction of 0.5");
  refused({.friction = std::numeric_limits<double>::quiet_NaN()}, "friction angle is nan");
  refused({.cohesion = 1.0, .tension = -1.0}, "tensile strength is -1");
  refused({.friction = std::numbers::pi / 2.0}, "friction angle is 1.57");
}

namespace {

/// A law whose own check passes what would create energy: dilation beyond friction, from the start or on the way.
struct Careless {
  static constexpr bool changes = true;
  double from = 0.0;
  double to = 0.0;
  Strength at(double shear) const {
    return {.cohesion = 1e3, .friction = 0.5, .dilation = shear >= from && shear < to ? 0.6 : 0.1};
  }
  void validate() const {}
};

}  // namespace

TEST_CASE("the strengths of a user's law are checked whatever the law checks itself") {
  using Soil = scarp::MohrCoulomb<2, scarp::StressFree<2>, Careless>;
  auto const stiff = scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3);
  CHECK_NOTHROW(Soil{stiff}.initial_state({}));
  for (auto const& wrong : {Careless{0.0, 1e-9}, Careless{0.02, 0.3}, Careless{5.0, 1e9}})
    CHECK_REFUSED((Soil{stiff, wrong}.initial_state({})), "dilation is 0.6 rad with a friction of 0.5");
}

TEST_CASE("friction may soften to none: a cut-off holds on the way and no strength is NaN") {
  scarp::SofteningStrength const strength{.peak = {.cohesion = 20e3, .friction = 0.35},
                                          .residual = {.cohesion = 10e3, .friction = 0.0},
                                          .softening_strain = 0.1};
  for (double const shear : {0.0, 1e-6, 0.05, 0.0999, 0.1, 1.0}) {
    Strength const now = strength.at(shear);
    CAPTURE(shear);
    CHECK(std::isfinite(now.cohesion));
    CHECK(now.cut_off() > 0.0);  // fails for NaN
  }
  CHECK(strength.at(0.0).cut_off() == strength.peak.cut_off());
  CHECK(strength.at(0.05).cut_off() <= strength.peak.cut_off());
  CHECK(std::isinf(strength.at(0.1).cut_off()));
  scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength> const clay{
      scarp::IsotropicElasticity::from_young_poisson(10e6, 0.3), strength, {}};
  auto state = clay.initial_state({});
  scarp::Gradient<2> shear = scarp::Gradient<2>::Zero();
  shear(0, 1) = shear(1, 0) = 5e-4;
  for (int step = 0; step < 300; ++step) {
    auto trial = state;
    REQUIRE(clay.respond(state, shear, trial).verdict.acceptable());
    state = trial;
  }
  CHECK(state.stress(5) == samples::Approx(10e3).epsilon(1e-9));
}

TEST_CASE("a residual strength that cannot be is refused as the peak is") {
  scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength> soil{
      scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3), {}, {}};
  scarp::SofteningStrength const sound{.peak = {.cohesion = 1e3, .friction = 0.5, .dilation = 0.1},
                                       .residual = {.cohesion = 1e3, .friction = 0.45}};
  soil.strength = sound;
  CHECK_NOTHROW(soil.initial_state({}));
  soil.strength.residual.friction = 25.0;  // degrees
  CHECK_REFUSED(soil.initial_state({}), "friction angle is 25");
  soil.strength = sound;
  soil.strength.residual.dilation = 0.5;
  CHECK_REFUSED(soil.initial_state({}), "dilation is 0.5");
  soil.strength = sound;
  soil.strength.softening_strain = 0.0;
  CHECK_REFUSED(soil.initial_state({}), "from peak to residual strength is 0");
}

TEST_CASE("a state that the strength of these points does not bear is rejected, one at its surface is not") {
  auto const soil = [](double friction) {
    return scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>{scarp::IsotropicElasticity::from_young_poisson(2e7, 0.3),
                                                            {{.friction = friction}},
                                                            {.surcharge = 1e5, .unit_weight = 1e4, .k0 = 0.5}};
  };
  auto const strong = soil(0.7);
  auto state = strong.initial_state({.depth = 1.0});
  auto end = state;
  REQUIRE(strong.respond(state, scarp::Gradient<2>{{0.0, 0.0}, {0.0, -2e-2}}, end).verdict.acceptable());
  CHECK_NOTHROW(strong.require_fitting(end));
  CHECK_REFUSED(soil(0.35).require_fitting(end), "another law has made it", "0.35 rad");
}

TEST_CASE("softening ground that is nearly incompressible finds its strength, though to the last bit only") {
  scarp::Random random(3);
  scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength> const sand{
      scarp::IsotropicElasticity::from_young_poisson(20e6, 0.4999),
      {.peak = {.cohesion = 5e3, .friction = 0.6, .dilation = 0.15},
       .residual = {.cohesion = 1e3, .friction = 0.5},
       .softening_strain = 0.2},
      {.surcharge = 100e3, .k0 = 0.8}};
  int refused = 0;
  for (int path = 0; path < 500; ++path) {
    auto state = sand.initial_state({});
    for (int step = 0; step < 10; ++step) {
      double const stretch = random.uniform(-1.0, 1.0);
      scarp::Gradient<2> const increment{{stretch, random.uniform(-1.0, 1.0)},
                                         {random.uniform(-1.0, 1.0), -stretch * random.uniform(0.5, 1.0)}};
      auto end = state;
      refused += !sand.respond(state, 1e-2 * increment, end).verdict.acceptable();
      state = end;
    }
  }
  CHECK(refused == 0);  // else a hundred of them
}

TEST_CASE("stress that is no number lies outside of every strength") {
  Vector<3> const stress(0.0, -1.0, std::numeric_limits<double>::quiet_NaN());
  CHECK_FALSE(scarp::detail::mohr_coulomb_excess({.cohesion = 1e3}, stress) <= 0.0);
}
