// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/fault_mesh.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <set>

#include "approx.hpp"

namespace {

using scarp::FaultMesh;
using scarp::Footing;
using Mesh = scarp::Mesh<scarp::Tri3>;

double area(Mesh const& mesh, int region) {
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.element_region[e] == region) {
      auto const rows = scarp::corners<scarp::Tri3, 2>(mesh.elements[e], mesh.nodes);
      sum += 0.5 * scarp::measure<scarp::Tri3, 2>(rows, scarp::Vector<2>::Zero());
    }
  }
  return sum;
}

/// 4 sqrt(3) area / sum of squared edges: 1 for an equilateral triangle, 0 for a flat one.
double worst_quality(Mesh const& mesh) {
  double worst = 1.0;
  for (auto const& element : mesh.elements) {
    auto const rows = scarp::corners<scarp::Tri3, 2>(element, mesh.nodes);
    double const edges = (rows.row(1) - rows.row(0)).squaredNorm() + (rows.row(2) - rows.row(1)).squaredNorm() +
                         (rows.row(0) - rows.row(2)).squaredNorm();
    double const twice_area = scarp::measure<scarp::Tri3, 2>(rows, scarp::Vector<2>::Zero());
    worst = std::min(worst, 2.0 * std::sqrt(3.0) * twice_area / edges);
  }
  return worst;
}

std::set<double> bottom_lines(Mesh const& mesh) {
  std::set<double> lines;
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) {
    lines.insert(mesh.nodes[static_cast<std::size_t>(node)].x());
  }
  return lines;
}

double length(Mesh const& mesh, char const* name) {
  double sum = 0.0;
  for (auto const& [first, second] : scarp::boundary(mesh, name)) {
    sum += (mesh.nodes[static_cast<std::size_t>(second)] - mesh.nodes[static_cast<std::size_t>(first)]).norm();
  }
  return sum;
}

FaultMesh with_footing() { return {.footing = Footing{.centre = -12.0, .width = 7.0, .height = 1.5}}; }

}  // namespace

TEST_CASE("the layer has its full area and the announced number of triangles at every size") {
  for (double const size : {0.4, 0.83, 1.25, 2.5, 4.0}) {
    FaultMesh const scene{.size = size};
    auto const mesh = scene.generate();
    CHECK(area(mesh, 0) == samples::Approx(75.0 * 25.0).epsilon(1e-12));  // analytic; round-off of 1e4 terms
    CHECK(static_cast<int>(mesh.elements.size()) == scene.triangle_count());
    CHECK(mesh.regions == std::vector<std::string>{"soil"});
  }
}

TEST_CASE("triangles are well shaped and neighbouring columns alike at every size") {
  for (double const size : {0.4, 0.83, 1.25, 2.5}) {
    auto const mesh = FaultMesh{.size = size}.generate();
    // Analytic: a triangle of a w x h cell has 2 sqrt(3) w h / (3 w^2 + h^2) or the same with w and h exchanged; at the
    // coarse side w = 2 h gives 0.533. Rounding to whole cells changes w/h by at most 10 % here: 0.48.
    CHECK(worst_quality(mesh) > 0.48);
    auto const lines = bottom_lines(mesh);
    double before = 0.0;
    double last = *lines.begin();
    for (auto line = std::next(lines.begin()); line != lines.end(); ++line) {
      double const width = *line - last;
      if (before > 0.0) {
        CHECK(std::max(width / before, before / width) < 1.25);  // what is usual for graded meshes
      }
      before = width;
      last = *line;
    }
  }
}

TEST_CASE("the kink of the fault sits on a node, wherever the tip is") {
  for (double const tip : {0.0, -7.123456789, 10.0 / 3.0}) {
    FaultMesh const scene{.tip = tip};
    auto const mesh = scene.generate();
    CHECK(bottom_lines(mesh).count(tip) == 1);  // exactly, not only to round-off
  }
}

TEST_CASE("cells are finest in the band and grow to the sides") {
  auto const lines = bottom_lines(FaultMesh{.size = 1.0, .coarsening = 3.0}.generate());
  double const first = *std::next(lines.begin()) - *lines.begin();
  auto const middle = lines.lower_bound(-10.0);
  double const inner = *std::next(middle) - *middle;
  CHECK(inner == samples::Approx(1.0).epsilon(0.05));          // rounding to whole cells
  CHECK(first / inner == samples::Approx(3.0).epsilon(0.05));  // the first cell is a little smaller than its left side
}

TEST_CASE("rows can be finer at bedrock") {
  auto const mesh = FaultMesh{.row_coarsening = 2.0}.generate();
  std::set<double> lines;
  for (int const node : scarp::boundary_nodes(mesh, "left")) {
    lines.insert(mesh.nodes[static_cast<std::size_t>(node)].y());
  }
  double const bottom = *std::next(lines.begin()) - *lines.begin();
  double const top = *lines.rbegin() - *std::next(lines.rbegin());
  // Analytic: heights grow by the ratio 2^(1/n) from row to row, so the last of n is 2^((n-1)/n) times the first.
  CHECK(top / bottom ==
        samples::Approx(std::pow(2.0, 1.0 - 1.0 / static_cast<double>(lines.size() - 1))).epsilon(1e-10));
}

TEST_CASE("the boundaries cover the outline") {
  auto const mesh = FaultMesh{}.generate();
  CHECK(length(mesh, "left") == samples::Approx(25.0).epsilon(1e-13));
  CHECK(length(mesh, "right") == samples::Approx(25.0).epsilon(1e-13));
  CHECK(length(mesh, "bottom") == samples::Approx(75.0).epsilon(1e-13));
  CHECK(length(mesh, "surface") == samples::Approx(75.0).epsilon(1e-13));
}

TEST_CASE("a footing stands on the surface and shares its nodes") {
  auto const mesh = with_footing().generate();
  auto const footing = scarp::region_number(mesh, "footing");
  CHECK(area(mesh, footing) == samples::Approx(7.0 * 1.5).epsilon(1e-13));
  CHECK(area(mesh, scarp::region_number(mesh, "soil")) == samples::Approx(75.0 * 25.0).epsilon(1e-12));
  CHECK(length(mesh, "footing_base") == samples::Approx(7.0).epsilon(1e-13));
  CHECK(length(mesh, "footing_top") == samples::Approx(7.0).epsilon(1e-13));
  CHECK(length(mesh, "surface") == samples::Approx(68.0).epsilon(1e-13));
  CHECK(static_cast<int>(mesh.elements.size()) == with_footing().triangle_count());
  std::set<std::pair<double, double>> places;
  for (auto const& node : mesh.nodes) {
    places.insert({node.x(), node.y()});
  }
  CHECK(places.size() == mesh.nodes.size());  // no two nodes at one place: the base is shared
  for (int const node : scarp::boundary_nodes(mesh, "footing_base")) {
    auto const& place = mesh.nodes[static_cast<std::size_t>(node)];
    CHECK(place.y() == 25.0);
    CHECK(std::abs(place.x() + 12.0) <= 3.5);
  }
}

TEST_CASE("no size gives a number of triangles nearer to the asked one") {
  for (auto const& scene : {FaultMesh{}, with_footing()}) {
    auto const best = scene.with_about(7563);
    int const miss = std::abs(best.triangle_count() - 7563);
    auto probe = scene;
    for (int k = 0; k <= 3000; ++k) {  // sizes from 0.5 to 1.5 m, by exhaustion
      probe.size = 0.5 + k / 3000.0;
      CHECK(std::abs(probe.triangle_count() - 7563) >= miss);
    }
    CHECK(miss <=
          120);  // half of the largest jump, a column of about 30 cells or a row of about 60, four triangles each
    CHECK(static_cast<int>(best.generate().elements.size()) == best.triangle_count());
  }
}

TEST_CASE("small and large numbers of triangles are met to half a row") {
  for (int const wanted : {100, 600, 2000, 30000}) {
    auto const scene = FaultMesh{}.with_about(wanted);
    // A crossed grid of n cells has rows of at most about sqrt(3 n) cells: half of one, four triangles each.
    CHECK(std::abs(scene.triangle_count() - wanted) <= 2.0 * std::sqrt(3.0 * wanted / 4.0));
  }
}

TEST_CASE("the same scene gives the same mesh, bit for bit") {
  CHECK(with_footing().generate().nodes == with_footing().generate().nodes);
  CHECK(with_footing().generate().elements == with_footing().generate().elements);
}

TEST_CASE("a tip outside the bottom is refused with the layer's ends") {
  CHECK_THROWS_WITH_AS(
      (FaultMesh{.tip = 30.0}.generate()),
      "the fault tip is at x = 30 m (the layer's bottom reaches from -52 to 23 m): move the tip between them",
      scarp::InputError);
  CHECK_THROWS_AS((FaultMesh{.tip = -52.0}.generate()), scarp::InputError);
}

TEST_CASE("sizes that are not positive or not finite are refused") {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  for (double const wrong : {nan, 0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS((FaultMesh{.size = wrong}.generate()), scarp::InputError);
    CHECK_THROWS_AS((FaultMesh{.depth = wrong}.generate()), scarp::InputError);
    CHECK_THROWS_AS((FaultMesh{.depth = wrong}.with_about(600)), scarp::InputError);
    CHECK_THROWS_AS((FaultMesh{.coarsening = wrong}.generate()), scarp::InputError);
    CHECK_THROWS_AS((FaultMesh{.row_aspect = wrong}.generate()), scarp::InputError);
    CHECK_THROWS_AS((FaultMesh{.row_coarsening = wrong}.generate()), scarp::InputError);
    CHECK_THROWS_AS((FaultMesh{.footing = Footing{-10.0, wrong, 1.0}}.generate()), scarp::InputError);
    CHECK_THROWS_AS((FaultMesh{.footing = Footing{-10.0, 5.0, wrong}}.generate()), scarp::InputError);
  }
  CHECK_THROWS_AS((FaultMesh{.tip = nan}.generate()), scarp::InputError);
  CHECK_THROWS_AS((FaultMesh{.left = 30.0}.generate()), scarp::InputError);
  CHECK_THROWS_AS((FaultMesh{.band_left = 10.0, .band_right = 0.0}.generate()), scarp::InputError);
  CHECK_THROWS_AS((FaultMesh{.size = 1e-5}.generate()), scarp::InputError);
  CHECK_THROWS_AS(FaultMesh{}.with_about(0), scarp::InputError);
}

TEST_CASE("a footing that does not stand on the surface and grid lines too close together are refused") {
  CHECK_THROWS_AS((FaultMesh{.footing = Footing{21.0, 6.0, 1.0}}.generate()), scarp::InputError);
  CHECK_THROWS_AS((FaultMesh{.footing = Footing{-2.51, 5.0, 1.0}}.generate()),
                  scarp::InputError);                                         // edge 1 cm from the tip
  CHECK_NOTHROW((FaultMesh{.footing = Footing{-2.5, 5.0, 1.0}}.generate()));  // edge on the tip
  // 0.3 - 0.1 - 0.2 is not zero in binary: an edge that misses the tip by round-off is put on it.
  CHECK_NOTHROW((FaultMesh{.tip = 0.3 - 0.1, .footing = Footing{-0.8, 2.0, 1.0}}.generate()));
}
