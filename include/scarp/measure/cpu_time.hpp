// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <ctime>

namespace scarp {

/// CPU time of the process since `start` [s], of all its threads together: other programs on the machine do not count.
class CpuTime {
 public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

}  // namespace scarp
