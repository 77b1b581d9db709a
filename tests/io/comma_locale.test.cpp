// SPDX-License-Identifier: BSL-1.0
// A program around scarp may have chosen the locale of its users: numbers of files keep their decimal point.
#include <doctest/doctest.h>

#include <clocale>
#include <cstdio>
#include <locale>

#include "scarp/element/tri3.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/io/csv_reader.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/io/json.hpp"
#include "scarp/io/vtu.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/files.hpp"
#include "support/gmsh_writer.hpp"

namespace {

/// The user's locale of C and of C++, which have a comma before the decimals and points between thousands.
class German {
 public:
  German() {
    try {
      before_ = std::locale::global(std::locale("de_DE.UTF-8"));
      found_ = true;
    } catch (std::runtime_error const&) {
    }
  }
  German(German const&) = delete;
  German& operator=(German const&) = delete;
  ~German() {
    if (found_) std::locale::global(before_);
  }
  bool found() const { return found_; }

 private:
  std::locale before_ = std::locale::classic();
  bool found_ = false;
};

constexpr double number = 12345.678;

/// Every kind of text file that the library writes.
void write_all(samples::ScratchFolder const& folder) {
  auto const mesh = samples::CrossedRectangle{.width = 1234.5, .height = 0.5}.generate();
  scarp::CsvTable table({"count", "x"});
  table.add(12345, number);
  table.write(folder / "table.csv");
  scarp::CsvLog(folder / "log.csv", {"x"}).add(number);
  scarp::write_file(folder / "log.jsonl", scarp::JsonObject().add("count", 12345).add("x", number).text());
  scarp::write_gmsh(folder / "22.msh", mesh, {scarp::GmshVersion::v2_2, scarp::GmshEncoding::text});
  scarp::write_gmsh(folder / "41.msh", mesh, {scarp::GmshVersion::v4_1, scarp::GmshEncoding::text});
  scarp::write_vtu(folder / "mesh.vtu", mesh, mesh.nodes);
  scarp::PvdSeries(folder.path(), "times").add(number, "mesh.vtu");
}

}  // namespace

TEST_CASE("files are written and read with a decimal point where the locale wants a comma") {
  samples::ScratchFolder const plain;
  write_all(plain);
  German const german;
  if (!german.found()) {
    std::puts("skipped: no locale with a decimal comma here (install the package 'locales')");
    return;
  }
  REQUIRE(std::localeconv()->decimal_point == std::string(","));
  samples::ScratchFolder const folder;
  write_all(folder);
  for (auto const& file : std::filesystem::directory_iterator(plain.path())) {
    auto const name = file.path().filename().string();
    CAPTURE(name);
    CHECK(samples::content(folder / name) == samples::content(file.path()));
  }
  CHECK(scarp::read_csv(folder / "table.csv").column("x") == std::vector{number});
  CHECK(scarp::CsvColumns("r\n0.5\n", "text").column("r") == std::vector{0.5});
  for (char const* const name : {"22.msh", "41.msh"}) {
    CAPTURE(name);
    auto const mesh = scarp::read_gmsh<scarp::Tri3>(folder / name);
    CHECK(mesh.nodes == samples::CrossedRectangle{.width = 1234.5, .height = 0.5}.generate().nodes);
  }
}
