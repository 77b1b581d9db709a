// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scarp/io/gmsh/detail/gmsh_stream.hpp"
#include "scarp/io/gmsh/detail/gmsh_types.hpp"

namespace scarp::detail {

struct GmshNode {
  std::int64_t tag;
  std::array<double, 3> position;  ///< [m]
};

/// Elements of one type in the same physical groups.
struct GmshBlock {
  GmshType type;
  std::vector<int> groups{};  ///< tags above zero; empty: in no group
  bool turned = false;        ///< the elements are meant to be run through the other way
  std::vector<std::int64_t> tags{};
  std::vector<std::int64_t> nodes{};  ///< tags, type.nodes for each element, in Gmsh's order
};

using DimTag = std::pair<int, int>;  ///< of a physical group or a geometrical entity

/// A file as it is, in its own numbering.
struct GmshContent {
  std::string file;
  std::map<DimTag, std::string> names{};  ///< of physical groups
  std::vector<GmshNode> nodes{};
  std::vector<GmshBlock> blocks{};
};

/// Zero stands for no group.
inline void add_group(std::vector<int>& groups, int tag) {
  if (tag != 0 && tag != std::numeric_limits<int>::min()) groups.push_back(std::abs(tag));
}

inline GmshType known_gmsh_type(GmshStream const& stream, int type) {
  auto const* const found = find_gmsh_type(type);
  if (!found) {
    refuse("{} has elements of type {} (not known here): leave them out of the mesh", stream.place(), type);
  }
  return *found;
}

inline std::array<double, 3> read_gmsh_position(GmshStream& stream, std::int64_t tag) {
  std::array<double, 3> position{};
  for (double& coordinate : position) {
    coordinate = stream.value<double>("a coordinate of a node");
    if (!std::isfinite(coordinate)) {
      refuse("{} has the coordinate {} of node {} (it must be finite): mesh the geometry again", stream.place(),
             coordinate, tag);
    }
  }
  return position;
}

/// $PhysicalNames, which is text in binary files too.
inline void read_gmsh_names(GmshStream& stream, GmshContent& content) {
  std::size_t const entries = stream.text_count("the number of physical names", 3);
  for (std::size_t k = 0; k < entries; ++k) {
    int const dim = stream.text<int>("the dimension of a physical group");
    int const tag = stream.text<int>("the tag of a physical group");
    auto name = stream.quoted("the name of a physical group");
    auto const [other, is_new] = content.names.emplace(DimTag(dim, tag), name);
    if (!is_new) {
      refuse("{} names group {} of dimension {} '{}' (it is '{}' already): give each group one name", stream.place(),
             tag, dim, name, other->second);
    }
  }
}

}  // namespace scarp::detail
