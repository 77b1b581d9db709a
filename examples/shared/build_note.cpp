// SPDX-License-Identifier: BSL-1.0
// In every example and benchmark: reports on stderr, before main, when the program was compiled without optimisation.
#include <cstdio>

#include "scarp/core/build_info.hpp"

namespace {

[[maybe_unused]] bool const reported = [] {
  constexpr auto note = scarp::slow_build_note(scarp::build_info());
  if (!note.empty()) std::fprintf(stderr, "scarp: %.*s\n", static_cast<int>(note.size()), note.data());
  return !note.empty();
}();

}  // namespace
