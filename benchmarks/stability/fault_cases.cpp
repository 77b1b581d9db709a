// SPDX-License-Identifier: BSL-1.0
// Ground over a fault: hardly any confinement or gravity, a hundred times the gravity, other units, every dip and
// throw, and a kink that is not on a node.
#include "stability/fault_ground.hpp"

#include <fmt/format.h>

#include "stability/groups.hpp"
#include "stability/measures.hpp"

namespace stability {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double gamma_soil = 15.68e3;  // [N/m3]

std::string effort(FaultAnswer const& found) {
  return fmt::format("{} at throw/depth {:.3g}, {} steps, {} refused, {} iterations", name(found.run.verdict.reason),
                     found.run.load / 25.0, found.run.steps, found.run.refused, found.run.iterations);
}

/// Reaches the throw in balance, without tension that the strength does not have.
Outcome reaches(FaultGround const& ground, double scale, double limit = 1e-9) {
  auto const found = answer(ground);
  Worst worst;
  worst.see(found.run.verdict.acceptable() && found.run.load == ground.throw_to
                ? 0.0
                : std::numeric_limits<double>::infinity());
  worst.see(found.imbalance);
  double const allowed = ground.soil.strength.strength.cut_off();
  worst.see(std::max(0.0, found.tension - allowed) / scale);
  // The residual's tolerance, over the weight instead of all reactions; the slack of the return.
  return at_most(limit, worst.value, "imbalance over weight, excess tension over overburden",
                 effort(found) + fmt::format(", largest tension {:.2g} Pa", found.tension));
}

Outcome surcharge(double pressure, double cohesion) {
  FaultGround ground;
  ground.loaded(gamma_soil, pressure);
  ground.soil.strength.strength.cohesion = cohesion;
  return reaches(ground, gamma_soil * ground.layer().depth);
}

Outcome gravity(double times) {
  FaultGround ground;
  ground.loaded(times * gamma_soil, 0.0);
  if (times >= 1.0) return reaches(ground, times * gamma_soil * ground.layer().depth);
  // Where cohesion is all that holds, ground tears at the surface, and what is torn off carries its weight by
  // nothing: 1e-8 of the forces at 1e-9 g, below which the run takes hundreds of tiny steps.
  ground.solver.tolerance = 1e-7;
  return reaches(ground, ground.soil.strength.strength.cohesion, 1e-6);
}

/// A model of 1/115 of the size at 115 g has the stresses and strains of the prototype.
Outcome centrifuge() {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  auto const prototype = answer(ground);
  auto const model = answer(ground.in_units(1.0 / 115.0, 1.0));
  return at_most(1e-9, difference(model, prototype), "difference of the surfaces", effort(model));
}

Outcome units(double length, double stress) {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  auto const reference = answer(ground);
  auto const other = answer(ground.in_units(length, stress));
  Worst worst;
  worst.see(difference(other, reference));
  worst.see(static_cast<double>(other.run.iterations - reference.run.iterations));
  return at_most(1e-9, worst.value, "difference of the surfaces and of iterations", effort(other));
}

Outcome dip(double degrees, double throw_over_depth, Size size) {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  ground.fault.dip = degrees * degree;
  if (size == Size::full) ground.layer().size = 2.5;
  ground.throw_to = throw_over_depth * ground.layer().depth;
  return reaches(ground, gamma_soil * ground.layer().depth);
}

Outcome tiny_throw() {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  ground.throw_to = 1e-9;
  auto const found = answer(ground);
  double most = 0.0;
  for (auto const& moved : found.surface) most = scarp::worse_of(most, moved.norm() * ground.layer().depth);
  // No node goes further than the hanging wall, the square root of 1 + 1/tan(60 degrees)^2 times the throw.
  double const beyond = std::max(0.0, most / (ground.throw_to * std::sqrt(4.0 / 3.0)) - 1.0);
  auto outcome = at_most(1e-6, beyond, "largest motion of the surface over that of the hanging wall, less 1",
                         effort(found) + fmt::format(", imbalance {:.1e}", found.imbalance));
  outcome.as_expected &= found.run.verdict.acceptable() && found.run.load == ground.throw_to && most > 0.5e-9;
  return outcome;
}

Outcome impossible_faults() {
  int missed = 0;
  auto const wants = [&](char const* words, auto const& change) {
    FaultGround ground;
    ground.loaded(gamma_soil, 4e3);
    change(ground);
    scarp::SerialExecutor serial;
    missed += refuses([&] { static_cast<void>(ground.problem(serial)); }, words) ? 0 : 1;
  };
  double const nan = std::nan("");
  wants("throw", [](auto& ground) { ground.throw_to = 0.0; });
  wants("throw", [&](auto& ground) { ground.throw_to = nan; });
  wants("dip", [](auto& ground) { ground.fault.dip = 0.0; });
  wants("was it given in degrees", [](auto& ground) { ground.fault.dip = 60.0; });
  wants("dip", [&](auto& ground) { ground.fault.dip = nan; });
  wants("put a node there", [](auto& ground) { ground.fault.tip = 1.0; });
  wants("put a node there", [&](auto& ground) { ground.fault.tip = nan; });
  wants("tip", [](auto& ground) { ground.fault.tip = ground.layer().tip = 1e3; });
  wants("unit weight", [&](auto& ground) { ground.unit_weight = nan; });
  wants("surcharge", [](auto& ground) { ground.surcharge = -1.0; });
  wants("size", [](auto& ground) { ground.layer().size = 0.0; });
  wants("depth", [&](auto& ground) { ground.layer().depth = nan; });
  wants("are not supported", [](auto& ground) { ground.layer().size = 1e-6; });
  wants("dilation", [](auto& ground) { ground.soil.strength.strength.dilation = 1.0; });
  return at_most(0.0, missed, "wrong scenes that were taken");
}

/// The scene's problem with the kink anywhere.
FaultAnswer with_kink_at(FaultGround const& ground, double tip) {
  scarp::SerialExecutor serial;
  auto fault = ground.fault;
  fault.tip = tip;
  FaultGround::Grid grid(ground.layer().generate());
  auto constraints = scarp::bedrock_constraints(grid.mesh(), fault, 0, scarp::TimeFunction::after(0.0));
  Eigen::VectorXd dead = body_force(grid, [&](int) { return scarp::Vector<2>(0.0, -ground.unit_weight); });
  dead += traction(grid, "surface", scarp::Vector<2>(0.0, -ground.surcharge));
  auto problem = scarp::make_problem(std::move(grid), ground.layer().depth,
                                     boost::hana::make_tuple(scarp::Region{"soil", ground.soil}), constraints,
                                     scarp::LoadHistory(dead), serial);
  return answer(ground, problem);
}

/// A kink between two nodes is a mean of kinks at these: its surface lies between theirs.
Outcome kink_between_nodes() {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  auto const place = [&](double tip) { return half_way(with_kink_at(ground, tip), 0.01) * ground.layer().depth; };
  double const cell = ground.layer().size;
  double const share = (place(0.4 * cell) - place(0.0)) / cell;
  // A tenth of a cell for ground that yields: the place need not move evenly.
  return at_most(0.1, std::abs(share - 0.4), "place of half the throw off the kink's, in cells",
                 fmt::format("{:.3f}", share));
}

/// Ground and fault together elsewhere along x.
Outcome moved_scene() {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  auto const reference = answer(ground);
  for (double* place : {&ground.layer().left, &ground.layer().right, &ground.layer().tip, &ground.layer().band_left,
                        &ground.layer().band_right, &ground.fault.tip}) {
    *place += 1234.5;
  }
  auto const moved = answer(ground);
  // Round-off of places of a kilometre over a throw of a quarter of a metre, some times over.
  return at_most(1e-9, difference(moved, reference), "difference of the surfaces", effort(moved));
}

/// Half of the throw at the surface, while the mesh's lines move past a kink that stays: on a node of the mesh, and
/// between two.
Outcome mesh_past_kink(Size size) {
  double const cell = size == Size::quick ? 2.5 : 1.25;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  std::string remark;
  for (double const shift : {0.0, 0.25, 0.5, 0.75}) {
    FaultGround ground;
    ground.loaded(gamma_soil, 4e3);
    ground.layer().size = cell;
    ground.layer().tip = -shift * cell;
    ground.throw_to = 0.05 * ground.layer().depth;
    auto const found = with_kink_at(ground, 0.0);
    if (!found.run.verdict.acceptable()) return {false, shift, "shift that was not solved", effort(found)};
    double const place = half_way(found, 0.05) * ground.layer().depth / cell;
    if (!std::isfinite(place)) return {false, shift, "shift without a place of half the throw", effort(found)};
    least = std::min(least, place);
    most = std::max(most, place);
    remark += fmt::format("{:.2f} ", place);
  }
  // The kink is felt where it is; a crossed cell is not the same at every shift.
  return at_most(0.35, most - least, "range of the half settlement's place over a cell", remark);
}

}  // namespace

Cases fault_cases() {
  Cases cases;
  auto const add = [&](std::string name, std::string expected, auto run) {
    cases.push_back({"ground over a fault", std::move(name), std::move(expected), std::move(run)});
  };
  std::string const arrives = "reaches the throw in balance, no tension beyond the strength";
  for (double const pressure : {0.0, 1e-6, 1e-3, 1.0}) {
    for (double const cohesion : {0.0, 1e3}) {
      add(fmt::format("surcharge {:g} Pa, cohesion {:g} Pa", pressure, cohesion), arrives,
          [=](Size) { return surcharge(pressure, cohesion); });
    }
  }
  for (double const times : {0.0, 1e-9, 1.0, 115.0})
    add(fmt::format("gravity {:g} g", times), arrives, [=](Size) { return gravity(times); });
  add("model 1/115 at 115 g", "as the prototype to 1e-9", [](Size) { return centrifuge(); });
  struct Units {
    double length;
    double stress;
  };
  for (Units const of : {Units{1e-12, 1.0}, Units{1e12, 1.0}, Units{1.0, 1e-12}, Units{1.0, 1e12}, Units{1e-12, 1e-12},
                         Units{1e12, 1e12}}) {
    add(fmt::format("lengths x {:g}, stresses x {:g}", of.length, of.stress), "as in metres and pascals to 1e-9",
        [=](Size) { return units(of.length, of.stress); });
  }
  for (double const degrees : {30.0, 45.0, 60.0, 90.0})
    add(fmt::format("dip {:g} degrees, throw 2 % of the depth", degrees), arrives,
        [=](Size size) { return dip(degrees, 0.02, size); });
  add("dip 60 degrees, throw 12 % of the depth", arrives, [](Size size) { return dip(60.0, 0.12, size); });
  add("throw 1e-9 m", "reached; nothing moves more than the hanging wall", [](Size) { return tiny_throw(); });
  add("throw 0, NaN, dip 0, degrees, tip apart from every node", "refused", [](Size) { return impossible_faults(); });
  add("tip between nodes", "felt where it is to a tenth of a cell", [](Size) { return kink_between_nodes(); });
  add("mesh lines moved past the tip", "place of half the throw within 0.35 cells", mesh_past_kink);
  add("everything 1234.5 m further", "the same surface to 1e-9", [](Size) { return moved_scene(); });
  return cases;
}

}  // namespace stability
