// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/csv_reader.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "scarp/core/random.hpp"
#include "scarp/io/csv.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Naming;
using samples::ScratchFolder;

scarp::CsvColumns table(std::string_view text) { return {text, "grains.csv"}; }

/// What is said when a column of a table with one number column `r` is requested.
std::string complaint(std::string_view text, std::string_view column = "r") {
  return samples::message_of([&] { static_cast<void>(table(text).column(column)); });
}

}  // namespace

TEST_CASE("what a table wrote is read back with the same bits") {
  ScratchFolder const folder;
  scarp::CsvTable written({"force [N]", "says \"why\", in words", "status"});
  scarp::Random random(17);
  std::vector<double> numbers{0.1, 1.0 / 3.0, -0.0, 1e300, std::numeric_limits<double>::denorm_min()};
  for (int k = 0; k < 1000; ++k) {
    numbers.push_back(std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.next() % 2000) - 1000));
  }
  for (double const number : numbers) written.add(number, -number, "not, \"converged\"\nin two lines");
  written.write(folder / "table.csv");

  auto const read = scarp::read_csv(folder / "table.csv");
  CHECK(read.names() == std::vector<std::string>{"force [N]", "says \"why\", in words", "status"});
  auto const first = read.column("force [N]");
  auto const second = read.column("says \"why\", in words");
  REQUIRE(first.size() == numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    CHECK(std::bit_cast<std::uint64_t>(first[k]) == std::bit_cast<std::uint64_t>(numbers[k]));
    CHECK(std::bit_cast<std::uint64_t>(second[k]) == std::bit_cast<std::uint64_t>(-numbers[k]));
    CHECK(read.line(k) == 2 + 2 * k);  // each row takes two lines of the file
  }
}

TEST_CASE("columns are found by name, blank lines and foreign ends of lines do no harm") {
  auto const read = table("\xEF\xBB\xBFid,x, note \r\n7, 2.5 ,soft\r\n\r\n+8,-1e-3,\r\n\n");
  CHECK(read.rows() == 2);
  CHECK(read.column<int>("id") == std::vector<int>{7, 8});
  CHECK(read.column("x") == std::vector<double>{2.5, -1e-3});
  CHECK(read.has("note"));
  CHECK_FALSE(read.has("y"));
  CHECK(read.line(1) == 4);
  CHECK(read.texts("note") == std::vector<std::string>{"soft", ""});
  CHECK_REFUSED(read.texts("y"), "no column 'y'");
}

TEST_CASE("a table is read as spreadsheets leave it") {
  std::vector<double> const x{0.5, 0.75};
  for (auto const* const text : {"id;x\n1;0.5\n2;0.75\n", "id\tx\n1\t0.5\n2\t0.75\n", "sep=;\nid;x\n1;0.5\n2;0.75\n",
                                 "sep=,\r\nid,x\r\n1,0.5\r\n2,0.75\r\n", "id,x\r1,0.5\r2,0.75\r",
                                 "\nid,x,,\n1,0.5,,\n,,,\n2,0.75,,\n , ,\n", "id,,x\n1,,0.5\n2,,0.75,,\n",
                                 "id,x\n   \n1,0.5\xC2\xA0\n2,+0.75\n", "\xEF\xBB\xBFid;x;\r1;\"0.5\";\r2;0.75\r"}) {
    CAPTURE(text);
    auto const read = table(text);
    CHECK(read.names() == std::vector<std::string>{"id", "x"});
    CHECK(read.column<int>("id") == std::vector<int>{1, 2});
    CHECK(read.column("x") == x);
  }
  CHECK(complaint("id,r,\n1,2,\n3,4,5\n") == Naming{"line 3 of", "'5' in column 3", "line 1 does not name"});
  CHECK(complaint("id;r\n1;0,5\n") == Naming{"'0,5' in column 'r'", "with a point"});
  CHECK(complaint("r\n1\xC2\xA0"
                  "200\n") == Naming{"'1<U+00A0>200'"});
  CHECK(complaint("r\n\xE2\x88\x92"
                  "2\n") == Naming{"'<U+2212>2'"});
  CHECK(complaint("x,y" + std::string(5000, 'y') + "\n1,2\n").size() < 400);
  CHECK(complaint("r\n" + std::string(5000, 'z') + "\n").size() < 400);
}

TEST_CASE("commas within names do not part the cells of a table with semicolons or tabs") {
  for (char const separator : {';', '\t'}) {
    std::string text = "strain, axial|q, kPa\n0.01|5\n";
    std::ranges::replace(text, '|', separator);
    CAPTURE(text);
    scarp::CsvColumns const table(text, "t.csv");
    CHECK(table.column("q, kPa") == std::vector{5.0});
  }
  CHECK_REFUSED(scarp::CsvColumns("a;b\n1;2;3\n", "t.csv"), "line 2", "parted by ';'");
}

TEST_CASE("a file that is missing, a folder or empty is refused by name") {
  ScratchFolder const folder;
  CHECK_THROWS_WITH_AS(scarp::read_csv(folder / "nowhere.csv"),
                       doctest::Contains("nowhere.csv' (there is no such file)"), scarp::InputError);
  CHECK_THROWS_WITH_AS(scarp::read_csv(folder.path()), doctest::Contains("it is a folder"), scarp::InputError);
  scarp::write_file(folder / "unicode.txt", std::string("\xFF\xFEr\0\n\0001\0\n\0", 10));
  CHECK_THROWS_WITH_AS(scarp::read_csv(folder / "unicode.txt"), doctest::Contains("in UTF-16"), scarp::InputError);
  CHECK_THROWS_WITH_AS(table(""), doctest::Contains("'grains.csv' is empty"), scarp::InputError);
  CHECK_THROWS_WITH_AS(table("\n\n"), doctest::Contains("'grains.csv' is empty"), scarp::InputError);
}

TEST_CASE("a wrong header is refused") {
  CHECK(complaint("x,y\n1,2\n") == Naming{"'grains.csv'", "no column 'r'", "x, y"});
  CHECK(complaint("x,r,x\n") == Naming{"line 1 of 'grains.csv'", "'x'"});
}

TEST_CASE("a line of another width is refused with its number") {
  CHECK(complaint("x,r\n1,2\n3\n") == Naming{"line 3 of 'grains.csv'", "1 cells", "2 columns"});
  CHECK(complaint("x,r\n1,2,3\n") == Naming{"has 3 cells"});
}

TEST_CASE("a cell that is no finite number is refused with line, column and value") {
  CHECK(complaint("x,r\n1,2\n3,4mm\n") == Naming{"line 3 of 'grains.csv'", "'4mm' in column 'r'", "no number"});
  for (auto const* const wrong : {"", "-", "+-1", "0x10", "1,5", "1 2", "one"}) {
    CAPTURE(wrong);
    CHECK(complaint(std::string("r\n\"") + wrong + "\"\n") == Naming{"it is no number"});
  }
  for (auto const* const wrong : {"nan", "inf", "-Infinity"}) {
    CAPTURE(wrong);
    CHECK(complaint(std::string("r\n") + wrong + "\n") == Naming{"it is not finite"});
  }
  CHECK(complaint("r\n1e999\n") == Naming{"beyond what a number here can hold"});
  CHECK_THROWS_WITH_AS(table("id\n1.5\n").column<int>("id"), doctest::Contains("it is no whole number"),
                       scarp::InputError);
}

TEST_CASE("quotes that do not close, or close too early, are refused with their line") {
  CHECK(complaint("r\n1\n\"2\n3\n") == Naming{"line 3 of 'grains.csv' opens quotes (they never close)"});
  CHECK(complaint("r\n\"1\"2\n") == Naming{"line 2 of 'grains.csv' has text behind closed quotes"});
}

TEST_CASE("what a damaged file holds neither ends a complaint early nor steers the terminal") {
  std::string text = "x,r\n1,2";
  text += {'\0', '\x1b', '[', '2', 'J', '\n'};
  CHECK(complaint(text) == Naming{"line 2 of 'grains.csv'", "'2??[2J' in column 'r'", "2.5e-3"});
}

TEST_CASE("bytes of any kind are read or refused") {
  scarp::Random random(5);
  std::string_view const letters = "0123456789.,-+e\"\n\r\t #xrin\xEF";
  int refused = 0;
  for (int k = 0; k < 2000; ++k) {
    std::string text = "x,r\n1,2\n";
    for (int byte = 0; byte < 6; ++byte) {
      text.insert(random.next() % (text.size() + 1), 1, letters[random.next() % letters.size()]);
    }
    refused += !complaint(text).empty();
  }
  CHECK(refused > 100);
  CHECK(refused < 2000);
}

TEST_CASE("lines of blanks around the header do not hide what parts the cells") {
  for (std::string_view const text : {" \nx;r\n1;2\n", "x;r\n \n1;2\n", "x\tr\n \t\n1\t2\n", ";\nx;r\n1;2\n"}) {
    CAPTURE(text);
    CHECK(table(text).column("r") == std::vector{2.0});
  }
}
