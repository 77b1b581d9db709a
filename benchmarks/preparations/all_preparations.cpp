// SPDX-License-Identifier: BSL-1.0
#include "preparation.hpp"

namespace preparations {

namespace {

/// Those that are to hit the reference study's void ratio and K0 together, their numbers interpolated between the
/// others'.
std::vector<Preparation> candidates() {
  return {
      {.path = "candidate: rising friction",
       .isotropic_pressure = 0.5e3,
       .isotropic_friction = 0.092,
       .vertical_friction = 0.42,
       .tested = true},
      {.path = "candidate: rising friction",
       .isotropic_pressure = 0.5e3,
       .isotropic_friction = 0.095,
       .vertical_friction = 0.41,
       .tested = true},
      {.path = "candidate: preloaded",
       .isotropic_pressure = 0.5e3,
       .isotropic_friction = 0.092,
       .overconsolidation_ratio = 1.24,
       .tested = true},
      {.path = "candidate: preloaded", .isotropic_pressure = 0.5e3, .overconsolidation_ratio = 1.25, .tested = true},
      {.path = "candidate: isotropic share", .isotropic_friction = 0.092, .share = 0.28, .tested = true},
      {.path = "candidate: held ratio", .isotropic_friction = 0.092, .held_ratio = 0.4, .tested = true}};
}

}  // namespace

std::vector<Preparation> all_preparations() {
  std::vector<Preparation> all;
  auto const near_the_scene = {0.07, 0.09, 0.11};
  for (double const friction : {0.03, 0.05, 0.07, 0.09, 0.11, 0.15, 0.2, 0.3, 0.4, 0.55})
    all.push_back({.path = "one-dimensional", .isotropic_friction = friction, .tested = friction == 0.09});
  all.push_back({.path = "one-dimensional, ten times slower", .fastest = 1e-6});
  for (double const friction : {0.05, 0.09, 0.15, 0.2, 0.3, 0.4}) {
    all.push_back({.path = "low friction to the end", .isotropic_friction = friction, .vertical_friction = friction});
  }
  all.push_back({.path = "falling friction", .isotropic_friction = 0.25, .vertical_friction = 0.15});
  for (double const second : {0.2, 0.3, 0.4}) all.push_back({.path = "rising friction", .vertical_friction = second});
  for (double const ratio : {1.2, 1.4, 2.0}) all.push_back({.path = "preloaded", .overconsolidation_ratio = ratio});
  for (double const friction : near_the_scene) {
    for (double const second : {0.3, 0.35, 0.4}) {
      all.push_back({.path = "rising friction from 0.5 kPa",
                     .isotropic_pressure = 0.5e3,
                     .isotropic_friction = friction,
                     .vertical_friction = second,
                     .tested = friction == 0.09 && second == 0.35});
    }
    for (double const ratio : {1.2, 1.3, 1.4}) {
      all.push_back({.path = "preloaded from 0.5 kPa",
                     .isotropic_pressure = 0.5e3,
                     .isotropic_friction = friction,
                     .overconsolidation_ratio = ratio,
                     .tested = friction == 0.09 && ratio == 1.3});
    }
  }
  for (double const share : {0.1, 0.2, 0.25, 0.3, 0.7}) {
    for (double const friction : near_the_scene) {
      all.push_back({.path = "isotropic share",
                     .isotropic_friction = friction,
                     .share = share,
                     .tested = friction == 0.09 && share == 0.3});
    }
  }
  for (double const share : {0.3, 0.7})
    all.push_back({.path = "isotropic share at low friction", .share = share, .share_friction = 0.09});
  for (double const pressure : {0.5e3, 20e3, 50e3, 100e3, 200e3}) {
    for (double const friction : near_the_scene)
      all.push_back({.path = "one isotropic packing", .isotropic_pressure = pressure, .isotropic_friction = friction});
  }
  for (double const friction : near_the_scene) {
    all.push_back(
        {.path = "held ratio", .isotropic_friction = friction, .held_ratio = 0.4, .tested = friction == 0.09});
  }
  all.push_back({.path = "held ratio from the mean stress", .share = 0.7, .held_ratio = 0.4});
  for (double const laid : {-1.0, -0.5, 0.5, 1.0}) all.push_back({.path = "laid grains", .laid = laid});
  for (auto const& candidate : candidates()) all.push_back(candidate);
  return all;
}

}  // namespace preparations
