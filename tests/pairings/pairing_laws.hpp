// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pairings/pairings.hpp"
#include "pairings/specimen.hpp"

/// What a packing of any shape with any law obeys. Forces are read from the velocities that they cause, without
/// damping.
namespace pairings {

using scarp::Reason;
using scarp::Status;

template <int Dim>
Tensor<Dim> sheared_by(double size) {
  Tensor<Dim> strain = -0.3 * size * Tensor<Dim>::Identity();
  strain(0, 1) = size;
  strain(Dim - 1, 0) = 0.4 * size;
  return strain;
}

/// Axial vector of the antisymmetric part, (A_zy - A_yz, ...).
inline Vector<3> axial(Tensor<2> const& tensor) { return {0.0, 0.0, tensor(1, 0) - tensor(0, 1)}; }
inline Vector<3> axial(Tensor<3> const& tensor) {
  return {tensor(2, 1) - tensor(1, 2), tensor(0, 2) - tensor(2, 0), tensor(1, 0) - tensor(0, 1)};
}

/// Whether a step's forces add up to nothing, and its torques with branch x force of the contacts, whose sum is the
/// antisymmetric part of Love and Weber's stress: \f$ \sum_i T_i = V\,axial(\sigma) \f$
template <int Dim>
void check_action_is_reaction(Specimen<Dim>& specimen) {
  specimen.bond();
  double turning = 0.0;
  for (int step = 0; step < 20; ++step) {
    auto const before = specimen.grains();
    REQUIRE(specimen.step(sheared_by<Dim>(2e-4)).acceptable());
    auto const after = specimen.grains();
    auto const seen = specimen.seen;
    double const volume = before.cell.determinant();
    Vector<Dim> force = Vector<Dim>::Zero();
    Vector<3> torque = Vector<3>::Zero();
    double scale = seen.stress.norm() * volume;
    double largest_torque = 0.0;
    for (std::size_t i = 0; i < before.velocity.size(); ++i) {
      double const mass = specimen.mass(i) / specimen.time_step();
      double const inertia = specimen.inertia(i) / specimen.time_step();
      force += mass * (after.velocity[i] - before.velocity[i]);
      torque += inertia * (after.spin[i] - before.spin[i]);
      scale = std::max({scale, mass * after.velocity[i].norm(), inertia * after.spin[i].norm()});
      largest_torque = std::max(largest_torque, inertia * (after.spin[i] - before.spin[i]).norm());
    }
    REQUIRE(std::isfinite(scale));
    REQUIRE(seen.contacts > 0.0);
    // Round-off of some hundred additions, and of velocities in whose differences the forces are read.
    CHECK(force.norm() < 1e-12 * scale);
    CHECK((torque - volume * axial(seen.stress)).norm() < 1e-12 * scale);
    turning = std::max(turning, largest_torque / scale);
  }
  CHECK((turning > 1e-6) == specimen.turns_grains());
}

/// A quarter turn, exact in floating point; in space about z and then about x, so that all axes change places.
inline void set_quarter_turn(Tensor<2>& turn) { turn << 0.0, -1.0, 1.0, 0.0; }
inline void set_quarter_turn(Tensor<3>& turn) { turn << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0; }

template <int Dim>
Grains<Dim> turned(Grains<Dim> grains, Tensor<Dim> const& turn) {
  grains.cell = (turn * grains.cell).eval();
  for (auto& place : grains.position) place = (turn * place).eval();
  for (auto& velocity : grains.velocity) velocity = (turn * velocity).eval();
  if constexpr (Dim == 2) {
    for (auto& axis : grains.axis) axis = (turn * axis).eval();
  } else {
    for (auto& spin : grains.spin) spin = (turn * spin).eval();
  }
  return grains;
}

/// Largest difference of velocities and spins over the largest of them.
template <int Dim>
double difference(Grains<Dim> const& a, Grains<Dim> const& b) {
  double largest = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < a.velocity.size(); ++i) {
    worst = std::max({worst, (a.velocity[i] - b.velocity[i]).norm(), (a.spin[i] - b.spin[i]).norm()});
    largest = std::max({largest, a.velocity[i].norm(), a.spin[i].norm()});
  }
  return worst / largest;
}

/// Round-off of 1e-16 in places of up to thirty units over overlaps of some tenths, which grows tenfold along the short
/// path; in space the critical step brings in an eigenvalue in closed form, good to 1e-8. A wrong sign or a lost image
/// makes a difference of order one.
template <int Dim>
inline constexpr double round_off = Dim == 2 ? 1e-11 : 1e-7;
inline constexpr int short_path = 8;

template <int Dim>
void check_turning_turns_the_answer(Specimen<Dim>& specimen, Specimen<Dim>& other) {
  Tensor<Dim> turn;
  set_quarter_turn(turn);
  Tensor<Dim> const strain = sheared_by<Dim>(2e-4);
  Tensor<Dim> const turned_strain = turn * strain * turn.transpose();
  other.place(turned(specimen.grains(), turn));
  specimen.bond();
  other.bond();
  for (int step = 0; step < short_path; ++step) {
    REQUIRE(specimen.step(strain).acceptable());
    REQUIRE(other.step(turned_strain).acceptable());
  }
  CHECK(difference(turned(specimen.grains(), turn), other.grains()) < round_off<Dim>);
  Tensor<Dim> const stress = turn * specimen.seen.stress * turn.transpose();
  CHECK((stress - other.seen.stress).norm() < round_off<Dim> * stress.norm());
}

template <int Dim>
void check_lattice_vectors_change_nothing(Specimen<Dim>& specimen, Specimen<Dim>& other) {
  Tensor<Dim> const strain = sheared_by<Dim>(2e-4);
  auto grains = specimen.grains();
  for (std::size_t i = 0; i < grains.position.size(); ++i) {
    Vector<Dim> cells;
    for (int a = 0; a < Dim; ++a) cells(a) = static_cast<double>((i + 3 * static_cast<std::size_t>(a)) % 7) - 3.0;
    grains.position[i] += grains.cell * cells;
  }
  other.place(grains);
  specimen.bond();
  other.bond();
  for (int step = 0; step < short_path; ++step) {
    REQUIRE(specimen.step(strain).acceptable());
    REQUIRE(other.step(strain).acceptable());
  }
  CHECK(difference(specimen.grains(), other.grains()) < round_off<Dim>);
  CHECK((specimen.seen.stress - other.seen.stress).norm() < round_off<Dim> * specimen.seen.stress.norm());
}

template <int Dim>
void check_no_number_is_swallowed(Specimen<Dim>& specimen) {
  constexpr Verdict broken{Status::failed, Reason::not_finite};
  double const nan = std::numeric_limits<double>::quiet_NaN();
  Tensor<Dim> const still = Tensor<Dim>::Zero();
  auto const sound = specimen.grains();
  auto grains = sound;
  grains.position[7](1) = nan;
  specimen.place(grains);
  CHECK(specimen.step(still) == broken);
  // In the middle of a run the stress shows it, and no step follows.
  specimen.place(sound);
  specimen.bond();
  REQUIRE(specimen.step(still).acceptable());
  specimen.displace(7, 1, nan);
  CHECK((specimen.step(still).status == Status::failed || !specimen.seen.stress.allFinite()));
  CHECK(specimen.step(still) == broken);
}

}  // namespace pairings

/// The test cases for the pairings of the shapes that a translation unit is about.
#define PAIRINGS_OBEY_THE_LAWS(Pairings)                                                                  \
  TEST_CASE_TEMPLATE_DEFINE("forces and torques of a step add up to nothing", P, action_is_reaction) {    \
    pairings::SpecimenOf<P> specimen(1);                                                                  \
    pairings::check_action_is_reaction<P::Shape::dim>(specimen);                                          \
  }                                                                                                       \
  TEST_CASE_TEMPLATE_DEFINE("a turned packing answers with turned forces", P, turning) {                  \
    pairings::SpecimenOf<P> specimen(2);                                                                  \
    pairings::SpecimenOf<P> other(2);                                                                     \
    pairings::check_turning_turns_the_answer<P::Shape::dim>(specimen, other);                             \
  }                                                                                                       \
  TEST_CASE_TEMPLATE_DEFINE("grains moved by lattice vectors feel the same forces", P, lattice_vectors) { \
    pairings::SpecimenOf<P> specimen(3);                                                                  \
    pairings::SpecimenOf<P> other(3);                                                                     \
    pairings::check_lattice_vectors_change_nothing<P::Shape::dim>(specimen, other);                       \
  }                                                                                                       \
  TEST_CASE_TEMPLATE_DEFINE("a position that is no number ends as a status", P, no_number) {              \
    pairings::SpecimenOf<P> specimen(4);                                                                  \
    pairings::check_no_number_is_swallowed<P::Shape::dim>(specimen);                                      \
  }                                                                                                       \
  TEST_CASE_TEMPLATE_APPLY(action_is_reaction, Pairings);                                                 \
  TEST_CASE_TEMPLATE_APPLY(turning, Pairings);                                                            \
  TEST_CASE_TEMPLATE_APPLY(lattice_vectors, Pairings);                                                    \
  TEST_CASE_TEMPLATE_APPLY(no_number, Pairings)
