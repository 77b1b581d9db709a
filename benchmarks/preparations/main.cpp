// SPDX-License-Identifier: BSL-1.0
// Which preparation of the reference study's packing gives both its void ratio and its earth pressure at rest?
#include <fmt/format.h>

#include <exception>

#include "../shared/data_file.hpp"
#include "measures.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

using namespace preparations;

/// At 0, 1.0, 2.9, 6.1, 12.5, 18.9 and 25 m: 4 kPa + 15.68 kN/m3 times the depth.
constexpr std::array overburdens{4e3, 20e3, 50e3, 100e3, 200e3, 300e3, 396e3};
constexpr double tested_overburden = 200e3;

struct Row {
  Preparation preparation;
  std::uint64_t seed = 0;
  double overburden = 0.0;
  scarp::Verdict verdict;
  Measures measures;
  Tested tested;
};

std::vector<Row> rows_of(int grains, std::uint64_t seed) {
  std::vector<Row> rows;
  Columns columns(grains, seed);
  for (auto const& preparation : all_preparations()) {
    for (auto const& depth : columns.make(preparation, overburdens)) {
      Row row{preparation, seed, depth.overburden, depth.prepared.verdict, {}, {}};
      if (row.verdict.acceptable()) {
        row.measures = measure(depth);
        if (preparation.tested && depth.overburden == tested_overburden) row.tested = test(depth.prepared.packing);
      }
      rows.push_back(row);
    }
  }
  fmt::print(stderr, "seed {}: {} packings\n", seed, rows.size());
  return rows;
}

void write(std::vector<std::vector<Row>> const& of_seeds) {
  scarp::CsvTable table({"path",
                         "isotropic pressure [Pa]",
                         "isotropic friction",
                         "share",
                         "share friction",
                         "vertical friction",
                         "overconsolidation ratio",
                         "held ratio",
                         "laid",
                         "fastest",
                         "seed",
                         "overburden [Pa]",
                         "status",
                         "K0",
                         "void ratio",
                         "coordination",
                         "mechanical coordination",
                         "contact fabric",
                         "particle fabric",
                         "horizontal particle fabric",
                         "sliding share",
                         "lateral strain",
                         "vertical strain",
                         "friction angle, window of 5 % [deg]",
                         "friction angle, window of 0.5 % [deg]",
                         "dilation angle [deg]",
                         "elastic K0"});
  for (auto const& rows : of_seeds) {
    for (auto const& [made, seed, overburden, verdict, is, tested] : rows) {
      table.add(made.path, made.isotropic_pressure, made.isotropic_friction, made.share, made.share_friction,
                made.vertical_friction, made.overconsolidation_ratio, made.held_ratio, made.laid, made.fastest, seed,
                overburden, scarp::name(verdict.status), is.k0, is.void_ratio, is.coordination,
                is.mechanical_coordination, is.contact_fabric, is.particle_fabric, is.level_particle_fabric,
                is.sliding_share, is.lateral_strain, is.vertical_strain, tested.friction_angle,
                tested.narrow_friction_angle, tested.dilation_angle, tested.elastic_k0);
    }
  }
  benchmarks::write_data("preparations", table.text());
}

}  // namespace

/// --quick: two clouds of 60 grains
int main(int argc, char** argv) try {
  bool const quick = benchmarks::is_quick(argc, argv);
  std::vector<std::vector<Row>> of_seeds(quick ? 2 : 10);
  scarp::ThreadExecutor executor(0);
  executor.for_each(static_cast<int>(of_seeds.size()), [&](int k) {
    of_seeds[static_cast<std::size_t>(k)] = rows_of(quick ? 60 : 400, static_cast<std::uint64_t>(k + 1));
  });
  write(of_seeds);
  return 0;
} catch (std::exception const& problem) {
  fmt::print(stderr, "preparations: {}\n", problem.what());
  return 1;
}
