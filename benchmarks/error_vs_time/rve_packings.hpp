// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <map>
#include <utility>

#include "../../examples/shared/study/study_sand.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/dem/contacts.hpp"
#include "scarp/dem/preparation.hpp"

namespace error_vs_time {

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using FloatGrains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional, float>;
using HertzGrains = scarp::Packing<scarp::Ellipse, scarp::HertzMindlin<>>;

constexpr double confinement = 2e5;  ///< [Pa]

/// The reference study's grains at 200 kPa at rest; made once for every number of grains and seed.
/// \throws PreparationError
inline Grains const& consolidated(int grains, int seed) {
  static std::map<std::pair<int, int>, Grains> made;
  auto const key = std::pair(grains, seed);
  if (auto const found = made.find(key); found != made.end()) return found->second;
  scarp::IsotropicPreparation const preparation{.pressure = confinement, .preparation_friction = 0.12};
  auto prepared = preparation.prepare(examples::study_cloud(grains, static_cast<std::uint64_t>(seed)).make<Grains>(),
                                      examples::study_law());
  if (!prepared.verdict.acceptable()) {
    throw scarp::PreparationError(fmt::format("packing {} of {} grains was not consolidated ({})", seed, grains,
                                              scarp::name(prepared.verdict.reason)));
  }
  return made.emplace(key, std::move(prepared.packing)).first->second;
}

template <class To, class From>
void convert(From const& from, To& to, int columns) {
  to.resize(from.rows());
  for (int k = 0; k < columns; ++k) {
    for (std::size_t i = 0; i < from.rows(); ++i) {
      to(i, k) = static_cast<std::remove_cvref_t<decltype(to(i, k))>>(from(i, k));
    }
  }
}

/// The same grains at the same places, at rest, without contacts.
template <class To>
To same_grains(Grains const& from) {
  std::vector<scarp::Ellipse::Size<double>> sizes;
  for (std::size_t i = 0; i < from.grain_count(); ++i) sizes.push_back(from.population->size(i));
  To to;
  to.population = std::make_shared<scarp::Population<scarp::Ellipse, typename To::Scalar> const>(
      sizes, from.population->density(), from.population->thickness());
  to.cell = from.cell;
  convert(from.position, to.position, 2);
  convert(from.orientation, to.orientation, 2);
  to.rest();
  return to;
}

/// The same packing in single precision, with the forces that its contacts remember.
inline FloatGrains in_single_precision(Grains const& from) {
  auto to = same_grains<FloatGrains>(from);
  to.pairs.first = from.pairs.first;
  to.pairs.second = from.pairs.second;
  convert(from.pairs.normal, to.pairs.normal, 2);
  convert(from.pairs.shear, to.pairs.shear, 1);
  to.pairs.ghost_owner = from.pairs.ghost_owner;
  to.pairs.ghost_shift = from.pairs.ghost_shift;
  to.pairs.drift = 2.0 * from.pairs.skin;  // the list is made anew, in its own order of lanes
  to.pairs.skin = from.pairs.skin;
  return to;
}

/// Hertz and Mindlin's law with the linear law's stiffnesses at the overlap that the mean contact force makes.
inline scarp::HertzMindlin<> matched_law(Grains const& packing) {
  auto const linear = examples::study_law();
  double force = 0.0;
  double contacts = 0.0;
  scarp::for_each_contact(packing, linear, [&](scarp::Contact<2> const& contact) {
    force += contact.force.norm();
    ++contacts;
  });
  double const overlap = force / contacts / linear.normal_stiffness;
  double const reduced_radius =
      0.5 * (packing.population->largest_radius() + packing.population->smallest_radius()) / 2;
  double const contact_radius = std::sqrt(reduced_radius * overlap);
  return {.reduced_modulus = linear.normal_stiffness / (2.0 * contact_radius),
          .reduced_shear_modulus = linear.tangential_stiffness / (8.0 * contact_radius),
          .friction = linear.friction};
}

/// The same grains brought to rest at the same pressure under another law.
inline HertzGrains relaxed(Grains const& from, scarp::HertzMindlin<> const& law) {
  auto packing = same_grains<HertzGrains>(from);
  scarp::VoigtStress<2> const target(-confinement, -confinement, 0.0);
  scarp::TimeStepper<HertzGrains> stepper;
  auto const verdict = scarp::Servo{}.reach(stepper, packing, law, scarp::Loading<2>::stress(target));
  if (!verdict.acceptable()) {
    throw scarp::PreparationError(
        fmt::format("a packing did not come to rest under Hertz's law ({})", scarp::name(verdict.reason)));
  }
  static_cast<void>(stepper.stop(packing, law));
  return packing;
}

}  // namespace error_vs_time
