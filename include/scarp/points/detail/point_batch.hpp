// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <any>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <typeinfo>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/points/mirrored_state.hpp"
#include "scarp/points/step_doubling.hpp"

namespace scarp::detail {

/// Material points of one provider whose type nobody sees: parameters, committed and trial states, plans. Points have
/// numbers of their own here, beside those among all points.
template <int Dim>
class PointBatch {
 public:
  virtual ~PointBatch() = default;
  virtual std::unique_ptr<PointBatch> copy() const = 0;
  /// The same provider with one point only, at the same site and without state.
  virtual std::unique_ptr<PointBatch> alone(int k) const = 0;

  /// number: among all points; here: whether this process owns the point, else it has no state
  /// \return number of the point here
  virtual int add(Site<Dim> const& site, int number, bool here) = 0;
  virtual void release(int k) = 0;

  virtual void plan(int k, Gradient<Dim> const& increment) = 0;
  /// \return whether the point has a plan of more work now
  virtual bool refine(int k) = 0;
  virtual long work(int k) const = 0;
  virtual bool has_exact_tangent() const = 0;
  /// Whether the points are to respond in one call, since many take the time of one.
  virtual bool takes_many() const = 0;
  /// Points that need more than `plan_slack` times the planned work plan it anew. increments and responses: of all
  /// points by their numbers among these
  virtual void respond(std::span<int const> own, std::vector<Gradient<Dim>> const& increments,
                       std::vector<Response<Dim>>& responses) = 0;
  virtual VoigtStress<Dim> stress(int k) const = 0;
  virtual VoigtTangent<Dim> tangent(int k) const = 0;
  virtual VoigtTangent<Dim> trial_tangent(int k) const = 0;
  virtual VoigtTangent<Dim> initial_tangent(int k) const = 0;
  virtual void commit() = 0;

  virtual void write(int k, StateWriter& writer) const = 0;
  /// A state of the point, for `put`.
  virtual std::any read(int k, StateReader& reader) const = 0;
  virtual void put(int k, std::any state) = 0;
  /// A state of point `from` of another batch, for `put` to point k; mirrored where there is a mirror. \throws
  /// InputError unless it has the same type of provider
  virtual std::any state_from(int k, PointBatch const& other, int from,
                              std::optional<Mirror<Dim>> const& mirror) const = 0;

  /// What a committed state shows as a value of this type: a pointer to itself, quantities, balance or picture; else
  /// nothing.
  virtual std::any shown(int k, std::type_info const& type) const = 0;
  virtual VoigtStress<Dim> floor_stress(int k) const = 0;
  /// Right after a commit, with twice the work: from the state before it or, where there is a path, from the state in
  /// its bits.
  virtual DoubledResponse<Dim> doubled(int k, Gradient<Dim> const& increment, std::string* path) const = 0;
};

}  // namespace scarp::detail
