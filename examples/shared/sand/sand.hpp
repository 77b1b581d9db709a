// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/core/error.hpp"

namespace examples {

/// Range of an option's value.
struct Range {
  double least = 0.0;
  bool inclusive = true;
  double most = 1e15;
};
inline constexpr Range positive{.inclusive = false};

/// Grains, contacts and preparation of a sand. Of preparation friction, void ratio and relative density the last one
/// that is not zero counts.
struct Sand {
  std::string shape = "disc";
  std::string law = "linear";
  double normal_stiffness = 6e6;
  double tangential_stiffness = 6e6;
  double friction = 0.55;
  double modulus = 1e9;
  double poisson = 0.25;
  double rolling_stiffness = 40.0;
  double rolling_friction = 0.1;
  double smallest = 4e-3;
  double largest = 6e-3;
  std::string sieve{};
  double aspect = 0.75;
  double exponent = 0.6;
  double density = 2650.0;
  double thickness = 0.2;
  int grains = 400;
  std::uint64_t seed = 1;
  double pressure = 2e5;
  double preparation_friction = 0.1;
  double void_ratio = 0.0;
  double relative_density = 0.0;
  double void_ratio_tolerance = 5e-4;
  double vertical_pressure = 0.0;
  double overconsolidation_ratio = 1.0;
  double k0 = 0.0;
  double conductivity = 0.0;
  double conductivity_void_ratio = 0.7;
  std::string calibrated_on{};
  std::string misfit{};

  /// Calls visit(name, member) for all options, by names with underscores.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit);
};

/// Calls visit(name, member, range, what it is) for each option of a sand, as files and command lines name it.
template <class AnySand, class Visit>
void for_each_option(AnySand& sand, Visit&& visit) {
  visit("shape", sand.shape, Range{}, "of the grains: disc, ellipse, superellipse, or sphere");
  visit("law", sand.law, Range{},
        "of the contacts: linear, hertz (Hertz and Mindlin); rolling, rolling-hertz (these with rolling resistance)");
  visit("normal-stiffness", sand.normal_stiffness, positive, "of linear and rolling contacts [N/m]");
  visit("tangential-stiffness", sand.tangential_stiffness, Range{}, "of linear and rolling contacts [N/m]");
  visit("friction", sand.friction, Range{}, "coefficient between grains");
  visit("modulus", sand.modulus, positive, "Young's, of hertz contacts [Pa]");
  visit("poisson", sand.poisson, Range{.most = 0.5}, "Poisson's ratio, of hertz contacts");
  visit("rolling-stiffness", sand.rolling_stiffness, Range{},
        "of rolling contacts [N m/rad]; about tangential stiffness x reduced radius squared");
  visit("rolling-friction", sand.rolling_friction, Range{}, "of rolling contacts");
  visit("smallest", sand.smallest, Range{.inclusive = false, .most = 1e3},
        "radius or major half axis [m], uniform from here");
  visit("largest", sand.largest, Range{.inclusive = false, .most = 1e3}, "to here [m]");
  visit("sieve", sand.sieve, Range{},
        "instead of these: diameters of sieves [m] and the mass that passes [%], as 0.002 0, 0.004 60, 0.006 100; "
        "grains pass with their minor axis");
  visit("aspect", sand.aspect, Range{.inclusive = false, .most = 1.0},
        "minor over major half axis of ellipses and superellipses");
  visit("exponent", sand.exponent, Range{.inclusive = false, .most = 2.0},
        "of superellipses: 1 is an ellipse, towards 0 a rectangle");
  visit("density", sand.density, Range{.inclusive = false, .most = 1e9}, "of the grains [kg/m3]");
  visit("thickness", sand.thickness, Range{.inclusive = false, .most = 1e3}, "out of plane [m]");
  visit("grains", sand.grains, Range{1.0, true, 1e5}, "number");
  visit("seed", sand.seed, Range{.most = 2e19}, "of the random cloud");
  visit("pressure", sand.pressure, Range{.inclusive = false, .most = 1e12}, "of the consolidation, isotropic [Pa]");
  visit("preparation-friction", sand.preparation_friction, Range{.most = 10.0},
        "during consolidation, sets the density");
  visit("void-ratio", sand.void_ratio, Range{.most = 10.0},
        "at the isotropic pressure, found by bisection on the preparation friction; 0: as that gives");
  visit("relative-density", sand.relative_density, Range{.most = 1.0},
        "likewise: 0 at the void ratio that a preparation friction as large as the contacts' gives, 1 at that of none; "
        "0: not used");
  visit("void-ratio-tolerance", sand.void_ratio_tolerance, Range{.inclusive = false, .most = 1.0}, "of the bisection");
  visit("vertical-pressure", sand.vertical_pressure, Range{.most = 1e12},
        "to which it is then compressed without lateral strain [Pa]; 0: not");
  visit("overconsolidation-ratio", sand.overconsolidation_ratio, Range{1.0, true, 10.0},
        "of the vertical pressure: largest over present");
  visit("k0", sand.k0, Range{.most = 10.0},
        "horizontal over vertical stress to which it is brought at last; 0: as it is");
  visit("conductivity", sand.conductivity, Range{.most = 10.0}, "hydraulic, of saturated ground [m/s]");
  visit("conductivity-void-ratio", sand.conductivity_void_ratio, Range{.least = 0.01, .most = 10.0},
        "of the ground that has this conductivity");
  visit("calibrated-on", sand.calibrated_on, Range{}, "data that the values come from");
  visit("misfit", sand.misfit, Range{}, "of these data");
}

template <class Self, class Visit>
void Sand::members(Self& self, Visit&& visit) {
  for_each_option(self, [&](std::string name, auto& member, Range, char const*) {
    std::ranges::replace(name, '-', '_');
    visit(std::string_view(name), member);
  });
}

/// Options that say how dense a sand is: one of them replaces the others.
inline bool sets_density(std::string_view name) {
  return name == "preparation-friction" || name == "void-ratio" || name == "relative-density";
}

/// What stands in a file of a sand and is no option of a program that prepares packings.
inline bool is_of_file(std::string_view name) {
  return name.starts_with("conductivity") || name == "calibrated-on" || name == "misfit";
}

/// Why a sand has no use for an option; empty where it has.
inline std::string why_unused(Sand const& sand, std::string_view name) {
  auto const law_is = fmt::format("the law is '{}'", sand.law);
  auto const shape_is = fmt::format("grains are of the shape '{}'", sand.shape);
  bool const hertz = sand.law.ends_with("hertz");
  if ((name == "modulus" || name == "poisson") && !hertz) return law_is;
  if ((name == "normal-stiffness" || name == "tangential-stiffness") && hertz) return law_is;
  if (name.starts_with("rolling-") && !sand.law.starts_with("rolling")) return law_is;
  bool const round = sand.shape == "disc" || sand.shape == "sphere";
  if ((name == "aspect" && round) || (name == "exponent" && sand.shape != "superellipse")) return shape_is;
  if (name == "thickness" && sand.shape == "sphere") return shape_is;
  if ((name == "smallest" || name == "largest") && !sand.sieve.empty()) return "a sieve curve is given";
  if (name == "void-ratio-tolerance" && sand.void_ratio == 0.0 && sand.relative_density == 0.0)
    return "without a void ratio";
  if (name == "overconsolidation-ratio" && sand.vertical_pressure == 0.0 && sand.k0 > 0.0) return "k0 is given";
  if (name.starts_with("conductivity") && sand.conductivity == 0.0) return "without a conductivity";
  return {};
}

/// \throws InputError naming an option whose value is out of its range, and for several that set the density
inline void validate(Sand const& sand) {
  for_each_option(sand, [](char const* name, auto const& member, Range range, char const*) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(member)>>) {
      auto const value = static_cast<double>(member);
      if (!(value <= range.most && (range.inclusive ? value >= range.least : value > range.least)))
        scarp::reject("{} is {} (a number {} {} and at most {} is expected): correct it", name, value,
                      range.inclusive ? "from" : "above", range.least, range.most);
    }
  });
  if (sand.largest < sand.smallest)
    scarp::reject("the largest size {} is below the smallest {} (no size lies between them): exchange them",
                  sand.largest, sand.smallest);
  if (sand.void_ratio > 0.0 && sand.relative_density > 0.0)
    scarp::reject("void-ratio is {} and relative-density {} (both set the density): leave one out", sand.void_ratio,
                  sand.relative_density);
}

}  // namespace examples
