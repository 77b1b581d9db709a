// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <numbers>

#include "io/mesh_samples.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "support/approx.hpp"

namespace {

std::filesystem::path gmsh_sample(std::string const& name) {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "reference" / "gmsh" / name;
}

}  // namespace

TEST_CASE("meshes of Gmsh have the measures of their geometry, the same from all formats") {
  // Analytic: the rectangle 4 x 2 less a heptagon with seven segments of parabolas through points of a circle of 0.5.
  constexpr double r = 0.5;
  double const half_angle = std::numbers::pi / 7.0;
  double const heptagon = 7.0 * 0.5 * r * r * std::sin(2.0 * half_angle);
  double const segments = 7.0 * 2.0 / 3.0 * 2.0 * r * std::sin(half_angle) * r * (1.0 - std::cos(half_angle));
  auto const first = scarp::read_gmsh<scarp::Tri6>(gmsh_sample("plate_22_text.msh"));
  CHECK(first.nodes.size() == 43);  // another code: Gmsh's own count
  for (auto const* name : {"plate_22_text.msh", "plate_22_binary.msh", "plate_41_text.msh", "plate_41_binary.msh"}) {
    CAPTURE(name);
    auto const mesh = scarp::read_gmsh<scarp::Tri6>(gmsh_sample(name));
    scarp::validate(mesh);
    CHECK(samples::volume(mesh) == samples::Approx(8.0 - heptagon - segments).epsilon(1e-14));
    CHECK(mesh.regions == std::vector<std::string>{"rock", "soft sand"});
    CHECK(mesh.boundaries.at("bottom").size() == 2);
    CHECK(mesh.boundaries.at("hole").size() == 7);
    CHECK(mesh.elements == first.elements);
    CHECK(mesh.element_region == first.element_region);
    CHECK(mesh.boundaries == first.boundaries);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      CHECK((mesh.nodes[n] - first.nodes[n]).norm() < 2e-15);  // 16 digits of numbers up to 4
    }
  }
  auto const box = scarp::read_gmsh<scarp::Tet4>(gmsh_sample("box_22_text.msh"));
  scarp::validate(box);
  CHECK(samples::volume(box) == samples::Approx(2.0).epsilon(1e-14));
  CHECK(box.regions == std::vector<std::string>{"lower", "physical_9"});
  CHECK(box.boundaries.at("ground").size() == 4);
  for (auto const& side : box.boundaries.at("ground")) {  // the outward normal points down
    auto const rows = scarp::corners<scarp::Tri3, 3>(side, box.nodes);
    scarp::Vector<3> const u = rows.row(1) - rows.row(0);
    scarp::Vector<3> const v = rows.row(2) - rows.row(0);
    CHECK(u(0) * v(1) - u(1) * v(0) < 0.0);
  }
}
