// SPDX-License-Identifier: BSL-1.0
#include "scarp/simd/pack.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "scarp/simd/quads.hpp"
#include "scarp/simd/select.hpp"

namespace lanes = scarp::lanes;

// The widths of every register, whichever one this source is compiled for.
#define EVERY_PACK                                                                                                    \
  lanes::BasicPack<double, 1>, lanes::BasicPack<double, 2>, lanes::BasicPack<double, 4>, lanes::BasicPack<double, 8>, \
      lanes::BasicPack<float, 4>, lanes::BasicPack<float, 8>

namespace {

/// The same number to the last bit and the sign of zero; nothing is said of the bits of what is not a number.
template <class Scalar>
bool same(Scalar a, Scalar b) {
  using Bits = std::conditional_t<sizeof(Scalar) == 8, std::uint64_t, std::uint32_t>;
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

/// Numbers of every kind, in pairs of all with all.
template <class Pack>
struct EveryPair {
  using Scalar = typename Pack::value_type;
  using Limits = std::numeric_limits<Scalar>;
  static constexpr std::array<Scalar, 12> kinds{
      Scalar(0),     Scalar(-0.0),  Scalar(1.5),      Scalar(-2.25),      Scalar(0.1),         Scalar(-7e9),
      Limits::min(), Limits::max(), Limits::lowest(), Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()};

  /// check(packs of a and b); lanes hold neighbouring pairs.
  template <class Check>
  static void check(Check const& check) {
    constexpr std::size_t count = kinds.size() * kinds.size();
    for (std::size_t start = 0; start < count; start += Pack::size()) {
      Pack a(0);
      Pack b(0);
      for (std::size_t lane = 0; lane < Pack::size(); ++lane) {
        a.vector[lane] = kinds[(start + lane) % count / kinds.size()];
        b.vector[lane] = kinds[(start + lane) % kinds.size()];
      }
      check(a, b);
    }
  }
};

/// of_packs(a, b) is of_numbers(a, b) in every lane.
template <class Pack, class OfPacks, class OfNumbers>
bool lanes_agree(OfPacks const& of_packs, OfNumbers const& of_numbers) {
  bool agree = true;
  EveryPair<Pack>::check([&](Pack const& a, Pack const& b) {
    auto const values = of_packs(a, b);
    for (std::size_t lane = 0; lane < Pack::size(); ++lane) {
      auto const expected = of_numbers(a[lane], b[lane]);
      if constexpr (std::is_same_v<decltype(expected), bool const>) {
        agree = agree && values[lane] == expected;
      } else {
        agree = agree && same(values[lane], expected);
      }
    }
  });
  return agree;
}

/// One generic function for packs and numbers.
template <class Pack, class Operation>
bool lanes_agree(Operation const& operation) {
  return lanes_agree<Pack>(operation, operation);
}

}  // namespace

static_assert(std::is_same_v<lanes::Pack<double>, lanes::BasicPack<double, lanes::lane_count<double>>>);
static_assert(std::is_convertible_v<float, lanes::Pack<double>>);
static_assert(std::is_convertible_v<int, lanes::Pack<float>>);
static_assert(!std::is_convertible_v<double, lanes::Pack<float>>, "a pack of single precision would round it");
static_assert(std::is_constructible_v<lanes::Pack<float>, double>, "unless a user requests it");
static_assert(!std::is_constructible_v<lanes::Pack<float>, long>, "and of no other number");
static_assert(!std::is_convertible_v<lanes::Pack<double>, double>);
static_assert(std::is_trivially_copyable_v<lanes::Pack<double>>);

TEST_CASE_TEMPLATE("arithmetic of packs is that of numbers, to the last bit", Pack, EVERY_PACK) {
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a + b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a - b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a * b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a / b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return -a; }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return +a; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a += b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a -= b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a *= b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a /= b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return 2 * a; }));
}

TEST_CASE_TEMPLATE("comparisons of packs are those of numbers, none holds for what is not a number but !=", Pack,
                   EVERY_PACK) {
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a == b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a != b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a < b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a <= b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a > b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a >= b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return !(a < b); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a < b && b == b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return a < b || a == a; }));
}

TEST_CASE_TEMPLATE("selection and bounds of packs are those of numbers, with signs of zero and what is not a number",
                   Pack, EVERY_PACK) {
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return lanes::select(a < b, a, b); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return lanes::select(a < b || b != b, b, a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return lanes::at_least(a, b); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return lanes::at_most(a, b); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return min(a, b); }, [](auto a, auto b) { return a < b ? a : b; }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return max(a, b); }, [](auto a, auto b) { return a > b ? a : b; }));
  CHECK(lanes_agree<Pack>(
      [](auto a, auto b) {
        return lanes::select(a < b, std::array{a, b}, std::array{b, a})[1];
      },
      [](auto a, auto b) { return a < b ? b : a; }));
}

TEST_CASE_TEMPLATE("functions of packs are those of numbers, lane by lane", Pack, EVERY_PACK) {
  // Exact: one instruction rounds a root as the other does, the rest are changes of sign or the same function.
  using std::abs, std::copysign, std::sqrt, std::pow, std::atan2, std::hypot, std::cbrt, std::exp, std::log, std::tanh,
      std::sin, std::cos, std::tan, std::asin, std::acos, std::atan, std::floor, std::ceil;
  CHECK(lanes_agree<Pack>([](auto a, auto) { return abs(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return copysign(a, b); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return sqrt(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return pow(a, b); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return atan2(a, b); }));
  CHECK(lanes_agree<Pack>([](auto a, auto b) { return hypot(a, b); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return cbrt(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return exp(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return log(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return tanh(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return sin(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return cos(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return tan(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return asin(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return acos(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return atan(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return floor(a); }));
  CHECK(lanes_agree<Pack>([](auto a, auto) { return ceil(a); }));
}

TEST_CASE_TEMPLATE("packs are made, read and written lane by lane", Pack, EVERY_PACK) {
  using Scalar = typename Pack::value_type;
  constexpr std::size_t width = Pack::size();
  CHECK(all_of(Pack{} == Pack(0)));
  CHECK(std::signbit(Pack(Scalar(-0.0))[width - 1]));

  std::array<Scalar, width + 2> numbers;
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<Scalar>(k + 1);
  auto const loaded = lanes::load<Scalar, width>(numbers.data() + 1);  // as a rule not on a boundary of vectors
  Pack assigned(0);
  for (std::size_t lane = 0; lane < width; ++lane) {
    CHECK(loaded[lane] == numbers[lane + 1]);
    assigned.vector[lane] = numbers[lane + 1];
  }
  CHECK(all_of(assigned == loaded));
  lanes::store(loaded * Pack(10), numbers.data() + 1);
  CHECK(numbers.front() == Scalar(1));
  for (std::size_t lane = 0; lane < width; ++lane) CHECK(numbers[lane + 1] == 10 * loaded[lane]);
  CHECK(numbers.back() == static_cast<Scalar>(width + 2));

  assigned.vector[0] = assigned[width - 1];
  CHECK(assigned[0] == static_cast<Scalar>(width + 1));
}

TEST_CASE_TEMPLATE("masks tell of any, all and none, and packs their greatest lane", Pack, EVERY_PACK) {
  using Scalar = typename Pack::value_type;
  auto const never = Pack(1) < Pack(0);
  CHECK(!any_of(never));
  CHECK(none_of(never));
  CHECK(!all_of(never));
  CHECK(all_of(!never));
  for (std::size_t at = 0; at < Pack::size(); ++at) {
    Pack one_lane(-1);
    one_lane.vector[at] = Scalar(3);
    CHECK(hmax(one_lane) == Scalar(3));
    CHECK(any_of(one_lane > Pack(0)));
    CHECK(!none_of(one_lane > Pack(0)));
    CHECK(all_of(one_lane > Pack(0)) == (Pack::size() == 1));
    CHECK(!all_of(one_lane < Pack(0)));
  }
}

TEST_CASE_TEMPLATE("quads are rows of four numbers, read and written for all lanes", Pack, EVERY_PACK) {
  using Scalar = typename Pack::value_type;
  constexpr std::size_t width = Pack::size();
  std::array<Scalar, 4 * width> rows;
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = static_cast<Scalar>(k);
  auto const columns = lanes::from_quads<Scalar, width>(
      [&](std::size_t lane) { return lanes::FourScalars<Scalar>::read(rows.data() + 4 * lane); });
  auto const quads = lanes::to_quads<Scalar, width>(columns);
  for (std::size_t lane = 0; lane < width; ++lane) {
    for (std::size_t c = 0; c < 4; ++c) {
      CHECK(columns[c][lane] == rows[4 * lane + c]);
      CHECK(quads[lane].value[c] == rows[4 * lane + c]);
    }
  }
}
