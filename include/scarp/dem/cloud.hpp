// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "scarp/core/random.hpp"
#include "scarp/dem/packing.hpp"

namespace scarp {

/// A loose random cloud in a square cell, the start of every preparation: grains are placed one by one, largest first, at
/// random without touching (bounding circles), their axes evenly spread over all directions. Random sequential addition jams near a filled share
/// of 0.547 for equal discs; the default stays well below.
template <class Grading>
struct Cloud {
  using Shape = typename Grading::Shape;

  Grading grading;
  int grains = 0;
  double density = 0.0;    ///< [kg/m3]
  double thickness = 0.0;  ///< out of plane [m]
  std::uint64_t seed = 1;
  double filled_share = 0.42;  ///< area of the bounding circles over area of the cell

  /// \throws InputError on counts, sizes or shares that cannot be packed
  template <class PackingType>
  PackingType make() const {
    static_assert(Shape::dim == 2, "placement is written for the plane");
    using Scalar = typename PackingType::Scalar;
    if (grains < 1)
      refuse("a packing of {} grains was asked for (nothing can carry stress): give at least one grain", grains);
    require_positive("share of the cell filled by the cloud", filled_share);
    Random random(seed);
    std::vector<typename Shape::template Size<double>> sizes;
    for (int i = 0; i < grains; ++i) sizes.push_back(grading.sample(random));
    std::sort(sizes.begin(), sizes.end(), std::greater<>{});

    PackingType packing;
    packing.population = std::make_shared<Population<Shape, Scalar> const>(sizes, density, thickness);
    double circles = 0.0;
    for (auto const& size : sizes) circles += std::numbers::pi * std::pow(Shape::bounding_radius(size), 2);
    double const side = std::sqrt(circles / filled_share);
    packing.cell = Tensor<2>::Identity() * side;
    packing.position.resize(sizes.size());
    packing.orientation.resize(sizes.size());
    packing.rest();

    double const first_axis = random.uniform();
    constexpr long most_trials = 1'000'000;  // ordinary clouds need some ten per grain
    std::vector<Vector<2>> placed;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      double const radius = Shape::bounding_radius(sizes[i]);
      bool free = false;
      for (long trial = 0; !free; ++trial) {
        if (trial == most_trials) {
          refuse("grain {} of {} found no free place (the cloud fills {} of its cell): use a smaller share", i + 1,
                 grains, filled_share);
        }
        Vector<2> place;
        place(0) = random.uniform(0.0, side);
        place(1) = random.uniform(0.0, side);
        free = true;
        for (std::size_t j = 0; j < placed.size() && free; ++j) {
          Vector<2> branch = placed[j] - place;
          for (int a = 0; a < 2; ++a) branch(a) -= side * std::round(branch(a) / side);
          free = branch.norm() > radius + Shape::bounding_radius(sizes[j]);
        }
        if (free) placed.push_back(place);
      }
      for (int a = 0; a < 2; ++a) packing.position(i, a) = static_cast<Scalar>(placed[i](a));
      if constexpr (Shape::orientation_count == 2) {
        // Golden-ratio sequence: evenly spread axes, unrelated to the order of sizes.
        double const golden = std::numbers::phi * static_cast<double>(i) + first_axis;
        double const angle = std::numbers::pi * (golden - std::floor(golden));
        packing.orientation(i, 0) = static_cast<Scalar>(std::cos(angle));
        packing.orientation(i, 1) = static_cast<Scalar>(std::sin(angle));
      }
    }
    return packing;
  }
};

}  // namespace scarp
