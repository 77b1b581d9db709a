// SPDX-License-Identifier: BSL-1.0
// Are responses on a device those of the processor, and how many DEM steps does it take in a second? Prints tables of
// comma-separated values.
//   device_speed bits DEVICE                       compares both; ends with 1 where they differ
//   device_speed speed DEVICE POINTS SCENE_POINTS  DEM steps over numbers of points (33,66), and responses of a scene's
//   points device_speed kernel                            the vector kernel, for comparison
//   device_speed sanitize DEVICE                   a short response for tools that watch the memory
// DEVICE is processor, or cuda in a program with CUDA.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <latch>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <vector>

#include "device_packings.hpp"
#include "device_points.hpp"
#include "scarp/core/process.hpp"
#ifdef SCARP_WITH_CUDA
#include "scarp/cuda/cuda_device.hpp"
#endif

namespace {

using scarp_benchmark::DevicePoints;
using scarp_benchmark::Grains;
using scarp_benchmark::narrow;
using scarp_benchmark::Narrow;
using scarp_benchmark::packings_of;
using scarp_benchmark::strain_step;
template <class PackingType>
using DeviceOf = typename DevicePoints<PackingType>::Device;
template <class PackingType>
using Processor = scarp::ProcessorDevice<scarp::BlockTypesOf<PackingType>, scarp::LocalDamping>;

template <class PackingType>
constexpr bool is_double = std::is_same_v<PackingType, Grains>;
template <class PackingType>
constexpr std::string_view precision = is_double<PackingType> ? "double" : "float";
constexpr double strain = 1e-5;        // of a DEM step, the most that a provider takes
constexpr double fast_strain = 5e-5;   // for many lists
constexpr std::array sizes{400, 100};  // grains of a packing

template <class PackingType>
std::shared_ptr<DeviceOf<PackingType>> device(std::string const& name) {
  if (name == "processor") return std::make_shared<Processor<PackingType>>();
#ifdef SCARP_WITH_CUDA
  if (name == "cuda") return scarp::cuda_device<scarp::BlockTypesOf<PackingType>, scarp::LocalDamping>();
  scarp::reject("the device is '{}'; expected processor or cuda", name);
#else
  scarp::reject("the device is '{}' in a program without CUDA; expected processor. Compile it with SCARP_WITH_CUDA",
                name);
#endif
}

/// Stress times volume [N m] after steps of the vector kernel.
template <class PackingType>
scarp::detail::SmallTensor<2> moment_of_kernel(PackingType packing, std::size_t point, int steps) {
  auto const law = scarp_benchmark::law_of_study<PackingType>();
  scarp::TimeStepper<PackingType> stepper;
  scarp::StepObservation<2> seen;
  for (int step = 0; step < steps; ++step)
    static_cast<void>(stepper.step(packing, law, strain_step(fast_strain, point)));
  static_cast<void>(stepper.observe(packing, law, seen));
  return scarp::detail::row_by_row<2>(-seen.stress * packing.volume());
}

/// Largest difference over the largest number.
double difference(std::span<double const> found, std::span<double const> expected) {
  double most = 0.0;
  double size = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    double const apart = std::abs(found[k] - expected[k]);
    if (!(apart <= most)) most = apart;  // not-a-number stays
    size = std::max(size, std::abs(expected[k]));
  }
  return most / size;
}

/// \return whether the device's responses are the processor's up to round-off, and the same in another run
template <class PackingType>
bool compare(std::string const& name, int grains, std::vector<PackingType> const& packings) {
  std::size_t const points = packings.size();
  auto const tested = device<PackingType>(name);
  DevicePoints<PackingType> found(tested, packings, points, *tested);
  DevicePoints<PackingType> expected(std::make_shared<Processor<PackingType>>(), packings, points, *tested);
  constexpr double bound = is_double<PackingType> ? 1e-9 : 1e-3;
  bool is_good = true;
  for (int const number : {0, 1, 8, 100, 1000}) {
    std::vector<int> const steps(points, number);
    found.respond(steps, fast_strain);
    std::vector<std::string> first;
    for (std::size_t k = 0; k < points; ++k) first.push_back(found.content(k));
    found.respond(steps, fast_strain);
    expected.respond(steps, fast_strain);
    double worst = 0.0;
    double of_kernel = 0.0;
    int most_pairs = 0;
    bool alike = true;
    std::size_t equal = 0;
    std::size_t repeated = 0;
    for (std::size_t k = 0; k < points; ++k) {
      auto const& header = found.header(k);
      auto const& other = expected.header(k);
      double const apart =
          number > 0 ? difference(header.moment, other.moment) : difference(header.stiffness, other.stiffness);
      if (!(apart <= worst)) worst = apart;
      if (number > 0)
        of_kernel = std::max(of_kernel, difference(header.moment, moment_of_kernel(packings[k], k, number)));
      most_pairs = std::max(most_pairs, header.pairs);
      equal += first[k] == expected.content(k) ? 1 : 0;
      repeated += first[k] == found.content(k) ? 1 : 0;
      alike &= header.trouble == other.trouble;
    }
    is_good &= repeated == points && (number > 100 || (alike && worst <= bound));
    fmt::print("{},{},{},{},{:.2g},{},{},{},{},{},{},{}\n", precision<PackingType>, grains, number, points, worst,
               number > 100 ? "" : fmt::format("{:g}", bound), number > 0 ? fmt::format("{:.2g}", of_kernel) : "",
               equal, repeated, found.lists(points), most_pairs, found.troubles(points));
    std::fflush(stdout);
  }
  return is_good;
}

int bits(std::string const& name) {
  fmt::print(
      "precision,grains,steps,points,difference,bound,difference from vector kernel,equal bits,"
      "equal bits of another run,lists,most near pairs,troubles\n");
  bool is_good = true;
  for (int const grains : sizes) {
    auto const packings = packings_of(grains);
    is_good &= compare(name, grains, packings);
    is_good &= compare(name, grains, narrow(packings));
  }
  return is_good ? 0 : 1;
}

/// The median of three runs of the same responses.
template <class PackingType>
void print_speed(DevicePoints<PackingType>& on_device, int grains, char const* what, std::vector<int> const& steps) {
  std::array<double, 3> seconds{};
  for (double& one : seconds) one = on_device.respond(steps, strain);
  std::ranges::sort(seconds);
  fmt::print("{},{},{},{},{},{},{:.6g},{},{}\n", what, precision<PackingType>, grains, steps.size(),
             std::accumulate(steps.begin(), steps.end(), 0L), *std::ranges::max_element(steps), seconds[1],
             on_device.lists(steps.size()), on_device.troubles(steps.size()));
  std::fflush(stdout);
}

/// Steps per point such that a case takes about a second.
template <class PackingType>
void measure(std::string const& name, std::vector<PackingType> const& packings, int grains,
             std::vector<int> const& numbers, int scene_points) {
  auto const tested = device<PackingType>(name);
  auto const most = static_cast<std::size_t>(std::max(scene_points, *std::ranges::max_element(numbers)));
  DevicePoints<PackingType> on_device(tested, packings, most, *tested);
  for (int const points : numbers) {
    std::vector<int> steps(static_cast<std::size_t>(points), 20);
    on_device.respond(steps, strain);
    double const per_step = on_device.respond(steps, strain) / 20.0;
    std::ranges::fill(steps, static_cast<int>(std::clamp(0.2 / per_step, 20.0, 1000.0)));
    print_speed(on_device, grains, "like", steps);
  }
  // Responses of a load step, and of one in which few points take many times the mean, as next to a fault.
  std::vector<int> steps(static_cast<std::size_t>(scene_points), 100);
  print_speed(on_device, grains, "responses", steps);
  for (std::size_t k = 0; k < steps.size(); ++k)
    steps[k] = std::max(
        8, static_cast<int>(2400.0 * std::exp(-static_cast<double>(20 * k) / static_cast<double>(steps.size()))));
  print_speed(on_device, grains, "uneven", steps);
}

int speed(std::string const& name, std::vector<int> const& numbers, int scene_points) {
  fmt::print("work,precision,grains,points,steps,most steps,seconds,lists,troubles\n");
  for (int const grains : sizes) {
    auto const packings = packings_of(grains);
    measure(name, packings, grains, numbers, scene_points);
    measure(name, narrow(packings), grains, numbers, scene_points);
  }
  return 0;
}

/// DEM steps of packings of their own on so many threads.
template <class PackingType>
void print_kernel(std::vector<PackingType> const& packings, int threads) {
  constexpr int rounds = 10;
  constexpr int steps = 1000;
  auto const law = scarp_benchmark::law_of_study<PackingType>();
  std::latch ready(threads + 1);
  std::vector<std::jthread> team;
  for (int thread = 0; thread < threads; ++thread) {
    team.emplace_back([&, point = static_cast<std::size_t>(thread)] {
      scarp::TimeStepper<PackingType> stepper;
      auto packing = packings[point % packings.size()];
      ready.arrive_and_wait();
      for (int round = 0; round < rounds; ++round) {
        packing = packings[point % packings.size()];
        for (int step = 0; step < steps; ++step)
          static_cast<void>(stepper.step(packing, law, strain_step(strain, point)));
      }
    });
  }
  ready.arrive_and_wait();
  auto const begin = std::chrono::steady_clock::now();
  team.clear();
  double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  fmt::print("{},{},{},{},{:.6g}\n", precision<PackingType>, packings[0].grain_count(), threads,
             long{rounds} * steps * threads, seconds);
  std::fflush(stdout);
}

int kernel() {
  fmt::print("precision,grains,threads,steps,seconds\n");
  for (int const grains : sizes) {
    auto const packings = packings_of(grains);
    for (int const threads : {1, scarp::usable_processors()}) {
      print_kernel(packings, threads);
      print_kernel(narrow(packings), threads);
    }
  }
  return 0;
}

int sanitize(std::string const& name) {
  auto const tested = device<Grains>(name);
  std::size_t const points = 2;
  DevicePoints<Grains> on_device(tested, packings_of(400, 1), points, *tested);
  on_device.respond(std::vector<int>(points, 60), 4.0 * fast_strain);
  fmt::print("{} points, {} lists, {} troubles\n", points, on_device.lists(points), on_device.troubles(points));
  return on_device.lists(points) > 0 && on_device.troubles(points) == 0 ? 0 : 1;
}

std::vector<int> numbers_of(std::string const& text) {
  std::vector<int> numbers;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t const end = std::min(text.find(',', at), text.size());
    numbers.push_back(std::max(1, std::stoi(text.substr(at, end - at))));
    at = end + 1;
  }
  return numbers;
}

}  // namespace

int main(int count, char** arguments) try {
  std::vector<std::string> const given(arguments + 1, arguments + count);
  std::string const command = given.empty() ? "" : given[0];
  if (command == "bits" && given.size() == 2) return bits(given[1]);
  if (command == "speed" && given.size() == 4) return speed(given[1], numbers_of(given[2]), std::stoi(given[3]));
  if (command == "kernel" && given.size() == 1) return kernel();
  if (command == "sanitize" && given.size() == 2) return sanitize(given[1]);
  scarp::reject(
      "usage: device_speed bits|sanitize DEVICE, device_speed speed DEVICE POINTS,... SCENE_POINTS, or device_speed "
      "kernel");
} catch (std::exception const& problem) {
  fmt::print(stderr, "device_speed: {}\n", problem.what());
  return 2;
}
