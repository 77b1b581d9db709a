// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <ctime>

#include "kernel_steps.hpp"

namespace scarp_benchmark {

/// The parts of scarp::pair_forces, one by one. The passes over blocks of pairs run over the whole list each;
/// responding and scattering work on the numbers of the first block, so that their data lie in the nearest cache as
/// they do in the library.
template <class PackingType>
class Parts {
 public:
  using Shape = typename PackingType::Shape;
  using Law = typename PackingType::Law;
  using Scalar = typename PackingType::Scalar;
  using Layout = scarp::RowLayout<Shape, Law>;
  using Block = scarp::detail::PairBlock<Shape, Law, Scalar>;
  static constexpr std::size_t width = scarp::lanes::Pack<Scalar>::size();

  Parts(PackingType packing, Law const& law) : packing_(std::move(packing)), law_(law) {
    forces();
    for_each_block(1, [&](std::size_t at, std::size_t) { block_.gather(scratch_.rows.data(), at); });
  }

  void forces() { scarp::pair_forces<scarp::Observe::nothing>(packing_, law_, scratch_); }

  [[gnu::flatten]] void fill_rows() {
    scarp::fill_grain_rows(packing_, scratch_.rows.data());
    scarp::fill_ghost_rows(packing_, scratch_.rows.data());
  }
  void clear_forces() { scratch_.forces.assign(nobody() * Layout::force_size + Layout::force_size, Scalar(0)); }
  [[gnu::flatten]] void gather() {
    for_each_block(all, [&](std::size_t at, std::size_t) { block_.gather(scratch_.rows.data(), at); });
  }
  [[gnu::flatten]] void respond() {
    scarp::detail::PairResponse<scarp::Observe::nothing, PackingType, Law> response(packing_, law_);
    if constexpr (Shape::warm_starts_normal) {
      std::size_t const pairs = packing_.pairs.count();
      for (std::size_t start = 0; start < pairs; start += Block::size)
        response.search(block_, (std::min(Block::size, pairs - start) + width - 1) / width * width, start);
    }
    for_each_block(all, [&](std::size_t at, std::size_t start) { response.respond(block_, at, start + at); });
  }
  [[gnu::flatten]] void scatter() {
    for_each_block(all, [&](std::size_t at, std::size_t) { block_.scatter(scratch_.forces.data(), at); });
  }
  void gather_ghosts() { scarp::gather_forces(packing_, scratch_.forces.data()); }

 private:
  static constexpr std::size_t all = static_cast<std::size_t>(-1);

  std::size_t nobody() const { return packing_.row_count() + packing_.pairs.ghost_owner.size(); }

  template <class Visit>
  void for_each_block(std::size_t max_blocks, Visit&& visit) {
    auto const& pairs = packing_.pairs;
    for (std::size_t start = 0; start < pairs.count() && start / Block::size < max_blocks; start += Block::size) {
      std::size_t const present = std::min(Block::size, pairs.count() - start);
      block_.name_pairs(pairs.first.data() + start, pairs.second.data() + start, present,
                        static_cast<std::int32_t>(nobody()));
      std::size_t const used = (present + width - 1) / width * width;
      for (std::size_t at = 0; at < used; at += width) visit(at, start);
    }
  }

  PackingType packing_;
  Law law_;
  scarp::PairScratch<Scalar> scratch_;
  Block block_{};
};

template <class PackingType>
void part(benchmark::State& state, int grains, void (Parts<PackingType>::*run_part)()) {
  auto const law = law_of_study<PackingType>();
  auto const& packing = sheared<PackingType>(grains);
  Parts<PackingType> parts(packing, law);
  for (auto _ : state) {
    (parts.*run_part)();
    benchmark::ClobberMemory();
  }
  count_pairs(state, packing.pairs.count(), contact_count(packing, law));
}

inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What a step takes beyond its forces, as the counter us_per_step: the quickest batch of 50 steps minus the quickest
/// of 50 calls of pair_forces.
template <class PackingType>
void integration(benchmark::State& state, int grains) {
  auto const law = law_of_study<PackingType>();
  PackingType packing = sheared<PackingType>(grains);
  scarp::TimeStepper<PackingType> stepper;
  scarp::PairScratch<typename PackingType::Scalar> scratch;
  SlowShear<PackingType::dim> shear;
  constexpr int batch = 50;
  double forces = std::numeric_limits<double>::infinity();
  double steps = forces;
  for (auto _ : state) {
    double const start = processor_seconds();
    for (int step = 0; step < batch; ++step) scarp::pair_forces<scarp::Observe::nothing>(packing, law, scratch);
    double const middle = processor_seconds();
    for (int step = 0; step < batch; ++step) static_cast<void>(stepper.step(packing, law, shear.next()));
    forces = std::min(forces, middle - start);
    steps = std::min(steps, processor_seconds() - middle);
  }
  state.counters["us_per_step"] = (steps - forces) * 1e6 / batch;
}

/// Steps that a list of pairs lasts at a strain per step: its skin over the mean growth of its drift.
template <class PackingType>
double steps_of_a_list(PackingType packing, typename PackingType::Law const& law, double strain_per_step) {
  scarp::TimeStepper<PackingType> stepper;
  SlowShear<PackingType::dim> shear(strain_per_step);
  int const steps = packing.grain_count() > 10'000 ? 400 : 4000;
  double drifted = 0.0;
  for (int step = 0; step < steps; ++step) {
    double const before = packing.pairs.drift;
    static_cast<void>(stepper.step(packing, law, shear.next()));
    drifted += packing.pairs.drift < before ? packing.pairs.drift : packing.pairs.drift - before;
  }
  return packing.pairs.skin * steps / drifted;
}

/// A new list of pairs and its critical step, shared out among the steps that the list lasts.
template <class PackingType>
void neighbour_search(benchmark::State& state, int grains) {
  using benchmark::Counter;
  auto const law = law_of_study<PackingType>();
  PackingType packing = sheared<PackingType>(grains);
  double const skin = packing.pairs.skin;
  double const steps_slow = steps_of_a_list(packing, law, 1e-6);
  double const steps_fast = steps_of_a_list(packing, law, 1e-5);
  for (auto _ : state) {
    if (!scarp::rebuild_pairs(packing, skin, scarp::interaction_range_of(law)).acceptable()) {
      state.SkipWithError("no list of pairs");
      break;
    }
    benchmark::DoNotOptimize(packing.pairs.critical_step = scarp::critical_step(packing, law));
  }
  auto const lists = static_cast<double>(state.iterations());
  state.counters["us_per_list"] = Counter(lists * 1e-6, seconds_each);
  state.counters["steps_at_1e-6"] = steps_slow;
  state.counters["steps_at_1e-5"] = steps_fast;
  state.counters["us_per_step_at_1e-6"] = Counter(lists * steps_slow * 1e-6, seconds_each);
  state.counters["us_per_step_at_1e-5"] = Counter(lists * steps_fast * 1e-6, seconds_each);
}

template <class PackingType>
void declare_shares(std::string const& shape, int grains) {
  using P = Parts<PackingType>;
  auto const name = [&](char const* of) { return fmt::format("share/{}/{}/double/{}", of, shape, grains); };
  auto const declare_part = [&](char const* of, void (P::*run_part)()) {
    declare(name(of), [=](auto& state) { part<PackingType>(state, grains, run_part); });
  };
  declare_part("fill_rows", &P::fill_rows);
  declare_part("clear_forces", &P::clear_forces);
  declare_part("gather", &P::gather);
  declare_part("respond", &P::respond);
  declare_part("scatter", &P::scatter);
  declare_part("gather_ghosts", &P::gather_ghosts);
  declare_part("pair_forces", &P::forces);
  declare(name("integration"), [=](auto& state) { integration<PackingType>(state, grains); });
  declare(name("neighbour_search"), [=](auto& state) { neighbour_search<PackingType>(state, grains); });
}

}  // namespace scarp_benchmark
