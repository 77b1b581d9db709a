// SPDX-License-Identifier: BSL-1.0
#include "scarp/shape/convex_shape.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "minimum_translation_by_search.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/dem/packing_picture.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/with_species.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;
using scarp::Ellipse;
using scarp::Point;

/// An ellipse by its support function, as a quotient.
struct Oblong : scarp::ConvexShape<Oblong, 2> {
  template <class T>
  static T support(std::array<T, 2> const& size, T const& cosine, T const& sine) {
    T const x = size[0] * cosine, y = size[1] * sine;
    T const square = x * x + y * y;
    return -(-square / sqrt(square));
  }
};

/// A rounded triangle: its two sides along a line are not alike.
struct Triangle : scarp::ConvexShape<Triangle, 2> {
  template <class T>
  static T support(std::array<T, 2> const& size, T const& cosine, T const& sine) {
    return size[0] * (1.0 + size[1] * cosine * (cosine * cosine - 3.0 * sine * sine));
  }
};

/// A circle about another point than the centre.
struct Egg : scarp::ConvexShape<Egg, 2> {
  template <class T>
  static T support(std::array<T, 2> const& size, T const& cosine, T const& sine) {
    return size[0] + size[1] * (0.6 * cosine + 0.8 * sine);
  }
};

/// An ellipse whose area is that of its rectangle.
struct Wide : Ellipse {
  static double content(Size<double> const& size) { return 4.0 * size[0] * size[1]; }
};

/// An ellipse whose inertia is wrong by the factor 2.
struct Heavy : Ellipse {
  static double gyration_squared(Size<double> const& size) { return 2.0 * Ellipse::gyration_squared(size); }
  template <class T>
  static scarp::ContactGeometry<2, T> touch(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                            Point<2, T> const& branch, Point<2, T> const& normal) {
    return Ellipse::touch(first, second, branch, normal);
  }
};

std::array<double, 2> axis(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

TEST_CASE("area, inertia and bounds follow from the support function") {
  for (auto const& size : {Ellipse::Size<double>{5e-3, 4e-3}, {5e-3, 1.5e-3}}) {
    CHECK(Oblong::content(size) == Approx(Ellipse::content(size)).epsilon(1e-9));
    CHECK(Oblong::gyration_squared(size) == Approx(Ellipse::gyration_squared(size)).epsilon(1e-9));
    CHECK(Oblong::bounding_radius(size) == Approx(Ellipse::bounding_radius(size)).epsilon(1e-8));
    CHECK(Oblong::eccentricity(size) == Approx(Ellipse::eccentricity(size)).epsilon(1e-6));
  }
  // Analytic: h = r (1 + e cos 3 phi) has the area pi r^2 (1 - 4 e^2) and the largest slope 3 r e.
  CHECK(Triangle::content({2.0, 0.1}) == Approx(std::numbers::pi * 4.0 * 0.96).epsilon(1e-12));
  CHECK(Triangle::bounding_radius({2.0, 0.1}) == Approx(2.2).epsilon(1e-8));
  CHECK(Triangle::eccentricity({2.0, 0.1}) == Approx(0.6).epsilon(1e-8));
  CHECK(Triangle::contact_radius(Triangle::pose<double>({2.0, 0.1}, axis(0.3))) == Approx(2.0).epsilon(1e-12));
}

TEST_CASE("a pair touches as ellipses with hand-made derivatives do") {
  scarp::Random random(3);
  for (int pair = 0; pair < 200; ++pair) {
    Ellipse::Size<double> const first{random.uniform(0.7, 1.3), random.uniform(0.4, 1.0)}, second{1.0, 0.6};
    auto const a = axis(random.uniform(0.0, 6.0)), b = axis(random.uniform(0.0, 6.0)),
               d = axis(random.uniform(0.0, 6.0));
    Point<2, double> const branch{1.5 * d[0], 1.5 * d[1]}, start{d[0], d[1]};
    auto const known = Ellipse::touch(Ellipse::pose(first, a), Ellipse::pose(second, b), branch, start);
    auto const found = Oblong::touch(Oblong::pose(first, a), Oblong::pose(second, b), branch, start);
    CHECK(std::abs(found.overlap - known.overlap) < 1e-12);
    for (std::size_t const k : {0U, 1U}) {
      CHECK(std::abs(found.normal[k] - known.normal[k]) < 1e-12);
      CHECK(std::abs(found.arm_first[k] - known.arm_first[k]) < 1e-12);
      CHECK(std::abs(found.arm_second[k] - known.arm_second[k]) < 1e-12);
    }
  }
}

TEST_CASE("grains whose two sides differ touch where their boundaries overlap least") {
  scarp::Random random(5);
  Triangle::Size<double> const size{1.0, 0.1};
  for (int k = 0; k < 100; ++k) {
    double const of_first = random.uniform(0.0, 6.0), of_second = random.uniform(0.0, 6.0);
    auto const d = axis(random.uniform(0.0, 6.0));
    auto const first = Triangle::pose<double>(size, axis(of_first)),
               second = Triangle::pose<double>(size, axis(of_second));
    double const distance = random.uniform(1.85, 2.1);
    Point<2, double> const branch{distance * d[0], distance * d[1]};
    auto const touch = scarp::converged_contact<Triangle>(first, second, branch, {d[0], d[1]});
    // Brute force by the formula: separation in ten thousand directions; the second grain is seen from its other side.
    auto const height = [](double angle) { return 1.0 + 0.1 * std::cos(3.0 * angle); };
    double least = 1e300;
    for (int direction = 0; direction < 10'000; ++direction) {
      double const angle = 2.0 * std::numbers::pi * direction / 10'000;
      double const apart = branch[0] * std::cos(angle) + branch[1] * std::sin(angle);
      least = std::min(least, height(angle - of_first) + height(angle + std::numbers::pi - of_second) - apart);
    }
    CHECK(std::abs(touch.overlap - least) < 1e-6);
    // Both support points lie half the overlap from the contact point, along the normal.
    auto const both = Triangle::supports<double>(first, second, touch.normal);
    double const reach = touch.arm_first[0] * touch.normal[0] + touch.arm_first[1] * touch.normal[1];
    CHECK(std::abs(both[0].value - reach - touch.overlap / 2.0) < 1e-9);
  }
}

TEST_CASE("grains that are not convex, are off their centre or have a wrong closed form are rejected") {
  CHECK_REFUSED(Triangle::check({1.0, 0.2}), "not convex", "radius of curvature is -0.6");
  CHECK_NOTHROW(Triangle::check({1.0, 0.12}));
  CHECK_REFUSED(Egg::check({1.0, 0.25}), "centre of mass 0.25 m");
  CHECK_NOTHROW(scarp::Population<Oblong>({{5e-3, 4e-3}}, 2650.0, 1.0));
  CHECK_REFUSED(scarp::Population<Wide>({{2.0, 1.0}}, 2650.0, 1.0), "content of a grain", "is 8 (", "has 6.28319");
  CHECK_REFUSED(scarp::Population<Heavy>({{5e-3, 4e-3}}, 2650.0, 1.0), "radius of gyration", "correct");
}

TEST_CASE("only discs and ellipses are drawn by their half axes") {
  using Law = scarp::LinearFrictional;
  static_assert(scarp::HasPicture<scarp::Packing<Ellipse, Law>>);
  static_assert(scarp::HasPicture<scarp::Packing<scarp::WithSpecies<Ellipse, 2>, Law>>);
  static_assert(!scarp::HasPicture<scarp::Packing<Triangle, Law>>);
}
