// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>
#ifdef RVE_LAB_WITH_NLOPT
#include <nlopt.hpp>
#endif

#include "../shared/print.hpp"
#include "evaluation_table.hpp"

namespace rve_lab {

/// The sand itself where it lies within the bounds, else their middle.
inline Eigen::VectorXd start_of(Calibration const& calibration) {
  Eigen::VectorXd shares(static_cast<Eigen::Index>(calibration.free.size()));
  Sand sand = calibration.start;
  for (std::size_t k = 0; k < calibration.free.size(); ++k) {
    double const value = calibration.free[k].of(sand);
    bool const inside = value > calibration.free[k].least && value < calibration.free[k].most;
    shares(static_cast<Eigen::Index>(k)) = inside ? std::clamp(calibration.free[k].share_of(value), 0.1, 0.9) : 0.5;
  }
  return shares;
}

/// Evaluates, prints a line for each evaluation, and keeps the best. A place whose packings cannot be prepared or
/// tested is infeasible.
class Search {
 public:
  Search(Calibration const& calibration, std::filesystem::path const& folder, bool resume)
      : calibration_(calibration),
        team_(calibration.threads),
        table_(folder / "evaluations.csv", calibration, resume) {}

  Evaluation evaluate(Eigen::VectorXd const& shares) {
    auto found = table_.find(shares);
    bool const known = found.has_value();
    if (!known) {
      found = evaluated(calibration_, shares, team_);
      table_.add(*found);
    }
    if (!found->feasible()) {
      reasons_.push_back(found->reason);
    } else {
      if (units_.size() == 0) units_ = units(calibration_, *found);
      double const error = misfit(calibration_, *found, units_);
      largest_ = std::max(largest_, error);
      if (best_.shares.size() == 0 || error < misfit(calibration_, best_, units_)) best_ = *found;
    }
    print(*found, known);
    return *found;
  }

  /// The start itself, else the first feasible place of a sequence that fills the bounds.
  /// \throws InputError where none of them is
  Eigen::VectorXd feasible(Eigen::VectorXd const& start) {
    // As many as a sand has numbers.
    constexpr std::array<unsigned, 20> bases{2,  3,  5,  7,  11, 13, 17, 19, 23, 29,
                                             31, 37, 41, 43, 47, 53, 59, 61, 67, 71};
    if (evaluate(start).feasible()) return start;
    Eigen::VectorXd place = start;
    for (unsigned number = 1; number_ < calibration_.evaluations; ++number) {
      for (Eigen::Index k = 0; k < place.size(); ++k)
        place(k) = 0.1 + 0.8 * halton(number, bases.at(static_cast<std::size_t>(k)));
      if (evaluate(place).feasible()) return place;
    }
    scarp::reject(
        "none of {} evaluations has packings that can be prepared and tested (the first: {}): change the bounds",
        number_, reasons_.front());
  }

  void optimise(Eigen::VectorXd const& start) {
#ifdef RVE_LAB_WITH_NLOPT
    auto const count = static_cast<unsigned>(start.size());
    nlopt::opt optimiser(count > 1 ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA, count);
    optimiser.set_lower_bounds(0.0);
    optimiser.set_upper_bounds(1.0);
    optimiser.set_initial_step(0.25);
    optimiser.set_xtol_abs(0.02);
    optimiser.set_maxeval(std::max(1, calibration_.evaluations - number_));
    auto const objective = [](std::vector<double> const& place, std::vector<double>&, void* self) {
      auto& search = *static_cast<Search*>(self);
      try {
        auto const shares = Eigen::Map<Eigen::VectorXd const>(place.data(), static_cast<Eigen::Index>(place.size()));
        return search.objective(search.evaluate(shares));
      } catch (std::exception const&) {
        search.problem_ = std::current_exception();
        throw nlopt::forced_stop();
      }
    };
    optimiser.set_min_objective(objective, this);
    std::vector<double> place(start.begin(), start.end());
    double least = 0.0;
    try {
      optimiser.optimize(place, least);
    } catch (nlopt::roundoff_limited const&) {  // the scatter: it has come as far as it can
    } catch (nlopt::forced_stop const&) {
      std::rethrow_exception(problem_);
    }
#else
    static_cast<void>(start);
    scarp::reject(
        "this rve_lab does not calibrate (it was built without NLopt): install libnlopt-cxx-dev and build again");
#endif
  }

  Evaluation on_other_seeds(Eigen::VectorXd const& shares) {
    return evaluated(calibration_, shares, team_, calibration_.seeds);
  }
  Evaluation const& best() const { return best_; }
  Eigen::VectorXd const& scale() const { return units_; }
  int evaluations() const { return number_; }
  /// Of the infeasible evaluations.
  std::vector<std::string> const& reasons() const { return reasons_; }
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }

 private:
  /// Squared misfit; of infeasible places more than that of any feasible one so far, so that they attract no search.
  double objective(Evaluation const& one) const {
    if (!one.feasible()) return 2.0 * largest_ * largest_ + 1.0;
    double const error = misfit(calibration_, one, units_);
    return error * error;
  }

  /// Number of the sequence of van der Corput, within 0 and 1.
  static double halton(unsigned number, unsigned base) {
    double value = 0.0;
    for (double digit = 1.0 / base; number > 0; number /= base, digit /= base) value += digit * (number % base);
    return value;
  }

  void print(Evaluation const& one, bool known) {
    std::string line = fmt::format("{:3}:", ++number_);
    for (std::size_t k = 0; k < calibration_.free.size(); ++k)
      line += fmt::format(" {} {:.5g}", calibration_.free[k].name,
                          calibration_.free[k].at(one.shares(static_cast<Eigen::Index>(k))));
    for (std::size_t k = 0; one.feasible() && k < calibration_.observations.size(); ++k) {
      auto const& wanted = calibration_.observations[k];
      auto const at = static_cast<Eigen::Index>(k);
      if (wanted.strain == 0.0)
        line += fmt::format(", {} {:.4g} +- {:.2g}", wanted.name, one.values(at), one.scatter(at));
    }
    line += one.feasible()
                ? fmt::format(", void ratio {:.4f}: misfit {:.2f}", one.void_ratio, misfit(calibration_, one, units_))
                : fmt::format(": infeasible, {}", one.reason);
    evaluated_ += known ? 0 : 1;
    int const all = calibration_.evaluations + 2 * static_cast<int>(calibration_.free.size()) + 2;
    examples::print(stdout, "{}; {}\n", line,
                    known ? "from evaluations.csv"
                          : fmt::format("{:.0f} s, at most {:.0f} s more", seconds(),
                                        seconds() / evaluated_ * std::max(0, all - number_)));
  }

  Calibration const& calibration_;
  scarp::ThreadExecutor team_;
  EvaluationTable table_;
  Eigen::VectorXd units_;
  Evaluation best_;
  double largest_ = 0.0;  ///< misfit of feasible evaluations
  std::vector<std::string> reasons_;
  std::exception_ptr problem_;  ///< NLopt passes on no exceptions but its own
  int number_ = 0;
  int evaluated_ = 0;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace rve_lab
