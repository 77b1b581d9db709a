// SPDX-License-Identifier: BSL-1.0
#include "../../examples/shared/grain_files.hpp"

#include <doctest/doctest.h>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/packings/packing_reader.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/sphere.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Naming;

examples::GrainFile read(std::string const& text) {
  samples::ScratchFolder const folder;
  scarp::write_file(folder / "grains", text);
  return examples::read_grains(folder / "grains");
}

std::string complaint(std::string const& text) {
  return samples::message_of([&] { read(text); });
}

/// Two spheres in each form, the second of radius 0.25 m at (1.5, 2, 3) m.
std::string const yade = "#format x_y_z_r\n# made in Yade\n1 1 1 0.5\n1.5\t2\t3\t0.25\n";
std::string const lammps =
    "LAMMPS data file via write_data\n\n2 atoms\n1 atom types\n\n0 4 xlo xhi\n-1 5 ylo yhi\n0 8 zlo zhi\n1 0.5 0.25 xy "
    "xz yz\n\n"
    "Atoms # sphere\n\n7 1 1 2650 1 1 1 0 0 0\n9 1 0.5 2650 1.5 2 3 0 0 0\n\nVelocities\n\n7 0 0 0 0 0 0\n9 0 0 0 0 0 "
    "0\n";
std::string const dump =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z "
    "radius\n"
    "7 0 0 0 0.1\nITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 5.5 1\n-1 5.25 "
    "0.5\n"
    "0 8 0.25\nITEM: ATOMS id type diameter xu yu zu\n7 1 1 1 1 1\n9 1 0.5 1.5 2 3\n";
std::string const mercury =
    "MercuryDPM 1.0 name Cube revision 1 repository none\nxMin 0 xMax 4 yMin -1 yMax 5 zMin 0 zMax 8\nSpecies 1\n"
    "LinearViscoelasticSpecies id 0 density 1 stiffness 1 dissipation 0\nWalls 6\nBoundaries 1\n"
    "PeriodicBoundary id 0 normal 1 0 0 scaleFactor 1 distanceLeft 0 distanceRight 4 shift 4 0 0\nParticles 2\n"
    "SphericalParticle id 7 indSpecies 0 position 1 1 1 orientation 1 0 0 0 velocity 0 0 0 radius 0.5 invMass 1\n"
    "BaseParticle id 9 indSpecies 0 position 1.5 2 3 velocity 0 0 0 radius 0.25 invMass 1\nInteractions 0\n";

std::string with(std::string text, std::string_view old, std::string_view other) {
  auto const at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), other);
}

}  // namespace

TEST_CASE("one packing reads alike from the files of other codes") {
  for (auto const& text :
       {yade, with(yade, "#format x_y_z_r\n", ""), with(yade, "#format x_y_z_r", "##PERIODIC:: 4 6 8"),
        std::string("#format id_x_y_z_r_matId\n7 1 1 1 0.5 0\n9 1.5 2 3 0.25 0\n"), lammps, dump, mercury,
        std::string("id,x,y,z,r\n7,1,1,1,0.5\n9,1.5,2,3,0.25\n")}) {
    CAPTURE(text);
    auto const grains = read(text).grains;
    CHECK(grains.column("x") == std::vector<double>{1.0, 1.5});
    CHECK(grains.column("y") == std::vector<double>{1.0, 2.0});
    CHECK(grains.column("z") == std::vector<double>{1.0, 3.0});
    CHECK(grains.column("r") == std::vector<double>{0.5, 0.25});
    bool const has_ids = text.find("\n7") != std::string::npos || text.find("id 7") != std::string::npos;
    CHECK(grains.column<std::int64_t>("id") ==
          (has_ids ? std::vector<std::int64_t>{7, 9} : std::vector<std::int64_t>{0, 1}));
  }
}

TEST_CASE("the cell is read where a file has one") {
  scarp::Tensor<3> box = scarp::Vector<3>(4.0, 6.0, 8.0).asDiagonal();
  CHECK_FALSE(read(yade).cell.has_value());
  CHECK(read(with(yade, "#format x_y_z_r", "##PERIODIC:: 4 6 8")).cell == box);
  CHECK(read(mercury).cell == box);
  CHECK(read("# O.cell.hSize = Matrix3( 4 , 0 , 0 , 0 , 6 , 0 , 0 , 0 , 8 )\n1 1 1 0.5\n").cell == box);
  box(0, 1) = 1.0;
  box(0, 2) = 0.5;
  box(1, 2) = 0.25;
  CHECK(read(lammps).cell == box);
  CHECK(read(dump).cell ==
        box);  // whose bounds are those of the sheared box: x 0 to 4 and 1.5 more, y -1 to 5 and 0.25 more
}

TEST_CASE("what a file holds beside the grains is told") {
  CHECK(read(yade).notes.empty());
  CHECK(samples::contains(read(mercury).notes.at(0), "6 walls are not read"));
  CHECK(samples::contains(read(dump).notes.at(0), "the last of 2 snapshots"));
  CHECK(samples::contains(read(with(dump, "yz pp pp pp", "yz pp ff pp")).notes.at(0), "not periodic"));
  CHECK(samples::contains(read(lammps).notes.at(0), "densities"));
  // Another unit system, a second material, grains that are held.
  auto const notes = [](std::string const& text) { return scarp::listed(read(text).notes, "; "); };
  CHECK(notes(with(with(lammps, "via write_data", "via write_data, units = micro"), "9 1 0.5", "9 3 0.5")) ==
        Naming{"2 materials", "units are 'micro'"});
  CHECK_FALSE(samples::contains(notes(with(lammps, "via write_data", "via write_data, units = si")), "units"));
  CHECK(notes("ITEM: UNITS\ncgs\n" + with(dump, "\n9 1 0.5", "\n9 4 0.5")) == Naming{"2 materials", "'cgs'"});
  CHECK(notes(with(mercury, "radius 0.25 invMass 1", "radius 0.25 invMass 0")) == Naming{"1 fixed grains"});
  CHECK(notes(with(mercury, "id 9 indSpecies 0", "id 9 indSpecies 1")) == Naming{"2 materials"});
  CHECK(notes(with(mercury, "PeriodicBoundary id", "DeletionBoundary id")) == Naming{"1 boundaries are not read"});
  CHECK_FALSE(samples::contains(notes(mercury), "boundaries"));
  CHECK(notes("#format x_y_z_r_matId\n1 1 1 0.5 0\n1.5 2 3 0.25 2\n") == Naming{"x_y_z_r_matId those behind r"});
  CHECK(notes("#format x_y_z_r_clumpId\n1 1 1 0.5 -1\n1.5 2 3 0.25 -1\n").empty());
}

TEST_CASE("a packing of spheres comes from another code's file") {
  using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;
  auto const file = read(lammps);
  auto const named = scarp::read_packing<Spheres>(file.grains, file.cell.value(), 2650.0, 1.0);
  CHECK(named.ids == std::vector<std::int64_t>{7, 9});
  CHECK(named.packing.population->size(1)[0] == 0.25);
  using Discs = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
  CHECK(samples::message_of([&] {
          scarp::read_packing<Discs>(file.grains, scarp::Tensor<2>::Identity() * 8.0, 2650.0, 0.2);
        }) == Naming{"line 14 of", "has '3' in column 'z'", "as spheres in space"});
}

TEST_CASE("what cannot be read is refused with the line") {
  CHECK(complaint(with(yade, "#format x_y_z_r", "#format r_x_y")) == Naming{"line 1 of", "export it as x_y_z_r"});
  CHECK(complaint(with(yade, "1.5\t2\t3\t0.25", "1.5 2 3")) == Naming{"line 4 of", "3 words (4 are needed)"});
  CHECK(complaint("# id x y z r\n1 1 1 1 0.5\n") == Naming{"line 1 of", "columns are not named"});
  CHECK(complaint("#format id_x_y_z_r_mass_clumpId\n0 1 1 1 0.5 7 -1\n1 1.5 2 3 0.25 7 12\n") ==
        Naming{"line 3 of", "member of a clump"});
  CHECK(complaint(with(lammps, "0 4 xlo xhi", "4 0 0 avec")) == Naming{"line 6 of", "general triclinic box"});
  CHECK(complaint(with(lammps, " # sphere", "")) == Naming{"line 11 of", "style is not named"});
  CHECK(complaint(with(lammps, "# sphere", "# atomic")) == Naming{"line 11 of", "the style 'atomic' has no diameters"});
  CHECK(complaint(with(lammps, "0 4 xlo", "0 x xlo")) == Naming{"line 6 of", "'x' (it is no number)"});
  CHECK(complaint(with(lammps, "9 1 0.5 2650 1.5 2 3 0 0 0", "9 1 0.5")) == Naming{"line 14 of", "3 words"});
  CHECK(complaint(with(dump, "id type diameter", "id type mass")) == Naming{"line 19 of", "id x y z radius"});
  CHECK(complaint(dump.substr(0, dump.find("0 5.5"))) == Naming{"ends too soon"});
  CHECK(complaint(dump.substr(0, dump.find("ITEM: ATOMS id type"))) == Naming{"line 15 of", "no ITEM: ATOMS follows"});
  CHECK(complaint(dump.substr(0, dump.find("9 1 0.5"))) == Naming{"announces 2 grains and has 1"});
  CHECK(complaint(with(lammps, "9 1 0.5 2650 1.5 2 3 0 0 0\n", "")) == Naming{"announces 2 grains and has 1"});
  CHECK(complaint(with(dump, "BOUNDS xy xz yz", "BOUNDS abc origin")) == Naming{"line 15 of", "general triclinic box"});
  CHECK(complaint(with(mercury, "position 1.5 2 3", "place 1.5 2 3")) == Naming{"line 10 of", "has no position"});
  CHECK(complaint(with(mercury, "Particles 2", "Particles 3")) == Naming{"line 11 of", "fewer particles"});
  CHECK(complaint(with(mercury, "Particles 2", "Particles 1")) == Naming{"line 10 of", "more particles"});
  CHECK(complaint(with(with(dump, "id type diameter", "id mol diameter"), "9 1 0.5", "9 1 0.5")) ==
        Naming{"molecule 1", "one body"});
  CHECK(complaint(with(mercury, "SphericalParticle", "SuperQuadricParticle")) ==
        Naming{"line 9 of", "spheres are read"});
  CHECK(samples::message_of([&] { read(with(lammps, "9 1 0.5", "9 1 half")).grains.column("r"); }) ==
        Naming{"line 14 of", "'half' in column 'r'"});
}
