// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <vector>

namespace scarp {

/// What of a file of Gmsh counts.
struct GmshOptions {
  int highest_order = 2;  ///< of elements; at 1 all nodes but corners are left out, so that sides are straight
  std::vector<std::string> regions{};  ///< physical groups that count before others where an element lies in several
};

}  // namespace scarp
