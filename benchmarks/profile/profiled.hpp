// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <time.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <utility>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/index.hpp"
#include "scarp/tensor/principal.hpp"

namespace profile {

/// CPU time of this thread [ns].
inline long thread_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1'000'000'000L * now.tv_sec + now.tv_nsec;
}

/// Which bound decided the number of DEM steps of a response.
enum class Reason { least, strain, inertia, refined, count };
inline constexpr std::array reason_names{"least number", "strain of a step", "inertial number", "asked again, slower"};

/// Count and time of responses of one kind, or of tangents; several threads add to it.
struct Tally {
  std::atomic<long> calls{0};
  std::atomic<long> dem_steps{0};
  std::atomic<long> nanoseconds{0};

  void add(long steps, long spent) {
    calls.fetch_add(1, std::memory_order_relaxed);
    dem_steps.fetch_add(steps, std::memory_order_relaxed);
    nanoseconds.fetch_add(spent, std::memory_order_relaxed);
  }
};

/// Where and for what the points' time goes.
struct Tallies {
  static constexpr int depths = 5;   ///< equal parts of the layer, from the surface down
  static constexpr int strains = 3;  ///< so far: below 0.5 %, below 5 %, more

  double depth = 25.0;  ///< of the layer [m]
  std::array<std::array<Tally, depths>, strains> by_place{};
  std::array<Tally, static_cast<std::size_t>(Reason::count)> by_reason{};
  std::array<Tally, 4> by_status{};  ///< in the order of scarp::Status
  Tally tangents{};

  Tally& at(double z, double strain) {
    auto const row = static_cast<std::size_t>(strain < 0.005 ? 0 : strain < 0.05 ? 1 : 2);
    return by_place[row][scarp::detail::index(std::clamp(static_cast<int>(z / depth * depths), 0, depths - 1))];
  }
};

/// Packings whose responses and tangents are counted and timed.
/// Packings: a DemRve
template <scarp::CheckedProvider Packings>
struct Profiled {
  static constexpr int dim = Packings::dim;

  struct Plan {
    scarp::PlanOf<Packings> own{};
    Reason reason = Reason::least;

    explicit operator long() const { return static_cast<long>(own); }
  };

  struct State {
    typename Packings::State own;
    double depth = 0.0;   ///< [m]
    double strain = 0.0;  ///< largest principal ones of all increments, added up

    SCARP_MEMBERS(own, depth, strain)
  };

  Packings provider{};
  std::shared_ptr<Tallies> tallies = std::make_shared<Tallies>();

  State initial_state(scarp::Site<dim> const& site) const { return {provider.initial_state(site), site.depth}; }
  State empty_state(scarp::Site<dim> const& site) const { return {scarp::empty_state(provider, site), site.depth}; }
  scarp::VoigtStress<dim> stress(State const& state) const { return provider.stress(state.own); }

  scarp::VoigtTangent<dim> tangent(State const& state) const {
    long const start = thread_nanoseconds();
    auto const found = provider.tangent(state.own);
    tallies->tangents.add(0, thread_nanoseconds() - start);
    return found;
  }

  Plan plan(State const& committed, scarp::Gradient<dim> const& increment) const {
    auto const own = provider.plan(committed.own, increment);
    if (own <= provider.min_steps) return {own, Reason::least};
    // The number is rounded up from what the inertial number requires, where that decides.
    bool const is_slow = provider.inertial_number_of(committed.own, increment, own - 1) >= provider.inertial_number;
    return {own, is_slow ? Reason::inertia : Reason::strain};
  }
  Plan refined(Plan const& plan) const { return {provider.refined(plan.own), Reason::refined}; }

  scarp::Response<dim> respond(State const& committed, scarp::Gradient<dim> const& increment, State& trial) const {
    return respond(committed, increment, trial, plan(committed, increment));
  }
  scarp::Response<dim> respond(State const& committed, scarp::Gradient<dim> const& increment, State& trial,
                               Plan const& plan) const {
    long const start = thread_nanoseconds();
    auto const response = provider.respond(committed.own, increment, trial.own, plan.own);
    long const spent = thread_nanoseconds() - start;
    trial.depth = committed.depth;
    trial.strain = committed.strain + scarp::largest_principal<dim>((increment + increment.transpose()) / 2.0);
    long const steps = static_cast<long>(plan);
    tallies->at(committed.depth, committed.strain).add(steps, spent);
    tallies->by_reason[static_cast<std::size_t>(plan.reason)].add(steps, spent);
    tallies->by_status[static_cast<std::size_t>(response.verdict.status)].add(steps, spent);
    return response;
  }
};

}  // namespace profile
