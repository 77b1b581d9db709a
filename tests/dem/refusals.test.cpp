// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "../../examples/shared/laboratory_loadings.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/bonded_packing.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Discs;
using scarp::Loading;
using scarp::Tensor;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// Something that is to be refused, and what the refusal names.
struct Case {
  std::string named;
  std::function<void()> attempt;
};

void check_refused(std::vector<Case> const& cases) {
  for (auto const& one : cases) {
    CAPTURE(one.named);
    CHECK_REFUSED(one.attempt(), one.named);
  }
}

Discs lattice() { return samples::triangular_lattice<Discs>(4, 5e-3, 1e-2 * (1.0 - 1e-3)); }

template <class Change>
std::function<void()> step_with(Change change) {
  return [change] {
    auto packing = lattice();
    scarp::TimeStepper<Discs> stepper;
    auto law = samples::study_law();
    change(stepper, law);
    static_cast<void>(stepper.step(packing, law, Tensor<2>::Zero()));
  };
}

template <class Change>
std::function<void()> reach_with(Change change) {
  return [change] {
    auto packing = lattice();
    scarp::TimeStepper<Discs> stepper;
    scarp::Servo servo{.max_steps = 20};
    auto loading = scarp::drained_compression<2>(1e-6, samples::pressure);
    change(servo, loading);
    static_cast<void>(servo.reach(stepper, packing, samples::study_law(), loading));
  };
}

template <class Change>
std::function<void()> prepare_with(Change change) {
  return [change] {
    scarp::IsotropicPreparation preparation{.pressure = samples::pressure};
    change(preparation);
    static_cast<void>(preparation.prepare(lattice(), samples::study_law()));
  };
}

/// Loses a grain of those that are asked for together.
struct LosesOne {
  using Shape = scarp::Disc;
  scarp::SizeOf<Shape> sample(scarp::Random&) const { return {1e-3}; }
  std::vector<scarp::SizeOf<Shape>> sample(scarp::Random&, int count) const {
    return std::vector<scarp::SizeOf<Shape>>(static_cast<std::size_t>(count - 1), {1e-3});
  }
};

template <class Grading>
std::function<void()> cloud_of(Grading grading) {
  return [grading] {
    scarp::Cloud<Grading> const cloud{.grading = grading, .grains = 4, .density = 1.0, .thickness = 1.0};
    static_cast<void>(cloud.template make<scarp::Packing<typename Grading::Shape, scarp::LinearFrictional>>());
  };
}

}  // namespace

TEST_CASE("parameters of a step are refused where they are first used") {
  CHECK_NOTHROW(step_with([](auto&, auto&) {})());
  check_refused({
      {"factor of the local damping is nan",
       step_with([](auto& stepper, auto&) { stepper.damping.factor = no_number; })},
      {"factor of the local damping is 1.5", step_with([](auto& stepper, auto&) { stepper.damping.factor = 1.5; })},
      {"drag of the local damping is -0.1", step_with([](auto& stepper, auto&) { stepper.damping.drag = -0.1; })},
      {"skin over the largest radius is 0", step_with([](auto& stepper, auto&) { stepper.skin_ratio = 0.0; })},
      {"skin over the largest radius is inf", step_with([](auto& stepper, auto&) { stepper.skin_ratio = inf; })},
      {"critical time step is -1", step_with([](auto& stepper, auto&) { stepper.time_step_share = -1.0; })},
      {"critical time step is nan", step_with([](auto& stepper, auto&) { stepper.time_step_share = no_number; })},
      {"normal stiffness of the contact law is 0", step_with([](auto&, auto& law) { law.normal_stiffness = 0.0; })},
      {"tangential stiffness of the contact law is nan",
       step_with([](auto&, auto& law) { law.tangential_stiffness = no_number; })},
      {"no population",
       [] {
         Discs nothing;
         scarp::TimeStepper<Discs> stepper;
         static_cast<void>(stepper.step(nothing, samples::study_law(), Tensor<2>::Zero()));
       }},
      {"no population",
       [] {
         Discs nothing;
         scarp::CellDriver<Discs> const drive(nothing, samples::study_law(), scarp::oedometer<2>(1e-6));
       }},
  });
}

TEST_CASE("a law that is exchanged for one without sense is refused, too") {
  auto packing = lattice();
  scarp::TimeStepper<Discs> stepper;
  REQUIRE(stepper.refresh(packing, samples::study_law()).acceptable());
  auto law = samples::study_law();
  law.normal_stiffness = -6e6;
  CHECK_REFUSED(stepper.refresh(packing, law), "normal stiffness of the contact law is -6000000");
  // What the list does not depend on, too.
  using Rolling = scarp::Packing<scarp::Disc, scarp::RollingResistance<scarp::LinearFrictional>>;
  Rolling::Law rolling{samples::study_law(), 10.0, 0.1};
  auto pair = samples::place<Rolling>(scarp::Tensor<2>::Identity(), {{0.125}, {0.125}}, {{0.25, 0.5}, {0.5, 0.5}});
  scarp::TimeStepper<Rolling> roller;
  REQUIRE(roller.refresh(pair, rolling).acceptable());
  rolling.rolling_friction = -0.1;
  CHECK_REFUSED(roller.refresh(pair, rolling), "rolling friction of the contact law is -0.1");
}

TEST_CASE("parameters of a servo and of its loading are refused") {
  CHECK_NOTHROW(reach_with([](auto&, auto&) {})());
  CHECK_NOTHROW(reach_with([](auto&, auto& loading) {  // constant volume to second order, and a held mean stress
    loading = {.controls = {{scarp::Tensor<2>::Identity(), -samples::pressure}}};
    loading.gradient_per_step.diagonal() << 1e-6, -1e-6 / (1.0 + 1e-6);
  })());
  check_refused({
      {"between checks of the servo is 0", reach_with([](auto& servo, auto&) { servo.check_every = 0; })},
      {"between checks of the servo is -20", reach_with([](auto& servo, auto&) { servo.check_every = -20; })},
      {"step limit of the servo is 0", reach_with([](auto& servo, auto&) { servo.max_steps = 0; })},
      {"stress tolerance of the servo is nan",
       reach_with([](auto& servo, auto&) { servo.stress_tolerance = no_number; })},
      {"unbalanced tolerance of the servo is 0",
       reach_with([](auto& servo, auto&) { servo.unbalanced_tolerance = 0.0; })},
      {"largest strain per step of a held stress is nan",
       reach_with([](auto& servo, auto&) { servo.feedback.fastest = no_number; })},
      {"largest strain per step of a held stress is -1",
       reach_with([](auto& servo, auto&) { servo.feedback.fastest = -1.0; })},
      {"response steps of a held stress is 0",
       reach_with([](auto& servo, auto&) { servo.feedback.response_steps = 0.0; })},
      {"learning steps of a held stress is inf",
       reach_with([](auto& servo, auto&) { servo.feedback.learning_steps = inf; })},
      {"prescribed displacement gradient",
       reach_with([](auto&, auto& loading) { loading.gradient_per_step(0, 1) = no_number; })},
      {"held stress 0 has a direction that is not symmetric",
       reach_with([](auto&, auto& loading) { loading.controls[0].direction(0, 1) = 0.5; })},
      {"strains along the direction of held stress 0",
       reach_with([](auto&, auto& loading) { loading.gradient_per_step(0, 0) = -1e-6; })},
      {"direction of a held stress is 0",
       reach_with([](auto&, auto& loading) { loading.controls[0].direction.setZero(); })},
      {"held stresses 0 and 1 have directions in common", reach_with([](auto&, auto& loading) {
         loading.controls.push_back({scarp::Tensor<2>::Identity(), -samples::pressure});
       })},
      {"strain amplitude of a cyclic loading is 0", [] { static_cast<void>(examples::Cyclic{}.next_sign(1e-3, 1)); }},
  });
}

TEST_CASE("parameters of a preparation are refused") {
  check_refused({
      {"pressure of the preparation is 0", prepare_with([](auto& preparation) { preparation.pressure = 0.0; })},
      {"preparation friction is nan",
       prepare_with([](auto& preparation) { preparation.preparation_friction = no_number; })},
      {"between checks of the servo is 0",
       prepare_with([](auto& preparation) { preparation.consolidation.check_every = 0; })},
      {"stress tolerance of the servo is -1",
       prepare_with([](auto& preparation) { preparation.relaxation.stress_tolerance = -1.0; })},
      {"vertical pressure is nan",
       [] {
         static_cast<void>(scarp::OneDimensionalCompression{}.compress(lattice(), samples::study_law(), {no_number}));
       }},
  });
}

TEST_CASE("sizes that no grains have are refused") {
  using scarp::DiscGrading;
  using scarp::EllipseGrading;
  using Grains = scarp::Population<scarp::Disc>;
  CHECK_NOTHROW(cloud_of(DiscGrading{1e-3, 1e-3})());
  check_refused({
      {"smallest size of the grading is 0", cloud_of(DiscGrading{0.0, 1e-3})},
      {"smallest size of the grading is nan", cloud_of(DiscGrading{no_number, 1e-3})},
      {"largest size of the grading is 0.0005", cloud_of(DiscGrading{1e-3, 5e-4})},
      {"largest size of the grading is inf", cloud_of(DiscGrading{1e-3, inf})},
      {"aspect ratio of the grading is 0", cloud_of(EllipseGrading{1e-3, 2e-3, 0.0})},
      {"a packing of zero grains", [] { Grains({}, 1.0, 1.0); }},
      {"the grading gives 3 grains (asked for 4)", cloud_of(LosesOne{})},
      {"share of the cell filled by the cloud is 1.2",
       [] {
         static_cast<void>(scarp::Cloud<DiscGrading>{
             .grading = {1e-3, 1e-3}, .grains = 4, .density = 1.0, .thickness = 1.0, .filled_share = 1.2}
                               .make<Discs>());
       }},
  });
}

TEST_CASE("bonds that no pull breaks, or that act further than a grain's diameter, are refused in words") {
  using Bond = scarp::CohesiveBond<scarp::LinearFrictional>;
  auto const bond_with = [](double tension, double shear) {
    return std::function<void()>([=] {
      static_cast<void>(scarp::bonded(lattice(), samples::study_law(), Bond{samples::study_law(), tension, shear}));
    });
  };
  check_refused({
      {"tensile strength of the bonds is inf", bond_with(inf, 1.0)},
      {"tensile strength of the bonds is -1", bond_with(-1.0, 1.0)},
      {"shear strength of the bonds is nan", bond_with(1.0, no_number)},
      {"acts across gaps of up to 166", bond_with(1e9, 1.0)},
  });
  CHECK_NOTHROW(bond_with(1.0, inf)());
}
