// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/vtu.hpp"

#include <doctest/doctest.h>

#include "scarp/element/tet4.hpp"
#include "support/crossed_rectangle.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::contains;
using samples::content;
using samples::Naming;
using samples::ScratchFolder;

std::string encoded(std::string_view text) { return scarp::base64(std::as_bytes(std::span(text))); }

int letter_value(char letter) {
  if (letter >= 'A' && letter <= 'Z') return letter - 'A';
  if (letter >= 'a' && letter <= 'z') return letter - 'a' + 26;
  if (letter >= '0' && letter <= '9') return letter - '0' + 52;
  return letter == '+' ? 62 : 63;
}

std::vector<unsigned char> decoded(std::string const& text) {
  std::vector<unsigned char> bytes;
  for (std::size_t first = 0; first + 3 < text.size(); first += 4) {
    unsigned bits = 0;
    std::size_t given = 3;
    for (std::size_t k = 0; k < 4; ++k) {
      bool const padding = text[first + k] == '=';
      given -= padding ? 1 : 0;
      bits = bits << 6U | (padding ? 0U : static_cast<unsigned>(letter_value(text[first + k])));
    }
    for (std::size_t k = 0; k < given; ++k) {
      bytes.push_back(static_cast<unsigned char>(bits >> (8U * (2U - k))));
    }
  }
  return bytes;
}

/// The opening tag of the DataArray with this name and the numbers in it.
template <class Number>
struct Array {
  std::string tag;
  std::vector<Number> values;
};

template <class Number>
Array<Number> read(std::string const& file, std::string const& name) {
  auto const at = file.find(" Name=\"" + name + "\"");
  REQUIRE(at != std::string::npos);
  auto const open = file.rfind('<', at);
  auto const close = file.find('>', at);
  auto const bytes = decoded(file.substr(close + 1, file.find('<', close) - close - 1));
  std::uint64_t length = 0;
  REQUIRE(bytes.size() >= sizeof(length));
  std::memcpy(&length, bytes.data(), sizeof(length));
  CHECK(length == bytes.size() - sizeof(length));
  Array<Number> array{file.substr(open, close - open), std::vector<Number>(length / sizeof(Number))};
  std::memcpy(array.values.data(), bytes.data() + sizeof(length), length);
  return array;
}

}  // namespace

TEST_CASE("base64 gives the texts of its standard") {
  // Another code: the test vectors of RFC 4648, section 10.
  CHECK(encoded("") == "");
  CHECK(encoded("f") == "Zg==");
  CHECK(encoded("fo") == "Zm8=");
  CHECK(encoded("foo") == "Zm9v");
  CHECK(encoded("foob") == "Zm9vYg==");
  CHECK(encoded("fooba") == "Zm9vYmE=");
  CHECK(encoded("foobar") == "Zm9vYmFy");
  CHECK(encoded("\xff\xfe\xfb") == "//77");  // the two letters that are not letters: computed by hand
  CHECK(encoded("\xfb\xe0") == "++A=");
}

TEST_CASE("a mesh comes back from its file with every bit") {
  ScratchFolder const folder;
  auto const mesh =
      samples::CrossedRectangle{.width = 3.0, .height = 1.0, .columns = 3, .rows = 2, .distortion = 0.1}.generate();
  auto positions = mesh.nodes;
  positions[2] += scarp::Vector<2>(0.1, -0.2);
  scarp::write_vtu(folder / "m.vtu", mesh, positions);
  auto const file = content(folder / "m.vtu");
  CHECK(file == Naming{"NumberOfPoints=\"" + std::to_string(mesh.nodes.size()) + "\" NumberOfCells=\"24\""});
  CHECK(file == Naming{"header_type=\"UInt64\""});
  auto const points = read<double>(file, "Points").values;
  REQUIRE(points.size() == 3 * positions.size());
  for (std::size_t n = 0; n < positions.size(); ++n) {
    CHECK(points[3 * n] == positions[n].x());
    CHECK(points[3 * n + 1] == positions[n].y());
    CHECK(points[3 * n + 2] == 0.0);
  }
  auto const connectivity = read<std::int32_t>(file, "connectivity").values;
  auto const offsets = read<std::int32_t>(file, "offsets").values;
  REQUIRE(connectivity.size() == 3 * mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    CHECK(std::equal(mesh.elements[e].begin(), mesh.elements[e].end(), connectivity.begin() + 3 * static_cast<int>(e)));
    CHECK(offsets[e] == 3 * static_cast<int>(e) + 3);
  }
  CHECK(read<std::uint8_t>(file, "types").values == std::vector<std::uint8_t>(24, 5));  // VTK_TRIANGLE
  CHECK(read<std::int32_t>(file, "region").values == mesh.element_region);
}

TEST_CASE("vectors and tensors are filled up to three dimensions, other fields are written as they are") {
  ScratchFolder const folder;
  auto const mesh = samples::CrossedRectangle{}.generate();  // five nodes, four elements
  std::vector<double> displacement;
  for (int k = 0; k < 10; ++k) {
    displacement.push_back(0.1 * k);
  }
  std::vector<double> gradient;
  for (int k = 0; k < 16; ++k) {
    gradient.push_back(1.0 / (1 + k));
  }
  std::vector<double> stress(12, -7.25);
  std::vector<int> const status{0, 2, 3, 1};
  scarp::write_vtu(folder / "f.vtu", mesh, mesh.nodes,
                   {.at_nodes = {{"displacement [m]", 2, std::span<double const>(displacement)}},
                    .at_elements = {{"gradient", 4, std::span<double const>(gradient)},
                                    {"stress <Pa>", 3, std::span<double const>(stress), {"xx", "yy", "xy"}},
                                    {"status", 1, std::span<int const>(status)}}});
  auto const file = content(folder / "f.vtu");
  auto const moves = read<double>(file, "displacement [m]");
  CHECK(moves.tag == Naming{"NumberOfComponents=\"3\""});
  CHECK(std::vector<double>(moves.values.begin() + 3, moves.values.begin() + 6) ==
        std::vector<double>{displacement[2], displacement[3], 0.0});
  auto const tensors = read<double>(file, "gradient");
  CHECK(tensors.tag == Naming{"NumberOfComponents=\"9\""});
  CHECK(std::vector<double>(tensors.values.begin(), tensors.values.begin() + 9) ==
        std::vector<double>{gradient[0], gradient[1], 0.0, gradient[2], gradient[3], 0.0, 0.0, 0.0, 0.0});
  auto const stresses = read<double>(file, "stress &lt;Pa&gt;");
  CHECK(stresses.tag == Naming{"NumberOfComponents=\"3\" ComponentName0=\"xx\" ComponentName1=\"yy\""});
  CHECK(stresses.values == stress);
  CHECK(read<std::int32_t>(file, "status").values == status);
  auto const cell_data = file.substr(file.find("<CellData>"));
  CHECK(cell_data == Naming{"Name=\"status\""});
  CHECK_FALSE(contains(cell_data, "displacement"));
}

TEST_CASE("a mesh in space keeps its three coordinates") {
  ScratchFolder const folder;
  scarp::Mesh<scarp::Tet4> mesh;
  mesh.nodes = {{0.0, 0.0, 0.5}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  mesh.elements = {{0, 1, 2, 3}};
  mesh.element_region = {0};
  mesh.regions = {"soil"};
  scarp::write_vtu(folder / "t.vtu", mesh, mesh.nodes);
  auto const file = content(folder / "t.vtu");
  auto const points = read<double>(file, "Points").values;
  CHECK(points == std::vector<double>{0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  CHECK(read<std::uint8_t>(file, "types").values == std::vector<std::uint8_t>{10});  // VTK_TETRA
}

TEST_CASE("fields and positions of the wrong length are refused and an older file stays") {
  ScratchFolder const folder;
  auto const mesh = samples::CrossedRectangle{}.generate();
  auto const path = folder / "m.vtu";
  scarp::write_file(path, "older");
  std::vector<double> const values(7);
  scarp::VtuField const field{"pressure", 1, std::span<double const>(values)};
  CHECK_REFUSED(scarp::write_vtu(path, mesh, mesh.nodes, {.at_nodes = {field}}), "'pressure' has 7 numbers", "5 nodes",
                "1 components");
  CHECK_REFUSED(scarp::write_vtu(path, mesh, mesh.nodes, {.at_elements = {field}}), "'pressure' has 7 numbers",
                "4 elements");
  CHECK_REFUSED(scarp::write_vtu(path, mesh, {}), "0 ");
  std::vector<double> const enough(4);
  scarp::VtuField const misnamed{"q", 1, std::span<double const>(enough), {"a", "b"}};
  CHECK_REFUSED(scarp::write_vtu(path, mesh, mesh.nodes, {.at_elements = {misnamed}}), "'q'");
  CHECK(content(path) == "older");
}

TEST_CASE(
    "names of fields that are no text of XML or are there already are refused, all others are written so that XML has "
    "them") {
  ScratchFolder const folder;
  auto const mesh = samples::CrossedRectangle{}.generate();
  std::vector<int> const numbers(mesh.elements.size(), 1);
  auto const write = [&](std::vector<std::string> const& names) {
    scarp::VtuFields fields;
    for (auto const& name : names) fields.at_elements.push_back({name, 1, std::span<int const>(numbers)});
    scarp::write_vtu(folder / "f.vtu", mesh, mesh.nodes, fields);
  };
  for (std::string const wrong : {"",
                                  "a\x01"
                                  "b",
                                  "line\nline", "\x7f",
                                  "b\xf6"
                                  "den"})
    CHECK_REFUSED(write({wrong}), "a field is named '");
  CHECK_REFUSED(write({"status", "status"}), "two fields are named 'status'");
  CHECK_REFUSED(write({"region"}), "two fields are named 'region'");  // which is always written
  CHECK_FALSE(std::filesystem::exists(folder / "f.vtu"));
  write({"mean pressure <kPa> & \"more\"",
         "b\xC3\xB6"
         "den"});
  CHECK(contains(content(folder / "f.vtu"), "Name=\"mean pressure &lt;kPa&gt; &amp; &quot;more&quot;\""));
}

TEST_CASE("a boundary is a picture of its facets, without regions") {
  ScratchFolder const folder;
  auto const mesh = samples::CrossedRectangle{}.generate();
  auto const facets = scarp::facets_of(mesh, "bottom");
  REQUIRE(scarp::boundary(mesh, "bottom").size() > 0);
  CHECK(facets.count() == static_cast<int>(scarp::boundary(mesh, "bottom").size()));
  scarp::write_vtu(folder / "bottom.vtu", facets, mesh.nodes);
  auto const text = content(folder / "bottom.vtu");
  CHECK(contains(text, fmt::format("NumberOfCells=\"{}\"", facets.count())));
  CHECK_FALSE(contains(text, "region"));
}
