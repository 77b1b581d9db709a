// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/crossed_rectangle.hpp"

/// A block that is pulled or pressed, and materials with every bad habit that a solver must survive.
namespace samples {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline scarp::LinearElastic<2> elastic_soil() { return scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3); }

/// Elasticity that softens smoothly: \f$ \sigma = (r + (1-r) e^{-x^2})\, C \varepsilon,\; x =
/// |\varepsilon|/\varepsilon_0,\; r = 0.2 \f$ of the total strain. In one dimension its slope falls to \f$ r - 2 (1-r)
/// e^{-3/2} = -0.16 \f$ of the elastic
/// one: a peak, but too mild for the rest of a block to snap back. The tangent that it tells is elastic, as a
/// packing's.
struct Softening {
  static constexpr int dim = 2;
  struct State {
    int point = 0;
    scarp::EngineeringStrain<2> strain = scarp::EngineeringStrain<2>::Zero();
    friend bool operator==(State const& a, State const& b) { return a.point == b.point && a.strain == b.strain; }

    SCARP_MEMBERS_EXCEPT((point), strain)
  };

  double reference_strain = infinity;   ///< infinite: linear
  double largest_strain = infinity;     ///< total, beyond which there is no answer
  double largest_increment = infinity;  ///< of strain, beyond which there is no answer
  int silent_point = -1;                ///< point that answers NaN beyond the largest strain and calls it ok

  State initial_state(scarp::Site<2> const& site) const { return {site.index}; }

  scarp::VoigtTangent<2> tangent(State const&) const { return elastic_soil().tangent({}); }

  scarp::VoigtStress<2> stress(State const& state) const {
    constexpr double rest = 0.2;
    double const intact = std::exp(-std::pow(state.strain.norm() / reference_strain, 2));
    return (rest + (1.0 - rest) * intact) * elastic_soil().tangent({}) * state.strain;
  }

  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    trial = committed;
    auto const change = scarp::to_engineering_strain<2, double>(increment);
    trial.strain += change;
    if (trial.strain.norm() > largest_strain && trial.point == silent_point) {
      return {scarp::VoigtStress<2>::Constant(std::numeric_limits<double>::quiet_NaN()), {}};
    }
    if (silent_point < 0 && (trial.strain.norm() > largest_strain || change.norm() > largest_increment)) {
      return {stress(committed), {scarp::Status::failed, scarp::Reason::cell_collapsed}};
    }
    return {stress(trial), {}};
  }
};

/// Linear elasticity that is `not_converged` until its plan is large enough, and writes down each call's plan.
struct Planning {
  static constexpr int dim = 2;
  using State = Softening::State;
  using Plan = int;
  struct Call {
    int point;
    Plan plan;
  };

  int needed = 0;  ///< plan from which a response counts as converged
  std::shared_ptr<std::vector<Call>> calls = std::make_shared<std::vector<Call>>();
  Softening law{};

  State initial_state(scarp::Site<2> const& site) const { return law.initial_state(site); }
  /// Twice too stiff in shear, so that a solver that believes it must iterate.
  scarp::VoigtTangent<2> tangent(State const& state) const {
    scarp::VoigtTangent<2> tangent = law.tangent(state);
    tangent(2, 2) *= 2.0;
    return tangent;
  }
  scarp::VoigtStress<2> stress(State const& state) const { return law.stress(state); }

  Plan plan(State const&, scarp::Gradient<2> const& increment) const {
    return 1 + static_cast<int>(1e7 * increment.norm());
  }
  Plan refined(Plan plan) const { return 2 * plan; }

  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return respond(committed, increment, trial, plan(committed, increment));
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial,
                             Plan plan) const {
    calls->push_back({committed.point, plan});
    auto response = law.respond(committed, increment, trial);
    if (plan < needed) response.verdict = {scarp::Status::not_converged, scarp::Reason::unbalanced};
    return response;
  }
};

/// A tangent rule of a user's: the provider's tangent at the start of a step, unchanged while it iterates (modified
/// Newton).
struct Frozen {
  template <int Dim>
  scarp::VoigtTangent<Dim> start(scarp::VoigtTangent<Dim> const& provider, scarp::VoigtTangent<Dim> const&) const {
    return provider;
  }
  template <int Dim>
  scarp::VoigtTangent<Dim> update(scarp::VoigtTangent<Dim> const& tangent, scarp::VoigtTangent<Dim> const&,
                                  scarp::EngineeringStrain<Dim> const&, scarp::VoigtStress<Dim> const&) const {
    return tangent;
  }
};

static_assert(scarp::TangentRule<Frozen, 2> && scarp::TangentRule<Frozen, 3>);
static_assert(scarp::ConstitutiveProvider<Softening> && !scarp::HasPlan<Softening> && scarp::HasPlan<Planning>);

/// Block of 1 m x 1 m, fixed at the bottom; its top moves up by the load factor [m], or is free.
template <class Provider, class Motion = scarp::SmallStrain>
struct Block {
  using Grid = scarp::Discretisation<scarp::Tri3, Motion>;
  using Problem = scarp::EquilibriumProblem<Grid>;

  static Problem make(Provider provider, scarp::SerialExecutor& executor, bool moved_top = true) {
    Grid grid(samples::CrossedRectangle{.columns = 3, .rows = 2}.generate());
    scarp::Constraints constraints(grid.mesh());
    for (int const node : scarp::boundary_nodes(grid.mesh(), "bottom")) constraints.fix(node);
    for (int const node : scarp::boundary_nodes(grid.mesh(), "top")) {
      if (moved_top) constraints.move(node, 1, 1.0);
    }
    std::vector<scarp::Site<2>> sites;
    for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(grid.dof_count());
    return {std::move(grid), {std::move(provider), sites}, std::move(constraints), std::move(loads), executor};
  }
};

/// What must never change unless a step is accepted.
template <class Problem>
struct Committed {
  std::vector<scarp::Vector<2>> positions;
  std::vector<std::string> states;  ///< their bits

  explicit Committed(Problem const& problem) : positions(problem.discretisation().positions()) {
    for (int k = 0; k < problem.points().size(); ++k) states.push_back(problem.points().pack(k));
  }
  friend bool operator==(Committed const&, Committed const&) = default;
};

/// Keeps all reports, checks that a refused attempt left the committed state alone, and may stop a run.
template <class Problem>
struct Witness {
  Committed<Problem> committed;
  int stop_after = std::numeric_limits<int>::max();  ///< attempts
  std::vector<scarp::StepReport> reports{};
  int changed_by_refused = 0;
  int unchanged_by_accepted = 0;

  void attempted(Problem const& problem, scarp::StepReport const& report) {
    reports.push_back(report);
    Committed<Problem> const now(problem);
    bool const same = now == committed;
    if (report.verdict.acceptable()) {
      unchanged_by_accepted += same ? 1 : 0;
    } else {
      changed_by_refused += same ? 0 : 1;
    }
    committed = now;
  }
  bool wants_stop() const { return static_cast<int>(reports.size()) >= stop_after; }
};

template <class Problem>
Witness<Problem> watch(Problem const& problem) {
  return {Committed<Problem>(problem)};
}

}  // namespace samples
