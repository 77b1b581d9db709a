// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "contact/every_law.hpp"
#include "scarp/core/random.hpp"
#include "scarp/dem/time_stepping.hpp"

/// A packing under test without its types, so that what is asked of all of them is compiled once: seconds per pairing
/// count.
namespace pairings {

using scarp::Tensor;
using scarp::Vector;
using scarp::Verdict;

/// Everything that moves. Spins stand along z in the plane; axes are those of plane grains.
template <int Dim>
struct Grains {
  Tensor<Dim> cell;
  std::vector<Vector<Dim>> position;
  std::vector<Vector<Dim>> velocity;
  std::vector<Vector<3>> spin;
  std::vector<Vector<2>> axis;
};

template <int Dim>
struct Specimen {
  scarp::StepObservation<Dim> seen{};  ///< before the last step

  virtual ~Specimen() = default;
  virtual Grains<Dim> grains() const = 0;
  /// New motion and no pair list.
  virtual void place(Grains<Dim> const& grains) = 0;
  /// Moves one grain along one axis and leaves the pair list as it is.
  virtual void displace(std::size_t grain, int axis, double by) = 0;
  /// Makes the list and bonds every near pair where the law has bonds; those too far apart break at once.
  virtual void bond() = 0;
  virtual Verdict step(Tensor<Dim> const& strain) = 0;
  virtual double time_step() const = 0;
  virtual double mass(std::size_t grain) const = 0;
  virtual double inertia(std::size_t grain) const = 0;
  /// Whether any force has an arm.
  virtual bool turns_grains() const = 0;
};

/// A jittered grid of grains that overlap by some tenths and move at random, in a cell without right angles.
template <int Dim>
Grains<Dim> crowd(int side, double spacing, scarp::Random& random) {
  Grains<Dim> grains;
  grains.cell = side * spacing * Tensor<Dim>::Identity();
  grains.cell(0, 1) = 0.1 * spacing * side;
  grains.cell(Dim - 1, 0) = 0.04 * spacing * side;
  int count = 1;
  for (int a = 0; a < Dim; ++a) count *= side;
  auto const within = [&](double size) { return random.uniform(-size, size); };
  for (int i = 0; i < count; ++i) {
    Vector<Dim> place, velocity;
    for (int a = 0, rest = i; a < Dim; ++a, rest /= side) place(a) = (rest % side + random.uniform(0.0, 0.2)) / side;
    for (int a = 0; a < Dim; ++a) velocity(a) = within(0.1);
    grains.position.push_back(grains.cell * place);
    grains.velocity.push_back(velocity);
    Vector<3> spin = Vector<3>::Zero();
    for (int k = Dim == 2 ? 2 : 0; k < 3; ++k) spin(k) = within(0.1);
    grains.spin.push_back(spin);
    double const angle = within(3.0);
    grains.axis.emplace_back(std::cos(angle), std::sin(angle));
  }
  return grains;
}

template <class Shape>
std::shared_ptr<scarp::Population<Shape> const> population_of(std::size_t count, scarp::Random& random) {
  std::vector<typename scarp::Population<Shape>::Size> sizes(count);
  for (auto& size : sizes) {
    double const length = random.uniform(0.8, 1.0);
    if constexpr (Shape::size_count == 1) {
      size = {length / Shape::bounding_radius({1.0})};
    } else {
      size[0] = length;
      size[1] = length * random.uniform(0.7, 0.95);
      if constexpr (Shape::size_count == 3) size[2] = random.uniform(0.6, 1.3);  // exponent
    }
  }
  return std::make_shared<scarp::Population<Shape> const>(sizes, 1.0, 1.0);
}

template <class P>
class SpecimenOf final : public Specimen<P::Shape::dim> {
 public:
  using Shape = typename P::Shape;
  using Law = typename P::Law;
  static constexpr int dim = Shape::dim;

  explicit SpecimenOf(std::uint64_t seed) {
    stepper_.damping = {.factor = 0.0, .drag = 0.0};
    scarp::Random random(seed);
    constexpr int side = dim == 2 ? 5 : 3;
    auto const grains = crowd<dim>(side, 1.6, random);
    packing_.population = population_of<Shape>(grains.position.size(), random);
    place(grains);
  }

  Grains<dim> grains() const override {
    Grains<dim> grains{packing_.cell, {}, {}, {}, {}};
    for (std::size_t i = 0; i < packing_.grain_count(); ++i) {
      auto const spin = packing_.spin.row(i);
      grains.position.emplace_back(packing_.position.row(i).data());
      grains.velocity.emplace_back(packing_.velocity.row(i).data());
      grains.spin.push_back(Vector<3>::Zero());
      std::copy(spin.begin(), spin.end(), grains.spin.back().end() - spin.size());
      auto const axis = packing_.orientation.row(i);
      if constexpr (Shape::orientation_count == 2) grains.axis.emplace_back(axis[0], axis[1]);
    }
    return grains;
  }

  void place(Grains<dim> const& grains) override {
    packing_.cell = grains.cell;
    packing_.position.resize(grains.position.size());
    packing_.orientation.resize(grains.position.size());
    packing_.rest();
    packing_.pairs = {};
    for (std::size_t i = 0; i < grains.position.size(); ++i) {
      for (int a = 0; a < dim; ++a) {
        packing_.position(i, a) = grains.position[i](a);
        packing_.velocity(i, a) = grains.velocity[i](a);
      }
      constexpr int spins = scarp::spin_size<dim>;
      for (int k = 0; k < spins; ++k) packing_.spin(i, k) = grains.spin[i](3 - spins + k);
      if constexpr (Shape::orientation_count == 2)
        packing_.orientation.set_row(i, {grains.axis[i](0), grains.axis[i](1)});
    }
  }

  void displace(std::size_t grain, int axis, double by) override { packing_.position(grain, axis) += by; }

  void bond() override {
    REQUIRE(stepper_.refresh(packing_, law_).acceptable());
    scarp::ContactMemory<dim, double> memory;
    samples::bond_if_possible<Law>(memory);
    auto row = packing_.pairs.scalars.row(0);
    std::copy_n(memory.scalars.begin(), row.size(), row.begin());
    for (std::size_t p = 0; p < packing_.pairs.count(); ++p) packing_.pairs.scalars.set_row(p, row);
  }

  Verdict step(Tensor<dim> const& strain) override {
    return stepper_.template step<scarp::Observe::balance>(packing_, law_, strain, &this->seen);
  }

  double time_step() const override { return stepper_.time_step_share * packing_.pairs.critical_step; }
  double mass(std::size_t grain) const override { return 1.0 / packing_.population->inverse_mass()[grain]; }
  double inertia(std::size_t grain) const override { return 1.0 / packing_.population->inverse_inertia()[grain]; }
  bool turns_grains() const override { return Shape::orientation_count > 0 || Law::inputs.shear || Law::inputs.moment; }

 private:
  Law law_ = samples::Sample<Law>::law();
  scarp::TimeStepper<scarp::Packing<Shape, Law>> stepper_;
  scarp::Packing<Shape, Law> packing_;
};

}  // namespace pairings
