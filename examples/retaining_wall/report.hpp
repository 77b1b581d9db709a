// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "../shared/print.hpp"
#include "../shared/renamed_keys.hpp"
#include "../shared/run_options.hpp"
#include "run.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/csv.hpp"

namespace retaining_wall {

/// Largest difference of the forces on wall and rollers, relative; the solver's tolerance refers to all reactions.
inline double imbalance(Outcome const& outcome) {
  double largest = 0.0;
  for (auto const& row : outcome.rows)
    largest = std::max(largest, std::abs(row.pressed.far_force / row.pressed.force - 1.0));
  return largest;
}

inline void print_table(std::vector<Outcome> const& outcomes) {
  examples::print(
      stdout,
      "K is the force on the wall over the integral of the overburden, its extreme mean over {:g} % of strain\n\n",
      100.0 * window);
  examples::print(stdout, "{:<8} {:>7} {:>8} {:>8} {:>9} {:>14} {:>16}   {}\n", "wall", "K", "from", "Rankine",
                  "K/Rankine", "explained", "phi [degrees]", "phi from");
  for (auto const& outcome : outcomes) {
    auto const reached = outcome.reached();
    auto const [least, most] = outcome.interval();
    examples::print(stdout, "{:<8} {:7.4f} {:6.2f} % {:8.4f} {:9.4f} {:>14} {:>16}   {}\n", name(outcome.movement),
                    reached.ratio, 100.0 * reached.strain, outcome.formula(), reached.ratio / outcome.formula(),
                    fmt::format("{:.3f} to {:.3f}", least, most),
                    fmt::format("{:.2f} +- {:.2f}", degrees(outcome.friction.angle), degrees(outcome.friction.scatter)),
                    outcome.friction.source);
  }
  examples::print(stdout, "\n{:<8} {:>8} {:>9} {:>8} {:>6} {:>8} {:>6} {:>11} {:>9} {:>10} {:>8}\n", "wall",
                  "K at rest", "K at end", "to", "steps", "rejected", "iter", "DEM steps", "residual", "imbalance",
                  "seconds");
  for (auto const& outcome : outcomes) {
    auto const& run = outcome.run;
    auto const ratio = [&](bool first) {
      return outcome.rows.empty() ? std::nan("") : (first ? outcome.rows.front() : outcome.rows.back()).ratio();
    };
    examples::print(stdout, "{:<8} {:9.4f} {:9.4f} {:6.2f} % {:6} {:8} {:6} {:11} {:9.1e} {:10.1e} {:8.1f}\n",
                    name(outcome.movement), ratio(true), ratio(false), 100.0 * run.load, run.steps, run.refused,
                    run.iterations, run.inner_steps, run.largest_residual, imbalance(outcome), run.seconds);
  }
}

/// \return whether all came to the end and within what their friction explains; else prints which did not
inline bool judge(std::vector<Outcome> const& outcomes) {
  bool good = true;
  for (auto const& outcome : outcomes) {
    if (outcome.holds()) continue;
    good = false;
    auto const& run = outcome.run;
    if (run.verdict.acceptable()) {
      examples::print(stderr,
                      "retaining_wall: {} pressure is not Rankine's (its ratio lies outside what phi explains)\n",
                      name(outcome.movement));
    } else {
      examples::print(stderr,
                      "retaining_wall: {} movement stopped at the strain {:.4f} ({}; last rejected attempt: {})\n",
                      name(outcome.movement), run.load, name(run.verdict.reason), name(run.last_failure));
    }
  }
  return good;
}

inline nlohmann::ordered_json summary(Outcome const& outcome) {
  auto const reached = outcome.reached();
  auto const& run = outcome.run;
  nlohmann::ordered_json json;
  json["status"] = run.verdict.acceptable() ? "ok" : std::string(name(run.verdict.reason));
  json["holds"] = outcome.holds();
  json["ratio"] = reached.ratio;
  json["rankine"] = outcome.formula();
  json["force_over_rankine"] = reached.ratio / outcome.formula();
  json["explained"] = outcome.interval();
  json["friction_angle"] = degrees(outcome.friction.angle);
  json["friction_scatter"] = degrees(outcome.friction.scatter);
  json["friction_from"] = outcome.friction.source;
  json["window_from"] = reached.strain;
  json["window"] = window;
  json["strain"] = run.load;
  json["imbalance"] = imbalance(outcome);
  json["steps"] = run.steps;
  json["rejected_steps"] = run.refused;
  json["iterations"] = run.iterations;
  json["dem_steps"] = run.inner_steps;
  json["max_accepted_residual"] = run.largest_residual;
  json["seconds"] = run.seconds;
  examples::add_keys_from_before(json);
  return json;
}

/// "ok", or why the first movement has stopped that did not come to its end.
inline std::string status_of(std::vector<Outcome> const& outcomes) {
  for (auto const& outcome : outcomes) {
    if (!outcome.run.verdict.acceptable()) return std::string(name(outcome.run.verdict.reason));
  }
  return "ok";
}

/// \throws FileError
inline void write_all(Choice const& choice, std::vector<Outcome> const& outcomes, scarp::RunFolder& own) {
  std::filesystem::path const& folder = own.path();
  own.begin();
  std::string const status = status_of(outcomes);
  nlohmann::ordered_json json{
      {"status", status}, {"soil", choice.soil == Soil::sand ? "sand" : "mohr_coulomb"}, {"size", choice.size}};
  if (choice.soil == Soil::sand) {
    json["grains"] = choice.sand.grains;
    json["seed"] = choice.sand.seed;
    if (choice.sand.void_ratio == 0.0 && choice.sand.relative_density == 0.0)
      json["preparation_friction"] = choice.sand.preparation_friction;
  }
  for (auto const& outcome : outcomes) {
    std::string const movement = name(outcome.movement);
    json[movement] = summary(outcome);
    scarp::CsvTable forces({"strain", "displacement [m]", "force [N/m]", "far_force [N/m]", "overburden [N/m]", "ratio",
                            "iterations", "residual"});
    for (auto const& row : outcome.rows)
      forces.add(row.strain, row.strain * Wall{}.length, row.pressed.force, row.pressed.far_force,
                 row.pressed.overburden, row.ratio(), row.iterations, row.residual);
    forces.write(folder / (movement + ".csv"));
    if (outcome.friction.tests.empty()) continue;
    scarp::CsvTable tests({"packing", "strain", "ratio"});  // packing 0: all together
    for (std::size_t k = 0; k < outcome.friction.tests.size(); ++k) {
      auto const& test = outcome.friction.tests[k];
      for (std::size_t row = 0; row < test.strain.size(); ++row) tests.add(k, test.strain[row], test.ratio[row]);
    }
    tests.write(folder / (movement + "_tests.csv"));
  }
  json["run"] = examples::json_of(own.record());
  examples::write_json(folder / "summary.json", json);
  own.end(status == "ok" ? "finished" : status);
}

}  // namespace retaining_wall
