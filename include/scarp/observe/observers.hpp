// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/named_member.hpp"
#include "scarp/solver/step_report.hpp"

SCARP_NAMED_MEMBER(ended)

namespace scarp {

/// Several observers as one; each is called at every attempt, any may stop the run.
/// \tparam Parts each an `ObservesSteps`; one that lives elsewhere, for a program that reads it when the run has ended,
/// is given by `std::ref` and outlives the run
template <class... Parts>
struct Observers {
  static_assert(!((requires { typename std::unwrap_reference_t<Parts>::WatchesAll; }) || ...),
                "scarp: a CheckpointedRun watches all other observers: give it to the run itself");

  boost::hana::tuple<Parts...> parts;  ///< in the order in which they are called

  explicit Observers(Parts... each) : parts(std::move(each)...) {}  ///< Takes the observers over.

  /// Passes an attempt on to each observer.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    boost::hana::for_each(parts, [&](auto& part) { own(part).attempted(problem, report); });
  }

  /// Calls ended(problem, load) of those parts that have it, where a run has stopped.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    boost::hana::for_each(parts, [&](auto& part) {
      constexpr bool has_one = requires { own(part).ended(problem, load); };
      static_assert(has_one || !detail::names_ended<std::remove_cvref_t<decltype(own(part))>>,
                    "scarp: ended of an observer is never called: it needs "
                    "`void ended(Problem const& problem, double load)`");
      if constexpr (has_one) own(part).ended(problem, load);
    });
  }

  /// Whether at least one observer stops the run.
  bool wants_stop() const {
    bool stop = false;
    boost::hana::for_each(parts, [&](auto const& part) { stop = stop || own(part).wants_stop(); });
    return stop;
  }

  /// The parts with a state; each that is not empty has to name its members.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    boost::hana::for_each(self.parts, [&](auto& part) {
      using Part = std::remove_cvref_t<decltype(own(part))>;
      static_assert(Described<Part> || std::is_empty_v<Part>,
                    "scarp: an observer of a run that is saved names its members: SCARP_MEMBERS(rows), or "
                    "SCARP_MEMBERS_EXCEPT((path)) where a resumed run sets them itself");
      if constexpr (Described<Part>) visit("observer", own(part));
    });
  }

 private:
  /// A part, or the observer that it refers to.
  template <class Part>
  static auto& own(Part& part) {
    if constexpr (std::is_same_v<std::unwrap_reference_t<std::remove_const_t<Part>>, std::remove_const_t<Part>>) {
      return part;
    } else {
      return part.get();
    }
  }
};

/// How tables and messages express the load: divided by a unit, under a name. Smaller ones than the least count as it.
struct LoadMeasure {
  double unit = 1.0;                                        ///< load factor that counts as one
  std::string name = "load";                                ///< in headers of tables and messages
  double least = -std::numeric_limits<double>::infinity();  ///< load factor

  /// \throws InputError for a unit that is not positive
  void validate() const { require_positive("unit of the load", unit); }
  double of(double load) const { return std::max(load, least) / unit; }  ///< Load in units of the measure.
};

/// When a series writes: at load 0, whenever the load has passed a further multiple of to / count, and at the end.
struct LoadSchedule {
  double to = 0.0;     ///< load factor at the end
  int count = 0;       ///< states that are written after that of load 0
  double unit = 1.0;   ///< of loads in tables
  double next = 0.0;   ///< load factor from which the next state is written
  double last = -1.0;  ///< load that was written last

  /// \throws InputError for an end, a number or a unit that is not positive
  void validate() const {
    require_positive("end of the load", to);
    require_at_least("number of files or profiles up to the end of the load", count, 1);
    require_positive("unit of the load", unit);
  }

  /// Whether a state at this load is written; true once for each.
  /// \throws InputError for a load below one that was written
  bool takes(double load) {
    if (last >= 0.0 && load < last)
      reject("what is recorded reaches the load {} and the run is at {} (it is another run): record each on its own",
             last, load);
    constexpr double round_off = 1e-9;  // of loads that are sums of steps
    bool const reaches_end = load >= to && last < to;
    if (!(load > last) || (load < next && !reaches_end)) return false;
    next = to / count * (std::floor(load / to * count + round_off) + 1.0 - round_off);
    last = load;
    return true;
  }

  /// Whether the last state of a run is to be written that stopped between two of them after the fault has moved.
  bool takes_end(double load) {
    if (!(load > 0.0 && load > last)) return false;
    last = load;
    return true;
  }

  SCARP_MEMBERS_EXCEPT((to, count, unit), next, last)
};

namespace detail {
/// \throws InputError for a point that a problem does not have
template <class Problem>
int require_point(Problem const& problem, int point) {
  int const count = problem.points().size();
  if (point < 0 || point >= count)
    reject("point {} is to be observed (there are points 0 to {}): choose one of these", point, count - 1);
  return point;
}
}  // namespace detail

/// Observer behaviour of one that never stops a run.
struct NeverStops {
  static bool wants_stop() { return false; }  ///< Never stops a run.
};

}  // namespace scarp
