// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/io/gmsh/detail/gmsh_stream.hpp"

namespace scarp::detail {

/// An element type of the first or second order of Gmsh's file formats. Gmsh 4.8 Reference Manual, section 9.1
struct GmshType {
  int type;
  int dim;
  int nodes;
  std::string_view name;
  std::string_view element{};  ///< the class of this library that reads it, if there is one
};

inline constexpr std::array gmsh_types{
    GmshType{1, 1, 2, "2-node line", "Line2"},
    GmshType{2, 2, 3, "3-node triangle", "Tri3"},
    GmshType{3, 2, 4, "4-node quadrangle", "Quad4"},
    GmshType{4, 3, 4, "4-node tetrahedron", "Tet4"},
    GmshType{5, 3, 8, "8-node hexahedron", "Hex8"},
    GmshType{6, 3, 6, "6-node prism"},
    GmshType{7, 3, 5, "5-node pyramid"},
    GmshType{8, 1, 3, "3-node line", "Line3"},
    GmshType{9, 2, 6, "6-node triangle", "Tri6"},
    GmshType{10, 2, 9, "9-node quadrangle"},
    GmshType{11, 3, 10, "10-node tetrahedron", "Tet10"},
    GmshType{12, 3, 27, "27-node hexahedron"},
    GmshType{13, 3, 18, "18-node prism"},
    GmshType{14, 3, 14, "14-node pyramid"},
    GmshType{15, 0, 1, "point"},
    GmshType{16, 2, 8, "8-node quadrangle", "Quad8"},
    GmshType{17, 3, 20, "20-node hexahedron", "Hex20"},
    GmshType{18, 3, 15, "15-node prism"},
    GmshType{19, 3, 13, "13-node pyramid"},
};

/// \return null for a type that is not listed
constexpr GmshType const* find_gmsh_type(int type) {
  auto const found =
      std::find_if(gmsh_types.begin(), gmsh_types.end(), [&](GmshType const& entry) { return entry.type == type; });
  return found == gmsh_types.end() ? nullptr : &*found;
}

struct GmshNode {
  std::int64_t tag;
  std::array<double, 3> position;  ///< [m]
};

struct GmshElement {
  GmshType const* type;
  std::int64_t tag;
  std::vector<int> groups{};          ///< tags above zero; empty: in no group
  bool turned = false;                ///< it is meant to be run through the other way
  std::vector<std::int64_t> nodes{};  ///< tags, in Gmsh's order
};

using DimTag = std::pair<int, int>;  ///< of a physical group or a geometrical entity

/// A file as it is, in its own numbering.
struct GmshContent {
  std::string file;
  std::map<DimTag, std::string> names{};  ///< of physical groups
  std::vector<GmshNode> nodes{};
  std::vector<GmshElement> elements{};
  std::map<std::int64_t, int> group_data{};  ///< groups of elements by tag, as meshio keeps them beside the elements
  bool lists_copies = false;                 ///< an element is listed once for each of its groups
  std::vector<std::string> skipped{};        ///< what is not read, such as Periodic
  std::vector<std::string> notes{};          ///< a sentence each
};

/// Zero stands for no group. A file may name a group several times, also with both signs.
inline void add_group(std::vector<int>& groups, int tag) {
  if (tag == 0 || tag == std::numeric_limits<int>::min()) return;
  if (std::find(groups.begin(), groups.end(), std::abs(tag)) == groups.end()) groups.push_back(std::abs(tag));
}

inline GmshType const& read_gmsh_type(GmshStream& stream) {
  auto const type = stream.value<std::int32_t>("the type of an element");
  auto const* const found = find_gmsh_type(type);
  if (!found) {
    reject("{} has elements of type {} (first and second order are read): mesh with `-order 2`, or leave them out",
           stream.place(), type);
  }
  return *found;
}

inline std::array<double, 3> read_gmsh_position(GmshStream& stream, std::int64_t tag) {
  std::array<double, 3> position{};
  for (double& coordinate : position) {
    coordinate = stream.value<double>("a coordinate of a node");
    if (!std::isfinite(coordinate)) {
      reject("{} has the coordinate {} of node {} (it must be finite): mesh the geometry again", stream.place(),
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
      reject("{} names group {} of dimension {} '{}' (it is '{}' already): give each group one name", stream.place(),
             tag, dim, name, other->second);
    }
  }
}

/// $ElementData "gmsh:physical": the physical groups of elements. Gmsh 4.8 Reference Manual, section 9.1
inline void read_gmsh_group_data(GmshStream& stream, GmshContent& content) {
  for (auto names = stream.text_count("the number of names of data", 1); names > 0; --names)
    stream.quoted("the name of data");
  for (auto times = stream.text_count("the number of times of data", 1); times > 0; --times)
    stream.text<double>("the time of data");
  auto const sizes = stream.text_count("the number of sizes of data", 1);
  std::size_t size = 0;  // step, components, elements, from 4 on the partition
  std::size_t elements = 0;
  for (std::size_t k = 0; k < sizes; ++k) {
    size = stream.text_count("a size of data", 1);
    if (k == 2) elements = size;
  }
  stream.to_next_line();
  for (std::size_t e = 0; e < elements; ++e) {
    auto const tag = stream.value<std::int32_t>("the tag of an element");
    auto const group = stream.value<double>("the physical group of an element");
    if (std::abs(group) <= std::numeric_limits<int>::max()) content.group_data[tag] = static_cast<int>(group);
  }
}

}  // namespace scarp::detail
