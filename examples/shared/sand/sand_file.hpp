// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../entries.hpp"
#include "sand.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/read_file.hpp"

namespace examples {

/// Whether an option is given elsewhere, so that the value of a file does not count.
using IsGiven = std::function<bool(std::string const& name)>;

/// Takes the options of a sand out of entries.
/// \throws InputError for values that cannot be, options that the sand has no use for, and two that set the density
inline void take(Entries& entries, Sand& sand, IsGiven const& is_given = {}) {
  auto const counts = [&](std::string const& name) { return is_given && is_given(name); };
  bool density_given = false;
  for_each_option(sand, [&](std::string_view name, auto const& member, Range, char const*) {
    using Member = std::remove_cvref_t<decltype(member)>;
    bool const off = name != "preparation-friction" && member == Member{};
    if (sets_density(name) && counts(std::string(name)) && !off) density_given = true;
  });
  std::vector<std::string> names;
  std::string density;
  Sand of_file = sand;  // with all values of the file: what others replace later was of use there
  for_each_option(sand, [&](char const* name, auto& member, Range, char const*) {
    if (!entries.has(name)) return;
    auto value = member;
    entries.take(name, value);
    for_each_option(of_file, [&](std::string_view option, auto& same, Range, char const*) {
      if constexpr (std::is_same_v<decltype(same), decltype(member)>) {
        if (option == name) same = value;
      }
    });
    if (sets_density(name) && !std::exchange(density, name).empty())
      scarp::reject("'{}' stands beside another option that sets the density: leave one out", name);
    if (counts(name) || (sets_density(name) && density_given)) return;
    member = value;
    names.emplace_back(name);
  });
  for (auto const& name : names) {
    if (auto const why = why_unused(of_file, name); !why.empty())
      scarp::reject("'{}' is given but not used ({}): leave it out", name, why);
  }
  validate(sand);
}

/// A sand from lines `option = value`; what follows # is a comment. `sand` holds what the file does not give.
/// \throws InputError naming file and option, FileError
inline Sand read_sand(std::filesystem::path const& path, Sand sand = {}, IsGiven const& is_given = {}) {
  auto const text = scarp::read_file(path);
  scarp::with_context(path.string(), [&] {
    Entries entries(text);
    if (entries.empty()) scarp::reject("it has no lines `option = value` (a sand has one at least): write them");
    take(entries, sand, is_given);
    entries.require_all_taken("a sand");
  });
  return sand;
}

/// The text that read_sand reads: all options that the sand uses, with what they are. A ratio of no vertical pressure
/// is left to the program that reads it: ground has one of its own.
inline std::string text_of(Sand const& sand) {
  std::string text;
  bool const bisects = sand.void_ratio > 0.0 || sand.relative_density > 0.0;
  for_each_option(sand, [&](char const* name, auto const& member, Range, char const* what) {
    using Member = std::remove_cvref_t<decltype(member)>;
    if (!why_unused(sand, name).empty() || (bisects && std::string_view(name) == "preparation-friction")) return;
    if constexpr (std::is_same_v<Member, std::string>) {
      auto word = member;
      std::ranges::replace_if(
          word, [](char letter) { return letter == '#' || letter == '\n' || letter == '\r'; }, ' ');
      if (!word.empty()) text += fmt::format("{} = {}\n", name, word);
    } else {
      bool const off =
          sets_density(name) || std::string_view(name) == "vertical-pressure" || std::string_view(name) == "k0";
      if (off && member == Member{} && std::string_view(name) != "preparation-friction") return;
      if (std::string_view(name) == "overconsolidation-ratio" && sand.vertical_pressure == 0.0 && member == Member{1})
        return;
      text += fmt::format("{} = {}  # {}\n", name, member, what);
    }
  });
  return text;
}

/// A packing's sand is kept beside it: X.packing has X.sand.
inline std::filesystem::path sand_path(std::filesystem::path packing) { return packing.replace_extension(".sand"); }

/// Options of the shape of grains and of the law between them.
inline constexpr char const* grain_options[] = {"shape",
                                                "law",
                                                "friction",
                                                "modulus",
                                                "poisson",
                                                "normal-stiffness",
                                                "tangential-stiffness",
                                                "rolling-stiffness",
                                                "rolling-friction"};

/// A value of grains or contacts that two sands do not share.
struct OtherGrains {
  std::string option;
  std::string before;
  std::string now;
};

/// now: whose unused options do not count
inline std::vector<OtherGrains> other_grains(Sand const& before, Sand const& now) {
  std::vector<OtherGrains> others;
  std::map<std::string, std::string> values;
  for_each_option(before, [&](char const* name, auto const& value, Range, char const*) {
    values[name] = fmt::format("{}", value);
  });
  for_each_option(now, [&](char const* name, auto const& value, Range, char const*) {
    bool const counts = std::ranges::find(grain_options, std::string_view(name)) != std::end(grain_options) &&
                        why_unused(now, name).empty();
    if (auto text = fmt::format("{}", value); counts && text != values[name])
      others.push_back({name, values[name], std::move(text)});
  });
  return others;
}

/// Notes on values of grains and contacts that a packing was not prepared with.
inline std::vector<std::string> other_than_prepared(std::filesystem::path const& packing, Sand const& sand) {
  std::vector<std::string> notes;
  if (!std::filesystem::is_regular_file(sand_path(packing))) return notes;
  Sand const own = read_sand(sand_path(packing), {}, [](auto const&) { return false; });
  for (auto const& [option, before, now] : other_grains(own, sand))
    notes.push_back(fmt::format("'{}' was prepared with {} {}, and {} is given: its grains lie as they were left",
                                packing.string(), option, before, now));
  return notes;
}

/// \throws InputError for options that only a preparation uses, beside a packing that is there
inline void require_of_grains(Sand const& sand, IsGiven const& is_given, std::string_view packing) {
  for_each_option(sand, [&](char const* name, auto const&, Range, char const*) {
    if (is_given(name) && std::ranges::find(grain_options, std::string_view(name)) == std::end(grain_options))
      scarp::reject("'{}' is given but not used (the packing of '{}' is there): leave it out", name, packing);
  });
}

/// The sand of a packing that rve_lab prepared. prefix: of the names by which values are given
/// \throws InputError for a packing or a sand that is not there
inline Sand sand_of_packing(std::filesystem::path const& packing, Sand sand, IsGiven const& is_given,
                            std::string_view prefix = "--") {
  if (!std::filesystem::exists(packing))
    scarp::reject("cannot read '{}' (there is no such file): check its name and folder", packing.string());
  auto const path = sand_path(packing);
  if (std::filesystem::is_regular_file(path)) return read_sand(path, std::move(sand), is_given);
  std::string missing;
  for (char const* name : grain_options) {
    if (why_unused(sand, name).empty() && !is_given(name))
      missing += fmt::format("{}{}{}", missing.empty() ? "" : ", ", prefix, name);
  }
  if (missing.empty()) return sand;
  scarp::reject("the sand of '{}' is not known (there is no '{}' beside it): bring that file back, or give {}",
                packing.string(), path.string(), missing);
}

}  // namespace examples
