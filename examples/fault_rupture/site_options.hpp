// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/study/chosen_ground.hpp"
#include "team.hpp"

/// The site of a scene: its ground, and the lengths, sizes and places that follow from it where they are not given.
namespace fault_rupture {

// In the reference study's ground; they follow the depth of another one.
constexpr double short_length = 2.0;  ///< [m], where the mesh is made for it
constexpr double long_length = 8.0;   ///< [m], of coarser meshes

/// Eight digits are left for lengths of a metre; farther off subtract a constant.
inline CLI::Validator place() { return examples::number_from(-1e8, true, 1e8); }

inline void declare_site(CLI::App& app, Choice& choice) {
  using examples::number_from;
  app.add_option("--depth", choice.depth,
                 "of the ground above bedrock [m]; lengths, sizes and places that are not given follow it")
      ->check(number_from(0.1, true, 1e3));
  app.add_option("--left", choice.left,
                 "x of the ground's left end [m]; where it is not given 2.08 depths left of the tip")
      ->check(place());
  app.add_option("--width", choice.width, "of the ground [m]; where it is not given 3 depths")
      ->check(number_from(0.0, false, 1e5));
  app.add_option("--unit-weight", choice.unit_weight, "of the ground, dry [N/m3]")->check(number_from(1e3, true, 1e5));
  app.add_option("--surcharge", choice.surcharge, "on the ground [Pa]")->check(number_from(0.0, true, 1e7));
  auto* const table =
      app.add_option("--water-table", choice.water_table,
                     "depth below the surface [m], negative above it; below the table water fills the pores; "
                     "without it the ground is dry")
          ->check(number_from(-1e4, true, 1e3));
  auto const of_water = [&](char const* option, double& value, char const* what, CLI::Validator const& range) {
    app.add_option(option, value, what)->check(range)->needs(table);
  };
  of_water("--conductivity", choice.conductivity,
           "hydraulic, of wet ground before the rupture [m/s]; it follows the pores", number_from(0.0, false, 10.0));
  of_water("--void-ratio", choice.void_ratio, "of wet ground before the rupture", number_from(0.01, true, 10.0));
  of_water("--slip-rate", choice.slip_rate, "of a fault below wet ground [m/s]", number_from(1e-15, true, 100.0));
  of_water("--drain", choice.drain, "time after the rupture in which the bedrock rests and water drains [s]",
           number_from(0.0, true, 1e12));
  app.add_option("--largest-time-error", choice.largest_time_error,
                 "estimated, of the pore pressures in one time step [Pa]; sizes the load steps of wet ground")
      ->check(number_from(0.0, false, 1e9))
      ->needs(table);
}

/// Places that follow from ground and fault where they are not given, as the reference study has them relative to the
/// tip and to the fault's own line; recorded as if they were the defaults.
inline void choose_places(CLI::App& app, Choice& choice) {
  std::vector<std::string> notes;
  if (!choice.mesh.empty()) measure_mesh<Element>(choice, notes);
  if (rank() == 0) examples::print_notes(notes);
  Choice const usual;
  double const scale = choice.scale();
  auto const take = [&](char const* option, double& place, double value) {
    if (app.count(option) == 0) place = value;
    app.get_option(option)->default_str(fmt::format("{}", value));
  };
  take("--depth", choice.depth, choice.mesh.empty() ? usual.depth : choice.depth);
  take("--left", choice.left, choice.mesh.empty() ? choice.tip + scale * usual.left : choice.left);
  take("--width", choice.width, choice.mesh.empty() ? scale * usual.width : choice.width);
  auto const cotangent = [](double dip) { return 1.0 / std::tan(dip * std::numbers::pi / 180.0); };
  double const further = cotangent(choice.dip) - cotangent(usual.dip);  // to the left, over height
  auto const along_fault = [&](double x, double height) {
    return std::clamp(choice.tip + scale * (x - height * further), choice.left, choice.left + choice.width);
  };
  take("--probe-a-x", choice.probe_a_x, along_fault(usual.probe_a_x, usual.probe_a_y));
  take("--probe-a-y", choice.probe_a_y, scale * usual.probe_a_y);
  take("--probe-b-x", choice.probe_b_x, along_fault(usual.probe_b_x, usual.probe_b_y));
  take("--probe-b-y", choice.probe_b_y, scale * usual.probe_b_y);
  take("--footing-centre", choice.footing_centre, along_fault(usual.footing_centre, usual.depth));
}

/// How the elements of a mesh without a strip fit the length.
inline void warn_of_coarse_mesh(Choice const& choice) {
  double const largest = size_for<Element>(choice.length);
  double const size = !choice.mesh.empty()  ? choice.mesh_size
                      : choice.elements > 0 ? ground_of<Element>(choice).layer.size
                                            : choice.size;
  if (!(choice.length > 0.0 && choice.strip_width == 0.0 && largest < 0.9 * size)) return;
  examples::print(
      stderr, "warning: a --length of {} m needs elements of at most {:.2g} m along the fault: {}\n", choice.length,
      largest,
      choice.mesh.empty()
          ? "give a smaller --size, or leave --size, --elements and --strip-width out to have a strip refined"
          : "mesh them finer, or leave --strip-width out to have them refined");
}

/// How the elements of a file fit the length.
inline void tell_of_mesh(Choice const& choice) {
  examples::print(stderr,
                  "'{}': ground of {:.4g} m, elements of about {:.2g} m along the fault, a length of {:.3g} m\n",
                  choice.mesh, choice.depth, choice.mesh_size, choice.length);
  warn_of_coarse_mesh(choice);
}

/// Length and sizes of elements where they are not given; recorded as if they were the defaults.
inline void choose_length_and_sizes(CLI::App& app, Choice& choice) {
  bool const of_file = !choice.mesh.empty();
  bool const is_uniform = app.count("--strip-width") > 0 && choice.strip_width == 0.0;
  bool const has_length = app.count("--length") > 0 || choice.length == 0.0;
  bool const has_size = app.count("--size") > 0;
  bool const is_short = choice.length > 0.0 && size_for<Element>(choice.length) < choice.mesh_size;
  bool const sizes_strip =
      of_file && has_size && choice.strip_width == 0.0 && !is_uniform && app.count("--length") > 0 && is_short;
  if (of_file && has_size && choice.strip_width == 0.0 && !sizes_strip)
    scarp::reject(
        "--size was given with --mesh and without --strip-width (elements of a file are refined in a strip only): give "
        "both, or a --length below {:.2g} m",
        choice.mesh_size / size_for<Element>(1.0));
  bool const keeps_file = of_file && !has_length && choice.strip_width == 0.0;
  bool const has_mesh = (has_size && !sizes_strip) || choice.elements > 0 || is_uniform || keeps_file;
  double const own_size = choice.size;
  double const scale = choice.scale();
  if (!has_size) choice.size = of_file ? choice.mesh_size : scale * choice.size;
  if (!has_length) choice.length *= scale;
  if ((has_mesh || app.count("--quick") > 0) && !has_length) choice.length = scale * long_length;
  if (has_mesh && of_file && !has_length)
    choice.length = std::min(choice.length, std::stod(fmt::format("{:.2g}", choice.size / size_for<Element>(1.0))));
  if (choice.length > choice.depth)
    scarp::reject(
        "--length is {} m (the ground is {} m deep, so that a mean over this radius is that of the whole ground): "
        "choose "
        "a shorter one, from a tenth of the depth down",
        choice.length, choice.depth);
  if (!has_mesh) choose_strip<Element>(choice);
  if (sizes_strip) choice.size = own_size;
  if (of_file && rank() == 0) tell_of_mesh(choice);
  if (!of_file && app.count("--length") > 0 && rank() == 0) warn_of_coarse_mesh(choice);
  auto const record = [&](char const* option, double value) {
    if (app.count(option) == 0) app.get_option(option)->default_str(fmt::format("{:g}", value));
  };
  record("--length", choice.length);
  record("--size", choice.size);
  record("--strip-width", choice.strip_width);
}

/// Ground that its own weight squeezes to nothing, and a footing that it hardly feels, have no balance.
inline void require_balance(Choice const& choice) {
  if (!(choice.unit_weight > choice.buoyancy().lift))
    scarp::reject(
        "--unit-weight is {} N/m3 with a --void-ratio of {} (dry; its grains would float in water): give the weight of "
        "the dry ground",
        choice.unit_weight, choice.void_ratio);
  if (choice.water_table && *choice.water_table >= choice.depth)
    scarp::reject("--water-table is {} m deep (the ground is {} m deep, all of it dry): leave it out",
                  *choice.water_table, choice.depth);
  double const carried = choice.surcharge + choice.unit_weight * choice.depth - choice.buoyancy().relief(choice.depth);
  if (choice.soil != Soil::dem && choice.young_modulus < carried)
    scarp::reject(
        "--young-modulus is {} Pa; expected from {:.4g} Pa on, what the ground carries at bedrock: give it in pascals",
        choice.young_modulus, carried);
  constexpr double least_friction = 0.01;
  if (choice.scene != Case::free && choice.base == Base::frictional && choice.base_friction < least_friction)
    scarp::reject("--base-friction is {} (nothing holds a footing sideways that slides freely): give one from {} on",
                  choice.base_friction, least_friction);
  double const least = carried / 400.0;
  if (choice.bearing_pressure > 0.0 && choice.bearing_pressure < least)
    scarp::reject("--bearing-pressure is {} Pa; expected 0 or from {:.4g} Pa on: give it in pascals, or leave it out",
                  choice.bearing_pressure, least);
}

/// A strip whose elements the mesh has already.
inline void warn_of_idle_strip(Choice const& choice) {
  auto ground = ground_of<Element>(choice);
  auto const refined = ground.mesh({}).elements.size();
  ground.strip.reset();
  if (ground.mesh({}).elements.size() < refined) return;
  examples::print(
      stderr,
      "warning: the strip refines nothing (the mesh has elements of {:.3g} m there already): give a smaller "
      "--size, or leave --strip-width out\n",
      choice.size);
}

/// The sides move with the walls of the fault, so that a rupture close to them is theirs.
inline void warn_of_ends(Choice const& choice) {
  double const outcrop = choice.tip - choice.depth / std::tan(choice.dip * std::numbers::pi / 180.0);
  double const apart = std::min(outcrop - choice.left, choice.left + choice.width - choice.tip);
  if (apart < choice.depth / 2.0)
    examples::print(stderr,
                    "warning: the fault leads from x = {:.4g} m at bedrock to {:.4g} m at the surface, {:.3g} m from "
                    "an end of the ground ({:.4g} to {:.4g} m), whose motion is prescribed: give another --left or "
                    "--width, half of the depth farther\n",
                    choice.tip, outcrop, apart, choice.left, choice.left + choice.width);
}

}  // namespace fault_rupture
