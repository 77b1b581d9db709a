// SPDX-License-Identifier: BSL-1.0
// What does a soil law of one's own take? Hyperbolic shear in plane strain, and a column of it that is pushed sideways.
#include "../shared/print.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/make_problem.hpp"
#include "scarp/solver/quasi_newton.hpp"

/// \f$ \sigma = (K A + G D)\,\varepsilon,\; G = G_0/(1 + \gamma/\gamma_r),\; \gamma^2 = \varepsilon^T D \varepsilon \f$
/// with A, D for the change of area and of shape. Small strain; the shear stress tends to G_0 gamma_r.
struct HyperbolicShear {
  static constexpr int dim = 2;
  using Matrix = scarp::VoigtTangent<2>;
  struct State {
    scarp::EngineeringStrain<2> strain = scarp::EngineeringStrain<2>::Zero();
  };
  double bulk_modulus = 40e6, shear_modulus = 20e6, reference_strain = 2e-3;  // K, G_0 [Pa], gamma_r
  Matrix area = Matrix{{1.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 0.0, 0.0}};
  Matrix shape = Matrix{{1.0, -1.0, 0.0}, {-1.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  double shear(State const& state) const { return std::sqrt(state.strain.dot(shape * state.strain)); }
  double fall(State const& state) const { return 1.0 + shear(state) / reference_strain; }
  Matrix secant(State const& state) const { return bulk_modulus * area + shear_modulus / fall(state) * shape; }
  State initial_state(scarp::Site<2> const&) const { return {}; }
  scarp::VoigtStress<2> stress(State const& state) const { return secant(state) * state.strain; }
  Matrix tangent(State const& state) const {
    scarp::VoigtStress<2> const across = shape * state.strain / std::max(shear(state), 1e-12);
    double const slope = -shear_modulus / (reference_strain * std::pow(fall(state), 2));  // dG/dgamma
    return secant(state) + slope * shear(state) * across * across.transpose();
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    trial.strain = committed.strain + scarp::to_engineering_strain<2, double>(increment);
    if (increment.allFinite()) return {stress(trial), {}};
    return {stress(committed), {scarp::Status::failed, scarp::Reason::not_finite}};
  }
};
static_assert(scarp::ConstitutiveProvider<HyperbolicShear>);

int main() {
  HyperbolicShear const soil;
  double const height = 10.0, push = 3200.0;  // [m], [N/m3]: four fifths of what the base can carry
  auto const mesh = scarp::BoxMesh<scarp::Quad4>{.lengths = {1.0, height}, .cells = {1, 50}}.generate();
  scarp::Discretisation<scarp::Quad4, scarp::SmallStrain> const grid(mesh);
  scarp::Constraints fixed(mesh);
  for (int node = 0; node < grid.node_count(); ++node) fixed.fix(node, 1);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) fixed.fix(node, 0);
  auto const loads = grid.body_force([&](int) { return scarp::Vector<2>(push, 0.0); });
  scarp::SerialExecutor serial;
  auto const soils = boost::hana::make_tuple(scarp::Region{"soil", soil});
  auto problem = scarp::make_problem(grid, height, soils, fixed, loads, serial);
  scarp::NoObserver no_observer;
  scarp::QuasiNewton<> const newton{.tolerance = 1e-10};
  bool const done = scarp::LoadStepping{}.settle(newton, problem, 0.0, no_observer).verdict.acceptable();
  double const moved = problem.discretisation().positions().back().x() - mesh.nodes.back().x();
  double const a = push / (soil.shear_modulus * soil.reference_strain);  // gamma = gamma_r a z / (1 - a z), summed up:
  double const exact = soil.reference_strain * (-std::log1p(-a * height) / a - height);
  examples::print(stdout, "top moves {:.6f} m, closed form {:.6f} m\n", moved, exact);
  return done && std::abs(moved / exact - 1.0) < 1e-3 ? 0 : 1;
}
