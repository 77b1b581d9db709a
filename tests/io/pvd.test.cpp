// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/vtu.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/io/state_bits.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::content;
using samples::ScratchFolder;

bool complete(std::string const& text) { return text.ends_with("</Collection>\n</VTKFile>\n"); }

int entries_in(std::string const& text) {
  int found = 0;
  for (auto at = text.find("<DataSet "); at != std::string::npos; at = text.find("<DataSet ", at + 1)) {
    ++found;
  }
  return found;
}

}  // namespace

TEST_CASE("the list of a series is complete after every added file") {
  ScratchFolder const folder;
  scarp::PvdSeries series(folder.path(), "fault");
  for (int k = 0; k < 3; ++k) {
    series.add(0.1 * k, "fault_" + std::to_string(k) + ".vtu");
    auto const text = content(folder / "fault.pvd");
    CHECK(complete(text));
    CHECK(entries_in(text) == k + 1);
  }
  CHECK(content(folder / "fault.pvd").find("timestep=\"0.1\" group=\"\" part=\"0\" file=\"fault_1.vtu\"") !=
        std::string::npos);
}

TEST_CASE("a continued series keeps its earlier files") {
  ScratchFolder const folder;
  scarp::PvdSeries first(folder.path(), "fault");
  first.add(0.0, "a.vtu");
  scarp::StateWriter writer;
  writer("series", first);
  scarp::PvdSeries second(folder.path(), "fault");
  scarp::StateReader reader(writer.bits());
  reader("series", second);
  second.add(1.0, "b & c.vtu");
  auto const text = content(folder / "fault.pvd");
  CHECK(entries_in(text) == 2);
  CHECK(text.find("file=\"a.vtu\"") < text.find("file=\"b &amp; c.vtu\""));
}

TEST_CASE("times that do not increase are refused and the list stays") {
  ScratchFolder const folder;
  scarp::PvdSeries series(folder.path(), "fault");
  series.add(1.0, "a.vtu");
  CHECK_REFUSED(series.add(1.0, "b.vtu"), "1");
  CHECK_REFUSED(series.add(std::numeric_limits<double>::quiet_NaN(), "b.vtu"), "nan");
  CHECK(entries_in(content(folder / "fault.pvd")) == 1);
  CHECK(series.entries().size() == 1);
}

TEST_CASE("a file that could not be listed may be added again") {
  ScratchFolder const folder;
  scarp::PvdSeries series(folder / "later", "fault");
  CHECK(samples::message_of<scarp::FileError>([&] { series.add(0.5, "a.vtu"); }) == samples::Naming{"later"});
  CHECK(series.entries().empty());
  std::filesystem::create_directory(folder / "later");
  series.add(0.5, "a.vtu");
  CHECK(entries_in(content(folder / "later/fault.pvd")) == 1);
}
