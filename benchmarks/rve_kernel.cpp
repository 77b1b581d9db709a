// SPDX-License-Identifier: BSL-1.0
// What does one DEM step of a packing cost, by precision and number of grains, and which part of it takes how much?
#include "kernel_shares.hpp"
#include "naive_kernel.hpp"

namespace {

using namespace scarp_benchmark;

/// Largest difference of force [N] and torque over lever [N] between both kernels, relative to the largest contact
/// force.
template <class PackingType>
double disagreement(PackingType packing, scarp::LinearFrictional const& law, scarp::LocalDamping const& damping,
                    double time_step) {
  NaiveKernel<PackingType> naive(packing, law, damping, time_step);
  scarp::PairScratch<double> scratch;
  scarp::Tensor<2> strain;
  strain << 1e-5, 2e-5, -3e-5, 1e-5;
  naive.forces(strain);
  packing.last_move = {strain, time_step};
  scarp::pair_forces<scarp::Observe::nothing>(packing, law, scratch);
  double largest = 0.0;
  scarp::for_each_contact(packing, law,
                          [&](auto const& contact) { largest = std::max(largest, contact.force.norm()); });
  double worst = 0.0;
  double const lever = packing.population->largest_radius();
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    double const* net = scratch.forces.data() +
                        i * scarp::RowLayout<typename PackingType::Shape, typename PackingType::Law>::force_size;
    auto const& grain = naive.grains()[i];
    worst = std::max(
        {worst, std::abs(net[0] - grain.fx), std::abs(net[1] - grain.fy), std::abs(net[2] - grain.torque) / lever});
  }
  return worst / largest;
}

template <class PackingType>
void dem_step_naive(benchmark::State& state, int grains) {
  auto const law = law_of_study<PackingType>();
  PackingType const& packing = sheared<PackingType>(grains);
  scarp::LocalDamping const damping{};
  double const time_step = packing.pairs.critical_step;
  SlowShear<2> shear;
  if (!(disagreement(packing, law, damping, time_step) < 1e-9)) {
    state.SkipWithError("the naive kernel's forces differ from the library's by more than 1e-9");
    return;
  }
  NaiveKernel<PackingType> naive(packing, law, damping, time_step);
  for (auto _ : state) naive.step(shear.next());
  benchmark::DoNotOptimize(naive.grains().data());
  count_pairs(state, naive.pair_count(), contact_count(packing, law));
}

/// Cycles per second: the loop is a chain of additions, one cycle each.
void machine_clock(benchmark::State& state) {
  std::uint64_t chain = 1;
  constexpr int links = 1000;
  for (auto _ : state) {
    for (int link = 0; link < links; link += 10) {
      asm volatile(
          "add %0, %0\n\tadd %0, %0\n\tadd %0, %0\n\tadd %0, %0\n\tadd %0, %0\n\t"
          "add %0, %0\n\tadd %0, %0\n\tadd %0, %0\n\tadd %0, %0\n\tadd %0, %0"
          : "+r"(chain));
    }
  }
  benchmark::DoNotOptimize(chain);
  state.counters["GHz"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * links * 1e-9, benchmark::Counter::kIsRate);
}

template <class Shape>
void declare_naive(std::string const& name) {
  declare(fmt::format("dem_step_naive/{}/linear_frictional/double/400", name),
          [](auto& state) { dem_step_naive<StudyPacking<Shape>>(state, 400); });
}

template <class Shape>
void declare_plane(std::string const& name) {
  using scarp::Frictionless;
  using scarp::LinearFrictional;
  using scarp::Packing;
  std::vector<int> const numbers{100, 400, 1600};
  declare_steps<Packing<Shape, Frictionless, double>>(name + "/frictionless/double", numbers);
  declare_steps<Packing<Shape, Frictionless, float>>(name + "/frictionless/float", numbers);
  declare_steps<Packing<Shape, LinearFrictional, double>>(name + "/linear_frictional/double", numbers);
  declare_steps<Packing<Shape, LinearFrictional, float>>(name + "/linear_frictional/float", numbers);
}

}  // namespace

int main(int argc, char** argv) {
  using scarp::Disc;
  using scarp::Ellipse;
  using scarp::LinearFrictional;
  using scarp::Sphere;
  declare("machine/clock", machine_clock);
  declare_plane<Disc>("disc");
  declare_plane<Ellipse>("ellipse");
  declare_steps<StudyPacking<Sphere>>("sphere/linear_frictional/double", {100, 400, 1600});
  declare_steps<scarp::Packing<Sphere, LinearFrictional, float>>("sphere/linear_frictional/float", {100, 400, 1600});
  declare_naive<Disc>("disc");
  declare_naive<Ellipse>("ellipse");
  declare_shares<StudyPacking<Disc>>("disc", 400);
  declare_shares<StudyPacking<Ellipse>>("ellipse", 400);
  declare_shares<StudyPacking<Sphere>>("sphere", 400);

  // Cost by number of grains, neighbours anywhere in memory or close to each other.
  declare_steps<StudyPacking<Disc>>("disc/linear_frictional/double", {6400, 25600, 102400});
  for (int const grains : {6400, 25600, 102400}) {
    declare(fmt::format("dem_step_by_place/disc/linear_frictional/double/{}", grains),
            [grains](auto& state) { dem_step<StudyPacking<Disc>>(state, grains, Numbering::by_place); });
  }
  for (int const grains : {1600, 25600, 102400}) {
    declare(fmt::format("share/neighbour_search/disc/double/{}", grains),
            [grains](auto& state) { neighbour_search<StudyPacking<Disc>>(state, grains); });
  }
  return run(argc, argv, "rve_kernel");
}
