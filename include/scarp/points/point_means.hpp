// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/linear_map.hpp"
#include "scarp/points/neighbour_mean.hpp"
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// Nonlocal length of a point, and the stress against the strain that its mean does not contain.
struct Neighbourhood {
  double length = 0.0;     ///< radius [m]; 0: the point is a local one
  double stiffness = 1.0;  ///< share of the point's initial tangent
  double fading = 1e-3;    ///< strain after which the stress against fluctuation strain has faded

  /// \throws InputError for numbers that are negative or not finite, and a fading strain of zero
  void validate() const {
    require_not_negative("length that increments are averaged over", length);
    require_not_negative("stiffness against fluctuation strain", stiffness);
    require_positive("strain after which fluctuation stress has faded", fading);
  }
};

/// What means add to the state of a point.
template <int Dim>
struct MeanState {
  VoigtStress<Dim> tau = VoigtStress<Dim>::Zero();  ///< stress against the strain that the mean does not contain [Pa]
  double volume = 1.0;                              ///< of the point, over its initial one
  SCARP_MEMBERS(tau, volume)
};

/// Tangents [Pa] of points whose stress follows from their own strain and from a mean around them.
template <int Dim>
struct SplitTangents {
  std::vector<VoigtTangent<Dim>> by_own;   ///< derivative by the point's own strain
  std::vector<VoigtTangent<Dim>> by_mean;  ///< derivative by the mean strain around the point
};

/// Points that see means of the increments around them instead of their own,
/// \f$ \bar G_i = \sum_j w_{ij} J_j G_j / \sum_j w_{ij} J_j \f$, with weights w of the reference configuration and
/// volumes J over the initial ones, and a stress that holds what they do not see:
/// \f$ \sigma_i = \sigma_{material}(\bar G_i) + \tau_i,\;
/// \Delta\tau = s\,C^0 (\Delta\varepsilon - \Delta\bar\varepsilon) - \tau\,|\Delta\bar\varepsilon| / \varepsilon_f \f$
/// (implicit, turned with the mean's rotation). Without tau waves much shorter than the length cost nothing, and bands
/// become as thin as the mesh: strain \f$ \varepsilon = W^{-1} \bar\varepsilon \f$ belongs to any
/// \f$ \bar\varepsilon \f$. A local share of what the material sees would not help, since it softens as well. With s =
/// 1 a uniform elastic body responds as a local one; a tau that did not fade would lock bands, whose strain is never
/// that of its mean. Neighbours fluctuate in volume; with initial volumes as weights the volume of all would grow by
/// more than the materials dilate, since the mean of J is larger than the exponential of the mean of log J.
template <int Dim>
class PointMeans {
 public:
  using Gradients = std::vector<Gradient<Dim>>;     ///< one for each point
  using Stresses = std::vector<VoigtStress<Dim>>;   ///< one for each point [Pa]
  using Tangents = std::vector<VoigtTangent<Dim>>;  ///< one for each point [Pa]

  /// neighbourhoods, and tangents [Pa] of the states that the points begin with: of all points; iteration: solves
  /// linear systems of stiffnesses that are not assembled
  /// \throws InputError for numbers that no neighbourhood can have, and counts that differ
  PointMeans(NeighbourMean mean, std::span<Neighbourhood const> neighbourhoods, Tangents const& initial,
             LinearIteration iteration)
      : mean_(std::move(mean)),
        iterate_(iteration),
        tau_(neighbourhoods.size(), VoigtStress<Dim>::Zero()),
        trial_(tau_),
        volume_(neighbourhoods.size(), 1.0),
        trial_volume_(volume_),
        by_own_(neighbourhoods.size(), VoigtTangent<Dim>::Zero()),
        by_mean_(by_own_) {
    if (detail::index(mean_.size()) != neighbourhoods.size() || initial.size() != neighbourhoods.size()) {
      reject("{} neighbourhoods and {} initial tangents are given for {} points: give one of each to every point",
             neighbourhoods.size(), initial.size(), mean_.size());
    }
    for (std::size_t k = 0; k < initial.size(); ++k) {
      fading_.push_back(detail::validated(neighbourhoods[k]).fading);
      stiffness_.push_back(neighbourhoods[k].stiffness * initial[k]);
    }
  }

  NeighbourMean const& mean() const { return mean_; }   ///< Neighbours and weights in the reference configuration.
  LinearIteration iterate() const { return iterate_; }  ///< Solver for stiffnesses that are not assembled.

  /// Means of the values of all points, with the volumes after the last commit.
  template <class Value>
  std::vector<Value> means(std::vector<Value> const& values, Executor const& executor) const {
    return mean_.means(values, volume_, executor);
  }

  /// What the points see of their own gradients; tau belongs to it from then on.
  Gradients average(Gradients const& own, Executor const& executor) {
    Gradients mean = means(own, executor);
    for (std::size_t k = 0; k < own.size(); ++k) {
      trial_volume_[k] = volume_[k] * (Tensor<Dim>::Identity() + own[k]).determinant();
      if (mean_.of(static_cast<int>(k)).size() > 1) update_tau(k, mean[k], own[k] - mean[k]);
    }
    return mean;
  }

  /// tau [Pa] of all points in the last increment that was averaged.
  Stresses const& added_stresses() const { return trial_; }

  /// Derivatives [Pa] of the points' whole stresses by their own strains and by the means that they see, in the last
  /// increment that was averaged; tangents: the materials' by what they see. A point alone has its own strain only.
  SplitTangents<Dim> split(Tangents tangents) const {
    SplitTangents<Dim> parts{std::move(tangents), Tangents(by_mean_.size(), VoigtTangent<Dim>::Zero())};
    for (std::size_t k = 0; k < by_mean_.size(); ++k) {
      if (mean_.of(static_cast<int>(k)).size() == 1) continue;
      parts.by_mean[k] = parts.by_own[k] + by_mean_[k];
      parts.by_own[k] = by_own_[k];
    }
    return parts;
  }

  /// Makes the trial states the committed ones.
  /// \throws InputError for a point that has no volume left, without any change
  void commit() {
    for (std::size_t k = 0; k < trial_volume_.size(); ++k) {
      if (!(trial_volume_[k] > 0.0))
        reject("point {} has {} of its initial volume (it is turned inside out): take a smaller step", k,
               trial_volume_[k]);
    }
    tau_ = trial_;
    volume_ = trial_volume_;
  }

  /// tau [Pa] of a point after the last commit.
  VoigtStress<Dim> const& committed_tau(int point) const { return tau_[detail::index(point)]; }
  /// What belongs to the state of a point after the last commit.
  MeanState<Dim> committed(int point) const { return {tau_[detail::index(point)], volume_[detail::index(point)]}; }
  /// Sets the committed and trial state of a point, as for one that is copied or loaded.
  void set_committed(int point, MeanState<Dim> const& state) {
    tau_[detail::index(point)] = trial_[detail::index(point)] = state.tau;
    volume_[detail::index(point)] = trial_volume_[detail::index(point)] = state.volume;
  }

  /// What tau depends on: neighbours, their weights and the stiffness against fluctuation strain, in numbers that
  /// distinguish them from others.
  /// \throws InputError when it reads those of other means
  template <class Self, class Visit>
  static void basis_members(Self& self, Visit&& visit) {
    auto const own = self.basis();
    auto saved = own;
    visit("basis", saved);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (!(std::abs(saved[k] - own[k]) <= 1e-9 * std::abs(own[k])))  // round-off of another compiler
        reject(
            "a saved state is of points that see other means, {} for {} (another mesh, length, stiffness or fading): "
            "resume with the saved ones",
            saved[k], own[k]);
    }
  }

 private:
  std::array<double, 4> basis() const {
    std::array<double, 4> sums{};
    for (int point = 0; point < mean_.size(); ++point) {
      for (auto const& [other, weight] : mean_.of(point)) {
        sums[0] += 1.0;
        sums[1] += weight * weight * (1.0 + other);
      }
      sums[2] += fading_[detail::index(point)];
      sums[3] += stiffness_[detail::index(point)].norm();
    }
    return sums;
  }

  /// tau of a point that sees one gradient and does not see another.
  void update_tau(std::size_t k, Gradient<Dim> const& mean, Gradient<Dim> const& fluctuation) {
    Tensor<Dim> const strain = (mean + mean.transpose()) / 2.0;
    double const size = strain.norm();
    double const faded = 1.0 + size / fading_[k];
    Tensor<Dim> const turn = rotation_factor<Dim, double>(Tensor<Dim>::Identity() + mean);
    VoigtStress<Dim> const whole = tau_[k] + stiffness_[k] * to_engineering_strain<Dim, double>(fluctuation);
    Tensor<Dim> const held = turned<Dim>(turn, from_voigt_stress<Dim, double>(whole)) / faded;
    trial_[k] = to_voigt_stress<Dim, double>(held);
    by_own_[k] = stiffness_[k] / faded;
    by_mean_[k] = -by_own_[k];
    if (size > 0.0) {
      by_mean_[k] -= trial_[k] * to_voigt_stress<Dim, double>(strain).transpose() / (size * fading_[k] * faded);
    }
  }

  NeighbourMean mean_;
  LinearIteration iterate_;
  std::vector<double> fading_;
  Tangents stiffness_;
  Stresses tau_;
  Stresses trial_;  ///< tau of the last increment
  std::vector<double> volume_;
  std::vector<double> trial_volume_;
  Tangents by_own_;
  Tangents by_mean_;
};

}  // namespace scarp
