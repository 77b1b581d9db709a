// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "print.hpp"
#include "scarp/solver/load_stepping.hpp"

namespace examples {

/// One scene on one mesh.
struct Outcome {
  int elements = 0;
  int dofs = 0;
  double result = 0.0;
  scarp::RunReport run{};
  double seconds = 0.0;  ///< of the processor, mesh and set-up included
  std::string note{};    ///< what kept the result from being one
};

class Stopwatch {
 public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

/// Results on meshes that are halved each time, compared with their formula.
struct Series {
  std::string what;
  double formula = 0.0;
  std::optional<double> gate;  ///< largest error of the finest mesh, as a part of the formula; none: for information
  std::vector<Outcome> outcomes{};

  double error(std::size_t k) const { return outcomes[k].result / formula - 1.0; }
  bool holds() const { return !gate || std::abs(error(outcomes.size() - 1)) <= *gate; }

  static void print_head() {
    examples::print(stdout, "{:<34} {:>8} {:>6} {:>10} {:>10} {:>8} {:>5} {:>10} {:>5} {:>5} {:>7}\n", "", "elements",
                    "dofs", "result", "formula", "error %", "order", "limit", "steps", "iter", "seconds");
  }

  /// order: of the error between a mesh and the one before; limit: of the last three results if they approach it at one
  /// rate
  void print() const {
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      auto const& one = outcomes[k];
      examples::print(stdout, "{:<34} {:8} {:6} {:10.5g} {:10.5g} {:8.3f} {:>5} {:>10} {:5} {:5} {:7.2f}{}\n",
                      k == 0 ? what : "", one.elements, one.dofs, one.result, formula, 100.0 * error(k), order(k),
                      limit(k), one.run.steps, one.run.iterations, one.seconds,
                      (one.note.empty() ? "" : "  " + one.note) + (k + 1 < outcomes.size() ? "" : mark()));
    }
    std::fflush(stdout);
  }

 private:
  std::string order(std::size_t k) const {
    if (k == 0 || std::abs(error(k)) < 1e-6 || error(k - 1) * error(k) <= 0.0) return "";
    return fmt::format("{:.2f}", std::log2(error(k - 1) / error(k)));
  }
  std::string limit(std::size_t k) const {
    if (k < 2) return "";
    double const before = outcomes[k - 1].result - outcomes[k - 2].result;
    double const last = outcomes[k].result - outcomes[k - 1].result;
    if (!(last / before > 0.0 && last / before < 0.9)) return "";
    return fmt::format("{:.5g}", outcomes[k].result + last * last / (before - last));
  }
  std::string mark() const {
    if (!gate) return "";
    return fmt::format("  {} {:g} %", holds() ? "within" : "MISSES", 100.0 * *gate);
  }
};

}  // namespace examples
