// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>

namespace fault_rupture {

/// An old summary, of a run or of an ensemble, would speak for the new one.
inline void remove_older_summaries(std::filesystem::path const& folder) {
  for (auto const* name : {"summary.json", "summary.txt", "ensemble.json", "ensemble.txt", "surface_mean.csv"})
    std::filesystem::remove(folder / name);
}

/// An older, longer series would be mixed up with the new one. A run that goes on keeps its series.
inline void remove_older_results(std::filesystem::path const& folder, bool goes_on) {
  remove_older_summaries(folder);
  if (goes_on) return;
  for (auto const* name : {"fields.pvd", "surface.csv", "probe_A.csv", "probe_B.csv", "convergence.csv",
                           "convergence.jsonl", "footing.csv", "footing_base.csv", "water.csv", "packing_grains.csv",
                           "packing_contacts.csv", "packing_cell.csv"})
    std::filesystem::remove(folder / name);
  if (std::filesystem::exists(folder / "fields")) {
    for (auto const& file : std::filesystem::directory_iterator(folder / "fields")) {
      std::string const name = file.path().filename().string();
      if (name.starts_with("step_") && name.ends_with(".vtu")) std::filesystem::remove(file.path());
    }
  }
  if (!std::filesystem::exists(folder / "packings")) return;
  for (auto const& file : std::filesystem::directory_iterator(folder / "packings")) {
    std::string const name = file.path().stem().string();
    bool const ours = name == "A" || name == "B" || name.starts_with("A_") || name.starts_with("B_");
    if (ours && file.path().extension() == ".csv") std::filesystem::remove(file.path());
  }
}

}  // namespace fault_rupture
