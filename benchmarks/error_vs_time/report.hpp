// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdlib>
#include <string>
#include <thread>

#include "scarp/measure/processor.hpp"
#include "subjects.hpp"

namespace error_vs_time {

inline std::string cheapest(scarp::SweepTable const& table, std::string const& answer, double error) {
  auto const best = table.recommended(answer, error);
  if (best.empty()) return " - |";
  auto const& row = best.front();
  return fmt::format(" {}{}{} (cost {:.2g}) |", row.knob, row.setting.empty() ? "" : " ", row.setting, row.cost);
}

/// For each answer the cheapest settings for the wanted errors, and for an error that drowns in the scatter of samples.
inline std::string recommendations(Subject const& subject, scarp::SweepTable const& table) {
  std::string text = "\n| answer | base setting's cost over the front's |";
  std::string rule = "|---|---|";
  for (double const error : subject.wanted_errors) {
    text += fmt::format(" cheapest for {} |", scarp::percent(error));
    rule += "---|";
  }
  text += " for a tenth of the scatter |\n" + rule + "---|\n";
  for (std::size_t a = 0; a < table.answers.size(); ++a) {
    auto const& answer = table.answers[a];
    text += fmt::format("| {} | {:.2f} |", answer, table.excess_cost(0, answer));
    for (double const error : subject.wanted_errors) text += cheapest(table, answer, error);
    text += cheapest(table, answer, 0.1 * table.scatter[a]) + "\n";
  }
  return text;
}

/// How the numbers were made. SCARP_COMMIT comes from benchmarks/run.
inline std::string provenance(Subject const& subject, Options const& options, scarp::SweepTable const& table) {
  char const* const commit = std::getenv("SCARP_COMMIT");
  std::string const command =
      fmt::format("./benchmarks/run error_vs_time {}{}{}", subject.name,
                  options.repetitions > 0 ? fmt::format(" --repetitions {}", options.repetitions) : "",
                  options.quick ? " --quick" : "");
  std::string const machine =
      fmt::format("{} hardware threads, {}, compiler {}, commit {}", std::thread::hardware_concurrency(),
                  scarp::processor(), __VERSION__, commit != nullptr ? commit : "unknown");
  std::string const reference = std::isfinite(table.reference_cost)
                                    ? fmt::format("of the reference {:.3g} times that", table.reference_cost)
                                    : "exact reference";
  return fmt::format(
      "`{}`; {}. Repetitions: {}; CPU time of a run at the base setting {:.3g} s, {}; the former changed by {} "
      "(median) "
      "from one measurement to the next, costs nearer to each other count as equal.\n",
      command, machine, table.repetitions, table.rows.front().seconds, reference, scarp::percent(table.cost_noise));
}

inline void report(Subject const& subject, Options const& options, scarp::SweepTable const& table) {
  std::string const text =
      provenance(subject, options, table) + "\n" + table.markdown() + recommendations(subject, table);
  fmt::print("\n# {}: {}\n\n{}", subject.name, subject.question, text);
  table.write_csv(options.out / (subject.name + ".csv"));
  scarp::write_file(options.out / (subject.name + ".md"), text);
}

}  // namespace error_vs_time
