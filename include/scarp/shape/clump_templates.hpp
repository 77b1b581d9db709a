// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numbers>

#include "scarp/shape/clump.hpp"

namespace scarp {

/// Two discs whose centres lie 1.5 radii apart; the scale of all templates here is the radius of a disc.
struct DumbbellTemplate {
  static constexpr std::array<ClumpMember, 2> members{{{-0.75, 0.0, 1.0}, {0.75, 0.0, 1.0}}};
};

/// Three discs on the corners of a triangle of side 1.5.
struct TrefoilTemplate {
  static constexpr double height = 0.75 * std::numbers::sqrt3;
  static constexpr std::array<ClumpMember, 3> members{
      {{-0.75, -height / 3.0, 1.0}, {0.75, -height / 3.0, 1.0}, {0.0, 2.0 * height / 3.0, 1.0}}};
};

/// Four discs on the corners of a square of side 1.4: small enough to leave no hole.
struct QuatrefoilTemplate {
  static constexpr std::array<ClumpMember, 4> members{
      {{-0.7, -0.7, 1.0}, {0.7, -0.7, 1.0}, {0.7, 0.7, 1.0}, {-0.7, 0.7, 1.0}}};
};

using Dumbbell = Clump<DumbbellTemplate>;
using Trefoil = Clump<TrefoilTemplate>;
using Quatrefoil = Clump<QuatrefoilTemplate>;

static_assert(ParticleShape<Dumbbell>);
static_assert(ParticleShape<Trefoil>);
static_assert(ParticleShape<Quatrefoil>);

}  // namespace scarp
