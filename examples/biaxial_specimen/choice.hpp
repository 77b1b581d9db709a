// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scarp {
class GmshFile;
}

namespace biaxial_specimen {

/// Where the packings of the points come from: files, one packing for all points, or preparations of the reference study's
/// ellipses.
struct Grains {
  std::string particles{};
  std::string contacts{};
  std::string cell{};
  std::optional<double> normal_stiffness{};      ///< [N/m]; that of the contacts, else 6e6
  std::optional<double> tangential_stiffness{};  ///< [N/m]; likewise
  std::optional<double> friction{};              ///< that of the contacts, else 0.55
  double density = 2650.0;                       ///< [kg/m3]
  double thickness = 0.2;                        ///< out of plane [m], also of the specimen
  int prepared = 100;                            ///< grains of a packing that is prepared
  int pool = 8;                                  ///< packings that are prepared; every point draws one
  double preparation_friction = 0.0;             ///< 0: as dense as can be
  std::uint64_t seed = 1;
  double strain_per_dem_step = 1e-5;
};

struct Choice {
  std::string mesh{};                          ///< a file of Gmsh; empty: crossed triangles of an own rectangle
  int mesh_order = 2;                          ///< highest order of its elements
  scarp::GmshFile const* mesh_file = nullptr;  ///< its content
  double width = 0.05;
  double height = 0.1;
  int columns = 5;
  int rows = 10;
  Grains grains{};
  double confining = 200e3;         ///< lateral pressure [Pa]
  double axial_strain_step = 1e-3;  ///< of one row of the table, relative to the first height
  int steps = 35;
  double residual = 1e-3;  ///< unbalanced forces over reactions
  int iterations = 60;     ///< most of an attempt
  int halvings = 4;        ///< of a row's step before the test is given up
  int threads = 0;         ///< 0: all cores
  std::string table{};
  std::string fields{};           ///< folder, empty for none
  std::function<void()> begin{};  ///< called before anything is written
  int frames = 20;
  std::vector<std::string> budget{};  ///< bounds of the error budget, part=bound; the others are the usual ones
};

}  // namespace biaxial_specimen
