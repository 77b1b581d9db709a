// SPDX-License-Identifier: BSL-1.0
#include "estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "../shared/data_file.hpp"
#include "../shared/study/soils.hpp"
#include "../shared/study/study_sand.hpp"
#include "scarp/core/process.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/run/resources.hpp"
#include "scarp/solver/load_stepping.hpp"

namespace fault_rupture {

namespace {

template <class SoilType>
Control control_of(Choice const& choice) {
  return {choice.tolerance.value_or(SoilType::tolerance(choice)),
          choice.max_displacement_gradient.value_or(SoilType::max_displacement_gradient(choice.quick))};
}

/// Load steps of one size.
struct EqualSteps {
  double count;
  double increment;  ///< [m], of the throw
  double throw_at;   ///< [m], halfway
};

/// As LoadStepping makes them where no step needs many iterations: growing up to the limit of the gradient.
template <class Take>
void for_steps(double throw_to, double most, Take const& take) {
  constexpr double pieces = 100.0;
  scarp::LoadStepping const stepping;
  double increment = stepping.first;
  for (double at = 0.0; at < throw_to * (1.0 - 1e-9);) {
    double const step = std::min({increment, most, throw_to - at});
    double const count = step < most ? 1.0 : std::max(1.0, std::floor((throw_to - at) / (pieces * step)));
    take(EqualSteps{count, step, at + 0.5 * count * step});
    at += count * step;
    increment = stepping.growth * step;
  }
}

double iterations_of(double gradient, double tolerance, bool has_length, CostModel const& model) {
  double const decades = std::log10(gradient / tolerance);
  return std::max(1.0, has_length ? model.iterations_with_length + model.iterations_with_length_by_decade * decades
                                  : model.iterations + model.iterations_by_decade * decades);
}

/// DEM steps of one response, mean of all points.
/// crowding: factor of the strain
double answer_of(Choice const& choice, SceneSize const& size, EqualSteps const& steps, double width, double crowding,
                 CostModel const& model) {
  double const strain = crowding * model.strain_at_metre * std::pow(width / choice.scale(), model.strain_by_width) *
                        (1.0 + model.strain_by_throw * steps.throw_at / size.depth) * steps.increment / size.depth;
  return std::hypot(choice.min_dem_steps, strain / choice.strain_per_step);
}

std::string time_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} s ({:.1f} min)", seconds, seconds / 60.0);
  return fmt::format("{:.0f} s ({:.1f} h)", seconds, seconds / 3600.0);
}

}  // namespace

Control control_of(Choice const& choice) {
  if (choice.soil == Soil::dem) return control_of<Sand>(choice);
  return choice.soil == Soil::mohr_coulomb ? control_of<FrictionalSoil>(choice) : control_of<ElasticSoil>(choice);
}

CostModel read_cost_model(std::filesystem::path const& file) {
  auto const found = nlohmann::ordered_json::parse(scarp::read_file(file), nullptr, false);
  CostModel model;
  CostModel::members(model, [&](char const* name, auto& value) {
    bool const sound = found.is_object() && found.contains(name) &&
                       (std::is_same_v<decltype(value), double&> ? found[name].is_number() : found[name].is_string());
    if (!sound)
      scarp::reject("'{}' holds no '{}' (what runs cost is expected): make it anew by benchmarks/run scaling_laws",
                    file.string(), name);
    found[name].get_to(value);
  });
  return model;
}

std::filesystem::path default_cost_model() {
  return examples::data_file("fault_rupture/costs.json", FAULT_RUPTURE_COSTS);
}

Cost cost_of(Choice const& choice, SceneSize const& size, Control const& control, CostModel const& model,
             double speed) {
  // Along the fault, where the rupture is.
  double const mean_area = size.width * size.depth / size.elements;
  double const area = size.min_area > 0.0 ? size.min_area : mean_area;
  double const node_distance = std::sqrt(area * size.elements / size.nodes);
  double const width = std::hypot(model.width_per_node * node_distance, model.width_per_length * choice.length);
  double const throw_to = choice.throw_over_depth * size.depth;
  bool const packings = choice.soil == Soil::dem;
  bool const has_length = size.pairs > 0.0;
  // More of the points are strained than on the uniform meshes of the model, whose band has 1.25 times the mean number
  // of elements; the power is that of runs with lengths from 8 to 1 m.
  double const crowding = size.min_area > 0.0 ? std::sqrt(std::max(1.0, mean_area / size.min_area / 1.25)) : 1.0;
  Cost cost{.steps = 1.0, .iterations = 1.0};
  if (packings) cost.dem_steps = size.points * choice.min_dem_steps;
  auto const step = [&](EqualSteps const& steps) {
    double const iterations = iterations_of(steps.increment / width, control.tolerance, has_length, model);
    cost.steps += steps.count;
    cost.iterations += steps.count * iterations;
    if (packings)
      cost.dem_steps += steps.count * iterations * size.points * answer_of(choice, size, steps, width, crowding, model);
  };
  for_steps(throw_to, control.max_displacement_gradient * width, step);
  auto const power = [](double value, double count, double exponent) { return value * std::pow(count, exponent); };
  double outside = power(model.outside, size.points, model.outside_by_points);
  if (choice.soil == Soil::mohr_coulomb) {
    double const widths = throw_to / width;
    double const each = has_length ? model.plain_iterations_with_length : model.plain_iterations;
    cost.iterations = std::max(cost.steps, power(each, widths, model.plain_iterations_by_throw));
    if (has_length) outside *= power(model.plain_outside_with_length, widths, model.plain_outside_by_throw);
  }
  double const grains = choice.grains;
  if (packings) {
    cost.preparation = size.columns * power(model.column, grains, model.column_by_grains);
    double const tangents = cost.steps / scarp::QuasiNewton<>{}.tangent_interval * size.points;
    cost.points = (cost.dem_steps + tangents * model.tangent) * power(model.dem_step, grains, model.dem_step_by_grains);
  } else {
    cost.points = cost.iterations * size.points * model.plain_answer;
  }
  cost.outside = cost.iterations * (outside + model.pair * size.pairs);
  cost.preparation *= speed;
  cost.points *= speed;
  cost.outside *= speed;
  return cost;
}

double kernel_seconds() {
  constexpr int grains = 100;
  constexpr int steps = 200;
  constexpr double time = 0.15;  // [s]
  auto const law = examples::study_law();
  auto made =
      scarp::IsotropicPreparation{.pressure = 5e4}.prepare(examples::study_cloud(grains, 1).make<Grains>(), law);
  if (!made.verdict.acceptable()) scarp::reject("the packing that this machine is timed with was not prepared");
  scarp::TimeStepper<Grains> stepper;
  double least = std::numeric_limits<double>::infinity();
  double strain = 1e-6;
  for (scarp::CpuTime all; all.seconds() < time; strain = -strain) {
    scarp::Tensor<2> const shear = Eigen::Vector2d(strain, -strain).asDiagonal();
    scarp::CpuTime const batch;
    for (int step = 0; step < steps; ++step) {
      if (!stepper.step(made.packing, law, shear).acceptable())
        scarp::reject("the packing that this machine is timed with has failed");
    }
    least = std::min(least, batch.seconds() / steps);
  }
  return least;
}

std::string estimate(Choice const& choice, SceneSize const& size, int ranks, int threads) {
  auto const model = read_cost_model(default_cost_model());
  double const kernel = kernel_seconds();
  double const speed = kernel / model.kernel;
  auto const cost = cost_of(choice, size, control_of(choice), model, speed);
  auto const wall_on = [&](int used) {
    double const team = ranks * used;
    double const shared = team > 1.0 ? 1.0 / (team * model.thread_efficiency) : 1.0;
    double const columns_at_once = std::clamp(size.columns, 1.0, static_cast<double>(used));
    return cost.preparation / columns_at_once + cost.points * shared + cost.outside;
  };
  double const cpu = cost.points + ranks * (cost.preparation + cost.outside);
  double const bytes = memory_of(choice, size, ranks);

  auto text =
      fmt::format("scene: {:.0f} elements, {:.0f} nodes, {:.0f} points", size.elements, size.nodes, size.points);
  if (size.min_area > 0.0) text += fmt::format(", those along the fault {:.3g} m2", size.min_area);
  if (size.columns > 0.0)
    text += fmt::format(", {} grains in each, {:.0f} columns of packings", choice.grains, size.columns);
  if (size.pairs > 0.0)
    text += fmt::format(", {:.0f} points within {} m of one", size.pairs / size.points, choice.length);
  text += fmt::format(", h/H to {}\n", choice.throw_over_depth);
  text += fmt::format("steps: {:.0f}, with {:.0f} iterations", cost.steps, cost.iterations);
  if (cost.dem_steps > 0.0) text += fmt::format(" and {:.3g} million DEM steps", 1e-6 * cost.dem_steps);
  text += fmt::format("\nCPU time: {}; preparation {:.3g} s, points {:.3g} s, the rest {:.3g} s{}\n", time_text(cpu),
                      cost.preparation, cost.points, cost.outside, ranks > 1 ? " on every rank" : "");
  text += fmt::format("wall time: {} on {} thread{}{}, where nothing else runs\n", time_text(wall_on(threads)), threads,
                      threads > 1 ? "s" : "", ranks > 1 ? fmt::format(" of each of {} ranks", ranks) : "");
  if (int const here = scarp::usable_processors(); threads > here)
    text += fmt::format("warning: this machine has {} processor{} for the threads, so that it needs {}\n", here,
                        here > 1 ? "s" : "", time_text(wall_on(here)));
  text += fmt::format("memory: {}{}\n", scarp::memory_text(bytes), ranks > 1 ? " on every rank" : "");
  if (auto const free = scarp::free_memory(); bytes > free.bytes)
    text += fmt::format("warning: only {} are left by {}: the run would be rejected\n", scarp::memory_text(free.bytes),
                        free.limit);
  text += fmt::format(
      "machine: {:.2f} us for a step of 100 grains, {:.2f} of what it took where the model was measured ({}, {}, "
      "commit {})\n",
      1e6 * kernel, speed, model.machine, model.date, model.commit);
  text += fmt::format("uncertainty: runs that were not fitted took up to {:.1f} times more or less (docs/scaling.md)\n",
                      model.largest_error);
  if (choice.scene != Case::free) text += "warning: no scene with a footing was measured; many take more iterations\n";
  if (!repeats_study(choice))
    text += "warning: the model is of the reference study's site; others took up to 2.3 times more or 1.5 times less\n";
  if (choice.water_table)
    text +=
        "warning: pore water is not in the model; runs with it took 1.4 to 3 times more, with a bound on its time "
        "error 40\n";
  if (choice.soil == Soil::elastic) text += "warning: no elastic ground was measured\n";
  if (choice.sensitivity_runs) text += "sensitivity runs come on top: about one and a half to three times more\n";
  return text;
}

}  // namespace fault_rupture
