// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "stability/stability_case.hpp"

namespace stability {

// One source for each: <name>.cpp.
Cases contact_cases();
Cases dashpot_cases();
Cases fault_cases();
Cases floor_cases();
Cases footing_cases();
Cases mesh_cases();
Cases packing_cases();
Cases rve_cases();
Cases solver_cases();
Cases strength_cases();

/// All cases in the order of the page.
inline Cases all_cases() {
  Cases all;
  for (auto* const group : {contact_cases, packing_cases, rve_cases, dashpot_cases, strength_cases, mesh_cases,
                            solver_cases, fault_cases, floor_cases, footing_cases}) {
    for (Case& one : group()) all.push_back(std::move(one));
  }
  return all;
}

}  // namespace stability
