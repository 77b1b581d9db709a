// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/mesh_tables.hpp"

#include <doctest/doctest.h>

#include "scarp/element/tet4.hpp"
#include "scarp/element/tri3.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

using samples::content;
using samples::ScratchFolder;

TEST_CASE("a mesh becomes three tables with names of regions and boundaries") {
  ScratchFolder const folder;
  scarp::Mesh<scarp::Tri3> mesh;
  mesh.nodes = {{0.0, 0.0}, {0.1, 0.0}, {1.0 / 3.0, 1.0}, {0.0, 1.0}};
  mesh.elements = {{0, 1, 2}, {0, 2, 3}};
  mesh.element_region = {1, 0};
  mesh.regions = {"sand, dense", "clay"};
  mesh.boundaries = {{"ground", {{0, 1}}}, {"top", {{2, 3}}}};
  scarp::write_mesh_tables(folder.path(), mesh);
  CHECK(content(folder / "nodes.csv") == "node,x,y\n0,0,0\n1,0.1,0\n2,0.3333333333333333,1\n3,0,1\n");
  CHECK(content(folder / "elements.csv") == "element,region,n0,n1,n2\n0,clay,0,1,2\n1,\"sand, dense\",0,2,3\n");
  CHECK(content(folder / "boundaries.csv") == "boundary,n0,n1\nground,0,1\ntop,2,3\n");
  CHECK(folder.file_count() == 3);
}

TEST_CASE("the table of a mesh in space has three coordinates") {
  ScratchFolder const folder;
  scarp::Mesh<scarp::Tet4> mesh;
  mesh.nodes = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.25}};
  mesh.elements = {{0, 1, 2, 3}};
  mesh.element_region = {0};
  mesh.regions = {"sand"};
  scarp::write_mesh_tables(folder.path(), mesh);
  CHECK(content(folder / "nodes.csv") == "node,x,y,z\n0,0,0,0\n1,1,0,0\n2,0,1,0\n3,0,0,0.25\n");
  CHECK(content(folder / "elements.csv") == "element,region,n0,n1,n2,n3\n0,sand,0,1,2,3\n");
}

TEST_CASE("a mesh that is not valid and a folder that is not there are refused") {
  ScratchFolder const folder;
  scarp::Mesh<scarp::Tri3> mesh;
  CHECK_REFUSED(scarp::write_mesh_tables(folder.path(), mesh), "0 nodes");
  mesh.nodes = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  mesh.elements = {{0, 1, 2}};
  mesh.element_region = {0};
  mesh.regions = {"sand"};
  CHECK(samples::message_of<scarp::FileError>([&] {
          static_cast<void>(scarp::write_mesh_tables(folder / "nowhere", mesh));
        }) == samples::Naming{"nowhere"});
  CHECK(folder.file_count() == 0);
}
