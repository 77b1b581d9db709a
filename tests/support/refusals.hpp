// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <initializer_list>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/core/error.hpp"

/// What wrong input is refused with. A type of exception alone says nothing: any other refusal on the way has it, too.
namespace samples {

/// The message of the exception that an action throws; empty when it throws none.
template <class Error = scarp::InputError, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (Error const& error) {
    return error.what();
  }
  return {};
}

inline bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// Equal to a message that has all these parts in it: the quantity, its value, its place.
class Naming {
 public:
  Naming(std::initializer_list<std::string_view> parts) : parts_(parts.begin(), parts.end()) {}

  friend bool operator==(std::string const& message, Naming const& other) {
    return std::all_of(other.parts_.begin(), other.parts_.end(),
                       [&](auto const& part) { return contains(message, part); });
  }
  friend std::ostream& operator<<(std::ostream& out, Naming const& other) {
    out << "a message with";
    for (auto const& part : other.parts_) out << " '" << part << "'";
    return out;
  }

 private:
  std::vector<std::string> parts_;
};

}  // namespace samples

/// CHECK_REFUSED(expression, part...): an InputError whose message has all the parts in it.
#define CHECK_REFUSED(expression, ...) \
  CHECK(samples::message_of([&] { static_cast<void>(expression); }) == samples::Naming({__VA_ARGS__}))
