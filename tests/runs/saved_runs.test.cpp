// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "runs/watched_block.hpp"
#include "support/files.hpp"

using samples::ScratchFolder;

TEST_CASE(
    "what is saved comes back from checkpoints: every adaptor around every adaptor, and all that observers remember") {
  watched::for_each_case([](std::string const& name, auto const& provider, watched::Pull const& wanted) {
    CAPTURE(name);
    scarp::SerialExecutor serial;
    ScratchFolder const folder;
    auto const whole = watched::pull(provider, serial, folder / "whole", wanted);
    auto const parts = watched::pull_in_parts(provider, serial, folder / "parts", wanted);
    CHECK(whole.report.verdict.acceptable());
    CHECK(whole.report.steps > 4);
    CHECK(parts.report.steps == whole.report.steps);
    CHECK(parts.report.iterations == whole.report.iterations);
    CHECK(parts.states == whole.states);
    CHECK(parts.budget == whole.budget);
    CHECK(whole.files.size() >= 8);
    for (auto const& written : whole.files) {
      CAPTURE(written.first);
      REQUIRE(parts.files.contains(written.first));
      CHECK(parts.files.at(written.first) == written.second);
    }
  });
}
