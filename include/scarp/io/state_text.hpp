// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scarp/core/columns.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/tensor.hpp"

namespace scarp {

/// Writes the members that a described type names as text for people, a line each, parts indented. Of long lists their
/// length and the first few.
class StateText {
 public:
  template <class T>
    requires std::is_arithmetic_v<T>
  void operator()(std::string_view name, T const& value) { line(name, fmt::format("{}", value)); }

  /// By its name, where name(value) tells one.
  template <class T>
    requires std::is_enum_v<T>
  void operator()(std::string_view title, T const& value) {
    if constexpr (requires { std::string_view(name(value)); }) {
      line(title, name(value));
    } else {
      line(title, fmt::format("{}", static_cast<long long>(value)));
    }
  }
  void operator()(std::string_view name, std::string const& text) { line(name, '"' + text + '"'); }

  template <class T, int Rows, int Columns>
  void operator()(std::string_view name, Eigen::Matrix<T, Rows, Columns> const& matrix) {
    std::string rows;
    for (int i = 0; i < matrix.rows(); ++i) {
      for (int j = 0; j < matrix.cols(); ++j)
        rows += fmt::format("{}{}", j > 0 ? ", " : (i > 0 ? "; " : ""), matrix(i, j));
    }
    line(name, rows);
  }
  template <class T, std::size_t Count>
  void operator()(std::string_view name, std::array<T, Count> const& values) {
    list(name, std::span<T const>(values));
  }
  template <class T, class Allocator>
  void operator()(std::string_view name, std::vector<T, Allocator> const& values) {
    list(name, std::span<T const>(values));
  }
  template <class T>
  void operator()(std::string_view name, std::span<T> values) {
    list(name, std::span<T const>(values));
  }
  template <class Scalar, int Count>
  void operator()(std::string_view name, scarp::Columns<Scalar, Count> const& columns) {
    if constexpr (Count > 0) line(name, fmt::format("{} rows of {}", columns.rows(), Count));
  }
  template <class T>
  void operator()(std::string_view name, std::shared_ptr<T const> const& shared) {
    if (!shared) return line(name, "none");
    (*this)(name, *shared);
  }
  template <class First, class Second>
  void operator()(std::string_view name, std::pair<First, Second> const& both) {
    part(name, [&] {
      (*this)("first", both.first);
      (*this)("second", both.second);
    });
  }
  template <Described T>
  void operator()(std::string_view name, T const& value) {
    part(name, [&] { T::members(value, *this); });
  }

  std::string const& text() const { return text_; }

 private:
  static constexpr std::size_t shown = 6;  ///< elements of a list

  void line(std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), "{:{}}{}: {}\n", "", 2 * depth_, name, value);
  }

  template <class Inside>
  void part(std::string_view name, Inside const& inside) {
    fmt::format_to(std::back_inserter(text_), "{:{}}{}:\n", "", 2 * depth_, name);
    ++depth_;
    inside();
    --depth_;
  }

  template <class T>
  void list(std::string_view name, std::span<T const> values) {
    auto const first = values.first(std::min(shown, values.size()));
    std::string_view const rest = values.size() > shown ? ", ..." : "";
    if constexpr (std::is_arithmetic_v<T>) {
      std::string row;
      for (T const& value : first) row += fmt::format("{}{}", row.empty() ? "" : ", ", +value);
      line(name, values.size() > shown ? fmt::format("{} numbers: {}{}", values.size(), row, rest) : row);
    } else {
      part(fmt::format("{}, {} of them", name, values.size()), [&] {
        for (std::size_t k = 0; k < first.size(); ++k) (*this)(fmt::format("{}", k), first[k]);
      });
    }
  }

  std::string text_;
  int depth_ = 0;
};

/// The members of a state as text. A list of members is thereby what is saved, sent and read alike.
template <Described State>
std::string state_text(State const& state) {
  StateText text;
  State::members(state, text);
  return text.text();
}

}  // namespace scarp
