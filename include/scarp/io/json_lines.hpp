// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <filesystem>
#include <ranges>
#include <string>
#include <string_view>

#include "scarp/core/described.hpp"
#include "scarp/io/detail/appended_file.hpp"
#include "scarp/io/json_text.hpp"

namespace scarp {

/// One JSON object, written key by key. Values are numbers, truth values, text, other objects, and ranges of these.
/// Numbers are in the shortest form that reads back to the same bits; one that is not finite becomes null.
class JsonObject {
 public:
  /// keys are the caller's to keep apart
  template <class Value>
  JsonObject& add(std::string_view key, Value const& value) {
    if (!members_.empty()) members_ += ',';
    members_ += json(key) + ':' + json(value);
    return *this;
  }

  std::string text() const { return '{' + members_ + '}'; }

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

/// JSON lines on disk, one object a line.
class JsonLog {
 public:
  /// An older file of this name is replaced, or continued when a run is resumed.
  /// \throws FileError when the file cannot be written
  explicit JsonLog(std::filesystem::path const& path, bool resumed = false) : file_(path, "", resumed) {}

  /// \throws FileError when the line cannot be written
  void add(JsonObject const& object) { file_.add(object.text() + '\n'); }

  SCARP_MEMBERS(file_)

 private:
  AppendedFile file_;
};

}  // namespace scarp
