// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "../shared/sand/options.hpp"
#include "choices.hpp"
#include "paths.hpp"

namespace rve_lab {

/// From 1e-12 on, far below any use.
inline CLI::Validator positive(double most) { return examples::number_from(1e-12, true, most); }

inline void declare_path(CLI::App& app, Path& path) {
  auto const add = [&](char const* name, auto& member, char const* what) {
    return app.add_option(name, member, what)->group("Path");
  };
  add("--path", path.name, "of the deformation")->check(CLI::IsMember(path_names()));
  add("--strain", path.strain, "at the end, along the path")->check(positive(2.0));
  add("--strain-step", path.strain_step, "strain of one DEM step")->check(examples::number_from(1e-12, true, 1e-3));
  add("--lateral-stress,--held-stress", path.held,
      "held by biaxial (lateral), simple_shear_at_stress (vertical), constant_mean_stress (mean) [Pa, compression "
      "positive]; otherwise that of the packing")
      ->check(positive(1e12));
}

/// \throws InputError for options of a path that it has no use for
inline void require_used(CLI::App const& app, Path const& path) {
  if (path_named(path.name).held == nullptr)
    examples::reject_unused(app, "lateral-stress", fmt::format("the path '{}' holds no stress", path.name));
  if (path.cycles > 0) examples::reject_unused(app, "strain", "--cycles go to --amplitude");
  if (path.cycles == 0) examples::reject_unused(app, "amplitude", "without --cycles");
  if (path.cycles == 0 && path.strain < path.strain_step * (1.0 - 1e-9))
    scarp::reject("--strain is {} (a DEM step of --strain-step has {}): choose smaller steps", path.strain,
                  path.strain_step);
  if (path.cycles > 0 && path.amplitude < path.strain_step)
    scarp::reject("--amplitude is {} (a DEM step of --strain-step has {}): choose smaller steps", path.amplitude,
                  path.strain_step);
}

}  // namespace rve_lab
