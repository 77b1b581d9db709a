// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <type_traits>

#include "sand.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/shape/superellipse.hpp"

namespace examples {

using Rolling = scarp::RollingResistance<scarp::LinearFrictional>;
using RollingHertz = scarp::RollingResistance<scarp::HertzMindlin<>>;

template <class T>
inline constexpr char const* name_in_sand = nullptr;
template <>
inline constexpr char const* name_in_sand<scarp::Disc> = "disc";
template <>
inline constexpr char const* name_in_sand<scarp::Ellipse> = "ellipse";
template <>
inline constexpr char const* name_in_sand<scarp::Superellipse> = "superellipse";
template <>
inline constexpr char const* name_in_sand<scarp::Sphere> = "sphere";
template <>
inline constexpr char const* name_in_sand<scarp::LinearFrictional> = "linear";
template <>
inline constexpr char const* name_in_sand<scarp::HertzMindlin<>> = "hertz";
template <>
inline constexpr char const* name_in_sand<Rolling> = "rolling";
template <>
inline constexpr char const* name_in_sand<RollingHertz> = "rolling-hertz";

template <class Law>
Law law_of(Sand const& sand) {
  if constexpr (std::is_same_v<Law, scarp::HertzMindlin<>>) {
    return Law::of({.modulus = sand.modulus, .poisson = sand.poisson}, sand.friction);
  } else if constexpr (std::is_same_v<Law, Rolling> || std::is_same_v<Law, RollingHertz>) {
    return {.law = law_of<decltype(Law::law)>(sand),
            .rolling_stiffness = sand.rolling_stiffness,
            .rolling_friction = sand.rolling_friction};
  } else {
    return {.normal_stiffness = sand.normal_stiffness,
            .tangential_stiffness = sand.tangential_stiffness,
            .friction = sand.friction};
  }
}

/// The packings that a program compiles, of which a sand takes one.
template <class... Packings>
struct Built {};
template <class Shape>
using Linear = scarp::Packing<Shape, scarp::LinearFrictional>;

/// Calls task(std::type_identity<Packing>, law) with the packing of the sand's shape and law.
/// \throws InputError for a pair that is not built, naming those that are
template <class... Packings, class Task>
void with_packing(Built<Packings...>, Sand const& sand, Task const& task) {
  auto const fits = [&]<class Packing>(std::type_identity<Packing>) {
    return sand.shape == name_in_sand<typename Packing::Shape> && sand.law == name_in_sand<typename Packing::Law>;
  };
  auto const run = [&]<class Packing>(std::type_identity<Packing> packing) {
    if (fits(packing)) task(packing, law_of<typename Packing::Law>(sand));
  };
  if (sand.shape == "sphere" && ((Packings::dim == 2) && ...))
    scarp::reject(
        "the sand's grains are spheres (this program is plane): use ellipses; spheres go to rve_lab test and "
        "calibrate");
  if (!(fits(std::type_identity<Packings>{}) || ...)) {
    std::string built;
    ((built += fmt::format("{}{} {}", built.empty() ? "" : ", ", name_in_sand<typename Packings::Shape>,
                           name_in_sand<typename Packings::Law>)),
     ...);
    scarp::reject("'{}' grains with law '{}' are not built (to compile faster, only {}): choose one of these",
                  sand.shape, sand.law, built);
  }
  (run(std::type_identity<Packings>{}), ...);
}

}  // namespace examples
