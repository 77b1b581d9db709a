// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

namespace examples {

/// Keys of summaries before version 0.2, which stay beside the present ones until version 0.3.
struct RenamedKey {
  std::string_view before;
  std::string_view now;
};
inline constexpr RenamedKey renamed_keys[] = {
    {"settlement_foot_over_throw", "settlement_footwall_over_throw"},
    {"settlement_hanging_over_throw", "settlement_hanging_wall_over_throw"},
    {"sideways", "horizontal_displacement"},
    {"pressed_share", "contact_share"},
    {"support_error", "force_imbalance"},
    {"refused_steps", "rejected_steps"},
    {"last_refusal", "last_rejection"},
    {"mid_line_dip", "rupture_dip"},
    {"block_x50", "fault_line_x50"},
    {"share_of_time_in_rves", "share_of_time_in_points"},
    {"share_of_time_outside_rves", "share_of_time_outside_points"},
};

inline bool is_key_from_before(std::string_view key) {
  return std::ranges::find(renamed_keys, key, &RenamedKey::before) != std::end(renamed_keys);
}

inline void add_keys_from_before(nlohmann::ordered_json& summary) {
  for (auto const& [before, now] : renamed_keys) {
    if (summary.contains(now)) summary[std::string(before)] = nlohmann::ordered_json(summary[std::string(now)]);
  }
}

}  // namespace examples
