// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "scarp/dem/drive.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/shape/sphere.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using samples::Discs;
using samples::relative_error;
using scarp::LinearFrictional;
using Spheres = scarp::Packing<scarp::Sphere, LinearFrictional>;

constexpr double diameter = 1e-2;

LinearFrictional springs(double friction) {
  return {.normal_stiffness = 1e7, .tangential_stiffness = 5e6, .friction = friction};
}

/// Rows along x, pressed evenly; `stiffness_number` is k_n / (p t), the diameter over an overlap.
Discs triangular_array(double stiffness_number) {
  // Analytic: p = sqrt3 F / (d t), F = k_n u (tests/homogenise/lattice.test.cpp).
  double const overlap = diameter / (std::sqrt(3.0) * stiffness_number);
  return samples::triangular_lattice<Discs>(4, diameter / 2.0, diameter - overlap);
}

/// Eight cubes of four spheres, pressed evenly; `stiffness_number` is k_n / (p d).
Spheres fcc_array(double stiffness_number) {
  // Analytic: six contacts for each volume of d^3 / sqrt2 give p = 2 sqrt2 F / d^2.
  double const spacing = diameter - diameter / (2.0 * std::sqrt(2.0) * stiffness_number);
  double const half_edge = spacing / std::sqrt(2.0);
  constexpr int side = 4;
  Spheres packing;
  packing.population = std::make_shared<scarp::Population<scarp::Sphere> const>(
      std::vector<std::array<double, 1>>(side * side * side / 2, {diameter / 2.0}), samples::density, 1.0);
  packing.cell = side * half_edge * scarp::Tensor<3>::Identity();
  packing.position.resize(packing.population->count());
  packing.orientation.resize(packing.population->count());
  packing.rest();
  std::size_t grain = 0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (int k = (i + j) % 2; k < side; k += 2, ++grain) {
        for (int a = 0; a < 3; ++a) packing.position(grain, a) = ((a == 0 ? i : a == 1 ? j : k) + 0.25) * half_edge;
      }
    }
  }
  return packing;
}

struct Peak {
  double ratio = 0.0;     ///< of axial to lateral stress
  double contacts = 0.0;  ///< over the number of grains
  long step = 0;
};

/// Compression along the last axis at constant lateral stress until the ratio of stresses has stopped growing. Rigid
/// grains would get there without strain, these need up to 5 over their stiffness number. The inertial number is 1e-5
/// for the stiffer spheres and less for discs.
template <class PackingType>
Peak strength(PackingType packing, LinearFrictional const& law, double pressure, double stiffness_number) {
  constexpr int dim = PackingType::dim;
  double const rate = 2e-4 / stiffness_number;
  scarp::TimeStepper<PackingType> stepper;
  scarp::CellDriver<PackingType> drive(packing, law, scarp::drained_compression<dim>(rate, pressure));
  Peak peak;
  for (long step = 0; step < 40'000 && step - peak.step < 1000; ++step) {
    REQUIRE(drive.step(stepper).acceptable());
    auto const& seen = drive.seen();
    double const ratio = seen.stress(dim - 1, dim - 1) / seen.stress.diagonal().head(dim - 1).mean();
    if (ratio > peak.ratio) peak = {ratio, seen.contacts / static_cast<double>(packing.grain_count()), step};
  }
  return peak;
}

Peak strength_of_discs(double friction, double stiffness_number) {
  auto const law = springs(friction);
  double const pressure = law.normal_stiffness / (stiffness_number * samples::thickness);
  return strength(triangular_array(stiffness_number), law, pressure, stiffness_number);
}

Peak strength_of_spheres(double friction, double stiffness_number) {
  auto const law = springs(friction);
  double const pressure = law.normal_stiffness / (stiffness_number * diameter);
  return strength(fcc_array(stiffness_number), law, pressure, stiffness_number);
}

}  // namespace

TEST_CASE("a triangular array of discs pressed normal to its rows has Rowe's strength") {
  for (double const friction : {0.0, 0.1, 0.3}) {
    // Analytic: sigma_1 / sigma_3 = sqrt3 tan(60 deg + phi), tan phi = mu, for rigid discs once the contacts along the
    // rows are open; equilibrium of one disc on four contacts that slide (Rowe 1962): 3, 3.838, 7.327.
    double const expected = std::sqrt(3.0) * std::tan(std::numbers::pi / 3.0 + std::atan(friction));
    Peak const soft = strength_of_discs(friction, 1e3);
    Peak const stiff = strength_of_discs(friction, 1e4);
    CHECK(relative_error(stiff.ratio, expected) < 0.01);  // the gate; 0.15 % at most
    // Overlap and shear of the springs, d / kappa, lay the contacts flatter than 60 deg: always weaker, to first order,
    // with 2 % of second order in the error of the softer array.
    CHECK(stiff.ratio < expected);
    double const order = relative_error(soft.ratio, expected) / relative_error(stiff.ratio, expected);
    CHECK(order > 9.5);
    CHECK(order < 10.5);
    if (friction > 0.0) CHECK(stiff.contacts == 2.0);  // of three: the rows are open
  }
}

TEST_CASE("a face-centred array of spheres pressed along the edge of its cube has Rowe's strength") {
  for (double const friction : {0.0, 0.1, 0.3, 0.5}) {
    // Analytic: sigma_1 / sigma_3 = 2 (1 + mu) / (1 - mu) for rigid spheres once the contacts in the planes across the
    // axis are open; eight sliding contacts at 45 deg, of which four carry each lateral stress (Rowe 1962): 2, 2.444,
    // 3.714, 6.
    double const expected = 2.0 * (1.0 + friction) / (1.0 - friction);
    Peak const soft = strength_of_spheres(friction, 1e3);
    Peak const stiff = strength_of_spheres(friction, 1e4);
    CHECK(relative_error(stiff.ratio, expected) < 0.01);  // the gate; 0.08 % at most
    CHECK(stiff.ratio < expected);                        // and first order, as in the plane
    double const order = relative_error(soft.ratio, expected) / relative_error(stiff.ratio, expected);
    CHECK(order > 9.5);
    CHECK(order < 10.5);
    if (friction > 0.0) CHECK(stiff.contacts == 4.0);  // of six
  }
}
