// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "scarp/core/one_version.hpp"

namespace scarp {

namespace detail {
/// What a damaged file says must neither end a message early nor steer the terminal that shows it.
inline std::string without_control_characters(std::string text) {
  for (char& letter : text) {
    bool const control = static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
    if (control && letter != '\n' && letter != '\t') letter = '?';
  }
  return text;
}
}  // namespace detail

/// Wrong input at a boundary of the library; the text reads "problem (why): suggestion".
class InputError : public std::invalid_argument {
 public:
  explicit InputError(std::string text) : std::invalid_argument(detail::without_control_characters(std::move(text))) {}
};

namespace detail {
[[noreturn]] inline void throw_input_error(fmt::string_view text, fmt::format_args arguments) {
  throw InputError(fmt::vformat(text, arguments));
}
}  // namespace detail

/// \throws InputError always, with the formatted text
template <class... Arguments>
[[noreturn]] void refuse(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  detail::throw_input_error(text, fmt::make_format_args(arguments...));
}

/// \throws InputError unless value is finite and above zero
inline double require_positive(std::string_view what, double value) {
  if (!(std::isfinite(value) && value > 0.0)) {
    refuse("{} is {} (it must be finite and above zero): give a positive number", what, value);
  }
  return value;
}

/// \throws InputError unless value is finite and not below zero
inline double require_not_negative(std::string_view what, double value) {
  if (!(std::isfinite(value) && value >= 0.0)) {
    refuse("{} is {} (it must be finite and not negative): give zero or a positive number", what, value);
  }
  return value;
}

/// \throws InputError unless value is finite
inline double require_finite(std::string_view what, double value) {
  if (!std::isfinite(value)) {
    refuse("{} is {} (it must be finite): give an ordinary number", what, value);
  }
  return value;
}

}  // namespace scarp
