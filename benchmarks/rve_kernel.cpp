// SPDX-License-Identifier: BSL-1.0
// What does one DEM step of a packing cost, by shape, contact law, precision and number of grains?
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "naive_kernel.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/disc_grading.hpp"
#include "scarp/dem/ellipse_grading.hpp"
#include "scarp/dem/preparation.hpp"

namespace {

template <class Shape>
using StudyPacking = scarp::Packing<Shape, scarp::LinearFrictional>;

constexpr double pressure = 2e5;
constexpr double thickness = 0.2;

/// The study's material; the frictionless law keeps its normal spring.
template <class Law>
Law law_of_study() {
  if constexpr (scarp::Frictional<Law>) {
    return {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  } else {
    return {.normal_stiffness = 6e6};
  }
}

template <class Shape>
auto grading_of_study() {
  if constexpr (std::is_same_v<Shape, scarp::Disc>) {
    return scarp::DiscGrading{.smallest = 4e-3, .largest = 6e-3};
  } else {
    return scarp::EllipseGrading{.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75};
  }
}

/// Consolidated at 200 kPa; made once for each shape and number of grains.
template <class Shape>
StudyPacking<Shape> const& consolidated(int grains) {
  static std::map<int, StudyPacking<Shape>> made;
  auto const known = made.find(grains);
  if (known != made.end()) return known->second;
  auto const grading = grading_of_study<Shape>();
  scarp::Cloud<std::remove_const_t<decltype(grading)>> const cloud{
      .grading = grading, .grains = grains, .density = 2650.0, .thickness = thickness, .seed = 1};
  scarp::IsotropicPreparation const preparation{.pressure = pressure};
  auto prepared =
      preparation.prepare(cloud.template make<StudyPacking<Shape>>(), law_of_study<scarp::LinearFrictional>());
  if (!prepared.verdict.acceptable()) {
    scarp::refuse("{} grains were not consolidated ({}): the benchmark needs another seed", grains,
                  scarp::name(prepared.verdict.reason));
  }
  return made.emplace(grains, std::move(prepared.packing)).first->second;
}

template <class To, class From, int Count>
scarp::Columns<To, Count> converted(scarp::Columns<From, Count> const& from, std::size_t rows) {
  scarp::Columns<To, Count> result(rows);
  for (std::size_t r = 0; r < rows; ++r) {
    for (int k = 0; k < Count; ++k) result(r, k) = static_cast<To>(from(r, k));
  }
  return result;
}

/// The same grains in another precision or with another law; the list of pairs is made anew, shear forces start from zero.
template <class PackingType>
PackingType converted(StudyPacking<typename PackingType::Shape> const& from) {
  using Shape = typename PackingType::Shape;
  using Scalar = typename PackingType::Scalar;
  auto const& population = *from.population;
  std::vector<typename Shape::template Size<double>> sizes;
  for (std::size_t i = 0; i < from.grain_count(); ++i) sizes.push_back(population.size(i));
  PackingType packing;
  packing.population =
      std::make_shared<scarp::Population<Shape, Scalar> const>(sizes, population.density(), population.thickness());
  packing.cell = from.cell;
  packing.position = converted<Scalar>(from.position, from.grain_count());
  packing.orientation.resize(from.grain_count());
  if constexpr (Shape::orientation_count > 0) {
    packing.orientation = converted<Scalar>(from.orientation, from.grain_count());
  }
  packing.rest();
  return packing;
}

/// Slow pure shear that turns round every 200 steps: the packing stays in steady contact.
class SlowShear {
 public:
  scarp::Tensor<2> next() {
    double const rate = (count_++ / 200) % 2 == 0 ? 1e-6 : -1e-6;
    scarp::Tensor<2> strain = scarp::Tensor<2>::Zero();
    strain(0, 0) = rate;
    strain(1, 1) = -rate;
    return strain;
  }

 private:
  long count_ = 0;
};

void tell(benchmark::State& state, std::size_t near_pairs, std::size_t contacts) {
  using benchmark::Counter;
  auto const per = Counter::kIsRate | Counter::kInvert;
  auto const steps = static_cast<double>(state.iterations());
  state.counters["us_per_step"] = Counter(steps * 1e-6, per);
  state.counters["ns_per_near_pair"] = Counter(steps * static_cast<double>(near_pairs) * 1e-9, per);
  state.counters["near_pairs"] = static_cast<double>(near_pairs);
  state.counters["contacts"] = static_cast<double>(contacts);
}

template <class PackingType>
std::size_t contact_count(PackingType const& packing, typename PackingType::Law const& law) {
  std::size_t count = 0;
  scarp::for_each_contact(packing, law, [&](auto const&) { ++count; });
  return count;
}

/// The consolidated packing as the benchmark wants it, settled for its law and precision.
template <class PackingType>
PackingType settled(int grains, scarp::TimeStepper<PackingType>& stepper) {
  using Law = typename PackingType::Law;
  auto const& source = consolidated<typename PackingType::Shape>(grains);
  if constexpr (std::is_same_v<PackingType, StudyPacking<typename PackingType::Shape>>) {
    return source;
  } else {
    auto packing = converted<PackingType>(source);
    auto const law = law_of_study<Law>();
    if constexpr (!scarp::Frictional<Law>) {  // without friction the cell must shrink until it carries 200 kPa again
      auto const loading = scarp::Loading<2>::stress(scarp::VoigtStress<2>(-pressure, -pressure, 0.0));
      scarp::Servo const servo{.stress_tolerance = 1e-2, .unbalanced_tolerance = 1e-2, .most_steps = 50'000};
      if (auto const verdict = servo.reach(stepper, packing, law, loading); !verdict.acceptable()) {
        scarp::refuse("{} frictionless grains did not settle ({}): loosen the tolerances", grains,
                      scarp::name(verdict.reason));
      }
      packing.rest();  // grains without contact fly on for ever and would make the list of pairs old
    }
    return packing;
  }
}

template <class PackingType>
void dem_step(benchmark::State& state, int grains) {
  auto const law = law_of_study<typename PackingType::Law>();
  scarp::TimeStepper<PackingType> stepper;
  static std::map<int, PackingType> made;
  if (!made.contains(grains)) made.emplace(grains, settled<PackingType>(grains, stepper));
  PackingType packing = made.at(grains);
  SlowShear shear;
  for (int warm_up = 0; warm_up < 400; ++warm_up) static_cast<void>(stepper.step(packing, law, shear.next()));
  for (auto _ : state) {
    if (!stepper.step(packing, law, shear.next()).acceptable()) {
      state.SkipWithError("the packing failed");
      break;
    }
  }
  tell(state, packing.pairs.count(), contact_count(packing, law));
}

/// Largest difference of force [N] and torque over lever [N] between both kernels, relative to the largest contact force.
template <class PackingType>
double disagreement(PackingType packing, scarp::LinearFrictional const& law, scarp::LocalDamping const& damping,
                    double time_step) {
  scarp_benchmark::NaiveKernel<PackingType> naive(packing, law, damping, time_step);
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
  auto const law = law_of_study<scarp::LinearFrictional>();
  PackingType packing = consolidated<typename PackingType::Shape>(grains);
  scarp::TimeStepper<PackingType> stepper;
  SlowShear shear;
  for (int warm_up = 0; warm_up < 400; ++warm_up) static_cast<void>(stepper.step(packing, law, shear.next()));
  double const time_step = packing.pairs.critical_step;
  if (!(disagreement(packing, law, stepper.damping, time_step) < 1e-9)) {
    state.SkipWithError("the naive kernel's forces differ from the library's by more than 1e-9");
    return;
  }
  scarp_benchmark::NaiveKernel<PackingType> naive(packing, law, stepper.damping, time_step);
  for (auto _ : state) naive.step(shear.next());
  benchmark::DoNotOptimize(naive.grains().data());
  tell(state, naive.pair_count(), contact_count(packing, law));
}

template <class Shape, class Law, class Scalar>
void declare(std::string const& name) {
  for (int const grains : {100, 400, 1600}) {
    benchmark::RegisterBenchmark(("dem_step/" + name + "/" + std::to_string(grains)).c_str(), [grains](auto& state) {
      dem_step<scarp::Packing<Shape, Law, Scalar>>(state, grains);
    })->Unit(benchmark::kMicrosecond);
  }
}

template <class Shape>
void declare_naive(std::string const& name) {
  benchmark::RegisterBenchmark(("dem_step_naive/" + name + "/linear_frictional/double/400").c_str(), [](auto& state) {
    dem_step_naive<StudyPacking<Shape>>(state, 400);
  })->Unit(benchmark::kMicrosecond);
}

}  // namespace

int main(int argc, char** argv) {
  using scarp::Disc;
  using scarp::Ellipse;
  using scarp::Frictionless;
  using scarp::LinearFrictional;
  declare<Disc, Frictionless, double>("disc/frictionless/double");
  declare<Disc, Frictionless, float>("disc/frictionless/float");
  declare<Disc, LinearFrictional, double>("disc/linear_frictional/double");
  declare<Disc, LinearFrictional, float>("disc/linear_frictional/float");
  declare<Ellipse, Frictionless, double>("ellipse/frictionless/double");
  declare<Ellipse, Frictionless, float>("ellipse/frictionless/float");
  declare<Ellipse, LinearFrictional, double>("ellipse/linear_frictional/double");
  declare<Ellipse, LinearFrictional, float>("ellipse/linear_frictional/float");
  declare_naive<Disc>("disc");
  declare_naive<Ellipse>("ellipse");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    benchmark::RunSpecifiedBenchmarks();
  } catch (std::exception const& problem) {
    fmt::print(stderr, "rve_kernel: {}\n", problem.what());
    return 1;
  }
  return 0;
}
