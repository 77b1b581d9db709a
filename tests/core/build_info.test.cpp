// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/build_info.hpp"

#include <doctest/doctest.h>

using scarp::BuildInfo;
using scarp::detail::version_number;

static_assert(version_number("12.34.5") == 12034);
static_assert(version_number("12.34.67") == version_number("12.34.5"), "the last number changes no layout");
static_assert(version_number("0.2.0") == 2);
static_assert(version_number("1.0") == 1000);

TEST_CASE("a build is described in one line") {
  BuildInfo const info{.compiler = "g++",
                       .compiler_version = "12.2.0",
                       .instruction_set = "x86-64-v2",
                       .beyond = "AVX",
                       .lanes = 4,
                       .optimised = true};
  CHECK(scarp::described(info) == "g++ 12.2.0, optimised, x86-64-v2 with AVX, 4 lanes in a pack");
  CHECK(scarp::slow_build_note(info).empty());
}

TEST_CASE("a build without optimisation says so") {
  BuildInfo info{.compiler = "g++", .instruction_set = "riscv64", .lanes = 1};
  CHECK(scarp::described(info) == "g++, NOT optimised, riscv64, 1 lane in a pack");
  info.checked_containers = true;
  CHECK(scarp::described(info) == "g++, NOT optimised, riscv64, 1 lane in a pack, checked containers");
  CHECK(scarp::slow_build_note(info).find("without optimisation") != std::string_view::npos);
}
