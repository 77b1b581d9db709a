// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstdint>

#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "scarp/dem/packing.hpp"

namespace scarp::detail {

/// Plain numbers and arrays of them.
template <class T>
concept Bits = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

/// All values of the columns, their padding too: it takes part in comparisons.
template <class Scalar, int Count>
std::size_t value_count(Columns<Scalar, Count> const& columns) {
  return columns.padded_rows() * static_cast<std::size_t>(Count);
}

/// Appends the bits of the members that a packing names, arrays behind their length.
class BitWriter {
 public:
  template <Bits T>
  void put(T const* values, std::size_t count = 1) {
    if (count > 0) bits_.append(reinterpret_cast<char const*>(values), count * sizeof(T));
  }

  void put_length(std::size_t length) {
    auto const stored = static_cast<std::uint64_t>(length);
    put(&stored);
  }

  template <Bits T>
  void operator()(std::string_view, T const& value) {
    put(&value);
  }
  template <Bits T>
  void operator()(std::string_view, std::vector<T> const& values) {
    put_length(values.size());
    put(values.data(), values.size());
  }
  template <class Scalar, int Count>
  void operator()(std::string_view, Columns<Scalar, Count> const& columns) {
    if constexpr (Count > 0) {
      put_length(columns.rows());
      put(columns.column(0), value_count(columns));
    }
  }
  template <class Scalar, int Dim>
  void operator()(std::string_view, Eigen::Matrix<Scalar, Dim, Dim> const& tensor) {
    put(tensor.data(), static_cast<std::size_t>(Dim * Dim));
  }
  /// Content is stored beside the sizes to tell shapes apart that have equally many.
  template <class Shape, class Scalar>
  void operator()(std::string_view, std::shared_ptr<Population<Shape, Scalar> const> const& population) {
    (*this)("density", population->density());
    (*this)("thickness", population->thickness());
    (*this)("content", population->content());
    (*this)("sizes", population->sizes());
  }
  template <int Dim>
  void operator()(std::string_view, LastMove<Dim> const& move) {
    move.members(move, *this);
  }
  template <class Shape, class Law, class Scalar>
  void operator()(std::string_view, NearPairs<Shape, Law, Scalar> const& pairs) {
    pairs.members(pairs, *this);
  }

  std::string const& bits() const { return bits_; }

 private:
  std::string bits_;
};

/// Takes members off bits in the order of the writer.
/// \throws InputError naming the member where the bits end too early or hold what no packing has
class BitReader {
 public:
  explicit BitReader(std::string_view bits) : rest_(bits) {}

  bool at_end() const { return rest_.empty(); }

  template <Bits T>
  void take(std::string_view name, T* values, std::size_t count = 1) {
    if (count > rest_.size() / sizeof(T)) {
      refuse("it ends inside '{}' (for {} numbers of {} bytes only {} bytes are left): save it again", name, count,
             sizeof(T), rest_.size());
    }
    if (count > 0) std::memcpy(values, rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
  }

  /// A length that the rest has room for, so that no damage asks for endless memory.
  template <Bits T>
  std::size_t take_length(std::string_view name) {
    std::uint64_t length = 0;
    take(name, &length);
    if (length > rest_.size() / sizeof(T)) {
      refuse("'{}' has a length of {} (only {} bytes follow): save it again", name, length, rest_.size());
    }
    return static_cast<std::size_t>(length);
  }

  template <Bits T>
  void operator()(std::string_view name, T& value) {
    take(name, &value);
  }
  template <Bits T>
  void operator()(std::string_view name, std::vector<T>& values) {
    values.resize(take_length<T>(name));
    take(name, values.data(), values.size());
  }
  template <class Scalar, int Count>
  void operator()(std::string_view name, Columns<Scalar, Count>& columns) {
    if constexpr (Count > 0) {
      columns.resize(take_length<Scalar>(name));
      take(name, columns.column(0), value_count(columns));
    }
  }
  template <class Scalar, int Dim>
  void operator()(std::string_view name, Eigen::Matrix<Scalar, Dim, Dim>& tensor) {
    take(name, tensor.data(), static_cast<std::size_t>(Dim * Dim));
  }
  template <class Shape, class Scalar>
  void operator()(std::string_view, std::shared_ptr<Population<Shape, Scalar> const>& population) {
    double density = 0.0;
    double thickness = 0.0;
    double content = 0.0;
    Columns<Scalar, Shape::size_count> stored;
    (*this)("density", density);
    (*this)("thickness", thickness);
    (*this)("content", content);
    (*this)("sizes", stored);
    std::vector<typename Population<Shape, Scalar>::Size> sizes(stored.rows());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      for (std::size_t k = 0; k < sizes[i].size(); ++k) {
        sizes[i][k] = static_cast<double>(stored(i, static_cast<int>(k)));
      }
    }
    population = std::make_shared<Population<Shape, Scalar> const>(sizes, density, thickness);
    constexpr double round_off = 1e-12;  // sums of the same numbers by another compiler's code
    if (!(std::abs(content - population->content()) <= round_off * population->content())) {
      refuse(
          "its grains have a content of {} (of the shape asked for they would have {}): load it as the shape that was "
          "saved",
          content, population->content());
    }
  }
  template <int Dim>
  void operator()(std::string_view, LastMove<Dim>& move) {
    move.members(move, *this);
  }
  template <class Shape, class Law, class Scalar>
  void operator()(std::string_view, NearPairs<Shape, Law, Scalar>& pairs) {
    pairs.members(pairs, *this);
  }

 private:
  std::string_view rest_;
};

}  // namespace scarp::detail
