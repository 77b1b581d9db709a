// SPDX-License-Identifier: BSL-1.0
// Footings: hard and soft interfaces, chatter, uplift, standing on an edge,
// toppling.
#include <fmt/format.h>

#include "scarp/fault/frictional_footing.hpp"
#include "stability/fault_ground.hpp"
#include "stability/stability_case.hpp"

namespace stability {

namespace {

/// A footing on friction with a couple that has an amplitude over the load factor.
struct RockedFooting : scarp::FrictionalFooting<scarp::LinearFrictional> {
  scarp::TimeFunction couple = scarp::TimeFunction::constant(0.0);  ///< counter-clockwise, over weight times width

  template <class Grid>
  void add_loads(Grid const& grid, double surcharge, scarp::LoadHistory& loads) const {
    FrictionalFooting::add_loads(grid, surcharge, loads);
    Eigen::VectorXd turning = Eigen::VectorXd::Zero(loads.size());
    turning(grid.dof_count() + 2) = weight() * footing.width / (footing.width / 2.0);  // the arm is half the width
    loads.add(std::move(turning), couple);
  }
  double weight() const { return footing.bearing * footing.width; }
};

/// Coarse ground below a footing of 10 m; with strong soil it stays elastic.
template <class Structure>
scarp::FaultScene<FaultSoil, Structure, FaultNewton> scene_with(Structure const& structure, bool strong) {
  FaultGround ground;
  ground.loaded(15.68e3, 4e3);
  if (strong) ground.soil.strength.strength.cohesion = 1e9;
  scarp::FaultScene<FaultSoil, Structure, FaultNewton> scene;
  scene.soil = ground.soil;
  scene.ground = ground.ground;
  scene.solver = ground.solver;
  scene.structure = structure;
  scene.stepping.max_displacement_gradient = 0.02;
  scene.stepping.largest = 0.25;
  return scene;
}

/// How a footing has moved when a run ends, and why it ends.
struct Stand {
  scarp::RunReport run;
  scarp::FootingMotion motion;
  Watch watch{.most = 1000};
  double lifted = 0.0;  ///< share of the base without pressure
};

/// last: steps of the last stage, in which the fault moves
template <class Scene>
Stand stand(Scene const& scene, scarp::LoadStepping const& last) {
  scarp::SerialExecutor serial;
  auto problem = scene.problem(serial);
  Stand found;
  found.run = scene.settle(problem, found.watch);
  if (found.run.verdict.acceptable()) found.run = scene.place(problem, found.watch);
  if (found.run.verdict.acceptable())
    found.run = scarp::joined(found.run, last.run(scene.solver, problem, 0.0, scene.throw_to, found.watch));
  found.motion = scene.structure.motion(problem);
  double all = 0.0;
  for (auto const& point : found.motion.base) {
    all += point.area;
    found.lifted += point.pressure > 0.0 ? 0.0 : point.area;
  }
  found.lifted /= all;
  return found;
}

std::string words(Stand const& found) {
  return fmt::format(
      "{} (last rejection {}) at load {:.4g}, {} attempts, {} rejected; tilt {:.3g}, lifted {:.2f}  linear residual "
      "{:.1e}",
      name(found.run.verdict.reason), name(found.run.last_failure), found.run.load, found.watch.attempts,
      found.run.refused, found.motion.tilt, found.lifted, found.watch.linear_residual);
}

/// Vertical imbalance of the footing, and sideways, over its weight.
double imbalance(Stand const& found, double weight) {
  double sideways = 0.0;
  for (auto const& point : found.motion.base) sideways += point.stress.x() * point.area;
  return std::max(std::abs(support(found.motion) / weight - 1.0), std::abs(sideways) / weight);
}

/// A footing on friction over the fault.
Outcome frictional(double stiffness, double friction, double width, double throw_over_depth, bool must_reach) {
  RockedFooting footing;
  footing.footing.width = width;
  footing.interface = {.normal_stiffness = stiffness, .tangential_stiffness = stiffness, .friction = friction};
  auto scene = scene_with(footing, false);
  scene.throw_to = throw_over_depth * scene.ground.layer.depth;
  // Round-off of places of 25 m times the springs, over the footing's pressure of 91 kPa.
  scene.solver.tolerance = std::max(1e-10, 1e-19 * stiffness);
  auto const found = stand(scene, scene.stepping);
  bool const reached = found.run.verdict.acceptable();
  bool const named = !must_reach && found.run.verdict.reason == scarp::Reason::step_too_small;
  bool const bounded = found.watch.attempts < 1000;
  if (found.run.load < 0.0)
    return {named && bounded, found.run.load, "not placed: load factor, which is 0 once it stands", words(found)};
  auto outcome = at_most(std::max(1e-8, 10.0 * *scene.solver.tolerance), imbalance(found, footing.weight()),
                         "imbalance over weight once placed", words(found));
  outcome.as_expected &= (reached || named) && bounded;
  return outcome;
}

RockedFooting rocked(std::vector<std::pair<double, double>> const& amplitude) {
  RockedFooting footing;
  footing.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = 0.5};
  footing.couple = scarp::TimeFunction(amplitude);
  return footing;
}

/// Rocks a footing on strong ground by couples over W B, one after another; the fault hardly moves.
Stand rock(std::vector<double> const& couples, int steps_each) {
  double const end = 1e-6;
  std::vector<std::pair<double, double>> amplitude{{0.0, 0.0}};
  for (std::size_t k = 0; k < couples.size(); ++k)
    amplitude.emplace_back(end * static_cast<double>(k + 1) / static_cast<double>(couples.size()), couples[k]);
  auto scene = scene_with(rocked(amplitude), true);
  scene.throw_to = end;
  double const step = end / static_cast<double>(steps_each * static_cast<int>(couples.size()));
  return stand(scene, {.first = step, .smallest = 1e-4 * step, .largest = step, .max_displacement_gradient = 0.02});
}

/// Reaches the end in balance, with a share of the base lifted within bounds.
Outcome rocks(std::vector<double> const& couples, int steps_each, double min_lifted, double max_lifted) {
  auto const found = rock(couples, steps_each);
  auto outcome = at_most(1e-8, imbalance(found, rocked({{0.0, 0.0}}).weight()), "imbalance over weight", words(found));
  outcome.as_expected &= found.run.verdict.acceptable() && found.lifted >= min_lifted && found.lifted <= max_lifted;
  return outcome;
}

/// Lifted by half and let down again: as before.
Outcome comes_back() {
  auto const up = rock({0.35, 0.0}, 10);
  auto const still = rock({0.0, 0.0}, 1);
  Worst worst;
  worst.see(up.motion.tilt - still.motion.tilt);
  worst.see((up.motion.settlement - still.motion.settlement) / 10.0);
  // The base slides within its roughness while it rocks: what is left is small against the tilt of 1e-3 between.
  auto outcome = at_most(1e-4, worst.value, "tilt that is left", words(up));
  outcome.as_expected &= up.run.verdict.acceptable() && still.run.verdict.acceptable() && up.lifted == still.lifted;
  return outcome;
}

/// A couple beyond W times the lever of the outermost point has no equilibrium: 1/4 + 1/(4 sqrt(3)) = 0.3943 of the
/// width where two facets of the ground give four points.
Outcome topples() {
  auto const found = rock({0.55}, 20);
  double const couple = found.run.load / 1e-6 * 0.55;
  bool const named = found.run.verdict.reason == scarp::Reason::step_too_small ||
                     found.run.verdict.reason == scarp::Reason::singular_system;
  return {named && couple > 0.38 && couple < 0.395 && found.watch.attempts < 1000, couple,
          "largest couple carried over W B, 0.3943 by the outermost point", words(found)};
}

}  // namespace

Cases footing_cases() {
  Cases cases;
  auto const add = [&](std::string name, std::string expected, auto run) {
    cases.push_back({"footings", std::move(name), std::move(expected), std::move(run)});
  };
  std::string const reaches = "reaches the throw, in balance to 1e-8 of the weight";
  std::string const named = "in balance as far as it comes, if it can be placed; end or step_too_small";
  auto const deep = [](Size size) { return size == Size::quick ? 0.01 : 0.05; };
  for (double const stiffness : {1e6, 1e8, 1e10, 1e12}) {
    bool const usual = stiffness < 1e9;
    add(fmt::format("interface of {:g} Pa/m over the fault", stiffness), usual ? reaches : named,
        [=](Size size) { return frictional(stiffness, 0.5, 10.0, deep(size), usual); });
  }
  add("interface without friction over the fault", named,
      [=](Size size) { return frictional(1e8, 0.0, 10.0, deep(size), false); });
  add("interface with friction 1e-3 over the fault", named,
      [=](Size size) { return frictional(1e8, 1e-3, 10.0, deep(size), false); });
  add("interface with friction 1e6 over the fault", reaches,
      [=](Size size) { return frictional(1e8, 1e6, 10.0, deep(size), true); });
  add("base narrower than a cell", reaches, [](Size) { return frictional(1e8, 0.5, 1.5, 0.005, true); });
  add("uplift of half of the base", "balance to 1e-8 of the weight", [](Size) { return rocks({0.35}, 10, 0.3, 0.8); });
  add("standing on its edge", "balance to 1e-8 of the weight", [](Size) { return rocks({0.39}, 20, 0.45, 0.8); });
  add("uplift and re-contact", "as before the uplift", [](Size) { return comes_back(); });
  add("chatter: couple about the onset of uplift", "balance to 1e-8 of the weight", [](Size size) {
    std::vector<double> couples;
    for (int k = 0; k < (size == Size::quick ? 20 : 200); ++k) couples.push_back(k % 2 == 0 ? 0.25 : 0.15);
    return rocks(couples, 2, 0.0, 0.5);
  });
  add("couple beyond half of weight times width", "step_too_small or singular_system below it",
      [](Size) { return topples(); });
  return cases;
}

}  // namespace stability
