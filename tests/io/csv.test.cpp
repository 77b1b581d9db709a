// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/csv.hpp"

#include <doctest/doctest.h>

#include <sys/resource.h>

#include <array>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <sstream>

#include "scarp/core/random.hpp"
#include "scarp/io/csv_reader.hpp"
#include "scarp/io/state_bits.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::content;
using samples::ScratchFolder;

std::vector<std::string> lines_of(std::string const& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

TEST_CASE("numbers come back from a table with the same bits") {
  scarp::CsvTable table({"throw [m]"});
  scarp::Random random(17);
  std::vector<double> numbers{0.1, 1.0 / 3.0, -0.0, 1e300, std::numeric_limits<double>::denorm_min()};
  for (int k = 0; k < 1000; ++k) {
    numbers.push_back(std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.next() % 2000) - 1000));
  }
  for (double const number : numbers) {
    table.add(number);
  }
  auto const lines = lines_of(table.text());
  REQUIRE(lines.size() == numbers.size() + 1);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    double const back = std::strtod(lines[k + 1].c_str(), nullptr);
    CHECK(std::bit_cast<std::uint64_t>(back) == std::bit_cast<std::uint64_t>(numbers[k]));
  }
}

TEST_CASE("a row is given cell by cell or as a range") {
  scarp::CsvTable table({"x", "y"});
  table.add(1, 2.5);
  table.add(std::vector<double>{1.0, 2.5});
  table.add(std::vector<std::string>{"1", "2.5"});
  table.add(std::span<double const>(std::array{1.0, 2.5}));
  CHECK(table.text() == "x,y\n1,2.5\n1,2.5\n1,2.5\n1,2.5\n");
  CHECK_REFUSED(table.add(std::vector<double>{1.0}), "a row of 1 cells");
}

TEST_CASE("a table holds text and whole numbers beside numbers, and quotes what needs it") {
  scarp::CsvTable table({"step", "status", "says \"why\", in words", "force [N]"});
  table.add(3, "ok", std::string("a,b"), 0.5);
  table.add(4, std::string_view("not_converged"), "he said \"no\"", -2.0);
  // Expected by RFC 4180: quotes around, quotes inside doubled.
  CHECK(table.text() ==
        "step,status,\"says \"\"why\"\", in words\",force [N]\n3,ok,\"a,b\",0.5\n4,not_converged,\"he said "
        "\"\"no\"\"\",-2\n");
}

TEST_CASE("blanks at the ends of a text come back") {
  scarp::CsvTable table({"soil", "number"});
  for (char const* text : {" sand ", "\tsilt", "clay ", "two words"}) table.add(text, 1);
  scarp::CsvColumns const read(table.text(), "soils.csv");
  CHECK(read.texts("soil") == std::vector<std::string>{" sand ", "\tsilt", "clay ", "two words"});
}

TEST_CASE("a span of numbers is a row") {
  scarp::CsvTable table({"x [m]", "y [m]"});
  std::vector<double> const row{0.25, -1.5};
  table.add(std::span<double const>(row));
  CHECK(table.text() == "x [m],y [m]\n0.25,-1.5\n");
  CHECK_REFUSED(table.add(std::span<double const>(row).first(1)), "1 cells", "2 columns");
}

TEST_CASE("a span of texts is a row, quoted where it must be") {
  scarp::CsvTable table({"x [m]", "reason"});
  std::vector<std::string> const row{"", "too deep, at 0.2"};
  table.add(std::span<std::string const>(row));
  CHECK(table.text() == "x [m],reason\n,\"too deep, at 0.2\"\n");
  CHECK_REFUSED(table.add(std::span<std::string const>(row).first(1)), "1 cells", "2 columns");
}

TEST_CASE("rows of the wrong width are refused and not kept") {
  scarp::CsvTable table({"a", "b"});
  CHECK_REFUSED(table.add(1.0), "1 cells", "2 columns");
  CHECK_REFUSED(table.add(1.0, 2.0, 3.0), "3 cells", "2 columns");
  CHECK(table.text() == "a,b\n");
}

TEST_CASE("tables without columns and with empty or repeated names are refused") {
  CHECK_REFUSED(scarp::CsvTable({}), "no columns");
  CHECK_REFUSED(scarp::CsvTable({"a", ""}), "column 1");
  CHECK_REFUSED(scarp::CsvTable({"a", "b", "a"}), "'a'");
  CHECK_REFUSED(scarp::CsvTable({"two\nlines"}), "column 0");
}

TEST_CASE("a table is written as a whole") {
  ScratchFolder const folder;
  scarp::CsvTable table({"a"});
  table.add(1);
  table.write(folder / "t.csv");
  CHECK(content(folder / "t.csv") == "a\n1\n");
}

TEST_CASE("a row of a log is on its way to the disk as soon as it is added") {
  ScratchFolder const folder;
  scarp::CsvLog log(folder / "log.csv", {"a", "b"});
  CHECK(content(folder / "log.csv") == "a,b\n");
  log.add(1, 2.5);
  CHECK(content(folder / "log.csv") == "a,b\n1,2.5\n");
  CHECK_REFUSED(log.add(1), "1 cells", "2 columns");
  CHECK(content(folder / "log.csv") == "a,b\n1,2.5\n");
}

TEST_CASE("a log starts anew or goes on behind its last complete row") {
  ScratchFolder const folder;
  {
    scarp::CsvLog log(folder / "log.csv", {"a", "b"});
    log.add(1, 2);
  }
  {
    std::ofstream(folder / "log.csv", std::ios::app) << "3,";  // what an interruption leaves
  }
  {
    scarp::CsvLog log(folder / "log.csv", {"a", "b"}, scarp::CsvStart::resumed);
    log.add(5, 6);
  }
  CHECK(content(folder / "log.csv") == "a,b\n1,2\n5,6\n");
  { scarp::CsvLog const log(folder / "log.csv", {"a", "b"}); }
  CHECK(content(folder / "log.csv") == "a,b\n");
  {
    scarp::CsvLog log(folder / "new.csv", {"a"}, scarp::CsvStart::resumed);
    log.add(1);
  }
  CHECK(content(folder / "new.csv") == "a\n1\n");
}

TEST_CASE("a log with other columns is not continued and not touched") {
  ScratchFolder const folder;
  scarp::write_file(folder / "log.csv", "x,y\n1,2\n");
  CHECK_REFUSED(scarp::CsvLog(folder / "log.csv", {"a", "b"}, scarp::CsvStart::resumed), "log.csv", "a,b");
  CHECK(content(folder / "log.csv") == "x,y\n1,2\n");
}

TEST_CASE("rows from after a state was saved make way for those of the run that goes on from there") {
  ScratchFolder const folder;
  scarp::StateWriter writer;
  {
    scarp::CsvLog log(folder / "log.csv", {"a"});
    log.add(1);
    writer("log", log);
    log.add(2);
  }
  scarp::CsvLog log(folder / "log.csv", {"a"}, scarp::CsvStart::resumed);
  scarp::StateReader(writer.bits())("log", log);
  CHECK(content(folder / "log.csv") == "a\n1\n2\n");
  log.add(3);
  CHECK(content(folder / "log.csv") == "a\n1\n3\n");
  scarp::write_file(folder / "log.csv", "a\n");
  CHECK_REFUSED(scarp::StateReader(writer.bits())("log", log), "log.csv");
}

TEST_CASE("a log in a missing folder is refused") {
  ScratchFolder const folder;
  CHECK(samples::message_of<scarp::FileError>([&] {
          static_cast<void>(scarp::CsvLog(folder / "missing/log.csv", {"a"}));
        }) == samples::Naming{"missing"});
}

TEST_CASE("a row that did not fit onto the disk leaves no part of it before the next one") {
  ScratchFolder const folder;
  scarp::CsvLog log(folder / "log.csv", {"step", "value"});
  log.add(1, 1.25);
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  auto const handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit const full{std::filesystem::file_size(folder / "log.csv") + 2, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &full) == 0);
  CHECK(samples::message_of<scarp::FileError>([&] { log.add(2, 1.0 / 3.0); }) == samples::Naming{"log.csv"});
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, handler);
  log.add(3, 2.5);
  CHECK(content(folder / "log.csv") == "step,value\n1,1.25\n3,2.5\n");
}

TEST_CASE("a blank of another kind at the ends of a text comes back") {
  scarp::CsvTable table({"name"});
  table.add("\xC2\xA0sand\xC2\xA0");
  ScratchFolder const folder;
  table.write(folder / "t.csv");
  CHECK(scarp::CsvColumns(content(folder / "t.csv"), "t.csv").texts("name") ==
        std::vector<std::string>{"\xC2\xA0sand\xC2\xA0"});
}
