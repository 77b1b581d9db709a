// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/clump.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "scarp/core/random.hpp"
#include "scarp/simd/pack.hpp"
#include "support/approx.hpp"

namespace {

using scarp::Clump;
using scarp::ClumpMember;
using scarp::ContactGeometry;
using scarp::Disc;
using scarp::Point;

struct OneDisc {
  static constexpr std::array<ClumpMember, 1> members{{{3.0, -2.0, 1.5}}};
};

/// Unequal discs, one inside another, one of two equal ones at the same place, and a bridge: every case of covering.
struct Crowd {
  static constexpr std::array<ClumpMember, 6> members{
      {{0.0, 0.0, 1.0}, {0.1, 0.2, 0.3}, {1.2, 0.3, 0.8}, {1.2, 0.3, 0.8}, {-0.4, 0.9, 0.6}, {0.6, 1.1, 0.4}}};
};

/// Six discs that enclose a hole.
struct Ring {
  static constexpr double s = std::numbers::sqrt3;
  static constexpr std::array<ClumpMember, 6> members{
      {{2.0, 0.0, 1.1}, {1.0, s, 1.1}, {-1.0, s, 1.1}, {-2.0, 0.0, 1.1}, {-1.0, -s, 1.1}, {1.0, -s, 1.1}}};
};

struct ClumpWithoutTouch : scarp::Dumbbell {
  static void touch();
};
static_assert(!scarp::ParticleShape<ClumpWithoutTouch>, "a clump whose parts cannot touch must be refused");

template <class Shape>
std::array<double, 3> part(double scale, double angle, int number) {
  return Shape::template pose<double>({scale}, {std::cos(angle), std::sin(angle)}, number);
}

struct Moments {
  double area = 0.0;
  Point<2, double> centroid{};
  double polar = 0.0;
};

/// Moments about the frame's origin by exact lengths of scan lines: their covered intervals merged, midpoint rule
/// across.
template <class Members>
Moments scan(Members const& members, int lines) {
  Moments moments;
  double const low = -4.0;
  double const width = 8.0 / lines;
  for (int k = 0; k < lines; ++k) {
    double const y = low + (k + 0.5) * width;
    std::vector<std::array<double, 2>> intervals;
    for (ClumpMember const& member : members) {
      double const squared = member.radius * member.radius - (y - member.y) * (y - member.y);
      if (squared > 0.0) intervals.push_back({member.x - std::sqrt(squared), member.x + std::sqrt(squared)});
    }
    std::sort(intervals.begin(), intervals.end());
    double reached = -1e300;
    for (auto const& [left, right] : intervals) {
      double const a = std::max(left, reached);
      double const b = std::max(right, a);
      reached = b;
      moments.area += width * (b - a);
      moments.centroid[0] += width * (b * b - a * a) / 2.0;
      moments.centroid[1] += width * (b - a) * y;
      moments.polar += width * ((b * b * b - a * a * a) / 3.0 + (b - a) * y * y);
    }
  }
  for (double& component : moments.centroid) component /= moments.area;
  return moments;
}

}  // namespace

TEST_CASE("a clump of one disc is the disc, wherever its template puts it") {
  using Single = Clump<OneDisc>;
  scarp::Random random(41);
  for (int k = 0; k < 20; ++k) {
    double const first = random.uniform(0.5, 1.5);
    double const second = random.uniform(0.5, 1.5);
    Point<2, double> const branch{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    auto const clump =
        Single::touch<double>(scarp::part_pose<Single>(Single::Size<double>{first}, std::array{0.6, 0.8}, 0),
                              part<Single>(second, random.uniform(0.0, 6.0), 0), branch, {});
    auto const disc = Disc::touch<double>({1.5 * first}, {1.5 * second}, branch, {});
    // Analytic; the centroid carries round-off of the template's coordinates, a few 1e-16, into direction and arms.
    CHECK(std::abs(clump.overlap - disc.overlap) < 1e-14);
    for (std::size_t a = 0; a < 2; ++a) {
      CHECK(std::abs(clump.normal[a] - disc.normal[a]) < 1e-13);
      CHECK(std::abs(clump.arm_first[a] - disc.arm_first[a]) < 1e-13);
      CHECK(std::abs(clump.arm_second[a] - disc.arm_second[a]) < 1e-13);
    }
  }
  CHECK(Single::content({0.4}) == samples::Approx(Disc::content({0.6})).epsilon(1e-14));
  CHECK(Single::gyration_squared({0.4}) == samples::Approx(Disc::gyration_squared({0.6})).epsilon(1e-13));
  CHECK(Single::bounding_radius({0.4}) == samples::Approx(0.6).epsilon(1e-14));
  CHECK(Single::eccentricity({0.4}) < 1e-14);
}

TEST_CASE("two overlapping discs have the area and inertia of both less those of their lens") {
  std::array const discs{ClumpMember{0.0, 0.0, 1.0}, ClumpMember{1.1, 0.0, 0.7}};
  auto const whole = scarp::disc_union(discs);
  // Analytic: the chord stands at x; each side of the lens is a circular segment of half angle a, with
  // area r^2 (a - sin a cos a) and moment of area 2/3 (r sin a)^3 about the disc's own centre.
  double const x = (1.1 * 1.1 + 1.0 - 0.49) / 2.2;
  double const a = std::acos(x);
  double const b = std::acos((1.1 - x) / 0.7);
  double const segment_a = a - std::sin(a) * std::cos(a);
  double const segment_b = 0.49 * (b - std::sin(b) * std::cos(b));
  double const area = std::numbers::pi * 1.49 - segment_a - segment_b;
  double const moment_a = 2.0 / 3.0 * std::pow(std::sin(a), 3);
  double const moment_b = 1.1 * segment_b - 2.0 / 3.0 * std::pow(0.7 * std::sin(b), 3);
  CHECK(whole.area == samples::Approx(area).epsilon(1e-14));
  CHECK(whole.centroid(0) ==
        samples::Approx((std::numbers::pi * 0.49 * 1.1 - moment_a - moment_b) / area).epsilon(1e-13));
  CHECK(std::abs(whole.centroid(1)) < 1e-15);

  // Polar moment of a segment about its disc's centre: the sector's r^4 a / 2 less that of the triangle of height
  // h = r cos a, which is h^4 (t / 2 + t^3 / 6) with t = tan a.
  auto const polar_segment = [](double r, double angle) {
    double const t = std::tan(angle);
    return std::pow(r, 4) * angle / 2.0 - std::pow(r * std::cos(angle), 4) * (t / 2.0 + t * t * t / 6.0);
  };
  double const polar_b =
      polar_segment(0.7, b) - 2.0 * 1.1 * (2.0 / 3.0 * std::pow(0.7 * std::sin(b), 3)) + 1.1 * 1.1 * segment_b;
  double const polar = std::numbers::pi * (0.5 + 0.49 * (0.49 / 2.0 + 1.1 * 1.1)) - polar_segment(1.0, a) - polar_b;
  CHECK(whole.polar_moment == samples::Approx(polar - area * whole.centroid.squaredNorm()).epsilon(1e-13));
}

TEST_CASE_TEMPLATE("area, centroid and inertia of a union are those of its scan lines", Template, OneDisc, Crowd, Ring,
                   scarp::DumbbellTemplate, scarp::TrefoilTemplate, scarp::QuatrefoilTemplate) {
  auto const whole = scarp::disc_union(Template::members);
  constexpr int lines = 200'000;
  Moments const moments = scan(Template::members, lines);
  // Independent: the midpoint rule errs by some (8/lines)^1.5 at the round ends of each disc, near 2.5e-7 of the
  // moments.
  double const centroid_squared = moments.centroid[0] * moments.centroid[0] + moments.centroid[1] * moments.centroid[1];
  CHECK(whole.area == samples::Approx(moments.area).epsilon(1e-6));
  CHECK(std::abs(whole.centroid(0) - moments.centroid[0]) < 1e-6);
  CHECK(std::abs(whole.centroid(1) - moments.centroid[1]) < 1e-6);
  CHECK(whole.polar_moment == samples::Approx(moments.polar - moments.area * centroid_squared).epsilon(3e-6));
}

TEST_CASE("the parts of a clump lie about the centroid of their union and turn with the grain") {
  using Shape = Clump<Crowd>;
  std::array<ClumpMember, Crowd::members.size()> placed;
  for (int k = 0; k < Shape::part_count; ++k) {
    auto const [x, y, radius] = part<Shape>(1.0, 0.7, k);
    placed[static_cast<std::size_t>(k)] = {x, y, radius};
    CHECK(std::hypot(x, y) + radius <= Shape::bounding_radius({1.0}) * (1.0 + 1e-15));
    CHECK(std::hypot(x, y) <= Shape::eccentricity({1.0}) * (1.0 + 1e-15));
  }
  auto const turned = scarp::disc_union(placed);
  // Analytic: a rigid motion changes neither area nor inertia; round-off of some thirty arcs.
  CHECK(turned.centroid.norm() < 1e-14);
  CHECK(turned.area == samples::Approx(Shape::content({1.0})).epsilon(1e-13));
  CHECK(turned.polar_moment / turned.area == samples::Approx(Shape::gyration_squared({1.0})).epsilon(1e-13));
  CHECK(Shape::content({0.5}) == samples::Approx(0.25 * turned.area).epsilon(1e-13));
  CHECK(Shape::gyration_squared({0.5}) == samples::Approx(0.25 * Shape::gyration_squared({1.0})).epsilon(1e-15));
}

TEST_CASE("parts touch as discs at their places and the arms reach from the centres of the grains") {
  using Shape = scarp::Trefoil;
  scarp::Random random(42);
  for (int k = 0; k < 20; ++k) {
    double const angle_first = random.uniform(0.0, 6.0);
    double const angle_second = random.uniform(0.0, 6.0);
    Point<2, double> const branch{random.uniform(2.0, 4.0), random.uniform(-1.0, 1.0)};
    auto const first = part<Shape>(1.0, angle_first, k % 3);
    auto const second = part<Shape>(0.8, angle_second, (k / 3) % 3);
    auto const touch = Shape::touch<double>(first, second, branch, {});
    Point<2, double> const between{branch[0] + second[0] - first[0], branch[1] + second[1] - first[1]};
    double const distance = std::hypot(between[0], between[1]);
    // Analytic: discs of radius 1 and 0.8; round-off of lengths below ten.
    CHECK(std::abs(touch.overlap - (1.8 - distance)) < 1e-14);
    for (std::size_t a = 0; a < 2; ++a) {
      double const point = first[a] + between[a] / distance * (1.0 - touch.overlap / 2.0);
      CHECK(std::abs(touch.normal[a] - between[a] / distance) < 1e-14);
      CHECK(std::abs(touch.arm_first[a] - point) < 1e-14);
      CHECK(std::abs(touch.arm_second[a] - (point - branch[a])) < 1e-14);
    }
    auto const back = Shape::touch<double>(second, first, {-branch[0], -branch[1]}, {});
    CHECK(std::abs(back.overlap - touch.overlap) < 1e-14);
    for (std::size_t a = 0; a < 2; ++a) {
      CHECK(std::abs(back.normal[a] + touch.normal[a]) < 1e-14);
      CHECK(std::abs(back.arm_first[a] - touch.arm_second[a]) < 1e-14);
    }
  }
}

TEST_CASE("a pack of clumps gives what each gives alone") {
  using Lanes = scarp::lanes::Pack<double>;
  using Shape = scarp::Quatrefoil;
  scarp::Random random(43);
  std::array<Lanes, 6> in;  // scales, angles, branch
  for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
    for (Lanes& value : in) value.vector[lane] = random.uniform(1.0, 2.0);
  }
  auto const first = Shape::pose<Lanes>({in[0]}, {cos(in[2]), sin(in[2])}, 1);
  auto const second = Shape::pose<Lanes>({in[1]}, {cos(in[3]), sin(in[3])}, 3);
  auto const touch = Shape::touch<Lanes>(first, second, {in[4], in[5]}, {});
  for (std::size_t lane = 0; lane < Lanes::size(); ++lane) {
    auto const alone = Shape::touch<double>(part<Shape>(in[0][lane], in[2][lane], 1),
                                            part<Shape>(in[1][lane], in[3][lane], 3), {in[4][lane], in[5][lane]}, {});
    // Sine, cosine and fused multiply-adds differ in the last bits; sizes near two, centres at least half a radius
    // apart.
    CHECK(std::abs(touch.overlap[lane] - alone.overlap) < 1e-13);
    for (std::size_t a = 0; a < 2; ++a) {
      CHECK(std::abs(touch.normal[a][lane] - alone.normal[a]) < 1e-13);
      CHECK(std::abs(touch.arm_second[a][lane] - alone.arm_second[a]) < 1e-13);
    }
  }
}

TEST_CASE("discs of the templates are as far apart as they say") {
  auto const distances = [](auto const& members) {
    std::vector<double> all;
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j)
        all.push_back(std::hypot(members[i].x - members[j].x, members[i].y - members[j].y));
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  CHECK(distances(scarp::DumbbellTemplate::members) == std::vector<double>{1.5});
  for (double const side : distances(scarp::TrefoilTemplate::members)) CHECK(side == samples::Approx(1.5));
  auto const square = distances(scarp::QuatrefoilTemplate::members);
  for (std::size_t k = 0; k < 4; ++k) CHECK(square[k] == samples::Approx(1.4));
  for (std::size_t k = 4; k < 6; ++k) CHECK(square[k] == samples::Approx(1.4 * std::numbers::sqrt2));
}

TEST_CASE("discs that touch, from outside or inside, count as touching to round-off, wherever they lie") {
  auto const area = [](ClumpMember const& one, ClumpMember const& other) {
    return scarp::disc_union(std::array{one, other}).area;
  };
  constexpr double pi = std::numbers::pi;
  CHECK(area({0.0, 0.0, 0.2}, {-1.2, 0.0, 1.0}) == samples::Approx(1.04 * pi).epsilon(1e-9));
  CHECK(area({0.1, 0.0, 0.1}, {-0.4, 0.0, 0.4}) == samples::Approx(0.17 * pi).epsilon(1e-9));
  CHECK(area({0.0, 0.0, 0.5}, {0.4, 0.0, 0.1}) == samples::Approx(0.25 * pi).epsilon(1e-9));
  scarp::Random random(3);
  for (int k = 0; k < 500; ++k) {
    double const r = 0.1 * std::ceil(random.uniform(0.1, 9.0)), s = 0.1 * std::ceil(random.uniform(0.1, 9.0));
    double const turn = k % 4 == 0 ? 0.0 : k % 4 == 1 ? pi / 2.0 : random.uniform(-pi, pi);
    for (double const apart : {r + s, std::abs(r - s)}) {
      double const expected = apart == r + s ? r * r + s * s : std::max(r, s) * std::max(r, s);
      CHECK(area({0.0, 0.0, r}, {apart * std::cos(turn), apart * std::sin(turn), s}) ==
            samples::Approx(expected * pi).epsilon(1e-6));
    }
  }
}
