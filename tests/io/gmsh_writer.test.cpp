// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/gmsh_writer.hpp"

#include <doctest/doctest.h>

#include "approx.hpp"
#include "io/mesh_samples.hpp"
#include "io/scratch_folder.hpp"
#include "scarp/io/gmsh_reader.hpp"

namespace {

using scarp::GmshEncoding;
using scarp::GmshFormat;
using scarp::GmshVersion;

constexpr std::array all_formats{
    GmshFormat{GmshVersion::v2_2, GmshEncoding::text}, GmshFormat{GmshVersion::v2_2, GmshEncoding::binary},
    GmshFormat{GmshVersion::v4_1, GmshEncoding::text}, GmshFormat{GmshVersion::v4_1, GmshEncoding::binary}};

template <class Element>
void check_same(scarp::Mesh<Element> const& read, scarp::Mesh<Element> const& written) {
  CHECK(read.nodes == written.nodes);  // every bit: no number here is a signed zero
  CHECK(read.elements == written.elements);
  CHECK(read.element_region == written.element_region);
  CHECK(read.regions == written.regions);
  CHECK(read.boundaries == written.boundaries);
}

}  // namespace

TEST_CASE("a mesh of any element comes back from any format as it was") {
  ScratchFolder const folder;
  samples::for_each_element([&](char const* name, auto element) {
    using Element = decltype(element);
    CAPTURE(name);
    auto const mesh = samples::mesh_sample<Element>(samples::bent);
    scarp::validate(mesh);
    REQUIRE(mesh.boundaries.at("left").size() >= 1);
    for (auto const& format : all_formats) {
      CAPTURE(static_cast<int>(format.version));
      CAPTURE(static_cast<int>(format.encoding));
      scarp::write_gmsh(folder / "m.msh", mesh, format);
      check_same(scarp::read_gmsh<Element>(folder / "m.msh"), mesh);
    }
  });
}

TEST_CASE("samples have the volumes of their maps") {
  samples::for_each_element([&](char const* name, auto element) {
    using Element = decltype(element);
    CAPTURE(name);
    auto const straight = samples::mesh_sample<Element>(samples::sheared);
    CHECK(samples::volume(straight) == samples::Approx(samples::sheared_volume).epsilon(1e-14));
    if constexpr (Element::nodes > 4 && Element::nodes != 8) {  // Quad8 below: Hex8 has as many nodes
      auto const curved = samples::mesh_sample<Element>(samples::bent);
      CHECK(samples::volume(curved) == samples::Approx(samples::bent_volume).epsilon(1e-14));
    }
  });
  auto const curved = samples::mesh_sample<scarp::Quad8>(samples::bent);
  CHECK(samples::volume(curved) == samples::Approx(samples::bent_volume).epsilon(1e-14));
}
