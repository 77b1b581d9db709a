// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scarp/bvp/default_grid.hpp"
#include "scarp/element/hex20.hpp"
#include "scarp/element/hex8.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tet4.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"

namespace python_points {

/// Small strains with the default integration.
template <class Element>
using SmallGrid = scarp::Discretisation<Element, scarp::SmallStrain>;

/// Calls task(name, std::type_identity<Element>) for all elements until it returns true.
template <class Task>
bool any_element(Task const& task) {
  return task("tri3", std::type_identity<scarp::Tri3>{}) || task("tri6", std::type_identity<scarp::Tri6>{}) ||
         task("quad4", std::type_identity<scarp::Quad4>{}) || task("quad8", std::type_identity<scarp::Quad8>{}) ||
         task("tet4", std::type_identity<scarp::Tet4>{}) || task("tet10", std::type_identity<scarp::Tet10>{}) ||
         task("hex8", std::type_identity<scarp::Hex8>{}) || task("hex20", std::type_identity<scarp::Hex20>{});
}

/// Calls task(std::type_identity<Element>) with the element of a name. \throws InputError for another name
template <class Task>
void with_element(std::string const& wanted, Task const& task) {
  std::vector<std::string> names;
  bool const is_known = any_element([&](std::string_view name, auto type) {
    names.emplace_back(name);
    if (name != wanted) return false;
    task(type);
    return true;
  });
  if (!is_known)
    scarp::reject("there is no element '{}' (there are {}): use one of these", wanted, scarp::listed(names));
}

}  // namespace python_points
