// SPDX-License-Identifier: BSL-1.0
#include "scarp/simd/soa_array.hpp"

#include <doctest/doctest.h>

#include <type_traits>

using scarp::SoaArray;

static_assert(std::is_empty_v<SoaArray<double, 0>>, "no columns must take no memory");
static_assert(SoaArray<double, 2>::padding % 8 == 0, "the widest vector register of doubles must fit in the padding");

namespace {

template <class Array>
Array filled(std::size_t rows, double fill) {
  Array array;
  array.resize(rows, fill);
  return array;
}

}  // namespace

TEST_CASE("columns are padded with the fill value to full registers") {
  auto columns = filled<SoaArray<double, 2>>(9, 3.5);
  CHECK(columns.rows() == 9);
  CHECK(columns.padded_rows() > 9);
  CHECK(columns.padded_rows() % SoaArray<double, 2>::padding == 0);
  for (int k = 0; k < 2; ++k) {
    for (std::size_t r = 0; r < columns.padded_rows(); ++r) CHECK(columns.column(k)[r] == 3.5);
  }
}

TEST_CASE("a row set is a row read and touches no other row") {
  SoaArray<float, 3> columns;
  columns.resize(5);
  columns.set_row(3, {1.0F, 2.0F, 3.0F});
  CHECK(columns.row(3) == std::array<float, 3>{1.0F, 2.0F, 3.0F});
  CHECK(columns(3, 1) == 2.0F);
  CHECK(columns.row(2) == std::array<float, 3>{});
  CHECK(columns.row(4) == std::array<float, 3>{});
}

TEST_CASE("columns are equal when size and values are") {
  auto first = filled<SoaArray<double, 1>>(4, 1.0);
  auto second = filled<SoaArray<double, 1>>(4, 1.0);
  CHECK(first == second);
  second(2, 0) = 2.0;
  CHECK_FALSE(first == second);
  CHECK_FALSE(first == filled<SoaArray<double, 1>>(5, 1.0));
}

TEST_CASE("resizing forgets the old values") {
  auto columns = filled<SoaArray<double, 1>>(3, 7.0);
  columns.resize(12);
  for (std::size_t r = 0; r < 12; ++r) CHECK(columns(r, 0) == 0.0);
}
