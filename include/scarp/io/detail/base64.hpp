// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace scarp {

/// Base64 text of some bytes, with padding (RFC 4648, section 4).
inline std::string base64(std::span<std::byte const> bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::size_t group = 3;
  std::string text;
  text.reserve((bytes.size() + group - 1) / group * 4);
  for (std::size_t first = 0; first < bytes.size(); first += group) {
    std::size_t const given = std::min(group, bytes.size() - first);
    unsigned bits = 0;
    for (std::size_t k = 0; k < group; ++k) {
      bits = bits << 8U | (k < given ? std::to_integer<unsigned>(bytes[first + k]) : 0U);
    }
    for (std::size_t k = 0; k <= group; ++k) {
      text += k <= given ? letters[bits >> (6U * (group - k)) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace scarp
