// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../shared/run_options.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/io/packings/packing_tables.hpp"
#include "step_budget.hpp"
#include "void_ratio_study.hpp"

namespace rve_biaxial {

inline void write_curves(std::filesystem::path const& folder, std::vector<Result> const& results) {
  scarp::CsvTable table({"preparation_friction", "seed", "axial_strain", "lateral_strain", "volumetric_strain",
                         "axial_stress", "lateral_stress", "void_ratio", "coordination", "contact_fabric",
                         "particle_fabric", "unbalanced_ratio", "sliding_share"});
  for (auto const& result : results) {
    for (auto const& row : result.rows) {
      table.add(result.preparation_friction, result.seed, row.axial_strain, row.lateral_strain, row.volumetric_strain,
                row.axial_stress, row.lateral_stress, row.void_ratio, row.coordination, row.contact_fabric,
                row.particle_fabric, row.unbalanced_ratio, row.sliding_share);
    }
  }
  table.write(folder / "biaxial.csv");
}

inline std::vector<double> all_windows(double smoothing) {
  std::vector<double> windows{0.005, 0.01, 0.03, 0.05};
  if (std::find(windows.begin(), windows.end(), smoothing) == windows.end()) windows.push_back(smoothing);
  std::sort(windows.begin(), windows.end());
  return windows;
}

inline nlohmann::json definitions() {
  return {
      {"view", "compression positive, logarithmic strains, stresses in Pa"},
      {"phi_max",
       "degrees; eq. 8 of the reference study, sin phi = (s1/s3 - 1)/(s1/s3 + 1), with s1/s3 the mean axial over the "
       "mean "
       "lateral stress within a window of axial strain; largest over all windows inside the test"},
      {"psi_max",
       "degrees; eq. 9 of the reference study, sin psi = (de1/de3 + 1)/(1 - de1/de3), with the strain increments from "
       "end "
       "to end of the window; largest over all windows inside the test"},
      {"psi_secant", "degrees; eq. 9 with the increments from the largest contraction to the end of the test"},
      {"stress_scatter",
       "difference of the stresses of two packings on the same path over the stress, root mean square over pairs and "
       "rows"},
      {"window", "width in axial strain; `smoothing` is the one that the table shows"},
      {"void_ratio", "area of voids over area of grains after consolidation, overlaps not subtracted"},
      {"fabric",
       "anisotropy of contact normals and of major axes, text after eq. 7 of the reference study; of the states at the "
       "start "
       "and the end, and at the peak: the middle of the window of 0.5 % with the largest stress ratio"},
      {"over_void_ratio",
       "least-squares lines angle = at_zero + slope * void_ratio over all packings, and the void ratio at which "
       "they meet the reference study's angle; null where that is outside the packings'"},
      {"standard_deviation", "of the sample over the seeds"}};
}

/// One packing.
inline nlohmann::json summarise_packing(Result const& result, std::vector<double> const& windows) {
  nlohmann::json entry{
      {"preparation_friction", result.preparation_friction}, {"seed", result.seed},
      {"void_ratio", start_row(result).void_ratio},          {"coordination", start_row(result).coordination},
      {"psi_secant", secant_dilation_angle(result.rows)},    {"peaks", nlohmann::json::array()}};
  for (Moment const& moment : moments) {
    entry["contact_fabric"][moment.name] = moment.row(result).contact_fabric;
    entry["particle_fabric"][moment.name] = moment.row(result).particle_fabric;
  }
  for (double const window : windows) {
    auto const peak = peak_angles(result.rows, window);  // NaN becomes null
    entry["peaks"].push_back({{"window", window},
                              {"phi_max", peak.friction_angle},
                              {"phi_max_axial_strain", peak.friction_strain},
                              {"psi_max", peak.dilation_angle},
                              {"psi_max_axial_strain", peak.dilation_strain}});
  }
  return entry;
}

inline nlohmann::json summarise(Choice const& choice, std::vector<Result> const& results, double smoothing) {
  nlohmann::json summary;
  summary["definitions"] = definitions();
  summary["choice"] = {{"grains", choice.grains},
                       {"pressure", choice.pressure},
                       {"strain", choice.strain},
                       {"strain_per_step", choice.strain_per_step},
                       {"smoothing", smoothing}};
  summary["reference"] = {{"study", {{"phi_max", 30.8}, {"psi_max", 6.6}, {"void_ratio_range", {0.160, 0.179}}}},
                          {"sudodem",
                           {{{"void_ratio", 0.153}, {"phi_max", 36.6}, {"psi_max", 17.2}, {"psi_secant", 8.3}},
                            {{"void_ratio", 0.173}, {"phi_max", 33.8}, {"psi_max", 14.9}, {"psi_secant", 6.3}}}},
                          {"sudodem_windows", "phi_max 0.5 %, psi_max 5 %"}};
  auto const windows = all_windows(smoothing);
  for (auto const& packings : by_friction(results)) {
    summary["preparation_frictions"].push_back(summarise_friction(packings, windows));
  }
  summary["over_void_ratio"] = lines_over_void_ratio(results, windows);
  for (auto const& result : results) summary["packings"].push_back(summarise_packing(result, windows));
  summary["error_budget"] = examples::json_of(error_budget(results, choice.pressure, {}));
  return summary;
}

inline void write_all(scarp::RunFolder& own, Choice const& choice, std::vector<Result> const& results,
                      double smoothing) {
  std::filesystem::path const& folder = own.path();
  own.begin();
  write_curves(folder, results);
  scarp::write_packing_tables(folder, results.front().consolidated, study_law());
  auto summary = summarise(choice, results, smoothing);
  summary["run"] = examples::json_of(own.record());
  examples::write_json(folder / "summary.json", summary);
  own.end("finished");
}

}  // namespace rve_biaxial
