// SPDX-License-Identifier: BSL-1.0
#include "../../examples/strip_footing/footing.hpp"

#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "subjects.hpp"
#include "sweep.hpp"

namespace error_vs_time {

namespace {

using strip_footing::Footing;

enum class Kind { quad8_reduced, quad4, quad4_b_bar, tri6 };

struct FootingSettings {
  Kind element = Kind::quad8_reduced;
  double size = 0.04;       ///< of the cells at the footing's edge over its half width
  double tolerance = 1e-7;  ///< of the force residual
  double load_step = 0.16;  ///< largest, over the settlement at the end of the run
  bool to_collapse = true;  ///< else to a small settlement, in steps of one size
};

/// A rough strip footing on clay or on ground with 20 degrees of friction and dilation.
Footing footing(bool clay) {
  double const friction = clay ? 0.0 : examples::radians(20.0);
  return {.friction = friction, .dilation = friction, .rough = true};
}

/// Settlements of the surface beside the footing at fixed places, linear between nodes [m].
template <class Mesh>
Eigen::VectorXd heave(Mesh const& mesh, std::vector<scarp::Vector<2>> const& positions) {
  std::vector<std::pair<double, double>> surface;
  for (auto const* part : {"footing", "top"}) {
    for (int const node : boundary_nodes(mesh, part)) {
      auto const n = static_cast<std::size_t>(node);
      surface.emplace_back(mesh.nodes[n].x(), positions[n].y() - mesh.nodes[n].y());
    }
  }
  std::sort(surface.begin(), surface.end());
  constexpr int places = 12;
  Eigen::VectorXd found(places);
  for (int k = 0; k < places; ++k) {
    double const x = 1.25 * Footing::half_width + 0.2 * k;
    auto const after = std::upper_bound(surface.begin(), surface.end(), std::pair(x, 1e9));
    auto const before = std::prev(after);
    double const share = (x - before->first) / (after->first - before->first);
    found(k) = before->second + share * (after->second - before->second);
  }
  return found;
}

template <class Element, class Scheme, class Rule>
Measured press_with(Footing const& footing, FootingSettings const& settings, Rule const& rule) {
  using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
  double const pressure = footing.bearing_pressure();
  Soil const soil{.elasticity = scarp::IsotropicElasticity::from_young_poisson(1e5 * pressure, 0.3),
                  .strength = {{footing.cohesion, footing.friction, footing.dilation}},
                  .initial = {}};
  strip_footing::Grading const grading{.at_edge = settings.size, .growth = 0.5 * settings.size / 0.04};
  examples::PlaneGrid<Element, Scheme> grid(strip_footing::half_space<Element>(footing, grading));
  auto const& mesh = grid.mesh();
  scarp::Constraints constraints(mesh);
  for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
  for (auto const* side : {"left", "right"})
    for (int const node : boundary_nodes(mesh, side)) constraints.fix(node, 0);
  auto const below = boundary_nodes(mesh, "footing");
  for (int const node : below) {
    constraints.fix(node, 0);
    constraints.move(node, 1, -1e-3 * Footing::half_width);
  }
  Eigen::VectorXd const loads = Eigen::VectorXd::Zero(grid.dof_count());
  auto problem = examples::plane_problem(std::move(grid), soil, 0.0, constraints, scarp::LoadHistory(loads));
  scarp::QuasiNewton<Rule> const solver{
      .tolerance = settings.tolerance, .max_iterations = 40, .divergence_limit = 1e3, .rule = rule};
  double const to = settings.to_collapse ? 0.25 : 0.02;  // of the motion
  double const step = settings.load_step * to;
  scarp::LoadStepping const stepping{.first = settings.to_collapse ? 0.1 * step : step,
                                     .smallest = settings.to_collapse ? 1e-5 : 1e-9,
                                     .largest = step,
                                     .max_displacement_gradient = 1e3,
                                     .grow_below = 10,
                                     .shrink_above = 14};
  Measured measured;
  strip_footing::Plateau plateau{below, loads};
  scarp::NoObserver no_observer;
  auto const run = settings.to_collapse ? stepping.run(solver, problem, 0.0, to, plateau)
                                        : stepping.run(solver, problem, 0.0, to, no_observer);
  measured.inner_steps = run.iterations;
  measured.verdict = run.verdict;
  if (settings.to_collapse) {
    // The run ends itself once the load has stopped rising.
    if (run.verdict.reason == scarp::Reason::interrupted) measured.verdict = {};
    if (measured.verdict.acceptable() && !(plateau.slope < 0.02))
      measured.verdict = {scarp::Status::not_converged, scarp::Reason::unreachable};
    measured.add("bearing factor", plateau.pressure / footing.cohesion);
    return measured;
  }
  double const now = -examples::support_force(problem, below, 1, loads) / Footing::half_width;
  measured.add("bearing pressure", now / footing.cohesion);
  measured.add("heave", heave(problem.discretisation().mesh(), problem.discretisation().positions()));
  return measured;
}

template <class Element, class Scheme>
Measured press(Footing const& footing, FootingSettings const& settings) {
  return press_with<Element, Scheme>(footing, settings, scarp::ConsistentTangent{.floor = 1e-8});
}

Measured press_any(Footing const& footing, FootingSettings const& settings) {
  using scarp::FullIntegration;
  switch (settings.element) {
    case Kind::quad4: return press<scarp::Quad4, FullIntegration>(footing, settings);
    case Kind::quad4_b_bar: return press<scarp::Quad4, scarp::BBar>(footing, settings);
    case Kind::tri6: return press<scarp::Tri6, FullIntegration>(footing, settings);
    case Kind::quad8_reduced: break;
  }
  return press<scarp::Quad8, scarp::ReducedIntegration>(footing, settings);
}

/// Elements on finer and finer meshes; tolerances, load steps and tangents of the one that does not lock.
SweepTable to_collapse(Options const& options, bool clay) {
  Footing const ground = footing(clay);
  FootingSettings const base{.size = 0.04};
  Sweep sweep(clay ? "strip footing on clay" : "strip footing, 20 degrees", base,
              [=](FootingSettings const& settings) { return press_any(ground, settings); });
  Measured exact;
  exact.add("bearing factor", ground.cohesion_factor());
  sweep.exact(exact);
  std::pair<char const*, Kind> const kinds[] = {{"Quad8 reduced", Kind::quad8_reduced},
                                                {"Tri6", Kind::tri6},
                                                {"Quad4 B-bar", Kind::quad4_b_bar},
                                                {"Quad4", Kind::quad4}};
  for (auto const& [name, kind] : kinds) {
    std::vector<double> sizes{0.08, 0.04, 0.02};
    if (!options.quick && clay && kind == Kind::quad8_reduced) sizes.push_back(0.01);
    sweep.vary(
        fmt::format("{}, cell at the edge", name),
        [kind = kind](FootingSettings& settings, double size) {
          settings.element = kind;
          settings.size = size;
        },
        sizes);
  }
  sweep.vary("largest load step", &FootingSettings::load_step, {0.64, 0.32, 0.08, 0.04});
  sweep.vary("force tolerance", &FootingSettings::tolerance, {1e-2, 1e-3, 1e-4, 1e-5});
  return sweep.run(options.repetitions_or(1));
}

SweepTable clay_footing(Options const& options) { return to_collapse(options, true); }
SweepTable frictional_footing(Options const& options) { return to_collapse(options, false); }

/// Load steps and meshes while yielding is contained.
SweepTable before_collapse(Options const& options) {
  Footing const ground = footing(false);
  FootingSettings const base{.size = 0.04, .tolerance = 1e-7, .load_step = 0.125, .to_collapse = false};
  Sweep sweep("strip footing before collapse", base,
              [=](FootingSettings const& settings) { return press_any(ground, settings); });
  auto best = base;
  best.size = 0.02;
  best.load_step = options.quick ? 1.0 / 64.0 : 1.0 / 256.0;
  std::vector<double> steps{0.125, 0.0625, 0.03125};
  if (!options.quick) steps.insert(steps.end(), {0.015625, 0.0078125});
  sweep.reference(best);
  sweep.vary(
      "load step, finest mesh",
      [=](FootingSettings& settings, double step) {
        settings = best;
        settings.load_step = step;
      },
      steps);
  sweep.vary("cell at the edge, finest step",
             [=](FootingSettings& settings, double size) {
               settings = best;
               settings.size = size;
             },
             {0.16, 0.08, 0.04});
  sweep.vary("force tolerance", &FootingSettings::tolerance, {1e-2, 1e-3, 1e-4, 1e-6});
  return sweep.run(options.repetitions_or(1));
}

bool const registered_clay = register_subject(
    {.name = "strip_footing_clay",
     .question = "which mesh, element, load step and tolerance find 2 + pi below a rough strip footing?",
     .run = clay_footing});
bool const registered_friction = register_subject({.name = "strip_footing_friction",
                                                   .question = "the same for Nc at 20 degrees of friction",
                                                   .run = frictional_footing});
bool const registered_before =
    register_subject({.name = "strip_footing_before_collapse",
                      .question = "how fast do load steps and meshes of Mohr-Coulomb converge?",
                      .run = before_collapse});

}  // namespace

}  // namespace error_vs_time
