// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "../shared/energy_ledger.hpp"
#include "../shared/sliding_contacts.hpp"
#include "non_affine.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "specimen.hpp"

namespace rve_lab {

/// One row of the path table: names and values of its cells.
using Row = std::vector<std::pair<std::string, double>>;

inline double value(Row const& row, std::string_view name) {
  auto const cell = std::find_if(row.begin(), row.end(), [&](auto const& one) { return one.first == name; });
  return cell->second;
}

/// Difference of the principal stresses [Pa] of the symmetric part.
inline double deviator(Tensor const& stress) {
  return std::hypot(stress(0, 0) - stress(1, 1), stress(0, 1) + stress(1, 0));
}

/// Angle of the major principal direction of a symmetric tensor, from x [degrees], within (-90, 90].
inline double major_direction(Tensor const& tensor) {
  return 90.0 / std::numbers::pi * std::atan2(tensor(0, 1) + tensor(1, 0), tensor(0, 0) - tensor(1, 1));
}

template <class PackingType>
double mean_radius(PackingType const& packing) {
  auto const count = packing.grain_count();
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += std::sqrt(PackingType::Shape::content(packing.population->size(i)) / std::numbers::pi);
  }
  return sum / static_cast<double>(count);
}

/// Evaluates a specimen after every step for a row of the table.
template <class PackingType>
class Recorder {
 public:
  using Lab = Specimen<PackingType, scarp::Observe::energy>;

  explicit Recorder(PackingType const& start)
      : start_(start), radius_(mean_radius(start)), rotation_(start.grain_count(), 0.0) {}

  /// volume [m3] of the cell before the step that was just made
  void look(Lab const& lab, double volume) {
    ledger_.enter(lab.seen(), volume, lab.strain_step());
    stress_sum_ += lab.seen().stress;
    ++steps_in_row_;
    for (std::size_t i = 0; i < rotation_.size(); ++i) rotation_[i] += lab.packing().spin(i, 0) * lab.time_step();
  }

  /// Ends the row: means are those since the former one.
  Row row(Lab const& lab, PathKind const& path, long step) {
    auto const& packing = lab.packing();
    auto const state = scarp::balance(packing, lab.law());
    Tensor const& deformation = lab.deformation();
    Tensor const mean = steps_in_row_ > 0 ? Tensor(stress_sum_ / static_cast<double>(steps_in_row_)) : state.stress;
    stress_sum_.setZero();
    steps_in_row_ = 0;
    Row row{{"step", static_cast<double>(step)}, {"strain", path.strain(deformation)}};
    add_tensor(row, "F", deformation);
    row.emplace_back("axial_strain", 0.0 - std::log(deformation(1, 1)));
    row.emplace_back("volumetric_strain", 0.0 - std::log(deformation.determinant()));
    add_tensor(row, "s", state.stress);
    add_tensor(row, "mean_s", mean);
    row.insert(row.end(), {{"p", mean_pressure(state.stress)},
                           {"q", deviator(state.stress)},
                           {"mean_p", mean_pressure(mean)},
                           {"mean_q", deviator(mean)},
                           {"void_ratio", packing.void_ratio()},
                           {"n_contacts", state.contacts}});
    add_structure(row, lab);
    row.insert(row.end(),
               {{"work_in", ledger_.work_in},
                {"stored", ledger_.stored},
                {"contact_loss", ledger_.contact_loss},
                {"damping_loss", ledger_.damping_loss},
                {"kinetic", ledger_.kinetic},
                {"energy_gap", ledger_.gap()},
                {"unbalanced_ratio", state.unbalanced_ratio},
                {"kinetic_share", mean_pressure(scarp::kinetic_stress(packing)) / mean_pressure(state.stress)}});
    add_motion(row, lab);
    row.emplace_back("sliding_share", examples::sliding_share(packing, lab.law()));
    row.emplace_back("max_overlap_over_rmin", deepest_overlap(packing, lab.law()));
    return row;
  }

 private:
  static void add_tensor(Row& row, std::string const& name, Tensor const& tensor) {
    constexpr char axis[] = {'x', 'y'};
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) row.emplace_back(name + axis[a] + axis[b], tensor(a, b));
    }
  }

  static void add_structure(Row& row, Lab const& lab) {
    auto const [contacts, number] = scarp::contact_network(lab.packing(), lab.law());
    row.insert(row.end(), {{"coordination", number.all},
                           {"mechanical_coordination", number.mechanical},
                           {"rattlers", number.rattlers},
                           {"contact_anisotropy", scarp::fabric_anisotropy(contacts)},
                           {"contact_direction", major_direction(contacts)}});
    if constexpr (PackingType::Shape::orientation_count == 2) {
      auto const grains = scarp::particle_fabric(lab.packing());
      row.emplace_back("particle_anisotropy", scarp::fabric_anisotropy(grains));
      row.emplace_back("particle_direction", major_direction(grains));
    }
  }

  void add_motion(Row& row, Lab const& lab) const {
    auto const motion = non_affine_motion(start_, lab.packing(), lab.deformation());
    double mean = 0.0;
    double square = 0.0;
    for (double const angle : rotation_) {
      mean += angle / static_cast<double>(rotation_.size());
      square += angle * angle / static_cast<double>(rotation_.size());
    }
    row.insert(row.end(), {{"non_affine_motion", root_mean_square<2>(motion) / radius_},
                           {"grain_rotation", mean},
                           {"grain_rotation_rms", std::sqrt(square)}});
  }

  PackingType start_;
  double radius_;                 ///< of discs of the grains' areas, mean [m]
  std::vector<double> rotation_;  ///< of each grain beyond the cell's own [rad]
  examples::EnergyLedger<2> ledger_;
  Tensor stress_sum_ = Tensor::Zero();
  long steps_in_row_ = 0;
};

}  // namespace rve_lab
