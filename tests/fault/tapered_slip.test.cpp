// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/dip_slip_faults.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/element/hex8.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using Tapered = scarp::TaperedSlip<scarp::NormalFault>;

static_assert(scarp::ChangesAlongStrike<Tapered>);
static_assert(!scarp::ChangesAlongStrike<scarp::NormalFault>);

scarp::Mesh<scarp::Hex8> slab() {
  return scarp::BoxMesh<scarp::Hex8>{.lengths = {8.0, 4.0, 2.0}, .cells = {8, 4, 2}}.generate();
}

}  // namespace

TEST_CASE("slip is full up to one place, gone from another on, and half in between, level at both ends") {
  Tapered const fault{{}, 10.0, 30.0};
  CHECK(fault.share_along(-5.0) == 1.0);
  CHECK(fault.share_along(10.0) == 1.0);
  CHECK(fault.share_along(20.0) == samples::Approx(0.5).epsilon(1e-15));
  CHECK(fault.share_along(30.0) == 0.0);
  CHECK(fault.share_along(90.0) == 0.0);
  // Analytic: half a cosine leaves its ends by (pi d / 40)^2.
  CHECK(1.0 - fault.share_along(10.1) < 1e-4);
  CHECK(fault.share_along(29.9) < 1e-4);
}

TEST_CASE("every node of bottom and sides moves by the fault's motion times the share at its place along the strike") {
  auto const mesh = slab();
  scarp::NormalFault const same{.dip = 1.0, .tip = 3.0};
  Tapered const fault{same, 1.0, 4.0};
  auto const all = scarp::bedrock_constraints(mesh, same).displacement(0.4);
  auto const tapered = scarp::bedrock_constraints(mesh, fault).displacement(0.4);
  bool moves = false;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n) {
    double const share = fault.share_along(mesh.nodes[static_cast<std::size_t>(n)].y());
    CHECK((tapered.segment<3>(3 * n) - share * all.segment<3>(3 * n)).norm() < 1e-15);
    moves = moves || (share > 0.1 && share < 0.9 && tapered.segment<3>(3 * n).norm() > 0.01);
  }
  CHECK(moves);
}

TEST_CASE("in the plane a tapered fault is the fault itself") {
  auto const mesh = scarp::BoxMesh<scarp::Quad4>{.lengths = {8.0, 2.0}, .cells = {8, 2}}.generate();
  scarp::NormalFault const same{.tip = 3.0};
  CHECK(scarp::bedrock_constraints(mesh, Tapered{same, 0.0, 1.0}).displacement(1.0) ==
        scarp::bedrock_constraints(mesh, same).displacement(1.0));
}

TEST_CASE("slip that ends before it is full is refused") {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  for (double const end : {10.0, 5.0, nan, std::numeric_limits<double>::infinity()})
    CHECK_REFUSED((Tapered{{}, 10.0, end}.share_along(3.0)), "y = 10", fmt::format("{}", end));
  CHECK_REFUSED((Tapered{{}, 10.0, 5.0}.share_along(3.0)), "y = 10 m", "5 m");
}
