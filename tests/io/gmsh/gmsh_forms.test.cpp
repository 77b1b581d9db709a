// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/gmsh/detail/gmsh_forms.hpp"

#include <doctest/doctest.h>

#include "io/mesh_samples.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Tri3;
using Notes = std::vector<std::string>;

/// Four triangles of a rectangle of 2 m by 1 m, the left two in group 1, the right two in group 2; below them "bottom".
std::string const format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
std::string const names = "$PhysicalNames\n3\n2 1 \"clay\"\n2 2 \"sand\"\n1 4 \"bottom\"\n$EndPhysicalNames\n";
std::string const nodes = "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n";
std::string const elements =
    "$Elements\n6\n7 2 2 1 1 1 2 5\n8 2 2 1 1 1 5 4\n9 2 2 2 2 2 3 6\n10 2 2 2 2 2 6 5\n11 1 2 4 1 1 2\n12 1 2 4 1 2 "
    "3\n"
    "$EndElements\n";
std::string const strip = format + names + nodes + elements;

/// The same with one entity for each group of elements; groups: what the two surfaces say of theirs.
std::string strip_41(std::string const& left, std::string const& right, std::string const& group_names = names) {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + group_names +
         "$Entities\n0 1 2 0\n1 0 0 0 2 0 0 1 4 0\n1 0 0 0 1 1 0 " + left + " 0\n2 1 0 0 2 1 0 " + right +
         " 0\n$EndEntities\n$Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 "
         "0\n$EndNodes\n"
         "$Elements\n3 6 7 12\n2 1 2 2\n7 1 2 5\n8 1 5 4\n2 2 2 2\n9 2 3 6\n10 2 6 5\n1 1 1 2\n11 1 2\n12 2 "
         "3\n$EndElements\n";
}

std::string with(std::string text, std::string_view old, std::string_view other) {
  auto const at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), other);
}

std::string with_all(std::string text, std::string_view old, std::string_view other) {
  for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + other.size()))
    text.replace(at, old.size(), other);
  return text;
}

template <class Element>
void check_same(scarp::Mesh<Element> const& read, scarp::Mesh<Element> const& wanted) {
  CHECK(read.nodes == wanted.nodes);
  CHECK(read.elements == wanted.elements);
  CHECK(read.regions == wanted.regions);
  CHECK(read.element_region == wanted.element_region);
  CHECK(read.boundaries == wanted.boundaries);
}

template <class Element = Tri3>
scarp::Mesh<Element> read(std::string const& text, scarp::GmshOptions const& options = {}) {
  return scarp::GmshFile(text, "m.msh", options).mesh<Element>();
}

Notes notes(std::string const& text, scarp::GmshOptions const& options = {}) {
  return scarp::GmshFile(text, "m.msh", options).notes();
}

}  // namespace

TEST_CASE("one mesh reads alike however a file writes it") {
  auto const plain = read(strip);
  CHECK(samples::volume(plain) == samples::Approx(2.0));
  CHECK(plain.element_region == std::vector<int>{0, 0, 1, 1});
  for (auto const* version : {"2 0 8", "2.0 0 8", "2.1 0 8", "2.2 0 4"})
    check_same(read(with(strip, "2.2 0 8", version)), plain);
  check_same(read(strip_41("1 1", "1 2")), plain);
  check_same(read("\xEF\xBB\xBF// by a script\nof mine, $ 5\n\n" + strip), plain);
  check_same(read(with(strip, "$Nodes", "// nodes\n# and more\n$Nodes")), plain);
  check_same(read(with_all(strip, "\n", "\r\n")), plain);
  check_same(read(with(with(strip, "2 1 0 0", "2 1.0D+00 0.d0 0"), "6 2 1 0", "6 +2.0D0 10.D-1 0D0")), plain);
  // Tags in another order and with gaps, a node of no element.
  auto const others = with(with(with(strip, "$Nodes\n6\n1 0 0 0\n2 1 0 0", "$Nodes\n7\n2 1 0 0\n90 5 5 0\n1 0 0 0"),
                                "7 2 2 1 1 1 2 5\n", ""),
                           "12 1 2 4", "7 2 2 1 1 1 2 5\n31 1 2 4");
  check_same(read(others), plain);
  auto const parametric = with_all(with_all(with_all(strip, "Nodes", "ParametricNodes"), "1 0 0 0\n", "1 0 0 0 0 9\n"),
                                   "2 1 0 0\n", "2 1 0 0 1 9 0.5\n");
  check_same(read(with(with(with(with(parametric, "3 2 0 0\n", "3 2 0 0 0 1\n"), "4 0 1 0\n", "4 0 1 0 0 1\n"),
                            "5 1 1 0\n", "5 1 1 0 2 1 0.5 0.5\n"),
                       "6 2 1 0\n", "6 2 1 0 0 1\n")),
             plain);
}

TEST_CASE("a partitioned file reads as the whole") {
  auto const whole = read(strip_41("1 1", "1 2"));
  // Gmsh keeps the entities and adds theirs that are shared out, with parents, partitions and the parents' groups.
  auto const shared =
      with(strip_41("1 1", "1 2"), "$Nodes",
           "$PartitionedEntities\n2\n1\n7 2\n1 2 2 0\n5 0 1 1 1 0 0 0 0\n8 1 1 2 1 2 0 0 0 2 0 0 1 4 2 5 -5\n"
           "12 2 1 2 1 2 1 0 0 1 1 0 1 1 0\n8 2 1 1 1 0 0 0 1 1 0 1 1 0\n9 2 2 1 2 1 0 0 2 1 0 1 2 "
           "0\n$EndPartitionedEntities\n$Nodes");
  auto const parts =
      with(with(with(shared, "2 1 2 2\n7", "2 8 2 2\n7"), "2 2 2 2\n9", "2 9 2 2\n9"), "1 1 1 2\n11", "1 8 1 2\n11");
  check_same(read(parts), whole);
  // The line between the partitions has the group of the surface that it divides, which is no group of sides.
  check_same(read(with(with(parts, "3 6 7 12", "4 7 7 13"), "12 2 3\n", "12 2 3\n1 12 1 1\n13 2 5\n")), whole);
}

TEST_CASE("of several groups of an element the smallest counts") {
  auto const plain = read(strip);
  auto const four = with(names, "3\n", "4\n2 3 \"all\"\n");
  auto const of_41 = strip_41("2 1 3", "2 3 2", four);
  check_same(read(of_41), plain);
  CHECK(notes(of_41) == Notes{"'m.msh': elements of the physical group 'all' are in 'clay', 'sand' too, which count"});
  // MSH 2 lists an element once for each group, in any order of its nodes.
  auto const copies = with(with(format + four + nodes + elements, "$Elements\n6", "$Elements\n10"), "11 1 2 4",
                           "20 2 2 3 1 5 1 2\n21 2 2 3 1 1 5 4\n22 2 2 3 1 2 3 6\n23 2 2 3 1 2 6 5\n11 1 2 4");
  check_same(read(copies), plain);
  // The same elements: the lower tag; a wanted group before any other, so that others may lose all elements.
  CHECK(read(strip_41("2 3 1", "2 3 1", four)).regions == std::vector<std::string>{"clay", "sand"});
  auto const whole = read(of_41, {.regions = {"all", "rock"}});
  CHECK(whole.regions == std::vector<std::string>{"all"});
  CHECK(whole.element_region == std::vector<int>{0, 0, 0, 0});
  // "all" is more than "sand" here and keeps the rest.
  auto const rest = read(strip_41("1 3", "2 3 2", four));
  CHECK(rest.regions == std::vector<std::string>{"clay", "sand", "all"});
  CHECK(rest.element_region == std::vector<int>{2, 2, 1, 1});
  // Both signs and two tags of one name are one group.
  CHECK(read(strip_41("2 1 -1", "1 2")).element_region == plain.element_region);
  CHECK(read(strip_41("2 1 3", "1 2", with(four, "all", "clay"))).regions == plain.regions);
}

TEST_CASE("groups of which none holds the other are refused with what helps") {
  auto const five = with(names, "3\n", "5\n2 3 \"wet\"\n2 5 \"loam\"\n");
  auto const third = with(with(with(strip_41("2 1 3", "1 2", five), "0 1 2 0\n", "0 1 3 0\n"), " 0\n$EndEntities",
                               " 0\n3 0 0 0 1 1 0 1 1 0\n$EndEntities"),
                          "2 2 2 2\n9 2 3 6\n10 2 6 5", "2 2 2 1\n9 2 3 6\n2 3 2 1\n10 2 6 5");
  auto const crossed = with(with(third, "3 6 7 12", "4 6 7 12"), "2 1 0 0 2 1 0 1 2", "2 1 0 0 2 1 0 1 3");
  CHECK(samples::message_of([&] { read(crossed); }) ==
        samples::Naming{
            "element 7 of 'm.msh' is in the physical groups 'clay' and 'wet', and neither holds the other (an "
            "element has one material): write `Physical Surface(\"wet\") -= {...};` in the .geo file, or read"});
  CHECK(read(crossed, {.regions = {"wet"}}).element_region == std::vector<int>{2, 2, 2, 0});
}

TEST_CASE("groups that stand as data of the elements are taken where elements have none") {
  auto const bare =
      with_all(with_all(with_all(strip, " 2 2 1 1 ", " 2 2 0 1 "), " 2 2 2 2 ", " 2 2 0 2 "), " 1 2 4 1 ", " 1 2 0 1 ");
  auto const data =
      "$ElementData\n1\n\"gmsh:physical\"\n1\n0.0\n3\n0\n1\n6\n7 1\n8 1.0\n9 2\n10 2\n11 4\n12 4\n$EndElementData\n";
  check_same(read(bare + data), read(strip));
  CHECK(notes(bare + data) == Notes{"'m.msh': the data 'gmsh:physical' are the physical groups"});
  CHECK(read(with(strip, "8 2 2 1 1", "8 2 2 2 1") + data).element_region == std::vector<int>{0, 1, 1, 1});
  CHECK(samples::contains(notes(strip + with(data, "gmsh:physical", "soil:region"))[0], "$ElementData is not read"));
  CHECK(samples::message_of([&] { read(bare + with(data, "8 1.0", "8 x")); }) ==
        samples::Naming{"line 38 of 'm.msh' has 'x' for the physical group of an element"});
}

TEST_CASE("elements that run clockwise are turned and told") {
  auto const turned = with(with(strip, "1 2 5", "1 5 2"), "2 3 6", "2 6 3");
  auto const mesh = read(turned);
  CHECK(samples::volume(mesh) == samples::Approx(2.0));
  CHECK(mesh.elements[0] == std::array<int, 3>{0, 1, 4});
  CHECK(notes(turned) == Notes{"'m.msh': 2 elements run clockwise: they are turned"});
  CHECK(read(turned).boundaries == read(strip).boundaries);
  // Far from the origin, where products of coordinates have no digits left for an area.
  auto const far = with(strip, nodes,
                        "$Nodes\n6\n1 1e9 1e9 0\n2 1000000001 1e9 0\n3 1000000002 1e9 0\n4 1e9 1000000001 0\n"
                        "5 1000000001 1000000001 0\n6 1000000002 1000000001 0\n$EndNodes\n");
  CHECK(notes(far).empty());
  CHECK(samples::volume(read(far)) == samples::Approx(2.0));
}

TEST_CASE("nodes that no element here has are left out, on request all but corners") {
  // One quadrangle of nine nodes, its middle anywhere, with sides of three.
  auto const nine =
      format +
      "$Nodes\n9\n1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n5 1 -0.1 0\n6 2 0.5 0\n7 1 1.1 0\n8 0 0.5 0\n"
      "9 1.2 0.6 0\n$EndNodes\n$Elements\n2\n1 8 2 4 1 1 2 5\n2 10 2 1 1 1 2 3 4 5 6 7 8 9\n$EndElements\n";
  auto const eight = read<scarp::Quad8>(nine);
  CHECK(eight.nodes.size() == 8);
  CHECK(samples::volume(eight) == samples::Approx(2.0 + 2.0 * 2.0 / 3.0 * 2.0 * 0.1));  // analytic: two parabolas
  CHECK(eight.boundaries.at("physical_4").size() == 1);
  CHECK(notes(nine) == Notes{"'m.msh': each 9-node quadrangle is read as 8-node quadrangle, without its other nodes"});
  auto const four = read<scarp::Quad4>(nine, {.highest_order = 1});
  CHECK(four.nodes.size() == 4);
  CHECK(samples::volume(four) == samples::Approx(2.0));
  CHECK(four.boundaries.at("physical_4") == std::vector<std::array<int, 2>>{{0, 1}});
  CHECK(notes(nine, {.highest_order = 1}).size() == 2);  // of quadrangles and of lines
  CHECK(samples::message_of([&] { read<scarp::Quad4>(nine); }) ==
        samples::Naming{"read it as Quad8, or with highest_order = 1 as Quad4"});
  CHECK(notes(strip, {.highest_order = 1}).empty());
}

TEST_CASE("every type of element has the straight one of its shape") {
  for (auto const& type : scarp::detail::gmsh_types) {
    CAPTURE(type.name);
    auto const straight = scarp::detail::without_gmsh_nodes(type, 1);
    CHECK(straight.dim == type.dim);
    CHECK(straight.nodes <= type.nodes);
    CHECK(straight.nodes <= 8);
    CHECK(scarp::detail::without_gmsh_nodes(straight, 1).type == straight.type);
  }
}
