// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <type_traits>
#include <utility>

#include "scarp/core/described.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

/// Several observers as one; each hears of every attempt, any may ask to stop.
template <class... Parts>
struct Observers {
  boost::hana::tuple<Parts...> parts;

  explicit Observers(Parts... each) : parts(std::move(each)...) {}

  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    boost::hana::for_each(parts, [&](auto& part) { part.attempted(problem, report); });
  }

  /// Tells those who want to know where a run has stopped.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    boost::hana::for_each(parts, [&](auto& part) {
      if constexpr (requires { part.ended(problem, load); }) part.ended(problem, load);
    });
  }

  bool wants_stop() const {
    bool stop = false;
    boost::hana::for_each(parts, [&](auto const& part) { stop = stop || part.wants_stop(); });
    return stop;
  }

  /// Those that remember something; all but empty ones have to say what.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    boost::hana::for_each(self.parts, [&](auto& part) {
      using Part = std::remove_cvref_t<decltype(part)>;
      static_assert(Described<Part> || std::is_empty_v<Part>,
                    "scarp: an observer of a run that is saved names its members: SCARP_MEMBERS(rows), or "
                    "SCARP_MEMBERS_EXCEPT((path)) where a run that goes on sets them itself");
      if constexpr (Described<Part>) visit("observer", part);
    });
  }
};

/// An observer that lives elsewhere, for a program that asks it when the run has ended.
template <class Observer>
struct Borrowed {
  Observer* observer;

  explicit Borrowed(Observer& lent) : observer(&lent) {}

  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    observer->attempted(problem, report);
  }
  bool wants_stop() const { return observer->wants_stop(); }

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) requires(Described<Observer> || std::is_empty_v<Observer>) {
    if constexpr (Described<Observer>) Observer::members(*self.observer, visit);
  }
};

/// Observer behaviour of one that never stops a run.
struct NeverStops {
  static bool wants_stop() { return false; }
};

}  // namespace scarp
