// SPDX-License-Identifier: BSL-1.0
// How does a program of deal.II take packings as its material? The reference study's fault on a distributed, adaptive
// mesh.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "../shared/run_options.hpp"
#include "../shared/version_option.hpp"
#include "ground.hpp"

namespace {

using dealii_fault::Options;
using fault_rupture::Soil;

void declare(CLI::App& app, Options& options, std::string& own) {
  using examples::number_from;
  examples::add_named<Soil>(app, "--soil", options.soil, "dem (a packing in every point), mohr_coulomb or elastic",
                            {{"dem", Soil::dem}, {"mohr_coulomb", Soil::mohr_coulomb}, {"elastic", Soil::elastic}});
  app.add_option("--size", options.size, "width of a cell in the band before refinement [m]")
      ->check(number_from(0.0, false, 25.0));
  app.add_option("--length", options.length, "intrinsic length [m], 0 for none")->check(number_from(0.0, true, 1e3));
  app.add_option("--grains", options.grains, "of a packing")->check(CLI::Range(1, 100'000));
  app.add_option("--throw-over-depth", options.throw_over_depth, "at the end")->check(number_from(0.0, false, 1.0));
  app.add_flag("--newton", options.newton,
               "the points' tangents instead of initial stiffness with Anderson's acceleration");
  app.add_option("--levels", options.levels, "of refinement, 0 for none")->check(CLI::Range(0, 8));
  app.add_option("--refine-at", options.refine_at,
                 "shear strain since the mesh last changed; a tenth of it joins cells")
      ->check(number_from(0.0, false, 1.0));
  app.add_option("--imbalance", options.imbalance,
                 "DEM steps of the busiest process over their mean, above which points are shared out anew")
      ->check(number_from(1.0, true, 1e9));
  app.add_option("--threads", options.threads, "of each process")->check(CLI::Range(1, 1024));
  app.add_flag("--block", options.block, "elastic ground under its own weight, compared with the closed form");
  app.add_option("--own", own, "summary.json of fault_rupture on the same mesh, to be compared with")
      ->check(CLI::ExistingFile);
  app.add_option("--output", options.output, "folder of the fields")->check(examples::folder_problem);
  auto* const folder =
      app.add_option("--checkpoint", options.checkpoint, "folder where the run is saved at its end and meanwhile")
          ->check(examples::folder_problem);
  app.add_option("--checkpoint-every", options.checkpoint_every, "wall time after which the run is saved again [s]")
      ->check(number_from(0.0, true, 1e9))
      ->needs(folder);
  app.add_flag("--resume", options.resume, "from there, on any number of processes")->needs(folder);
  app.add_option("--stop-at", options.stop_at, "throw at which to end [m]")->check(number_from(0.0, false, 25.0));
}

/// A saved run takes the place of a whole folder.
/// \throws scarp::InputError for a folder of other files
void check_checkpoint(std::string& name) {
  namespace fs = std::filesystem;
  if (name.empty()) return;
  fs::path const folder = (fs::path(name) / "").parent_path();  // without a slash at its end
  name = folder.string();
  if (fs::exists(folder) && !fs::is_empty(folder) && !fs::exists(folder / "run"))
    scarp::reject("'{}' holds other files than a saved run (which would replace them): give --checkpoint another name",
                  name);
}

void complete(Options& options, std::string const& own) {
  check_checkpoint(options.checkpoint);
  bool const packings = options.soil == Soil::dem && !options.block;
  options.newton = options.newton || options.block || options.soil == Soil::elastic;
  options.residual = options.newton ? 1e-8 : packings ? 1e-3 : 1e-5;
  options.max_displacement_gradient = packings ? 0.005 : 0.02;
  options.max_iterations = options.newton ? 30 : 60;
  if (own.empty()) return;
  auto const summary = nlohmann::json::parse(std::ifstream(own));
  options.own_x50 = summary.at("surface_x50").get<double>();
  options.own_mean = summary.at("surface_mean").get<double>();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.threads = 1;
  options.grains = 100;
  options.soil = Soil::mohr_coulomb;
  std::string own;
  CLI::App app("The reference study's fault as a program of deal.II whose material is scarp's.");
  declare(app, options, own);
  examples::declare_version(app);
  if (auto const code = examples::ended_by_options(app, argc, argv)) return *code;
  dealii::Utilities::MPI::MPI_InitFinalize const session(argc, argv, 1);
  try {
    complete(options, own);
    scarp::StopSignal const stop;
    bool const complete = dealii_fault::Ground(options, MPI_COMM_WORLD).run(stop);
    return complete ? 0 : stop.wants_stop() ? 130 : 3;
  } catch (std::exception const& problem) {
    std::cerr << "dealii_fault: " << problem.what() << std::endl;
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  return 1;
}
