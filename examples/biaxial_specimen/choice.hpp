// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../shared/sand/sand.hpp"

namespace scarp {
class GmshFile;
}

namespace biaxial_specimen {

/// Where the packings of the points come from: files, one packing for all points, or preparations of the reference
/// study's ellipses.
struct Grains {
  std::string particles{};
  std::string contacts{};
  std::string cell{};
  std::optional<double> normal_stiffness{};      ///< [N/m]; that of the contacts, else 6e6
  std::optional<double> tangential_stiffness{};  ///< [N/m]; likewise
  std::optional<double> friction{};              ///< that of the contacts, else 0.55
  std::string sand_file{};
  examples::Sand sand{
      .shape = "ellipse", .grains = 100, .preparation_friction = 0.0};  ///< that is prepared, as dense as can be
  int pool = 8;  ///< packings that are prepared; every point draws one
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
  double confining = 200e3;         ///< lateral pressure, total [Pa]
  bool undrained = false;           ///< pores full of water that nothing drains
  double pore_pressure = 100e3;     ///< of that water at the start, over that of the air [Pa]
  double grain_diameter = 1e-3;     ///< of its permeability [m]
  double rate = 1e-4;               ///< of the top platen [m/s]
  double axial_strain_step = 1e-3;  ///< of one row of the table, relative to the first height
  int steps = 35;
  double residual = 1e-3;  ///< unbalanced forces over reactions
  int iterations = 60;     ///< most of an attempt
  int halvings = 4;        ///< of a row's step before the test is given up
  int threads = 0;         ///< 0: all cores
  std::string table{};
  std::string fields{};                           ///< folder, empty for none
  std::function<void()> begin{};                  ///< called before anything is written
  std::function<void(std::string const&)> end{};  ///< called with the reason of a test that stopped, or "finished"
  int frames = 20;
  std::vector<std::string> budget{};  ///< bounds of the error budget, part=bound; the others are the usual ones

  /// What the grains carry of the lateral pressure at the start [Pa].
  double effective() const { return undrained ? confining - pore_pressure : confining; }
};

}  // namespace biaxial_specimen
