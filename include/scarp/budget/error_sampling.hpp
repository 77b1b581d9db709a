// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

namespace scarp {

/// Where an error budget looks.
struct ErrorSampling {
  double share = 0.04;           ///< of the run's work that all checks may take; followed points come first
  int most_samples = 2;          ///< of one step
  int points_per_followed = 40;  ///< one of so many points is followed through the run,
  int most_followed = 24;        ///< at most so many,
  std::vector<int> followed{};   ///< and these
  double loose_pressure = 0.0;   ///< [Pa]; stresses below that of this pressure count as large as it
};

}  // namespace scarp
