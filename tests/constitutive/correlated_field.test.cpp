// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/correlated_field.hpp"

#include <doctest/doctest.h>

#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Vector;

constexpr int realisations = 20'000;

/// Means over seeds of Z(x), Z(x)^2 and Z(x) Z(y), and the share of values within one standard deviation.
struct Moments {
  double mean = 0.0;
  double variance = 0.0;
  double product = 0.0;
  double within_one = 0.0;
};

template <int Dim>
Moments moments(Vector<Dim> const& lengths, Vector<Dim> const& x, Vector<Dim> const& y) {
  Moments sums;
  for (std::uint64_t seed = 1; seed <= realisations; ++seed) {
    scarp::CorrelatedField<Dim> const field({.lengths = lengths, .seed = seed, .waves = 50});
    double const here = field(x);
    sums.mean += here / realisations;
    sums.variance += here * here / realisations;
    sums.product += here * field(y) / realisations;
    sums.within_one += (std::abs(here) < 1.0 ? 1.0 : 0.0) / realisations;
  }
  return sums;
}

/// Deviations that a mean of independent values of unit variance exceeds once in 15000 draws.
double const sampling_error = 4.0 / std::sqrt(double{realisations});

template <int Dim>
void obeys_its_formulas(Vector<Dim> const& lengths, Vector<Dim> const& apart) {
  Vector<Dim> const x = Vector<Dim>::LinSpaced(3.0, -40.0);
  auto const found = moments<Dim>(lengths, x, x + apart);
  double const correlation = std::exp(-apart.cwiseQuotient(lengths).squaredNorm());
  MESSAGE("correlation " << found.product << " for " << correlation << ", mean " << found.mean << ", variance "
                         << found.variance);
  CHECK(std::abs(found.mean) < sampling_error);
  // Analytic: Z^2 has the variance 2, a product of two normal values 1 + rho^2.
  CHECK(std::abs(found.variance - 1.0) < std::sqrt(2.0) * sampling_error);
  CHECK(std::abs(found.product - correlation) < std::sqrt(1.0 + correlation * correlation) * sampling_error);
  // Analytic: erf(1/sqrt 2); fifty waves are so near to normal that the sampling error of a share, < 1/2, covers it.
  CHECK(std::abs(found.within_one - std::erf(std::sqrt(0.5))) < 0.5 * sampling_error);
}

}  // namespace

TEST_CASE("random fields have the mean, variance and correlation of their formulas, in the plane and in space") {
  Vector<2> const layered(20.0, 2.0);
  obeys_its_formulas<2>(layered, {10.0, 0.0});
  obeys_its_formulas<2>(layered, {5.0, -1.5});
  Vector<3> const in_space(8.0, 4.0, 1.0);
  obeys_its_formulas<3>(in_space, {2.0, 1.0, 0.5});
}

TEST_CASE("a field is a function of the place: one realisation averages over a large region, in any order") {
  scarp::CorrelatedField<2> const field({.lengths = {1.0, 1.0}, .seed = 5, .waves = 2000});
  scarp::CorrelatedField<2> const again({.lengths = {1.0, 1.0}, .seed = 5, .waves = 2000});
  double forth = 0.0;
  double squares = 0.0;
  constexpr int side = 60;
  constexpr double spacing = 3.0;  // correlation lengths: neighbours are independent, exp(-9)
  for (int k = 0; k < side * side; ++k) {
    double const value = field({spacing * (k % side), spacing * (k / side)});
    forth += value / (side * side);
    squares += value * value / (side * side);
  }
  for (int k = side * side - 1; k >= 0; k -= 97) {
    Vector<2> const place(spacing * (k % side), spacing * (k / side));
    CHECK(again(place) == field(place));
  }
  CHECK(std::abs(forth) < 4.0 / side);
  // N waves of equal height: the regional mean square keeps an error of about 1/sqrt(N) beside the sampling error.
  CHECK(std::abs(squares - 1.0) < 4.0 * (std::sqrt(2.0) / side + 1.0 / std::sqrt(2000.0)));
}

TEST_CASE("a lognormal quantity has the mean and the coefficient of variation that it names") {
  scarp::Lognormal const quantity{.mean = 20e6, .variation = 0.4};
  scarp::Random random(9);
  constexpr int draws = 200'000;
  double mean = 0.0;
  double squares = 0.0;
  for (int draw = 0; draw < draws; ++draw) {
    double const value = quantity.of(scarp::normal_vector<1>(random)(0)) / quantity.mean;
    mean += value / draws;
    squares += value * value / draws;
  }
  CHECK(std::abs(mean - 1.0) < 4.0 * 0.4 / std::sqrt(double{draws}));
  // Standard error of a standard deviation is v sqrt((k - 1)/(4 n)) with the kurtosis k = 5.9 at v = 0.4.
  CHECK(std::abs(std::sqrt(squares - mean * mean) - 0.4) < 4.0 * 0.4 * std::sqrt(4.9 / 4.0 / draws));
  CHECK(scarp::Lognormal{.mean = 3.0}.of(2.0) == 3.0);
}

TEST_CASE("fields without length or waves are refused") {
  using Field = scarp::CorrelatedField<2>;
  CHECK_REFUSED(Field({.lengths = {1.0, 0.0}}), "length", "is 0");
  CHECK_REFUSED(Field({.waves = 0}), "waves", "0");
}

TEST_CASE("a lognormal quantity without a positive mean, or with a negative variation, is refused") {
  CHECK_REFUSED(scarp::Lognormal{.mean = -1.0}.of(0.5), "mean of a lognormal quantity");
  CHECK_REFUSED((scarp::Lognormal{.mean = 1.0, .variation = -0.3}.of(0.5)), "variation of a lognormal quantity");
  CHECK_REFUSED((scarp::Lognormal{.mean = 1.0, .variation = std::nan("")}.of(0.5)), "variation", "is nan");
}
