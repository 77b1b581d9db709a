// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <ranges>
#include <string>
#include <string_view>

namespace scarp {

/// Text whose bytes are UTF-8: others, as names of files may have, become U+FFFD, the replacement character.
inline std::string valid_utf8(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    auto const at = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
    unsigned const lead = at(0);
    std::size_t const length = lead < 0x80                   ? 1
                               : lead >= 0xc2 && lead < 0xe0 ? 2
                               : lead >> 4U == 0xe           ? 3
                               : lead >= 0xf0 && lead < 0xf5 ? 4
                                                             : 0;
    bool sound = length > 0;
    for (std::size_t k = 1; k < length; ++k) sound = sound && at(k) >> 6U == 2;
    // No longer forms than needed, no halves of surrogate pairs, nothing beyond U+10FFFF.
    sound = sound && !(lead == 0xe0 && at(1) < 0xa0) && !(lead == 0xed && at(1) > 0x9f) &&
            !(lead == 0xf0 && at(1) < 0x90) && !(lead == 0xf4 && at(1) > 0x8f);
    valid += sound ? text.substr(0, length) : std::string_view("\xEF\xBF\xBD");
    text.remove_prefix(sound ? length : 1);
  }
  return valid;
}

/// A JSON string with its quotes (RFC 8259, section 7), whatever the bytes of the text.
inline std::string quoted_json(std::string_view text) {
  std::string result = "\"";
  for (char const letter : valid_utf8(text)) {
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

namespace detail {

/// A character of JSON's \u, behind which `text` continues; of two halves of a surrogate pair the one that they make.
inline std::string take_json_escape(std::string_view& text) {
  auto const hex = [&] {
    unsigned code = 0xfffd;
    std::from_chars(text.data(), text.data() + std::min<std::size_t>(text.size(), 4), code, 16);
    text.remove_prefix(std::min<std::size_t>(text.size(), 4));
    return code;
  };
  unsigned code = hex();
  if (code >> 10U == 0x36 && text.starts_with("\\u")) {
    text.remove_prefix(2);
    code = 0x10000U + ((code & 0x3ffU) << 10U) + (hex() & 0x3ffU);
  }
  auto const tail = [&](unsigned shift) { return static_cast<char>(0x80U | (code >> shift & 0x3fU)); };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xc0U | code >> 6U), tail(0)};
  if (code < 0x10000) return {static_cast<char>(0xe0U | code >> 12U), tail(6), tail(0)};
  return {static_cast<char>(0xf0U | code >> 18U), tail(12), tail(6), tail(0)};
}

}  // namespace detail

/// Removes the JSON string that `text` begins with.
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
        auto rest = text.substr(at + 1);
        result += detail::take_json_escape(rest);
        at = text.size() - rest.size() - 1;
        break;
      }
      default: result += letter;
    }
  }
  text.remove_prefix(std::min(at + 1, text.size()));
  return result;
}

/// One JSON object, written key by key. Values are numbers, truth values, text, other objects, and ranges of these.
/// Numbers are in the shortest form that reads back to the same bits; one that is not finite becomes null.
class JsonObject {
 public:
  /// key: distinct from earlier ones, which is not checked
  template <class Value>
  JsonObject& add(std::string_view key, Value const& value) {
    if (!members_.empty()) members_ += ',';
    members_ += json(key) + ':' + json(value);
    return *this;
  }

  std::string text() const { return '{' + members_ + '}'; }  ///< The object in braces, on one line.

 private:
  template <class Value>
  static std::string json(Value const& value) {
    if constexpr (std::same_as<Value, JsonObject>) {
      return value.text();
    } else if constexpr (std::convertible_to<Value const&, std::string_view>) {
      return quoted_json(value);
    } else if constexpr (std::ranges::range<Value>) {
      std::string list = "[";
      for (auto const& item : value) {
        if (list.size() > 1) list += ',';
        list += json(item);
      }
      return list + ']';
    } else if constexpr (std::floating_point<Value>) {
      return std::isfinite(value) ? fmt::format("{}", value) : "null";
    } else {
      return fmt::format("{}", value);
    }
  }

  std::string members_;
};

}  // namespace scarp
