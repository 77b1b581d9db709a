// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string_view>

namespace scarp {

namespace detail {
struct AnyVisit {
  template <class Member>
  void operator()(std::string_view, Member&&) const {}
};

/// A private member is saved under its name without the underscore.
constexpr std::string_view plain_name(std::string_view name) {
  if (name.ends_with('_')) name.remove_suffix(1);
  return name;
}
}  // namespace detail

/// members(self, visit): calls visit(name, member) for each member that a saved state consists of; a member whose
/// length the scene fixes is passed as a span. Where there is after_loading(), it is called once the members have been
/// read. A line in the class writes this function:
/// \code
/// SCARP_MEMBERS(stress, plastic_shear, tangent)   // all data members
/// SCARP_MEMBERS_EXCEPT((site), awake, own)        // all but those in brackets, which follow from the scene
/// \endcode
/// Where it is used, a data member that is in neither list is an error: the type "decomposes into" more elements than
/// are named.
template <class T>
concept Described = requires(T& value, detail::AnyVisit const& visit) {
  T::members(value, visit);
};

}  // namespace scarp

// Each member in turn, two dozen at most.
#define SCARP_DETAIL_AGAIN(...) SCARP_DETAIL_AGAIN2(SCARP_DETAIL_AGAIN2(SCARP_DETAIL_AGAIN2(__VA_ARGS__)))
#define SCARP_DETAIL_AGAIN2(...) SCARP_DETAIL_AGAIN1(SCARP_DETAIL_AGAIN1(SCARP_DETAIL_AGAIN1(__VA_ARGS__)))
#define SCARP_DETAIL_AGAIN1(...) SCARP_DETAIL_AGAIN0(SCARP_DETAIL_AGAIN0(SCARP_DETAIL_AGAIN0(__VA_ARGS__)))
#define SCARP_DETAIL_AGAIN0(...) __VA_ARGS__
#define SCARP_DETAIL_BRACKETS ()
#define SCARP_DETAIL_EACH(MACRO, ...) __VA_OPT__(SCARP_DETAIL_AGAIN(SCARP_DETAIL_EACH_FIRST(MACRO, __VA_ARGS__)))
#define SCARP_DETAIL_EACH_FIRST(MACRO, member, ...) \
  MACRO(member, __VA_ARGS__) __VA_OPT__(SCARP_DETAIL_EACH_NEXT SCARP_DETAIL_BRACKETS(MACRO, __VA_ARGS__))
#define SCARP_DETAIL_EACH_NEXT() SCARP_DETAIL_EACH_FIRST
#define SCARP_DETAIL_LISTED(member, ...) listed_##member __VA_OPT__(, )
#define SCARP_DETAIL_VISITED(member, ...) visit(::scarp::detail::plain_name(#member), self.member);
#define SCARP_DETAIL_THERE(member, ...) static_cast<void>(sizeof(self.member));
#define SCARP_DETAIL_WITHOUT_BRACKETS(...) __VA_ARGS__

/// For a function `members(self, visit)` written by hand: an error unless these are the names of all data members, in
/// any order. A structured binding has as many names as its type has members, and two equal names are rejected.
#define SCARP_ALL_MEMBERS(...)                                                         \
  [[maybe_unused]] auto& [SCARP_DETAIL_EACH(SCARP_DETAIL_LISTED, __VA_ARGS__)] = self; \
  SCARP_DETAIL_EACH(SCARP_DETAIL_THERE, __VA_ARGS__) static_assert(true)

/// Defines `members(self, visit)` of a class, see `Described`; the arguments are all its data members.
#define SCARP_MEMBERS(...)                               \
  template <class Self, class Visit>                     \
  static void members(Self& self, Visit&& visit) {       \
    SCARP_ALL_MEMBERS(__VA_ARGS__);                      \
    SCARP_DETAIL_EACH(SCARP_DETAIL_VISITED, __VA_ARGS__) \
  }

/// Defines `members(self, visit)` of a class, see `Described`; `left_out` are, in brackets, the data members that are
/// not saved.
#define SCARP_MEMBERS_EXCEPT(left_out, ...)                                               \
  template <class Self, class Visit>                                                      \
  static void members(Self& self, [[maybe_unused]] Visit&& visit) {                       \
    SCARP_ALL_MEMBERS(SCARP_DETAIL_WITHOUT_BRACKETS left_out __VA_OPT__(, ) __VA_ARGS__); \
    SCARP_DETAIL_EACH(SCARP_DETAIL_VISITED, __VA_ARGS__)                                  \
  }
