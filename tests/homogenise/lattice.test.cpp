// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "../../examples/shared/sliding_contacts.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using samples::Discs;
using samples::SmoothDiscs;
using scarp::Tensor;
using scarp::VoigtTangent;

constexpr double radius = 5e-3;
constexpr double spacing = 2.0 * radius * (1.0 - 1e-4);
constexpr scarp::LinearFrictional law{.normal_stiffness = 6e6, .tangential_stiffness = 2.4e6, .friction = 0.5};

template <class PackingType>
PackingType listed(PackingType packing, typename PackingType::Law const& contact_law) {
  scarp::TimeStepper<PackingType> stepper;
  REQUIRE(stepper.refresh(packing, contact_law).acceptable());
  return packing;
}

Discs lattice() { return listed(samples::triangular_lattice<Discs>(4, radius, spacing), law); }

VoigtTangent<2> tangent_of(Discs const& packing) {
  return scarp::to_voigt_tangent<2>(scarp::contact_tangent(packing, law));
}

}  // namespace

TEST_CASE("a triangular lattice of equal discs has the closed-form moduli") {
  auto const tangent = tangent_of(lattice());
  double const kn = law.normal_stiffness;
  double const kt = law.tangential_stiffness;
  double const scale = std::sqrt(3.0) / 4.0 / samples::thickness;
  // Analytic: sum over the three bond directions, spacing cancels; per out-of-plane thickness
  // C11 = sqrt3/4 (3 kn + kt), C12 = sqrt3/4 (kn - kt), C66 = sqrt3/4 (kn + kt). Round-off with a margin.
  CHECK(tangent(0, 0) == samples::Approx(scale * (3.0 * kn + kt)).epsilon(1e-10));
  CHECK(tangent(1, 1) == samples::Approx(scale * (3.0 * kn + kt)).epsilon(1e-10));
  CHECK(tangent(0, 1) == samples::Approx(scale * (kn - kt)).epsilon(1e-10));
  CHECK(tangent(2, 2) == samples::Approx(scale * (kn + kt)).epsilon(1e-10));
  CHECK(tangent(2, 2) == samples::Approx((tangent(0, 0) - tangent(0, 1)) / 2.0).epsilon(1e-10));  // isotropy
  CHECK(std::abs(tangent(0, 2)) < 1e-10 * tangent(0, 0));
  CHECK(std::abs(tangent(1, 2)) < 1e-10 * tangent(0, 0));
  CHECK((tangent - tangent.transpose()).norm() < 1e-10 * tangent(0, 0));
}

TEST_CASE("without tangential stiffness the lattice obeys Cauchy's relation") {
  scarp::Frictionless const smooth{.normal_stiffness = 6e6};
  auto const packing = listed(samples::triangular_lattice<SmoothDiscs>(4, radius, spacing), smooth);
  auto const tangent = scarp::to_voigt_tangent<2>(scarp::contact_tangent(packing, smooth));
  CHECK(tangent(0, 1) == samples::Approx(tangent(2, 2)).epsilon(1e-10));  // analytic: C12 = C66 for central forces
  CHECK(tangent(0, 0) == samples::Approx(3.0 * tangent(0, 1)).epsilon(1e-10));
}

TEST_CASE("a pressed lattice carries its closed-form pressure and is in balance") {
  auto const packing = lattice();
  auto const state = scarp::balance(packing, law);
  // Analytic: three contacts per grain of area sqrt3/2 d^2 t, each giving F_n d n (x) n; the mean of n n over the three
  // directions is I/2, so the pressure is 3/2 F_n d / (sqrt3/2 d^2 t) = sqrt3 F_n / (d t).
  double const force = law.normal_stiffness * (2.0 * radius - spacing);
  double const expected = std::sqrt(3.0) * force / (spacing * samples::thickness);
  CHECK(state.contacts == 48);
  // The overlap, 1e-6 m, is a difference of numbers near 0.04 m: relative round-off 1e-17 x 4 / 1e-6.
  CHECK(state.stress(0, 0) == samples::Approx(-expected).epsilon(1e-9));
  CHECK(state.stress(1, 1) == samples::Approx(-expected).epsilon(1e-9));
  CHECK(std::abs(state.stress(0, 1)) < 1e-9 * expected);
  CHECK(state.unbalanced_ratio < 1e-9);
  CHECK(state.deepest_overlap == samples::Approx((2.0 * radius - spacing) / (radius / 2.0)).epsilon(1e-9));
  CHECK(examples::sliding_share(packing, law) == 0.0);
}

TEST_CASE("the same lattice in a cell with other base vectors has the same stress and moduli") {
  auto const usual = lattice();
  auto const stress = scarp::balance(usual, law).stress;
  for (int const shear : {1, 3, -2}) {
    auto packing = samples::triangular_lattice<Discs>(4, radius, spacing);
    packing.cell.col(1) += shear * packing.cell.col(0);
    packing = listed(packing, law);
    CHECK((scarp::balance(packing, law).stress - stress).norm() < 1e-9 * stress.norm());
    CHECK((tangent_of(packing) - tangent_of(usual)).norm() < 1e-12 * tangent_of(usual).norm());
  }
  // Shifted by one grain from row to row of cells: other images, the same infinite lattice.
  auto packing = samples::triangular_lattice<Discs>(4, radius, spacing);
  packing.cell.col(1) += packing.cell.col(0) / 4.0;
  packing = listed(packing, law);
  CHECK((scarp::balance(packing, law).stress - stress).norm() < 1e-9 * stress.norm());
  CHECK((tangent_of(packing) - tangent_of(usual)).norm() < 1e-12 * tangent_of(usual).norm());
}

TEST_CASE("a lattice has isotropic contact fabric and six contacts for each grain") {
  auto const packing = lattice();
  CHECK((scarp::contact_network(packing, law).fabric - Tensor<2>::Identity() / 2.0).norm() < 1e-12);
  CHECK(scarp::fabric_anisotropy(scarp::contact_network(packing, law).fabric) < 1e-11);
  CHECK(scarp::contact_network(packing, law).coordination.all == 6.0);
}

TEST_CASE("rattlers are grains with one contact or none, and the mechanical number leaves them out") {
  double const up = spacing * std::sqrt(3.0) / 2.0;
  auto const packing = listed(samples::place<Discs>(0.1 * Tensor<2>::Identity(), std::vector(5, std::array{radius}),
                                                    {{0.02, 0.02},
                                                     {0.02 + spacing, 0.02},
                                                     {0.02 + spacing / 2.0, 0.02 + up},
                                                     {0.02 + spacing / 2.0, 0.02 + up + spacing},
                                                     {0.07, 0.07}}),
                              law);
  auto const numbers = scarp::contact_network(packing, law).coordination;
  // Analytic: a triangle, a grain that hangs on its top and one alone have 2, 2, 3, 1 and 0 contacts.
  CHECK(numbers.all == samples::Approx(8.0 / 5.0).epsilon(1e-15));
  CHECK(numbers.mechanical == samples::Approx(7.0 / 3.0).epsilon(1e-15));
  CHECK(numbers.rattlers == samples::Approx(2.0 / 5.0).epsilon(1e-15));
}

TEST_CASE("grains that all point one way have the largest anisotropy of orientation") {
  using samples::Ellipses;
  auto const packing = samples::place<Ellipses>(0.1 * Tensor<2>::Identity(), {{5e-3, 3e-3}, {4e-3, 3e-3}},
                                                {{0.02, 0.02}, {0.07, 0.06}}, {0.7, 0.7});
  auto const fabric = scarp::particle_fabric(packing);
  // Analytic: n n^T of one direction, F = 4 (nn - I/2), sqrt(F:F/2) = 4 sqrt(1/2 / 2) = 2.
  CHECK(fabric(0, 0) == samples::Approx(std::cos(0.7) * std::cos(0.7)).epsilon(1e-14));
  CHECK(fabric.trace() == samples::Approx(1.0).epsilon(1e-14));
  CHECK(scarp::fabric_anisotropy(fabric) == samples::Approx(2.0).epsilon(1e-14));
}

TEST_CASE("grains without contact carry no stress and count as balanced") {
  auto const packing = listed(samples::triangular_lattice<Discs>(4, radius, 2.0 * radius * 1.001), law);
  auto const state = scarp::balance(packing, law);
  CHECK(state.contacts == 0);
  CHECK(state.stress.isZero(0.0));
  CHECK(state.unbalanced_ratio == 0.0);
  CHECK(scarp::contact_network(packing, law).fabric == Tensor<2>(Tensor<2>::Identity() / 2.0));
}
