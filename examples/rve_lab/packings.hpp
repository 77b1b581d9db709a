// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/print.hpp"
#include "../shared/sand/built.hpp"
#include "../shared/sand/preparation.hpp"
#include "options.hpp"

namespace rve_lab {

/// Each pair of shape and law costs compile time, so curved and rolling contacts come with discs only.
using Grains = examples::Built<examples::Linear<scarp::Disc>, scarp::Packing<scarp::Disc, scarp::HertzMindlin<>>,
                               scarp::Packing<scarp::Disc, examples::Rolling>, examples::Linear<scarp::Ellipse>,
                               examples::Linear<scarp::Superellipse>>;

/// \throws InputError, PreparationError
template <class PackingType>
PackingType prepared(Sand const& sand, typename PackingType::Law const& law) {
  auto const tell = [](std::string const& text) { examples::print(stdout, "{}\n", text); };
  return examples::prepared<PackingType>(sand, law, sand.seed, tell, sand.void_ratio_tolerance);
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
