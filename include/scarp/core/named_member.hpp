// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

/// Defines the concept `names_MEMBER`: whether a class has a member of this name, of whatever kind: a function, a
/// template of one, data. Optional members are found by the way they are called, so that one that is declared otherwise
/// would be passed over in silence; where it is named and cannot be called, the check of its part is an error.
/// Two base classes with members of one name make the name ambiguous. A final class has no derived one: there,
/// functions that are overloaded and templates are not found.
#define SCARP_NAMED_MEMBER(MEMBER)                       \
  namespace scarp::detail {                              \
  struct Only_##MEMBER {                                 \
    int MEMBER;                                          \
  };                                                     \
  template <class Part>                                  \
  struct Two_##MEMBER : Part, Only_##MEMBER {};          \
  template <class Part>                                  \
  consteval bool finds_##MEMBER() {                      \
    if constexpr (!std::is_class_v<Part>) {              \
      return false;                                      \
    } else if constexpr (std::is_final_v<Part>) {        \
      return requires { &Part::MEMBER; };                \
    } else {                                             \
      return !requires { &Two_##MEMBER<Part>::MEMBER; }; \
    }                                                    \
  }                                                      \
  template <class Part>                                  \
  concept names_##MEMBER = finds_##MEMBER<Part>();       \
  }
