// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/converged_contact.hpp"

#include <doctest/doctest.h>

#include "minimum_translation_by_search.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/superellipse.hpp"

namespace {

using scarp::Ellipse;
using scarp::Point;
using scarp::Superellipse;

/// A user's shape: an oval of the support function h = r (1 + eps cos 2 (phi - theta)).
struct Oval {
  static constexpr int dim = 2, size_count = 2, orientation_count = 2, pose_count = 3;
  static constexpr bool warm_starts_normal = true;
  using Size = std::array<double, 2>;
  static double content(Size const& s) { return std::numbers::pi * s[0] * s[0] * (1.0 - 1.5 * s[1] * s[1]); }
  static double gyration_squared(Size const& s) {
    double const square = s[1] * s[1];
    return s[0] * s[0] / 2.0 * (1.0 - square - 21.0 / 8.0 * square * square) / (1.0 - 1.5 * square);
  }
  static double bounding_radius(Size const& s) { return s[0] * (1.0 + s[1]); }
  static double eccentricity(Size const& s) { return 2.0 * s[0] * s[1]; }
  template <class T>
  static std::array<T, 3> pose(std::array<T, 2> const& size, std::array<T, 2> const& axis) {
    T const excess = size[0] * size[1];
    return {size[0], excess * (axis[0] * axis[0] - axis[1] * axis[1]),
            excess * scarp::broadcast<T>(2) * axis[0] * axis[1]};
  }
  template <class T>
  static T contact_radius(std::array<T, 3> const& pose) {
    return pose[0];
  }
  template <class T>
  static scarp::Support<T> support(std::array<T, 3> const& pose, Point<2, T> const& n) {
    T const cosine = n[0] * n[0] - n[1] * n[1];
    T const sine = scarp::broadcast<T>(2) * n[0] * n[1];
    T const part = pose[1] * cosine + pose[2] * sine;
    return {pose[0] + part, scarp::broadcast<T>(2) * (pose[2] * cosine - pose[1] * sine),
            pose[0] - scarp::broadcast<T>(3) * part};
  }
  template <class T>
  static std::array<scarp::Support<T>, 2> supports(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                                   Point<2, T> const& n) {
    return {support(first, n), support(second, n)};
  }
  template <class T>
  static scarp::ContactGeometry<2, T> touch(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                            Point<2, T> const& branch, Point<2, T> const& normal) {
    return scarp::support_contact<Oval>(first, second, branch, normal);
  }
};
static_assert(scarp::HasSupport<Oval> && scarp::HasSupport<Ellipse> && scarp::HasSupport<Superellipse>);
static_assert(!scarp::HasSupport<scarp::Disc>, "a disc has no search for its normal");
static_assert(scarp::HasInnerRadius<Ellipse> && !scarp::HasInnerRadius<Superellipse>);

/// Turns the normal on and on, and tells nobody its support.
struct NeverSettles : scarp::Disc {
  static constexpr bool warm_starts_normal = true;
  template <class T>
  static scarp::ContactGeometry<2, T> touch(std::array<T, 1> const& first, std::array<T, 1> const& second,
                                            Point<2, T> const& branch, Point<2, T> const& normal) {
    auto touch = scarp::Disc::touch(first, second, branch, normal);
    touch.normal = {-normal[1], normal[0]};
    return touch;
  }
};
static_assert(!scarp::HasSupport<NeverSettles>);

/// Largest error of the overlap, over the size, of pairs that move as in a packing: from the last normal to the next,
/// `pace` of the size in a step, searched anew where the touch says that it is normal_error.
template <class Shape>
double worst_followed(scarp::SizeOf<Shape> const& size, double pace, std::uint64_t seed) {
  using Grains = scarp::Population<Shape>;
  double const settled = Grains({size}, 2650.0, 1.0).largest_normal_change();
  double const largest = Shape::bounding_radius(size);
  scarp::Random random(seed);
  double worst = 0.0;
  for (int pair = 0; pair < 12; ++pair) {
    samples::PairAtOverlap<Shape> at(random, size, -0.02 * largest);
    std::array<double, 2> angle{random.uniform(0.0, 6.28), random.uniform(0.0, 6.28)};
    std::array<double, 2> const spin{pace * random.uniform(-1.0, 1.0), pace * random.uniform(-1.0, 1.0)};
    double const amplitude = random.uniform(0.0, 6.28);
    auto const pose = [&](std::size_t k) {
      return Shape::pose(size, std::array<double, 2>{std::cos(angle[k]), std::sin(angle[k])});
    };
    auto normal = scarp::converged_contact<Shape>(pose(0), pose(1), at.branch, at.branch).normal;
    for (int step = 0; step < 200; ++step) {
      for (std::size_t k = 0; k < 2; ++k) angle[k] += spin[k];
      at.branch[0] += 0.3 * pace * largest * std::cos(amplitude);
      at.branch[1] += 0.3 * pace * largest * std::sin(amplitude);
      auto touch = Shape::touch(pose(0), pose(1), at.branch, normal);
      if (touch.normal_error > settled)
        touch = scarp::converged_contact<Shape>(pose(0), pose(1), at.branch, touch.normal);
      normal = touch.normal;
      if (step % 20 > 0) continue;
      double const exact = samples::searched_overlap<Shape>(pose(0), pose(1), at.branch, 1000);
      if (std::abs(exact) < 0.1 * largest) worst = std::max(worst, std::abs(exact - touch.overlap) / largest);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("the converged touch of ellipses is the least overlap of all directions, also of needles") {
  // The search without derivatives finds the least value to round-off; positions of 3 sizes.
  for (double const aspect : {1.0, 0.6, 0.4, 0.2, 0.1, 0.05}) {
    CAPTURE(aspect);
    CHECK(samples::worst_touch<Ellipse>({1.0, aspect}, 60, 31) < 1e-13);
  }
}

TEST_CASE("the converged touch of superellipses is the least overlap of all directions, at cusps and flat sides too") {
  for (double const exponent : {0.2, 0.6, 1.0, 1.4, 1.8}) {
    for (double const aspect : {1.0, 0.3, 0.05}) {
      CAPTURE(exponent);
      CAPTURE(aspect);
      CHECK(samples::worst_touch<Superellipse>({1.0, aspect, exponent}, 12, 32) < 1e-13);
    }
  }
}

TEST_CASE("the converged touch of a user's shape is the least overlap of all directions") {
  for (double const epsilon : {0.0, 0.15, 0.33}) {
    CAPTURE(epsilon);
    CHECK(samples::worst_touch<Oval>({1.0, epsilon}, 40, 33) < 1e-13);
  }
}

TEST_CASE("pairs that move keep their least overlap from step to step, slowly and fast") {
  // A step leaves an error of the cube of its angle; at the angle from which touches are searched anew below 1e-6.
  for (double const aspect : {0.75, 0.3, 0.1, 0.05}) {
    CAPTURE(aspect);
    CHECK(worst_followed<Ellipse>({1.0, aspect}, 1e-4, 41) < 1e-10);
    CHECK(worst_followed<Ellipse>({1.0, aspect}, 1e-3, 42) < 1e-7);
    CHECK(worst_followed<Ellipse>({1.0, aspect}, 1e-2, 43) < 1e-6);
  }
  CHECK(worst_followed<Oval>({1.0, 0.3}, 1e-3, 44) < 1e-7);
  for (double const exponent : {0.2, 1.8}) CHECK(worst_followed<Superellipse>({1.0, 0.5, exponent}, 1e-3, 45) < 1e-10);
}

TEST_CASE("grains about one centre are normal_error, not answered with any normal") {
  auto const pose = Ellipse::pose<double>({1.0, 1.0}, {1.0, 0.0});
  CHECK(scarp::converged_contact<Ellipse>(pose, pose, {0.0, 0.0}, {1.0, 0.0}).normal_error > 1.0);
  // Of different axes the least translation is certain: both minor axes, across.
  auto const flat = Ellipse::pose<double>({1.0, 0.5}, {1.0, 0.0});
  auto const touch = scarp::converged_contact<Ellipse>(flat, flat, {0.0, 0.0}, {1.0, 0.0});
  CHECK(touch.normal_error == 0.0);
  CHECK(std::abs(touch.overlap - 1.0) < 1e-12);
}

TEST_CASE("a start that is no unit vector does not count as the end of a search") {
  auto const pose = Ellipse::pose<double>({1.0, 0.5}, {0.8, 0.6});
  Point<2, double> const branch{1.2, 0.7};
  auto const settled = scarp::converged_contact<Ellipse>(pose, pose, branch, {0.8, 0.6});
  REQUIRE(settled.normal_error == 0.0);
  for (double const length : {0.0, 1.0 - 1e-7, 1.0 + 1e-12, 1.3}) {
    auto const touch =
        scarp::converged_contact<Ellipse>(pose, pose, branch, {length * settled.normal[0], length * settled.normal[1]});
    CHECK(std::abs(touch.overlap - settled.overlap) < 1e-14);
    for (std::size_t a = 0; a < 2; ++a) CHECK(std::abs(touch.normal[a] - settled.normal[a]) < 1e-10);
  }
}

TEST_CASE("a position that is no number has no touch") {
  auto const pose = Ellipse::pose<double>({1.0, 0.5}, {1.0, 0.0});
  auto const touch = scarp::converged_contact<Ellipse>(pose, pose, {std::nan(""), 0.0}, {1.0, 0.0});
  CHECK(touch.normal_error > 0.0);
}

TEST_CASE("a shape whose search does not end fails the step, by name") {
  using Grains = scarp::Packing<NeverSettles, scarp::LinearFrictional>;
  Grains packing;
  packing.population = std::make_shared<scarp::Population<NeverSettles> const>(
      std::vector<std::array<double, 1>>(9, {1.0}), 2650.0, 1.0);
  packing.cell = 6.0 * scarp::Tensor<2>::Identity();
  packing.position.resize(9);
  packing.orientation.resize(9);
  for (std::size_t k = 0; k < 9; ++k) packing.position.set_row(k, {2.0 * double(k % 3), 2.0 * double(k / 3)});
  packing.rest();
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.5};
  scarp::TimeStepper<Grains> stepper;
  auto const verdict = stepper.step(packing, law, scarp::Tensor<2>::Zero());
  CHECK(verdict == scarp::Verdict{scarp::Status::failed, scarp::Reason::unconverged_normal});
}

TEST_CASE("a pair that one step cannot follow is searched anew within the step") {
  // Two needles that lie crossed from one step to the next; the normal remembered is that of before.
  using Grains = scarp::Packing<Ellipse, scarp::LinearFrictional>;
  Grains packing;
  packing.population = std::make_shared<scarp::Population<Ellipse> const>(
      std::vector<std::array<double, 2>>(2, {1.0, 0.1}), 2650.0, 1.0);
  packing.cell = 10.0 * scarp::Tensor<2>::Identity();
  packing.position.resize(2);
  packing.orientation.resize(2);
  packing.position.set_row(0, {4.0, 5.0});
  packing.position.set_row(1, {5.098, 5.0});
  packing.orientation.set_row(0, {1.0, 0.0});
  packing.orientation.set_row(1, {0.0, 1.0});
  packing.rest();
  scarp::LinearFrictional const law{.normal_stiffness = 1e6, .tangential_stiffness = 1e6, .friction = 0.0};
  scarp::TimeStepper<Grains> stepper;
  scarp::StepObservation<2> seen;
  REQUIRE(stepper.observe(packing, law, seen).acceptable());
  REQUIRE(packing.pairs.count() == 1);
  packing.pairs.normal.set_row(0, {std::cos(0.4), std::sin(0.4)});
  REQUIRE(stepper.observe(packing, law, seen).acceptable());
  // Analytic: tip against side, overlap 1 + 0.1 - 1.098.
  CHECK(std::abs(-seen.stress(0, 0) - 1e6 * 0.002 * 1.098 / 100.0) < 1e-9 * 1e6);
}

TEST_CASE("the slow way tells the contact point that the quick one does") {
  constexpr scarp::SizeOf<Ellipse> small{1.0, 0.6};
  constexpr scarp::SizeOf<Ellipse> large{1.5, 0.75};
  auto const first = Ellipse::pose<double>(small, {0.8, 0.6});
  auto const second = Ellipse::pose<double>(large, {-0.6, 0.8});
  Point<2, double> const branch{1.1, 1.2};
  auto const quick = scarp::converged_contact<Ellipse>(first, second, branch, {0.7, 0.714});
  auto const slow = scarp::minimum_translation<Ellipse>(first, second, branch);
  REQUIRE(quick.normal_error == 0.0);
  for (std::size_t a = 0; a < 2; ++a) {
    CHECK(std::abs(slow.normal[a] - quick.normal[a]) < 1e-10);
    CHECK(std::abs(slow.arm_first[a] - quick.arm_first[a]) < 1e-10);
    CHECK(std::abs(slow.arm_second[a] - quick.arm_second[a]) < 1e-10);
  }
}
