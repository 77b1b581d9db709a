// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Operations of a vector that has dot() and the operators of its kind, as Eigen's have.
struct OwnVectorOperations {
  /// Inner product of two vectors of equal length.
  template <class Vector>
  double dot(Vector const& first, Vector const& second) const {
    return first.dot(second);
  }
  /// to += factor * vector
  template <class Vector>
  void add(double factor, Vector const& vector, Vector& to) const {
    to += factor * vector;
  }
};

/// Anderson acceleration of a fixed-point iteration x <- x + d(x), for the solver of a program that calls providers:
/// the next iterate minimises the combination of the last corrections in the least-squares sense (Anderson 1965; Walker
/// and Ni 2011, SIAM J. Numer. Anal. 49). The least squares are solved by Gram and Schmidt's orthogonalisation, newest
/// change first; a change that repeats newer ones is left out.
/// Vector: its copies are independent. Operations: double dot(Vector, Vector), over all processes where a vector is
/// shared out among them, and void add(double factor, Vector, Vector& to). All processes must call next() and forget()
/// alike.
/// \code
/// struct OfPetsc {  // deal.II's PETScWrappers::MPI::Vector
///   double dot(Vector const& first, Vector const& second) const { return first * second; }
///   void add(double factor, Vector const& vector, Vector& to) const { to.add(factor, vector); }
/// };
/// scarp::AndersonMixing<Vector, OfPetsc> mixing(8);
/// \endcode
template <class Vector, class Operations = OwnVectorOperations>
class AndersonMixing {
 public:
  /// depth: number of earlier iterates that are combined; 0 is the plain iteration \throws InputError for a negative
  /// one
  explicit AndersonMixing(int depth = 6, Operations operations = {})
      : depth_(require_at_least("depth of Anderson's mixing", depth, 0)), operations_(std::move(operations)) {}

  /// A new iteration begins.
  void forget() { history_.clear(); }

  /// Next iterate from the present one and its correction, same shape.
  Vector next(Vector const& point, Vector const& correction) {
    history_.push_front({point, correction});
    while (detail::count(history_) > depth_ + 1) history_.pop_back();
    Vector iterate = point;
    operations_.add(1.0, correction, iterate);
    Vector left = correction;  // of the correction, at right angles to the changes so far
    std::vector<Change> changes;
    for (std::size_t k = 1; k < history_.size(); ++k) {
      Change change = between(history_[k], history_[k - 1]);
      double const whole = operations_.dot(change.correction, change.correction);
      for (int pass = 0; pass < 2; ++pass) {  // the second removes the round-off of the first
        for (auto const& newer : changes) {
          double const share = operations_.dot(newer.correction, change.correction) / newer.squared;
          operations_.add(-share, newer.correction, change.correction);
          operations_.add(-share, newer.motion, change.motion);
        }
      }
      change.squared = operations_.dot(change.correction, change.correction);
      if (!(change.squared > repeated * repeated * whole)) continue;
      double const share = operations_.dot(change.correction, left) / change.squared;
      operations_.add(-share, change.correction, left);
      operations_.add(-share, change.motion, iterate);
      changes.push_back(std::move(change));
    }
    return iterate;
  }

 private:
  static constexpr double repeated =
      1e-10;  ///< share of a change that newer ones do not hold, below which it is left out

  struct Iterate {
    Vector point;
    Vector correction;
  };
  struct Change {
    Vector motion;  ///< of point and correction together
    Vector correction;
    double squared = 0.0;  ///< size of the latter
  };

  Change between(Iterate const& before, Iterate const& after) const {
    Change change{after.point, after.correction};
    operations_.add(-1.0, before.point, change.motion);
    operations_.add(-1.0, before.correction, change.correction);
    operations_.add(1.0, change.correction, change.motion);
    return change;
  }

  int depth_;
  Operations operations_;
  std::deque<Iterate> history_;  ///< newest first
};

}  // namespace scarp
