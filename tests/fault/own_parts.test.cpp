// SPDX-License-Identifier: BSL-1.0
// A ground, a motion of the bedrock and a structure of one's own: what follows stands in this file alone.
#include <doctest/doctest.h>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/fault/fault_scene.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/approx.hpp"

namespace {

/// A box of quadrilaterals.
struct BoxGround {
  using Element = scarp::Quad8;
  int cells = 4;

  scarp::Mesh<Element> mesh(std::vector<double> const&) const {
    auto made = scarp::BoxMesh<Element>{.lengths = {16.0, 4.0}, .cells = {4 * cells, cells}}.generate();
    made.boundaries["surface"] = made.boundaries.extract("top").mapped();
    return made;
  }
  double surface_level() const { return 4.0; }
};

/// The right side sinks and nothing moves sideways, as above a mine.
struct Subsidence {
  double tip = 8.0;
  scarp::Vector<2> left() const { return scarp::Vector<2>::Zero(); }
  scarp::Vector<2> right() const { return {0.0, -1.0}; }
};

/// A store of goods on part of the surface: pressure only.
struct StripLoad {
  double from = 4.0;       ///< [m]
  double to = 7.0;         ///< [m]
  double pressure = 20e3;  ///< [Pa]

  std::vector<double> edges() const { return {from, to}; }
  template <class Element>
  void put_on(scarp::Mesh<Element>& mesh) const {
    auto& surface = mesh.boundaries["surface"];
    auto const below = [&](auto const& facet) {
      double const x = (mesh.nodes[std::size_t(facet[0])](0) + mesh.nodes[std::size_t(facet[1])](0)) / 2.0;
      return x > from && x < to;
    };
    std::copy_if(surface.begin(), surface.end(), std::back_inserter(mesh.boundaries["store"]), below);
  }
  static constexpr double start() { return -1.0; }
  template <class Grid>
  void add_loads(Grid const& grid, double, scarp::LoadHistory& loads) const {
    loads.add(grid.traction("store", scarp::Vector<2>(0.0, -pressure)), scarp::TimeFunction::ramp(-1.0, 0.0));
  }
  template <class Grid>
  static scarp::NoAttachment attached(Grid const&) {
    return {};
  }
  template <class Soil>
  static auto regions(scarp::Region<Soil> const& soil) {
    return boost::hana::make_tuple(soil);
  }
};

using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;

}  // namespace

TEST_CASE("a ground, a motion and a structure of one's own make a scene without an edit elsewhere") {
  scarp::FaultScene<Soil, StripLoad, scarp::QuasiNewton<>, BoxGround, Subsidence> scene;
  scene.soil = Soil::from_young_poisson(20e6, 0.3, {scene.surcharge, scene.unit_weight, 0.4});
  scene.throw_to = 0.01;
  scarp::SerialExecutor serial;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(serial);
  REQUIRE(scene.settle(problem, no_observer).verdict.acceptable());
  auto const settlement = [&](double x) {
    auto const& grid = problem.discretisation();
    for (int const node : boundary_nodes(grid.mesh(), "surface")) {
      auto const k = static_cast<std::size_t>(node);
      if (std::abs(grid.mesh().nodes[k].x() - x) < 1e-9) return grid.mesh().nodes[k].y() - grid.positions()[k].y();
    }
    return std::nan("");
  };
  CHECK(std::abs(settlement(5.5)) < 1e-9);  // analytic: the ground was at rest
  REQUIRE(scene.place(problem, no_observer).verdict.acceptable());
  double const placed = settlement(5.5);
  // Less than a strip that is loaded everywhere would settle: p H / M with M = 26.9 MPa.
  CHECK(placed > 0.3 * 20e3 * 4.0 / 26.9e6);
  CHECK(placed < 20e3 * 4.0 / 26.9e6);
  REQUIRE(scene.rupture(problem, no_observer).verdict.acceptable());
  CHECK(settlement(15.0) == samples::Approx(0.01).epsilon(0.02));  // the far side sinks by the throw
  CHECK(settlement(1.0) < 0.1 * 0.01);                             // and the near one stays
}
