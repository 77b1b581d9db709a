// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/sand/built.hpp"
#include "options.hpp"

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

/// Prepares packings of a sand.
template <class PackingType>
struct Preparation {
  using Law = typename PackingType::Law;

  /// What is done is printed. \throws InputError, PreparationError
  static PackingType printed(Sand const& sand, Law const& law);
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
