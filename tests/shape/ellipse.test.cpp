// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/ellipse.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "scarp/core/random.hpp"
#include "scarp/dem/grain_view.hpp"
#include "scarp/shape/disc.hpp"
#include "support/approx.hpp"

namespace {

using scarp::Disc;
using scarp::Ellipse;
using scarp::Point;

struct ShapeWithoutTouch : Ellipse {
  static void touch();
};
static_assert(!scarp::ParticleShape<ShapeWithoutTouch>, "a shape that cannot tell its overlap must be refused");

/// Its size is said to have two numbers, its pose wants three.
struct ShapeOfAnotherSize : scarp::Ellipse {
  template <class T>
  static std::array<T, 3> pose(std::array<T, 3> const&, std::array<T, 2> const&);
};
struct ShapeWithoutPose : scarp::Ellipse {
  static void pose();
};
struct ShapeOfPartsWithPoseOfOne : scarp::Ellipse {
  static constexpr int part_count = 2;
};
static_assert(scarp::HasPose<scarp::Ellipse>);
static_assert(!scarp::HasPose<ShapeOfAnotherSize>, "a pose from other numbers than the size must be refused");
static_assert(!scarp::HasPose<ShapeWithoutPose>, "a shape that makes no pose must be refused");
static_assert(!scarp::HasPose<ShapeOfPartsWithPoseOfOne>, "a shape of parts whose pose takes none must be refused");

struct Placed {
  double a, b, angle;
  std::array<double, 3> pose() const { return Ellipse::pose<double>({a, b}, {std::cos(angle), std::sin(angle)}); }
  /// Support function in the frame of the axes, written without the library.
  double support(double direction) const {
    return std::hypot(a * std::cos(direction - angle), b * std::sin(direction - angle));
  }
};

/// A random pair whose overlap lies between minus and plus a few percent of their size.
struct RandomPair {
  Placed first, second;
  Point<2, double> branch;

  explicit RandomPair(scarp::Random& random)
      : first{random.uniform(0.5, 1.5), random.uniform(0.3, 1.2), random.uniform(0.0, 3.2)},
        second{random.uniform(0.5, 1.5), random.uniform(0.3, 1.2), random.uniform(0.0, 3.2)} {
    double const direction = random.uniform(0.0, 2.0 * std::numbers::pi);
    double const distance = random.uniform(0.95, 1.02) * (first.support(direction) + second.support(direction));
    branch = {distance * std::cos(direction), distance * std::sin(direction)};
  }

  double gap_function(double direction) const {
    return first.support(direction) + second.support(direction) - branch[0] * std::cos(direction) -
           branch[1] * std::sin(direction);
  }

  scarp::ContactGeometry<2, double> touch(Point<2, double> const& start) const {
    return Ellipse::touch(first.pose(), second.pose(), branch, start);
  }

  scarp::ContactGeometry<2, double> settled() const {
    double const distance = std::hypot(branch[0], branch[1]);
    return scarp::converged_contact<Ellipse>(first.pose(), second.pose(), branch,
                                             {branch[0] / distance, branch[1] / distance});
  }
};

}  // namespace

TEST_CASE("the overlap of two ellipses is the least of all directions") {
  scarp::Random random(5);
  for (int k = 0; k < 20; ++k) {
    RandomPair const pair(random);
    constexpr int directions = 100'000;
    double least = 1e300;
    for (int d = 0; d < directions; ++d) {
      least = std::min(least, pair.gap_function(2.0 * std::numbers::pi * d / directions));
    }
    auto const touch = pair.settled();
    // Independent minimum: the grid lies above it by at most f''/2 (pi / 1e5)^2 with f'' below 20 here, that is 1e-8.
    CHECK(touch.overlap <= least + 1e-13);
    CHECK(touch.overlap > least - 1e-8);
    CHECK(touch.overlap ==
          samples::Approx(pair.gap_function(std::atan2(touch.normal[1], touch.normal[0]))).epsilon(1e-12));
  }
}

TEST_CASE("the contact point is the middle between the two support points") {
  scarp::Random random(6);
  RandomPair const pair(random);
  auto const touch = pair.settled();
  double const phi = std::atan2(touch.normal[1], touch.normal[0]);
  // Analytic: support point h n + h' t, the slope h' here as a central difference (error 1e-10 of a size near 1).
  auto const point_of = [&](Placed const& grain, double direction) {
    double const slope = (grain.support(direction + 1e-5) - grain.support(direction - 1e-5)) / 2e-5;
    double const value = grain.support(direction);
    return Point<2, double>{value * std::cos(direction) - slope * std::sin(direction),
                            value * std::sin(direction) + slope * std::cos(direction)};
  };
  auto const on_first = point_of(pair.first, phi);
  auto const on_second = point_of(pair.second, phi + std::numbers::pi);
  for (std::size_t a = 0; a < 2; ++a) {
    CHECK(std::abs(touch.arm_first[a] - (on_first[a] + pair.branch[a] + on_second[a]) / 2.0) < 1e-8);
    CHECK(std::abs(touch.arm_second[a] - (touch.arm_first[a] - pair.branch[a])) < 1e-15);
  }
}

TEST_CASE(
    "one step from a normal that is off by d leaves an overlap error of third and a normal error of second order") {
  scarp::Random random(7);
  for (int k = 0; k < 10; ++k) {
    RandomPair const pair(random);
    auto const exact = pair.settled();
    auto const errors = [&](double off) {
      double const c = std::cos(off);
      double const s = std::sin(off);
      auto const touch =
          pair.touch({exact.normal[0] * c - exact.normal[1] * s, exact.normal[0] * s + exact.normal[1] * c});
      double const turned = touch.normal[0] * exact.normal[1] - touch.normal[1] * exact.normal[0];
      return std::array<double, 2>{std::abs(touch.overlap - exact.overlap), std::abs(turned)};
    };
    auto const coarse = errors(4e-3);
    auto const fine = errors(1e-3);
    // Analytic orders: factors 4^3 and 4^2 for a four times smaller start error. Higher terms spoil them by a share of
    // d times a ratio of curvature derivatives, below 20 %; a constant that happens to vanish makes the order higher.
    CHECK(coarse[0] > 50.0 * fine[0]);
    CHECK(coarse[1] > 13.0 * fine[1]);
    CHECK(coarse[0] < 100.0 * std::pow(4e-3, 3));
  }
}

TEST_CASE_TEMPLATE("lanes meet as single numbers do", T, scarp::lanes::Pack<double>, scarp::lanes::Pack<float>) {
  using Scalar = typename T::value_type;
  // A hundred roundings of numbers up to ten.
  constexpr double round_off = 1e3 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  scarp::Random random(15);
  for (int draw = 0; draw < 50; ++draw) {
    std::array<T, 3> first;
    std::array<T, 3> second;
    Point<2, T> branch;
    Point<2, T> start;
    std::array<scarp::ContactGeometry<2, double>, T::size()> single;
    for (std::size_t lane = 0; lane < T::size(); ++lane) {
      RandomPair const pair(random);
      double const off = random.uniform(-0.01, 0.01);
      auto const normal = pair.settled().normal;
      Point<2, double> const turned{normal[0] * std::cos(off) - normal[1] * std::sin(off),
                                    normal[0] * std::sin(off) + normal[1] * std::cos(off)};
      single[lane] = pair.touch(turned);
      auto const spread = [lane](auto const& values, auto& to) {
        for (std::size_t k = 0; k < values.size(); ++k) to[k].vector[lane] = static_cast<Scalar>(values[k]);
      };
      spread(pair.first.pose(), first);
      spread(pair.second.pose(), second);
      spread(pair.branch, branch);
      spread(turned, start);
    }
    auto const touch = Ellipse::touch<T>(first, second, branch, start);
    for (std::size_t lane = 0; lane < T::size(); ++lane) {
      CHECK(std::abs(static_cast<double>(touch.overlap[lane]) - single[lane].overlap) < round_off);
      CHECK(std::abs(static_cast<double>(touch.normal_error[lane]) - single[lane].normal_error) < round_off);
      for (std::size_t a = 0; a < 2; ++a) {
        CHECK(std::abs(static_cast<double>(touch.normal[a][lane]) - single[lane].normal[a]) < round_off);
        CHECK(std::abs(static_cast<double>(touch.arm_first[a][lane]) - single[lane].arm_first[a]) < round_off);
      }
    }
  }
}

TEST_CASE("an ellipse of aspect one is a disc") {
  scarp::Random random(8);
  for (int k = 0; k < 20; ++k) {
    double const first = random.uniform(0.5, 1.5);
    double const second = random.uniform(0.5, 1.5);
    double const direction = random.uniform(0.0, 6.28);
    double const distance = (first + second) * random.uniform(0.9, 1.1);
    Point<2, double> const branch{distance * std::cos(direction), distance * std::sin(direction)};
    auto const disc = Disc::touch<double>({first}, {second}, branch, {});
    auto const start = Point<2, double>{std::cos(direction + 0.3), std::sin(direction + 0.3)};
    auto const ellipse = scarp::converged_contact<Ellipse>(Placed{first, first, 0.4}.pose(),
                                                           Placed{second, second, 1.4}.pose(), branch, start);
    // Analytic: the same circle; round-off of sizes near one.
    CHECK(std::abs(disc.overlap - (first + second - distance)) < 1e-15);
    CHECK(std::abs(ellipse.overlap - disc.overlap) < 1e-14);
    for (std::size_t a = 0; a < 2; ++a) {
      CHECK(std::abs(ellipse.normal[a] - disc.normal[a]) < 1e-14);
      CHECK(std::abs(ellipse.arm_first[a] - disc.arm_first[a]) < 1e-14);
      CHECK(std::abs(ellipse.arm_second[a] - disc.arm_second[a]) < 1e-14);
    }
  }
  CHECK(Ellipse::content({0.7, 0.7}) == samples::Approx(Disc::content({0.7})).epsilon(1e-15));
  CHECK(Ellipse::gyration_squared({0.7, 0.7}) == samples::Approx(Disc::gyration_squared({0.7})).epsilon(1e-15));
  CHECK(Ellipse::eccentricity({0.7, 0.7}) == Disc::eccentricity({0.7}));
  CHECK(Ellipse::inner_radius(Placed{0.7, 0.7, 0.0}.pose()) == samples::Approx(0.7).epsilon(1e-15));
}

TEST_CASE("area, inertia and curvature of an ellipse follow its axes") {
  // Analytic: area pi a b, second moment (a^2 + b^2)/4 per area, least radius of curvature b^2/a.
  CHECK(Ellipse::content({2.0, 1.5}) == samples::Approx(3.0 * std::numbers::pi).epsilon(1e-15));
  CHECK(Ellipse::gyration_squared({2.0, 1.5}) == samples::Approx(6.25 / 4.0).epsilon(1e-15));
  CHECK(Ellipse::inner_radius(Placed{2.0, 1.5, 0.4}.pose()) == samples::Approx(2.25 / 2.0).epsilon(1e-14));
  CHECK(Ellipse::bounding_radius({1.5, 2.0}) == 2.0);
  auto const tip = Ellipse::support(Placed{2.0, 1.5, 0.0}.pose(), Point<2, double>{1.0, 0.0});
  CHECK(tip.value == samples::Approx(2.0).epsilon(1e-15));
  CHECK(tip.slope == 0.0);
  CHECK(tip.curvature_radius == samples::Approx(2.25 / 2.0).epsilon(1e-15));
}

TEST_CASE("the same pair seen from the other grain has the opposite normal") {
  scarp::Random random(9);
  RandomPair const pair(random);
  auto const touch = pair.settled();
  auto const back = scarp::converged_contact<Ellipse>(pair.second.pose(), pair.first.pose(),
                                                      Point<2, double>{-pair.branch[0], -pair.branch[1]},
                                                      Point<2, double>{-touch.normal[0], -touch.normal[1]});
  CHECK(std::abs(back.overlap - touch.overlap) < 1e-14);  // analytic symmetry, round-off
  for (std::size_t a = 0; a < 2; ++a) {
    CHECK(std::abs(back.normal[a] + touch.normal[a]) < 1e-12);
    CHECK(std::abs(back.arm_first[a] - touch.arm_second[a]) < 1e-12);
  }
}
