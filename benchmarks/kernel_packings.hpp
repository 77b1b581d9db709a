// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/shape/clump.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/shape/superellipse.hpp"

/// Packings that the benchmarks of the kernel look at.
namespace scarp_benchmark {

template <class Shape>
using StudyPacking = scarp::Packing<Shape, scarp::LinearFrictional>;

inline constexpr double pressure = 2e5;

/// The reference study's springs; in space such that two grains overlap by the same share of their radius.
template <class Shape>
inline constexpr double stiffness_of_study = Shape::dim == 2 ? 6e6 : 3e5;

/// The reference study's material in terms of another law, which keeps the springs as far as it has them.
template <class Shape, class Law>
struct MaterialOfStudy;
template <class Shape>
struct MaterialOfStudy<Shape, scarp::LinearFrictional> {
  static scarp::LinearFrictional law() {
    return {.normal_stiffness = stiffness_of_study<Shape>,
            .tangential_stiffness = stiffness_of_study<Shape>,
            .friction = 0.55};
  }
};
template <class Shape>
struct MaterialOfStudy<Shape, scarp::Frictionless> {
  static scarp::Frictionless law() { return {.normal_stiffness = stiffness_of_study<Shape>}; }
};
template <class Shape>
struct MaterialOfStudy<Shape, scarp::HertzMindlin<>> {
  /// The linear spring's force at the mean overlap of two grains of 5 mm at 200 kPa, a 75th of their radius.
  static scarp::HertzMindlin<> law() {
    constexpr double overlap = 5e-3 / 75.0;
    constexpr double reduced_radius = 2.5e-3;
    double const reduced_modulus = 0.75 * stiffness_of_study<Shape> / std::sqrt(reduced_radius * overlap);
    return scarp::HertzMindlin<>::of({.modulus = 2.0 * (1.0 - 0.2 * 0.2) * reduced_modulus, .poisson = 0.2}, 0.55);
  }
};
template <class Shape, class Law>
struct MaterialOfStudy<Shape, scarp::RollingResistance<Law>> {
  static scarp::RollingResistance<Law> law() {
    return {.law = MaterialOfStudy<Shape, Law>::law(),
            .rolling_stiffness = 0.1 * stiffness_of_study<Shape> * 5e-3 * 5e-3,
            .rolling_friction = 0.2};
  }
};
template <class Shape, class Law>
struct MaterialOfStudy<Shape, scarp::CohesiveBond<Law>> {
  /// Strengths of a quarter of the mean contact force.
  static scarp::CohesiveBond<Law> law() {
    double const strength = stiffness_of_study<Shape> * 5e-3 / 300.0;
    return {.law = MaterialOfStudy<Shape, Law>::law(), .tensile_strength = strength, .shear_strength = strength};
  }
};

template <class PackingType>
typename PackingType::Law law_of_study() {
  return MaterialOfStudy<typename PackingType::Shape, typename PackingType::Law>::law();
}

template <class Shape>
auto grading_of_study() {
  if constexpr (std::is_same_v<Shape, scarp::Disc>) {
    return scarp::DiscGrading{.smallest = 4e-3, .largest = 6e-3};
  } else if constexpr (std::is_same_v<Shape, scarp::Sphere>) {
    return scarp::SphereGrading{.smallest = 4e-3, .largest = 6e-3};
  } else if constexpr (std::is_same_v<Shape, scarp::Dumbbell>) {
    return scarp::ClumpGrading<scarp::DumbbellTemplate>{.smallest = 2.5e-3, .largest = 3.5e-3};
  } else if constexpr (std::is_same_v<Shape, scarp::Superellipse>) {
    return scarp::SuperellipseGrading{.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75, .exponent = 0.6};
  } else {
    return scarp::EllipseGrading{.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75};
  }
}

/// Consolidated at 200 kPa; made once for each shape and number of grains.
template <class Shape>
StudyPacking<Shape> const& consolidated(int grains) {
  static std::map<int, StudyPacking<Shape>> made;
  auto const known = made.find(grains);
  if (known != made.end()) return known->second;
  auto const grading = grading_of_study<Shape>();
  scarp::Cloud<std::remove_const_t<decltype(grading)>> cloud{
      .grading = grading, .grains = grains, .density = 2650.0, .seed = 1};
  if constexpr (Shape::dim == 2) cloud.thickness = 0.2;
  scarp::IsotropicPreparation const preparation{.pressure = pressure};
  auto prepared = preparation.prepare(cloud.template make<StudyPacking<Shape>>(), law_of_study<StudyPacking<Shape>>());
  if (!prepared.verdict.acceptable()) {
    scarp::reject("{} grains were not consolidated ({}): the benchmark needs another seed", grains,
                  scarp::name(prepared.verdict.reason));
  }
  return made.emplace(grains, std::move(prepared.packing)).first->second;
}

/// How the grains of several cells are numbered: copy after copy, or at random, as in a cloud, whose neighbours lie
/// anywhere in memory.
enum class Numbering { by_place, at_random };

inline std::vector<std::size_t> numbers_of(std::size_t grains, Numbering numbering, scarp::Random& random) {
  std::vector<std::size_t> numbers(grains);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  if (numbering == Numbering::at_random) {
    for (std::size_t left = grains; left > 1; --left)
      std::swap(numbers[left - 1], numbers[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(left)))]);
  }
  return numbers;
}

/// `copies` x `copies` cells side by side, with another scalar or law; the list of pairs is made anew, shear forces
/// start from zero. Several copies get velocities of some mm/s at random, lest they stay copies of each other.
template <class PackingType>
PackingType converted(StudyPacking<typename PackingType::Shape> const& from, int copies = 1,
                      Numbering numbering = Numbering::at_random) {
  using Shape = typename PackingType::Shape;
  using Scalar = typename PackingType::Scalar;
  constexpr int dim = Shape::dim;
  auto const& population = *from.population;
  std::size_t const tiles = static_cast<std::size_t>(copies * copies);
  std::size_t const grains = from.grain_count();
  scarp::Random random(1);
  auto const numbers = numbers_of(tiles * grains, copies > 1 ? numbering : Numbering::by_place, random);
  std::vector<typename Shape::template Size<double>> sizes(tiles * grains);
  PackingType packing;
  packing.cell = from.cell;
  packing.cell.leftCols(2) *= copies;
  packing.position.resize(sizes.size());
  packing.orientation.resize(sizes.size());
  packing.rest();
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    scarp::Vector<dim> const offset = from.cell.col(0) * static_cast<double>(tile % static_cast<std::size_t>(copies)) +
                                      from.cell.col(1) * static_cast<double>(tile / static_cast<std::size_t>(copies));
    for (std::size_t i = 0; i < grains; ++i) {
      std::size_t const to = numbers[tile * grains + i];
      sizes[to] = population.size(i);
      for (int a = 0; a < dim; ++a) {
        packing.position(to, a) = static_cast<Scalar>(from.position(i, a) + offset(a));
        if (copies > 1) packing.velocity(to, a) = static_cast<Scalar>(random.uniform(-2e-3, 2e-3));
      }
      for (int k = 0; k < Shape::orientation_count; ++k) {
        if constexpr (Shape::orientation_count > 0)
          packing.orientation(to, k) = static_cast<Scalar>(from.orientation(i, k));
      }
    }
  }
  packing.population =
      std::make_shared<scarp::Population<Shape, Scalar> const>(sizes, population.density(), population.thickness());
  return packing;
}

/// Slow pure shear that turns round every 200 steps: the packing stays in steady contact.
template <int Dim>
class SlowShear {
 public:
  explicit SlowShear(double strain_per_step = 1e-6) : rate_(strain_per_step) {}

  scarp::Tensor<Dim> next() {
    double const rate = (count_++ / 200) % 2 == 0 ? rate_ : -rate_;
    scarp::Tensor<Dim> strain = scarp::Tensor<Dim>::Zero();
    strain(0, 0) = rate;
    strain(1, 1) = -rate;
    return strain;
  }

 private:
  double rate_;
  long count_ = 0;
};

/// Bonds all contacts of a packing whose law has bonds.
template <class PackingType>
void bond_contacts(PackingType& packing, typename PackingType::Law const& law) {
  using Law = typename PackingType::Law;
  using Memory = scarp::ContactMemory<PackingType::dim, typename PackingType::Scalar>;
  if constexpr (requires(Memory & memory) { Law::bond(memory); }) {
    if (!scarp::TimeStepper<PackingType>{}.refresh(packing, law).acceptable())
      scarp::reject("{} grains have no list of near pairs: the benchmark needs another seed", packing.grain_count());
    std::vector<std::size_t> closed;
    scarp::for_each_contact(packing, law, [&](auto const& contact) { closed.push_back(contact.pair); });
    Memory bonded;
    Law::bond(bonded);
    for (std::size_t const pair : closed) {
      for (int k = 0; k < Law::inputs.scalars; ++k)
        packing.pairs.scalars(pair, k) = bonded.scalars[static_cast<std::size_t>(k)];
    }
  }
}

/// Lets the cell change until it carries 200 kPa again.
template <class PackingType>
void settle(PackingType& packing, typename PackingType::Law const& law) {
  constexpr int dim = PackingType::dim;
  scarp::VoigtStress<dim> target = scarp::VoigtStress<dim>::Zero();
  target.template head<dim>().setConstant(-pressure);
  scarp::TimeStepper<PackingType> stepper;
  scarp::Servo const servo{.stress_tolerance = 1e-2, .unbalanced_tolerance = 1e-2, .max_steps = 50'000};
  if (auto const verdict = servo.reach(stepper, packing, law, scarp::Loading<dim>::stress(target));
      !verdict.acceptable()) {
    scarp::reject("{} grains did not settle under another law ({}): loosen the tolerances", packing.grain_count(),
                  scarp::name(verdict.reason));
  }
  packing.rest();  // grains without contact fly on for ever and would make the list of pairs old
}

/// A packing in slow shear, made once for each type and number of grains: consolidated, brought to its law and
/// precision, 400 steps sheared, or 4000 where the law is another and grains must find new places. More than 1600
/// grains are copies of 1600.
template <class PackingType>
PackingType const& sheared(int grains, Numbering numbering = Numbering::at_random) {
  using Shape = typename PackingType::Shape;
  using Law = typename PackingType::Law;
  static std::map<std::pair<int, Numbering>, PackingType> made;
  auto const known = made.find({grains, numbering});
  if (known != made.end()) return known->second;
  auto const law = law_of_study<PackingType>();
  int const copies = grains <= 1600 ? 1 : static_cast<int>(std::lround(std::sqrt(grains / 1600)));
  auto const& source = consolidated<Shape>(grains / (copies * copies));
  constexpr bool same_springs = scarp::Frictional<Law> && !std::is_same_v<Law, scarp::HertzMindlin<>>;
  constexpr int steps = same_springs ? 400 : 4000;
  PackingType packing;
  if constexpr (std::is_same_v<PackingType, StudyPacking<Shape>>) {
    packing = copies == 1 ? source : converted<PackingType>(source, copies, numbering);
  } else {
    packing = converted<PackingType>(source, copies, numbering);
    bond_contacts(packing, law);
    if constexpr (!same_springs) settle(packing, law);
  }
  scarp::TimeStepper<PackingType> stepper;
  SlowShear<PackingType::dim> shear;
  for (int step = 0; step < steps; ++step) {
    if (!stepper.step(packing, law, shear.next()).acceptable())
      scarp::reject("a packing of {} grains failed in shear: the benchmark needs another seed", grains);
  }
  return made.emplace(std::pair(grains, numbering), std::move(packing)).first->second;
}

template <class PackingType>
std::size_t contact_count(PackingType const& packing, typename PackingType::Law const& law) {
  std::size_t count = 0;
  scarp::for_each_contact(packing, law, [&](auto const&) { ++count; });
  return count;
}

}  // namespace scarp_benchmark
