// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "scarp/core/interruption.hpp"
#include "scarp/core/random.hpp"
#include "scarp/dem/packing.hpp"

namespace scarp {

/// sample(random): parameters of one grain [m] of the shape that it names; or sample(random, count) of so many, which
/// depend on each other.
template <class Grading>
concept SamplesGrains = ParticleShape<typename Grading::Shape> &&(
    requires(Grading const& grading, Random& random) {
      { grading.sample(random) } -> std::same_as<SizeOf<typename Grading::Shape>>;
    } ||
    requires(Grading const& grading, Random& random) {
      { grading.sample(random, 1) } -> std::same_as<std::vector<SizeOf<typename Grading::Shape>>>;
    });

/// Random sequential insertion: a loose cloud in a square or cubic cell, the start of every preparation: grains are
/// placed one by one, largest first, at random without touching (bounding circles or spheres), plane grains with their
/// axes evenly spread over all directions. Random sequential addition jams near a filled share of 0.547 for equal discs
/// and 0.384 for equal spheres; the defaults stay well below.
template <SamplesGrains Grading>
struct Cloud {
  using Shape = typename Grading::Shape;  ///< of all grains

  Grading grading{};                                    ///< distribution of the sizes [m]
  int grains = 0;                                       ///< number of grains, at least one
  double density = 0.0;                                 ///< [kg/m3]
  double thickness = Shape::dim == 2 ? 0.0 : 1.0;       ///< out of plane [m]; in space it stays 1
  std::uint64_t seed = 1;                               ///< of sizes, places and axes
  double filled_share = Shape::dim == 2 ? 0.42 : 0.25;  ///< content of the bounding circles or spheres over the cell's

  /// \throws InputError
  void validate() const {
    detail::validated(grading);
    if (grains < 1)
      reject("a packing of {} grains was requested (nothing can carry stress): give at least one grain", grains);
    require_positive("share of the cell filled by the cloud", filled_share);
    require_between("share of the cell filled by the cloud", filled_share, 0.0, 1.0);
  }

  /// A packing at rest whose grains do not touch, without a pair list.
  /// \throws InputError on counts, sizes or shares that cannot be packed
  template <class PackingType>
  PackingType make() const {
    constexpr int dim = Shape::dim;
    using Scalar = typename PackingType::Scalar;
    validate();
    Random random(seed);
    std::vector<SizeOf<Shape>> sizes;
    if constexpr (requires { grading.sample(random, grains); })
      sizes = grading.sample(random, grains);
    else
      for (int i = 0; i < grains; ++i) sizes.push_back(grading.sample(random));
    if (detail::count(sizes) != grains)
      reject("the grading gives {} grains (asked for {}): let sample(random, count) return as many", sizes.size(),
             grains);
    std::sort(sizes.begin(), sizes.end(), std::greater<>{});

    PackingType packing;
    packing.population = std::make_shared<Population<Shape, Scalar> const>(sizes, density, thickness);
    constexpr double ball = dim == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
    double filled = 0.0;
    auto const& population = *packing.population;
    for (std::size_t i = 0; i < sizes.size(); ++i) filled += ball * std::pow(population.bounding_radius(i), dim);
    double const side = std::pow(filled / filled_share, 1.0 / dim);
    packing.cell = Tensor<dim>::Identity() * side;
    packing.position.resize(sizes.size());
    packing.orientation.resize(sizes.size());
    packing.rest();

    double const first_axis = random.uniform();
    constexpr long max_trials = 1'000'000;  // ordinary clouds need some ten per grain
    std::vector<Vector<dim>> placed;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      InterruptionCheck::run();
      double const radius = population.bounding_radius(i);
      bool free = false;
      for (long trial = 0; !free; ++trial) {
        if (trial == max_trials) {
          reject("grain {} of {} found no free place (the cloud fills {} of its cell): use a smaller share", i + 1,
                 grains, filled_share);
        }
        Vector<dim> place;
        for (int a = 0; a < dim; ++a) place(a) = random.uniform(0.0, side);
        free = true;
        for (std::size_t j = 0; j < placed.size() && free; ++j) {
          Vector<dim> branch = placed[j] - place;
          for (int a = 0; a < dim; ++a) branch(a) -= side * std::round(branch(a) / side);
          free = branch.norm() > radius + population.bounding_radius(j);
        }
        if (free) placed.push_back(place);
      }
      for (int a = 0; a < dim; ++a) packing.position(i, a) = static_cast<Scalar>(placed[i](a));
      if constexpr (Shape::orientation_count == 2) {
        // Golden-ratio sequence: evenly spread axes, unrelated to the order of sizes.
        double const golden = std::numbers::phi * static_cast<double>(i) + first_axis;
        constexpr double turn = (is_point_symmetric<Shape>() ? 1.0 : 2.0) * std::numbers::pi;
        double const angle = turn * (golden - std::floor(golden));
        packing.orientation(i, 0) = static_cast<Scalar>(std::cos(angle));
        packing.orientation(i, 1) = static_cast<Scalar>(std::sin(angle));
      }
    }
    return packing;
  }
};

}  // namespace scarp
