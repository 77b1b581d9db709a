// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "../device/device.hpp"
#include "../sand/sand.hpp"
#include "scarp/constitutive/buoyancy.hpp"
#include "scarp/constitutive/hydraulic.hpp"
#include "scarp/tensor/tensor.hpp"

namespace fault_rupture {

// Of the reference study's ground.
inline constexpr double study_depth = 25.0;     ///< [m]
inline constexpr double unit_weight = 15.68e3;  ///< [N/m3]
inline constexpr double surcharge = 4e3;        ///< [Pa]

using examples::Device;

enum class Case { free, heavy, light };
enum class Soil { dem, mohr_coulomb, elastic };
enum class Base { tied, frictional };
enum class MeshPattern { crossed, left, right, quads, jittered };

/// Ground of another sand.
struct Layer {
  double top = 0.0;  ///< depth [m]
  examples::Sand sand;
};

/// What a user may choose; the reference study's free field on a mesh for a ten-minute run.
struct Choice {
  Case scene = Case::free;
  Soil soil = Soil::dem;
  Base base = Base::tied;
  bool quick = false;          ///< looser defaults of tolerance and load steps with packings
  bool study = false;          ///< whether the reference study's numbers are wanted beside other soil too
  double depth = study_depth;  ///< of the ground [m]
  double left = -52.0;         ///< x of its left end [m]
  double width = 75.0;         ///< [m]
  double unit_weight = fault_rupture::unit_weight;  ///< [N/m3]
  double surcharge = fault_rupture::surcharge;      ///< [Pa]
  std::optional<double> water_table;  ///< depth below the surface [m], negative above it; without, the ground is dry
  double conductivity = 1e-4;         ///< hydraulic, before the rupture [m/s]
  double void_ratio = 0.7;            ///< of the ground that water fills, before the rupture
  double slip_rate = 1.0;             ///< of the fault [m/s]
  double drain = 0.0;                 ///< time after the rupture in which water drains [s]
  std::optional<double> largest_time_error;  ///< of pore pressures in one step [Pa]
  double size = 2.5;                         ///< [m], cell width in the band, or size of the elements in the strip
  double strip_width = 0.0;  ///< [m], twice the margin around `strained` with small elements; 0 for a uniform mesh
  int elements = 0;          ///< wanted number of elements instead of `size`; 0 for none
  std::optional<MeshPattern> pattern;  ///< crossed, or quads where elements are quadrilaterals
  double aspect = 1.0;                 ///< height of a cell over its width
  std::uint64_t mesh_seed = 1;         ///< of the jittered mesh
  std::string mesh;                    ///< Gmsh file in place of all these
  int mesh_order = 2;                  ///< highest order of elements that are read from it
  double mesh_size = 0.0;              ///< of its elements along the fault [m], see measure_mesh
  double length = 0.0;                 ///< intrinsic [m]; 0 for none
  int grains = 400;
  int packings = 1;                ///< of which every point draws one
  bool mirrored_packings = false;  ///< draws among their mirror images too
  std::uint64_t seed = 1;
  double preparation_friction = 0.09;
  double overconsolidation_ratio = 1.0;  ///< what the sand once carried over its overburden
  double grain_aspect = 0.75;            ///< width over length of the ellipses
  double grain_friction = 0.55;          ///< coefficient between grains
  std::string sand_file{};
  examples::Sand sand{.shape = "ellipse"};        ///< of that file; what members before name counts first, see sand_of
  std::vector<std::string> layer_files{};         ///< depth=file of each of the next ones
  std::vector<Layer> layers{};                    ///< below that sand, each below the one before
  double peak_friction_angle = 30.8;              ///< [degrees], of Mohr-Coulomb ground, as the next three
  double peak_dilation_angle = 6.6;               ///< [degrees]
  std::optional<double> residual_friction_angle;  ///< [degrees]; Bolton's, peak friction less 0.8 of the dilation
  double softening_strain = 0.15;                 ///< plastic shear strain
  double young_modulus = 25e6;                    ///< [Pa], of ground without packings, as the next one
  double k0 = 0.4;                                ///< horizontal over vertical stress before faulting
  double throw_over_depth = 0.085;
  double dip = 60.0;                ///< [degrees]
  bool reverse = false;             ///< the hanging wall goes up
  double tip = 0.0;                 ///< [m]
  std::optional<double> tolerance;  ///< of the force residual; packings 1e-2, Mohr-Coulomb 1e-8, else 1e-10
  std::optional<double> max_displacement_gradient;  ///< of a load step; 0.0025 with packings, else 0.02
  int max_iterations = 30;
  double strain_per_step = 1e-5;
  int min_dem_steps = 20;
  double unbalanced_tolerance = 0.05;
  double footing_centre = -10.5;  ///< x [m]
  double footing_width = 10.0;    ///< [m]
  double bearing_pressure = 0.0;  ///< [Pa]; 0 for the case's own, 91 kPa or 37 kPa
  double base_friction = 0.5;     ///< coefficient of the frictional base
  int threads = 0;                ///< 0 for all the machine has
  Device device = Device::none;
  int frames = 40;
  double probe_a_x = -3.5;  ///< [m], in the band
  double probe_a_y = 6.0;
  double probe_b_x = -20.0;  ///< beside it
  double probe_b_y = 12.0;
  double time_limit = 0.0;          ///< [s], 0 for none
  std::vector<std::string> budget;  ///< bounds of the error budget, part=bound; the others are the usual ones
  bool sensitivity_runs = false;    ///< runs the scene once more for each part of the budget that needs another run
  std::string sensitivity_file;     ///< file of what sensitivity runs came to
  std::string checkpoint;           ///< folder; empty: nothing is saved
  double checkpoint_every = 600.0;  ///< [s]
  bool resume = false;
  std::vector<scarp::Vector<2>> strained;  ///< places around which a mesh with a strip is refined, see run_pilot

  /// What the results depend on.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("case", self.scene);
    visit("soil", self.soil);
    visit("footing", self.base);
    visit("quick", self.quick);
    visit("depth", self.depth);
    visit("unit-weight", self.unit_weight);
    visit("surcharge", self.surcharge);
    visit("size", self.size);
    visit("strip-width", self.strip_width);
    visit("elements", self.elements);
    visit("pattern", self.pattern);
    visit("aspect", self.aspect);
    visit("mesh-seed", self.mesh_seed);
    visit("reverse", self.reverse);
    visit("length", self.length);
    visit("grains", self.grains);
    visit("packings", self.packings);
    visit("mirrored-packings", self.mirrored_packings);
    visit("seed", self.seed);
    visit("preparation-friction", self.preparation_friction);
    visit("overconsolidation-ratio", self.overconsolidation_ratio);
    visit("grain-aspect", self.grain_aspect);
    visit("grain-friction", self.grain_friction);
    visit("peak-friction-angle", self.peak_friction_angle);
    visit("peak-dilation-angle", self.peak_dilation_angle);
    visit("residual-friction-angle", self.residual_friction_angle);
    visit("softening-strain", self.softening_strain);
    visit("young-modulus", self.young_modulus);
    visit("k0", self.k0);
    visit("throw-over-depth", self.throw_over_depth);
    visit("dip", self.dip);
    visit("tip", self.tip);
    visit("left", self.left);
    visit("width", self.width);
    visit("tolerance", self.tolerance);
    visit("max-displacement-gradient", self.max_displacement_gradient);
    visit("max-iterations", self.max_iterations);
    visit("strain-per-dem-step", self.strain_per_step);
    visit("min-dem-steps", self.min_dem_steps);
    visit("unbalanced-tolerance", self.unbalanced_tolerance);
    visit("footing-centre", self.footing_centre);
    visit("footing-width", self.footing_width);
    visit("bearing-pressure", self.bearing_pressure);
    visit("base-friction", self.base_friction);
    visit("frames", self.frames);
    visit("probe-a-x", self.probe_a_x);
    visit("probe-a-y", self.probe_a_y);
    visit("probe-b-x", self.probe_b_x);
    visit("probe-b-y", self.probe_b_y);
    if (self.water_table) {
      visit("water-table", self.water_table);
      visit("conductivity", self.conductivity);
      visit("void-ratio", self.void_ratio);
      visit("slip-rate", self.slip_rate);
      visit("drain", self.drain);
      visit("largest-time-error", self.largest_time_error);
    }
    double strained = 0.0;  // stands for all of the places: another pilot run has another mesh
    for (auto const& place : self.strained) strained += place.x() + 2.0 * place.y();
    visit("strained", strained);
  }

  /// Of lengths that follow the depth where they are not given.
  double scale() const { return depth / study_depth; }
  /// Of the ground before the rupture.
  scarp::Buoyancy buoyancy() const {
    return water_table ? scarp::Buoyancy{*water_table, scarp::Water{}.lift(void_ratio)} : scarp::Buoyancy{};
  }
  /// Below it the balance of a point counts as if it carried so much [Pa].
  double least_pressure() const { return std::max(surcharge, fault_rupture::surcharge) / 2.0; }
};

/// Whether the site is the reference study's, so that its places and ranges may stand beside the results: ground, fault
/// and soil, whatever the mesh, the length and the grains of a packing are. With `study` any soil.
bool repeats_study(Choice const& choice);

/// The sand at the surface, with the choice's grains, seed, density and friction.
/// \throws scarp::InputError for grains that the scenes are not built for
examples::Sand sand_of(Choice const& choice);

/// DEM steps of scenes with a length: fewer than the reference study's scene has, with the same places
/// (docs/notes/performance.md).
inline void set_few_dem_steps(Choice& choice) {
  choice.strain_per_step = 2e-5;
  choice.min_dem_steps = 10;
  choice.unbalanced_tolerance = 0.1;
}

}  // namespace fault_rupture
