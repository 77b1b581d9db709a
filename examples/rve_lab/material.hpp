// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

#include "choices.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/superellipse.hpp"

namespace rve_lab {

inline scarp::DiscGrading grading(std::type_identity<scarp::Disc>, Preparation const& choice) {
  return {.smallest = choice.smallest, .largest = choice.largest};
}

inline scarp::EllipseGrading grading(std::type_identity<scarp::Ellipse>, Preparation const& choice) {
  return {.smallest = choice.smallest, .largest = choice.largest, .aspect = choice.aspect};
}

inline scarp::SuperellipseGrading grading(std::type_identity<scarp::Superellipse>, Preparation const& choice) {
  return {.smallest = choice.smallest, .largest = choice.largest, .aspect = choice.aspect, .exponent = choice.exponent};
}

inline scarp::LinearFrictional linear_law(Material const& material) {
  return {.normal_stiffness = material.normal_stiffness,
          .tangential_stiffness = material.tangential_stiffness,
          .friction = material.friction};
}

/// Calls task(std::type_identity<Packing>, law) with the one type of packing whose shape was chosen and the linear law.
/// \throws InputError for an unknown shape
template <class Task>
void with_linear_law(Material const& material, Task const& task) {
  auto const run = [&](auto shape) {
    task(std::type_identity<scarp::Packing<typename decltype(shape)::type, scarp::LinearFrictional>>{},
         linear_law(material));
  };
  if (material.shape == "disc") return run(std::type_identity<scarp::Disc>{});
  if (material.shape == "ellipse") return run(std::type_identity<scarp::Ellipse>{});
  if (material.shape == "superellipse") return run(std::type_identity<scarp::Superellipse>{});
  scarp::reject("there are no '{}' grains (disc, ellipse and superellipse are built): choose one", material.shape);
}

/// The same with the law that was chosen. Each pair of shape and law
/// costs compile time, so curved and rolling contacts come with discs only.
/// \throws InputError for a pair that is not built
template <class Task>
void with_material(Material const& material, Task const& task) {
  if (material.law == "linear") return with_linear_law(material, task);
  auto const run = [&](auto const& law) {
    task(std::type_identity<scarp::Packing<scarp::Disc, std::remove_cvref_t<decltype(law)>>>{}, law);
  };
  if (material.shape == "disc" && material.law == "hertz")
    return run(scarp::HertzMindlin<>::of(material.modulus, material.poisson, material.friction));
  if (material.shape == "disc" && material.law == "rolling") {
    return run(scarp::RollingResistance<scarp::LinearFrictional>{.law = linear_law(material),
                                                                 .rolling_stiffness = material.rolling_stiffness,
                                                                 .rolling_friction = material.rolling_friction});
  }
  scarp::reject("'{}' grains with law '{}' are not built (to compile faster): use discs, or law 'linear'",
                material.shape, material.law);
}

}  // namespace rve_lab
