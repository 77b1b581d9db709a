// SPDX-License-Identifier: BSL-1.0
#include "../../examples/fault_rupture/surface_mean.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/mesh_file_ground.hpp"
#include "scarp/fault/refined_ground.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "support/elements.hpp"

namespace {

using Positions = std::vector<scarp::Vector<2>>;
using scarp::Vector;

/// Both walls move, by no slip along one plane.
struct BothMove {
  double tip = 0.0;
  Vector<2> left() const { return {0.1, 0.3}; }
  Vector<2> right() const { return {0.5, -0.7}; }
};

std::filesystem::path example(char const* name) {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "examples" / name;
}

/// How far the mean is from the closed form [m], for a motion that nothing but bedrock and sides prescribe, on ground
/// that has settled unevenly before.
template <class Element, class Motion>
double miss(scarp::Mesh<Element> const& mesh, Motion const& motion, double fault_throw) {
  scarp::detail::StepAtTip const step(mesh, motion.tip);
  Positions rest = mesh.nodes;
  Positions now;
  std::vector<double> share;
  for (auto const& node : mesh.nodes) share.push_back(0.5 + 0.5 * std::tanh((node.x() + 8.0) / 6.0));
  std::vector<bool> held(mesh.nodes.size(), false);
  auto const hold = [&](char const* side, auto const& share_at) {
    for (int const node : scarp::boundary_nodes(mesh, side)) {
      auto const n = static_cast<std::size_t>(node);
      share[n] = share_at(mesh.nodes[n].x());
      held[n] = true;
    }
  };
  hold("bottom", [&](double x) { return step.share_at(x); });
  hold("left", [](double) { return 0.0; });
  hold("right", [](double) { return 1.0; });
  Vector<2> const left = fault_throw * motion.left();
  Vector<2> const right = fault_throw * motion.right();
  for (std::size_t n = 0; n < rest.size(); ++n) {
    double const wave = held[n] ? 0.0 : std::sin(0.7 * rest[n].x() + rest[n].y());
    rest[n].y() -= 0.02 * wave;
    now.emplace_back(rest[n] + left + share[n] * (right - left) + Vector<2>(0.1, 0.2) * wave);
  }
  auto const found = fault_rupture::surface_mean(mesh, rest, now, scarp::offset_at(motion, fault_throw));
  auto const profile = scarp::surface_profile(mesh, rest, now);
  double const depth = scarp::region_area(mesh, "soil", rest) / (profile.back().x_initial - profile.front().x_initial);
  double const slip = right.x() - left.x();
  double const offset = left.y() - right.y();
  CHECK(std::abs(found.dilated_area) > 0.1);  // the term counts
  return found.surface_mean -
         (motion.tip + left.x() + slip / 2.0 - depth * slip / offset + found.dilated_area / offset);
}

template <class Element>
void check_all(scarp::Mesh<Element> const& mesh) {
  constexpr double round_off = 1e-9 * 25.0;  // [m], of areas of some thousand m2 over an offset of metres
  for (double const fault_throw : {0.01, 2.125}) {
    CHECK(std::abs(miss(mesh, scarp::NormalFault{}, fault_throw)) < round_off);
    CHECK(std::abs(miss(mesh, scarp::NormalFault{.dip = std::numbers::pi / 2.0}, fault_throw)) < round_off);
    CHECK(std::abs(miss(mesh, scarp::ReverseFault{.dip = 0.8}, fault_throw)) < round_off);
    CHECK(std::abs(miss(mesh, BothMove{}, fault_throw)) < round_off);
  }
}

}  // namespace

TEST_CASE_TEMPLATE("the mean of the profile follows from the dilated area, whatever the ground does", Element,
                   scarp::Tri3, scarp::Quad8 ALSO_NIGHTLY(scarp::Tri6, scarp::Quad4)) {
  scarp::FaultMesh const layer{.size = 5.0, .jitter = 0.2};
  check_all(layer.generate<Element>());
  check_all(scarp::RefinedGround{scarp::StructuredGround<Element>{layer}, scarp::StripSize{.fine = 1.0}}.mesh({}));
  auto below_a_footing = layer.generate<Element>({-15.0, -5.0});
  scarp::mark_footing_base(below_a_footing, -10.0, 10.0);
  check_all(below_a_footing);
}

TEST_CASE("on ground from Gmsh too") {
  check_all(scarp::ground_from_file<scarp::Tri6>(example("fault_rupture/meshes/unstructured.msh")).given);
  check_all(scarp::ground_from_file<scarp::Quad8>(example("own_ground/own_ground.msh")).given);
}

TEST_CASE("a step above the tip has its mean in the middle of its heave") {
  auto const mesh =
      scarp::FaultMesh{.left = -50.0, .right = 25.0, .size = 5.0, .coarsening = 1.0}.generate<scarp::Tri3>();
  double const h = 2.0;
  scarp::NormalFault const fault;
  auto now = mesh.nodes;
  for (auto& node : now) {
    if (node.x() > 0.0) node += h * fault.right();
    if (node.x() == 0.0) node += 0.5 * h * fault.right();
  }
  // Analytic: the facets beside the tip are alike, and the ground grows by its depth times the heave.
  auto const found = fault_rupture::surface_mean(mesh, mesh.nodes, now, scarp::offset_at(fault, h));
  CHECK(std::abs(found.surface_mean - 0.5 * h * fault.right().x()) < 1e-12 * 25.0);
  CHECK(std::abs(found.dilated_area - 25.0 * h * fault.right().x()) < 1e-12 * 25.0 * 75.0);
}

TEST_CASE("without an offset there is no mean") {
  auto const mesh = scarp::FaultMesh{.size = 5.0}.generate<scarp::Tri3>();
  CHECK(std::isnan(fault_rupture::surface_mean(mesh, mesh.nodes, mesh.nodes, {}).surface_mean));
  CHECK(fault_rupture::surface_mean(mesh, mesh.nodes, mesh.nodes, {}).dilated_area == 0.0);
}
