// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "choice.hpp"
#include "pilot_size.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/fault/refined_ground.hpp"

namespace fault_rupture {

/// The element is compiled in, so that these names differ from program to program and stay within their sources: a
/// program for another one is another target, see examples/fault_rupture/CMakeLists.txt.
#ifndef FAULT_RUPTURE_ELEMENT
#define FAULT_RUPTURE_ELEMENT Tri3
#endif
using Element = scarp::FAULT_RUPTURE_ELEMENT;
constexpr char const* element_name = Element::nodes == 3   ? "tri3"
                                     : Element::nodes == 6 ? "tri6"
                                     : Element::nodes == 4 ? "quad4"
                                                           : "quad8";
constexpr bool is_triangle = Element::nodes % 3 == 0;

/// A normal fault, or the same backwards.
struct ChosenFault : scarp::NormalFault {
  bool reverse = false;

  scarp::Vector<2> right() const { return (reverse ? -1.0 : 1.0) * NormalFault::right(); }
};

inline ChosenFault fault_of(Choice const& choice) {
  return {{.dip = choice.dip * std::numbers::pi / 180.0, .tip = choice.tip}, choice.reverse};
}

/// A layer in a mesh of its own or the mesh of a file, refined in a strip where there is one. Defined in
/// chosen_ground.cpp for one element.
template <class ElementType>
struct ChosenGround {
  using Element = ElementType;

  scarp::FaultMesh layer{};
  std::optional<PilotSize> strip{};
  std::optional<scarp::Mesh<Element>> given{};

  scarp::Mesh<Element> mesh(std::vector<double> const& edges) const;
  double surface_level() const;
  double depth() const;
};

/// Takes depth and ends of the mesh of a file, and the size of its elements along the fault, into the choice.
/// notes: on the file \throws scarp::InputError for a file that is no ground
template <class ElementType>
void measure_mesh(Choice& choice, std::vector<std::string>& notes);

/// Size [m] of the elements that resolve a length [m].
template <class ElementType>
double size_for(double length);

/// Size of the elements and, unless it is chosen already, width of the strip that a length requires where it is too
/// short for the usual mesh, or for that of the file.
/// \throws scarp::InputError for a length that requires too many elements
template <class ElementType>
void choose_strip(Choice& choice);

/// \throws scarp::InputError for choices that do not fit together
template <class ElementType>
ChosenGround<ElementType> ground_of(Choice const& choice);

}  // namespace fault_rupture
