// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "paths.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/homogenise/balance.hpp"

namespace rve_lab {

/// A packing on its way along a path. Its list of pairs is renewed at once when it gets old, so that the contacts can
/// be looked at after every step, and its deformation gradient is followed across changes of the cell's base vectors.
template <class PackingType, scarp::Observe what>
class Specimen {
 public:
  using Law = typename PackingType::Law;

  /// \throws InputError for a packing that cannot be listed, or a pressure to hold that no grains can carry
  Specimen(PackingType packing, Law const& law, PathKind const& path, double strain_step, std::optional<double> held)
      : packing_(std::move(packing)), law_(law) {
    inverse_start_ = packing_.cell.inverse();
    if (auto const verdict = renew(); !verdict.acceptable()) {
      scarp::refuse("the packing cannot be tested ({}): check its cell, at least two diameters wide, and its positions",
                    scarp::name(verdict.reason));
    }
    double const pressure = path.held == nullptr ? 0.0 : held.value_or(path.held(scarp::balance(packing_, law).stress));
    if (path.held != nullptr) {
      if (!(std::isfinite(pressure) && pressure > 0.0)) {
        scarp::refuse("a pressure of {} Pa is to be held (grains carry compression only): give a positive one",
                      pressure);
      }
    }
    drive_.emplace(packing_, law_, path.loading(strain_step, pressure));
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

  scarp::Verdict renew() {
    Tensor const before = packing_.cell;
    auto const verdict = stepper_.refresh(packing_, law_);
    if (packing_.cell != before) inverse_start_ = packing_.cell.inverse() * deformation_;
    return verdict;
  }

  PackingType packing_;
  Law law_;
  scarp::TimeStepper<PackingType> stepper_;
  std::optional<scarp::Drive<PackingType, what>> drive_;
  Tensor inverse_start_;  ///< of the cell at the start, in the present base vectors
  Tensor deformation_ = Tensor::Identity();
  double time_step_ = 0.0;
};

/// \throws InputError always: the path came to an end at a strain
[[noreturn]] inline void refuse_verdict(scarp::Verdict const& verdict, double strain, std::string const& file) {
  scarp::refuse(
      "the packing ended with {} ({}) beyond strain {:.6g}; the rows so far are in '{}': take smaller steps, or "
      "check the stress to hold",
      scarp::name(verdict.status), scarp::name(verdict.reason), strain, file);
}

/// Deepest overlap over the smallest contact radius of the packing.
template <class PackingType>
double deepest_overlap(PackingType const& packing, typename PackingType::Law const& law) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    smallest = std::min(smallest, PackingType::Shape::contact_radius(scarp::row_pose(packing, i)));
  }
  return scarp::balance(packing, law).deepest_overlap / smallest;
}

}  // namespace rve_lab
