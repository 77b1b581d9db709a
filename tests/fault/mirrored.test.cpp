// SPDX-License-Identifier: BSL-1.0
// The scene seen in a mirror.
#include <doctest/doctest.h>

#include <numbers>

#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/softening_strength.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/scene/nonlocal_scene.hpp"
#include "scarp/solver/consistent_tangent.hpp"

namespace {

using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength>;

/// A jittered layer, or what a mirror at x = 0 shows of it.
struct Ground {
  using Element = scarp::Tri3;

  scarp::FaultMesh layer{.size = 3.5, .jitter = 0.25};
  bool mirrored = false;

  scarp::Mesh<Element> mesh(std::vector<double> const& edges) const {
    auto made = layer.generate<Element>(edges);
    if (!mirrored) return made;
    for (auto& node : made.nodes) node.x() = -node.x();
    for (auto& element : made.elements) std::swap(element[1], element[2]);
    for (auto& [name, facets] : made.boundaries) {
      for (auto& facet : facets) std::swap(facet[0], facet[1]);
    }
    std::swap(made.boundaries["left"], made.boundaries["right"]);
    return made;
  }
  double surface_level() const { return layer.depth; }
};

struct Fault {
  double tip = 0.0;
  bool mirrored = false;

  scarp::Vector<2> left() const { return mirrored ? slip(-1.0) : scarp::Vector<2>(0.0, 0.0); }
  scarp::Vector<2> right() const { return mirrored ? scarp::Vector<2>(0.0, 0.0) : slip(1.0); }

 private:
  static scarp::Vector<2> slip(double sense) {
    auto const slides = scarp::NormalFault{}.right();
    return {sense * slides.x(), slides.y()};
  }
};

using Scene = scarp::FreeFieldFault<scarp::Nonlocal<Soil>, scarp::QuasiNewton<scarp::ConsistentTangent>, Ground, Fault>;

/// Places of all nodes after the rupture.
std::vector<scarp::Vector<2>> ruptured(double length, bool mirrored) {
  constexpr double degree = std::numbers::pi / 180.0;
  Scene scene;
  scene.soil.provider.elasticity = scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3);
  scene.soil.provider.strength = {.peak = {.cohesion = 1e3, .friction = 31.0 * degree, .dilation = 7.0 * degree},
                                  .residual = {.cohesion = 1e3, .friction = 26.0 * degree, .dilation = 0.0},
                                  .strain_to_residual = 0.15};
  scene.soil.provider.initial = {scene.surcharge, scene.unit_weight, 0.4};
  scene.soil.length = length;
  scene.ground.mirrored = mirrored;
  scene.fault.mirrored = mirrored;
  scene.throw_to = 0.75;
  scene.solver.tolerance = 1e-10;
  scene.solver.rule.floor = 1e-4;
  scarp::SerialExecutor serial;
  scarp::NoObserver nobody;
  auto problem = scene.problem(serial);
  REQUIRE(scene.settle(problem, nobody).verdict.acceptable());
  REQUIRE(scene.rupture(problem, nobody).verdict.acceptable());
  auto places = problem.discretisation().positions();
  for (auto& place : places) place.x() *= mirrored ? -1.0 : 1.0;
  return places;
}

double largest_difference(std::vector<scarp::Vector<2>> const& some, std::vector<scarp::Vector<2>> const& others) {
  double largest = 0.0;
  for (std::size_t k = 0; k < some.size(); ++k) largest = std::max(largest, (some[k] - others[k]).norm());
  return largest;
}

}  // namespace

TEST_CASE("the mirrored scene gives the mirrored answer, without a length and with one") {
  auto const local = ruptured(0.0, false);
  auto const averaged = ruptured(8.0, false);
  // Residuals of 1e-10 leave errors of a micrometre where the soil softens; the throw is 0.75 m.
  CHECK(largest_difference(local, ruptured(0.0, true)) < 1e-6);
  CHECK(largest_difference(averaged, ruptured(8.0, true)) < 1e-6);
  CHECK(largest_difference(local, averaged) > 0.01);
}
