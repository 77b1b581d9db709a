// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <random>

#include "io/mesh_samples.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "support/files.hpp"
#include "support/gmsh_writer.hpp"

namespace {

using samples::content;
using samples::ScratchFolder;

using Element = scarp::Tri3;
using scarp::GmshEncoding;
using scarp::GmshVersion;

/// Two triangles in two regions, with two boundaries, in each format.
std::vector<std::string> files() {
  scarp::Mesh<Element> mesh;
  mesh.nodes = {{0.0, 0.0}, {1.0, 0.25}, {1.0, 1.0}, {-0.1, 1.0}};
  mesh.elements = {{0, 1, 2}, {0, 2, 3}};
  mesh.element_region = {0, 1};
  mesh.regions = {"sand", "clay"};
  mesh.boundaries = {{"ground", {{0, 1}}}, {"middle", {{2, 0}}}};
  ScratchFolder const folder;
  std::vector<std::string> contents;
  for (auto const version : {GmshVersion::v2_2, GmshVersion::v4_0, GmshVersion::v4_1}) {
    for (auto const encoding : {GmshEncoding::text, GmshEncoding::binary}) {
      scarp::write_gmsh(folder / "m.msh", mesh, {version, encoding});
      contents.push_back(content(folder / "m.msh"));
    }
  }
  return contents;
}

/// Anything but a valid mesh or an InputError fails the test.
bool is_read(std::string bytes) {
  try {
    auto const mesh = scarp::GmshFile(std::move(bytes), "m.msh").mesh<Element>();
    scarp::validate(mesh);
    return true;
  } catch (scarp::InputError const& error) {
    std::string const said = error.what();
    CHECK(said.find("m.msh") != std::string::npos);  // what validate() says of a mesh that was read does not name it
    return false;
  }
}

template <class Number>
void append_swapped(std::string& bytes, Number number) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), &number, sizeof(Number));
  bytes.append(raw.rbegin(), raw.rend());
}

template <class... Numbers>
std::string swapped(Numbers... numbers) {
  std::string bytes;
  (append_swapped(bytes, numbers), ...);
  return bytes;
}

}  // namespace

TEST_CASE("a file that is cut off anywhere is refused") {
  for (auto const& file : files()) {
    CHECK(is_read(file));
    CHECK(is_read(file.substr(0, file.size() - 1)));  // the end of the last line may be missing
    for (std::size_t length = 0; length + 1 < file.size(); ++length) {
      CAPTURE(length);
      CHECK_FALSE(is_read(file.substr(0, length)));
    }
  }
}

TEST_CASE("a file with a wrong byte is a valid mesh or is refused") {
  int accepted = 0;
  int refused = 0;
  for (auto const& file : files()) {
    for (std::size_t at = 0; at < file.size(); ++at) {
      for (unsigned const change : {0x01U, 0x02U, 0x10U, 0x40U, 0x80U, 0xffU}) {
        CAPTURE(at);
        CAPTURE(change);
        auto damaged = file;
        damaged[at] = static_cast<char>(static_cast<unsigned char>(file[at]) ^ change);
        (is_read(std::move(damaged)) ? accepted : refused)++;
      }
    }
  }
  CHECK(accepted > 0);  // such as other coordinates and names
  CHECK(refused > accepted / 2);
}

TEST_CASE("files with many wrong, missing and repeated bytes are valid meshes or are refused") {
  unsigned const seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  auto const below = [&](std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
  };
  for (auto const& file : files()) {
    for (int k = 0; k < 2000; ++k) {
      auto damaged = file;
      for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
        auto const at = below(damaged.size());
        auto const length = 1 + below(std::min<std::size_t>(8, damaged.size() - at));
        switch (below(4)) {
          case 0: damaged.erase(at, length); break;
          case 1: damaged.insert(at, damaged.substr(below(damaged.size()), length)); break;
          case 2: damaged.replace(at, length, length, static_cast<char>(0xff)); break;
          default: damaged[at] = static_cast<char>(below(256)); break;
        }
      }
      CAPTURE(damaged);
      is_read(std::move(damaged));
    }
  }
}

TEST_CASE("binary files of the other order of bytes are read") {
  std::string const names = "$PhysicalNames\n1\n2 5 \"sand\"\n$EndPhysicalNames\n";
  auto const format = [&](std::string const& version) {
    return "$MeshFormat\n" + version + " 1 8\n" + swapped(std::int32_t{1}) + "\n$EndMeshFormat\n" + names;
  };
  using Tag = std::uint64_t;
  std::string const v2_2 = format("2.2") + "$Nodes\n3\n" + swapped(1, 0.0, 0.0, 0.0) + swapped(2, 2.5, 0.0, 0.0) +
                           swapped(3, 0.0, 1.5, 0.0) + "\n$EndNodes\n$Elements\n1\n" +
                           swapped(2, 1, 2, 9, 5, 1, 1, 2, 3) + "\n$EndElements\n";
  std::string const v4_1 = format("4.1") + "$Entities\n" + swapped(Tag{0}, Tag{0}, Tag{1}, Tag{0}) +
                           swapped(1, 0.0, 0.0, 0.0, 2.5, 1.5, 0.0, Tag{1}, 5, Tag{0}) + "\n$EndEntities\n$Nodes\n" +
                           swapped(Tag{1}, Tag{3}, Tag{1}, Tag{3}, 2, 1, 0, Tag{3}, Tag{1}, Tag{2}, Tag{3}, 0.0, 0.0,
                                   0.0, 2.5, 0.0, 0.0, 0.0, 1.5, 0.0) +
                           "\n$EndNodes\n$Elements\n" +
                           swapped(Tag{1}, Tag{1}, Tag{9}, Tag{9}, 2, 1, 2, Tag{1}, Tag{9}, Tag{1}, Tag{2}, Tag{3}) +
                           "\n$EndElements\n";
  for (auto const& bytes : {v2_2, v4_1}) {
    auto const mesh = scarp::GmshFile(bytes, "m.msh").mesh<Element>();
    CHECK(mesh.nodes == std::vector<scarp::Vector<2>>{{0.0, 0.0}, {2.5, 0.0}, {0.0, 1.5}});
    CHECK(mesh.elements == std::vector<std::array<int, 3>>{{0, 1, 2}});
    CHECK(mesh.regions == std::vector<std::string>{"sand"});
  }
}
