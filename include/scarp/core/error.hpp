// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "scarp/core/named_member.hpp"
#include "scarp/core/one_version.hpp"

SCARP_NAMED_MEMBER(validate)

namespace scarp {

namespace detail {
/// Text of a damaged file must neither end a message early nor steer the terminal that shows it.
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
  /// Control characters other than line feed and tab become question marks.
  explicit InputError(std::string text) : std::invalid_argument(detail::without_control_characters(std::move(text))) {}
};

namespace detail {
[[noreturn]] inline void reject_formatted(fmt::string_view text, fmt::format_args arguments) {
  throw InputError(fmt::vformat(text, arguments));
}
}  // namespace detail

/// Rejects an input with a message "problem (why): suggestion".
/// \throws InputError always, with the formatted text
template <class... Arguments>
[[noreturn]] void reject(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  detail::reject_formatted(text, fmt::make_format_args(arguments...));
}

/// A number that must be positive, returned; `what` names it in the message.
/// \throws InputError unless value is finite and above zero
inline double require_positive(std::string_view what, double value) {
  if (!(std::isfinite(value) && value > 0.0)) {
    reject("{} is {} (it must be finite and above zero): give a positive number", what, value);
  }
  return value;
}

/// A number that must not be negative, returned; `what` names it in the message.
/// \throws InputError unless value is finite and not below zero
inline double require_not_negative(std::string_view what, double value) {
  if (!(std::isfinite(value) && value >= 0.0)) {
    reject("{} is {} (it must be finite and not negative): give zero or a positive number", what, value);
  }
  return value;
}

/// A number that must lie in a closed range, returned; `what` names it in the message.
/// \throws InputError unless value lies between the two, which it may equal; NaN never does
template <class Number>
Number require_between(std::string_view what, Number value, Number least, Number most) {
  if (!(value >= least && value <= most)) {
    reject("{} is {} (it must lie between {} and {}): give a number in this range", what, value, least, most);
  }
  return value;
}

/// A number that has a least value, returned; `what` names it in the message.
/// \throws InputError for a value below the least one, and for NaN
template <class Number>
Number require_at_least(std::string_view what, Number value, Number least) {
  if (!(value >= least)) reject("{} is {} (it must be at least {}): give a larger number", what, value, least);
  return value;
}

/// A number that must be finite, returned; `what` names it in the message.
/// \throws InputError unless value is finite
inline double require_finite(std::string_view what, double value) {
  if (!std::isfinite(value)) {
    reject("{} is {} (it must be finite): give an ordinary number", what, value);
  }
  return value;
}

namespace detail {
/// Settings after a check by their own `void validate() const`, where they have one.
template <class Settings>
Settings const& validated(Settings const& settings) {
  if constexpr (requires { settings.validate(); }) {
    settings.validate();
  } else {
    static_assert(!names_validate<Settings>, "scarp: validate is never called: it needs `void validate() const`");
  }
  return settings;
}
}  // namespace detail

/// The elements of a range as text, each by the same format. A source that calls fmt::join instead compiles all of
/// fmt's formatting anew.
template <class Range>
std::string listed(Range const& range, std::string_view between = ", ", std::string_view each = "{}") {
  std::string text;
  bool first = true;
  for (auto const& element : range) {
    if (!first) text += between;
    first = false;
    text += fmt::vformat(each, fmt::make_format_args(element));
  }
  return text;
}

}  // namespace scarp
