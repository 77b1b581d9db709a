// SPDX-License-Identifier: BSL-1.0
// A column of packings in a triaxial test, compared with one packing: in space, with hexahedra and tetrahedra.

#include <CLI/CLI.hpp>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "../shared/version_option.hpp"
#include "column_test.hpp"
#include "rve_test.hpp"
#include "scarp/element/hex8.hpp"
#include "scarp/element/tet10.hpp"

namespace {

using namespace triaxial_column;

constexpr double uniform = 0.01;  // spread of the axial stress up to which a column counts as homogeneous

/// Prints the curve beside that of the packing.
/// \return the largest relative distance of the axial stresses while the column is homogeneous, 1 if the run failed
template <class Element>
double compare(char const* name, Packing const& packing, std::vector<Row> const& alone, Choice const& choice) {
  auto const column = column_test<Element>(packing, choice);
  examples::print(stdout, "\n{}: {} elements, {} points\n{:>9} {:>12} {:>12} {:>10} {:>10} {:>9}\n", name,
                  column.elements, column.points, "strain", "axial [Pa]", "packing", "e_v", "packing", "spread");
  double worst_stress = 0.0;
  double worst_uniform = 0.0;
  double uniform_to = 0.0;  // strain
  bool is_uniform = true;
  double worst_volume = 0.0;
  double next = 0.0;
  for (auto const& row : column.rows) {
    auto const own = at_strain(alone, row.axial_strain);
    worst_stress = std::max(worst_stress, std::abs(row.axial_stress / own.axial_stress - 1.0));
    is_uniform = is_uniform && row.spread < uniform;
    if (is_uniform) {
      worst_uniform = worst_stress;
      uniform_to = row.axial_strain;
    }
    worst_volume = std::max(worst_volume, std::abs(row.volumetric_strain - own.volumetric_strain));
    bool const last = &row == &column.rows.back();
    if (row.axial_strain < next && !last) continue;
    next += choice.strain / 10.0;
    examples::print(stdout, "{:9.5f} {:12.0f} {:12.0f} {:10.6f} {:10.6f} {:9.1e}\n", row.axial_strain, row.axial_stress,
                    own.axial_stress, row.volumetric_strain, own.volumetric_strain, row.spread);
  }
  auto const& run = column.run;
  examples::print(stdout, "{}: axial stress differs by {:.2f} % at most, volumetric strain by {:.1e}\n", name,
                  100.0 * worst_stress, worst_volume);
  examples::print(stdout,
                  "up to the strain {:.5f}, where points differ by less than {:.0f} %: axial stress by {:.2f} %\n",
                  uniform_to, 100.0 * uniform, 100.0 * worst_uniform);
  examples::print(stdout, "{} steps, {} rejected, {} iterations, {} DEM steps, residual {:.1e}, {:.1f} s, {} {}\n",
                  run.steps, run.refused, run.iterations, run.inner_steps, run.largest_residual, run.seconds,
                  scarp::name(run.verdict.status), scarp::name(run.verdict.reason));
  std::fflush(stdout);
  return run.verdict.acceptable() ? worst_uniform : 1.0;
}

/// \return exit code: 0 where column and packing agree
int run(Choice const& choice) {
  auto const prepared = consolidated(choice);
  if (!prepared.verdict.acceptable()) {
    examples::print(stderr, "the packing was not prepared ({}): try another seed\n",
                    scarp::name(prepared.verdict.reason));
    return 1;
  }
  examples::print(stdout, "{} spheres at {:.0f} Pa, void ratio {:.3f}\n", choice.grains, choice.pressure,
                  prepared.packing.void_ratio());
  auto const alone = rve_test(prepared.packing, choice);
  double const hexahedra = compare<scarp::Hex8>("Hex8", prepared.packing, alone, choice);
  double const tetrahedra = compare<scarp::Tet10>("Tet10", prepared.packing, alone, choice);
  return std::max(hexahedra, tetrahedra) < 0.02 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  CLI::App app{"Triaxial compression of a column of packings, beside the same test on one packing"};
  examples::declare_version(app);
  app.option_defaults()->always_capture_default();
  app.add_option("--grains", choice.grains, "spheres in a packing")->check(CLI::Range(30, 2000));
  app.add_option("--seed", choice.seed, "of the packing")->check(examples::seed_number());
  app.add_option("--strain", choice.strain, "shortening at the end")->check(examples::number_from(0.0, false, 0.2));
  app.add_option("--load-step", choice.load_step, "largest shortening of a load step")
      ->check(examples::number_from(0.0, false, 0.01));
  app.add_option("--tolerance", choice.tolerance, "residual of a load step")
      ->check(examples::number_from(0.0, false, 0.1));
  CLI11_PARSE(app, argc, argv);
  try {
    return run(choice);
  } catch (std::exception const& problem) {
    return examples::ended_by(problem, "triaxial_column", app);
  }
}
