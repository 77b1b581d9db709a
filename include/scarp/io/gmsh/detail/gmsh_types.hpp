// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace scarp::detail {

/// An element type of Gmsh's file formats. Gmsh 4.8 Reference Manual, section 9.1
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
    GmshType{20, 2, 9, "9-node triangle"},
    GmshType{21, 2, 10, "10-node triangle"},
    GmshType{22, 2, 12, "12-node triangle"},
    GmshType{23, 2, 15, "15-node triangle"},
    GmshType{24, 2, 15, "incomplete 15-node triangle"},
    GmshType{25, 2, 21, "21-node triangle"},
    GmshType{26, 1, 4, "4-node line"},
    GmshType{27, 1, 5, "5-node line"},
    GmshType{28, 1, 6, "6-node line"},
    GmshType{29, 3, 20, "20-node tetrahedron"},
    GmshType{30, 3, 35, "35-node tetrahedron"},
    GmshType{31, 3, 56, "56-node tetrahedron"},
    GmshType{92, 3, 64, "64-node hexahedron"},
    GmshType{93, 3, 125, "125-node hexahedron"},
};

/// \return null for a type that is not listed
constexpr GmshType const* find_gmsh_type(int type) {
  auto const found =
      std::find_if(gmsh_types.begin(), gmsh_types.end(), [&](GmshType const& entry) { return entry.type == type; });
  return found == gmsh_types.end() ? nullptr : &*found;
}

}  // namespace scarp::detail
