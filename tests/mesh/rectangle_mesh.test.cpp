// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/rectangle_mesh.hpp"

#include <doctest/doctest.h>

#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

double area(scarp::Mesh<scarp::Tri3> const& mesh) {
  double sum = 0.0;
  for (auto const& element : mesh.elements) {
    auto const rows = scarp::corners<scarp::Tri3, 2>(element, mesh.nodes);
    sum += 0.5 * scarp::measure<scarp::Tri3, 2>(rows, scarp::Vector<2>::Zero());
  }
  return sum;
}

}  // namespace

TEST_CASE("a crossed rectangle has four triangles and one centre node per cell") {
  auto const mesh = scarp::RectangleMesh{.width = 3.0, .height = 2.0, .columns = 6, .rows = 4}.generate();
  CHECK(mesh.elements.size() == 4 * 6 * 4);   // analytic
  CHECK(mesh.nodes.size() == 7 * 5 + 6 * 4);  // analytic
  CHECK(area(mesh) == samples::Approx(6.0).epsilon(1e-14));
}

TEST_CASE("the named boundaries lie on their sides and run counter-clockwise") {
  auto const mesh = scarp::RectangleMesh{.width = 3.0, .height = 2.0, .columns = 3, .rows = 2}.generate();
  scarp::Vector<2> const along[] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
  char const* const names[] = {"bottom", "right", "top", "left"};
  double const lengths[] = {3.0, 2.0, 3.0, 2.0};
  for (std::size_t side = 0; side < 4; ++side) {
    double length = 0.0;
    for (auto const& [first, second] : scarp::boundary(mesh, names[side])) {
      length +=
          (mesh.nodes[static_cast<std::size_t>(second)] - mesh.nodes[static_cast<std::size_t>(first)]).dot(along[side]);
    }
    CHECK(length == samples::Approx(lengths[side]).epsilon(1e-15));
  }
  for (int const node : scarp::boundary_nodes(mesh, "top")) {
    CHECK(mesh.nodes[static_cast<std::size_t>(node)].y() == 2.0);
  }
}

TEST_CASE("distortion moves interior nodes only, differently for every seed and always the same for one") {
  scarp::RectangleMesh const plain{.width = 3.0, .height = 2.0, .columns = 3, .rows = 2};
  auto distorted = plain;
  distorted.distortion = 0.2;
  auto const mesh = distorted.generate();
  CHECK(area(mesh) == samples::Approx(6.0).epsilon(1e-14));  // analytic: the outline stays
  auto const straight = plain.generate();
  int moved = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    auto const& node = straight.nodes[n];
    bool const inside = node.x() > 0.0 && node.x() < 3.0 && node.y() > 0.0 && node.y() < 2.0;
    CHECK((inside || mesh.nodes[n] == node));
    moved += mesh.nodes[n] != node ? 1 : 0;
  }
  CHECK(moved == 2 + 6);  // analytic: two inner corners and six centres
  CHECK(distorted.generate().nodes == mesh.nodes);
  distorted.seed = 2;
  CHECK(distorted.generate().nodes != mesh.nodes);
}

TEST_CASE("the largest distortion keeps all triangles the right way round") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CHECK_NOTHROW(scarp::RectangleMesh{.columns = 8, .rows = 8, .distortion = 0.2, .seed = seed}.generate());
  }
}

TEST_CASE("wrong sizes are refused") {
  CHECK_REFUSED((scarp::RectangleMesh{.width = 0.0}.generate()), "width", "is 0");
  CHECK_REFUSED((scarp::RectangleMesh{.height = -1.0}.generate()), "height", "is -1");
  CHECK_REFUSED((scarp::RectangleMesh{.columns = 0}.generate()), "0 columns");
  CHECK_REFUSED((scarp::RectangleMesh{.rows = 10001}.generate()), "10001 rows");
  CHECK_REFUSED((scarp::RectangleMesh{.distortion = 0.3}.generate()), "distortion is 0.3");
  CHECK_REFUSED((scarp::RectangleMesh{.distortion = std::nan("")}.generate()), "distortion is nan");
}
