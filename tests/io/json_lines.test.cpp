// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/json_lines.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

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
    scarp::JsonLog log(path, resumed);
    log.add(scarp::JsonObject().add("resumed", resumed));
  }
  CHECK(scarp::read_file(path) == "{\"resumed\":false}\n{\"resumed\":true}\n");
  scarp::JsonLog(path).add(scarp::JsonObject());
  CHECK(scarp::read_file(path) == "{}\n");
}
