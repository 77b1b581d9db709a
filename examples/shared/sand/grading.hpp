// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "sand.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/sieve_curve.hpp"

namespace examples {

/// A sieve curve from the text of a sand's option: "0.002 0, 0.006 100", diameters [m] and per cent.
/// \throws InputError
inline scarp::SieveCurve sieve_curve(std::string const& text) {
  scarp::SieveCurve curve;
  for (std::size_t begin = 0; begin <= text.size();) {
    auto const end = std::min(text.find(',', begin), text.size());
    double diameter = 0.0, passing = 0.0;
    char rest = 0;
    if (std::sscanf(text.substr(begin, end - begin).c_str(), "%lf %lf %c", &diameter, &passing, &rest) != 2)
      scarp::reject(
          "'{}' is no point of a sieve curve (a diameter [m] and per cent that pass are expected): correct it",
          text.substr(begin, end - begin));
    curve.diameters.push_back(diameter);
    curve.passing.push_back(passing / 100.0);
    begin = end + 1;
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
  scarp::SieveCurve sieve{};

  void validate() const { scarp::detail::validate_grading(smallest, largest, aspect, exponent); }

  scarp::SizeOf<Shape> sample(scarp::Random& random) const {
    constexpr auto numbers = std::tuple_size_v<scarp::SizeOf<Shape>>;
    scarp::SizeOf<Shape> size{};
    double const minor_share = numbers > 1 ? aspect : 1.0;
    size[0] = sieve.diameters.empty() ? random.uniform(smallest, largest)
                                      : sieve.sample(random, Shape::dim) / 2.0 / minor_share;
    if constexpr (numbers > 1) size[1] = aspect * size[0];
    if constexpr (numbers > 2) size[2] = exponent;
    return size;
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
                      .sieve = sand.sieve.empty() ? scarp::SieveCurve{} : sieve_curve(sand.sieve)},
          .grains = sand.grains,
          .density = sand.density,
          .thickness = Shape::dim == 2 ? sand.thickness : 1.0,
          .seed = seed};
}

}  // namespace examples
