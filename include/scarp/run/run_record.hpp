// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/json.hpp"

namespace scarp {

/// Description of a run, in a JSON file of its output folder.
struct RunRecord {
  using Lines = std::vector<std::pair<std::string, std::string>>;  ///< names and values

  std::string program{};     ///< name of the executable
  std::string identity{};    ///< no two runs have the same: the moment and random digits, made by RunFolder
  std::string state{};       ///< running (or killed), finished, or why it has stopped
  std::string started{};     ///< ISO 8601, universal time
  std::string changed{};     ///< when `state` came about
  std::string checkpoint{};  ///< folder of its checkpoints, absolute; empty: none are made
  std::string scene{};       ///< what its checkpoints must agree with, a line for each choice
  Lines build{};             ///< version, compiler, processor and the like
  Lines options{};           ///< all of them, also those that were not given
  Lines defaults{};          ///< what they would have been, in the same order

  bool has_finished() const { return state == "finished"; }  ///< Whether the run came to its own end.

  /// What a reader needs to recognise it.
  std::string described() const {
    return fmt::format("a run of {}, started {} and {}", program, started,
                       has_finished()       ? "finished"
                       : state == "running" ? "not finished"
                                            : "stopped (" + state + ")");
  }

  /// JSON object: a member for each field, with an object for each of the three lists.
  std::string text() const {
    std::string json;
    members(*this, [&](std::string_view name, auto const& value) {
      json += fmt::format("{}\n  {}: {}", json.empty() ? "{" : ",", quoted_json(name), written(value));
    });
    return json + "\n}\n";
  }

  /// \throws InputError for a text that no record has
  static RunRecord from(std::string_view text) {
    RunRecord record;
    Lines unknown;
    Lines* block = &unknown;
    int depth = 0;  // of objects and arrays, which later programs may nest
    std::optional<std::string> name;
    while (!text.empty()) {
      if (text.front() != '"') {
        bool const opens = text.front() == '{' || text.front() == '[';
        if (opens && ++depth == 2) block = name && text.front() == '{' ? record.lines(*name, unknown) : &unknown;
        if (text.front() == '}' || text.front() == ']') --depth;
        if (opens || text.front() == ',') name.reset();
        text.remove_prefix(1);
        continue;
      }
      std::string found = take_json_string(text);
      if (!name) {
        name = std::move(found);
      } else if (depth != 1) {
        (depth == 2 ? block : &unknown)->emplace_back(*name, std::move(found));
      } else {
        members(record, [&]<class Value>(std::string_view member, Value& value) {
          if constexpr (std::same_as<Value, std::string>)
            if (member == *name) value = std::move(found);
        });
      }
    }
    if (record.identity.empty() || record.state.empty())
      reject("it is no record of a run (members are missing): remove it");
    return record;
  }

  SCARP_MEMBERS(program, identity, state, started, changed, checkpoint, scene, build, options, defaults)

 private:
  Lines* lines(std::string_view name, Lines& unknown) {
    return name == "build" ? &build : name == "options" ? &options : name == "defaults" ? &defaults : &unknown;
  }

  static std::string written(std::string const& text) { return quoted_json(text); }
  static std::string written(Lines const& lines) {
    std::string json = "{";
    for (auto const& [key, value] : lines)
      json += fmt::format("{}\n    {}: {}", json.ends_with('{') ? "" : ",", quoted_json(key), quoted_json(value));
    return json + "\n  }";
  }
};

}  // namespace scarp
