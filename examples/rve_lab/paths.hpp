// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "../shared/laboratory_loadings.hpp"
#include "../shared/print.hpp"
#include "scarp/core/error.hpp"

namespace rve_lab {

using Tensor = scarp::Tensor<2>;

inline constexpr double degree = std::numbers::pi / 180.0;

template <int Dim>
double axial_strain(Eigen::Matrix<double, Dim, Dim> const& deformation) {
  return 0.0 - std::log(deformation(Dim - 1, Dim - 1));
}
inline double shear_strain(Tensor const& deformation) { return deformation(0, 1); }
/// Half the difference of the logarithmic strains, which the path of constant mean stress prescribes.
inline double deviatoric_strain(Tensor const& deformation) {
  return 0.5 * std::log(deformation(0, 0) / deformation(1, 1));
}

/// A path by its name: the loading at a strain per step and a held pressure [Pa], and which pressure that is.
template <int Dim>
struct PathKindIn {
  std::string_view name;
  scarp::Loading<Dim> (*loading)(double rate, double held);
  double (*held)(scarp::Tensor<Dim> const& stress) = nullptr;  ///< null where nothing is held
  double (*strain)(scarp::Tensor<Dim> const& deformation) = axial_strain<Dim>;
  double row_strain = 1e-4;  ///< between the rows of a replay
};
using PathKind = PathKindIn<2>;

template <int Dim>
double lateral_pressure(Eigen::Matrix<double, Dim, Dim> const& stress) {
  return -stress.diagonal().template head<Dim - 1>().mean();
}
inline double axial_pressure(Tensor const& stress) { return -stress(1, 1); }
inline double mean_pressure(Tensor const& stress) { return -stress.trace() / 2.0; }

inline std::vector<PathKind> const& all_paths() {
  static std::vector<PathKind> const paths{
      {.name = "isotropic",
       .loading = [](double rate, double) { return examples::isotropic_compression<2>(rate); },
       .row_strain = 5e-5},
      {.name = "oedometer", .loading = [](double rate, double) { return scarp::oedometer<2>(rate); }},
      {.name = "biaxial", .loading = scarp::drained_compression<2>, .held = lateral_pressure<2>},
      {.name = "undrained", .loading = [](double rate, double) { return examples::undrained_compression<2>(rate); }},
      {.name = "pure_shear", .loading = [](double rate, double) { return examples::pure_shear<2>(rate); }},
      {.name = "simple_shear",
       .loading = [](double rate, double) { return examples::simple_shear<2>(rate); },
       .strain = shear_strain},
      {.name = "simple_shear_at_stress",
       .loading = examples::simple_shear_at_stress<2>,
       .held = axial_pressure,
       .strain = shear_strain},
      {.name = "constant_mean_stress",
       .loading = examples::constant_mean_stress<2>,
       .held = mean_pressure,
       .strain = deviatoric_strain}};
  return paths;
}

inline std::vector<std::string> path_names() {
  std::vector<std::string> names;
  for (auto const& path : all_paths()) names.emplace_back(path.name);
  return names;
}

/// \throws InputError for a name that is none
inline PathKind const& path_named(std::string_view name) {
  for (auto const& path : all_paths()) {
    if (path.name == name) return path;
  }
  scarp::reject("there is no path '{}' (the laboratory knows {}): choose one of these", name,
                scarp::listed(path_names(), ", "));
}

/// The only path of a packing in space: drained triaxial compression.
inline PathKindIn<3> const& triaxial_path() {
  static PathKindIn<3> const path{
      .name = "triaxial", .loading = scarp::drained_compression<3>, .held = lateral_pressure<3>};
  return path;
}

/// As many steps as make no step of a stretch of strain larger than the one that is wanted.
struct EvenSteps {
  long count = 1;
  double strain = 0.0;  ///< of one step: the wanted one itself where it divides the stretch

  /// least: number of steps
  static EvenSteps of(double stretch, double wanted, long least = 1) {
    constexpr double slight = 1e-9;
    auto const count = std::max(least, static_cast<long>(std::ceil(stretch / wanted * (1.0 - slight))));
    double const even = stretch / static_cast<double>(count);
    return {count, std::abs(even - wanted) <= slight * wanted ? wanted : even};
  }
};

/// The same, with a note where the wanted step does not divide the stretch. what: name of the stretch
inline EvenSteps even_steps(double stretch, double wanted, std::string_view what) {
  auto const even = EvenSteps::of(stretch, wanted);
  if (even.strain != wanted)
    examples::print_notes({fmt::format("--strain-step {} does not divide the {} {}: steps of {:.6g} are made", wanted,
                                       what, stretch, even.strain)});
  return even;
}

/// Steps between two rows.
inline long steps_of(double strain, double strain_step) { return std::max(1L, std::lround(strain / strain_step)); }

}  // namespace rve_lab
