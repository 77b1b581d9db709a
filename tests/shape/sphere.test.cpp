// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/sphere.hpp"

#include <doctest/doctest.h>

#include "scarp/core/random.hpp"
#include "scarp/dem/population.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/simd/pack.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Disc;
using scarp::Point;
using scarp::Sphere;

struct SphereWithoutContactRadius : Sphere {
  static void contact_radius();
};
static_assert(!scarp::ParticleShape<SphereWithoutContactRadius>, "a shape without a contact radius must be refused");

struct SphereOfTwoNumbers : Sphere {
  static constexpr int pose_count = 2;
};
static_assert(!scarp::HasPose<SphereOfTwoNumbers>, "a pose of another length than announced must be refused");

}  // namespace

TEST_CASE("spheres overlap by the sum of radii less the distance, along the line of centres") {
  scarp::Random random(31);
  for (int k = 0; k < 50; ++k) {
    double const first = random.uniform(0.5, 1.5);
    double const second = random.uniform(0.5, 1.5);
    Point<3, double> const branch{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    double const distance = std::hypot(branch[0], branch[1], branch[2]);
    auto const touch = Sphere::touch<double>({first}, {second}, branch, {});
    // Analytic; round-off of sizes near one.
    CHECK(std::abs(touch.overlap - (first + second - distance)) < 1e-15);
    for (std::size_t a = 0; a < 3; ++a) {
      CHECK(std::abs(touch.normal[a] - branch[a] / distance) < 1e-15);
      CHECK(std::abs(touch.arm_first[a] - touch.normal[a] * (first + distance - second) / 2.0) < 1e-15);
      CHECK(std::abs(touch.arm_second[a] - (touch.arm_first[a] - branch[a])) < 1e-15);
    }
  }
}

TEST_CASE("spheres with their centres in a plane touch as discs do") {
  scarp::Random random(32);
  for (int k = 0; k < 20; ++k) {
    double const first = random.uniform(0.5, 1.5);
    double const second = random.uniform(0.5, 1.5);
    Point<2, double> const branch{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    auto const disc = Disc::touch<double>({first}, {second}, branch, {});
    auto const sphere = Sphere::touch<double>({first}, {second}, {branch[0], branch[1], 0.0}, {});
    // The same operations but for a zero added: equal to round-off of sizes near one.
    CHECK(std::abs(sphere.overlap - disc.overlap) < 1e-15);
    for (std::size_t a = 0; a < 2; ++a) {
      CHECK(std::abs(sphere.normal[a] - disc.normal[a]) < 1e-15);
      CHECK(std::abs(sphere.arm_first[a] - disc.arm_first[a]) < 1e-15);
      CHECK(std::abs(sphere.arm_second[a] - disc.arm_second[a]) < 1e-15);
    }
    CHECK(sphere.normal[2] == 0.0);
    CHECK(sphere.arm_first[2] == 0.0);
  }
}

TEST_CASE("spheres whose centres coincide have a finite touch") {
  auto const touch = Sphere::touch<double>({0.5}, {0.25}, {0.0, 0.0, 0.0}, {});
  CHECK(touch.overlap == 0.75);  // analytic, exact in binary
  CHECK(touch.normal == Point<3, double>{1.0, 0.0, 0.0});
  CHECK(touch.arm_first == touch.arm_second);
}

TEST_CASE("volume and inertia of a sphere are those of its layers of discs") {
  // Analytic: discs of radius sqrt(r^2 - z^2) stacked; Simpson's rule is exact for the volume's quadratic, and its
  // error for the quartic (r^2 - z^2)^2 / 2 is 2 r 24 / 2 / 180 (r/500)^4, below 1e-11.
  double const radius = 0.7;
  constexpr int layers = 1000;
  double volume = 0.0;
  double second_moment = 0.0;
  for (int k = 0; k <= layers; ++k) {
    double const weight = (k == 0 || k == layers ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0)) * 2.0 * radius / layers / 3.0;
    double const height = -radius + 2.0 * radius * k / layers;
    double const disc = std::sqrt(std::max(0.0, radius * radius - height * height));
    volume += weight * Disc::content({disc});
    second_moment += weight * Disc::content({disc}) * Disc::gyration_squared({disc});
  }
  CHECK(Sphere::content({radius}) == samples::Approx(volume).epsilon(1e-13));
  CHECK(Sphere::gyration_squared({radius}) == samples::Approx(second_moment / volume).epsilon(1e-10));
  CHECK(Sphere::bounding_radius({radius}) == radius);
  CHECK(Sphere::eccentricity({radius}) == 0.0);
}

TEST_CASE("a pack of sphere pairs gives what each pair gives alone") {
  using Lanes = scarp::lanes::Pack<double>;
  scarp::Random random(33);
  std::array<Lanes, 5> in;  // radii, branch
  for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
    for (Lanes& value : in) value.vector[lane] = random.uniform(0.5, 1.5);
  }
  for (std::size_t a = 2; a < 5; ++a) in[a].vector[0] = 0.0;  // one pair with coincident centres
  auto const touch = Sphere::touch<Lanes>({in[0]}, {in[1]}, {in[2], in[3], in[4]}, {});
  for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
    auto const alone = Sphere::touch<double>({in[0][lane]}, {in[1][lane]}, {in[2][lane], in[3][lane], in[4][lane]}, {});
    // Contraction to fused multiply-adds may differ: round-off of sizes near one.
    CHECK(std::abs(touch.overlap[lane] - alone.overlap) < 1e-15);
    for (std::size_t a = 0; a < 3; ++a) {
      CHECK(std::abs(touch.normal[a][lane] - alone.normal[a]) < 1e-15);
      CHECK(std::abs(touch.arm_first[a][lane] - alone.arm_first[a]) < 1e-15);
    }
  }
}

TEST_CASE("grains in space have no thickness out of a plane") {
  CHECK_REFUSED(scarp::Population<scarp::Sphere>({{1e-3}}, 2650.0, 0.2), "thickness", "0.2");
  CHECK_NOTHROW(scarp::Population<scarp::Sphere>({{1e-3}}, 2650.0, 1.0));
}
