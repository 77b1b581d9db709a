// SPDX-License-Identifier: BSL-1.0
#include "../../examples/biaxial_specimen/rectangle.hpp"

#include <map>
#include <tuple>

#include "../../examples/shared/study/study_sand.hpp"
#include "cpu_time_limit.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/following_pressure.hpp"
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/random_packings.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/measure/sweep.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "subjects.hpp"

namespace error_vs_time {

namespace {

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Source = scarp::SamePacking<Grains>;
using Sand = scarp::DemRve<Grains, Source>;
constexpr double confining = 200e3;  ///< [Pa]
constexpr double thickness = 0.2;    ///< [m], also of the grains

/// A specimen of 5 cm x 10 cm between rough platens, the same dense packing at all points.
struct SpecimenSettings {
  int cells = 4;            ///< over the width, twice as many over the height
  double load_step = 1e-3;  ///< axial strain of a load step
  double tolerance = 1e-3;
  bool along_iterates = false;
  int grains = 60;
  std::uint64_t seed = 1;
  double strain_per_dem_step = 1e-5;
  int least_dem_steps = 20;
  double strain = 0.03;  ///< at the end
  double most_seconds = 150.0;
};

Grains const& prepared(int grains, std::uint64_t seed) {
  static std::map<std::tuple<int, std::uint64_t>, Grains> made;
  std::tuple const key{grains, seed};
  auto const found = made.find(key);
  if (found != made.end()) return found->second;
  auto cloud = examples::study_cloud(grains, seed);
  cloud.thickness = thickness;
  scarp::IsotropicPreparation const preparation{.pressure = confining, .preparation_friction = 0.0};
  auto const law = examples::study_law();
  auto prepared = preparation.prepare(cloud.template make<Grains>(), law);
  if (!prepared.verdict.acceptable())
    scarp::refuse("a packing of {} grains did not settle ({}): choose another seed", grains,
                  name(prepared.verdict.reason));
  return made.emplace(key, std::move(prepared.packing)).first->second;
}

/// Force [N] and mean stress of the body.
template <class Element, class Problem>
void look(Problem const& problem, biaxial_specimen::Sides<Element> const& sides, std::vector<double>& forces,
          std::vector<double>& stresses) {
  auto const& grid = problem.discretisation();
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(grid.dof_count());
  Eigen::VectorXd nodal;
  auto const points = problem.committed_stresses();
  grid.internal_force(still, points, nodal);
  problem.attached().add_forces(grid.positions(), still, nodal);
  double force = 0.0;
  for (int const node : sides.top) force -= nodal(2 * node + 1);
  forces.push_back(force);
  auto const volumes = grid.volumes(still);
  scarp::VoigtStress<2> sum = scarp::VoigtStress<2>::Zero();
  double volume = 0.0;
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    sum += volumes[k] * points[k];
    volume += volumes[k];
  }
  for (double const component : scarp::VoigtStress<2>(sum / volume)) stresses.push_back(component);
}

template <class Element, class Scheme, class Path>
scarp::Measured compress(SpecimenSettings const& settings, int repetition) {
  Sand const sand{.law = examples::study_law(),
                  .source = {prepared(settings.grains, settings.seed + static_cast<std::uint64_t>(repetition))},
                  .strain_per_step = settings.strain_per_dem_step,
                  .least_steps = settings.least_dem_steps,
                  .loose_pressure = confining / 100.0};
  auto mesh = scarp::BoxMesh<Element>{.lengths = {0.05, 0.1}, .cells = {settings.cells, 2 * settings.cells}}.generate();
  auto const sides = biaxial_specimen::find_sides(mesh);
  using Grid = scarp::Discretisation<Element, scarp::UpdatedLagrangian, Scheme>;
  using Lateral = scarp::FollowingPressure<typename Element::Facet>;
  Grid grid(std::move(mesh), thickness);
  scarp::Constraints constraints(grid.mesh());
  for (int const node : sides.bottom) constraints.fix(node);
  for (int const node : sides.top) {
    constraints.fix(node, 0);
    constraints.move(node, 1, -sides.height);
  }
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, sides.top_level));
  using Field = scarp::ProviderField<Sand>;
  static scarp::SerialExecutor executor;
  int const dofs = grid.dof_count();
  scarp::EquilibriumProblem<Grid, Field, scarp::SerialExecutor, Lateral> problem(
      std::move(grid), Field(sand, sites), std::move(constraints), scarp::LoadHistory(Eigen::VectorXd::Zero(dofs)),
      executor, Lateral(sides.lateral, confining, thickness));

  using Solver = scarp::QuasiNewton<scarp::PointSecant, scarp::PlainStep, scarp::SparseLu, Path>;
  Solver const solver{.tolerance = settings.tolerance, .most_iterations = 60};
  scarp::LoadStepping const stepping{.first = settings.load_step,
                                     .smallest = settings.load_step / 40.0,
                                     .largest = settings.load_step,
                                     .largest_gradient = 0.05,
                                     .few = 60,
                                     .many = 60};
  CpuTimeLimit limit(settings.most_seconds);
  scarp::CpuTime const time;
  auto report = stepping.settle(solver, problem, 0.0, limit);
  typename Solver::template Session<decltype(problem)> session(solver, problem);
  std::vector<double> forces;
  std::vector<double> stresses;
  constexpr int rows = 6;
  for (int row = 0; row < rows && report.verdict.acceptable(); ++row) {
    report = scarp::joined(report, stepping.advance(session, problem, settings.strain * row / rows,
                                                    settings.strain * (row + 1) / rows, limit));
    look(problem, sides, forces, stresses);
  }
  scarp::Measured measured;
  measured.seconds = time.seconds();
  measured.inner_steps = report.inner_steps;
  measured.verdict = report.verdict;
  auto const values = [](std::vector<double> const& list) {
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd const>(list.data(), std::ssize(list)));
  };
  measured.answer("top force", values(forces));
  measured.answer("mean stress", values(stresses));
  return measured;
}

scarp::Measured compress_tri3(SpecimenSettings const& settings, int repetition) {
  using scarp::FullIntegration;
  if (settings.along_iterates)
    return compress<scarp::Tri3, FullIntegration, scarp::AlongIterates>(settings, repetition);
  return compress<scarp::Tri3, FullIntegration, scarp::FromCommitted>(settings, repetition);
}
template <class ElementType, class SchemeType>
struct Kind {
  using Element = ElementType;
  using Scheme = SchemeType;
};

scarp::SweepTable specimen(Options const& options) {
  SpecimenSettings base;
  if (options.quick) {
    base.cells = 2;
    base.grains = 40;
    base.strain = 0.006;
  }
  scarp::Sweep sweep("biaxial specimen", base, compress_tri3);
  auto tight = base;
  tight.load_step = base.load_step / 4.0;
  tight.tolerance = 1e-4;
  tight.strain_per_dem_step = 3e-6;
  sweep.reference(tight);
  sweep.vary("load step", &SpecimenSettings::load_step, {5e-3, 2.5e-3, 5e-4, 2.5e-4});
  sweep.vary("force tolerance", &SpecimenSettings::tolerance, {3e-2, 1e-2, 3e-3, 3e-4});
  sweep.vary("strain per DEM step", &SpecimenSettings::strain_per_dem_step, {1e-4, 3e-5, 3e-6});
  sweep.vary("least DEM steps", &SpecimenSettings::least_dem_steps, {5, 80});
  sweep.vary("along iterates, load step",
             [](SpecimenSettings& settings, double step) {
               settings.along_iterates = true;
               settings.load_step = step;
             },
             {2.5e-3, 1e-3, 2.5e-4});
  sweep.vary(
      "cells over the width",
      [](SpecimenSettings& settings, double cells) { settings.cells = static_cast<int>(cells); },
      options.quick ? std::vector{1.0, 3.0} : std::vector{2.0, 3.0, 6.0});
  using scarp::FullIntegration;
  using scarp::ReducedIntegration;
  sweep.vary_over<Kind<scarp::Quad4, FullIntegration>, Kind<scarp::Quad8, ReducedIntegration>>(
      "element", {"Quad4", "Quad8 reduced"}, [](auto kind, SpecimenSettings const& settings, int repetition) {
        using Chosen = decltype(kind);
        return compress<typename Chosen::Element, typename Chosen::Scheme, scarp::FromCommitted>(settings, repetition);
      });
  sweep.vary_sample(
      "grains", [](SpecimenSettings& settings, double grains) { settings.grains = static_cast<int>(grains); },
      options.quick ? std::vector{20.0} : std::vector{30.0, 120.0});
  return sweep.run(options.repetitions_or(2));
}

bool const registered =
    register_subject({.name = "biaxial_specimen",
                      .question = "what do load steps, tolerances and meshes of a specimen of packings leave?",
                      .run = specimen});

}  // namespace

}  // namespace error_vs_time
