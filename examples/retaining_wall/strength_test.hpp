// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "run.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/homogenise/balance.hpp"

namespace retaining_wall {

/// Stresses of a biaxial test, means over the strain since the row before [Pa], positive in compression.
struct TestRow {
  double strain = 0.0;  ///< logarithmic, along the axis that is compressed
  double horizontal = 0.0;
  double vertical = 0.0;

  double ratio() const { return horizontal / vertical; }
};

/// Drained biaxial test on a packing from the stress that it has at rest: for the active case the vertical is
/// compressed while the horizontal stress is held, for the passive one the other way round; no shear stress, as beside
/// smooth walls.
/// \throws PreparationError when the packing cannot follow
template <class PackingType, class Damping>
std::vector<TestRow> biaxial_test(PackingType packing, typename PackingType::Law const& law, Damping const& damping,
                                  Movement movement, double strain, double strain_per_step) {
  constexpr double strain_per_row = 2.5e-4;
  int const axis = movement == Movement::active ? 1 : 0;
  scarp::Tensor<2> const start = scarp::balance(packing, law).stress;
  scarp::Loading<2> loading;
  loading.gradient_per_step(axis, axis) = -strain_per_step;
  loading.controls = {scarp::component_control<2>(1 - axis, start(1 - axis, 1 - axis)),
                      scarp::component_control<2>(2, 0.0)};
  scarp::TimeStepper<PackingType, Damping> stepper;
  stepper.damping = damping;
  scarp::CellDriver<PackingType> drive(packing, law, loading);
  std::vector<TestRow> rows{{0.0, -start(0, 0), -start(1, 1)}};
  long const steps_per_row = std::lround(strain_per_row / strain_per_step);
  long const steps = std::lround(strain / strain_per_step);
  scarp::Tensor<2> sum = scarp::Tensor<2>::Zero();
  for (long step = 1; step <= steps; ++step) {
    if (auto const verdict = drive.step(stepper); !verdict.acceptable()) {
      throw scarp::PreparationError(fmt::format("a biaxial test stopped at the strain {} ({}): try another seed",
                                                rows.back().strain, name(verdict.reason)));
    }
    sum += drive.seen().stress / static_cast<double>(steps_per_row);
    if (step % steps_per_row != 0) continue;
    rows.push_back({static_cast<double>(step) * strain_per_step, -sum(0, 0), -sum(1, 1)});
    sum.setZero();
  }
  return rows;
}

inline Curve curve_of(std::vector<TestRow> const& rows) {
  Curve curve;
  for (auto const& row : rows) curve.add(row.strain, row.ratio());
  return curve;
}

/// Strength of packings from all depths together, as a wall sees it: of the sums of their stresses, in the window of
/// strain where their ratio is extreme. The scatter s is that of all single rows of all n packings in this window. The
/// wall takes as many packings along another path: the difference of two such means has the standard deviation
/// \f$ s\sqrt{2/n} \f$ if they are independent, and twice this is allowed.
inline Friction friction_of(std::vector<std::vector<TestRow>> const& tests, Movement movement) {
  auto sums = tests.front();
  for (std::size_t k = 1; k < tests.size(); ++k) {
    for (std::size_t row = 0; row < sums.size(); ++row) {
      sums[row].horizontal += tests[k][row].horizontal;
      sums[row].vertical += tests[k][row].vertical;
    }
  }
  Friction friction{.tests = {curve_of(sums)}};
  auto const found = extreme(friction.tests.front(), movement);
  friction.angle = mobilised(found.ratio);
  double squares = 0.0;
  double count = 0.0;
  for (auto const& test : tests) {
    friction.tests.push_back(curve_of(test));
    for (auto const& row : test) {
      if (row.strain <= found.strain || row.strain > found.strain + window) continue;
      double const away = mobilised(row.ratio()) - friction.angle;
      squares += away * away;
      count += 1.0;
    }
  }
  friction.scatter = std::sqrt(squares / (count - 1.0));
  friction.allowance = 2.0 * friction.scatter * std::sqrt(2.0 / static_cast<double>(tests.size()));
  friction.source =
      fmt::format("biaxial tests on {} packings, from {:.2f} % strain", tests.size(), 100.0 * found.strain);
  return friction;
}

}  // namespace retaining_wall
