// SPDX-License-Identifier: BSL-1.0
#include "support/gmsh_writer.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <sstream>

#include "io/mesh_samples.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "support/approx.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::content;
using samples::ScratchFolder;

using scarp::GmshEncoding;
using scarp::GmshFormat;
using scarp::GmshVersion;

constexpr std::array all_formats{
    GmshFormat{GmshVersion::v2_2, GmshEncoding::text}, GmshFormat{GmshVersion::v2_2, GmshEncoding::binary},
    GmshFormat{GmshVersion::v4_0, GmshEncoding::text}, GmshFormat{GmshVersion::v4_0, GmshEncoding::binary},
    GmshFormat{GmshVersion::v4_1, GmshEncoding::text}, GmshFormat{GmshVersion::v4_1, GmshEncoding::binary}};

template <class Element>
void check_same(scarp::Mesh<Element> const& read, scarp::Mesh<Element> const& written) {
  CHECK(read.nodes == written.nodes);  // every bit: no number here is a signed zero
  CHECK(read.elements == written.elements);
  CHECK(read.element_region == written.element_region);
  CHECK(read.regions == written.regions);
  CHECK(read.boundaries == written.boundaries);
}

}  // namespace

TEST_CASE("a mesh of any element comes back from any format as it was") {
  ScratchFolder const folder;
  samples::for_each_element([&](char const* name, auto element) {
    using Element = decltype(element);
    CAPTURE(name);
    auto const mesh = samples::mesh_sample<Element>(samples::bent);
    scarp::validate(mesh);
    REQUIRE(mesh.boundaries.at("left").size() >= 1);
    for (auto const& format : all_formats) {
      CAPTURE(static_cast<int>(format.version));
      CAPTURE(static_cast<int>(format.encoding));
      scarp::write_gmsh(folder / "m.msh", mesh, format);
      check_same(scarp::read_gmsh<Element>(folder / "m.msh"), mesh);
    }
  });
}

TEST_CASE("a mesh seen in a mirror is turned") {
  ScratchFolder const folder;
  samples::for_each_element([&](char const* name, auto element) {
    using Element = decltype(element);
    CAPTURE(name);
    auto const mesh = samples::mesh_sample<Element>(samples::bent);
    scarp::write_gmsh(folder / "m.msh", mesh, {GmshVersion::v2_2, GmshEncoding::text});
    std::istringstream lines(content(folder / "m.msh"));
    std::string mirrored;
    bool at_nodes = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with('$')) at_nodes = line == "$Nodes";
      std::istringstream words(line);
      std::string tag, x, y, z;
      if (at_nodes && words >> tag >> x >> y >> z) line = fmt::format("{} {} {} {}", tag, y, x, z);
      mirrored += line + '\n';
    }
    scarp::GmshFile const file(mirrored, "m.msh");
    auto const turned = file.mesh<Element>();
    CHECK_NOTHROW(scarp::validate(turned));
    CHECK(samples::volume(turned) == samples::Approx(samples::volume(mesh)).epsilon(1e-14));
    CHECK(file.notes() == std::vector{fmt::format("'m.msh': {} elements run {}: they are turned", mesh.elements.size(),
                                                  Element::dim == 2 ? "clockwise" : "left-handed")});
    CHECK(turned.boundaries.size() == mesh.boundaries.size());
    for (auto const& boundary : mesh.boundaries) {
      CHECK(scarp::boundary_nodes(turned, boundary.first) == scarp::boundary_nodes(mesh, boundary.first));
    }
    for (auto const& nodes : mesh.elements) {
      CHECK(scarp::detail::turned_round<Element>(scarp::detail::turned_round<Element>(nodes)) == nodes);
    }
  });
}

TEST_CASE("samples have the volumes of their maps") {
  samples::for_each_element([&](char const* name, auto element) {
    using Element = decltype(element);
    CAPTURE(name);
    auto const straight = samples::mesh_sample<Element>(samples::sheared);
    CHECK(samples::volume(straight) == samples::Approx(samples::sheared_volume).epsilon(1e-14));
    if constexpr (Element::nodes > 4 && Element::nodes != 8) {  // Quad8 below: Hex8 has as many nodes
      auto const curved = samples::mesh_sample<Element>(samples::bent);
      CHECK(samples::volume(curved) == samples::Approx(samples::bent_volume).epsilon(1e-14));
    }
  });
  auto const curved = samples::mesh_sample<scarp::Quad8>(samples::bent);
  CHECK(samples::volume(curved) == samples::Approx(samples::bent_volume).epsilon(1e-14));
}

TEST_CASE("groups without elements and names with blanks and other letters come back") {
  ScratchFolder const folder;
  auto mesh = samples::mesh_sample<scarp::Tet10>(samples::bent);
  mesh.regions = {"no elements", "lower sand", "Lösslehm"};
  for (int& region : mesh.element_region) ++region;
  mesh.boundaries["none"] = {};
  for (auto const& format : all_formats) {
    scarp::write_gmsh(folder / "m.msh", mesh, format);
    check_same(scarp::read_gmsh<scarp::Tet10>(folder / "m.msh"), mesh);
  }
}

TEST_CASE("a text file is what Gmsh's manual describes") {
  ScratchFolder const folder;
  scarp::Mesh<scarp::Tri3> mesh;
  mesh.nodes = {{0.0, 0.0}, {0.1, 0.0}, {0.0, 1.5}};
  mesh.elements = {{0, 1, 2}};
  mesh.element_region = {0};
  mesh.regions = {"sand"};
  mesh.boundaries["ground"] = {{0, 1}};
  std::string const names = "$PhysicalNames\n2\n2 1 \"sand\"\n1 2 \"ground\"\n$EndPhysicalNames\n";
  scarp::write_gmsh(folder / "m.msh", mesh, {GmshVersion::v2_2, GmshEncoding::text});
  CHECK(content(folder / "m.msh") == "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
                                         "$Nodes\n3\n1 0 0 0\n2 0.1 0 0\n3 0 1.5 0\n$EndNodes\n"
                                         "$Elements\n2\n1 2 2 1 1 1 2 3\n2 1 2 2 2 1 2\n$EndElements\n");
  std::string const entities = "$Entities\n0 1 1 0\n2 0 0 0 0.1 1.5 0 1 2 0\n1 0 0 0 0.1 1.5 0 1 1 0\n$EndEntities\n";
  scarp::write_gmsh(folder / "m.msh", mesh, {GmshVersion::v4_0, GmshEncoding::text});
  CHECK(content(folder / "m.msh") == "$MeshFormat\n4 0 8\n$EndMeshFormat\n" + names + entities +
                                         "$Nodes\n1 3\n1 2 0 3\n1 0 0 0\n2 0.1 0 0\n3 0 1.5 0\n$EndNodes\n"
                                         "$Elements\n2 2\n1 2 2 1\n1 1 2 3\n2 1 1 1\n2 1 2\n$EndElements\n");
  scarp::write_gmsh(folder / "m.msh", mesh, {GmshVersion::v4_1, GmshEncoding::text});
  CHECK(content(folder / "m.msh") == "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names + entities +
                                         "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n0.1 0 0\n0 1.5 0\n$EndNodes\n"
                                         "$Elements\n2 2 1 2\n2 1 2 1\n1 1 2 3\n1 2 1 1\n2 1 2\n$EndElements\n");
}

TEST_CASE("what cannot be written is refused and an older file stays") {
  ScratchFolder const folder;
  auto const path = folder / "m.msh";
  scarp::write_file(path, "older");
  auto const good = samples::mesh_sample<scarp::Tri3>(samples::sheared);
  auto mesh = good;
  mesh.regions[1] = "the \"upper\" sand";
  CHECK_REFUSED(scarp::write_gmsh(path, mesh), "'the \"upper\" sand'", "1 to 127");
  mesh = good;
  mesh.boundaries["two\nlines"] = {};
  CHECK_REFUSED(scarp::write_gmsh(path, mesh), "'two");
  mesh = good;
  mesh.regions[1] = mesh.regions[0];
  CHECK_REFUSED(scarp::write_gmsh(path, mesh), mesh.regions[0]);
  mesh = good;
  std::swap(mesh.elements[0][0], mesh.elements[0][1]);
  CHECK_REFUSED(scarp::write_gmsh(path, mesh), "element 0", "Jacobian");
  CHECK(content(path) == "older");
  CHECK(samples::message_of<scarp::FileError>([&] { scarp::write_gmsh(folder / "no/m.msh", good); }) ==
        samples::Naming{"no/m.msh"});
}
