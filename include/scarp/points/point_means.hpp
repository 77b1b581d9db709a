// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/linear_map.hpp"
#include "scarp/points/neighbour_mean.hpp"
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

/// Points that see means of the increments around them instead of their own, see NonlocalMeans.
template <int Dim>
class PointMeans {
 public:
  using Gradients = std::vector<Gradient<Dim>>;     ///< one for each point
  using Stresses = std::vector<VoigtStress<Dim>>;   ///< one for each point [Pa]
  using Tangents = std::vector<VoigtTangent<Dim>>;  ///< one for each point [Pa]

  virtual ~PointMeans() = default;
  virtual std::unique_ptr<PointMeans> copy() const = 0;  ///< With the same states.
  NeighbourMean const& mean() const { return mean_; }    ///< Neighbours and weights in the reference configuration.
  LinearIteration iterate() const { return iterate_; }   ///< Solver for stiffnesses that are not assembled.

  /// What the points see of their own gradients; tau belongs to it from then on.
  virtual Gradients average(Gradients const& own, Executor const& executor) = 0;
  /// tau [Pa] of all points in the last increment that was averaged.
  virtual Stresses const& added_stresses() const = 0;
  /// Derivatives [Pa] of the points' whole stresses by their own strains and by the means that they see, in the last
  /// increment that was averaged; tangents: the materials' by what they see. A point alone has its own strain only.
  virtual SplitTangents<Dim> split(Tangents tangents) const = 0;
  /// Forces [N] by the means of strains: of_nodes gives the points' engineering strains by displacements [m], of_points
  /// forces by stresses times volume [N m]; tangents: by_mean times volume [N m]. Refers to these means.
  virtual LinearMap forces_around(LinearMap of_nodes, LinearMap of_points, Tangents tangents,
                                  Executor const& executor) const = 0;
  /// Makes the trial states the committed ones.
  /// \throws InputError for a point that has no volume left, without any change
  virtual void commit() = 0;

  /// What belongs to the state of a point after the last commit.
  virtual MeanState<Dim> committed(int point) const = 0;
  /// Sets the committed and trial state of a point, as for one that is copied or loaded.
  virtual void set_committed(int point, MeanState<Dim> const& state) = 0;

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

 protected:
  /// iteration: solves linear systems of stiffnesses that are not assembled
  PointMeans(NeighbourMean mean, LinearIteration iteration) : mean_(std::move(mean)), iterate_(iteration) {}
  virtual std::array<double, 4> basis() const = 0;  ///< Numbers that distinguish these means from others.

  NeighbourMean mean_;       ///< neighbours and weights
  LinearIteration iterate_;  ///< solver
};

namespace detail {
/// Means, or none; a copy holds its own.
template <int Dim>
class HeldMeans : public std::unique_ptr<PointMeans<Dim>> {
  using Base = std::unique_ptr<PointMeans<Dim>>;

 public:
  HeldMeans() = default;
  HeldMeans(Base means) : Base(std::move(means)) {}  // NOLINT: means are held ones
  HeldMeans(HeldMeans const& other) : Base(other ? other->copy() : nullptr) {}
  HeldMeans(HeldMeans&&) noexcept = default;
  HeldMeans& operator=(HeldMeans other) noexcept {
    this->swap(other);
    return *this;
  }
  ~HeldMeans() = default;
};
}  // namespace detail

}  // namespace scarp
