// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "scarp/io/atomic_file.hpp"
#include "scarp/io/json.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/io/time_stamp.hpp"

namespace scarp {

/// Description of a run, in a JSON file of its output folder.
struct RunRecord {
  using Lines = std::vector<std::pair<std::string, std::string>>;  ///< names and values

  std::string program{};     ///< name of the executable
  std::string identity{};    ///< no two runs have the same; made by RunFolder
  std::string state{};       ///< running (or killed), finished, or why it has stopped
  std::string started{};     ///< as time_stamp() has it
  std::string changed{};     ///< when `state` came about
  std::string checkpoint{};  ///< folder of its checkpoints, absolute; empty: none are made
  std::string scene{};       ///< what its checkpoints must agree with, a line for each choice
  Lines build{};             ///< version, compiler, processor and the like
  Lines options{};           ///< all of them, also those that were not given
  Lines defaults{};          ///< what they would have been, in the same order

  bool has_finished() const { return state == "finished"; }  ///< Whether the run came to its own end.

  /// Of the most a reader needs to recognise it.
  std::string described() const {
    return fmt::format("a run of {}, started {} and {}", program, started,
                       has_finished()       ? "finished"
                       : state == "running" ? "not finished"
                                            : "stopped (" + state + ")");
  }

  /// JSON object: a member for each field, with an object for each of the three lists.
  std::string text() const {
    std::string json = "{\n";
    members(*this, [&](std::string_view name, std::string const& value) {
      json += fmt::format("  {}: {},\n", quoted_json(name), quoted_json(value));
    });
    return json + block("build", build) + ",\n" + block("options", options) + ",\n" + block("defaults", defaults) +
           "\n}\n";
  }

  /// \throws InputError for a text that no record has
  static RunRecord from(std::string_view text) {
    RunRecord record;
    Lines* block = nullptr;
    Lines unknown;
    std::optional<std::string> name;
    while (!text.empty()) {
      if (text.front() != '"') {
        if (text.front() == '{') block = name ? record.lines(*name, unknown) : nullptr;
        if (text.front() == '}') block = nullptr;
        if (text.front() == '{' || text.front() == ',') name.reset();
        text.remove_prefix(1);
        continue;
      }
      std::string found = take_json_string(text);
      if (!name) {
        name = std::move(found);
      } else if (block != nullptr) {
        block->emplace_back(*name, std::move(found));
      } else {
        members(record, [&](std::string_view member, std::string& value) {
          if (member == *name) value = std::move(found);
        });
      }
    }
    if (record.identity.empty() || record.state.empty())
      reject("it is no record of a run (members are missing): remove it");
    return record;
  }

 private:
  template <class Self, class Visit>
  static void members(Self& self, Visit const& visit) {
    visit("program", self.program);
    visit("identity", self.identity);
    visit("state", self.state);
    visit("started", self.started);
    visit("changed", self.changed);
    visit("checkpoint", self.checkpoint);
    visit("scene", self.scene);
  }

  Lines* lines(std::string_view name, Lines& unknown) {
    return name == "build" ? &build : name == "options" ? &options : name == "defaults" ? &defaults : &unknown;
  }

  static std::string block(std::string_view name, Lines const& lines) {
    std::string json = fmt::format("  {}: {{", quoted_json(name));
    for (auto const& [key, value] : lines)
      json += fmt::format("{}\n    {}: {}", json.ends_with('{') ? "" : ",", quoted_json(key), quoted_json(value));
    return json + "\n  }";
  }
};

/// A name that no other run has: the moment and some random digits.
inline std::string new_run_identity() {
  std::random_device random;
  return fmt::format("{}-{:08x}{:08x}", time_stamp(), random(), random());
}

}  // namespace scarp
