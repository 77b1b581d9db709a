// SPDX-License-Identifier: BSL-1.0
// One DEM step of the same hundred round grains as discs or ellipses, with friction or without, watched or not: the
// same places, near pairs and contacts for all, so that what differs between two of them is the price of a feature.
// benchmarks/absence/run counts the instructions of measured_steps and measured_list.
//   price_of_a_step disc|ellipse smooth|frictional nothing|balance|energy
//   price_of_a_step disc|ellipse species|fire|rim nothing   frictional contacts of two species, or moved by another
//   policy
#include <fmt/format.h>

#include <string_view>

#include "../shared/state_bytes.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/law_per_species.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/fire.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/dem/uniform_strain_rim.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/with_species.hpp"

namespace {

constexpr int steps = 400;  // too few for a new list of near pairs

scarp::LinearFrictional const rough{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};

template <class Law>
Law law_of() {
  if constexpr (std::is_same_v<Law, scarp::LinearFrictional>) {
    return rough;
  } else if constexpr (Law::inputs.species > 0) {
    return {{rough, rough, rough}};
  } else {
    return {.normal_stiffness = rough.normal_stiffness};
  }
}

/// A hundred grains under 100 kPa in a balance that needs no friction, so that it is one for every law.
/// \throws InputError where they find none
auto balanced_discs() {
  scarp::Cloud<scarp::DiscGrading> const cloud{
      .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = 100, .density = 2650.0, .thickness = 0.2};
  auto law = rough;
  law.friction = 0.0;
  scarp::IsotropicPreparation const preparation{.pressure = 1e5, .preparation_friction = 0.0};
  auto made = preparation.prepare(cloud.make<scarp::Packing<scarp::Disc, scarp::LinearFrictional>>(), law);
  if (!made.verdict.acceptable()) scarp::reject("the grains found no balance: change the seed");
  return made.packing;
}

/// The same places of grains of another shape and law; ellipses are round, species are taken in turn.
template <class Grains, class Discs>
Grains as(Discs const& discs) {
  Grains grains;
  std::vector<typename Grains::Shape::template Size<double>> sizes;
  for (std::size_t i = 0; i < discs.grain_count(); ++i) {
    sizes.emplace_back().fill(discs.population->size(i)[0]);
    if constexpr (Grains::Law::inputs.species > 0) sizes.back().back() = i % 2 == 0 ? 1.0 : 2.0;
  }
  using PopulationType = scarp::Population<typename Grains::Shape, double>;
  grains.population = std::make_shared<PopulationType const>(sizes, 2650.0, 0.2);
  grains.cell = discs.cell;
  grains.position = discs.position;
  grains.orientation.resize(sizes.size());
  if constexpr (Grains::Shape::orientation_count == 2) {
    for (std::size_t i = 0; i < sizes.size(); ++i) grains.orientation(i, 0) = 1.0;
  }
  grains.rest();
  return grains;
}

template <scarp::Observe what, class Stepper, class Grains>
[[gnu::noinline]] bool measured_steps(Stepper& stepper, Grains& grains, typename Grains::Law const& law,
                                      scarp::StepObservation<2>& seen) {
  scarp::Tensor<2> shear = scarp::Tensor<2>::Zero();
  shear(0, 1) = 1e-7;
  for (int step = 0; step < steps; ++step) {
    if (!stepper.template step<what>(grains, law, shear, &seen).acceptable()) return false;
  }
  return true;
}

template <class Stepper, class Grains>
[[gnu::noinline]] bool measured_list(Stepper const& stepper, Grains& grains, typename Grains::Law const& law) {
  return stepper.refresh(grains, law).acceptable();
}

template <class Shape, class Law, scarp::Observe what, class... Policies>
int measure() {
  using Grains = scarp::Packing<Shape, Law>;
  auto grains = as<Grains>(balanced_discs());
  auto const law = law_of<Law>();
  scarp::TimeStepper<Grains, Policies...> stepper;
  scarp::StepObservation<2> seen;
  // A first list, contacts and scratch memory, so that the measured list renews one, as in a run.
  if (!stepper.observe(grains, law, seen).acceptable()) return 1;
  grains.pairs.drift = 2.0 * grains.pairs.skin;
  if (!measured_list(stepper, grains, law)) return 1;
  auto const listed = grains.pairs.first;
  if (!measured_steps<what>(stepper, grains, law, seen)) return 1;
  bool const same_list = listed == grains.pairs.first && grains.pairs.drift <= grains.pairs.skin;
  if (!same_list || !stepper.observe(grains, law, seen).acceptable()) return 1;
  fmt::print("{{\"steps\": {}, \"near_pairs\": {}, \"contacts\": {}, \"grains\": {}, \"sizeof\": {}, \"bytes\": {}}}\n",
             steps, grains.pairs.count(), seen.contacts, grains.grain_count(), sizeof(Grains),
             benchmarks::state_bytes(grains));
  return 0;
}

template <class Shape, class Law>
int measure(std::string_view watched) {
  if (watched == "nothing") return measure<Shape, Law, scarp::Observe::nothing>();
  if (watched == "balance") return measure<Shape, Law, scarp::Observe::balance>();
  if (watched == "energy") return measure<Shape, Law, scarp::Observe::energy>();
  return 2;
}

template <class Shape>
int measure(std::string_view law, std::string_view watched) {
  if (law == "smooth") return measure<Shape, scarp::Frictionless>(watched);
  if (law == "frictional") return measure<Shape, scarp::LinearFrictional>(watched);
  if (watched != "nothing") return 2;
  using Rough = scarp::LinearFrictional;
  constexpr auto nothing = scarp::Observe::nothing;
  if (law == "species") return measure<scarp::WithSpecies<Shape, 2>, scarp::LawPerSpecies<Rough, 2>, nothing>();
  if (law == "fire") return measure<Shape, Rough, nothing, scarp::Fire>();
  if (law == "rim") return measure<Shape, Rough, nothing, scarp::LocalDamping, scarp::UniformStrainRim>();
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string_view(argv[1]) == "disc") return measure<scarp::Disc>(argv[2], argv[3]);
  if (argc == 4 && std::string_view(argv[1]) == "ellipse") return measure<scarp::Ellipse>(argv[2], argv[3]);
  fmt::print(stderr, "usage: price_of_a_step disc|ellipse smooth|frictional|species|fire|rim nothing|balance|energy\n");
  return 2;
}
