// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/gmsh/gmsh_reader.hpp"

#include <doctest/doctest.h>

#include "io/mesh_samples.hpp"
#include "scarp/io/atomic_file.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Naming;
using samples::ScratchFolder;

/// Two triangles of a unit square, sparse tags in any order, a node of no element and a point.
std::string const square_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 4 "ground"
2 1 "sand"
$EndPhysicalNames
$Nodes
5
40 1 1 0
7 0 0 0
900 0.5 9 0
12 1 0 0
31 0 1 0
$EndNodes
$Elements
5
1 15 2 9 1 7
5 1 2 4 1 12 7
6 1 2 0 3 12 40
30 2 2 2 1 7 40 31
21 2 3 1 1 77 7 12 40
$EndElements
)";

std::string const square_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 1 1 0
5 0 0 0 1 0 0 1 -4 2 1 2
3 0 0 0 1 1 0 0 1 5
$EndEntities
$Nodes
2 4 7 40
1 5 1 1
12
1 0 0 0.5
2 3 0 3
40
7
31
1 1 0
0 0 0
0 1 0
$EndNodes
$Elements
2 3 1 9
1 5 1 1
1 7 12
2 3 2 2
8 7 12 40
9 7 40 31
$EndElements
)";

std::string with(std::string text, std::string_view old, std::string_view other) {
  auto const at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), other);
}

template <class Element = scarp::Tri3>
scarp::Mesh<Element> read(std::string const& text) {
  ScratchFolder const folder;
  scarp::write_file(folder / "m.msh", text);
  return scarp::read_gmsh<Element>(folder / "m.msh");
}

/// What the reader says, with the file's folder left out; empty when it has nothing to say.
template <class Element = scarp::Tri3>
std::string complaint(std::string const& text) {
  ScratchFolder const folder;
  scarp::write_file(folder / "m.msh", text);
  std::string said = samples::message_of([&] { scarp::read_gmsh<Element>(folder / "m.msh"); });
  auto const name = folder.path().string() + "/";
  for (auto at = said.find(name); at != std::string::npos; at = said.find(name)) said.erase(at, name.size());
  return said;
}

}  // namespace

TEST_CASE("nodes and elements are numbered in the order of their tags, what no element uses is left out") {
  auto const mesh = read(square_22);
  CHECK(mesh.nodes == std::vector<scarp::Vector<2>>{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}});
  CHECK(mesh.elements == std::vector<std::array<int, 3>>{{0, 1, 3}, {0, 3, 2}});
  CHECK(mesh.regions == std::vector<std::string>{"sand", "physical_2"});
  CHECK(mesh.element_region == std::vector<int>{0, 1});
  // The side is given the wrong way round and turned to the outward normal; the one in no group is left out.
  REQUIRE(mesh.boundaries.size() == 1);
  CHECK(mesh.boundaries.at("ground") == std::vector<std::array<int, 2>>{{0, 1}});
}

TEST_CASE("version 4.1 finds groups by entities, with signs and parameters") {
  auto const mesh = read(square_41);
  CHECK(mesh.nodes == std::vector<scarp::Vector<2>>{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}});
  CHECK(mesh.elements == std::vector<std::array<int, 3>>{{0, 1, 3}, {0, 3, 2}});
  CHECK(mesh.regions == std::vector<std::string>{"mesh"});
  REQUIRE(mesh.boundaries.size() == 1);
  CHECK(mesh.boundaries.at("physical_4") == std::vector<std::array<int, 2>>{{0, 1}});
}

TEST_CASE("a block of no elements says nothing, whatever its type") {
  auto const text = with(with(square_41, "2 3 1 9", "3 3 1 9"), "2 3 2 2\n", "1 5 8 0\n2 3 2 2\n");
  CHECK(read(text).elements == read(square_41).elements);
  CHECK(read(text).boundaries == read(square_41).boundaries);
}

TEST_CASE("the sign of a region in version 4.1 turns its elements") {
  // Gmsh 4.8 saves "Physical Surface(5) = {-3}" so; in version 2.2 it turns the elements itself.
  auto const turned =
      with(with(square_41, "0 1 5\n$EndE", "1 -5 0\n$EndE"), "7 12 40\n9 7 40 31", "7 40 12\n9 7 31 40");
  CHECK(read(turned).elements == read(square_41).elements);
  CHECK(scarp::GmshFile(turned, "m.msh").notes().empty());
}

TEST_CASE("a cell that is turned round twice is the same") {
  samples::for_each_element([](char const* name, auto element) {
    using Facet = typename decltype(element)::Facet;
    CAPTURE(name);
    std::array<int, Facet::nodes> nodes{};
    for (int a = 0; a < Facet::nodes; ++a) nodes[static_cast<std::size_t>(a)] = 10 + a;
    auto const turned = scarp::detail::turned_round<Facet>(nodes);
    CHECK_FALSE(scarp::detail::same_winding<Facet>(turned, nodes));
    CHECK(scarp::detail::same_winding<Facet>(scarp::detail::turned_round<Facet>(turned), nodes));
  });
  // By hand: corners 1 4 3 2, then the middles of 1-4, 4-3, 3-2, 2-1.
  CHECK(scarp::detail::turned_round<scarp::Quad8>({1, 2, 3, 4, 12, 23, 34, 41}) ==
        std::array<int, 8>{1, 4, 3, 2, 41, 34, 23, 12});
}

TEST_CASE("other sections, ends of lines as on Windows and a lifted plane do no harm") {
  auto const plain = read(square_22);
  auto text = with(square_22, "$Nodes", "$Periodic\n1\n0 1 1\n$EndPeriodic\n$Nodes");
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) text.insert(at, "\r");
  CHECK(read("$Comments\nmade by hand\n$EndComments\n" + text).elements == plain.elements);
  auto lifted = square_41;
  for (auto const* corner : {"1 0 0 0.5", "1 1 0\n0 0 0\n0 1 0\n"}) {
    std::string other = corner;
    other = other == "1 0 0 0.5" ? "1 0 2.5 0.5" : "1 1 2.5\n0 0 2.5\n0 1 2.5000000001\n";
    lifted = with(lifted, corner, other);
  }
  CHECK(read(lifted).nodes == plain.nodes);
}

TEST_CASE("a boundary between two regions keeps the sense that the file gives it") {
  auto const between = with(square_22, "5 1 2 4 1 12 7", "5 1 2 4 1 40 7");
  CHECK(read(between).boundaries.at("ground") == std::vector<std::array<int, 2>>{{3, 0}});
  auto const other = with(square_22, "5 1 2 4 1 12 7", "5 1 2 4 1 7 40");
  CHECK(read(other).boundaries.at("ground") == std::vector<std::array<int, 2>>{{0, 3}});
}

TEST_CASE("a mesh of other elements is refused and the right element named") {
  CHECK(complaint<scarp::Tet4>(square_22) ==
        Naming{"'m.msh' is a 2D mesh with 2 x type 2 (3-node triangle) (Tet4 needs a 3D one): read it as Tri3"});
  CHECK(complaint<scarp::Quad4>(square_22) ==
        Naming{"'m.msh' holds 2 x type 2 (3-node triangle) (all elements of a mesh of Quad4 are of type 3): read it "
               "as Tri3"});
  CHECK(complaint(with(square_22, "30 2 2 2 1 7 40 31", "30 3 2 2 1 7 12 40 31")) ==
        Naming{"'m.msh' holds 1 x type 2 (3-node triangle), 1 x type 3 (4-node quadrangle) (all elements "
               "of a mesh of Tri3 are of type 2): mesh with one kind of element: `gmsh FILE.geo -2 -setnumber "
               "Mesh.SubdivisionAlgorithm 1` gives"});
  CHECK(complaint(with(square_22, "30 2 2 2 1 7 40 31", "30 4 2 2 1 7 12 40 31")) ==
        Naming{"'m.msh' is a 3D mesh with 1 x type 4 (4-node tetrahedron) (Tri3 needs a 2D one): read it as Tet4"});
  CHECK(complaint(with(square_22, "30 2 2 2 1 7 40 31", "30 6 2 2 1 7 12 40 31 7 12")) ==
        Naming{"(Tri3 needs a 2D one): mesh with another kind"});
  auto const lines =
      with(with(square_22, "30 2 2 2 1 7 40 31", "30 1 2 2 1 7 40"), "21 2 3 1 1 77 7 12 40", "21 1 2 2 1 40 31");
  CHECK(complaint(lines) == Naming{"'m.msh' holds neither surface nor volume elements"});
  CHECK(
      complaint(with(square_22, "5 1 2 4 1 12 7", "5 8 2 4 1 12 7 31")) ==
      Naming{
          "the physical group 'ground' of 'm.msh' holds elements of type 8 (3-node line), such as 5 (the sides of Tri3 "
          "have "
          "type 1)"});
  CHECK(complaint(with(square_22, "30 2 2 2 1", "30 77 2 2 1")) ==
        Naming{"line 22 of 'm.msh' has elements of type 77"});
}

TEST_CASE("types of elements have the numbers of Gmsh's manual, each once") {
  for (int type = 1; type <= 19; ++type) {
    CAPTURE(type);
    auto const* const found = scarp::detail::find_gmsh_type(type);
    REQUIRE(found != nullptr);
    if (type != 15) CHECK(found->name.find(std::to_string(found->nodes) + "-node") != std::string_view::npos);
  }
  for (std::size_t k = 1; k < scarp::detail::gmsh_types.size(); ++k)
    CHECK(scarp::detail::gmsh_types[k].type > scarp::detail::gmsh_types[k - 1].type);
  CHECK(scarp::detail::find_gmsh_type(15)->nodes == 1);
}

TEST_CASE("a file tells the type of its elements before it is read as one") {
  ScratchFolder const folder;
  auto const type_of = [&](std::string const& text) {
    scarp::write_file(folder / "m.msh", text);
    return scarp::GmshFile(folder / "m.msh").element_type();
  };
  CHECK(type_of(square_22) == scarp::Tri3::gmsh_type);
  CHECK(type_of(square_41) == scarp::Tri3::gmsh_type);
  // One triangle becomes a quadrangle: of both types the lower number. Without surfaces there is none.
  CHECK(type_of(with(square_22, "30 2 2 2 1 7 40 31", "30 3 2 2 1 7 12 40 31")) == scarp::Tri3::gmsh_type);
  CHECK(type_of("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 15 2 0 1 1\n"
                "$EndElements\n") == 0);
}

TEST_CASE("a bad mesh is refused with the element or node that is wrong") {
  CHECK(complaint(with(square_22, "40 1 1 0", "40 2 0 0")) ==
        Naming{"element 21 of 'm.msh' (its nodes there: 7, 12, 40) has the Jacobian 0 m^2 (flat, or its nodes run the "
               "wrong way round)"});
  CHECK(complaint(with(square_22, "77 7 12 40", "77 7 12 12")) == Naming{"element 21 of 'm.msh' names a node twice"});
  CHECK(complaint(with(square_22, "12 1 0 0", "7 1 0 0")) == Naming{"'m.msh' lists node 7 twice"});
  CHECK(complaint(with(square_22, "77 7 12 40", "77 7 12 41")) == Naming{"element 21 of 'm.msh' names node 41"});
  CHECK(complaint(with(square_22, "5 1 2 4 1 12 7", "5 1 2 4 1 12 31")) ==
        Naming{"element 5 of 'm.msh' in the physical group 'ground' lies on no side"});
  CHECK(complaint(with(square_22, "5 1 2 4 1 12 7", "5 1 2 4 1 12 8")) == Naming{"element 5 of 'm.msh'"});
  CHECK(complaint(with(square_22, "30 2 2 2 1 7 40 31", "30 2 2 1 1 12 40 7")) ==
        Naming{"elements 21 and 30 of 'm.msh' have the same nodes"});
  CHECK(complaint(with(square_22, "31 0 1 0", "31 0 1 0.01")) ==
        Naming{"node 31 of 'm.msh' is at z = 0.01, node 7 at z = 0"});
  CHECK(complaint(with(square_41, "2 3 2 2\n", "2 4 2 2\n")) ==
        Naming{"line 26 of 'm.msh' names entity 4 of dimension 2"});
  CHECK(complaint(with(square_41, "2 3 2 2\n", "2 3 1 2\n")) ==
        Naming{"line 26 of 'm.msh' has elements of type 1 (2-node line) on an entity of dimension 2"});
}

TEST_CASE("names that a mesh does not have are refused with those that it has") {
  auto const mesh = read(square_22);
  CHECK_REFUSED(scarp::region_number(mesh, "clay"), "region 'clay'", "sand, physical_2");
  CHECK_REFUSED(scarp::boundary(mesh, "top"), "boundary 'top'", "ground");
}

TEST_CASE("a damaged file is refused with the line") {
  CHECK(complaint(with(square_22, "7 0 0 0", "7 0 nan 0")) ==
        Naming{"line 12 of 'm.msh' has the coordinate nan of node 7"});
  CHECK(complaint(with(square_22, "7 0 0 0", "7 0 1e999 0")) ==
        Naming{"line 12 of 'm.msh' has '1e999' for a coordinate"});
  CHECK(complaint(with(square_22, "7 0 0 0", "7 0 x 0")) ==
        Naming{"line 12 of 'm.msh' has 'x' for a coordinate of a node"});
  CHECK(complaint(with(square_22, "Nodes\n5", "Nodes\n6")) ==
        Naming{"line 16 of 'm.msh' has '$EndNodes' for the tag of a node (it is no whole number that can stand here)"});
  CHECK(complaint(with(square_22, "Nodes\n5", "Nodes\n4")) ==
        Naming{"line 15 of 'm.msh' has '31' ($EndNodes must follow)"});
  CHECK(complaint(with(square_22, "Nodes\n5", "Nodes\n-5")) ==
        Naming{"line 10 of 'm.msh' has '-5' for the number of nodes"});
  CHECK(complaint(with(square_22, "Nodes\n5", "Nodes\n5000000000000")) ==
        Naming{"line 10 of 'm.msh' says 5000000000000 for the number of nodes (only "});
  CHECK(complaint(with(square_22, "30 2 2 2", "30 2 -2 2")) ==
        Naming{"line 22 of 'm.msh' has -2 for the number of tags"});
  CHECK(complaint(with(square_22, "30 2 2 2", "30 2 2000000000 2")) ==
        Naming{"line 22 of 'm.msh' says 2000000000 for"});
  CHECK(complaint(with(square_22, "\"sand\"", "sand")) ==
        Naming{"line 7 of 'm.msh' has 'sand' for the name of a physical group"});
  CHECK(complaint(with(square_22, "2 1 \"sand\"", "1 4 \"sand\"")) ==
        Naming{"line 7 of 'm.msh' names group 4 of dimension 1 'sand' (it is 'ground' already)"});
  CHECK(complaint(with(square_41, "2 4 7 40", "2 5 7 40")) ==
        Naming{"the section that ends at line 20 of 'm.msh' holds 4 nodes (it announces 5)"});
  CHECK(complaint(with(square_41, "2 3 1 9", "1 3 1 9")) ==
        Naming{"the section that ends at line 25 of 'm.msh' holds 1 elements (it announces 3)"});
  CHECK(complaint(with(square_41, "1 5 1 1\n1 7", "1 5 1 99999\n1 7")) == Naming{"line 24 of 'm.msh' says 99999 for"});
  CHECK(complaint(square_22.substr(0, 150)) == Naming{"'m.msh' ends at line 16 where"});
  CHECK(complaint(square_22.substr(0, square_22.find("$Elements"))) == Naming{"'m.msh' has no section $Elements"});
}

TEST_CASE("what is no mesh of a version that is read is refused") {
  CHECK(complaint("") == Naming{"'m.msh' is no mesh of MSH 2 or 4 (it does not begin with $MeshFormat): save it by"});
  CHECK(complaint("solid cube\n") == Naming{"line 1 of 'm.msh' has 'solid' (a section such as $Nodes must begin)"});
  CHECK(complaint("$NOD\n1\n1 0 0 0\n$ENDNOD\n") == Naming{"'m.msh' is no mesh of MSH 2 or 4 (it does"});
  for (auto const* version : {"1.0", "2.3", "3.0", "4.2"}) {
    CHECK(complaint(with(square_22, "2.2 0 8", fmt::format("{} 0 8", version))) ==
          Naming{fmt::format("'m.msh' is a mesh of MSH {} (2 to 2.2, 4.0 and 4.1 are read)", std::stod(version))});
  }
  CHECK(complaint(with(square_22, "2.2 0 8", "2.2 2 8")) == Naming{"has file type 2"});
  CHECK(complaint(with(square_22, "2.2 0 8", "2.2 1 4")) == Naming{"numbers of 4 bytes"});
  CHECK(complaint(with(square_22, "2.2 0 8", "2.2 1 8")) ==
        Naming{"byte 20 of 'm.msh' has 0x646e4524 where the number one"});
  CHECK_REFUSED(scarp::read_gmsh<scarp::Tri3>("nowhere.msh"), "nowhere.msh");
  CHECK_REFUSED(scarp::read_gmsh<scarp::Tri3>(std::filesystem::temp_directory_path()),
                std::filesystem::temp_directory_path().string());
  std::string const no_elements = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n0 0 0 0\n$EndElements\n";
  CHECK(complaint(no_elements) == Naming{"'m.msh' holds neither surface nor volume elements"});
}

TEST_CASE("a side is in a boundary once, however often the file says so") {
  std::vector<std::array<int, 2>> const once{{0, 1}};
  // MSH 2.2 repeats a line for each group, and a file may name two groups alike.
  auto const repeated =
      with(with(square_22, "$Elements\n5", "$Elements\n6"), "5 1 2 4 1 12 7", "5 1 2 4 1 12 7\n4 1 2 4 1 7 12");
  CHECK(read(repeated).boundaries.at("ground") == once);
  auto const two_tags = with(with(repeated, "4 1 2 4 1 7 12", "4 1 2 8 1 7 12"), "2\n1 4 \"ground\"",
                             "3\n1 8 \"ground\"\n1 4 \"ground\"");
  CHECK(read(two_tags).boundaries.at("ground") == once);
  // Gmsh keeps the groups of `Physical Curve(4) = {5, -5}` with both signs.
  for (auto const* groups : {"2 -4 4 2 1 2", "2 4 4 2 1 2", "3 4 -4 -4 2 1 2"})
    CHECK(read(with(square_41, "1 -4 2 1 2", groups)).boundaries.at("physical_4") == once);
}

TEST_CASE("what a file names or holds and its mesh has not is told") {
  auto const notes = [](std::string const& text) { return scarp::GmshFile(text, "m.msh").notes(); };
  using Notes = std::vector<std::string>;
  CHECK(notes(square_41).empty());
  CHECK(notes(with(square_22, "2\n1 4", "3\n1 9 \"drain\"\n1 4")) ==
        Notes{"'m.msh': the physical group 'drain' is empty: no element of dimension 1 is in it"});
  // As meshio writes them: names of groups, and elements in none.
  auto const lost = notes(with(with(square_22, "30 2 2 2 1", "30 2 2 0 1"), "21 2 3 1 1", "21 2 3 0 1"));
  REQUIRE(lost.size() == 2);
  CHECK(samples::contains(lost[0], "'sand' is empty"));
  CHECK(samples::contains(lost[1], "2 elements are in no physical group"));
  auto const sections =
      notes(square_22 + "$Periodic\n0\n$EndPeriodic\n$ElementData\n$EndElementData\n$Comments\n$EndComments\n");
  REQUIRE(sections.size() == 2);
  CHECK(samples::contains(sections[0], "$Periodic is not read: nothing ties"));
  CHECK(samples::contains(sections[1], "$ElementData is not read"));
  CHECK(samples::contains(notes(with(square_22, "1 4 \"ground\"", "0 4 \"corner\""))[0],
                          "'corner' of dimension 0 is not read"));
}

TEST_CASE("a boundary without sides is refused to whoever loads or holds it") {
  auto const mesh = read(with(square_22, "2\n1 4", "3\n1 9 \"drain\"\n1 4"));
  CHECK_REFUSED(scarp::boundary(mesh, "drain"), "the boundary 'drain' has no facets");
  CHECK_REFUSED(scarp::boundary_nodes(mesh, "drain"), "the boundary 'drain' has no facets");
}

TEST_CASE("what is no mesh is called by its kind") {
  CHECK(read("\xEF\xBB\xBF" + square_22).elements == read(square_22).elements);
  CHECK(complaint("<!DOCTYPE html><html>404: not found</html>") == samples::Naming{"it is a web page"});
  CHECK(complaint("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n") ==
        samples::Naming{"pointer of Git LFS"});
  CHECK(complaint("\x1f\x8b\x08 and so on") == samples::Naming{"compressed"});
}
