// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "grading.hpp"
#include "scarp/dem/preparation.hpp"

namespace examples {

/// Gets a line for each step of a preparation; may throw to stop it.
using Progress = std::function<void(std::string const&)>;

/// \throws PreparationError
template <class PackingType>
PackingType settled(scarp::Prepared<PackingType> prepared, std::string const& what) {
  if (!prepared.verdict.acceptable())
    throw scarp::PreparationError(
        fmt::format("the packing could not be {} ({}): change pressure, stiffness, seed or number of grains", what,
                    scarp::name(prepared.verdict.reason)));
  return std::move(prepared.packing);
}

/// The isotropic consolidation of a sand, and how dense that makes it.
template <class PackingType>
struct Consolidation {
  PackingType cloud;
  typename PackingType::Law law;
  double pressure = 0.0;  ///< at which the void ratio is wanted [Pa]
  double begin = 0.0;     ///< of the consolidation by friction [Pa]; below `pressure` it is compressed from there
  Progress progress{};
  double least_friction = 0.0;  ///< of the densest packing

  struct Made {
    PackingType packing;  ///< at the pressure `begin`
    double void_ratio;    ///< at `pressure`
    double friction;
    double wanted = void_ratio;  ///< void ratio
  };

  /// \throws PreparationError
  Made at(double friction) const {
    scarp::IsotropicPreparation const first{.pressure = begin, .preparation_friction = friction};
    auto packing = settled(first.prepare(cloud, law), fmt::format("consolidated at friction {:.4f}", friction));
    double const void_ratio = begin < pressure ? compressed(packing).void_ratio() : packing.void_ratio();
    if (progress) progress(fmt::format("preparation friction {:.6f} gives void ratio {:.6f}", friction, void_ratio));
    return {std::move(packing), void_ratio, friction};
  }

  /// Without friction few grains may find no rest: then with as little as they need.
  Made densest() const {
    constexpr double slight = 0.005, most = 0.04;
    for (double friction = least_friction;; friction = std::max(slight, 2.0 * friction)) {
      try {
        return at(friction);
      } catch (scarp::PreparationError const&) {
        if (friction >= most) throw;
      }
    }
  }

 private:
  PackingType compressed(PackingType packing) const {
    constexpr int dim = PackingType::dim;
    scarp::Loading<dim> loading;
    for (int axis = 0; axis < dim; ++axis) loading.controls.push_back(scarp::component_control<dim>(axis, -pressure));
    scarp::TimeStepper<PackingType> stepper;
    scarp::Servo const servo{.stress_tolerance = 1e-3, .unbalanced_tolerance = 1e-3};
    auto const verdict = servo.reach(stepper, packing, law, loading);
    return settled<PackingType>({std::move(packing), verdict}, "compressed isotropically");
  }
};

/// Bisection on the preparation friction between none (densest) and the contacts' own (loosest).
/// allowed: how far the nearest void ratio found may be from the one that is wanted
/// \throws InputError for a void ratio outside what these give, or one that the bisection jumps over
template <class PackingType>
typename Consolidation<PackingType>::Made reach_density(Consolidation<PackingType> const& consolidation,
                                                        Sand const& sand, double allowed) {
  using Made = typename Consolidation<PackingType>::Made;
  constexpr int max_halvings = 16;
  double const tolerance = sand.void_ratio_tolerance;
  auto law = consolidation.law;
  double high = friction_coefficient(law);
  Made nearest = consolidation.densest();
  double low = nearest.friction;
  double const first = low;
  double const densest = nearest.void_ratio;
  double target = sand.void_ratio;
  auto const missing = [&](Made const& made) { return std::abs(made.void_ratio - target); };
  double loosest = densest;
  if (sand.relative_density > 0.0 || missing(nearest) > tolerance) {
    Made loose = consolidation.at(high);
    loosest = loose.void_ratio;
    if (sand.relative_density > 0.0) target = loosest - sand.relative_density * (loosest - densest);
    if (missing(loose) < missing(nearest)) nearest = std::move(loose);
  }
  bool const between = densest <= target && target <= loosest;
  for (int k = 0; between && k < max_halvings && missing(nearest) > tolerance; ++k) {
    Made middle = consolidation.at((low + high) / 2.0);
    (middle.void_ratio < target ? low : high) = middle.friction;
    if (missing(middle) < missing(nearest)) nearest = std::move(middle);
  }
  if (missing(nearest) > allowed)
    scarp::reject(
        "void ratio {:.6g} is not reached (frictions from {} to {} give {:.6f} to {:.6f}, the nearest found is {:.6f} "
        "at {}): choose one in between, another seed or a wider tolerance",
        target, first, friction_coefficient(law), densest, loosest, nearest.void_ratio, nearest.friction);
  nearest.wanted = target;
  return nearest;
}

/// \throws InputError as reach_density, PreparationError
template <class PackingType>
typename Consolidation<PackingType>::Made consolidated(Consolidation<PackingType> const& consolidation,
                                                       Sand const& sand, double allowed) {
  bool const by_friction = sand.void_ratio == 0.0 && sand.relative_density == 0.0;
  return by_friction ? consolidation.at(sand.preparation_friction) : reach_density(consolidation, sand, allowed);
}

/// Horizontal over vertical stress, without shear strain. vertical [Pa]
/// \throws PreparationError
template <class PackingType>
PackingType brought_to_k0(PackingType packing, typename PackingType::Law const& law, double vertical, double k0) {
  constexpr int dim = PackingType::dim;
  scarp::Loading<dim> loading;
  for (int axis = 0; axis < dim; ++axis)
    loading.controls.push_back(scarp::component_control<dim>(axis, axis < dim - 1 ? -k0 * vertical : -vertical));
  scarp::TimeStepper<PackingType> stepper;
  auto verdict = scarp::Servo{}.reach(stepper, packing, law, loading);
  if (auto const stopped = stepper.stop(packing, law); verdict.acceptable()) verdict = stopped;
  return settled<PackingType>({std::move(packing), verdict}, fmt::format("brought to k0 {}", k0));
}

/// A packing of a sand, with a seed of its own. off: how far its void ratio may be off the one that is wanted
/// isotropic_void_ratio: where given, becomes that at the isotropic pressure
/// \throws InputError, PreparationError, and what progress throws
template <class PackingType>
PackingType prepared(Sand const& sand, typename PackingType::Law const& law, std::uint64_t seed,
                     Progress const& progress, double off, double* isotropic_void_ratio = nullptr) {
  if (sand.overconsolidation_ratio > 1.0 && sand.vertical_pressure == 0.0)
    scarp::reject(
        "overconsolidation-ratio is {} without a vertical-pressure (it is a ratio of that): give both, or none",
        sand.overconsolidation_ratio);
  auto const cloud = cloud_of<typename PackingType::Shape>(sand, seed);
  Consolidation<PackingType> const consolidation{cloud.template make<PackingType>(), law, sand.pressure, sand.pressure,
                                                 progress};
  auto made = consolidated(consolidation, sand, off);
  if (isotropic_void_ratio) *isotropic_void_ratio = made.void_ratio;
  auto packing = std::move(made.packing);
  if (sand.vertical_pressure > 0.0) {
    if (progress) progress("compressed without lateral strain");
    std::vector<double> path{sand.overconsolidation_ratio * sand.vertical_pressure};
    if (sand.overconsolidation_ratio > 1.0) path.push_back(sand.vertical_pressure);
    auto column = scarp::OneDimensionalCompression{}.compress(std::move(packing), law, path);
    packing = settled(std::move(column.back()), "compressed one-dimensionally");
  }
  if (sand.k0 == 0.0) return packing;
  return brought_to_k0(std::move(packing), law, sand.vertical_pressure > 0.0 ? sand.vertical_pressure : sand.pressure,
                       sand.k0);
}

}  // namespace examples
