// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fault_rupture {

/// One of several runs that differ in their packings.
struct EnsembleMember {
  std::uint64_t seed = 0;
  std::filesystem::path folder{};
  int code = 1;           ///< as its program would have ended
  std::string problem{};  ///< why it ended without results; empty where it has some
};

/// Where the member of a seed writes, in the folder of all.
std::filesystem::path member_folder(std::filesystem::path const& all, std::uint64_t seed);

/// Mean and scatter (standard deviation, of two members or more) of every measure in the members' summaries that ran to
/// their end, and who did not.
nlohmann::ordered_json ensemble_summary(std::vector<EnsembleMember> const& members);

/// The same as a table.
std::string ensemble_table(nlohmann::ordered_json const& summary);

/// Settlement of the surface at the end of the runs, mean and scatter [m] over the members: x_initial, settlement,
/// scatter.
/// \throws scarp::FileError
void write_mean_surface(std::filesystem::path const& file, std::vector<EnsembleMember> const& members);

}  // namespace fault_rupture
