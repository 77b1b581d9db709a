// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <string>

#include "../shared/run_options.hpp"
#include "../shared/sand/sand.hpp"

namespace rve_lab {

using examples::Sand;

struct Path {
  std::string name = "biaxial";
  double strain = 0.05;          ///< along the path, positive
  double strain_step = 5e-6;     ///< of one DEM step
  std::optional<double> held{};  ///< stress that the path holds [Pa]; that of the packing when not given
  std::optional<double> row_strain{};
  int cycles = 0;
  double amplitude = 0.005;  ///< strain at which a cycle turns round
};

/// A test in the laboratory: a packing from a file, or one that is prepared first.
struct Test {
  Sand sand;
  std::string sand_file{};
  Path path;
  std::string packing{};
  std::string format{};  ///< of another code, in which a prepared packing is written too
  examples::Output output{"output/rve_lab"};
};

/// Another code's packing on a path.
struct Replay {
  Sand sand;  ///< of which a replay has law, density and thickness
  Path path{.strain_step = 1e-6};
  std::string particles{};
  std::string contacts{};
  std::string cell{};
  std::optional<double> relaxation{};  ///< isotropic pressure before the path [Pa]
  double tolerance = 1e-6;             ///< of the file's overlaps against the packing's, over the smallest radius
  std::string out{};
};

}  // namespace rve_lab
