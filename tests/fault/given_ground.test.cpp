// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/mesh_file_ground.hpp"

#include <doctest/doctest.h>

#include "scarp/fault/ground.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"
#include "support/files.hpp"
#include "support/gmsh_writer.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Naming;
using samples::ScratchFolder;

constexpr scarp::FaultMesh layer{.size = 5.0};

std::filesystem::path example(char const* name) {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "examples" / name;
}

template <class Element>
scarp::MeshFileGround<Element> through_file(scarp::Mesh<Element> const& mesh) {
  ScratchFolder const folder;
  scarp::write_gmsh(folder / "ground.msh", mesh);
  return scarp::ground_from_file<Element>(folder / "ground.msh");
}

/// What the complaint about a ground says; empty without one.
template <class Element>
std::string complaint(scarp::Mesh<Element> const& mesh) {
  return samples::message_of([&] { through_file(mesh); });
}

scarp::Mesh<scarp::Quad4> sound() { return layer.generate<scarp::Quad4>(); }

scarp::Mesh<scarp::Quad8> with_block() {
  auto mesh = layer.generate<scarp::Quad8>({-15.0, -5.0});
  scarp::mark_footing_base(mesh, -10.0, 10.0);
  scarp::add_footing_block(mesh, 2.0, 1.0);
  return mesh;
}

template <class Element>
void remove(scarp::Mesh<Element>& mesh, std::size_t element) {
  mesh.elements.erase(mesh.elements.begin() + static_cast<std::ptrdiff_t>(element));
  mesh.element_region.erase(mesh.element_region.begin() + static_cast<std::ptrdiff_t>(element));
}

/// The element whose centre is nearest to a place.
std::size_t element_at(scarp::Mesh<scarp::Quad4> const& mesh, scarp::Vector<2> const& place) {
  std::size_t nearest = 0;
  double least = 1e300;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    scarp::Vector<2> centre = scarp::Vector<2>::Zero();
    for (int const node : mesh.elements[e]) centre += mesh.nodes[static_cast<std::size_t>(node)] / 4.0;
    if (double const away = (centre - place).norm(); away < least) {
      least = away;
      nearest = e;
    }
  }
  return nearest;
}

}  // namespace

TEST_CASE_TEMPLATE("a sound ground passes through a file", Element, scarp::Quad8,
                   scarp::Hex8 ALSO_NIGHTLY(scarp::Tri3, scarp::Tet4)) {
  auto const mesh = layer.generate<Element>();
  auto const ground = through_file(mesh);
  CHECK(ground.mesh({}).nodes.size() == mesh.nodes.size());
  CHECK(ground.surface_level() == 25.0);
  CHECK(scarp::bottom_level(ground.given) == 0.0);
}

TEST_CASE("both grounds are asked alike") {
  scarp::StructuredGround<scarp::Quad8> const made{layer};
  auto const given = through_file(made.mesh({-15.0, -5.0}));
  CHECK(made.surface_level() == given.surface_level());
  CHECK(made.mesh({-15.0, -5.0}).nodes.size() == given.mesh({-15.0, -5.0}).nodes.size());
}

TEST_CASE("a ground at another height keeps its levels") {
  auto mesh = sound();
  for (auto& node : mesh.nodes) node.y() -= 100.0;
  auto const ground = through_file(mesh);
  CHECK(ground.surface_level() == -75.0);
  CHECK(scarp::bottom_level(ground.given) == -100.0);
}

TEST_CASE_TEMPLATE("a file of the straight element serves for the quadratic one", Element,
                   scarp::Quad8 ALSO_NIGHTLY(scarp::Tri6)) {
  ScratchFolder const folder;
  scarp::write_gmsh(folder / "ground.msh", layer.generate<typename Element::Linear>());
  auto const ground = scarp::ground_from_file<Element>(folder / "ground.msh");
  CHECK(ground.given.nodes.size() == layer.generate<Element>().nodes.size());
}

TEST_CASE("a file of the quadratic element serves for the straight one on request") {
  ScratchFolder const folder;
  scarp::write_gmsh(folder / "ground.msh", layer.generate<scarp::Quad8>());
  std::vector<std::string> notes;
  auto const ground = scarp::ground_from_file<scarp::Quad4>(folder / "ground.msh", &notes, 1);
  CHECK(ground.given.nodes.size() == sound().nodes.size());
  CHECK(ground.given.boundaries.at("surface").size() == sound().boundaries.at("surface").size());
  CHECK(notes.size() == 2);  // of elements and of sides
  CHECK_REFUSED(scarp::ground_from_file<scarp::Quad4>(folder / "ground.msh"), "highest_order = 1 as Quad4");
}

TEST_CASE("a ground in millimetres is noted") {
  ScratchFolder const folder;
  auto mesh = sound();
  for (auto& node : mesh.nodes) node *= 1e3;
  scarp::write_gmsh(folder / "ground.msh", mesh);
  std::vector<std::string> notes;
  static_cast<void>(scarp::ground_from_file<scarp::Quad4>(folder / "ground.msh", &notes));
  REQUIRE(notes.size() == 1);
  CHECK(samples::contains(notes[0], "m deep (from 0.1 m to 1000 m are usual): lengths are metres"));
}

TEST_CASE_TEMPLATE("a ground without groups is named by place", Element, scarp::Quad4, scarp::Hex8) {
  ScratchFolder const folder;
  auto const named = layer.generate<Element>();
  auto bare = named;
  bare.boundaries.clear();
  scarp::write_gmsh(folder / "ground.msh", bare, {scarp::GmshVersion::v2_2, scarp::GmshEncoding::text});
  std::string text = samples::content(folder / "ground.msh");
  std::string const group = Element::dim == 2 ? " 3 2 1 1 " : " 5 2 1 1 ";
  for (auto at = text.find(group); at != std::string::npos; at = text.find(group, at)) text[at + 5] = '0';
  scarp::write_file(folder / "ground.msh", text);
  std::vector<std::string> notes;
  auto const ground = scarp::ground_from_file<Element>(folder / "ground.msh", &notes);
  CHECK(ground.given.regions == named.regions);
  for (auto const& [name, sides] : named.boundaries) CHECK(ground.given.boundaries.at(name).size() == sides.size());
  CHECK(ground.given.boundaries.size() == named.boundaries.size());
  REQUIRE(notes.size() == 4);  // an empty group, elements in none, and what they and the sides are called
  CHECK(samples::contains(notes[2], "all are 'soil'"));
  CHECK(samples::contains(notes[3], "named by their place"));
  auto hole = named;
  hole.boundaries.clear();
  remove(hole, hole.elements.size() / 2);
  CHECK(complaint(hole) == Naming{"bounds the soil but is in none of"});
}

TEST_CASE("a footing in the file is taken, with its block or without") {
  auto mesh = with_block();
  auto const ground = through_file(mesh);
  auto taken = ground.mesh({-15.0, -5.0});
  scarp::mark_footing_base(taken, -10.0, 10.0);
  scarp::add_footing_block(taken, 2.0, 1.0);
  CHECK(taken.elements.size() == mesh.elements.size());
  auto marked = layer.generate<scarp::Quad4>({-15.0, -5.0});
  scarp::mark_footing_base(marked, -10.0, 10.0);
  CHECK(scarp::boundary(through_file(marked).given, "footing_base").size() ==
        scarp::boundary(marked, "footing_base").size());
}

TEST_CASE("the unstructured meshes of the examples are grounds with a node at the tip") {
  auto const at_tip = [](auto const& mesh) {
    int found = 0;
    for (int const node : scarp::boundary_nodes(mesh, "bottom")) {
      found += mesh.nodes[static_cast<std::size_t>(node)].norm() == 0.0 ? 1 : 0;
    }
    return found;
  };
  auto const triangles = scarp::ground_from_file<scarp::Tri3>(example("fault_rupture/meshes/unstructured.msh"));
  CHECK(triangles.given.elements.size() == 929);  // regression: Gmsh 4.8.4 with unstructured.geo
  CHECK(triangles.surface_level() == 25.0);
  CHECK(at_tip(triangles.given) == 1);
  auto const quads = scarp::ground_from_file<scarp::Quad8>(example("own_ground/own_ground.msh"));
  CHECK(quads.given.elements.size() == 332);  // regression: likewise with own_ground.geo
  CHECK(quads.surface_level() == 20.0);
  CHECK(at_tip(quads.given) == 1);
}

TEST_CASE("a file of other elements is refused") {
  CHECK_REFUSED(scarp::ground_from_file<scarp::Quad4>(example("fault_rupture/meshes/unstructured.msh")),
                "unstructured.msh");
}

TEST_CASE("an edge of a structure without a corner node is refused with the nearest") {
  auto const ground = through_file(layer.generate<scarp::Quad8>({-15.0, -5.0}));
  CHECK_NOTHROW(ground.mesh({-5.0, -15.0}));
  CHECK_THROWS_WITH_AS(ground.mesh({-15.0, -7.0}), doctest::Contains("(the nearest are at -5 and -10 m)"),
                       scarp::InputError);
}

TEST_CASE("other regions than soil and footing are refused with those there are") {
  auto mesh = sound();
  mesh.regions = {"sand"};
  CHECK(complaint(mesh) == Naming{"ground.msh': the mesh has elements in the regions sand (a ground has 'soil'"});
  mesh.regions = {"soil", "clay"};
  mesh.element_region.back() = 1;
  CHECK(complaint(mesh) == Naming{"in the regions soil, clay ("});
}

TEST_CASE("a missing boundary is refused with those there are") {
  for (char const* const name : {"left", "right", "bottom", "surface"}) {
    auto mesh = sound();
    mesh.boundaries.erase(name);
    CHECK(complaint(mesh) ==
          Naming{fmt::format("ground.msh': the mesh has no side in a boundary '{}' (it has: ", name)});
  }
  auto mesh = sound();
  mesh.boundaries.erase("left");
  CHECK(complaint(mesh) == Naming{"'left' (it has: bottom, right, surface)"});
  auto space = layer.generate<scarp::Hex8>();
  space.boundaries.erase("front");
  CHECK(complaint(space) == Naming{"no side in a boundary 'front'"});
  for (char const* const name : {"footing_base", "footing_top"}) {
    auto footing = with_block();
    footing.boundaries.erase(name);
    CHECK(complaint(footing) == Naming{fmt::format("no side in a boundary '{}'", name)});
  }
}

TEST_CASE("boundaries that are not straight at the ends of the soil are refused with a place") {
  using Place = scarp::Vector<2>;
  struct Case {
    char const* text;
    Place (*map)(Place const&);
  };
  for (auto const& [text, map] : {
           Case{"the boundary 'surface' passes through (",
                [](Place const& x) { return Place(x.x(), x.y() * (1.0 + 1e-5 * x.x())); }},
           Case{"the boundary 'bottom' passes through (",
                [](Place const& x) { return Place(x.x(), x.y() + (25.0 - x.y()) * 1e-5 * x.x()); }},
           Case{"the boundary 'left' passes through (",
                [](Place const& x) { return Place(x.x() - 1e-5 * (23.0 - x.x()) * x.y(), x.y()); }},
           Case{"the boundary 'right' passes through (",
                [](Place const& x) { return Place(x.x() + 1e-5 * (x.x() + 52.0) * x.y(), x.y()); }},
       }) {
    auto mesh = sound();
    for (auto& node : mesh.nodes) node = map(node);
    CHECK(complaint(mesh) == Naming{text});
  }
  auto rounded = sound();  // to seven digits
  for (auto& node : rounded.nodes) node = (node * 1e5).array().round().matrix() / 1e5;
  CHECK(complaint(rounded).empty());
}

TEST_CASE("a hole in the ground is refused with a place") {
  auto mesh = sound();
  remove(mesh, element_at(mesh, {-20.0, 12.0}));
  auto const text = complaint(mesh);
  CHECK(text == Naming{"bounds the soil but is in none of left, right, bottom, surface (4 such sides"});
}

TEST_CASE("a part of the outline in no boundary, in two, or twice in one is refused with a place") {
  auto missing = sound();
  missing.boundaries["surface"].pop_back();
  CHECK(complaint(missing) == Naming{"(1 such sides"});
  auto twice = sound();
  twice.boundaries["footing_base"] = {twice.boundaries["surface"].front()};
  CHECK(complaint(twice) == Naming{"is in 'surface' and in 'footing_base'"});
  auto inside = with_block();  // the surcharge would stay below the block
  inside.boundaries["surface"].push_back(inside.boundaries["footing_base"].back());
  CHECK(complaint(inside) == Naming{"is in 'surface' and in 'footing_base'"});
  inside.boundaries["footing_base"].pop_back();
  CHECK(complaint(inside) == Naming{"is in 'surface' but lies between two elements"});
}

TEST_CASE("a crack and a hanging node are refused with a place") {
  auto torn = sound();
  std::size_t const element = element_at(torn, {-20.0, 12.0});
  int& corner = torn.elements[element][2];
  torn.nodes.push_back(torn.nodes[static_cast<std::size_t>(corner)]);
  corner = static_cast<int>(torn.nodes.size()) - 1;
  CHECK(complaint(torn) == Naming{"are both at ("});

  auto hanging = sound();  // an element is divided, its neighbours are not
  std::size_t const divided = element_at(hanging, {-20.0, 12.0});
  auto const ring = hanging.elements[divided];
  int const first = static_cast<int>(hanging.nodes.size());
  auto const at = [&](std::size_t k) { return hanging.nodes[static_cast<std::size_t>(ring[k])]; };
  scarp::Vector<2> const below = (at(0) + at(1)) / 2.0;
  scarp::Vector<2> const above = (at(3) + at(2)) / 2.0;
  hanging.nodes.push_back(below);
  hanging.nodes.push_back(above);
  hanging.elements[divided] = {ring[0], first, first + 1, ring[3]};
  hanging.elements.push_back({first, ring[1], ring[2], first + 1});
  hanging.element_region.push_back(0);
  CHECK(complaint(hanging) == Naming{"hangs: it is a corner inside a side of element"});
}
