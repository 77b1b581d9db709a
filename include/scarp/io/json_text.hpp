// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

namespace scarp {

/// A JSON string with its quotes (RFC 8259, section 7).
inline std::string quoted_json(std::string_view text) {
  std::string result = "\"";
  for (char const letter : text) {
    if (letter == '"' || letter == '\\') {
      result += {'\\', letter};
    } else if (static_cast<unsigned char>(letter) < 0x20) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(letter));
    } else {
      result += letter;
    }
  }
  return result + '"';
}

/// Takes the JSON string off that `text` begins with; of \u only what quoted_json writes is understood.
/// \return what stands between its quotes; nothing of text is left when these do not close
inline std::string take_json_string(std::string_view& text) {
  std::string result;
  std::size_t at = 1;
  for (; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] != '\\' || at + 1 == text.size()) {
      result += text[at];
      continue;
    }
    char const letter = text[++at];
    switch (letter) {
      case 'n': result += '\n'; break;
      case 't': result += '\t'; break;
      case 'r': result += '\r'; break;
      case 'b': result += '\b'; break;
      case 'f': result += '\f'; break;
      case 'u': {
        unsigned code = 0;
        auto const digits = text.substr(std::min(at + 1, text.size()), 4);
        std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
        result += static_cast<char>(code);
        at += 4;
        break;
      }
      default: result += letter;
    }
  }
  text.remove_prefix(std::min(at + 1, text.size()));
  return result;
}

}  // namespace scarp
