// SPDX-License-Identifier: BSL-1.0
#include "ensemble.hpp"
#include "../shared/renamed_keys.hpp"
#include "measure_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "scarp/core/error.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/io/csv_reader.hpp"
#include "scarp/io/read_file.hpp"

namespace fault_rupture {

namespace {

using Json = nlohmann::ordered_json;

/// Counts and times of a process that all members share, and what is no measure.
constexpr std::array no_measures{"seed",
                                 "elements",
                                 "grains_per_rve",
                                 "threads",
                                 "cpu_seconds",
                                 "wall_seconds",
                                 "peak_memory_bytes",
                                 "share_of_time_in_points",
                                 "share_of_time_outside_points",
                                 "tolerance",
                                 "fault_line_x50",
                                 "depth",
                                 "footing_centre",
                                 "footing_width",
                                 "bearing_pressure"};

struct Spread {
  int count = 0;
  double mean = 0.0;
  double scatter = std::numeric_limits<double>::quiet_NaN();
};

Spread spread_of(std::vector<double> const& values) {
  Spread spread{.count = static_cast<int>(values.size())};
  for (double const value : values) spread.mean += value / spread.count;
  if (spread.count < 2) return spread;
  double squares = 0.0;
  for (double const value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.scatter = std::sqrt(squares / (spread.count - 1));
  return spread;
}

/// All numbers of a summary by their names, those of bands with their height.
void collect(Json const& summary, std::vector<std::string>& names, std::map<std::string, std::vector<double>>& values) {
  auto const add = [&](std::string const& name, Json const& value) {
    if (!value.is_number() || examples::is_key_from_before(name)) return;
    if (std::ranges::find(no_measures, std::string_view(name)) != no_measures.end()) return;
    auto& all = values[name];
    if (all.empty()) names.push_back(name);
    all.push_back(value.get<double>());
  };
  for (auto const& [name, value] : summary.items()) add(name, value);
  if (!summary.contains("bands")) return;
  for (auto const& band : summary["bands"]) {
    for (auto const& [name, value] : band.items()) {
      if (name != "height_over_depth")
        add(fmt::format("{} at {:.2f} of the depth", name, band["height_over_depth"].get<double>()), value);
    }
  }
}

std::vector<EnsembleMember> finished(std::vector<EnsembleMember> const& members) {
  auto found = members;
  std::erase_if(found, [](EnsembleMember const& member) { return member.code != 0; });
  return found;
}

}  // namespace

std::filesystem::path member_folder(std::filesystem::path const& all, std::uint64_t seed) {
  return all / fmt::format("seed_{}", seed);
}

Json ensemble_summary(std::vector<EnsembleMember> const& members) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> values;
  Json summary;
  for (auto const& member : members) {
    Json told{{"seed", member.seed}, {"folder", member.folder.filename().string()}, {"status", member.problem}};
    if (member.problem.empty()) {
      auto const own = Json::parse(scarp::read_file(member.folder / "summary.json"));
      told["status"] = own["status"];
      if (member.code == 0) collect(own, names, values);
      for (auto const& [part, found] : own["error_budget"]["parts"].items()) {
        if (!found["within"].get<bool>())
          told["outside_budget"][part] = {{"value", found["value"]}, {"bound", found.value("bound", Json())}};
      }
    }
    summary["members"].push_back(std::move(told));
  }
  for (auto const& name : names) {
    auto const spread = spread_of(values[name]);
    auto const said = words_of(name);
    auto const level = name.find(" at ");
    auto const what = *said.what == '\0'   ? name
                      : level == name.npos ? said.what
                                           : said.what + (", " + name.substr(level + 1));
    summary["measures"][name] = {{"count", spread.count}, {"mean", spread.mean}, {"scatter", spread.scatter},
                                 {"what", what},          {"unit", said.unit},   {"factor", said.factor}};
  }
  return summary;
}

std::string ensemble_table(Json const& summary) {
  std::string text;
  for (auto const& member : summary["members"]) {
    auto const seed = member["seed"].get<std::uint64_t>();
    if (member["status"] != "ok") {
      text += fmt::format("INCOMPLETE: seed {}: {}\n", seed, member["status"].get<std::string>());
      continue;
    }
    std::string outside;
    auto const number = [](Json const& value) { return value.is_number() ? value.get<double>() : std::nan(""); };
    auto const beyond = member.value("outside_budget", Json::object());
    for (auto const& [part, found] : beyond.items())
      outside += fmt::format("{}{} {:.2g} (bound {:.2g})", outside.empty() ? ": " : ", ", part, number(found["value"]),
                             number(found["bound"]));
    text += fmt::format("seed {}: {}side its error budget{}\n", seed, outside.empty() ? "in" : "out", outside);
  }
  text += fmt::format("{:<56} {:>12} {:>12} {:<8} {:>4}  {}\n", "measure", "mean", "scatter", "", "runs", "key");
  if (!summary.contains("measures")) return text;
  for (auto const& [name, spread] : summary["measures"].items()) {
    double const factor = spread["factor"].get<double>();
    std::string const scatter = spread["scatter"].is_null() || !std::isfinite(spread["scatter"].get<double>())
                                    ? "-"
                                    : fmt::format("{:.3g}", factor * spread["scatter"].get<double>());
    text += fmt::format("{:<56} {:>12.5g} {:>12} {:<8} {:>4}  {}\n", spread["what"].get<std::string>(),
                        factor * spread["mean"].get<double>(), scatter, spread["unit"].get<std::string>(),
                        spread["count"].get<int>(), name);
  }
  return text;
}

void write_mean_surface(std::filesystem::path const& file, std::vector<EnsembleMember> const& members) {
  std::vector<std::vector<double>> places;
  std::vector<std::vector<double>> settlements;
  for (auto const& member : finished(members)) {
    auto const table = scarp::read_csv(member.folder / "surface.csv");
    auto const throws = table.column("throw_over_depth");
    auto const x = table.column("x_initial");
    auto const settlement = table.column("settlement");
    auto const first = static_cast<std::size_t>(std::ranges::find(throws, throws.back()) - throws.begin());
    std::size_t const count = throws.size() - first;
    if (places.empty()) {
      places.resize(count);
      settlements.resize(count);
    }
    // The mesh does not depend on the seed; how it has settled at rest does.
    if (count != places.size())
      scarp::reject("'{}' has {} points at its end (other members {}): run all members anew",
                    (member.folder / "surface.csv").string(), count, places.size());
    for (std::size_t k = 0; k < count; ++k) {
      places[k].push_back(x[first + k]);
      settlements[k].push_back(settlement[first + k]);
    }
  }
  scarp::CsvTable table({"x_initial", "settlement", "scatter"});
  for (std::size_t k = 0; k < settlements.size(); ++k) {
    auto const spread = spread_of(settlements[k]);
    table.add(spread_of(places[k]).mean, spread.mean, spread.scatter);
  }
  table.write(file);
}

}  // namespace fault_rupture
