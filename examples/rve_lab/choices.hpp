// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "../shared/run_options.hpp"

namespace rve_lab {

/// What the grains are and how they touch. The names of shapes and laws are those of material.hpp.
struct Material {
  std::string shape = "disc";
  std::string law = "linear";
  double normal_stiffness = 6e6;      ///< [N/m], of linear and rolling
  double tangential_stiffness = 6e6;  ///< [N/m], of linear and rolling
  double friction = 0.55;
  double modulus = 1e9;             ///< Young's [Pa], of hertz
  double poisson = 0.25;            ///< of hertz
  double rolling_stiffness = 40.0;  ///< [N m/rad], of rolling; about tangential stiffness x reduced radius squared
  double rolling_friction = 0.1;    ///< of rolling
};

/// A cloud of grains and its consolidation.
struct Preparation {
  double smallest = 4e-3;  ///< radius or major half axis [m]
  double largest = 6e-3;   ///< [m]
  double aspect = 0.75;    ///< minor over major half axis; discs have none
  double exponent = 0.6;   ///< of superellipses, 1 is an ellipse
  int grains = 400;
  std::uint64_t seed = 1;
  double density = 2650.0;  ///< [kg/m3]
  double thickness = 0.2;   ///< out of plane [m]
  double pressure = 2e5;    ///< [Pa]
  double friction = 0.1;    ///< during consolidation
  std::optional<double> target_void_ratio{};
  double void_ratio_tolerance = 5e-4;
};

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
  Material material;
  Preparation preparation;
  Path path;
  std::string packing{};
  std::string format{};  ///< of another code, in which a prepared packing is written too
  examples::Output output{"output/rve_lab"};
};

/// Another code's packing on a path.
struct Replay {
  Material material;
  Path path{.strain_step = 1e-6};
  std::string particles{};
  std::string contacts{};
  std::string cell{};
  double density = 2650.0;
  double thickness = 0.2;
  std::optional<double> relaxation{};  ///< isotropic pressure before the path [Pa]
  double tolerance = 1e-6;             ///< of the file's overlaps against the packing's, over the smallest radius
  std::string out{};
};

}  // namespace rve_lab
