// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <map>

#include "ring.hpp"

namespace thick_cylinder {

/// A circular opening in Mohr-Coulomb ground under an equal pressure from all sides, which is taken from the wall.
/// Closed form: Salencon (1969), with the numbers of the verification problem "Cylindrical hole in an infinite
/// Mohr-Coulomb medium" of FLAC and 3DEC (Itasca).
struct Opening {
  double radius = 1.0;         ///< a [m]
  double outer = 50.0;         ///< where the mesh ends and the pressure far away acts [m]
  double far_pressure = 30e6;  ///< [Pa]
  double cohesion = 3.45e6;    ///< [Pa]
  double friction = examples::radians(30.0);
  double dilation = examples::radians(30.0);
  double young = 6.78e9;  ///< [Pa]
  double poisson = 0.21;

  double passive() const { return (1.0 + std::sin(friction)) / (1.0 - std::sin(friction)); }
  /// q / (K - 1), with the strength q of an unconfined specimen.
  double shift() const { return 2.0 * cohesion * std::sqrt(passive()) / (passive() - 1.0); }

  /// \f$ R_0/a = \left[\frac{2}{K+1}\,\frac{p_0 + q/(K-1)}{q/(K-1)}\right]^{1/(K-1)} \f$ without support of the wall.
  double plastic_radius() const {
    return radius * std::pow(2.0 / (passive() + 1.0) * (far_pressure + shift()) / shift(), 1.0 / (passive() - 1.0));
  }

  /// Compression is negative.
  PolarStress stress(double r) const {
    auto const yielding = [&](double at) { return shift() * (std::pow(at / radius, passive() - 1.0) - 1.0); };
    double const border = plastic_radius();
    if (r < border) return {-yielding(r), -(passive() * (yielding(r) + shift()) - shift())};
    double const drop = (far_pressure - yielding(border)) * border * border / (r * r);
    return {-far_pressure + drop, -far_pressure - drop};
  }
};

struct Excavated {
  examples::Outcome outcome;  ///< plastic radius over that of the opening
  double stress_error = 0.0;  ///< root of the mean square over the points within 3 a, over the pressure far away
};

/// Where the plastic shear strain of the points, by their distance from the centre, falls to zero: a straight line
/// through the outermost two distances that have some.
inline double radius_of_yielding(std::vector<std::pair<double, double>> const& plastic_shear) {
  std::map<long, std::pair<double, double>> rings;  // by distance, rounded
  for (auto const& [radius, shear] : plastic_shear) {
    auto& [at, most] = rings[std::lround(1e6 * radius)];
    at = radius;
    most = std::max(most, shear);
  }
  std::pair<double, double> last{0.0, 0.0};
  std::pair<double, double> before{0.0, 0.0};
  for (auto const& [key, ring] : rings) {
    if (ring.second <= 1e-9) break;
    before = last;
    last = ring;
  }
  return last.first + last.second * (last.first - before.first) / (before.second - last.second);
}

/// cells: of a quarter along its arc; twice as many per doubling of the radius
template <class Element, class Scheme>
Excavated excavate(Opening const& opening, int cells) {
  examples::Stopwatch const watch;
  using Rock = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
  Rock const rock{.elasticity = scarp::IsotropicElasticity::from_young_poisson(opening.young, opening.poisson),
                  .strength = {{opening.cohesion, opening.friction, opening.dilation}},
                  .initial = {.surcharge = opening.far_pressure}};
  double const ratio = opening.outer / opening.radius;
  QuarterRing const ring{opening.radius, opening.outer,
                         static_cast<int>(std::lround(cells * std::log(ratio) / (std::numbers::pi / 4.0))), cells};
  examples::PlaneGrid<Element, Scheme> grid(ring.mesh<Element>());
  auto const& mesh = grid.mesh();
  std::vector<scarp::Vector<2>> places;
  for (int point = 0; point < grid.point_count(); ++point) places.push_back(grid.site(point, 0.0).position);
  auto const constraints = symmetric(mesh);
  // The loads that keep the first state in equilibrium are those of the pressure on wall and far boundary.
  std::vector<scarp::VoigtStress<2>> const first(static_cast<std::size_t>(grid.point_count()), rock.initial.at(0.0));
  Eigen::VectorXd far;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), first, far);
  Eigen::VectorXd wall = Eigen::VectorXd::Zero(grid.dof_count());
  for (int const node : boundary_nodes(mesh, "left")) wall.segment<2>(2 * node).swap(far.segment<2>(2 * node));
  scarp::LoadHistory loads(far);
  loads.add(wall, scarp::TimeFunction({{0.0, 1.0}, {1.0, 0.0}}));
  auto problem = examples::plane_problem(std::move(grid), rock, opening.outer, constraints, loads);
  examples::Newton const newton{.tolerance = 1e-8, .rule = {.exact = {.floor = 1e-9}}};
  scarp::LoadStepping const stepping{.first = 0.1, .smallest = 1e-5, .largest = 0.1, .max_displacement_gradient = 1e3};
  scarp::NoObserver no_observer;
  auto const run = stepping.run(newton, problem, 0.0, 1.0, no_observer);

  auto const& done = problem.discretisation();
  auto const stresses = problem.committed_stresses();
  std::vector<std::pair<double, double>> plastic_shear;
  double square = 0.0;
  int compared = 0;
  for (int point = 0; point < done.point_count(); ++point) {
    auto const& place = places[static_cast<std::size_t>(point)];
    double const from_centre = place.norm();
    plastic_shear.emplace_back(from_centre, problem.points().template state<Rock::State>(point).plastic_shear);
    if (from_centre > 3.0 * opening.radius) continue;
    PolarStress const found(stresses[static_cast<std::size_t>(point)], place);
    PolarStress const exact = opening.stress(from_centre);
    square += std::pow(found.radial - exact.radial, 2) + std::pow(found.hoop - exact.hoop, 2);
    compared += 2;
  }
  return {{static_cast<int>(done.mesh().elements.size()), done.dof_count(),
           radius_of_yielding(plastic_shear) / opening.radius, run, watch.seconds()},
          std::sqrt(square / compared) / opening.far_pressure};
}

}  // namespace thick_cylinder
