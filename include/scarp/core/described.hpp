// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string_view>

namespace scarp {

namespace detail {
struct AnyVisit {
  template <class Member>
  void operator()(std::string_view, Member&&) const {}
};
}  // namespace detail

/// members(self, visit): calls visit(name, member) for each member that a saved state consists of; a member whose length the
/// scene knows is passed as a span. Where there is after_loading(), it is called once the members have been read.
template <class T>
concept Described = requires(T& value, detail::AnyVisit const& visit) {
  T::members(value, visit);
};

}  // namespace scarp
