// SPDX-License-Identifier: BSL-1.0
// Up to which time step do grains vibrate without end, and what do prediction and default say? Grains in balance are
// nudged by 1e-9 m/s, too little to open a contact or to slide, and left alone without damping; the growth of their
// energy decides.
#include <fmt/format.h>

#include "contact/every_law.hpp"
#include "dem/sample_packings.hpp"
#include "scarp/shape/clump_templates.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/shape/superellipse.hpp"
#include "stability/groups.hpp"
#include "stability/vibration.hpp"

namespace stability {

namespace {

using scarp::HertzMindlin;
using scarp::HertzRestitution;
using scarp::Packing;
using scarp::Tensor;
using scarp::Vector;

constexpr double radius = 5e-3;    // [m]
constexpr double squeezed = 1e-4;  // overlap over spacing
constexpr double endless = 1e6;    // friction that nothing overcomes

scarp::LinearFrictional springs() {
  return {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = endless};
}

/// Grains on the points i a + j b.
template <class PackingType>
PackingType lattice(typename PackingType::Shape::template Size<double> const& size, Vector<2> const& a,
                    Vector<2> const& b, int count_a, int count_b) {
  Tensor<2> cell;
  cell.col(0) = count_a * (1.0 - squeezed) * a;
  cell.col(1) = count_b * (1.0 - squeezed) * b;
  std::vector<Vector<2>> places;
  for (int i = 0; i < count_a; ++i) {
    for (int j = 0; j < count_b; ++j) places.push_back((1.0 - squeezed) * ((i + 0.25) * a + (j + 0.25) * b));
  }
  return samples::place<PackingType>(cell, {places.size(), size}, places);
}

/// Spheres on a cubic grid, or in a row along x that touches nothing beside it.
template <class PackingType>
PackingType grid(int along, int across) {
  double const spacing = 2.0 * radius * (1.0 - squeezed);
  double const apart = across > 1 ? spacing : 3.0 * radius;
  PackingType packing;
  auto const count = static_cast<std::size_t>(along * across * across);
  packing.population = std::make_shared<scarp::Population<scarp::Sphere> const>(
      std::vector<scarp::Sphere::Size<double>>(count, {radius}), samples::density, 1.0);
  packing.cell = Vector<3>(along * spacing, across * apart, across * apart).asDiagonal();
  packing.position.resize(count);
  packing.rest();
  for (std::size_t i = 0; i < count; ++i) {
    int const number = static_cast<int>(i);
    packing.position(i, 0) = (number % along + 0.25) * spacing;
    packing.position(i, 1) = (number / along % across + 0.25) * apart;
    packing.position(i, 2) = (number / along / across + 0.25) * apart;
  }
  return packing;
}

/// Bonds every listed pair where the law has bonds.
template <class PackingType>
void bond_all(PackingType& packing) {
  using Law = typename PackingType::Law;
  scarp::ContactMemory<PackingType::dim, double> memory;
  test_support::bond_if_possible<Law>(memory);
  auto row = packing.pairs.scalars.row(0);
  std::copy_n(memory.scalars.begin(), row.size(), row.begin());
  for (std::size_t p = 0; p < packing.pairs.count(); ++p) packing.pairs.scalars.set_row(p, row);
}

template <class PackingType>
Outcome compare(PackingType packing, typename PackingType::Law const& law) {
  Outcome outcome{.measure = "bisected over predicted limit"};
  auto stepper = detail::undamped<PackingType>();
  if (auto const verdict = stepper.refresh(packing, law); !verdict.acceptable()) {
    outcome.remark = fmt::format("refused: {}", name(verdict.reason));
    return outcome;
  }
  bond_all(packing);
  Limits const limits = limits_of(packing, law);
  outcome.worst = limits.bisected / limits.predicted;
  double const share = limits.by_default / limits.bisected;
  outcome.remark = fmt::format("default step {:.2f} of the bisected limit", share);
  outcome.as_expected = std::abs(outcome.worst - 1.0) <= 0.1 && share < 0.8;
  return outcome;
}

/// Study's grains under 200 kPa, brought to rest, then with endless friction.
template <class PackingType>
Outcome compare_random(int grains) {
  auto packing = samples::consolidated<PackingType>(grains).packing;
  auto law = samples::study_law();
  scarp::TimeStepper<PackingType> stepper;
  for (int step = 0; step < 10'000; ++step) {
    if (!stepper.step(packing, law, Tensor<2>::Zero()).acceptable()) return {.measure = "nothing", .remark = "no rest"};
  }
  packing.rest();
  law.friction = endless;
  return compare(packing, law);
}

template <class Law>
Cases discs_with(std::string const& law_name, Law const& law) {
  using PackingType = Packing<scarp::Disc, Law>;
  auto const row = [law](Size) {
    return compare(lattice<PackingType>({radius}, {2.0 * radius, 0.0}, {0.0, 6.0 * radius}, 2, 1), law);
  };
  auto const triangles = [law](Size) {
    return compare(lattice<PackingType>({radius}, {2.0 * radius, 0.0}, {radius, std::sqrt(3.0) * radius}, 4, 4), law);
  };
  return {{.name = fmt::format("discs, {}: row", law_name), .run = row},
          {.name = fmt::format("discs, {}: triangular lattice", law_name), .run = triangles}};
}

template <class Law>
Cases spheres_with(std::string const& law_name, Law const& law) {
  using PackingType = Packing<scarp::Sphere, Law>;
  return {{.name = fmt::format("spheres, {}: row", law_name),
           .run = [law](Size) { return compare(grid<PackingType>(2, 1), law); }},
          {.name = fmt::format("spheres, {}: cubic lattice", law_name),
           .run = [law](Size) { return compare(grid<PackingType>(4, 4), law); }}};
}

/// Discs that are stretched along y: the lattice stretches with them.
Outcome ellipses(Size) {
  constexpr double aspect = 0.6;
  return compare(lattice<samples::Ellipses>({radius, aspect * radius}, {2.0 * radius, 0.0},
                                            {radius, aspect * std::sqrt(3.0) * radius}, 4, 4),
                 springs());
}

/// Neighbours along the diagonals only: (x, y) with |x/2 rx|^(2/eps) + |y/2 ry|^(2/eps) = 1.
Outcome superellipses(double exponent) {
  double const share = 2.0 * std::pow(0.5, exponent / 2.0);
  double const aspect = 0.7;
  Vector<2> const up(share * radius, share * aspect * radius);
  Vector<2> const back(-up(0), up(1));
  return compare(lattice<Packing<scarp::Superellipse, scarp::LinearFrictional>>({radius, aspect * radius, exponent}, up,
                                                                                back, 4, 4),
                 springs());
}

/// Side by side two contacts join each pair, end to end one.
Outcome dumbbells(Size) {
  return compare(lattice<Packing<scarp::Dumbbell, scarp::LinearFrictional>>({radius}, {3.5 * radius, 0.0},
                                                                            {0.0, 2.0 * radius}, 4, 4),
                 springs());
}

}  // namespace

Cases time_step_cases() {
  Cases all;
  auto const take = [&](Cases&& some) {
    for (Case& one : some) {
      one.group = "Time step limits";
      one.expected = "bisected and predicted limit within 10 %, default below 0.8 of it";
      all.push_back(std::move(one));
    }
  };
  auto const damped = [](double restitution) {
    return HertzMindlin<HertzRestitution>::of(7e9, 0.2, endless, {.restitution = restitution});
  };
  auto const hertz = HertzMindlin<>::of(7e9, 0.2, endless);
  auto softer = springs();
  softer.tangential_stiffness *= 0.3;
  take(discs_with("springs", scarp::Frictionless{.normal_stiffness = 6e6}));
  take(discs_with("springs and friction", springs()));
  take(discs_with("springs and friction, k_t/k_n = 0.3", softer));
  take(discs_with("rolling resistance",
                  scarp::RollingResistance<scarp::LinearFrictional>{
                      .law = springs(), .rolling_stiffness = 6e6 * radius * radius, .rolling_friction = endless}));
  take(discs_with("bonds", scarp::CohesiveBond<scarp::LinearFrictional>{
                               .law = springs(), .tensile_strength = 1.0, .shear_strength = endless}));
  take(discs_with("Hertz and Mindlin", hertz));
  for (double const restitution : {0.9, 0.5, 0.1}) {
    take(discs_with(fmt::format("Hertz and Mindlin, restitution {}", restitution), damped(restitution)));
  }
  take(spheres_with("springs and friction", springs()));
  take(spheres_with("Hertz and Mindlin, restitution 0.5", damped(0.5)));
  take({{.name = "ellipses, springs and friction: lattice", .run = ellipses},
        {.name = "superellipses of exponent 0.7, springs and friction: lattice",
         .run = [](Size) { return superellipses(0.7); }},
        {.name = "superellipses of exponent 1.3, springs and friction: lattice",
         .run = [](Size) { return superellipses(1.3); }},
        {.name = "dumbbells, springs and friction: lattice", .run = dumbbells},
        {.name = "random discs, springs and friction",
         .run = [](Size size) { return compare_random<samples::Discs>(size == Size::quick ? 30 : 200); }},
        {.name = "random ellipses, springs and friction",
         .run = [](Size size) { return compare_random<samples::Ellipses>(size == Size::quick ? 30 : 200); }}});
  return all;
}

}  // namespace stability
