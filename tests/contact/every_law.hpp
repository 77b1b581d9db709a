// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/law_per_species.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/contact/rolling_resistance.hpp"

/// The types of law that the template tests run over; a new law is named here and has a Sample.
#define EVERY_CONTACT_LAW                                                                                            \
  scarp::Frictionless, scarp::LinearFrictional, scarp::HertzMindlin<>, scarp::HertzMindlin<scarp::HertzRestitution>, \
      scarp::RollingResistance<scarp::Frictionless>, scarp::RollingResistance<scarp::LinearFrictional>,              \
      scarp::RollingResistance<scarp::HertzMindlin<>>,                                                               \
      scarp::RollingResistance<scarp::HertzMindlin<scarp::HertzRestitution>>,                                        \
      scarp::CohesiveBond<scarp::LinearFrictional>,                                                                  \
      scarp::RollingResistance<scarp::CohesiveBond<scarp::LinearFrictional>>,                                        \
      scarp::LawPerSpecies<scarp::RollingResistance<scarp::HertzMindlin<>>, 2>

namespace samples {

using scarp::CohesiveBond;
using scarp::Frictionless;
using scarp::HertzMindlin;
using scarp::HertzRestitution;
using scarp::LawPerSpecies;
using scarp::LinearFrictional;
using scarp::RollingResistance;

/// A law with forces of some 10 N at an overlap of 0.1 m and a reduced radius of 1 m.
template <class Law>
struct Sample {
  static Law law() { return HertzMindlin<>::of({.modulus = 500.0, .poisson = 0.2}, 0.5); }
};
template <>
struct Sample<HertzMindlin<HertzRestitution>> {
  static HertzMindlin<HertzRestitution> law() {
    return HertzMindlin<HertzRestitution>::of({.modulus = 500.0, .poisson = 0.2}, 0.5, {.restitution = 0.6});
  }
};
template <>
struct Sample<Frictionless> {
  static Frictionless law() { return {.normal_stiffness = 100.0}; }
};
template <>
struct Sample<LinearFrictional> {
  static LinearFrictional law() { return {.normal_stiffness = 100.0, .tangential_stiffness = 50.0, .friction = 0.5}; }
};
template <class Law>
struct Sample<RollingResistance<Law>> {
  static RollingResistance<Law> law() {
    return {.law = Sample<Law>::law(), .rolling_stiffness = 8.0, .rolling_friction = 0.2};
  }
};
template <class Law>
struct Sample<CohesiveBond<Law>> {
  static CohesiveBond<Law> law() { return {.law = Sample<Law>::law(), .tensile_strength = 4.0, .shear_strength = 3.0}; }
};
template <class Law>
struct Sample<LawPerSpecies<Law, 2>> {
  static LawPerSpecies<Law, 2> law() { return {{Sample<Law>::law(), Sample<Law>::law(), Sample<Law>::law()}}; }
};

/// Bonds a contact where the law, or one that it is wrapped around, has bonds.
template <class Law, int Dim, class T>
void bond_if_possible(scarp::ContactMemory<Dim, T>& memory) {
  if constexpr (requires { Law::bond(memory); }) {
    Law::bond(memory);
  } else if constexpr (requires { Law::law; }) {
    bond_if_possible<decltype(Law::law)>(memory);
  }
}

}  // namespace samples
