// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <vector>

#include "../shared/sand/built.hpp"
#include "options.hpp"
#include "scarp/rve/random_packings.hpp"

namespace rve_lab {

using Discs = examples::Linear<scarp::Disc>;
using HertzianDiscs = scarp::Packing<scarp::Disc, scarp::HertzMindlin<>>;
using RollingDiscs = scarp::Packing<scarp::Disc, examples::Rolling>;
using Ellipses = examples::Linear<scarp::Ellipse>;
using Superellipses = examples::Linear<scarp::Superellipse>;

/// Each pair of shape and law costs compile time, so curved and rolling contacts come with discs only.
using Grains = examples::Built<Discs, HertzianDiscs, RollingDiscs, Ellipses, Superellipses>;

/// Spheres in space, compiled by themselves (spheres.hpp).
using Spheres = examples::Built<examples::Linear<scarp::Sphere>, scarp::Packing<scarp::Sphere, examples::Rolling>,
                                scarp::Packing<scarp::Sphere, examples::RollingHertz>>;

inline bool is_in_space(Sand const& sand) { return sand.shape == "sphere"; }

/// Seed number k of several packings of a sand; the first is the sand's own.
inline std::uint64_t seed_of(Sand const& sand, int k) {
  return k == 0 ? sand.seed : scarp::family_seed(sand.seed, static_cast<std::uint64_t>(k));
}

/// Prepares packings of a sand.
template <class PackingType>
struct Preparation {
  using Law = typename PackingType::Law;

  /// What is done is printed. \throws InputError, PreparationError
  static PackingType printed(Sand const& sand, Law const& law);
  /// Packings of several seeds, at the same time where threads are requested; it is printed how many there are.
  static std::vector<PackingType> of_seeds(Sand const& sand, Law const& law, std::vector<std::uint64_t> const& seeds,
                                           int threads);
  /// The densest or loosest packing where the sand's void ratio lies beyond it.
  /// isotropic_void_ratio: becomes that at the isotropic pressure
  /// \throws InputError, PreparationError
  static PackingType nearest(Sand const& sand, Law const& law, double& isotropic_void_ratio);
};

/// \throws InputError for grains that are not built
inline void require_built(Sand const& sand) {
  auto const nothing = [](auto, auto const&) {};
  is_in_space(sand) ? with_packing(Spheres{}, sand, nothing) : with_packing(Grains{}, sand, nothing);
}

/// The values of the file, but options that are given.
/// \throws InputError
template <class Choice>
void read_sand_file(Choice& choice, CLI::App const& app) {
  if (!choice.sand_file.empty())
    choice.sand = examples::read_sand(choice.sand_file, choice.sand, examples::given_in(app));
  examples::require_used(app, choice.sand);
}

}  // namespace rve_lab
