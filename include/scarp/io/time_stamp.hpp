// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <ctime>
#include <string>

namespace scarp {

/// The present moment in universal time, such as "2026-11-23T15:57:33Z" (ISO 8601).
inline std::string time_stamp() {
  std::time_t const now = std::time(nullptr);
  std::tm parts{};
#if defined(_WIN32)
  gmtime_s(&parts, &now);
#else
  gmtime_r(&now, &parts);
#endif
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

}  // namespace scarp
