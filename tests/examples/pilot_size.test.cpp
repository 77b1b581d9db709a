// SPDX-License-Identifier: BSL-1.0
#include "../../examples/shared/study/pilot_size.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scarp/bvp/default_grid.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Vector;

/// Ground of 8 m by 4 m in cells of 1 m whose nodes have moved.
template <class Element>
struct MovedGround {
  scarp::DefaultGrid<Element> grid{
      scarp::FaultMesh{.left = 0.0, .right = 8.0, .depth = 4.0, .tip = 4.0, .size = 1.0, .coarsening = 1.0}
          .generate<Element>()};

  template <class Motion>
  explicit MovedGround(Motion const& motion) {
    Eigen::VectorXd moved(grid.dof_count());
    auto const& nodes = grid.mesh().nodes;
    for (int n = 0; n < grid.node_count(); ++n) moved.segment<2>(2 * n) = motion(nodes[static_cast<std::size_t>(n)]);
    grid.commit(moved);
  }
  auto const& discretisation() const { return grid; }
};

/// Column of cells from 5 to 6 m that shears while what is right of it goes down as a block.
Vector<2> step_at_five(Vector<2> const& place) { return {0.0, -0.2 * std::clamp(place.x() - 5.0, 0.0, 1.0)}; }

}  // namespace

TEST_CASE_TEMPLATE("strained places are the elements in which the ground shears", Element, scarp::Tri3, scarp::Tri6,
                   scarp::Quad8) {
  MovedGround<Element> const ground(step_at_five);
  auto const places = fault_rupture::strained_places(ground, 1.0 - 1e-9);  // without rounding
  CHECK(places.size() == ground.grid.mesh().elements.size() / 8);
  for (auto const& place : places) {
    CHECK(place.x() > 5.0);
    CHECK(place.x() < 6.0);
  }
  CHECK(fault_rupture::strained_places(ground, 0.49).size() == places.size() / 2);
}

TEST_CASE("of the strain the largest part is taken first") {
  MovedGround<scarp::Quad8> const ground([](Vector<2> const& place) {
    Vector<2> const faint{0.0, -0.01 * std::clamp(place.x() - 1.0, 0.0, 1.0)};
    return Vector<2>(step_at_five(place) + faint);
  });
  for (auto const& place : fault_rupture::strained_places(ground, 0.95)) CHECK(place.x() > 5.0);
  CHECK(fault_rupture::strained_places(ground, 0.99).size() > 4);
}

TEST_CASE("elements are fine around strained places, coarse far away and grow between") {
  fault_rupture::PilotSize const field{
      .strained = {{0.0, 0.0}, {-2.0, 4.0}}, .margin = 3.0, .fine = 0.5, .coarse = 4.5, .transition = 10.0};
  CHECK(field.size({0.0, 0.0}) == 0.5);
  CHECK(field.size({-2.0, 7.0}) == 0.5);
  CHECK(field.size({8.0, 0.0}) == samples::Approx(2.5));  // halfway through the transition
  CHECK(field.size({300.0, 0.0}) == 4.5);
  auto const [left, right] = field.edges(0.0);
  CHECK(left == -3.0);
  CHECK(right == 3.0);
  CHECK(field.edges(4.0)[0] == -5.0);
  CHECK(!std::isfinite(field.edges(20.0)[0]));
}

TEST_CASE("a pilot run that strains nothing is refused") {
  MovedGround<scarp::Tri3> const ground([](Vector<2> const&) { return Vector<2>(0.0, -1.0); });
  CHECK_REFUSED(fault_rupture::strained_places(ground, 0.7), "apply a throw");
  CHECK_REFUSED(fault_rupture::strained_places(ground, 1.5), "share of the strain", "1.5");
}

TEST_CASE("settings that say nothing of sizes are refused") {
  using fault_rupture::PilotSize;
  std::vector<Vector<2>> const places{{0.0, 0.0}};
  CHECK_REFUSED(PilotSize{}.validate(), "strained 0 places");
  CHECK_REFUSED((PilotSize{.strained = places, .margin = -1.0}.validate()), "margin", "-1");
  CHECK_REFUSED((PilotSize{.strained = places, .fine = 0.0}.validate()), "size of elements near", "0");
  CHECK_REFUSED((PilotSize{.strained = places, .fine = 2.0, .coarse = 1.0}.validate()), "size of elements far", "1");
  CHECK_REFUSED((PilotSize{.strained = places, .transition = 0.0}.validate()), "transition", "0");
}
