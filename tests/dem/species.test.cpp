// SPDX-License-Identifier: BSL-1.0
// Grains of several species, each pair of which has a contact law of its own.
#include "../../examples/shared/energy_ledger.hpp"
#include "scarp/contact/law_per_species.hpp"

#include <doctest/doctest.h>

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/packing_picture.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "scarp/shape/clump.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/shape/with_species.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Disc;
using scarp::Ellipse;
using scarp::LawPerSpecies;
using scarp::LinearFrictional;
using scarp::Tensor;
using scarp::Vector;
using scarp::WithSpecies;

using Rolling = scarp::RollingResistance<LinearFrictional>;
using Bonded = scarp::CohesiveBond<LinearFrictional>;

static_assert(scarp::ParticleShape<WithSpecies<Disc, 2>> && scarp::ParticleShape<WithSpecies<Ellipse, 3>>);
static_assert(scarp::ParticleShape<WithSpecies<scarp::Sphere, 2>> &&
              scarp::ParticleShape<WithSpecies<scarp::Dumbbell, 2>>);
static_assert(scarp::HasSupport<WithSpecies<Ellipse, 2>> && scarp::HasInnerRadius<WithSpecies<Ellipse, 2>>);
static_assert(!scarp::HasSupport<WithSpecies<Disc, 2>> && !scarp::HasInnerRadius<WithSpecies<Disc, 2>>);
static_assert(scarp::ContactLaw<LawPerSpecies<scarp::Frictionless, 2>>);
static_assert(scarp::HasStoredEnergy<LawPerSpecies<scarp::HertzMindlin<scarp::HertzRestitution>, 2>>);
static_assert(scarp::Bonds<LawPerSpecies<Bonded, 2>> && !scarp::Bonds<LawPerSpecies<LinearFrictional, 2>>);
// What does not tell species apart pays nothing for it.
static_assert(LinearFrictional::inputs.species == 0 && WithSpecies<Disc, 2>::pose_count == Disc::pose_count + 1);

template <class Shape, class Law, int Species = 2>
using Mix = scarp::Packing<WithSpecies<Shape, Species>, LawPerSpecies<Law, Species>>;

/// Stiff sand, soft rubber, and between both.
LawPerSpecies<LinearFrictional, 2> sand_and_rubber() {
  return {{LinearFrictional{.normal_stiffness = 6e6, .tangential_stiffness = 5e6, .friction = 0.5},
           LinearFrictional{.normal_stiffness = 4e5, .tangential_stiffness = 3e5, .friction = 0.7},
           LinearFrictional{.normal_stiffness = 2e5, .tangential_stiffness = 1e5, .friction = 0.9}}};
}

/// The grains of a packing at the same places, of a shape with species.
template <class PackingType, class Shape, class Law, class SpeciesOf>
PackingType with_species(scarp::Packing<Shape, Law> const& plain, SpeciesOf&& species_of) {
  std::vector<scarp::SizeOf<typename PackingType::Shape>> sizes;
  for (std::size_t i = 0; i < plain.grain_count(); ++i) {
    auto const own = plain.population->size(i);
    auto& size = sizes.emplace_back();
    std::copy(own.begin(), own.end(), size.begin());
    size.back() = species_of(i);
  }
  PackingType packing;
  packing.population = std::make_shared<scarp::Population<typename PackingType::Shape> const>(
      sizes, plain.population->density(), plain.population->thickness());
  packing.cell = plain.cell;
  packing.position = plain.position;
  packing.orientation = plain.orientation;
  packing.rest();
  return packing;
}

Tensor<2> shear(double size) {
  Tensor<2> step;
  step << size, 0.5 * size, 0.0, -size;
  return step;
}

template <class PackingType>
examples::EnergyLedger<2> sheared(PackingType& packing, typename PackingType::Law const& law, double size, int steps) {
  scarp::TimeStepper<PackingType> stepper;
  examples::EnergyLedger<2> ledger;
  for (int step = 0; step < steps; ++step) {
    scarp::StepObservation<2> seen;
    double const volume = packing.volume();
    REQUIRE(stepper.template step<scarp::Observe::energy>(packing, law, shear(size), &seen).acceptable());
    ledger.enter(seen, volume, shear(size));
  }
  return ledger;
}

}  // namespace

TEST_CASE_TEMPLATE("two grains meet by the law between their species, whichever comes first", Shape, Disc, Ellipse) {
  constexpr int species = 3;
  using Grains = Mix<Shape, LinearFrictional, species>;
  constexpr double reach = 5e-3, overlap = 1e-5;
  typename Grains::Law law;
  for (int i = 1; i <= species; ++i) {
    for (int j = i; j <= species; ++j)
      law.between(i, j) = {.normal_stiffness = 1e5 * (10 * i + j),
                           .tangential_stiffness = 1e4 * (10 * i + j),
                           .friction = 0.01 * (10 * i + j)};
  }
  for (int i = 1; i <= species; ++i) {
    for (int j = 1; j <= species; ++j) {
      CAPTURE(i);
      CAPTURE(j);
      double const number = 10 * std::min(i, j) + std::max(i, j);
      auto const size = [&](int of) {
        if constexpr (Shape::size_count == 1)
          return scarp::SizeOf<typename Grains::Shape>{reach, double(of)};
        else
          return scarp::SizeOf<typename Grains::Shape>{reach, 0.75 * reach, double(of)};
      };
      auto grains = samples::place<Grains>(Tensor<2>::Identity(), {size(i), size(j)},
                                           {{0.5, 0.5}, {0.5 + 2.0 * reach - overlap, 0.5}});
      scarp::TimeStepper<Grains> stepper;
      REQUIRE(stepper.refresh(grains, law).acceptable());
      // Both move past each other; those of the smallest friction slide.
      double const slip = -2.0 * overlap;
      grains.velocity(1, 1) = slip;
      grains.last_move = {Tensor<2>::Zero(), 1.0};
      scarp::PairScratch<double> scratch;
      scarp::pair_forces<scarp::Observe::nothing>(grains, law, scratch);
      auto const forces = scarp::NetForces<Grains>{scratch.forces.data()};
      double const normal = 1e5 * number * overlap;
      double const shear = std::min(1e4 * number * -slip, 0.01 * number * normal);
      CHECK(forces.force(1, 0) == samples::Approx(normal).epsilon(1e-10));
      CHECK(forces.force(1, 1) == samples::Approx(shear).epsilon(1e-10));
      int contacts = 0;
      scarp::for_each_contact(grains, law, [&](scarp::Contact<2> const& contact) {
        ++contacts;
        CHECK(contact.stiffness.normal == 1e5 * number);
        CHECK(contact.stiffness.tangential == 1e4 * number);
        CHECK(contact.normal_force == samples::Approx(normal).epsilon(1e-10));
      });
      CHECK(contacts == 1);
      // The time step is that of the stiffest pair of species, 3-3, whatever species are there.
      auto stiffest = grains;
      LawPerSpecies<LinearFrictional, species> all;
      all.laws.fill(law.between(3, 3));
      CHECK(scarp::critical_step(grains, law) == scarp::critical_step(stiffest, all));
    }
  }
}

TEST_CASE("a law per species is as stiff, reaches as far and is damped as much as the most of its laws") {
  LawPerSpecies<Bonded, 2> bonds;
  bonds.laws.fill({sand_and_rubber().laws[0], 3.0, 2.0});
  bonds.between(2, 1).tensile_strength = 60.0;
  CHECK(bonds.interaction_range() == samples::Approx(60.0 / 6e6).epsilon(1e-15));
  using Damped = scarp::HertzMindlin<scarp::HertzRestitution>;
  LawPerSpecies<Damped, 2> damped;
  damped.laws = {Damped::of({.modulus = 1e9, .poisson = 0.3}, 0.5, {.restitution = 0.9}),
                 Damped::of({.modulus = 1e8, .poisson = 0.3}, 0.5, {.restitution = 0.2}),
                 Damped::of({.modulus = 1e7, .poisson = 0.3}, 0.5, {.restitution = 0.5})};
  CHECK(damped.damping_ratio() == damped.between(1, 2).damping_ratio());
  CHECK(damped.stiffness(1e-5, 1e-3).normal == damped.between(1, 1).stiffness(1e-5, 1e-3).normal);
}

TEST_CASE_TEMPLATE("species with one law are grains without species, to the last bit", Shape, Disc, Ellipse) {
  using Plain = scarp::Packing<Shape, LinearFrictional>;
  using Grains = Mix<Shape, LinearFrictional>;
  auto plain = samples::consolidated<Plain>(100).packing;
  plain.rest();
  auto mixed = with_species<Grains>(plain, [](std::size_t i) { return i % 2 == 0 ? 1.0 : 2.0; });
  plain =
      with_species<Plain>(plain, [&](std::size_t i) { return plain.population->size(i).back(); });  // without contacts
  typename Grains::Law law;
  law.laws.fill(samples::study_law());
  auto const one = sheared(plain, samples::study_law(), 1e-5, 300);
  auto const other = sheared(mixed, law, 1e-5, 300);
  CHECK(plain.position == mixed.position);
  CHECK(plain.velocity == mixed.velocity);
  CHECK(plain.pairs.shear == mixed.pairs.shear);
  CHECK(one.contact_loss == other.contact_loss);
  CHECK(one.stored == other.stored);
  CHECK(scarp::contact_tangent(plain, samples::study_law()) == scarp::contact_tangent(mixed, law));
}

TEST_CASE("a mixture of sand and rubber is stiffer than rubber, softer than sand, and closes its energy balance") {
  using Grains = Mix<Disc, LinearFrictional>;
  auto const law = sand_and_rubber();
  scarp::IsotropicPreparation const preparation{.pressure = 5e4};
  auto const prepared = [&](auto const& species_of) {
    auto const cloud = with_species<Grains>(samples::loose_cloud<samples::Discs>(200, 3), species_of);
    auto made = preparation.prepare(cloud, law);
    REQUIRE(made.verdict.acceptable());
    return made.packing;
  };
  auto const sand = prepared([](std::size_t) { return 1.0; });
  auto const rubber = prepared([](std::size_t) { return 2.0; });
  auto mixture = prepared([](std::size_t i) { return i % 2 == 0 ? 1.0 : 2.0; });
  auto const stiffness = [&](Grains const& grains) { return scarp::contact_tangent(grains, law)(0, 0); };
  CHECK(stiffness(rubber) < 0.5 * stiffness(mixture));
  CHECK(stiffness(mixture) < 0.5 * stiffness(sand));
  auto const ledger = sheared(mixture, law, 1e-5, 500);
  double const turned_over = std::abs(ledger.stored) + ledger.contact_loss + ledger.damping_loss;
  CHECK(std::abs(ledger.gap()) < 1e-3 * turned_over);  // the bound of the study for the energy that steps make or lose
  auto const picture = scarp::packing_picture(mixture, law);
  CHECK(picture.grains[1].a == picture.grains[1].b);
}

TEST_CASE("stiffnesses that pairs of species exchange make the list and its time step anew") {
  auto const grains_of = [](double own, double other) {
    LawPerSpecies<LinearFrictional, 2> law = sand_and_rubber();
    law.laws[0].normal_stiffness = law.laws[0].tangential_stiffness = own;
    law.laws[2].normal_stiffness = law.laws[2].tangential_stiffness = other;
    return law;
  };
  using Grains = Mix<Disc, LinearFrictional>;
  auto grains = with_species<Grains>(samples::consolidated<samples::Discs>(80).packing,
                                     [](std::size_t i) { return 1.0 + static_cast<double>(i % 2); });
  scarp::TimeStepper<Grains> stepper;
  auto const even = grains_of(2e6, 2e6);
  auto const uneven = grains_of(1e5, 3.9e6);
  REQUIRE(stepper.refresh(grains, even).acceptable());
  double const before = grains.pairs.critical_step;
  REQUIRE(stepper.refresh(grains, uneven).acceptable());
  CHECK(grains.pairs.critical_step < 0.8 * before);
  CHECK(grains.pairs.critical_step == scarp::critical_step(grains, uneven));
}

TEST_CASE("the preparation exchanges the friction of all pairs of species, and each is checked") {
  auto law = sand_and_rubber();
  std::vector<double> found;
  scarp::for_each_friction(law, [&](double& friction) { found.push_back(friction); });
  CHECK(found == std::vector{0.5, 0.7, 0.9});
  law.between(1, 2).friction = std::numeric_limits<double>::quiet_NaN();
  auto grains = samples::place<Mix<Disc, LinearFrictional>>(Tensor<2>::Identity(), {{0.1, 1.0}}, {{0.5, 0.5}});
  CHECK(scarp::TimeStepper<Mix<Disc, LinearFrictional>>{}.refresh(grains, law) ==
        scarp::Verdict{scarp::Status::failed, scarp::Reason::not_finite});
  law.between(1, 2) = {.normal_stiffness = -1.0};
  CHECK_REFUSED(law.validate(), "normal stiffness of the contact law is -1");
}

TEST_CASE("species that are not there are refused") {
  using Grains = scarp::Population<WithSpecies<Disc, 2>>;
  for (double const species : {3.0, 1.5, 0.5})
    CHECK_REFUSED(Grains({{1.0, species}}, 1.0, 1.0), fmt::format("a grain is of species {}", species));
}

TEST_CASE("a law per species has no other pairs, and a pair that becomes wrong is found") {
  scarp::LawPerSpecies<scarp::LinearFrictional, 2> law;
  for (int const wrong : {-1, 0, 3}) CHECK_REFUSED(law.between(1, wrong), "no law between species", "1 to 2");
  for (auto& one : law.laws) one = samples::study_law();
  using Packing = scarp::Packing<scarp::WithSpecies<scarp::Disc, 2>, scarp::LawPerSpecies<scarp::LinearFrictional, 2>>;
  auto packing = samples::place<Packing>(scarp::Tensor<2>{{0.1, 0.0}, {0.0, 0.1}}, {{5e-3, 1.0}, {5e-3, 2.0}},
                                         {{0.02, 0.02}, {0.0299, 0.02}});
  scarp::TimeStepper<Packing> stepper;
  REQUIRE(stepper.refresh(packing, law).acceptable());
  law.between(1, 2).normal_stiffness *= -0.5;  // softer than the others, which alone bound the time step
  CHECK_REFUSED(stepper.refresh(packing, law), "normal stiffness");
}
