// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/superellipse.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "scarp/core/random.hpp"
#include "scarp/dem/grain_view.hpp"
#include "scarp/shape/ellipse.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::ContactGeometry;
using scarp::Ellipse;
using scarp::Point;
using scarp::Superellipse;

struct ShapeWithoutInertia : Superellipse {
  static void gyration_squared();
};
static_assert(!scarp::ParticleShape<ShapeWithoutInertia>, "a shape without inertia must be refused");

constexpr double pi = std::numbers::pi;
constexpr std::array exponents{0.3, 0.5, 0.8, 1.0, 1.3, 1.7};

struct Placed {
  double rx, ry, eps, angle;
  Superellipse::Pose<double> pose() const {
    return Superellipse::pose<double>({rx, ry, eps}, {std::cos(angle), std::sin(angle)});
  }
  /// Support function in the frame of the axes, written without the library.
  double support(double direction) const {
    double const q = 2.0 / (2.0 - eps);
    return std::pow(std::pow(std::abs(rx * std::cos(direction - angle)), q) +
                        std::pow(std::abs(ry * std::sin(direction - angle)), q),
                    1.0 / q);
  }
};

/// A random pair of one exponent, drawn until its least overlap is near the one wanted.
struct RandomPair {
  Placed first, second;
  Point<2, double> branch;

  RandomPair(scarp::Random& random, double eps, double overlap)
      : first{random.uniform(0.5, 1.5), random.uniform(0.4, 1.2), eps, random.uniform(0.0, 3.2)},
        second{random.uniform(0.5, 1.5), random.uniform(0.4, 1.2), eps, random.uniform(0.0, 3.2)} {
    // Grains whose supporting lines along one direction overlap by that much; a turned direction can only lessen it.
    double const direction = random.uniform(0.0, 2.0 * pi);
    double low = 0.0;
    double high = 5.0;
    for (int k = 0; k < 60; ++k) {
      double const distance = (low + high) / 2.0;
      branch = {distance * std::cos(direction), distance * std::sin(direction)};
      (least(400) > overlap ? low : high) = distance;
    }
  }

  double gap_function(double direction) const {
    return first.support(direction) + second.support(direction) - branch[0] * std::cos(direction) -
           branch[1] * std::sin(direction);
  }

  double least(int directions) const {
    double least = 1e300;
    for (int d = 0; d < directions; ++d) least = std::min(least, gap_function(2.0 * pi * d / directions));
    return least;
  }

  ContactGeometry<2, double> touch(Point<2, double> const& start) const {
    return Superellipse::touch(first.pose(), second.pose(), branch, start);
  }
  ContactGeometry<2, double> settled() const {
    return scarp::converged_contact<Superellipse>(first.pose(), second.pose(), branch, branch);
  }
};

Point<2, double> turned(Point<2, double> const& v, double angle) {
  return {v[0] * std::cos(angle) - v[1] * std::sin(angle), v[0] * std::sin(angle) + v[1] * std::cos(angle)};
}

}  // namespace

TEST_CASE("a superellipse of exponent one is an ellipse") {
  scarp::Random random(21);
  for (int k = 0; k < 50; ++k) {
    RandomPair const pair(random, 1.0, random.uniform(-1e-2, 1e-2));
    auto const pose_of = [](Placed const& grain) {
      return Ellipse::pose<double>({grain.rx, grain.ry}, {std::cos(grain.angle), std::sin(grain.angle)});
    };
    auto const touch = pair.settled();
    auto const ellipse =
        scarp::converged_contact<Ellipse>(pose_of(pair.first), pose_of(pair.second), pair.branch, touch.normal);
    // Analytic: the same curve; the normal's round-off is that of sizes near one over radii of curvature above 0.1.
    CHECK(std::abs(touch.overlap - ellipse.overlap) < 1e-14);
    for (std::size_t a = 0; a < 2; ++a) {
      CHECK(std::abs(touch.normal[a] - ellipse.normal[a]) < 1e-12);
      CHECK(std::abs(touch.arm_first[a] - ellipse.arm_first[a]) < 1e-12);
      CHECK(std::abs(touch.arm_second[a] - ellipse.arm_second[a]) < 1e-12);
    }
  }
  Superellipse::Size<double> const size{2.0, 1.5, 1.0};
  CHECK(Superellipse::content(size) == samples::Approx(Ellipse::content({2.0, 1.5})).epsilon(1e-12));
  CHECK(Superellipse::gyration_squared(size) == samples::Approx(Ellipse::gyration_squared({2.0, 1.5})).epsilon(1e-12));
  CHECK(Superellipse::bounding_radius(size) == 2.0);
  CHECK(Superellipse::eccentricity(size) == samples::Approx(Ellipse::eccentricity({2.0, 1.5})).epsilon(1e-7));
}

TEST_CASE("area and inertia are those of the curve") {
  for (double const eps : exponents) {
    // Barr's parameter, x = rx cos^eps, y = ry sin^eps; Gauss's theorem turns the integrals into A = 1/2 int (x dy - y
    // dx), J = 1/4 int (x^2 + y^2)(x dy - y dx), x dy - y dx = rx ry eps (cos sin)^(eps - 1) dt. With t = pi/2 s^m the
    // end at t = 0 becomes smooth enough for the midpoint rule; the other end follows by symmetry.
    Superellipse::Size<double> const size{1.3, 0.8, eps};
    constexpr int points = 100'000;
    double const m = 6.0 / eps;
    double area = 0.0;
    double moment = 0.0;
    for (int k = 0; k < points; ++k) {
      double const s = (k + 0.5) / points;
      double const t = pi / 4.0 * std::pow(s, m);
      double const weight = pi / 4.0 * m * std::pow(s, m - 1.0) / points * size[0] * size[1] * eps *
                            std::pow(std::cos(t) * std::sin(t), eps - 1.0);
      double const large = std::pow(std::cos(t), 2.0 * eps);
      double const small = std::pow(std::sin(t), 2.0 * eps);
      double const squares = size[0] * size[0] + size[1] * size[1];
      area += 4.0 * weight;
      moment += weight * squares * (large + small);
    }
    // The midpoint rule's error is of order (1/points)^2 times derivatives near m^2, that is 1e-7 at most.
    CHECK(Superellipse::content(size) == samples::Approx(area).epsilon(1e-7));
    CHECK(Superellipse::gyration_squared(size) == samples::Approx(moment / area).epsilon(1e-7));
  }
}

TEST_CASE("no boundary point is farther than the bounding radius and no slope exceeds the eccentricity") {
  for (double const eps : exponents) {
    for (double const ry : {0.5, 1.0, 1.4}) {
      Superellipse::Size<double> const size{1.0, ry, eps};
      auto const pose = Superellipse::pose<double>(size, {1.0, 0.0});
      double farthest = 0.0;
      double steepest = 0.0;
      constexpr int directions = 20'000;
      for (int d = 0; d <= directions; ++d) {
        double const phi = pi / 2.0 * d / directions;
        auto const support = Superellipse::support<double>(pose, {std::cos(phi), std::sin(phi)});
        farthest = std::max(farthest, std::hypot(support.value, support.slope));
        steepest = std::max(steepest, std::abs(support.slope));
      }
      // The grid misses an extremum by its curvature, up to a few hundred near a flat side, times (step/2)^2 = 1.5e-9.
      CHECK(Superellipse::bounding_radius(size) == samples::Approx(farthest).epsilon(1e-6));
      CHECK(std::abs(Superellipse::eccentricity(size) - steepest) < 1e-6 * Superellipse::bounding_radius(size));
    }
  }
}

TEST_CASE("the support function's slope and radius of curvature are its derivatives") {
  scarp::Random random(22);
  for (double const eps : exponents) {
    for (int k = 0; k < 20; ++k) {
      Placed const grain{random.uniform(0.5, 1.5), random.uniform(0.4, 1.2), eps, random.uniform(0.0, 3.2)};
      double const off_axis = random.uniform(0.2, 1.3);  // a difference quotient fails where curvature is unbounded
      double const phi = grain.angle + off_axis;
      auto const support = Superellipse::support<double>(grain.pose(), {std::cos(phi), std::sin(phi)});
      double const d = 1e-4;
      double const h = grain.support(phi);
      double const ahead = grain.support(phi + d);
      double const behind = grain.support(phi - d);
      // Truncation d^2 h'''/6 and d^2 h''''/12 with derivatives up to a few thousand for eps = 0.3 and 1.7; round-off
      // 1e-8.
      CHECK(support.value == samples::Approx(h).epsilon(1e-14));
      CHECK(std::abs(support.slope - (ahead - behind) / (2.0 * d)) < 1e-5);
      CHECK(std::abs(support.curvature_radius - (h + (ahead - 2.0 * h + behind) / (d * d))) < 1e-4);
    }
  }
}

TEST_CASE("the overlap of two superellipses is the least of all directions") {
  std::uint64_t const seed = 23;
  CAPTURE(seed);
  scarp::Random random(seed);
  for (double const eps : exponents) {
    for (double const overlap : {-1e-1, -1e-3, 1e-4, 1e-3, 1e-2}) {
      for (int k = 0; k < 4; ++k) {
        CAPTURE(eps);
        CAPTURE(overlap);
        RandomPair const pair(random, eps, overlap);
        double const least = pair.least(100'000);
        auto const touch = pair.settled();
        // Independent minimum: beside a flat side, where f' leaps by up to 0.1 within one step of the grid (6e-5), it
        // lies above by up to 1e-6; f'' stays below 20 elsewhere, which makes 1e-8.
        CHECK(touch.overlap <= least + 1e-13);
        CHECK(touch.overlap > least - 1e-6);
        CHECK(std::abs(touch.overlap - pair.gap_function(std::atan2(touch.normal[1], touch.normal[0]))) < 1e-12);
        CHECK(std::abs(std::hypot(touch.normal[0], touch.normal[1]) - 1.0) < 4e-15);
      }
    }
  }
}

TEST_CASE("superellipses of different exponents touch too") {
  scarp::Random random(24);
  int pairs = 0;
  int shallow = 0;
  for (double const eps : exponents) {
    for (double const other : exponents) {
      RandomPair pair(random, eps, 1e-3);
      pair.second.eps = other;
      double const least = pair.least(100'000);
      auto const touch = pair.settled();
      // As above; grains of other shape may lie far deeper in each other, where corners leave several minima to follow.
      CHECK(std::abs(touch.overlap - pair.gap_function(std::atan2(touch.normal[1], touch.normal[0]))) < 1e-12);
      ++pairs;
      if (least < 1e-2) {
        ++shallow;
        CHECK(std::abs(touch.overlap - least) < 1e-6);
      }
    }
  }
  CHECK(2 * shallow > pairs);
}

TEST_CASE("a touch that starts off by a small angle errs by second order in the normal and by third in the overlap") {
  scarp::Random random(25);
  for (double const eps : exponents) {
    for (int k = 0; k < 20; ++k) {
      RandomPair const pair(random, eps, 1e-3);
      auto const exact = pair.settled();
      for (double const off : {1e-2, 1e-3, 1e-4, 1e-5}) {
        auto const touch = pair.touch(turned(exact.normal, off));
        double const angle = std::abs(touch.normal[0] * exact.normal[1] - touch.normal[1] * exact.normal[0]);
        // Derived: steps above 1e-4, or that gain more than 1e-10 of overlap, are repeated. The step left is s below
        // min(off, 1e-4) and leaves s^2 times rho'/rho of the normal, here below 1e3 (corners, flat sides).
        double const step = std::min(off, 1e-4);
        CHECK(angle < std::max(1e3 * step * step, 1e-12));
        CHECK(std::abs(touch.overlap - exact.overlap) < 1e-10);
      }
    }
  }
}

TEST_CASE("flat sides, corners and axes that lie in line are touched without trouble") {
  auto const start = [](Point<2, double> const& branch) { return branch; };
  for (double const eps : {0.2, 0.3, 1.0, 1.8}) {
    auto const upright = Placed{1.0, 0.5, eps, 0.0}.pose();
    for (double const shift : {0.0, 0.3, -0.3}) {
      Point<2, double> const branch{shift, shift == 0.0 ? 0.999 : 0.99};
      auto const touch = Superellipse::touch(upright, upright, branch, start(branch));
      CHECK(std::isfinite(touch.overlap));
      CHECK(std::abs(touch.arm_first[0] - shift / 2.0) < 1e-9);  // analytic: equal grains meet in the middle
      CHECK(std::abs(touch.arm_first[1] - branch[1] / 2.0) < 1e-9);
      if (shift == 0.0) {
        CHECK(touch.overlap == samples::Approx(1e-3).epsilon(1e-9));  // analytic: 2 ry - distance
        CHECK(touch.normal[1] == samples::Approx(1.0).epsilon(1e-15));
      }
    }
  }
  // A tip on a flat side: analytic, rx + ry - distance, and the arms end on the line of centres.
  auto const flat = Placed{1.0, 0.5, 0.3, 0.0}.pose();
  auto const tip = Placed{0.8, 0.4, 1.7, pi / 2.0}.pose();
  auto const touch = Superellipse::touch(flat, tip, Point<2, double>{0.1, 1.299}, Point<2, double>{0.0, 1.0});
  CHECK(touch.overlap == samples::Approx(1e-3).epsilon(1e-3));  // a flat side of exponent 0.3 falls by 1e-7 at x = 0.1
  CHECK(std::abs(touch.arm_second[0]) < 1e-3);                  // the tip turns that little
  CHECK(touch.arm_second[1] == samples::Approx(-0.8).epsilon(1e-3));
}

TEST_CASE("the start does not matter, not even none or the opposite one") {
  scarp::Random random(26);
  for (double const eps : exponents) {
    RandomPair const pair(random, eps, 1e-3);
    auto const exact = pair.settled();
    for (auto const& start : {Point<2, double>{0.0, 0.0}, Point<2, double>{-exact.normal[0], -exact.normal[1]},
                              turned(exact.normal, 0.8), turned(exact.normal, -0.8)}) {
      auto const touch = pair.touch(start);
      CHECK(std::abs(touch.overlap - exact.overlap) < 1e-10);  // the gain of overlap below which stepping ends
    }
  }
}

TEST_CASE("grains whose centres coincide part along their least width") {
  auto const pose = Placed{1.0, 0.5, 0.6, 0.0}.pose();
  auto const touch = Superellipse::touch(pose, pose, Point<2, double>{0.0, 0.0}, Point<2, double>{0.1, 1.0});
  CHECK(touch.overlap == samples::Approx(1.0).epsilon(1e-9));  // analytic: 2 ry; stepping ends at a gain of 1e-10
  CHECK(std::abs(touch.normal[1]) == samples::Approx(1.0).epsilon(1e-9));
}

TEST_CASE("a turned or mirrored pair touches in the turned or mirrored place") {
  scarp::Random random(27);
  for (double const eps : exponents) {
    for (int k = 0; k < 10; ++k) {
      RandomPair const pair(random, eps, 1e-3);
      auto const touch = pair.settled();
      RandomPair other = pair;
      double const angle = random.uniform(0.0, 6.0);
      other.first.angle += angle;
      other.second.angle += angle;
      other.branch = turned(pair.branch, angle);
      auto const rotated = other.settled();
      other = pair;
      other.first.angle *= -1.0;
      other.second.angle *= -1.0;
      other.branch[1] *= -1.0;
      auto const mirrored = other.settled();
      auto const normal = turned(touch.normal, angle);
      auto const arm = turned(touch.arm_first, angle);
      // Analytic symmetries. Round-off of the angle, 1e-15, moves normals little but the contact point by the radius of
      // curvature, up to 1e4 beside the flattest sides here.
      CHECK(std::abs(rotated.overlap - touch.overlap) < 1e-13);
      CHECK(std::abs(mirrored.overlap - touch.overlap) < 1e-13);
      for (std::size_t a = 0; a < 2; ++a) {
        double const sign = a == 0 ? 1.0 : -1.0;
        CHECK(std::abs(rotated.normal[a] - normal[a]) < 1e-11);
        CHECK(std::abs(rotated.arm_first[a] - arm[a]) < 1e-9);
        CHECK(std::abs(mirrored.normal[a] - sign * touch.normal[a]) < 1e-11);
        CHECK(std::abs(mirrored.arm_first[a] - sign * touch.arm_first[a]) < 1e-9);
      }
    }
  }
}

TEST_CASE("the same pair of superellipses seen from the other grain has the opposite normal and swapped arms") {
  scarp::Random random(28);
  for (double const eps : exponents) {
    RandomPair const pair(random, eps, 1e-3);
    auto const touch = pair.settled();
    auto const back =
        Superellipse::touch(pair.second.pose(), pair.first.pose(), Point<2, double>{-pair.branch[0], -pair.branch[1]},
                            Point<2, double>{-touch.normal[0], -touch.normal[1]});
    CHECK(std::abs(back.overlap - touch.overlap) < 1e-14);  // analytic symmetry, round-off
    for (std::size_t a = 0; a < 2; ++a) {
      CHECK(std::abs(back.normal[a] + touch.normal[a]) < 1e-12);
      CHECK(std::abs(back.arm_first[a] - touch.arm_second[a]) < 1e-9);  // as above
      CHECK(std::abs(touch.arm_first[a] - touch.arm_second[a] - pair.branch[a]) < 1e-15);
    }
  }
}

TEST_CASE("the contact point of superellipses is the middle between their support points") {
  scarp::Random random(29);
  for (double const eps : exponents) {
    RandomPair const pair(random, eps, 1e-2);
    auto const touch = pair.settled();
    // Boundary points with that normal by Barr's parameter: x = rx cos^eps t, n ~ (cos^(2-eps) t / rx, sin^(2-eps) t /
    // ry).
    auto const point_of = [&](Placed const& grain, double sign) {
      auto const n = turned({sign * touch.normal[0], sign * touch.normal[1]}, -grain.angle);
      double const power = 1.0 / (2.0 - eps);
      double const c = std::pow(std::abs(n[0]) * grain.rx, power);
      double const s = std::pow(std::abs(n[1]) * grain.ry, power);
      double const length = std::hypot(c, s);
      return turned({std::copysign(grain.rx * std::pow(c / length, eps), n[0]),
                     std::copysign(grain.ry * std::pow(s / length, eps), n[1])},
                    grain.angle);
    };
    auto const on_first = point_of(pair.first, 1.0);
    auto const on_second = point_of(pair.second, -1.0);
    for (std::size_t a = 0; a < 2; ++a) {
      // Analytic; round-off times the radius of curvature beside flat sides, as above.
      CHECK(std::abs(touch.arm_first[a] - (on_first[a] + pair.branch[a] + on_second[a]) / 2.0) < 1e-9);
    }
  }
}

TEST_CASE_TEMPLATE("a pack of superellipse pairs gives what each pair gives alone", Scalar, double, float) {
  using Lanes = scarp::lanes::Pack<Scalar>;
  scarp::Random random(30);
  for (int k = 0; k < 20; ++k) {
    Superellipse::Pose<Lanes> first, second;
    Point<2, Lanes> branch, start;
    for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
      double const eps = exponents[static_cast<std::size_t>(random.uniform(0.0, 6.0))];
      RandomPair const pair(random, eps, random.uniform(-1e-2, 1e-2));
      for (std::size_t i = 0; i < first.size(); ++i) {
        first[i].vector[lane] = static_cast<Scalar>(pair.first.pose()[i]);
        second[i].vector[lane] = static_cast<Scalar>(pair.second.pose()[i]);
      }
      for (std::size_t a = 0; a < 2; ++a) {
        branch[a].vector[lane] = static_cast<Scalar>(pair.branch[a]);
        start[a].vector[lane] = lane % 2 == 0 ? branch[a][lane] : Scalar(0);
      }
    }
    auto const touch = Superellipse::touch<Lanes>(first, second, branch, start);
    for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
      Superellipse::Pose<Scalar> alone_first, alone_second;
      for (std::size_t i = 0; i < first.size(); ++i) {
        alone_first[i] = first[i][lane];
        alone_second[i] = second[i][lane];
      }
      auto const alone = Superellipse::touch<Scalar>(alone_first, alone_second, {branch[0][lane], branch[1][lane]},
                                                     {start[0][lane], start[1][lane]});
      // Fused multiply-adds differ in the last bits of sizes near one; a lane that stops one step later by that is as
      // far off as stepping may leave it: the gain of overlap below which it ends, and a step's square times curvature.
      double const resolution = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
      CHECK(std::abs(static_cast<double>(touch.overlap[lane] - alone.overlap)) < 50.0 * resolution);
      for (std::size_t a = 0; a < 2; ++a) {
        CHECK(std::abs(static_cast<double>(touch.normal[a][lane] - alone.normal[a])) < 1e4 * resolution);
        CHECK(std::abs(static_cast<double>(touch.arm_first[a][lane] - alone.arm_first[a])) < 1e5 * resolution);
      }
    }
  }
}

TEST_CASE("sizes that make no superellipse, or one that contact search does not hold for, are refused") {
  CHECK_NOTHROW(Superellipse::check({1.0, 0.5, 0.2}));
  CHECK_NOTHROW(Superellipse::check({1.0, 0.5, 1.8}));
  CHECK_REFUSED(Superellipse::check({1.0, 0.5, 1.9}), "exponent", "is 1.9", "0.2 and 1.8");
  CHECK_REFUSED(Superellipse::check({1.0, 0.5, 0.1}), "exponent", "0.1");
  CHECK_REFUSED(Superellipse::check({1.0, 0.5, std::nan("")}), "exponent", "nan");
  CHECK_REFUSED(Superellipse::check({0.0, 0.5, 1.0}), "half axis rx", "is 0");
  CHECK_REFUSED(Superellipse::check({1.0, -0.5, 1.0}), "half axis ry", "is -0.5");
}
