// SPDX-License-Identifier: BSL-1.0
#include <CLI/CLI.hpp>
#include <fstream>
#include <sstream>

#include "../../examples/shared/command_line.hpp"
#include "../../examples/shared/sand/grading.hpp"
#include "../../examples/shared/sand/sand_file.hpp"
#include "adversary/readers.hpp"

namespace adversary {

namespace {

/// As the examples declare theirs: each kind of option once.
struct Options {
  double size = 1.0;
  double friction = 0.5;
  int grains = 100;
  std::uint64_t seed = 1;
  std::string soil = "dem";
  bool reverse = false;
  std::vector<double> list{0.1};
  std::string table;
};

void read_options(std::string const& text) {
  Options options;
  CLI::App app;
  app.add_option("--size", options.size)->check(examples::number_from(0.0, false, 25.0));
  app.add_option("--grains", options.grains)->check(CLI::Range(1, 100'000));
  app.add_option("--seed", options.seed)->check(examples::seed_number());
  app.add_option("--soil", options.soil)->check(CLI::IsMember({"dem", "elastic"}));
  app.add_flag("--reverse", options.reverse);
  app.add_option("--list", options.list)->delimiter(',')->check(examples::number_from(0.0, true, 10.0));
  auto& shear = *app.add_subcommand("shear");
  shear.configurable();
  shear.add_option("--friction", options.friction)->check(examples::number_from(0.0, true, 10.0));
  shear.add_option("--table", options.table);
  app.allow_config_extras(CLI::config_extras_mode::error);
  std::istringstream stream(text);
  try {
    app.parse_from_stream(stream);
  } catch (CLI::ParseError const& refusal) {
    throw InputError(fmt::format("options are refused ({}): see --help", refusal.what()));
  }
  demand(options.size > 0.0 && options.size <= 25.0, "a size out of range");
  demand(options.friction >= 0.0 && options.friction <= 10.0, "a friction out of range");
  demand(options.grains >= 1 && options.grains <= 100'000, "a number of grains out of range");
  demand(options.seed < 1'000'000'000'000'000, "a seed out of range");
  demand(options.soil == "dem" || options.soil == "elastic", "an unknown soil");
  for (double const value : options.list) demand(value >= 0.0 && value <= 10.0, "a listed number out of range");
}

Game sand_reader() {
  auto const folder = std::make_shared<ScratchFolder>();
  examples::Sand const dense{.shape = "ellipse", .relative_density = 0.8, .misfit = "0.5 standard errors"};
  examples::Sand const sieved{.law = "hertz", .sieve = "0.002 0, 0.004 60, 0.006 100"};
  return reader("sands", {examples::text_of(dense), examples::text_of(sieved)}, [=](std::string const& bytes) {
    auto const file = *folder / "any.sand";
    std::ofstream(file, std::ios::binary) << bytes;
    auto const sand = examples::read_sand(file);
    examples::for_each_option(sand, [](char const*, auto const& member, examples::Range range, char const*) {
      if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(member)>>) {
        auto const value = static_cast<double>(member);
        demand(value >= range.least && value <= range.most, "an option out of range");
      }
    });
    if (!sand.sieve.empty()) static_cast<void>(examples::sieve_curve(sand.sieve));
  });
}

}  // namespace

std::vector<Game> readers_of_options() {
  std::string const options =
      "size = 2.5\ngrains = 49\nseed = 2\nsoil = elastic\nreverse = true\nlist = 0.1,0.3\n\n[shear]\nfriction = 0.5\n"
      "table = \"out.csv\"\n";
  return {reader("options", {options}, read_options), sand_reader()};
}

}  // namespace adversary
