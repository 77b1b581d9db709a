// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "../shared/device/device.hpp"
#include "../shared/run_options.hpp"
#include "../shared/sand/sand.hpp"

namespace rve_lab {

using examples::Device;
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

/// How a packing is tested for its curve.
struct CurveTest {
  std::string path = "biaxial";
  std::optional<double> held{};  ///< [Pa]; that of the packing when not given
  double strain = 0.1;
  double strain_step = 2e-5;
  double row_strain = 1e-3;
};

struct CalibrateChoice {
  examples::Sand sand{.void_ratio_tolerance = 2e-3};  ///< small packings jump over void ratios
  std::string sand_file{};
  std::string free{};  ///< empty: friction, relative density and the stiffness of the contacts
  std::string target{};
  std::vector<std::string> tables{};
  bool triaxial = false;  ///< whether the tables are of triaxial tests
  std::optional<double> strain{};
  double window = 0.02;
  CurveTest test{};
  int seeds = 4;
  int evaluations = 30;
  int threads = 0;
  bool resume = false;
  examples::Output output{"output/rve_lab"};
};

/// A test of any material by a laboratory's name; pressures [Pa] are positive in compression, angles in degrees.
struct Laboratory {
  std::string provider = "packing";
  Sand sand;
  std::string sand_file{};
  std::vector<std::string> packings{};
  int seeds = 1;  ///< of packings that are prepared
  double young = 20e6;
  double poisson = 0.3;
  double friction = 30.0;
  double dilation = 0.0;
  double cohesion = 0.0;
  int dimension = 2;

  std::string path = "drained";
  std::string table{};
  double strain = 0.1;  ///< length of the path
  bool extension = false;
  double ratio = 0.0;
  int cycles = 0;
  double amplitude = 0.005;
  std::optional<double> consolidation{};
  double k0 = 1.0;

  double increment = 5e-4;
  double strain_step = 5e-6;
  double tolerance = 1e-4;
  double window = 5e-3;
  std::optional<double> void_ratio{};
  Device device = Device::none;
  std::optional<int> threads{};
  std::vector<std::string> overlays{};
  examples::Output output{"output/rve_lab"};

  bool is_packing() const { return provider == "packing"; }
  /// Threads for so many points: on a card their calls run side by side.
  int threads_for(int points) const {
    constexpr int on_cores = 2, on_card = 128;
    return std::min(points, threads.value_or(device == Device::cuda ? on_card : on_cores));
  }
};

}  // namespace rve_lab
