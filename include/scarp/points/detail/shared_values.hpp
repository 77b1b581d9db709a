// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/executor.hpp"

namespace scarp::detail {

/// Eigen's matrices of fixed size are copied by functions of their own; their numbers lie side by side.
template <class Scalar, int Rows, int Columns, int Options>
struct LyingInMemory<Eigen::Matrix<Scalar, Rows, Columns, Options, Rows, Columns>> {
  using Value = Eigen::Matrix<Scalar, Rows, Columns, Options, Rows, Columns>;
  static_assert(Rows > 0 && Columns > 0, "scarp: values that ranks share own no memory");
  static constexpr std::size_t size = sizeof(Scalar) * static_cast<std::size_t>(Rows * Columns);
  static void write(Value const& value, std::byte* to) { std::memcpy(to, value.data(), size); }
  static void read(std::byte const* from, Value& value) { std::memcpy(value.data(), from, size); }
};

template <int Dim>
struct LyingInMemory<Response<Dim>> {
  using Stress = LyingInMemory<VoigtStress<Dim>>;
  using Outcome = LyingInMemory<Verdict>;
  static constexpr std::size_t size = Stress::size + Outcome::size;
  static void write(Response<Dim> const& value, std::byte* to) {
    Stress::write(value.stress, to);
    Outcome::write(value.verdict, to + Stress::size);
  }
  static void read(std::byte const* from, Response<Dim>& value) {
    Stress::read(from, value.stress);
    Outcome::read(from + Stress::size, value.verdict);
  }
};

}  // namespace scarp::detail
