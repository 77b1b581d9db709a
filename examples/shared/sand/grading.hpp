// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "sand.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/io/text_lines.hpp"
#include "sieve_curve.hpp"

namespace examples {

/// A sieve curve from the text of a sand's option: "0.002 0, 0.006 100", diameters [m] and per cent. A point that is
/// given twice counts once.
/// \throws InputError
inline SieveCurve sieve_curve(std::string const& text) {
  constexpr double largest = 1.0;  // [m]; larger ones are in mm
  SieveCurve curve;
  for (std::size_t begin = 0; begin <= text.size();) {
    auto const end = std::min(text.find(',', begin), text.size());
    auto const point = scarp::trimmed(std::string_view(text).substr(begin, end - begin));
    auto const blank = std::min(point.find_first_of(" \t"), point.size());
    double diameter = 0.0, passing = 0.0;
    if (scarp::read_number(point.substr(0, blank), diameter) != std::errc{} ||
        scarp::read_number(scarp::trimmed(point.substr(blank)), passing) != std::errc{})
      scarp::reject(
          "'{}' is no point of a sieve curve (a diameter [m] and per cent that pass are expected, points between "
          "digits and commas between points of the curve): correct it",
          scarp::shortened(scarp::spelt_out(point)));
    if (diameter > largest)
      scarp::reject("a sieve of the curve has {} m (at most {} m are expected): give diameters in metres", diameter,
                    largest);
    begin = end + 1;
    if (!curve.diameters.empty() && diameter == curve.diameters.back() && passing / 100.0 == curve.passing.back())
      continue;
    curve.diameters.push_back(diameter);
    curve.passing.push_back(passing / 100.0);
  }
  scarp::detail::validated(curve);
  return curve;
}

/// Sizes of a sand's grains, for grains of one, two (half axes) or three numbers (and an exponent).
template <class ShapePolicy>
struct SandGrading {
  using Shape = ShapePolicy;

  double smallest = 0.0;  ///< radius or major half axis [m]
  double largest = 0.0;
  double aspect = 1.0;
  double exponent = 1.0;
  SieveCurve sieve{};

  void validate() const { scarp::detail::validate_grading(smallest, largest, aspect, exponent); }

  std::vector<scarp::SizeOf<Shape>> sample(scarp::Random& random, int grains) const {
    constexpr auto numbers = std::tuple_size_v<scarp::SizeOf<Shape>>;
    double const minor_share = numbers > 1 ? aspect : 1.0;
    std::vector<double> majors;
    if (!sieve.diameters.empty()) majors = sieve.sample(random, Shape::dim, grains);
    for (double& major : majors) major = major / 2.0 / minor_share;
    while (majors.size() < static_cast<std::size_t>(grains)) majors.push_back(random.uniform(smallest, largest));
    std::vector<scarp::SizeOf<Shape>> sizes;
    for (double const major : majors) {
      sizes.push_back({major});
      if constexpr (numbers > 1) sizes.back()[1] = aspect * major;
      if constexpr (numbers > 2) sizes.back()[2] = exponent;
    }
    return sizes;
  }
};

/// \throws InputError
template <class Shape>
scarp::Cloud<SandGrading<Shape>> cloud_of(Sand const& sand, std::uint64_t seed) {
  validate(sand);
  return {.grading = {.smallest = sand.smallest,
                      .largest = sand.largest,
                      .aspect = sand.aspect,
                      .exponent = sand.exponent,
                      .sieve = sand.sieve.empty() ? SieveCurve{} : sieve_curve(sand.sieve)},
          .grains = sand.grains,
          .density = sand.density,
          .thickness = Shape::dim == 2 ? sand.thickness : 1.0,
          .seed = seed};
}

}  // namespace examples
