// SPDX-License-Identifier: BSL-1.0
#include "adversary/readers.hpp"
#include "io/mesh_samples.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/mesh/mesh_checks.hpp"
#include "support/elements.hpp"
#include "support/gmsh_writer.hpp"

namespace adversary {

namespace {

// Has neither surfaces nor volumes.
constexpr auto line_alone =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n2 1 0 0\n$EndNodes\n"
    "$Elements\n1\n1 1 2 1 1 1 2\n$EndElements\n";

template <class Element>
Game gmsh_reader() {
  std::vector<std::string> samples{line_alone};
  ScratchFolder const folder;
  auto const mesh = samples::mesh_sample<Element>(samples::bent);
  for (auto const version : {scarp::GmshVersion::v2_2, scarp::GmshVersion::v4_0, scarp::GmshVersion::v4_1}) {
    for (auto const encoding : {scarp::GmshEncoding::text, scarp::GmshEncoding::binary}) {
      scarp::write_gmsh(folder / "m.msh", mesh, {version, encoding});
      samples.push_back(content(folder / "m.msh"));
    }
  }
  return reader(fmt::format("gmsh {}D, {} nodes", Element::dim, Element::nodes), samples, [](std::string const& bytes) {
    auto const read = scarp::GmshFile(bytes, "m.msh").mesh<Element>();
    try {
      scarp::validate(read);
    } catch (InputError const& why) {
      demand(false, fmt::format("what was read is no valid mesh: {}", why.what()));
    }
    for (auto const& [side, facets] : read.boundaries)
      if (!facets.empty()) demand(!scarp::boundary(read, side).empty(), "a boundary that is not found");
    demand(std::isfinite(samples::volume(read)) && samples::volume(read) > 0.0, "a mesh without a volume");
    scarp::require_no_duplicate_nodes(read);
    scarp::require_no_hanging_nodes(read);
  });
}

template <class... Elements>
std::vector<Game> gmsh_readers() {
  return {gmsh_reader<Elements>()...};
}

}  // namespace

// What a file says is read alike for every element; what becomes of it differs by dimension and by nodes on the sides.
std::vector<Game> readers_of_meshes() {
  return gmsh_readers<scarp::Tri3, scarp::Tet10 ALSO_NIGHTLY(scarp::Quad8, scarp::Hex8)>();
}

}  // namespace adversary
