// SPDX-License-Identifier: BSL-1.0
#include "../shared/contact_reader.hpp"
#include "../shared/packing_input.hpp"
#include "../shared/print.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "packings.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "scarp/io/csv.hpp"
#include "specimen.hpp"

namespace rve_lab {

namespace {

/// Options that are given count before the columns of the contacts.
void take_law_from(scarp::CsvColumns const& contacts, examples::IsGiven const& given, Sand& sand) {
  auto const take = [&](char const* option, std::string_view column, double& parameter) {
    if (!given(option)) parameter = examples::only_value(contacts, column).value_or(parameter);
  };
  take("normal-stiffness", "kn", sand.normal_stiffness);
  take("tangential-stiffness", "ks", sand.tangential_stiffness);
  take("friction", "tan_phi", sand.friction);
}

/// The columns of tests/reference/yade: everything is the state at the row's deformation.
template <class Lab>
std::vector<double> replay_row(Lab const& lab, PathKind const& path, long step) {
  auto const state = scarp::balance(lab.packing(), lab.law());
  Tensor const& deformation = lab.deformation();
  Tensor const& stress = state.stress;
  return {static_cast<double>(step),
          path.strain(deformation),
          deformation(0, 0),
          deformation(0, 1),
          deformation(1, 0),
          deformation(1, 1),
          stress(0, 0),
          stress(0, 1),
          stress(1, 0),
          stress(1, 1),
          lab.packing().void_ratio(),
          state.contacts,
          deepest_overlap(lab.packing(), lab.law())};
}

/// Lets a packing whose shear forces are not known find its balance: both normal stresses held, no shear strain.
/// pressure [Pa], positive
/// \throws InputError for a packing that does not come to rest
template <class PackingType>
void relax(PackingType& packing, scarp::LinearFrictional const& law, double pressure) {
  scarp::Loading<2> loading;
  for (int axis = 0; axis < 2; ++axis) loading.controls.push_back(scarp::component_control<2>(axis, -pressure));
  scarp::TimeStepper<PackingType> stepper;
  double const before = packing.void_ratio();
  auto verdict = scarp::Servo{}.reach(stepper, packing, law, loading);
  if (auto const stopped = stepper.stop(packing, law); verdict.acceptable()) verdict = stopped;
  if (!verdict.acceptable()) {
    scarp::reject("the packing does not come to rest at {} Pa ({}): check cell, stiffness and pressure", pressure,
                  scarp::name(verdict.reason));
  }
  examples::print(stdout, "relaxed at {} Pa: void ratio {:.8f}, {:.8f} in the file\n", pressure, packing.void_ratio(),
                  before);
}

/// \throws InputError for files that are wrong, std::runtime_error when the packing cannot continue; the rows so far
/// are then on disk
template <class PackingType>
void run_replay(Replay const& choice, scarp::CsvColumns const& particles,
                std::optional<scarp::CsvColumns> const& contacts, Tensor const& cell,
                scarp::LinearFrictional const& law) {
  using Lab = Specimen<PackingType, scarp::Observe::balance>;
  auto named = scarp::read_packing<PackingType>(particles, cell, choice.sand.density, choice.sand.thickness);
  if (contacts && (contacts->has("ftx") || contacts->has("fty")))
    examples::read_contacts(named, *contacts, law, choice.tolerance);
  if (choice.relaxation) relax(named.packing, law, *choice.relaxation);
  PathKind const& path = path_named(choice.path.name);
  auto const [steps, strain_step] = even_steps(choice.path.strain, choice.path.strain_step, "strain");
  Lab lab(std::move(named.packing), law, path, strain_step, choice.path.held);
  auto const first = scarp::balance(lab.packing(), law);
  examples::print(stdout, "{} grains, {:.0f} contacts, void ratio {:.8f}\n", lab.packing().grain_count(),
                  first.contacts, lab.packing().void_ratio());
  examples::print(stdout, "cell {:.12g},{:.12g},{:.12g},{:.12g} m\n", cell(0, 0), cell(1, 0), cell(0, 1), cell(1, 1));
  examples::print(
      stdout, "law: normal stiffness {} N/m, tangential {} N/m, friction {}; thickness {} m, density {} kg/m3\n",
      law.normal_stiffness, law.tangential_stiffness, law.friction, choice.sand.thickness, choice.sand.density);
  examples::print(stdout, "stress [Pa]: xx {:.6f}, xy {:.6f}, yx {:.6f}, yy {:.6f}\n", first.stress(0, 0),
                  first.stress(0, 1), first.stress(1, 0), first.stress(1, 1));
  if (first.contacts == 0.0) {
    examples::print(
        stderr,
        "warning: no grains of '{}' touch, so that the stress is zero until the path brings them together: check units "
        "and cell, or compress it first\n",
        choice.particles);
  }
  auto const fabric = scarp::contact_network(lab.packing(), law).fabric;
  examples::print(stdout, "fabric of the contacts: xx {:.10f}, xy {:.10f}, yy {:.10f}\n", fabric(0, 0), fabric(0, 1),
                  fabric(1, 1));
  scarp::CsvLog log(choice.out, {"step", "strain", "Fxx", "Fxy", "Fyx", "Fyy", "sxx", "sxy", "syx", "syy", "void_ratio",
                                 "n_contacts", "max_overlap_over_rmin"});
  auto const write = [&](long step) { log.add(std::span<double const>(replay_row(lab, path, step))); };
  write(0);
  long const steps_per_row = steps_of(choice.path.row_strain.value_or(path.row_strain), strain_step);
  for (long step = 1; step <= steps; ++step) {
    auto const verdict = lab.step();
    if (!verdict.acceptable()) end_early(verdict, path.strain(lab.deformation()), choice.out);
    if (step % steps_per_row == 0 || step == steps) write(step);
  }
  if (path.held != nullptr) require_held(lab, path);
  examples::print(stdout, "{} to strain {:.6g} in {} steps of {}: {}\n", path.name, path.strain(lab.deformation()),
                  steps, strain_step, choice.out);
}

}  // namespace

void replay(Replay choice, CLI::App const& app) {
  require_used(app, choice.path);
  if (choice.contacts.empty()) examples::reject_unused(app, "tolerance", "without --contacts");
  examples::reject_overwriting(choice.out, {choice.particles, choice.contacts});
  auto const input = examples::read_packing_input(choice.particles, choice.contacts, choice.cell);
  if (input.contacts) take_law_from(*input.contacts, examples::given_in(app), choice.sand);
  choice.sand.shape = examples::shape_of(input.particles);
  if (!examples::given_in(app)("thickness"))
    examples::print_notes(
        {fmt::format("--thickness is not given: {} m is taken (stresses are per thickness); give that of the packing",
                     choice.sand.thickness)});
  examples::with_packing(examples::Built<Discs, Ellipses, Superellipses>{}, choice.sand,
                         [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
                           run_replay<PackingType>(choice, input.particles, input.contacts, input.cell, law);
                         });
}

void declare_replay(CLI::App& app, Replay& replay) {
  app.add_option("--particles", replay.particles,
                 "CSV: id, x, y and r, or a, b, angle (and eps); discs also as text of Yade, data or dump of LAMMPS, "
                 "restart of "
                 "MercuryDPM")
      ->required();
  app.add_option(
      "--contacts", replay.contacts,
      "CSV: id1, id2, cell_i, cell_j; ftx, fty give shear forces, kn, ks, tan_phi the law, branches the cell");
  app.add_option("--cell", replay.cell,
                 "a1x,a1y,a2x,a2y: base vectors [m]; otherwise from the contacts, or the particles' file");
  declare_path(app, replay.path);
  app.get_option("--path")->required();
  app.get_option("--strain")->required();
  app.add_option("--row-strain", replay.path.row_strain,
                 "between rows; 5e-5 for isotropic and 1e-4 else when not given")
      ->check(positive(2.0))
      ->group("Path");
  app.add_option("--normal-stiffness", replay.sand.normal_stiffness, "instead of kn [N/m]")->check(positive(1e15));
  app.add_option("--tangential-stiffness", replay.sand.tangential_stiffness, "instead of ks [N/m]")
      ->check(examples::number_from(0.0, true, 1e15));
  app.add_option("--friction", replay.sand.friction, "instead of tan_phi")
      ->check(examples::number_from(0.0, true, 1e3));
  app.add_option("--density", replay.sand.density, "of the grains [kg/m3]")->check(positive(1e9));
  app.add_option("--thickness", replay.sand.thickness, "out of plane [m]")->check(positive(1e3));
  app.add_option("--relax", replay.relaxation,
                 "isotropic pressure under which the packing comes to rest before the path [Pa], no shear strain: for "
                 "files without shear forces")
      ->check(positive(1e12));
  app.add_option("--tolerance", replay.tolerance, "of the overlaps in --contacts, over the smallest radius")
      ->check(positive(1.0));
  app.add_option("--out", replay.out, "table to write")->required();
}

}  // namespace rve_lab
