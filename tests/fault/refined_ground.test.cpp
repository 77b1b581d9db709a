// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/refined_ground.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/mesh_file_ground.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Vector;

constexpr scarp::FaultMesh layer{.size = 5.0, .coarsening = 1.0};

template <class Ground>
concept Refinable = requires {
  typename scarp::RefinedGround<Ground>;
};
static_assert(Refinable<scarp::MeshFileGround<scarp::Quad8>> && !Refinable<scarp::StructuredGround<scarp::Tet4>>);

std::filesystem::path example(char const* name) {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "examples" / name;
}

template <class Element>
double longest_near(scarp::Mesh<Element> const& mesh, Vector<2> const& place, double reach) {
  double longest = 0.0;
  for (auto const& element : mesh.elements) {
    auto const at = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(element[k])]; };
    constexpr std::size_t corners = scarp::LinearOf<Element>::nodes;
    for (std::size_t k = 0; k < corners; ++k) {
      if ((at(k) - place).norm() < reach) longest = std::max(longest, (at(k) - at((k + 1) % corners)).norm());
    }
  }
  return longest;
}

}  // namespace

TEST_CASE("the strip is fine along its line, coarse far away and grows between") {
  scarp::StripSize const strip{.tip = 3.0,
                               .bedrock = -20.0,
                               .dip = std::numbers::pi / 4.0,
                               .half_width = 2.0,
                               .widening = 0.1,
                               .fine = 0.5,
                               .coarse = 4.5,
                               .transition = 10.0};
  CHECK(strip.size({3.0, -20.0}) == 0.5);
  CHECK(strip.size({-7.0, -10.0}) == 0.5);                               // on the line
  CHECK(strip.size({-7.0 + 2.999, -10.0}) == 0.5);                       // half the width, 2 + 0.1 * 10 m
  CHECK(strip.size({-7.0 - 3.0 - 5.0, -10.0}) == samples::Approx(2.5));  // halfway through the transition
  CHECK(strip.size({-7.0 + 3.0 + 10.0, -10.0}) == samples::Approx(4.5));
  CHECK(strip.size({300.0, -10.0}) == 4.5);
  CHECK(strip.edges(0.0)[0] == 1.0);
  CHECK(strip.edges(10.0)[1] == samples::Approx(-7.0 + 3.0));
}

TEST_CASE_TEMPLATE("a layer is refined along the strip, with the nodes that structures ask for", Element, scarp::Tri3,
                   scarp::Quad8 ALSO_NIGHTLY(scarp::Tri6, scarp::Quad4)) {
  scarp::RefinedGround const ground{scarp::StructuredGround<Element>{layer}, scarp::StripSize{.fine = 0.6}};
  static_assert(scarp::Ground<std::remove_cv_t<decltype(ground)>>);
  CHECK(ground.surface_level() == 25.0);
  auto const mesh = ground.mesh({-15.0, -5.0});
  auto const corners = scarp::detail::corners_along(mesh, "surface");
  for (double const edge : {-15.0, -5.0}) CHECK_NOTHROW(scarp::detail::require_corner(corners, edge, 1e-9));
  CHECK_NOTHROW(scarp::require_node_at_tip(mesh, 0.0));
  CHECK(longest_near(mesh, {-5.0, 10.0}, 3.0) < 1.0);
  CHECK(longest_near(mesh, {-45.0, 10.0}, 5.0) > 2.0);
}

TEST_CASE("grounds from Gmsh are refined likewise") {
  auto const check = [](auto const& given, double tolerance) {
    scarp::RefinedGround const ground{given, scarp::StripSize{.half_width = 2.0, .fine = 0.4}};
    auto const mesh = ground.mesh({});
    CHECK(mesh.elements.size() > 2 * given.given.elements.size());
    CHECK_NOTHROW(scarp::detail::require_ground(mesh));  // groups, no hanging nodes, straight and closed outline
    CHECK_NOTHROW(scarp::require_node_at_tip(mesh, 0.0));
    CHECK(longest_near(mesh, {-5.0, 10.0}, 1.5) < tolerance);
  };
  auto const file = example("fault_rupture/meshes/unstructured.msh");
  check(scarp::ground_from_file<scarp::Tri3>(file), 1.19 * 0.4);
  check(scarp::ground_from_file<scarp::Tri6>(file), 1.19 * 0.4);
  check(scarp::ground_from_file<scarp::Quad8>(example("own_ground/own_ground.msh")), 2.0 * 0.4);
}

TEST_CASE("a strip that is none is refused before anything is refined") {
  auto const refused = [](scarp::StripSize const& strip) {
    return samples::message_of([&] { scarp::RefinedGround{scarp::StructuredGround<>{layer}, strip}.mesh({}); });
  };
  CHECK(refused({.dip = std::nan("")}) == samples::Naming({"dip of the strip", "nan"}));
  CHECK(refused({.dip = 0.0}) == samples::Naming({"dip of the strip", "0"}));
  CHECK(refused({.half_width = -1.0}) == samples::Naming({"half width of the strip", "-1"}));
  CHECK(refused({.fine = 0.0}) == samples::Naming({"size of elements in the strip", "0"}));
  CHECK(refused({.fine = 2.0, .coarse = 1.0}) == samples::Naming({"far from the strip", "1"}));
  CHECK(refused({.transition = 0.0}) == samples::Naming({"transition next to the strip", "0"}));
}
