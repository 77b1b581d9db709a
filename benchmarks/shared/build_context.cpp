// SPDX-License-Identifier: BSL-1.0
// In every program of Google Benchmark: the head of its output says how the program was compiled.
#include <benchmark/benchmark.h>

#include "scarp/core/build_info.hpp"

namespace {

[[maybe_unused]] bool const declared = [] {
  benchmark::AddCustomContext("scarp", std::string(scarp::version));
  benchmark::AddCustomContext("scarp_build", scarp::described(scarp::build_info()));
  return true;
}();

}  // namespace
