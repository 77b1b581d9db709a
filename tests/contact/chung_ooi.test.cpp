// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/tensor/tensor.hpp"
#include "support/approx.hpp"

// The eight impacts of Chung and Ooi 2011, Granular Matter 13, 643-656. Geometry, speeds and materials of tests 1 to 4
// are theirs; those of tests 5 to 8 are ours, since the closed forms hold for any.

namespace {

using samples::relative_error;
using scarp::ContactForce;
using scarp::ContactKinematics;
using scarp::ContactMemory;
using scarp::HertzMindlin;
using scarp::HertzRestitution;
using scarp::Vector;

constexpr double rigid = 1e40;  // modulus of a wall [Pa]

/// A sphere of reduced mass and radius that meets another one, or a wall, at a given speed.
struct Impact {
  double mass;
  double radius;
  double speed;
  double reduced_modulus;

  // Hertz 1882; Chung and Ooi 2011, Granular Matter 13, tests 1 to 4.
  double largest_overlap() const {
    return std::pow(15.0 * mass * speed * speed / (16.0 * reduced_modulus * std::sqrt(radius)), 0.4);
  }
  double largest_force() const {
    return 4.0 / 3.0 * reduced_modulus * std::sqrt(radius) * std::pow(largest_overlap(), 1.5);
  }
  double duration() const {
    double const factor = 4.0 * std::sqrt(std::numbers::pi) * std::tgamma(0.4) / (5.0 * std::tgamma(0.9));
    return factor * largest_overlap() / speed;
  }
};

struct Rebound {
  double largest_overlap = 0.0;
  double largest_force = 0.0;
  double duration = 0.0;
  double speed = 0.0;             // normal
  double tangential_speed = 0.0;  // of the centre
  double spin = 0.0;              // times radius
  double dissipated = 0.0;
};

/// Leap-frog from first touch until the overlap is gone; a solid sphere: inertia 2/5 m r^2. `surface_speed` is the spin
/// at first touch times radius.
template <class Law>
Rebound bounce(Law const& contact_law, Impact const& impact, double tangential_speed, int steps_per_contact,
               double surface_speed = 0.0) {
  double const step = impact.duration() / steps_per_contact;
  Rebound rebound{.tangential_speed = tangential_speed, .spin = surface_speed};
  ContactMemory<2, double> memory;
  double closing_speed = impact.speed;
  double overlap = 0.0;
  for (int n = 0; overlap >= 0.0; ++n) {
    double const before = overlap;
    overlap += closing_speed * step;
    double const slip = (rebound.tangential_speed + rebound.spin) * step;
    auto const force = contact_law.respond(ContactKinematics<2, double>{.overlap = overlap,
                                                                        .slip_increment = slip,
                                                                        .reduced_radius = impact.radius,
                                                                        .overlap_increment = closing_speed * step,
                                                                        .tangential_increment = slip,
                                                                        .reduced_mass = impact.mass,
                                                                        .time_step = step},
                                           memory);
    rebound.dissipated += force.dissipated;
    if (overlap <= 0.0) {
      rebound.duration = (n + before / (before - overlap)) * step;
      break;
    }
    closing_speed -= force.normal / impact.mass * step;
    rebound.tangential_speed += force.shear / impact.mass * step;
    rebound.spin += 2.5 * force.shear / impact.mass * step;
    rebound.largest_overlap = std::max(rebound.largest_overlap, overlap);
    rebound.largest_force = std::max(rebound.largest_force, force.normal);
  }
  rebound.speed = -closing_speed;
  return rebound;
}

double sphere_mass(double density, double radius) {
  return 4.0 / 3.0 * std::numbers::pi * density * std::pow(radius, 3);
}

/// Two spheres that are about to meet head-on along x, in a cell that is wide for them.
struct Collision {
  using Spheres = scarp::Packing<scarp::Sphere, HertzMindlin<HertzRestitution>>;

  std::array<double, 2> radius;
  Vector<3> closing;               // velocity of the first; the second moves the other way [m/s]
  std::array<Vector<3>, 2> spin;   // [rad/s]
  Vector<3> line{1.0, 0.0, 0.0};   // of centres
  Vector<3> drift{0.0, 0.0, 0.0};  // velocity of both [m/s]
  double density = 2699.0;

  double mass(int grain) const { return sphere_mass(density, radius[static_cast<std::size_t>(grain)]); }
  double inertia(int grain) const { return 0.4 * mass(grain) * std::pow(radius[static_cast<std::size_t>(grain)], 2); }
  double reduced_mass() const { return mass(0) * mass(1) / (mass(0) + mass(1)); }

  Spheres packing() const {
    Spheres made;
    made.population = std::make_shared<scarp::Population<scarp::Sphere> const>(
        std::vector<std::array<double, 1>>{{radius[0]}, {radius[1]}}, density, 1.0);
    made.cell = 20.0 * (radius[0] + radius[1]) * scarp::Tensor<3>::Identity();
    made.position.resize(2);
    made.orientation.resize(2);
    made.rest();
    Vector<3> const middle = made.cell.diagonal() / 2.0;
    for (int i = 0; i < 2; ++i) {
      auto const grain = static_cast<std::size_t>(i);
      double const side = i == 0 ? -1.0 : 1.0;
      Vector<3> const place = middle + side * (1.0 + 1e-9) * radius[grain] * line;
      Vector<3> const velocity = drift - side * closing;
      for (int a = 0; a < 3; ++a) {
        made.position(grain, a) = place(a);
        made.velocity(grain, a) = velocity(a);
        made.spin(grain, a) = spin[grain](a);
      }
    }
    return made;
  }
};

template <class Columns>
Vector<3> row(Columns const& columns, int grain) {
  auto const i = static_cast<std::size_t>(grain);
  return {columns(i, 0), columns(i, 1), columns(i, 2)};
}

/// Sums over both spheres, angular momentum about the origin. `*_scale` add up sizes instead.
struct Momenta {
  Vector<3> linear = Vector<3>::Zero();
  Vector<3> angular = Vector<3>::Zero();
  double linear_scale = 0.0;
  double angular_scale = 0.0;

  Momenta(Collision const& collision, Collision::Spheres const& packing) {
    for (int i = 0; i < 2; ++i) {
      Vector<3> const momentum = collision.mass(i) * row(packing.velocity, i);
      Vector<3> const orbital = row(packing.position, i).cross(momentum);
      Vector<3> const own = collision.inertia(i) * row(packing.spin, i);
      linear += momentum;
      angular += orbital + own;
      linear_scale += momentum.norm();
      angular_scale += orbital.norm() + own.norm();
    }
  }
};

struct Course {
  Collision::Spheres packing;
  double lost_momentum = 0.0;          // largest over the course, relative
  double lost_angular_momentum = 0.0;  // largest over the course, relative
  int touching = 0;                    // steps
};

/// Until the spheres are apart again.
Course collide(Collision const& collision, HertzMindlin<HertzRestitution> const& contact_law) {
  Course course{.packing = collision.packing()};
  auto& packing = course.packing;
  scarp::TimeStepper<Collision::Spheres> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  stepper.skin_ratio = 0.01;
  stepper.time_step_share = 0.01;
  Momenta const start(collision, packing);
  for (int step = 0; step < 100'000; ++step) {
    REQUIRE(stepper.step(packing, contact_law, scarp::Tensor<3>::Zero()).acceptable());
    Momenta const now(collision, packing);
    course.lost_momentum = std::max(course.lost_momentum, (now.linear - start.linear).norm() / start.linear_scale);
    course.lost_angular_momentum =
        std::max(course.lost_angular_momentum, (now.angular - start.angular).norm() / start.angular_scale);
    double const distance = (row(packing.position, 1) - row(packing.position, 0)).norm();
    bool const apart = distance > collision.radius[0] + collision.radius[1];
    if (course.touching > 0 && apart) return course;
    if (!apart) ++course.touching;
  }
  return course;
}

}  // namespace

TEST_CASE("two equal spheres meet as in Chung and Ooi's test 1") {
  struct Case {
    double modulus, poisson, density, overlap, force, duration;
  };
  // Analytic: Hertz's formulas with R = 10 mm and a relative speed of 20 m/s, for glass and for limestone.
  for (Case const& c : {Case{48e9, 0.2, 2800.0, 274.11e-6, 10.697e3, 40.34e-6},
                        Case{20e9, 0.25, 2500.0, 368.30e-6, 7.108e3, 54.20e-6}}) {
    auto const contact_law = HertzMindlin<>::of({.modulus = c.modulus, .poisson = c.poisson}, 0.35);
    Impact const impact{sphere_mass(c.density, 0.01) / 2.0, 0.005, 20.0, contact_law.reduced_modulus};
    // The numbers above are rounded in their last digit.
    CHECK(relative_error(impact.largest_overlap(), c.overlap) < 1e-4);
    CHECK(relative_error(impact.largest_force(), c.force) < 1e-4);
    CHECK(relative_error(impact.duration(), c.duration) < 2e-4);
    // Leap-frog errs by (pi / 400)^2 / 24 and samples the peak within half a step: both below 2e-5.
    Rebound const rebound = bounce(contact_law, impact, 0.0, 400);
    CHECK(relative_error(rebound.largest_overlap, impact.largest_overlap()) < 1e-4);
    CHECK(relative_error(rebound.largest_force, impact.largest_force()) < 1e-4);
    CHECK(relative_error(rebound.duration, impact.duration()) < 1e-4);
    CHECK(relative_error(rebound.speed, impact.speed) < 1e-5);
  }
}

TEST_CASE("a sphere meets a rigid wall as in Chung and Ooi's test 2") {
  struct Case {
    double modulus, poisson, density, overlap, force, duration;
  };
  // Analytic: Hertz's formulas with R = 100 mm and 0.2 m/s, for an aluminium and a magnesium alloy.
  for (Case const& c : {Case{70e9, 0.3, 2699.0, 49.717e-6, 11.370e3, 731.7e-6},
                        Case{40e9, 0.35, 1800.0, 52.123e-6, 7.233e3, 767.1e-6}}) {
    auto const contact_law = HertzMindlin<>::between({.modulus = c.modulus, .poisson = c.poisson},
                                                     {.modulus = rigid, .poisson = c.poisson}, 0.35);
    Impact const impact{sphere_mass(c.density, 0.1), 0.1, 0.2, contact_law.reduced_modulus};
    // The numbers above are rounded in their last digit.
    CHECK(relative_error(impact.largest_overlap(), c.overlap) < 2e-5);
    CHECK(relative_error(impact.largest_force(), c.force) < 1e-4);
    CHECK(relative_error(impact.duration(), c.duration) < 1e-4);
    // As above; the gates are 1e-3 for overlap and force, 2e-3 for the time.
    Rebound const rebound = bounce(contact_law, impact, 0.0, 400);
    CHECK(relative_error(rebound.largest_overlap, impact.largest_overlap()) < 1e-4);
    CHECK(relative_error(rebound.largest_force, impact.largest_force()) < 1e-4);
    CHECK(relative_error(rebound.duration, impact.duration()) < 1e-4);
    CHECK(relative_error(rebound.speed, impact.speed) < 1e-5);
  }
}

TEST_CASE("spheres rebound with the restitution that was requested, at any speed, as in Chung and Ooi's test 3") {
  struct Material {
    double modulus, poisson, density;
  };
  for (Material const& m : {Material{380e9, 0.23, 4000.0}, Material{100e9, 0.25, 7000.0}}) {  // alumina, cast iron
    for (double const restitution : {0.05, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.98, 1.0}) {
      for (double const speed : {0.039, 3.9}) {  // theirs is 3.9 m/s with R = 2.5 mm
        auto const contact_law = HertzMindlin<HertzRestitution>::of({.modulus = m.modulus, .poisson = m.poisson}, 0.092,
                                                                    HertzRestitution{.restitution = restitution});
        Impact const impact{sphere_mass(m.density, 0.0025), 0.0025, speed, contact_law.reduced_modulus};
        Rebound const rebound = bounce(contact_law, impact, 0.0, 400);
        // Analytic: what was requested. The dashpot sees the speed of half a step ago: first order, 4e-4 at 400 steps,
        // a fifth of the gate.
        CHECK(std::abs(rebound.speed / speed - restitution) < 4e-4);
        // Analytic: kinetic energy. First order as well; 1.0e-2 of the impact's energy at e = 0.05.
        double const energy = 0.5 * impact.mass * speed * speed;
        CHECK(std::abs(rebound.dissipated / energy - (1.0 - restitution * restitution)) < 1.1e-2);
      }
    }
  }
}

TEST_CASE("an oblique impact slides through as in Chung and Ooi's test 4") {
  double const friction = 0.092, restitution = 0.98, radius = 0.0025, speed = 3.9;
  auto const contact_law = HertzMindlin<HertzRestitution>::of({.modulus = 380e9, .poisson = 0.23}, friction,
                                                              HertzRestitution{.restitution = restitution});
  struct Case {
    double degrees, kept_share, spin;
  };
  for (Case const& c :
       {Case{40.0, 0.7829, 544.2}, Case{60.0, 0.8948, 355.2}, Case{80.0, 0.9679, 123.4}, Case{85.0, 0.9841, 61.9}}) {
    double const angle = c.degrees * std::numbers::pi / 180.0;
    Impact const impact{sphere_mass(4000.0, radius), radius, speed * std::cos(angle), contact_law.reduced_modulus};
    Rebound const rebound = bounce(contact_law, impact, speed * std::sin(angle), 400);
    // Analytic: impulses mu (1 + e) m v_n and (1 + e) m v_n. The first steps stick: 1e-3.
    double const lost_speed = friction * (1.0 + restitution) * impact.speed;
    CHECK(relative_error(speed * std::sin(angle) - rebound.tangential_speed, lost_speed) < 1e-3);
    CHECK(relative_error(rebound.spin / radius, -2.5 * lost_speed / radius) < 1e-3);
    // The same as numbers: 1 - mu (1 + e) / tan(angle) and 2.5 mu (1 + e) v_n / R, rounded in their last digit.
    CHECK(relative_error(rebound.tangential_speed / (speed * std::sin(angle)), c.kept_share) < 2e-4);
    CHECK(relative_error(-rebound.spin / radius, c.spin) < 2e-3);
  }
}

namespace {

/// A steel sphere of 10 mm that meets a rigid wall at 5 m/s along the normal.
struct OnSteelWall {
  static constexpr double friction = 0.3, restitution = 0.8, radius = 0.01, normal_speed = 5.0;
  HertzMindlin<HertzRestitution> contact_law =
      HertzMindlin<HertzRestitution>::between({.modulus = 208e9, .poisson = 0.3}, {.modulus = rigid, .poisson = 0.3},
                                              friction, HertzRestitution{.restitution = restitution});
  Impact impact{sphere_mass(7850.0, radius), radius, normal_speed, contact_law.reduced_modulus};

  /// Tangential speed of the centre that a wall on which the sphere slides throughout takes.
  static constexpr double lost_speed = friction * (1.0 + restitution) * normal_speed;
};

}  // namespace

TEST_CASE("with a given normal speed sliding takes the same from any tangential speed, as in Chung and Ooi's test 5") {
  OnSteelWall const wall;
  for (double const share : {4.0, 6.0, 12.0, 40.0}) {  // of what sliding takes; from 3.5 on the contact never sticks
    double const tangential_speed = share * wall.lost_speed;
    for (double const sense : {1.0, -1.0}) {
      Rebound const rebound = bounce(wall.contact_law, wall.impact, sense * tangential_speed, 400);
      // Analytic: v_t' = v_t - mu (1 + e) v_n, R w' = -2.5 mu (1 + e) v_n; the restitution is good to 4e-4 as above.
      CHECK(relative_error(sense * tangential_speed - rebound.tangential_speed, sense * wall.lost_speed) < 4e-4);
      CHECK(relative_error(rebound.spin, -2.5 * sense * wall.lost_speed) < 4e-4);
    }
  }
  // A slower contact sticks and takes less: the formula has a limit, and the cases above are on its right side.
  Rebound const stuck = bounce(wall.contact_law, wall.impact, wall.lost_speed, 400);
  CHECK(wall.lost_speed - stuck.tangential_speed < 0.9 * wall.lost_speed);
}

TEST_CASE("with a given normal speed sliding takes the same from any spin, as in Chung and Ooi's test 6") {
  OnSteelWall const wall;
  for (double const share : {4.0, 6.0, 12.0, 40.0}) {
    for (double const sense : {1.0, -1.0}) {
      double const surface_speed = sense * share * wall.lost_speed;
      Rebound const rebound = bounce(wall.contact_law, wall.impact, 0.0, 400, surface_speed);
      // Analytic: v_t' = mu (1 + e) v_n against the sliding surface, R w' = R w - 2.5 mu (1 + e) v_n; as above.
      CHECK(relative_error(rebound.tangential_speed, -sense * wall.lost_speed) < 4e-4);
      CHECK(relative_error(surface_speed - rebound.spin, 2.5 * sense * wall.lost_speed) < 4e-4);
    }
  }
}

TEST_CASE("tests 5 and 6 are one: only the speed of the surface past the wall counts, stuck or sliding") {
  OnSteelWall const wall;
  for (double const slip_speed : {0.01, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 40.0}) {  // m/s; sliding throughout from 9.45
    Rebound const thrown = bounce(wall.contact_law, wall.impact, slip_speed, 400);
    Rebound const spun = bounce(wall.contact_law, wall.impact, 0.0, 400, slip_speed);
    Rebound const mirrored = bounce(wall.contact_law, wall.impact, -slip_speed, 400);
    // Analytic: both begin with the same slip and so receive the same impulse. Round-off of some 400 steps.
    CHECK(std::abs(thrown.tangential_speed - slip_speed - spun.tangential_speed) < 1e-12 * wall.normal_speed);
    CHECK(std::abs(thrown.spin - (spun.spin - slip_speed)) < 1e-12 * wall.normal_speed);
    CHECK(relative_error(spun.speed, thrown.speed) < 1e-13);
    // Analytic: changing every sign along the wall is exact in floating point.
    CHECK(mirrored.tangential_speed == -thrown.tangential_speed);
    CHECK(mirrored.spin == -thrown.spin);
    // A contact in the plane takes from the sphere's spin what it gives its centre: impulse x R = -I (w' - w).
    CHECK(relative_error(thrown.spin, 2.5 * (thrown.tangential_speed - slip_speed)) < 1e-12);
  }
}

TEST_CASE("two equal spheres with equal spins part as in Chung and Ooi's test 7") {
  double const friction = 0.3, speed = 0.2;
  for (double const restitution : {1.0, 0.8}) {
    auto const contact_law = HertzMindlin<HertzRestitution>::of({.modulus = 70e9, .poisson = 0.3}, friction,
                                                                HertzRestitution{.restitution = restitution});
    for (double const spin :
         {2.0, 24.0}) {  // sticks, slides; on both spheres, so that the surfaces meet in opposite senses
      Collision const collision{.radius = {0.1, 0.1},
                                .closing = {speed, 0.0, 0.0},
                                .spin = {Vector<3>{0.0, 0.0, spin}, Vector<3>{0.0, 0.0, spin}}};
      Course const course = collide(collision, contact_law);
      REQUIRE(course.touching > 500);
      // Exact, in every step: forces are opposite and act at one point, and leap-frog moves each centre along its own
      // velocity, so that sum (x cross m v + I w) of a position and the velocity that led to it never changes.
      // Round-off.
      CHECK(course.lost_momentum < 1e-12);
      CHECK(course.lost_angular_momentum < 1e-12);
      auto const& packing = course.packing;
      // Exact: the half turn about z through the middle exchanges the spheres. Round-off of positions near 2 m, 2e-16,
      // over overlaps of 1e-5 m.
      CHECK((row(packing.velocity, 0) + row(packing.velocity, 1)).norm() < 1e-9 * speed);
      CHECK((row(packing.spin, 0) - row(packing.spin, 1)).norm() < 1e-9 * spin);
      // 1e-3: discretisation as above, and the line of centres turns by some 1e-4 rad while they touch.
      CHECK(relative_error(packing.velocity(0, 0), -restitution * speed) < 1e-3);
      double const lost_speed = friction * (1.0 + restitution) * speed;
      double const turned = std::abs(packing.velocity(0, 1));
      if (spin > 10.0) {
        // Analytic, with the impulse (1 + e) m v: tangential speed mu (1 + e) v, spin less 2.5 mu (1 + e) v / R.
        CHECK(relative_error(packing.velocity(0, 1), -lost_speed) < 1e-3);
        CHECK(relative_error(packing.spin(0, 2), spin - 2.5 * lost_speed / 0.1) < 1e-3);
      } else {
        CHECK(turned < 0.9 * lost_speed);
      }
    }
  }
}

TEST_CASE("two different spheres with spins part as in Chung and Ooi's test 8") {
  double const friction = 0.3, speed = 0.2, restitution = 0.8;
  auto const contact_law = HertzMindlin<HertzRestitution>::of({.modulus = 70e9, .poisson = 0.3}, friction,
                                                              HertzRestitution{.restitution = restitution});
  for (double const spin : {2.0, -24.0, 24.0}) {
    Collision const collision{.radius = {0.1, 0.05},
                              .closing = {speed, 0.0, 0.0},
                              .spin = {Vector<3>{0.0, 0.0, spin}, Vector<3>{0.0, 0.0, spin}}};
    Course const course = collide(collision, contact_law);
    REQUIRE(course.touching > 500);
    CHECK(course.lost_momentum < 1e-12);  // as above
    CHECK(course.lost_angular_momentum < 1e-12);
    auto const& packing = course.packing;
    // Analytic: the impulse P = (1 + e) m* 2 v moves each centre by P/m, and if it slides by mu P/m across and
    // 2.5 mu P/(m R) in spin. 1e-3 of the change: as above.
    double const impulse = (1.0 + restitution) * collision.reduced_mass() * 2.0 * speed;
    for (int i = 0; i < 2; ++i) {
      double const side = i == 0 ? -1.0 : 1.0;
      double const change = impulse / collision.mass(i);
      CHECK(relative_error(row(packing.velocity, i)(0) + side * speed, side * change) < 1e-3);
      if (std::abs(spin) < 10.0) continue;
      double const sense = spin > 0.0 ? side : -side;
      double const radius = collision.radius[static_cast<std::size_t>(i)];
      CHECK(relative_error(row(packing.velocity, i)(1), sense * friction * change) < 1e-3);
      CHECK(relative_error(spin - row(packing.spin, i)(2),
                           (spin > 0.0 ? 1.0 : -1.0) * 2.5 * friction * change / radius) < 1e-3);
    }
  }
}

TEST_CASE("a glancing collision in space keeps momentum and angular momentum to round-off") {
  for (double const restitution : {1.0, 0.8, 0.2}) {
    for (double const friction : {0.0, 0.1, 1.0}) {  // sliding to sticking
      Collision const collision{.radius = {0.07, 0.1},
                                .closing = {0.3, -0.2, 0.25},
                                .spin = {Vector<3>{3.0, -5.0, 2.0}, Vector<3>{-1.0, 4.0, 8.0}},
                                .line = Vector<3>{2.0, -1.0, 2.0} / 3.0,
                                .drift = {0.05, 0.1, -0.07}};
      auto const contact_law = HertzMindlin<HertzRestitution>::of({.modulus = 70e9, .poisson = 0.3}, friction,
                                                                  HertzRestitution{.restitution = restitution});
      Course const course = collide(collision, contact_law);
      REQUIRE(course.touching > 300);
      CHECK(course.lost_momentum < 1e-12);  // exact, as in test 7
      CHECK(course.lost_angular_momentum < 1e-12);
    }
  }
}

namespace {

/// The trap: Mindlin's stiffness times the total slip s, F_t = -8 G* a s.
struct TotalSlipForm {
  HertzMindlin<> law;

  ContactForce<2, double> respond(ContactKinematics<2, double> const& approach,
                                  ContactMemory<2, double>& memory) const {
    double const slip = memory.scalars[1] += approach.slip_increment;
    auto force = law.respond(approach, memory);
    force.shear = -law.stiffness(approach.overlap, approach.reduced_radius).tangential * slip;
    return force;
  }
};

/// Kinetic energy that a rebound has gained over that of the impact, as a share of it.
double gained_energy(Rebound const& rebound, double speed) {
  double const squares = rebound.speed * rebound.speed + rebound.tangential_speed * rebound.tangential_speed +
                         0.4 * rebound.spin * rebound.spin;
  return squares / (speed * speed) - 1.0;
}

}  // namespace

TEST_CASE("an elastic oblique impact gains no energy, and what it loses is what the law says, stuck or sliding") {
  double const radius = 0.0025, speed = 3.9;
  for (double const friction : {0.092, 1e6}) {  // test 4, and without sliding
    auto const contact_law = HertzMindlin<>::of({.modulus = 380e9, .poisson = 0.23}, friction);
    for (double const degrees : {5.0, 45.0, 80.0, 85.0}) {
      double const angle = degrees * std::numbers::pi / 180.0;
      Impact const impact{sphere_mass(4000.0, radius), radius, speed * std::cos(angle), contact_law.reduced_modulus};
      Rebound const rebound = bounce(contact_law, impact, speed * std::sin(angle), 400);
      double const gained = gained_energy(rebound, speed);
      double const lost = rebound.dissipated / (0.5 * impact.mass * speed * speed);
      // Analytic: energy. The normal part closes to 5e-9, as in test 1, the tangential one exactly.
      CHECK(gained < 0.0);
      CHECK(std::abs(gained + lost) < 1e-8);
      // Where nothing slides all loss comes from the shrinking contact, which releases its share of the shear force
      // (Thornton, Cummins and Cleary 2013). Analytic: 2/7 sin^2(angle) of the energy is that of the slip, since the
      // slip has the mass m / 3.5, and of this always the same share is lost. Another code gives the share: Runge-Kutta
      // with 10^5 steps for u'' = -u^1.5, F' = -1.5 s sqrt(u) w + min(u', 0) F / 2u, w' = 3.5 F, s = 2 (1 - nu) / (2 -
      // nu).
      // The scheme above is of first order, 0.6 % at 400 steps.
      if (friction > 1.0) {
        CHECK(relative_error(lost, 0.65408 * 2.0 / 7.0 * std::pow(std::sin(angle), 2)) < 0.01);
        // The path-dependent form gains energy at each of these angles: the test above can fail.
        CHECK(gained_energy(bounce(TotalSlipForm{contact_law}, impact, speed * std::sin(angle), 400), speed) > 5e-5);
      }
    }
  }
}
