// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/io/atomic_file.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

enum class GmshVersion { v2_2, v4_0, v4_1 };
enum class GmshEncoding { text, binary };

/// The form of a Gmsh file.
struct GmshFormat {
  GmshVersion version = GmshVersion::v4_1;
  GmshEncoding encoding = GmshEncoding::binary;
};

namespace detail {

/// Collects the content of a Gmsh file: numbers as words or as bytes of this machine's order.
class GmshSink {
 public:
  explicit GmshSink(bool binary) : binary_(binary) {}

  bool binary() const { return binary_; }
  std::string const& content() const { return content_; }

  /// Text in both forms.
  void text(std::string_view text) { content_ += text; }

  /// As words in the shortest form that reads back to the same bits.
  template <class... Numbers>
  void values(Numbers const&... numbers) {
    (value(numbers), ...);
  }

  void end_line() {
    if (!binary_) content_.back() = '\n';
  }

  /// Behind the bytes of a section.
  void end_section(std::string_view name) {
    if (binary_) content_ += '\n';
    content_ += fmt::format("$End{}\n", name);
  }

 private:
  template <class Number>
  void value(Number number) {
    if (binary_) {
      content_.append(reinterpret_cast<char const*>(&number), sizeof(number));
    } else {
      fmt::format_to(std::back_inserter(content_), "{} ", number);
    }
  }

  bool binary_;
  std::string content_;
};

}  // namespace detail

}  // namespace scarp

namespace scarp::detail {

/// What a file says of one physical group: elements of a region or sides of a boundary.
struct GmshGroup {
  std::string name;
  std::int32_t dim;
  std::int32_t tag;
};

/// The elements of one group, all of one type.
struct GmshRun {
  GmshGroup group;
  std::int32_t type;
  std::int32_t nodes_each;
  std::vector<std::int32_t> tags{};
  std::vector<std::int32_t> nodes{};  ///< tags, in Gmsh's order

  std::size_t size() const { return tags.size(); }

  template <class Cell>
  void add(std::int32_t tag, std::array<int, Cell::nodes> const& numbers) {
    std::array<std::int32_t, Cell::nodes> ordered{};
    for (int a = 0; a < Cell::nodes; ++a) ordered[index(Cell::gmsh_order[index(a)])] = numbers[index(a)] + 1;
    tags.push_back(tag);
    nodes.insert(nodes.end(), ordered.begin(), ordered.end());
  }
};

inline std::string const& require_gmsh_name(std::string const& name) {
  constexpr std::size_t longest = 127;  // Gmsh 4.8 Reference Manual, section 9.1
  if (name.empty() || name.size() > longest || name.find_first_of("\"\r\n") != std::string::npos) {
    reject("a region or boundary is named '{}' (Gmsh takes 1 to {} letters on one line, no quotes): rename it", name,
           longest);
  }
  return name;
}

/// Regions first, then boundaries, with tags from 1.
template <class Element>
std::vector<GmshGroup> gmsh_groups(Mesh<Element> const& mesh) {
  std::vector<GmshGroup> groups;
  auto const next = [&] { return static_cast<std::int32_t>(groups.size() + 1); };
  for (auto const& name : mesh.regions) {
    for (auto const& other : groups) {
      if (other.name == name) reject("two regions are named '{}' (a file cannot distinguish them): rename one", name);
    }
    groups.push_back({require_gmsh_name(name), Element::dim, next()});
  }
  for (auto const& entry : mesh.boundaries) {
    groups.push_back({require_gmsh_name(entry.first), Element::dim - 1, next()});
  }
  return groups;
}

/// One run for each group that is not empty. The tags are the elements' order, from 1, then that of the sides.
template <class Element>
std::vector<GmshRun> gmsh_runs(Mesh<Element> const& mesh) {
  using Facet = typename Element::Facet;
  std::vector<GmshRun> runs;
  for (auto const& group : gmsh_groups(mesh)) {
    bool const region = group.dim == Element::dim;
    runs.push_back({group, region ? Element::gmsh_type : Facet::gmsh_type, region ? Element::nodes : Facet::nodes});
  }
  std::int32_t tag = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    runs[index(mesh.element_region[e])].template add<Element>(++tag, mesh.elements[e]);
  }
  auto run = runs.begin() + count(mesh.regions);
  for (auto const& entry : mesh.boundaries) {
    for (auto const& side : entry.second) run->template add<Facet>(++tag, side);
    ++run;
  }
  std::erase_if(runs, [](GmshRun const& empty) { return empty.size() == 0; });
  return runs;
}

}  // namespace scarp::detail

namespace scarp {

namespace detail {

inline void write_gmsh_run(GmshSink& sink, GmshRun const& run, GmshVersion version) {
  bool const is_41 = version == GmshVersion::v4_1;
  auto const each = index(run.nodes_each);
  for (std::size_t e = 0; e < run.size(); ++e) {
    auto const tag = run.tags[e];
    if (is_41) {
      sink.values(static_cast<std::uint64_t>(tag));
    } else if (version == GmshVersion::v4_0) {
      sink.values(tag);
    } else if (sink.binary()) {
      sink.values(tag, run.group.tag, run.group.tag);
    } else {
      sink.values(tag, run.type, 2, run.group.tag, run.group.tag);
    }
    for (std::size_t a = 0; a < each; ++a) {
      auto const node = run.nodes[e * each + a];
      is_41 ? sink.values(static_cast<std::uint64_t>(node)) : sink.values(node);
    }
    sink.end_line();
  }
}

/// positions: x, y, z of each node [m]; two tags for each element, those of its physical group and of its entity
inline void write_gmsh_22(GmshSink& sink, std::vector<std::array<double, 3>> const& positions,
                          std::vector<GmshRun> const& runs) {
  sink.text(fmt::format("$Nodes\n{}\n", positions.size()));
  for (std::size_t n = 0; n < positions.size(); ++n) {
    auto const& [x, y, z] = positions[n];
    sink.values(static_cast<std::int32_t>(n + 1), x, y, z);
    sink.end_line();
  }
  sink.end_section("Nodes");
  std::size_t elements = 0;
  for (auto const& run : runs) elements += run.size();
  sink.text(fmt::format("$Elements\n{}\n", elements));
  for (auto const& run : runs) {
    if (sink.binary()) sink.values(run.type, static_cast<std::int32_t>(run.size()), 2);
    write_gmsh_run(sink, run, GmshVersion::v2_2);
  }
  sink.end_section("Elements");
}

/// Each physical group that is not empty is an entity of the same tag, in the box of all nodes and without sides.
inline void write_gmsh_entities(GmshSink& sink, std::vector<std::array<double, 3>> const& positions,
                                std::vector<GmshRun> const& runs) {
  auto low = positions.front();
  auto high = low;
  for (auto const& position : positions) {
    for (std::size_t k = 0; k < position.size(); ++k) {
      low[k] = std::min(low[k], position[k]);
      high[k] = std::max(high[k], position[k]);
    }
  }
  sink.text("$Entities\n");
  for (std::int32_t dim = 0; dim < 4; ++dim) {
    auto const same = [&](GmshRun const& run) { return run.group.dim == dim; };
    sink.values(static_cast<std::uint64_t>(std::count_if(runs.begin(), runs.end(), same)));
  }
  sink.end_line();
  for (std::int32_t dim = 1; dim < 4; ++dim) {
    for (auto const& run : runs) {
      if (run.group.dim != dim) continue;
      auto const tag = run.group.tag;
      sink.values(tag, low[0], low[1], low[2], high[0], high[1], high[2], std::uint64_t{1}, tag, std::uint64_t{0});
      sink.end_line();
    }
  }
  sink.end_section("Entities");
}

/// MSH 4.0 has no ranges of tags, the tag of an entity before its dimension, and each node's place behind its tag.
inline void write_gmsh_4(GmshSink& sink, std::vector<std::array<double, 3>> const& positions,
                         std::vector<GmshRun> const& runs, bool is_40) {
  write_gmsh_entities(sink, positions, runs);
  std::uint64_t const nodes = positions.size();
  auto const totals = [&](std::uint64_t blocks, std::uint64_t entries) {
    is_40 ? sink.values(blocks, entries) : sink.values(blocks, entries, std::uint64_t{1}, entries);
    sink.end_line();
  };
  auto const block = [&](GmshGroup const& group, std::int32_t type, std::uint64_t entries) {
    is_40 ? sink.values(group.tag, group.dim, type, entries) : sink.values(group.dim, group.tag, type, entries);
    sink.end_line();
  };
  sink.text("$Nodes\n");
  totals(1, nodes);
  block(runs.front().group, 0, nodes);
  for (std::uint64_t n = 1; n <= nodes; ++n) {
    auto const& [x, y, z] = positions[n - 1];
    is_40 ? sink.values(static_cast<std::int32_t>(n), x, y, z) : sink.values(n);
    sink.end_line();
  }
  for (auto const& [x, y, z] : positions) {
    if (is_40) break;
    sink.values(x, y, z);
    sink.end_line();
  }
  sink.end_section("Nodes");
  std::uint64_t elements = 0;
  for (auto const& run : runs) elements += run.size();
  sink.text("$Elements\n");
  totals(runs.size(), elements);
  for (auto const& run : runs) {
    block(run.group, run.type, run.size());
    write_gmsh_run(sink, run, is_40 ? GmshVersion::v4_0 : GmshVersion::v4_1);
  }
  sink.end_section("Elements");
}

}  // namespace detail

/// Writes a mesh for Gmsh and what reads its files; regions and boundaries become physical groups of their names.
/// Elements have the tags 1, 2, ... in their order, then the sides of the boundaries; coordinates keep every bit.
/// \throws InputError for a mesh that is not valid and names that Gmsh cannot take
/// \throws FileError when the file cannot be written; an older file of this name is then untouched
template <HasGmshType Element>
void write_gmsh(std::filesystem::path const& path, Mesh<Element> const& mesh, GmshFormat format = {}) {
  validate(mesh);
  auto const groups = detail::gmsh_groups(mesh);
  auto const runs = detail::gmsh_runs(mesh);
  bool const is_22 = format.version == GmshVersion::v2_2;
  bool const is_40 = format.version == GmshVersion::v4_0;
  detail::GmshSink sink(format.encoding == GmshEncoding::binary);
  sink.text(fmt::format("$MeshFormat\n{} {:d} 8\n", is_22 ? "2.2" : is_40 ? "4" : "4.1", sink.binary()));
  if (sink.binary()) {
    sink.values(std::int32_t{1});
    sink.text("\n");
  }
  sink.text(fmt::format("$EndMeshFormat\n$PhysicalNames\n{}\n", groups.size()));
  for (auto const& group : groups) sink.text(fmt::format("{} {} \"{}\"\n", group.dim, group.tag, group.name));
  sink.text("$EndPhysicalNames\n");
  std::vector<std::array<double, 3>> positions(mesh.nodes.size(), std::array<double, 3>{});
  for (std::size_t n = 0; n < positions.size(); ++n) {
    std::copy_n(mesh.nodes[n].begin(), Element::dim, positions[n].begin());
  }
  is_22 ? detail::write_gmsh_22(sink, positions, runs) : detail::write_gmsh_4(sink, positions, runs, is_40);
  write_file(path, sink.content());
}

}  // namespace scarp
