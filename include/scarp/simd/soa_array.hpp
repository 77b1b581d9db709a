// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <vector>

#include "scarp/core/index.hpp"

namespace scarp {

/// Allocates whole cache lines, so that no vector register's load or store straddles two of them.
/// \tparam T any element
template <class T>
struct CacheLineAllocator {
  using value_type = T;                        ///< of one element
  static constexpr std::align_val_t line{64};  ///< alignment [bytes], one cache line

  CacheLineAllocator() = default;
  /// Allocators have no state, so those of different types are interchangeable.
  template <class Other>
  CacheLineAllocator(CacheLineAllocator<Other> const&) {}

  /// Memory of `count` elements, aligned to a cache line.
  /// \throws std::bad_alloc
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), line)); }
  /// Returns memory to the system; the number of elements is not needed.
  void deallocate(T* values, std::size_t) { ::operator delete(values, line); }

  friend bool operator==(CacheLineAllocator const&, CacheLineAllocator const&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;  ///< std::vector that starts on a cache line.

/// `Count` arrays of equal length in one block (structure of arrays). Each column is padded with the fill value to
/// full vectors of 64 bytes so that vector loops need no tail. `Count` zero needs no memory.
/// \tparam Scalar type of a value
/// \tparam Count number of columns, at least 0
template <class Scalar, int Count>
class SoaArray {
 public:
  static constexpr std::size_t padding = sizeof(Scalar) < 8 ? 16 : 8;  ///< rows are padded to a multiple of this

  /// Discards all values: rows and padding have the fill value after it.
  /// \throws std::bad_alloc
  void resize(std::size_t rows, Scalar fill = Scalar(0)) {
    rows_ = rows;
    stride_ = (rows + padding - 1) / padding * padding;
    values_.assign(stride_ * Count, fill);
  }

  std::size_t rows() const { return rows_; }           ///< Rows without the padding.
  std::size_t padded_rows() const { return stride_; }  ///< Rows with the padding, which is the length of a column.

  /// First element of column k; rows lie side by side.
  Scalar* column(int k) { return values_.data() + detail::index(k) * stride_; }
  /// First element of column k; rows lie side by side.
  Scalar const* column(int k) const { return values_.data() + detail::index(k) * stride_; }

  Scalar& operator()(std::size_t row, int k) { return column(k)[row]; }  ///< One element; indices are not checked.
  /// One element; indices are not checked.
  Scalar operator()(std::size_t row, int k) const { return column(k)[row]; }

  /// One value of each column.
  std::array<Scalar, detail::index(Count)> row(std::size_t r) const {
    std::array<Scalar, detail::index(Count)> values{};
    for (int k = 0; k < Count; ++k) values[detail::index(k)] = (*this)(r, k);
    return values;
  }

  /// One value for each column.
  void set_row(std::size_t r, std::array<Scalar, detail::index(Count)> const& values) {
    for (int k = 0; k < Count; ++k) (*this)(r, k) = values[detail::index(k)];
  }

  /// Reserved on the heap, padding included.
  std::size_t bytes() const { return values_.capacity() * sizeof(Scalar); }

  friend bool operator==(SoaArray const&, SoaArray const&) = default;

 private:
  AlignedVector<Scalar> values_;
  std::size_t rows_ = 0;
  std::size_t stride_ = 0;
};

/// Rows without columns.
template <class Scalar>
class SoaArray<Scalar, 0> {
 public:
  void resize(std::size_t, Scalar = Scalar(0)) {}              ///< Has no effect.
  std::array<Scalar, 0> row(std::size_t) const { return {}; }  ///< An empty array.
  void set_row(std::size_t, std::array<Scalar, 0> const&) {}   ///< Has no effect.
  std::size_t bytes() const { return 0; }                      ///< Zero: nothing is stored.
  friend bool operator==(SoaArray const&, SoaArray const&) = default;
};

}  // namespace scarp
