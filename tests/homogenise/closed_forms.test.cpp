// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "../../benchmarks/shared/condensed_tangent.hpp"
#include "../../examples/rve_lab/non_affine.hpp"
#include "../../examples/shared/sliding_contacts.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "scarp/shape/sphere.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using samples::Discs;
using samples::relative_error;
using scarp::LinearFrictional;
using scarp::Tensor;
using scarp::Vector;
using Spheres = scarp::Packing<scarp::Sphere, LinearFrictional>;

constexpr double radius = 5e-3;
constexpr double sphere_pressure = 1e5;
constexpr LinearFrictional sphere_law{.normal_stiffness = 2e6, .tangential_stiffness = 8e5, .friction = 0.4};

/// Equal spheres under isotropic pressure; made once.
Spheres const& equal_spheres() {
  static Spheres const packing = [] {
    scarp::Cloud<scarp::SphereGrading> const cloud{
        .grading = {.smallest = radius, .largest = radius}, .grains = 150, .density = 2650.0, .seed = 3};
    auto prepared = scarp::IsotropicPreparation{.pressure = sphere_pressure}.prepare(cloud.make<Spheres>(), sphere_law);
    REQUIRE(prepared.verdict.acceptable());
    return std::move(prepared.packing);
  }();
  return packing;
}

Discs const& discs() {
  auto const& prepared = samples::consolidated<Discs>(80);
  REQUIRE(prepared.verdict.acceptable());
  return prepared.packing;
}

template <class PackingType>
PackingType const& origin_of() {
  if constexpr (PackingType::dim == 2) {
    return discs();
  } else {
    return equal_spheres();
  }
}
template <class PackingType>
LinearFrictional law_of() {
  return PackingType::dim == 2 ? samples::study_law() : sphere_law;
}
template <class PackingType>
double pressure_of() {
  return PackingType::dim == 2 ? samples::pressure : sphere_pressure;
}

template <class PackingType>
Vector<PackingType::dim> place_of(PackingType const& packing, std::size_t grain) {
  Vector<PackingType::dim> place;
  for (int a = 0; a < PackingType::dim; ++a) place(a) = packing.position(grain, a);
  return place;
}

/// Lengths, stiffnesses and densities of a world over those of ours.
struct Units {
  double length = 1.0;
  double stiffness = 1.0;
  double density = 1.0;

  double time() const { return std::sqrt(density * std::pow(length, 3) / stiffness); }  // sqrt(m / k)
  double stress() const { return stiffness / length; }
  LinearFrictional law(LinearFrictional const& here) const {
    return {here.normal_stiffness * stiffness, here.tangential_stiffness * stiffness, here.friction};
  }
};

/// The grains of a packing at rest, without shear forces, in other units; and `copies` of the cell along each of its
/// first two base vectors, grain i of copy k as number i + k N.
template <class PackingType>
PackingType redrawn(PackingType const& packing, Units const& units, int copies = 1) {
  auto const& population = *packing.population;
  std::size_t const grains = packing.grain_count();
  std::vector<std::array<double, 1>> sizes(grains * static_cast<std::size_t>(copies * copies));
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = {population.size(i % grains)[0] * units.length};
  double const thickness = PackingType::dim == 2 ? population.thickness() * units.length : 1.0;
  PackingType drawn;
  drawn.population = std::make_shared<scarp::Population<typename PackingType::Shape> const>(
      sizes, population.density() * units.density, thickness);
  drawn.cell = packing.cell * units.length;
  for (int k = 0; k < 2; ++k) drawn.cell.col(k) *= copies;
  drawn.position.resize(sizes.size());
  drawn.orientation.resize(sizes.size());
  drawn.rest();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    auto const copy = static_cast<int>(i / grains);
    Vector<PackingType::dim> const shift = copy % copies * packing.cell.col(0) + copy / copies * packing.cell.col(1);
    Vector<PackingType::dim> const place = (place_of(packing, i % grains) + shift) * units.length;
    for (int a = 0; a < PackingType::dim; ++a) drawn.position(i, a) = place(a);
  }
  return drawn;
}

/// Axial over lateral pressure in each step of drained compression.
template <class PackingType>
std::vector<double> path(PackingType packing, LinearFrictional const& law, double pressure, double rate, int steps) {
  constexpr int dim = PackingType::dim;
  scarp::TimeStepper<PackingType> stepper;
  scarp::CellDriver<PackingType> drive(packing, law, scarp::drained_compression<dim>(rate, pressure));
  std::vector<double> ratios;
  for (int step = 0; step < steps; ++step) {
    REQUIRE(drive.step(stepper).acceptable());
    ratios.push_back(-drive.seen().stress(dim - 1, dim - 1) / pressure);
  }
  return ratios;
}

/// The path of a packing in other units. All grains move at the start: local damping asks for the sign of each velocity
/// and spin, and where that is zero but for round-off, a path would hang on round-off from its first step.
template <class PackingType>
std::vector<double> path_in(Units const& units, PackingType const& origin, LinearFrictional const& law, double pressure,
                            int steps) {
  PackingType packing = redrawn(origin, units);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    for (int a = 0; a < PackingType::dim; ++a)
      packing.velocity(i, a) = 1e-3 * spread(random) * units.length / units.time();
    for (int a = 0; a < scarp::spin_size<PackingType::dim>; ++a)
      packing.spin(i, a) = 0.1 * spread(random) / units.time();
  }
  return path(std::move(packing), units.law(law), pressure * units.stress(), 1e-5, steps);
}

double largest_gap(std::vector<double> const& path, std::vector<double> const& other) {
  double largest = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) largest = std::max(largest, relative_error(path[i], other[i]));
  return largest;
}

struct Isotropic {
  double bulk, shear;

  /// Isotropic part of a modulus: C_iijj = 9 K, C_ijij = 3 K + 10 G.
  explicit Isotropic(scarp::VoigtTangent<3> const& tangent)
      : bulk(tangent.topLeftCorner<3, 3>().sum() / 9.0),
        shear((tangent.diagonal().head<3>().sum() + 2.0 * tangent.diagonal().tail<3>().sum() - 3.0 * bulk) / 10.0) {}
};

}  // namespace

TEST_CASE("equal spheres under uniform strain have Voigt's moduli, and relaxed ones are softer") {
  auto const& packing = equal_spheres();
  double const contacts = scarp::contact_network(packing, sphere_law).coordination.all;
  double const filled = packing.population->content() / packing.volume();
  double const kn = sphere_law.normal_stiffness, kt = sphere_law.tangential_stiffness;
  // Analytic: K = Z phi k_n / 6 pi R, G = Z phi (2 k_n + 3 k_t) / 20 pi R. Every contact has the same isotropic part
  // whatever its direction, so for the isotropic part of the tangent these are exact but for the overlap u in the
  // branch 2 R - u: (1 - u / 2R)^2 at the deepest.
  double const bulk = contacts * filled * kn / (6.0 * std::numbers::pi * radius);
  double const shear = contacts * filled * (2.0 * kn + 3.0 * kt) / (20.0 * std::numbers::pi * radius);
  double const deepest = scarp::balance(packing, sphere_law).deepest_overlap / 4.0;  // over half the radius: over 2 R
  REQUIRE(deepest < 0.01);
  Isotropic const affine(scarp::to_voigt_tangent<3>(scarp::contact_tangent(packing, sphere_law)));
  CHECK(affine.bulk < bulk);
  CHECK(affine.bulk > bulk * (1.0 - 2.0 * deepest));
  CHECK(affine.shear < shear);
  CHECK(affine.shear > shear * (1.0 - 2.0 * deepest));
  // Analytic: bounds. 0.85 and 0.62 of them here; a relaxation that did nothing would be seen.
  Isotropic const relaxed(benchmarks::CondensedTangent{.initial_stress = false}(packing, sphere_law));
  CHECK(relaxed.bulk < 0.99 * affine.bulk);
  CHECK(relaxed.shear < 0.9 * affine.shear);
  CHECK(relaxed.bulk > 0.0);
  CHECK(relaxed.shear > 0.0);
}

TEST_CASE("the stress of spheres at rest is symmetric within their unbalanced ratio") {
  auto const state = scarp::balance(equal_spheres(), sphere_law);
  // Analytic: the skew part is the sum of the net torques, which vanish with the net forces.
  double const pressure = -state.stress.trace() / 3.0;
  CHECK((state.stress - state.stress.transpose()).cwiseAbs().maxCoeff() < state.unbalanced_ratio * pressure);
  CHECK(state.unbalanced_ratio < 1e-3);
}

TEST_CASE("the work of the contacts is that of the stress, Hill and Mandel's condition") {
  auto const law = samples::study_law();
  Discs const start = discs();
  Discs moved = start;
  scarp::TimeStepper<Discs> stepper;
  scarp::StepObservation<2> seen;  // not looked at; CellDriver needs the same step
  Tensor<2> strain;
  strain << 3e-6, 1e-6, 1e-6, -1e-5;
  Tensor<2> deformation = Tensor<2>::Identity();
  std::vector<double> turn(start.grain_count(), 0.0);
  for (int step = 0; step < 100; ++step) {
    REQUIRE(stepper.step<scarp::Observe::balance>(moved, law, strain, &seen).acceptable());
    double const time_step = stepper.time_step_share * moved.pairs.critical_step;
    for (std::size_t i = 0; i < turn.size(); ++i) turn[i] += moved.spin(i, 0) * time_step;
    deformation += strain * deformation;
  }
  auto const motion = rve_lab::non_affine_motion(start, moved, deformation);
  Tensor<2> const gradient = deformation - Tensor<2>::Identity();
  REQUIRE(rve_lab::root_mean_square(motion) > 0.1 * gradient.norm() * samples::grading<Discs>().smallest);

  double affine_work = 0.0, work = 0.0;
  scarp::for_each_contact(start, law, [&](scarp::Contact<2> const& contact) {
    auto const swing = [&](std::size_t grain, scarp::Point<2, double> const& arm) {
      auto const there = scarp::turned_motion(turn[grain], arm);
      return Vector<2>(there[0], there[1]);
    };
    Vector<2> const strained = gradient * contact.branch;
    Vector<2> const beyond = motion[contact.second] + swing(contact.second, contact.touch.arm_second) -
                             motion[contact.first] - swing(contact.first, contact.touch.arm_first);
    affine_work += contact.force.dot(strained);
    work += contact.force.dot(strained + beyond);
  });
  auto const state = scarp::balance(start, law);
  double const work_of_stress = -start.volume() * state.stress.cwiseProduct(gradient).sum();
  double const scale = start.volume() * state.stress.norm() * gradient.norm();
  // Analytic: exact for the motion of uniform strain; the actual one adds net forces and torques times its
  // fluctuations, which are of the size of strain x diameter.
  CHECK(std::abs(affine_work - work_of_stress) < 1e-13 * scale);
  CHECK(std::abs(work - work_of_stress) < state.unbalanced_ratio * scale);
  CHECK(state.unbalanced_ratio < 2e-4);
}

TEST_CASE_TEMPLATE("lengths, stiffnesses and densities in other units give the same path", PackingType, Discs,
                   Spheres) {
  auto const& origin = origin_of<PackingType>();
  auto const law = law_of<PackingType>();
  auto const base = path_in({}, origin, law, pressure_of<PackingType>(), 500);
  // Exact: with powers of two that make a power of two of the unit of time too, every number is the same but for its
  // exponent.
  for (Units const units : {Units{0x1p-20, 0x1p20, 0x1p20}, Units{0x1p20, 0x1p-20, 0x1p-20}, Units{0x1p20, 0x1p20, 1.0},
                            Units{0x1p-10, 0x1p-10, 1.0}})
    CHECK(path_in(units, origin, law, pressure_of<PackingType>(), 500) == base);
  // Round-off, 1e-12 over overlaps, grows to 1e-11 (discs) and 1e-10 (spheres) within these steps and is of the size of
  // the path after some 600 steps of spheres.
  std::vector<double> const begun(base.begin(), base.begin() + 150);
  for (Units const units :
       {Units{1e-6, 1e6, 1e6}, Units{1e6, 1e-6, 1.0}, Units{1e-6, 1e-6, 1.0}, Units{1e6, 1e6, 1e-6}})
    CHECK(largest_gap(path_in(units, origin, law, pressure_of<PackingType>(), 150), begun) < 1e-9);
}

TEST_CASE("in the smallest unit of force spheres still have the same path") {
  // Exact as above: no floor of a divisor may be felt, here at forces of 1e-12 of ours.
  auto const base = path_in({}, equal_spheres(), sphere_law, sphere_pressure, 500);
  CHECK(path_in({0x1p-20, 0x1p-20, 1.0}, equal_spheres(), sphere_law, sphere_pressure, 500) == base);
}

TEST_CASE("an eighth of the strain step leaves less than half of what inertia does to a path") {
  constexpr double strain = 1e-3;
  // Mean error of the axial stress up to that strain, added up over some packings since one alone is a matter of
  // chance.
  auto const mean_of = [](std::uint64_t seed, double rate) {
    auto const& prepared = samples::consolidated<Discs>(80, seed);
    REQUIRE(prepared.verdict.acceptable());
    auto const ratios = path(prepared.packing, samples::study_law(), samples::pressure, rate,
                             static_cast<int>(std::lround(strain / rate)));
    double sum = 0.0;
    for (double const ratio : ratios) sum += ratio;
    return sum / static_cast<double>(ratios.size());
  };
  std::map<double, double> error;
  for (std::uint64_t const seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    double const slow = mean_of(seed, 1e-6);
    for (double const rate : {4e-5, 2e-5, 1e-5, 5e-6}) error[rate] += std::abs(mean_of(seed, rate) - slow) / 6.0;
  }
  MESSAGE("errors " << error[4e-5] << ", " << error[2e-5] << ", " << error[1e-5] << ", " << error[5e-6]);
  // Inertia and the lag of the held stress are of first order in the rate: an eighth. Which contacts slide first is a
  // matter of chance and hides the order in so few grains, so a half is asked.
  CHECK(error[5e-6] < 0.5 * error[4e-5]);
  CHECK(error[1e-5] < 1e-3);  // of the lateral pressure, at the rate that other tests use
}

TEST_CASE("a doubled cell has the same stress and the same tangents") {
  auto const law = samples::study_law();
  Discs one = discs();
  scarp::TimeStepper<Discs> stepper;
  scarp::StepObservation<2> seen;  // not looked at; CellDriver needs the same step
  Tensor<2> strain;
  strain << 1e-5, 1e-5, 0.0, -1e-5;
  for (int step = 0; step < 300; ++step)
    REQUIRE(stepper.step<scarp::Observe::balance>(one, law, strain, &seen).acceptable());
  one.rest();
  std::size_t const grains = one.grain_count();
  Discs four = redrawn(one, {}, 2);
  REQUIRE(stepper.refresh(four, law).acceptable());

  auto const branch = [](Discs const& packing, std::size_t pair) {
    auto const from = scarp::row_position(packing, static_cast<std::size_t>(packing.pairs.first[pair]));
    auto const to = scarp::row_position(packing, static_cast<std::size_t>(packing.pairs.second[pair]));
    return Vector<2>(to[0] - from[0], to[1] - from[1]);
  };
  auto const owners = [grains](Discs const& packing, std::size_t pair) {
    return std::pair{static_cast<std::size_t>(packing.pairs.first[pair]) % grains,
                     scarp::grain_of_row(packing, static_cast<std::size_t>(packing.pairs.second[pair])) % grains};
  };
  for (std::size_t p = 0; p < four.pairs.count(); ++p) {
    auto const [first, second] = owners(four, p);
    for (std::size_t q = 0; q < one.pairs.count(); ++q) {
      auto const [a, b] = owners(one, q);
      bool const same = a == first && b == second && (branch(one, q) - branch(four, p)).norm() < 1e-9;
      bool const swapped = a == second && b == first && (branch(one, q) + branch(four, p)).norm() < 1e-9;
      if (same || swapped) four.pairs.shear(p, 0) = one.pairs.shear(q, 0);  // in the plane the number keeps its sign
    }
  }
  auto const state = scarp::balance(one, law);
  auto const there = scarp::balance(four, law);
  REQUIRE(std::abs(state.stress(0, 1)) > 0.01 * state.stress.norm());
  CHECK(there.contacts == 4 * state.contacts);
  // Exact: sums over the same contacts. Round-off, 1e-15 of places over overlaps and forces that average out.
  CHECK((there.stress - state.stress).norm() < 1e-12 * state.stress.norm());
  CHECK(examples::sliding_share(four, law) == samples::Approx(examples::sliding_share(one, law)));
  auto const affine = scarp::contact_tangent(one, law);
  CHECK((scarp::contact_tangent(four, law) - affine).norm() < 1e-12 * affine.norm());
  auto const relaxed = benchmarks::CondensedTangent{}(one, law);
  CHECK((benchmarks::CondensedTangent{}(four, law) - relaxed).norm() < 1e-12 * relaxed.norm());
}
