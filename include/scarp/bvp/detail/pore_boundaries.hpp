// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/bvp/load_history.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp::detail {

/// Where the pressure of a field of corners is given and where water flows in; everywhere else the boundary is
/// impermeable.
class PoreBoundaries {
 public:
  using Values = Eigen::VectorXd;

  explicit PoreBoundaries(int corners) : given_(index(corners)), is_bare_(given_.size(), 0) { number_unknowns(); }

  /// \throws InputError for a corner whose pressure is given already, and differently, and for all corners of an
  /// inflow; describe(corner): it in words
  template <class Describe>
  void prescribe(std::vector<int> const& corners, double pressure, TimeFunction const& amplitude,
                 Describe const& describe) {
    Course const course{pressure, amplitude};
    for (int const corner : corners) {  // a rejected call changes nothing
      auto const& known = given_[index(corner)];
      if (pressure != 0.0) require_water(corner, describe);
      if (known && !is_bare_[index(corner)] && !(*known == course))
        reject("the pore pressure of {} is given twice (as {} and {} Pa, or with two amplitudes): decide for one",
               describe(corner), known->pressure, pressure);
    }
    auto all = *this;
    for (int const corner : corners) all.given_[index(corner)] = course;
    for (auto const& [rates, course_of_rates] : all.inflows_) all.require_effect(rates, describe);
    *this = std::move(all);
    number_unknowns();
  }
  /// rates [m3/s]: of all corners. \throws InputError for a corner that no water is around, and where all have a
  /// pressure
  template <class Describe>
  void let_in(Values rates, TimeFunction const& amplitude, Describe const& describe) {
    for (Eigen::Index k = 0; k < rates.size(); ++k)
      if (rates(k) != 0.0) require_water(static_cast<int>(k), describe);
    require_effect(rates, describe);
    inflows_.emplace_back(std::move(rates), amplitude);
  }
  /// Corners that no water is around any more have no pressure.
  /// \throws InputError for those where a pressure or an inflow is given
  template <class Describe>
  void take_out(std::vector<int> const& corners, Describe const& describe) {
    auto all = *this;  // a rejected call changes nothing
    for (int const corner : corners) {
      auto const k = index(corner);
      all.is_bare_[k] = 1;
      if (given_[k] && given_[k]->pressure != 0.0) all.require_water(corner, describe);
      for (auto const& [rates, amplitude] : inflows_)
        if (rates(corner) != 0.0) all.require_water(corner, describe);
      if (!given_[k]) all.given_[k] = Course{0.0, TimeFunction::constant(1.0)};
    }
    *this = std::move(all);
    number_unknowns();
  }

  std::vector<int> const& unknowns() const { return unknowns_; }  ///< Corners whose pressure is not given.
  bool is_given(int corner) const { return given_[index(corner)].has_value(); }
  /// Among the unknowns, of a corner whose pressure is not given.
  int number(int corner) const { return number_[index(corner)]; }
  /// Over the corners whose pressure is given.
  double sum_of_given(std::vector<double> const& values) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += given_[k] ? values[k] : 0.0;
    return sum;
  }
  /// Whether water flows through boundaries of a ground whose pressure nothing sets.
  bool lacks_outlet() const {
    auto const bare = static_cast<std::size_t>(std::ranges::count(is_bare_, 1));
    return !inflows_.empty() && unknowns_.size() + bare == given_.size();
  }

  /// Pressures [Pa] of all corners at a load factor, 0 where they are unknown.
  Values pressures(double load) const {
    Values all = Values::Zero(static_cast<Eigen::Index>(given_.size()));
    for (std::size_t k = 0; k < given_.size(); ++k)
      if (given_[k]) all(static_cast<Eigen::Index>(k)) = given_[k]->pressure * given_[k]->amplitude(load);
    return all;
  }
  /// Inflow [m3/s] of all corners at a load factor.
  Values inflow(double load) const {
    Values all = Values::Zero(static_cast<Eigen::Index>(given_.size()));
    for (auto const& [rates, amplitude] : inflows_) all += amplitude(load) * rates;
    return all;
  }
  /// First load factor beyond one where these may turn; infinite beyond the last.
  double next_knot(double load) const {
    double next = std::numeric_limits<double>::infinity();
    for (auto const& [rates, amplitude] : inflows_) next = std::min(next, amplitude.next_knot(load));
    for (auto const& course : given_)
      if (course && course->pressure != 0.0) next = std::min(next, course->amplitude.next_knot(load));
    return next;
  }

 private:
  struct Course {
    double pressure = 0.0;
    TimeFunction amplitude{};
    friend bool operator==(Course const&, Course const&) = default;
  };

  /// \throws InputError for a corner that no element with water has
  template <class Describe>
  void require_water(int corner, Describe const& describe) const {
    if (is_bare_[index(corner)] != 0)
      reject("a pore pressure or an inflow is given at {} (no water is around it): name boundaries of wet ground only",
             describe(corner));
  }
  /// \throws InputError for rates that flow in at corners of given pressure only, which decides what flows there
  template <class Describe>
  void require_effect(Values const& rates, Describe const& describe) const {
    int last = -1;
    for (Eigen::Index k = 0; k < rates.size(); ++k) {
      if (rates(k) == 0.0) continue;
      last = static_cast<int>(k);
      if (!is_given(last) || is_bare_[index(last)] != 0) return;
    }
    if (last >= 0)
      reject("an inflow has no effect (the pressure of all its corners is given, as of {}): leave one of the two out",
             describe(last));
  }
  void number_unknowns() {
    unknowns_.clear();
    number_.resize(given_.size());
    for (std::size_t k = 0; k < given_.size(); ++k) {
      number_[k] = count(unknowns_);
      if (!given_[k]) unknowns_.push_back(static_cast<int>(k));
    }
  }

  std::vector<std::optional<Course>> given_;
  std::vector<char> is_bare_;  ///< whether no element with water has the corner
  std::vector<std::pair<Values, TimeFunction>> inflows_;
  std::vector<int> unknowns_;
  std::vector<int> number_;  ///< of each corner among them
};

}  // namespace scarp::detail
