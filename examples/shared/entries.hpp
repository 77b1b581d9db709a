// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "scarp/core/error.hpp"
#include "scarp/io/text_lines.hpp"

namespace examples {

/// Lines "key value" or "key = value" of a text, each of which must be taken.
class Entries {
 public:
  /// \throws InputError for a line without a value and for a key that is given twice
  explicit Entries(std::string_view text) {
    for (scarp::TextLines lines(text); !lines.done();) {
      std::string_view const whole = lines.take();
      std::string_view const entry = scarp::trimmed(whole.substr(0, whole.find('#')));
      if (entry.empty() || entry.starts_with(';')) continue;
      auto const line = lines.number();
      std::string_view const key = entry.substr(0, entry.find_first_of(" \t="));
      std::string_view value = scarp::trimmed(entry.substr(key.size()));
      if (value.starts_with('=')) value = scarp::trimmed(value.substr(1));
      if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
      if (value.empty())
        scarp::reject("line {} is '{}' (a key and its value are expected): add the value", line,
                      scarp::shortened(scarp::spelt_out(key)));
      if (!values_.try_emplace(std::string(key), Value{std::string(value), line}).second)
        scarp::reject("line {} gives '{}' again (one value is expected): leave one out", line, key);
    }
  }

  bool empty() const { return values_.empty(); }
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
    if (scarp::read_number(text, value) != std::errc{} || !std::isfinite(static_cast<double>(value)))
      scarp::reject("line {}: '{}' is '{}' ({} is expected): correct it", line, key,
                    scarp::shortened(scarp::spelt_out(text)), expected<Number>());
  }

  /// \throws InputError for keys that nobody took
  void require_all_taken(std::string_view kind) const {
    for (auto const& [key, value] : values_)
      scarp::reject("line {}: {} has no '{}' (it is unknown or of another kind): leave it out", value.line, kind,
                    scarp::shortened(scarp::spelt_out(key)));
  }

 private:
  template <class Number>
  static std::string expected() {
    if constexpr (std::floating_point<Number>) return "a finite number";
    return fmt::format("a whole number from {} to {}", std::numeric_limits<Number>::lowest(),
                       std::numeric_limits<Number>::max());
  }

  struct Value {
    std::string text;
    std::size_t line;
  };
  std::map<std::string, Value> values_;
};

}  // namespace examples
