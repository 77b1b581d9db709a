// SPDX-License-Identifier: BSL-1.0
// Sands and sieve curves are text: what editors and locales leave in them is read, or rejected visibly.
#include <doctest/doctest.h>

#include <clocale>

#include "../../examples/shared/sand/grading.hpp"
#include "../../examples/shared/sand/sand_file.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Naming;

examples::Sand sand_of(std::string_view text) {
  examples::Sand sand;
  examples::Entries entries(text);
  examples::take(entries, sand);
  entries.require_all_taken("a sand");
  return sand;
}

std::string complaint(std::string_view text) {
  return samples::message_of([&] { sand_of(text); });
}

}  // namespace

TEST_CASE("a sand is read as editors leave it") {
  for (auto const* const text :
       {"shape = ellipse\nfriction = 0.25\n", "\xEF\xBB\xBFshape ellipse\r\nfriction 0.25\r\n",
        "shape = ellipse\rfriction = 0.25\r", "shape = \"ellipse\"\nfriction = +0.25  # rough\n",
        "; a remark\nshape = ellipse\xC2\xA0\n\tfriction=0.25"}) {
    CAPTURE(text);
    auto const sand = sand_of(text);
    CHECK(sand.shape == "ellipse");
    CHECK(sand.friction == 0.25);
  }
  CHECK(complaint("friction = 0,25\n") == Naming{"line 1", "'0,25'"});
  CHECK(complaint("shape = disc\rfriction = 0.2.5\r") == Naming{"line 2", "'0.2.5'"});
  CHECK(complaint("fric\xC2\xA0tion = 0.25\n") == Naming{"'fric<U+00A0>tion'"});
  CHECK(complaint("x = " + std::string(5000, 'y')).size() < 400);
}

TEST_CASE("other grains than those that a packing was prepared with are noted") {
  samples::ScratchFolder const folder;
  scarp::write_file(folder / "dense.sand", "shape = disc\nlaw = linear\nfriction = 0.3\nnormal-stiffness = 5e6\n");
  auto sand = sand_of("shape = disc\nlaw = linear\nfriction = 0.3\nnormal-stiffness = 5e6\npressure = 7e4\n");
  CHECK(examples::other_than_prepared(folder / "dense.packing", sand).empty());
  sand.friction = 0.6;
  sand.tangential_stiffness = 1e5;
  auto const notes = examples::other_than_prepared(folder / "dense.packing", sand);
  REQUIRE(notes.size() == 2);
  CHECK(notes[0] == Naming{"tangential-stiffness"});
  CHECK(notes[1] == Naming{"dense.packing' was prepared with friction 0.3, and 0.6 is given"});
  CHECK(examples::other_than_prepared(folder / "loose.packing", sand).empty());
  scarp::write_file(folder / "empty.sand", "# nothing yet\n");
  CHECK_REFUSED(examples::read_sand(folder / "empty.sand"), "empty.sand", "no lines `option = value`");
}

TEST_CASE("a sieve curve is read whatever the locale is") {
  auto const read = [](std::string const& text) { return examples::sieve_curve(text); };
  std::string const before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  auto const curve = read("0.001 0,  +2e-3 37.5,\t0.004 37.5, 0.008\t100");
  std::setlocale(LC_ALL, before.c_str());
  CHECK(curve.diameters == std::vector{0.001, 0.002, 0.004, 0.008});
  CHECK(curve.passing == std::vector{0.0, 0.375, 0.375, 1.0});
  CHECK(read("0.001 0, 0.002 40, 0.002 40, 0.008 100").diameters == std::vector{0.001, 0.002, 0.008});
  CHECK_REFUSED(read("1 0, 4 100"), "give diameters in metres");
  CHECK_REFUSED(read("0.001 5, 0.004 100"), "from 5 % to 100 %");
  CHECK_REFUSED(read("0.001 0, 0.002 60, 0.004 50, 0.008 100"), "60 % pass");
  CHECK_REFUSED(read("0,001 0; 0,004 100"), "no point of a sieve curve");
  CHECK_REFUSED(read("0.001 0%, 0.004 100%"), "'0.001 0%' is no point");
}
