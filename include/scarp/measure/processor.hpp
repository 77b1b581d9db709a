// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fstream>
#include <string>

namespace scarp {

/// What the machine calls its processor; "unknown processor" where it does not say.
inline std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    auto const colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

}  // namespace scarp
