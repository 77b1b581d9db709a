// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "scarp/core/error.hpp"

namespace examples {

/// Lines "key value" or "key = value" of a text, each of which must be taken.
class Entries {
 public:
  /// \throws InputError for a line without a value and for a key that is given twice
  explicit Entries(std::string_view text) {
    for (int line = 1; !text.empty(); ++line) {
      std::string_view const whole = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(whole.size() + 1, text.size()));
      std::string_view const entry = trimmed(whole.substr(0, whole.find('#')));
      if (entry.empty()) continue;
      std::string_view const key = entry.substr(0, entry.find_first_of(" \t\r="));
      std::string_view value = trimmed(entry.substr(key.size()));
      if (value.starts_with('=')) value = trimmed(value.substr(1));
      if (value.empty()) scarp::reject("line {} is '{}' (a key and its value are expected): add the value", line, key);
      if (!values_.try_emplace(std::string(key), Value{std::string(value), line}).second)
        scarp::reject("line {} gives '{}' again (one value is expected): leave one out", line, key);
    }
  }

  bool has(std::string const& key) const { return values_.contains(key); }

  /// Leaves the value as it is where the key is not given.
  void take(std::string const& key, std::string& value) {
    if (auto const found = values_.extract(key)) value = found.mapped().text;
  }
  template <class Number>
    requires std::floating_point<Number> || std::integral<Number>
  void take(std::string const& key, Number& value) {
    auto const found = values_.extract(key);
    if (!found) return;
    auto const& [text, line] = found.mapped();
    auto const [end, trouble] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (trouble != std::errc{} || end != text.data() + text.size() || !std::isfinite(static_cast<double>(value)))
      scarp::reject("line {}: '{}' is '{}' ({} is expected): correct it", line, key, text, expected<Number>());
  }

  /// \throws InputError for keys that nobody took
  void require_all_taken(std::string_view kind) const {
    for (auto const& [key, value] : values_)
      scarp::reject("line {}: {} has no '{}' (it is unknown or of another kind): leave it out", value.line, kind, key);
  }

 private:
  static constexpr std::string_view blanks = " \t\r";

  template <class Number>
  static std::string expected() {
    if constexpr (std::floating_point<Number>) return "a finite number";
    return fmt::format("a whole number from {} to {}", std::numeric_limits<Number>::lowest(),
                       std::numeric_limits<Number>::max());
  }

  static std::string_view trimmed(std::string_view text) {
    auto const first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  struct Value {
    std::string text;
    int line;
  };
  std::map<std::string, Value> values_;
};

}  // namespace examples
