// SPDX-License-Identifier: BSL-1.0
/// \file
/// Reference elements: shapes, facets and quadrature of lines, triangles, quadrilaterals, tetrahedra, hexahedra.
/// An element is one header and models `ReferenceElement`; meshes, assembly and files need nothing more of it.
/// `map.hpp` carries shapes to real coordinates.
/// How an element is integrated is not its business, see the room bvp.
/// Nodes are numbered as in VTK.
#pragma once

#include "scarp/element/checked_element.hpp"
#include "scarp/element/hex20.hpp"
#include "scarp/element/hex8.hpp"
#include "scarp/element/map.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/reference_element.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tet4.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"
