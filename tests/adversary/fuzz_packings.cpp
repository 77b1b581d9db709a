// SPDX-License-Identifier: BSL-1.0
// Random packings, laws and strain paths against what every packing obeys: momentum, the energy ledger, turned,
// mirrored and renumbered copies. fuzz_packings --seed S [--inputs N | --seconds T] [--only PAIR] [--first K];
// docs/notes/testing.md
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

#include "../../examples/shared/energy_ledger.hpp"
#include "adversary/contest.hpp"
#include "contact/every_law.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/shape/clump.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/shape/superellipse.hpp"

namespace {

using adversary::demand;
using adversary::Game;
using adversary::Outcome;
using scarp::Random;
using scarp::Tensor;
using scarp::Vector;

/// All that is drawn for one input, without types, so that it is compiled once for each dimension.
template <int Dim>
struct Draw {
  Tensor<Dim> cell;
  std::vector<Vector<Dim>> position;
  std::vector<Vector<Dim>> velocity;
  std::vector<Vector<3>> spin;
  std::vector<Vector<2>> axis;
  std::vector<std::array<double, 3>> size;  ///< bounding radius, aspect, exponent
  std::vector<Tensor<Dim>> path;            ///< displacement gradient of each step

  std::size_t grains() const { return position.size(); }
};

std::size_t whole(Random& random, std::size_t least, std::size_t most) {
  return least + random.next() % (most - least + 1);
}

template <int Dim>
Draw<Dim> draw(Random& random) {
  Draw<Dim> drawn;
  std::size_t const side = Dim == 2 ? whole(random, 3, 6) : whole(random, 3, 4);
  double const spread = random.uniform(1.0, 1.6);  // largest size over smallest
  double const slender = random.uniform() < 0.3 ? random.uniform(0.12, 0.5) : random.uniform(0.5, 1.0);
  double const spacing = random.uniform(1.5, 2.0) * std::sqrt(std::max(slender, 0.4));
  double const speed = random.uniform() < 0.3 ? 0.0 : std::pow(10.0, random.uniform(-4.0, -1.0));
  auto const within = [&](double size) { return random.uniform(-size, size); };
  drawn.cell = static_cast<double>(side) * spacing * Tensor<Dim>::Identity();
  drawn.cell(0, 1) = within(0.3) * drawn.cell(0, 0);
  drawn.cell(Dim - 1, 0) = within(0.2) * drawn.cell(0, 0);
  std::size_t count = 1;
  for (int a = 0; a < Dim; ++a) count *= side;
  for (std::size_t i = 0; i < count; ++i) {
    Vector<Dim> place, velocity;
    std::size_t rest = i;
    for (int a = 0; a < Dim; ++a, rest /= side)
      place(a) = (static_cast<double>(rest % side) + within(0.1)) / static_cast<double>(side);
    for (int a = 0; a < Dim; ++a) velocity(a) = within(speed);
    Vector<3> spin = Vector<3>::Zero();
    for (int k = Dim == 2 ? 2 : 0; k < 3; ++k) spin(k) = within(speed);
    double const angle = within(std::numbers::pi);
    drawn.position.push_back(drawn.cell * place);
    drawn.velocity.push_back(velocity);
    drawn.spin.push_back(spin);
    drawn.axis.emplace_back(std::cos(angle), std::sin(angle));
    drawn.size.push_back(
        {std::pow(spread, random.uniform(-1.0, 0.0)), slender * random.uniform(0.9, 1.0), random.uniform(0.6, 1.3)});
  }
  Tensor<Dim> strain = Tensor<Dim>::Zero();
  double const rate = std::pow(10.0, random.uniform(-5.0, -3.5));
  std::size_t const turns = whole(random, 1, 6);
  for (int step = 0; step < 24; ++step) {
    if (step % static_cast<int>(turns) == 0) {
      for (int k = 0; k < Dim * Dim; ++k) strain(k) = within(rate);
    }
    drawn.path.push_back(strain);
  }
  return drawn;
}

/// The same in other coordinates; where change mirrors, spins, which are axial, run the other way.
template <int Dim>
Draw<Dim> seen_from(Draw<Dim> drawn, Tensor<Dim> const& change) {
  double const sense = change.determinant();
  drawn.cell = (change * drawn.cell).eval();
  if (sense < 0.0) drawn.cell.col(0) = (-drawn.cell.col(0)).eval();  // the same lattice, right-handed again
  for (auto& place : drawn.position) place = (change * place).eval();
  for (auto& velocity : drawn.velocity) velocity = (change * velocity).eval();
  if constexpr (Dim == 2) {
    for (auto& axis : drawn.axis) axis = (change * axis).eval();
    for (auto& spin : drawn.spin) spin *= sense;
  } else {
    for (auto& spin : drawn.spin) spin = (sense * (change * spin)).eval();
  }
  for (auto& strain : drawn.path) strain = (change * strain * change.transpose()).eval();
  return drawn;
}

/// The grains in another order, each moved by some lattice vector.
template <int Dim>
Draw<Dim> renumbered(Draw<Dim> const& drawn, std::vector<std::size_t> const& order, Random& random) {
  Draw<Dim> other = drawn;
  for (std::size_t i = 0; i < order.size(); ++i) {
    Vector<Dim> cells;
    for (int a = 0; a < Dim; ++a) cells(a) = static_cast<double>(whole(random, 0, 4)) - 2.0;
    other.position[i] = drawn.position[order[i]] + drawn.cell * cells;
    other.velocity[i] = drawn.velocity[order[i]];
    other.spin[i] = drawn.spin[order[i]];
    other.axis[i] = drawn.axis[order[i]];
    other.size[i] = drawn.size[order[i]];
  }
  return other;
}

template <int Dim>
Tensor<Dim> random_turn(Random& random) {
  double const angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  if constexpr (Dim == 2) {
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  } else {
    Vector<3> const axis(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(0.1, 1.0));
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  }
}

/// What a run says after a short and after the whole path; `finer` steps in the place of one, each of a share of its
/// time.
template <int Dim>
struct Told {
  scarp::Verdict verdict{};
  std::vector<Vector<Dim>> velocity{};  ///< after the short path
  Tensor<Dim> stress = Tensor<Dim>::Zero();
  double largest_force = 0.0;
  double out_of_balance = 0.0;  ///< largest sum of all forces
  examples::EnergyLedger<Dim> ledger{};
  double energy = 0.0;  ///< largest of what was stored, moving and put in
};
constexpr int short_path = 8;

/// A law of stiffness 100 and random friction, wherever the law has these.
template <class Law>
void draw_friction(Law& law, Random& random) {
  if constexpr (requires { law.friction = 0.5; }) law.friction = random.uniform(0.0, 1.0);
  if constexpr (requires { law.rolling_friction = 0.5; }) law.rolling_friction = random.uniform(0.0, 0.4);
  if constexpr (requires { law.tensile_strength = 1.0; }) law.tensile_strength = random.uniform(0.0, 8.0);
  if constexpr (requires { law.law; }) draw_friction(law.law, random);
}

template <class P>
P packing_of(Draw<P::dim> const& drawn) {
  using Shape = typename P::Shape;
  std::vector<typename scarp::Population<Shape>::Size> sizes;
  for (auto const& [radius, aspect, exponent] : drawn.size) {
    if constexpr (Shape::size_count == 1)
      sizes.push_back({radius / Shape::bounding_radius({1.0})});
    else if constexpr (Shape::size_count == 2)
      sizes.push_back({radius, radius * aspect});
    else
      sizes.push_back({radius, radius * std::max(aspect, 0.3), exponent});
  }
  P packing;
  packing.population = std::make_shared<scarp::Population<Shape> const>(sizes, 1.0, 1.0);
  packing.cell = drawn.cell;
  packing.position.resize(drawn.grains());
  packing.orientation.resize(drawn.grains());
  packing.rest();
  constexpr int spins = scarp::spin_size<P::dim>;
  for (std::size_t i = 0; i < drawn.grains(); ++i) {
    for (int a = 0; a < P::dim; ++a) {
      packing.position(i, a) = drawn.position[i](a);
      packing.velocity(i, a) = drawn.velocity[i](a);
    }
    for (int k = 0; k < spins; ++k) packing.spin(i, k) = drawn.spin[i](3 - spins + k);
    if constexpr (Shape::orientation_count == 2) packing.orientation.set_row(i, {drawn.axis[i](0), drawn.axis[i](1)});
  }
  return packing;
}

template <class P>
Told<P::dim> told_by(Draw<P::dim> const& drawn, typename P::Law const& law, int finer = 1) {
  constexpr int dim = P::dim;
  P packing = packing_of<P>(drawn);
  scarp::TimeStepper<P> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  stepper.time_step_share /= finer;
  Told<dim> told;
  double work = 0.0;
  int steps = 0;
  for (std::size_t step = 0; step < drawn.path.size() * static_cast<std::size_t>(finer); ++step) {
    Tensor<dim> const strain = drawn.path[step / static_cast<std::size_t>(finer)] / finer;
    double const volume = packing.volume();
    auto const before = packing.velocity;
    scarp::StepObservation<dim> seen{};
    told.verdict = stepper.template step<scarp::Observe::energy>(packing, law, strain, &seen);
    if (!told.verdict.acceptable()) return told;
    told.ledger.enter(seen, volume, strain);
    work += std::abs(volume * seen.stress.cwiseProduct(strain).sum());
    told.energy = std::max(
        told.energy, work + std::abs(seen.stored_energy) + seen.kinetic_energy + std::abs(told.ledger.contact_loss));
    double const time_step = packing.last_move.duration;
    Vector<dim> sum = Vector<dim>::Zero();
    for (std::size_t i = 0; i < drawn.grains(); ++i) {
      Vector<dim> change;
      for (int a = 0; a < dim; ++a) change(a) = packing.velocity(i, a) - before(i, a);
      double const scale = 1.0 / packing.population->inverse_mass()[i] / time_step;
      sum += scale * change;
      double fastest = 0.0;
      for (int a = 0; a < dim; ++a) fastest = std::max(fastest, std::abs(before(i, a)));
      told.largest_force = std::max({told.largest_force, scale * change.norm(), scale * fastest});
    }
    told.out_of_balance = std::max(told.out_of_balance, sum.norm());
    if (++steps == short_path) {
      told.stress = seen.stress;
      for (std::size_t i = 0; i < drawn.grains(); ++i) told.velocity.emplace_back(packing.velocity.row(i).data());
    }
  }
  return told;
}

/// Round-off of 1e-16 in places of some ten units over overlaps of some tenths, which grows along the path; in space
/// the critical step brings in an eigenvalue that is good to 1e-8. What is wrong makes a difference of order one.
template <int Dim>
inline constexpr double round_off = Dim == 2 ? 1e-9 : 1e-6;

template <int Dim>
void check_same(std::string_view what, Told<Dim> const& told, Told<Dim> const& other, Tensor<Dim> const& change,
                std::vector<std::size_t> const& order) {
  demand(other.verdict == told.verdict,
         fmt::format("{}: another verdict, {} for {}", what, name(other.verdict.reason), name(told.verdict.reason)));
  double largest = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < other.velocity.size(); ++i) {
    largest = std::max(largest, other.velocity[i].norm());
    worst = std::max(worst, (change * told.velocity[order[i]] - other.velocity[i]).norm());
  }
  demand(worst <= round_off<Dim> * largest, fmt::format("{}: velocities differ by {} of {}", what, worst, largest));
  double const stress = (change * told.stress * change.transpose() - other.stress).norm();
  // Grains that only just touch carry less than the round-off of the forces before.
  demand(stress <= round_off<Dim> * std::max(told.stress.norm(), told.largest_force),
         fmt::format("{}: stress differs by {} of {}", what, stress, told.stress.norm()));
}

template <class Shape, class Law>
Game pair(std::string name) {
  using P = scarp::Packing<Shape, Law>;
  constexpr int dim = P::dim;
  return {std::move(name), [](Random& random) {
            auto law = samples::Sample<Law>::law();
            draw_friction(law, random);
            auto const drawn = draw<dim>(random);
            std::vector<std::size_t> same(drawn.grains());
            std::iota(same.begin(), same.end(), std::size_t{0});
            auto order = same;
            for (std::size_t k = order.size() - 1; k > 0; --k) std::swap(order[k], order[whole(random, 0, k)]);
            auto const turn = random_turn<dim>(random);
            Tensor<dim> mirror = Tensor<dim>::Identity();
            mirror(0, 0) = -1.0;
            Tensor<dim> const itself = Tensor<dim>::Identity();

            auto const told = told_by<P>(drawn, law);
            check_same("again", told, told_by<P>(drawn, law), itself, same);
            check_same("turned", told, told_by<P>(seen_from(drawn, turn), law), turn, same);
            check_same("mirrored", told, told_by<P>(seen_from(drawn, mirror), law), mirror, same);
            check_same("renumbered", told, told_by<P>(renumbered(drawn, order, random), law), itself, order);
            if (!told.verdict.acceptable()) return Outcome::refused;
            demand(std::isfinite(told.largest_force) && told.stress.allFinite(), "a number that is not finite");
            demand(told.out_of_balance <= 1e-11 * told.largest_force,
                   fmt::format("forces add up to {} of {}", told.out_of_balance, told.largest_force));
            // What is missing falls with the step: where grains cross a good part of an overlap in one, an eighth is
            // not enough.
            auto finer = told_by<P>(drawn, law, 8);
            if (std::abs(finer.ledger.gap()) > 0.02 * finer.energy) finer = told_by<P>(drawn, law, 64);
            demand(std::abs(finer.ledger.gap()) <= 0.02 * finer.energy,
                   fmt::format("energy: {} of {} is missing", finer.ledger.gap(), finer.energy));
            return Outcome::accepted;
          }};
}

}  // namespace

int main(int count, char** words) {
  using namespace scarp;
  return adversary::contest(
      count, words,
      {pair<Disc, LinearFrictional>("discs, linear"), pair<Ellipse, LinearFrictional>("ellipses, linear"),
       pair<Superellipse, RollingResistance<LinearFrictional>>("superellipses, rolling"),
       pair<Dumbbell, HertzMindlin<HertzRestitution>>("clumps, hertz with dashpots"),
       pair<Disc, RollingResistance<CohesiveBond<LinearFrictional>>>("discs, bonds and rolling"),
       pair<Sphere, HertzMindlin<>>("spheres, hertz"), pair<Sphere, CohesiveBond<LinearFrictional>>("spheres, bonds")});
}
