// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <filesystem>

#include "scarp/io/atomic_file.hpp"
#include "scarp/io/gmsh/detail/gmsh_groups.hpp"

namespace scarp {

namespace detail {

inline void write_gmsh_run(GmshSink& sink, GmshRun const& run, bool is_41) {
  auto const each = index(run.nodes_each);
  for (std::size_t e = 0; e < run.size(); ++e) {
    auto const tag = run.tags[e];
    if (is_41) {
      sink.values(static_cast<std::uint64_t>(tag));
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
    write_gmsh_run(sink, run, false);
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

inline void write_gmsh_41(GmshSink& sink, std::vector<std::array<double, 3>> const& positions,
                          std::vector<GmshRun> const& runs) {
  write_gmsh_entities(sink, positions, runs);
  std::uint64_t const nodes = positions.size();
  sink.text("$Nodes\n");
  sink.values(std::uint64_t{1}, nodes, std::uint64_t{1}, nodes);
  sink.end_line();
  sink.values(runs.front().group.dim, runs.front().group.tag, 0, nodes);
  sink.end_line();
  for (std::uint64_t n = 1; n <= nodes; ++n) {
    sink.values(n);
    sink.end_line();
  }
  for (auto const& [x, y, z] : positions) {
    sink.values(x, y, z);
    sink.end_line();
  }
  sink.end_section("Nodes");
  std::uint64_t elements = 0;
  for (auto const& run : runs) elements += run.size();
  sink.text("$Elements\n");
  sink.values(static_cast<std::uint64_t>(runs.size()), elements, std::uint64_t{1}, elements);
  sink.end_line();
  for (auto const& run : runs) {
    sink.values(run.group.dim, run.group.tag, run.type, static_cast<std::uint64_t>(run.size()));
    sink.end_line();
    write_gmsh_run(sink, run, true);
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
  bool const is_41 = format.version == GmshVersion::v4_1;
  detail::GmshSink sink(format.encoding == GmshEncoding::binary);
  sink.text(fmt::format("$MeshFormat\n{} {:d} 8\n", is_41 ? "4.1" : "2.2", sink.binary()));
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
  is_41 ? detail::write_gmsh_41(sink, positions, runs) : detail::write_gmsh_22(sink, positions, runs);
  write_file(path, sink.content());
}

}  // namespace scarp
