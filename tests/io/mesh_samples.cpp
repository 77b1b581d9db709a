// SPDX-License-Identifier: BSL-1.0
// mesh_samples write FOLDER        writes <element>_<straight or bent>.vtu and _<format>.msh of each element type
// mesh_samples read FILE ELEMENT   reads a Gmsh file and prints what it holds, as JSON
// Both are for tests/io/mesh_files.test.py.
#include "io/mesh_samples.hpp"

#include <fmt/format.h>
#include <cstdio>
#include <exception>
#include <span>

#include "io/mesh_tables.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/io/vtu.hpp"
#include "support/gmsh_writer.hpp"

namespace {

using scarp::GmshEncoding;
using scarp::GmshVersion;

template <class Element>
void write_all(std::filesystem::path const& stem, scarp::Mesh<Element> const& mesh) {
  std::vector<double> height;
  std::vector<double> displacement;
  std::vector<int> number;
  for (auto const& node : mesh.nodes) {
    height.push_back(node(1));
    for (int k = 0; k < Element::dim; ++k) displacement.push_back(1e-3 * (k + 1) * node(0));
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) number.push_back(static_cast<int>(e));
  auto const name = stem.string();
  scarp::write_vtu(name + ".vtu", mesh, mesh.nodes,
                   {.at_nodes = {{"height", 1, std::span<double const>(height)},
                                 {"displacement", Element::dim, std::span<double const>(displacement)}},
                    .at_elements = {{"number", 1, std::span<int const>(number)}}});
  scarp::write_gmsh(name + "_22_text.msh", mesh, {GmshVersion::v2_2, GmshEncoding::text});
  scarp::write_gmsh(name + "_22_binary.msh", mesh, {GmshVersion::v2_2, GmshEncoding::binary});
  scarp::write_gmsh(name + "_41_text.msh", mesh, {GmshVersion::v4_1, GmshEncoding::text});
  scarp::write_gmsh(name + "_41_binary.msh", mesh, {GmshVersion::v4_1, GmshEncoding::binary});
  std::filesystem::create_directory(stem);
  samples::write_mesh_tables(stem, mesh);
}

void write_samples(std::filesystem::path const& folder) {
  samples::for_each_element([&](std::string const& name, auto element) {
    using Element = decltype(element);
    write_all(folder / (name + "_straight"), samples::mesh_sample<Element>(samples::sheared));
    write_all(folder / (name + "_bent"), samples::mesh_sample<Element>(samples::bent));
  });
}

template <class Element>
double content(std::vector<std::array<int, Element::facet_nodes>> const& sides, scarp::Mesh<Element> const& mesh) {
  using Facet = typename Element::Facet;
  double sum = 0.0;
  for (auto const& side : sides) {
    auto const rows = scarp::corners<Facet, Element::dim>(side, mesh.nodes);
    for (auto const& point : Facet::quadrature()) {
      sum += point.weight * scarp::measure<Facet, Element::dim>(rows, point.xi);
    }
  }
  return sum;
}

template <class Element>
void print(scarp::Mesh<Element> const& mesh) {
  scarp::validate(mesh);
  fmt::print("{{\"nodes\": {}, \"elements\": {}, \"volume\": {}, \"regions\": {{", mesh.nodes.size(),
             mesh.elements.size(), samples::volume(mesh));
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    auto const held = std::count(mesh.element_region.begin(), mesh.element_region.end(), static_cast<int>(r));
    fmt::print("{}\"{}\": {}", r == 0 ? "" : ", ", mesh.regions[r], held);
  }
  fmt::print("}}, \"boundaries\": {{");
  char const* separator = "";
  for (auto const& [name, sides] : mesh.boundaries) {
    fmt::print("{}\"{}\": [{}, {}]", separator, name, sides.size(), content(sides, mesh));
    separator = ", ";
  }
  fmt::print("}}, \"coordinates\": [");
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    fmt::print("{}[{}]", n == 0 ? "" : ", ", fmt::join(mesh.nodes[n], ", "));
  }
  fmt::print("], \"connectivity\": [");
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    fmt::print("{}[{}]", e == 0 ? "" : ", ", fmt::join(mesh.elements[e], ", "));
  }
  fmt::print("]}}\n");
}

bool read_and_print(std::filesystem::path const& path, std::string const& wanted) {
  bool known = false;
  samples::for_each_element([&](std::string const& name, auto element) {
    if (name != wanted) return;
    known = true;
    print(scarp::read_gmsh<decltype(element)>(path));
  });
  return known;
}

}  // namespace

int main(int given, char** words) {
  std::vector<std::string> const arguments(words + 1, words + given);
  try {
    if (arguments.size() == 2 && arguments[0] == "write") {
      write_samples(arguments[1]);
      return 0;
    }
    if (arguments.size() == 3 && arguments[0] == "read" && read_and_print(arguments[1], arguments[2])) return 0;
    fmt::print(stderr, "use: mesh_samples write FOLDER, mesh_samples read FILE ELEMENT\n");
    return 2;
  } catch (std::exception const& error) {
    fmt::print(stderr, "mesh_samples: {}\n", error.what());
    return 1;
  }
}
