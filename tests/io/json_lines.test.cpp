// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/json.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "scarp/io/appended_file.hpp"
#include "scarp/io/read_file.hpp"
#include "support/files.hpp"

using samples::ScratchFolder;

TEST_CASE("text comes back from JSON as it went there, and what follows it stays") {
  std::string all;
  for (char letter = 1; letter < 127; ++letter) all += letter;
  for (std::string const& text : {std::string(), std::string("a \"b\" \\ c/d"), all}) {
    std::string const json = scarp::quoted_json(text) + ":7";
    for (char const letter : json) CHECK(letter >= ' ');
    std::string_view rest = json;
    CHECK(scarp::take_json_string(rest) == text);
    CHECK(rest == ":7");
  }
  CHECK(scarp::quoted_json("\"\n\x1f") == "\"\\\"\\u000a\\u001f\"");
}

TEST_CASE("short escapes of other writers are read, and text that does not close ends with the file") {
  std::string_view text = "\"\\n\\t\\r\\b\\f\\/\\u0041x\",";
  CHECK(scarp::take_json_string(text) == "\n\t\r\b\f/Ax");
  CHECK(text == ",");
  for (std::string_view cut : {"\"open", "\"open\\", "\"open\\u00", "\""}) {
    static_cast<void>(scarp::take_json_string(cut));
    CHECK(cut.empty());
  }
}

TEST_CASE("an object holds its values in the order in which they came") {
  scarp::JsonObject inner;
  inner.add("x", 0.1);
  scarp::JsonObject object;
  CHECK(object.text() == "{}");
  object.add("n", 3).add("yes", true).add("name", "a\"b").add("inner", inner).add("list", std::vector{1.0, 2.5});
  object.add("none", std::numeric_limits<double>::infinity()).add("empty", std::vector<int>{});
  CHECK(object.text() == R"({"n":3,"yes":true,"name":"a\"b","inner":{"x":0.1},"list":[1,2.5],"none":null,"empty":[]})");
}

TEST_CASE("a log is one object a line, and goes on where it is resumed") {
  ScratchFolder const folder;
  auto const path = folder / "log.jsonl";
  for (bool const resumed : {false, true}) {
    scarp::AppendedFile log(path, "", resumed);
    log.add(scarp::JsonObject().add("resumed", resumed).text() + '\n');
  }
  CHECK(scarp::read_file(path) == "{\"resumed\":false}\n{\"resumed\":true}\n");
}

TEST_CASE("text that is not UTF-8 becomes JSON with replacement characters") {
  CHECK(scarp::quoted_json("b\xf6"
                           "den") ==
        "\"b\xEF\xBF\xBD"
        "den\"");
  // Analytic: RFC 3629. Sound characters of one to four bytes; forms too long, halves of pairs, beyond U+10FFFF, cut
  // off.
  for (std::string const sound :
       {"a", "\xC3\xB6", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF"})
    CHECK(scarp::valid_utf8(sound) == sound);
  for (std::string const wrong : {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
                                  "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xE2\x82"}) {
    std::string expected;
    for (std::size_t k = 0; k < wrong.size(); ++k) expected += "\xEF\xBF\xBD";
    CHECK(scarp::valid_utf8(wrong) == expected);
  }
}

TEST_CASE("a string that another program has escaped is read back as UTF-8") {
  std::string_view text = "\"\\u00e9 \\u20ac \\ud83d\\ude00 \\u000a\"";
  CHECK(scarp::take_json_string(text) == "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80 \n");
  CHECK(text.empty());
}
