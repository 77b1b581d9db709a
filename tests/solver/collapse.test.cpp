// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/collapse.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using Grid = scarp::Discretisation<scarp::Quad8, scarp::SmallStrain, scarp::ReducedIntegration>;
using Soil = scarp::MohrCoulomb<2>;

scarp::IsotropicElasticity stiffness() { return scarp::IsotropicElasticity::from_young_poisson(100e6, 0.3); }

/// A slope of 2 to 1 on a rough base, 10 m high, as in Griffiths and Lane (1999), example 1: phi = 20 degrees, c = 0.05
/// gamma H, no dilation.
scarp::Model<2> slope(double factor) {
  double const height = 10.0, crest = 12.0, weight = 20e3;
  scarp::Model<2> model(Grid(scarp::BoxMesh<scarp::Quad8>{
      .lengths = scarp::Vector<2>(1.0, height), .cells = {16, 8}, .map = [=](scarp::Vector<2> const& box) {
        return scarp::Vector<2>(box.x() * (crest + 2.0 * (height - box.y())), box.y());
      }}.generate()));
  model.fix({"left"}, 0);
  model.fix({"bottom"});
  model.gravity(weight);
  double const friction = std::atan(std::tan(20.0 / 180.0 * 3.14159265358979) / factor);
  model.material("soil", Soil{.elasticity = stiffness(),
                              .strength = {{.cohesion = 0.05 * weight * height / factor, .friction = friction}}});
  return model;
}

}  // namespace

TEST_CASE("a slope's factor of safety is that of its reference") {
  auto const found = scarp::reduce_strength(slope, {.to = 2.0, .tolerance = 0.02});
  INFO(found.why);
  REQUIRE(found.is_found());
  CHECK(found.stands < 1.43);  // 1.4 by finite elements, 1.38 by Bishop and Morgenstern's charts
  CHECK(found.fails > 1.36);
}

TEST_CASE("a block of clay between smooth platens carries 2 c, and what is less is no failure") {
  scarp::Model<2> model(
      Grid(scarp::BoxMesh<scarp::Quad8>{.lengths = scarp::Vector<2>(2.0, 2.0), .cells = {2, 2}}.generate()));
  model.fix({"left"}, 0);
  model.fix({"bottom"}, 1);
  model.surcharge({"top"}, 1e3, scarp::TimeFunction::after(1.0));
  model.material("soil", Soil{.elasticity = stiffness(), .strength = {{.cohesion = 10e3}}});
  auto settings = scarp::StrengthReduction{}.analysis;
  settings.stepping = {.first = 1.0, .smallest = 1e-3, .largest = 2.0};
  scarp::Analysis analysis(model, settings);
  REQUIRE(analysis.to(1.0).verdict.acceptable());
  auto const carried = find_collapse(analysis, 11.0);
  CHECK(carried.stands());
  CHECK(!carried.failed);
  CHECK(carried.ratio == samples::Approx(1.0).epsilon(1e-4));  // logarithms of strains of 1e-4
  auto const end = find_collapse(analysis, 41.0);
  INFO(end.why, end.ratio);
  CHECK(end.failed);
  CHECK(end.why.starts_with("the ground fails beyond the load factor 2"));
  CHECK(1e3 * (end.load - 1.0) == samples::Approx(20e3).epsilon(1e-3));  // analytic
}

TEST_CASE("ground at rest that is loaded later does not fail: round-off is no stiffness") {
  scarp::Model<2> model(
      Grid(scarp::BoxMesh<scarp::Quad8>{.lengths = scarp::Vector<2>(2.0, 4.0), .cells = {1, 2}}.generate()));
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"}, 1);
  model.gravity(18e3);
  model.surcharge({"top"}, 50e3, scarp::TimeFunction::ramp(1.0, 2.0));
  model.material(
      "soil", scarp::LinearElastic<2, scarp::GeostaticStress<2>>::from_young_poisson(40e6, 0.25, model.geostatic(0.5)));
  scarp::Analysis analysis(model, {.threads = 1});
  auto const end = find_collapse(analysis, 2.0);
  CHECK(end.stands());
  CHECK(!end.failed);
}

namespace {

/// Elastic, without a response beyond a strain.
struct Brittle : scarp::LinearElastic<2> {
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    auto response = scarp::LinearElastic<2>::respond(committed, increment, trial);
    if (response.stress(1) < -10e3) response.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return response;
  }
};

}  // namespace

TEST_CASE("a point that does not respond is no failure of the ground") {
  scarp::Model<2> model(
      Grid(scarp::BoxMesh<scarp::Quad8>{.lengths = scarp::Vector<2>(2.0, 2.0), .cells = {1, 1}}.generate()));
  model.fix({"left"}, 0);
  model.fix({"bottom"}, 1);
  model.surcharge({"top"}, 20e3);
  model.material("soil", Brittle{scarp::LinearElastic<2>::from_young_poisson(40e6, 0.25)});
  scarp::Analysis analysis(model, {.threads = 1});
  auto const end = find_collapse(analysis, 1.0);
  CHECK(!end.stands());
  CHECK(!end.failed);
  CHECK(end.load == samples::Approx(0.5).epsilon(1e-2));  // 10 of 20 kPa
  CHECK(end.why.find("step_too_small, after unbalanced at point") != std::string::npos);
  auto const found = scarp::reduce_strength([&](double) {
    scarp::Model<2> again(model.grid().copy());
    again.fix({"left"}, 0);
    again.fix({"bottom"}, 1);
    again.surcharge({"top"}, 20e3);
    again.material("soil", Brittle{scarp::LinearElastic<2>::from_young_poisson(40e6, 0.25)});
    return again;
  });
  CHECK(!found.is_found());
  CHECK(found.fails == 0.0);
  CHECK(found.why.find("factor 1: ") != std::string::npos);
}

TEST_CASE("an attempt that a point has stopped says nothing of the ground") {
  struct Strained {
    double gradient;
    double max_displacement_gradient() const { return gradient; }
  };
  scarp::CollapseWatch watch(100.0);
  scarp::StepReport step{.load_increment = 1.0, .history = std::vector<scarp::IterationRecord>(1)};
  watch.attempted(Strained{1e-3}, step);
  CHECK(watch.ratio() == 1.0);
  step.verdict = {scarp::Status::not_converged, scarp::Reason::iterations_spent};
  step.worst_point = 3;
  watch.attempted(Strained{1.0}, step);
  CHECK(watch.ratio() == 1.0);
  step.worst_point = -1;
  watch.attempted(Strained{1.0}, step);
  CHECK(watch.ratio() == samples::Approx(1e3).epsilon(1e-12));
  CHECK(!watch.wants_stop());  // no step was accepted there
}

TEST_CASE("a strength that the first factor does not leave, and one that the last one leaves, are told apart") {
  auto const early = scarp::reduce_strength(slope, {.from = 1.8, .to = 2.0});
  CHECK(early.stands == 0.0);
  CHECK(early.fails == 1.8);
  auto const late = scarp::reduce_strength(slope, {.from = 1.0, .to = 1.1});
  CHECK(late.stands == 1.1);
  CHECK(late.fails == 0.0);
}

TEST_CASE("settings that make no sense are rejected") {
  CHECK_REFUSED(scarp::reduce_strength(slope, {.from = 0.0}), "least factor of safety");
  CHECK_REFUSED(scarp::reduce_strength(slope, {.from = 2.0, .to = 1.0}), "largest factor of safety");
  CHECK_REFUSED(scarp::reduce_strength(slope, {.tolerance = 1e-17}), "tolerance of a factor of safety");
  CHECK_REFUSED(scarp::detail::validated(scarp::CollapseSettings{.failed = 5.0}), "has failed");
  auto const later = [](double factor) {
    auto model = slope(factor);
    model.surcharge({"top"}, 1e3, scarp::TimeFunction::ramp(1.0, 2.0));
    return model;
  };
  CHECK_REFUSED(scarp::reduce_strength(later), "loads change at 2");
  CHECK_REFUSED(scarp::reduce_strength(slope, {.load = 0.5}), "loads change at 1");  // half of the weight
}

namespace {

/// Elastic up to a size of strain, and a thousand times softer beyond it.
struct Bilinear {
  static constexpr int dim = 2;
  static constexpr bool exact_tangent = true;
  struct State {
    scarp::EngineeringStrain<2> strain = scarp::EngineeringStrain<2>::Zero();
    SCARP_MEMBERS(strain)
  };
  double yields = 1.0;

  static State initial_state(scarp::Site<2> const&) { return {}; }
  scarp::VoigtStress<2> stress(State const& state) const {
    return share(state.strain.norm()) * elastic() * state.strain;
  }
  scarp::VoigtTangent<2> tangent(State const& state) const {
    double const size = state.strain.norm();
    scarp::VoigtTangent<2> found = share(size) * elastic();
    if (size > yields)
      found += (softer - share(size)) / (size * size) * elastic() * state.strain * state.strain.transpose();
    return found;
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    trial = {committed.strain + scarp::to_engineering_strain<2, double>(increment)};
    return {stress(trial), {}};
  }

 private:
  static constexpr double softer = 1e-3;
  static scarp::VoigtTangent<2> elastic() { return scarp::LinearElastic<2>::from_young_poisson(1e7, 0.25).tangent({}); }
  double share(double size) const { return size <= yields ? 1.0 : (yields + softer * (size - yields)) / size; }
};

}  // namespace

TEST_CASE("ground that fails in the step which comes to the end has failed, whatever the length of the steps") {
  // Of a side under 1 kPa: (1 - nu^2, -nu (1 + nu)) times stress over modulus.
  double const strain = 1e-4 * std::hypot(1.0 - 0.25 * 0.25, 0.25 * 1.25);
  auto const model = [&](double factor) {
    scarp::Model<2> made(Grid(scarp::BoxMesh<scarp::Quad8>{.cells = {1, 1}}.generate()));
    made.fix({"left"}, 0);
    made.fix({"bottom"}, 1);
    made.surcharge({"top"}, 1e3, scarp::TimeFunction::ramp(0.0, 1.0));
    made.material("soil", Bilinear{.yields = 0.97 * strain / factor});
    return made;
  };
  for (double const step : {0.05, 0.01}) {
    CAPTURE(step);
    scarp::StrengthReduction settings;
    settings.to = 1.2;
    settings.analysis.stepping.first = settings.analysis.stepping.largest = step;
    scarp::Analysis analysis(model(1.0), settings.analysis);
    auto const end = find_collapse(analysis, 1.0);
    CHECK(end.failed);
    CHECK_FALSE(end.stands());
    auto const factor = scarp::reduce_strength(model, settings);
    CHECK(factor.stands == 0.0);
    CHECK(factor.fails == 1.0);
  }
}

TEST_CASE("ground that is left without stiffness has failed, also by the default settings") {
  for (double const friction : {0.0, 0.5}) {
    scarp::Model<2> model(
        Grid(scarp::BoxMesh<scarp::Quad8>{.lengths = scarp::Vector<2>(2.0, 2.0), .cells = {1, 1}}.generate()));
    model.fix({"left"}, 0);
    model.fix({"bottom"}, 1);
    model.surcharge({"top"}, 1e3, scarp::TimeFunction::after(0.0));
    model.material("soil", Soil{.elasticity = stiffness(), .strength = {{.cohesion = 10e3, .friction = friction}}});
    scarp::Analysis analysis(model, {.stepping = {.first = 1.0, .smallest = 1e-3, .largest = 2.0}});
    auto const end = find_collapse(analysis, 100.0);
    INFO(end.why, end.ratio);
    CHECK(end.failed);
    double const exact = 2.0 * 10e3 * std::tan(0.785398163397448 + friction / 2.0);  // of a free block
    CHECK(1e3 * end.load == samples::Approx(exact).epsilon(1e-2));
  }
}

TEST_CASE("a factor that the stress at rest does not bear ends no search for that of safety") {
  auto const at_rest = [](double factor) {
    double const friction = std::atan(std::tan(20.0 / 180.0 * 3.14159265358979) / factor);
    using AtRest = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
    scarp::Model<2> own(slope(factor).grid().copy());
    own.fix({"left"}, 0);
    own.fix({"bottom"});
    own.gravity(20e3);
    own.set_surface_level(10.0);
    own.material("soil", AtRest{.elasticity = stiffness(),
                                .strength = {{.cohesion = 10e3 / factor, .friction = friction}},
                                .initial = own.geostatic(0.5)});
    return own;
  };
  auto const found = scarp::reduce_strength(at_rest, {.to = 4.0, .tolerance = 0.05});
  INFO(found.why);
  CHECK(found.stands > 1.0);
  CHECK(found.stands < 1.45);
  if (found.fails == 0.0) CHECK(found.why.find("initial stress") != std::string::npos);
}

namespace {

/// Ends a run at the first accepted step after a rejected one.
struct EndsAfterRejection {
  bool is_rejected = false, is_over = false;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const& report) {
    if (!report.verdict.acceptable()) is_rejected = true;
    is_over = is_rejected && report.verdict.acceptable();
  }
  bool wants_stop() const { return is_over; }
};

}  // namespace

TEST_CASE("a run that its observer ends has not failed, whatever was rejected before") {
  scarp::Model<2> model(
      Grid(scarp::BoxMesh<scarp::Quad8>{.lengths = scarp::Vector<2>(2.0, 2.0), .cells = {1, 1}}.generate()));
  model.fix({"left"}, 0);
  model.fix({"bottom"}, 1);
  model.surcharge({"top"}, 1e3, scarp::TimeFunction::after(0.0));
  model.material("soil", Soil{.elasticity = stiffness(), .strength = {{.cohesion = 10e3}}});
  scarp::Analysis analysis(model, {.stepping = {.first = 1.0, .smallest = 1e-3, .largest = 2.0}});
  EndsAfterRejection observer;
  auto const end = find_collapse(analysis, 100.0, {}, observer);
  INFO(end.why);
  CHECK(observer.is_rejected);
  CHECK(end.run.last_failure == scarp::Reason::singular_system);
  CHECK(!end.failed);
}
