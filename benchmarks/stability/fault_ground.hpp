// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numbers>

#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/core/nan_max.hpp"
#include "scarp/fault/free_field_fault.hpp"

namespace stability {

using FaultSoil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
using FaultNewton = scarp::QuasiNewton<>;

/// Cohesive-frictional ground over a fault, coarse: what the cases change are its members.
struct FaultGround : scarp::FreeFieldFault<FaultSoil, FaultNewton> {
  double largest_part = 1e-2;  ///< of the depth, that one step may add to the throw

  FaultGround() {
    constexpr double degree = std::numbers::pi / 180.0;
    layer().size = 5.0;
    soil.elasticity = scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25);
    soil.strength.strength = {.cohesion = 1e3, .friction = 30.8 * degree, .dilation = 6.6 * degree};
    soil.initial.k0 = 0.4;
    solver.tolerance = 1e-10;
    solver.rule.exact.floor = 1e-4;
    throw_to = 0.01 * layer().depth;
  }

  scarp::FaultMesh& layer() { return ground.layer; }
  scarp::FaultMesh const& layer() const { return ground.layer; }

  /// A value for the gravity, surcharge and initial stress alike.
  FaultGround& loaded(double weight, double pressure) {
    unit_weight = weight;
    surcharge = pressure;
    soil.initial.unit_weight = weight;
    soil.initial.surcharge = pressure;
    return *this;
  }

  /// The same ground in other units of length and stress.
  FaultGround in_units(double length, double stress) const {
    FaultGround other = *this;
    for (double* place :
         {&other.layer().left, &other.layer().right, &other.layer().depth, &other.layer().tip, &other.layer().size,
          &other.layer().band_left, &other.layer().band_right, &other.fault.tip, &other.throw_to}) {
      *place *= length;
    }
    other.soil.elasticity.lame_lambda *= stress;
    other.soil.elasticity.shear_modulus *= stress;
    other.soil.strength.strength.cohesion *= stress;
    other.loaded(unit_weight * stress / length, surcharge * stress);
    return other;
  }
};

/// What a run on such ground ends with.
struct FaultResponse {
  scarp::RunReport run;
  std::vector<scarp::Vector<2>> surface;  ///< displacement of the surface's nodes over the depth
  double imbalance = 0.0;                 ///< of vertical reactions and loads, over these or the norm of reactions
  double tension = 0.0;                   ///< largest principal stress [Pa]
};

template <class Problem>
FaultResponse response(FaultGround const& ground, Problem& problem) {
  auto scene = ground;
  scene.stepping.first = 1e-3 / 25.0 * ground.layer().depth;
  scene.stepping.smallest = 1e-7 / 25.0 * ground.layer().depth;
  scene.stepping.largest = ground.largest_part * ground.layer().depth;
  scene.stepping.max_displacement_gradient = 0.02;
  scarp::NoObserver no_observer;
  FaultResponse found;
  auto const settled = scene.settle(problem, no_observer);
  found.run = settled.verdict.acceptable() ? scarp::joined(settled, scene.rupture(problem, no_observer)) : settled;
  auto const& grid = problem.discretisation();
  for (int const node : boundary_nodes(grid.mesh(), "surface")) {
    auto const k = static_cast<std::size_t>(node);
    found.surface.push_back((grid.positions()[k] - grid.mesh().nodes[k]) / ground.layer().depth);
  }
  Eigen::VectorXd forces;
  auto const stresses = problem.committed_stresses();
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), stresses, forces);
  double up = 0.0;
  double down = 0.0;
  double reactions = 0.0;
  Eigen::VectorXd const loads = problem.loads().at(0.0);
  for (int dof = 1; dof < grid.dof_count(); dof += 2) {
    down += loads(dof);
    if (!problem.constraints().is_prescribed(dof)) continue;
    up += forces(dof) - loads(dof);
    reactions = std::hypot(reactions, forces(dof) - loads(dof));
  }
  found.imbalance = std::abs(up + down) / std::max(std::abs(down), reactions);
  for (auto const& stress : stresses) {
    double const mean = (stress(0) + stress(1)) / 2.0;
    found.tension = scarp::nan_max(found.tension, mean + std::hypot((stress(0) - stress(1)) / 2.0, stress(2)));
  }
  return found;
}

inline FaultResponse response(FaultGround const& ground) {
  scarp::SerialExecutor serial;
  auto problem = ground.problem(serial);
  return response(ground, problem);
}

/// Largest difference of the surfaces' displacements over the larger of them; infinite unless both runs arrived.
inline double difference(FaultResponse const& a, FaultResponse const& b) {
  bool const arrived = a.run.verdict.acceptable() && b.run.verdict.acceptable();
  double apart = arrived && a.surface.size() == b.surface.size() ? 0.0 : std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (std::size_t k = 0; k < std::min(a.surface.size(), b.surface.size()); ++k) {
    apart = scarp::nan_max(apart, (a.surface[k] - b.surface[k]).norm());
    most = scarp::nan_max(most, b.surface[k].norm());
  }
  return apart / most;
}

}  // namespace stability
