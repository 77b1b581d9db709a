// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "../shared/print.hpp"
#include "paths.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/homogenise/balance.hpp"

namespace rve_lab {

/// Deepest overlap over the smallest contact radius of the packing.
template <class PackingType>
double deepest_overlap(PackingType const& packing, typename PackingType::Law const& law) {
  double deepest = 0.0;
  scarp::for_each_contact(packing, law,
                          [&](auto const& contact) { deepest = std::max(deepest, contact.touch.overlap); });
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    smallest = std::min(smallest, PackingType::Shape::contact_radius(scarp::row_pose(packing, i)));
  }
  return deepest / smallest;
}

/// A packing on its way along a path. Its list of pairs is renewed at once when it gets old, so that the contacts can
/// be looked at after every step, and its deformation gradient is followed across changes of the cell's base vectors.
template <class PackingType, scarp::Observe what>
class Specimen {
 public:
  static constexpr int dim = PackingType::dim;
  using Law = typename PackingType::Law;
  using Tensor = scarp::Tensor<dim>;

  /// \throws InputError for a packing that cannot be listed, or a pressure to hold that no grains can carry
  Specimen(PackingType packing, Law const& law, PathKindIn<dim> const& path, double strain_step,
           std::optional<double> held)
      : packing_(std::move(packing)), law_(law) {
    inverse_start_ = packing_.cell.inverse();
    if (auto const verdict = renew(); !verdict.acceptable()) {
      scarp::reject("the packing cannot be tested ({}): check its cell, at least two diameters wide, and its positions",
                    scarp::name(verdict.reason));
    }
    if (path.held != nullptr) {
      double const present = path.held(scarp::balance(packing_, law).stress);
      pressure_ = held.value_or(present);
      if (!(std::isfinite(pressure_) && pressure_ > 0.0)) {
        scarp::reject("a pressure of {} Pa is to be held (grains carry compression only): give a positive one",
                      pressure_);
      }
      consolidate(present);
    }
    drive_.emplace(packing_, law_, path.loading(strain_step, pressure_));
  }
  Specimen(Specimen const&) = delete;
  Specimen& operator=(Specimen const&) = delete;

  scarp::Verdict step() {
    if (auto const verdict = drive_->step(stepper_); !verdict.acceptable()) return verdict;
    if (drive_->seen().deepest_overlap > deepest) return {scarp::Status::failed, scarp::Reason::too_deep};
    time_step_ = stepper_.time_step_share * packing_.pairs.critical_step;
    deformation_ = packing_.cell * inverse_start_;
    return renew();
  }

  /// What the path holds [Pa], zero where it holds nothing.
  double pressure() const { return pressure_; }

  void reverse() { drive_->load(drive_->loading().reversed()); }

  PackingType const& packing() const { return packing_; }
  Law const& law() const { return law_; }
  auto const& seen() const { return drive_->seen(); }
  Tensor const& strain_step() const { return drive_->strain_step(); }
  Tensor const& deformation() const { return deformation_; }
  /// [s], of the last step
  double time_step() const { return time_step_; }

 private:
  static constexpr double deepest = 1.0;  ///< over the reduced radius of a contact: half the radius of equal discs

  /// Brings a packing to the pressure that its path holds, before the path begins: the normal stresses in the
  /// proportion that they have, no shear strain.
  /// present: the pressure that it has [Pa]
  /// \throws InputError for a pressure that it does not come to
  void consolidate(double present) {
    constexpr double slight = 1e-3;  // what the first steps of a path even out
    if (std::abs(pressure_ - present) <= slight * pressure_) return;
    Tensor const stress = scarp::balance(packing_, law_).stress;
    scarp::Loading<dim> loading;
    for (int axis = 0; axis < dim; ++axis) {
      double const share = present > 0.0 ? stress(axis, axis) / -present : 1.0;
      loading.controls.push_back(scarp::component_control<dim>(axis, -pressure_ * (share > 0.0 ? share : 1.0)));
    }
    double const before = packing_.void_ratio();
    auto verdict = scarp::Servo{}.reach(stepper_, packing_, law_, loading);
    if (auto const stopped = stepper_.stop(packing_, law_); verdict.acceptable()) verdict = stopped;
    if (verdict.acceptable() && deepest_overlap(packing_, law_) > deepest)
      verdict = {scarp::Status::failed, scarp::Reason::too_deep};
    if (!verdict.acceptable()) {
      scarp::reject(
          "the packing does not come from {:.6g} Pa to the {:.6g} Pa that its path holds ({}): choose another stress",
          present, pressure_, scarp::name(verdict.reason));
    }
    examples::print(stdout, "brought from {:.6g} to {:.6g} Pa before the path: void ratio {:.8f}, {:.8f} before\n",
                    present, pressure_, packing_.void_ratio(), before);
    inverse_start_ = packing_.cell.inverse();
    if (verdict = renew(); !verdict.acceptable())
      scarp::reject("the packing cannot be tested ({}): take a larger one", scarp::name(verdict.reason));
  }

  scarp::Verdict renew() {
    Tensor const before = packing_.cell;
    auto const verdict = stepper_.refresh(packing_, law_);
    if (packing_.cell != before) inverse_start_ = packing_.cell.inverse() * deformation_;
    return verdict;
  }

  PackingType packing_;
  Law law_;
  scarp::TimeStepper<PackingType> stepper_;
  std::optional<scarp::CellDriver<PackingType, what>> drive_;
  Tensor inverse_start_;  ///< of the cell at the start, in the present base vectors
  Tensor deformation_ = Tensor::Identity();
  double time_step_ = 0.0;
  double pressure_ = 0.0;
};

/// \throws std::runtime_error always: the path came to an end at a strain
[[noreturn]] inline void end_early(scarp::Verdict const& verdict, double strain, std::string const& file) {
  throw std::runtime_error(
      fmt::format("the packing ended with {} ({}) beyond strain {:.6g}; the rows so far are in '{}': take smaller "
                  "steps, or check the stress to hold",
                  scarp::name(verdict.status), scarp::name(verdict.reason), strain, file));
}

/// \throws std::runtime_error for a specimen that has not got the stress which its path holds
template <class Lab>
void require_held(Lab const& lab, PathKind const& path) {
  constexpr double most = 0.1;  // what steps of an ordinary size are off
  double const found = path.held(scarp::balance(lab.packing(), lab.law()).stress);
  if (std::abs(found - lab.pressure()) <= most * lab.pressure()) return;
  throw std::runtime_error(
      fmt::format("the path ended at {:.4g} Pa where {:.4g} Pa were to be held: take smaller steps, or another stress",
                  found, lab.pressure()));
}

}  // namespace rve_lab
