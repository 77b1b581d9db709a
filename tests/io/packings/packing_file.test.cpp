// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/packings/packing_file.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/core/random.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/io/packings/packing_reader.hpp"
#include "scarp/shape/clump.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::contains;
using samples::content;
using samples::ScratchFolder;

using Discs = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
using Ellipses = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;

/// A law that remembers everything that a law may.
struct Rememberer {
  static constexpr scarp::ContactInputs inputs{.shear = true, .moment = true, .scalars = 2};
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const&, scarp::ContactMemory<Dim, T>&) const {
    return {};
  }
  scarp::ContactStiffness stiffness(double, double) const { return {.normal = 1.0}; }
};
static_assert(scarp::ContactLaw<Rememberer>);

scarp::LinearFrictional law() { return {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55}; }

/// columns x rows grains of 4 mm to 6 mm on a jittered square grid, touching here and there.
template <class PackingType>
PackingType grid(int columns, int rows, std::uint64_t seed, double spacing = 9e-3) {
  constexpr int dim = PackingType::dim;
  scarp::Random random(seed);
  std::string text = fmt::format("x,y,{},r,a,b,scale,angle\n", dim == 3 ? "z" : "not used");
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      double const size = random.uniform(4e-3, 6e-3);
      // One after the other: compilers evaluate arguments in an order of their own.
      double const x = spacing * (i + random.uniform(-0.05, 0.05));
      double const y = spacing * (j + random.uniform(-0.05, 0.05));
      double const z = spacing * random.uniform(0.0, 0.2);
      double const angle = random.uniform(0.0, std::numbers::pi);
      text += fmt::format("{},{},{},{},{},{},{},{}\n", x, y, z, size, size, 0.75 * size, 0.55 * size, angle);
    }
  }
  scarp::Vector<dim> sides = scarp::Vector<dim>::Constant(3.0 * spacing);
  sides(0) = columns * spacing;
  sides(1) = rows * spacing;
  scarp::Tensor<dim> const cell = sides.asDiagonal().toDenseMatrix();
  return scarp::read_packing<PackingType>(scarp::CsvColumns(text, "grid"), cell, 2650.0, dim == 2 ? 0.2 : 1.0).packing;
}

template <class PackingType>
void shear(PackingType& packing, int steps, double strain_step) {
  scarp::TimeStepper<PackingType> stepper;
  scarp::Tensor<2> step = scarp::Tensor<2>::Zero();
  step(0, 1) = strain_step;
  for (int k = 0; k < steps; ++k) REQUIRE(stepper.step(packing, law(), step).acceptable());
}

template <class PackingType>
PackingType saved_and_loaded(PackingType const& packing) {
  ScratchFolder const folder;
  scarp::save_packing(folder / "packing", packing);
  return scarp::load_packing<PackingType>(folder / "packing");
}

/// Every bit, padding included.
template <class PackingType>
void check_same(PackingType loaded, PackingType const& packing) {
  auto const& made = *loaded.population;
  auto const& original = *packing.population;
  CHECK(made.sizes() == original.sizes());
  CHECK(made.density() == original.density());
  CHECK(made.thickness() == original.thickness());
  CHECK(made.content() == original.content());
  CHECK(made.mass() == original.mass());
  CHECK(made.smallest_radius() == original.smallest_radius());
  CHECK(made.largest_radius() == original.largest_radius());
  CHECK(made.largest_eccentricity() == original.largest_eccentricity());
  for (std::size_t i = 0; i < original.count(); ++i) {
    CHECK(made.inverse_mass()[i] == original.inverse_mass()[i]);
    CHECK(made.inverse_inertia()[i] == original.inverse_inertia()[i]);
  }
  loaded.population = packing.population;  // which is otherwise compared by address
  CHECK(loaded == packing);
}

template <class Scalar, int Count>
void fill(scarp::SoaArray<Scalar, Count>& columns, scarp::Random& random) {
  if constexpr (Count > 0) {
    for (std::size_t i = 0; i < columns.rows(); ++i) {
      for (int k = 0; k < Count; ++k) columns(i, k) = static_cast<Scalar>(random.uniform(-1.0, 1.0));
    }
  }
}

/// A packing whose members all hold something.
template <class PackingType>
PackingType filled(int columns, int rows) {
  auto packing = grid<PackingType>(columns, rows, 3);
  REQUIRE(scarp::rebuild_pairs(packing, 1e-3).acceptable());
  REQUIRE(packing.pairs.count() > 5);
  REQUIRE(packing.pairs.ghost_owner.size() > 2);
  scarp::Random random(4);
  fill(packing.velocity, random);
  fill(packing.spin, random);
  fill(packing.pairs.shear, random);
  fill(packing.pairs.moment, random);
  fill(packing.pairs.scalars, random);
  packing.pairs.drift = 1e-4;
  packing.pairs.critical_step = 1e-5;
  return packing;
}

std::string complaint_about(std::string const& bytes) {
  return samples::message_of([&] { static_cast<void>(scarp::detail::packing_of<Ellipses>(bytes)); });
}

template <class PackingType>
std::string bytes_of(PackingType const& packing) {
  ScratchFolder const folder;
  scarp::save_packing(folder / "packing", packing);
  return content(folder / "packing");
}

/// With the hash that fits.
std::string signed_again(std::string bytes) {
  std::uint64_t const hash = scarp::detail::hash_of(std::string_view(bytes).substr(0, bytes.size() - sizeof(hash)));
  std::memcpy(bytes.data() + bytes.size() - sizeof(hash), &hash, sizeof(hash));
  return bytes;
}

}  // namespace

TEST_CASE_TEMPLATE("a packing comes back with the same bits", PackingType, Discs, Ellipses, Spheres,
                   scarp::Packing<scarp::Ellipse, scarp::LinearFrictional, float>,
                   scarp::Packing<scarp::Ellipse, Rememberer>, scarp::Packing<scarp::Sphere, Rememberer, float>,
                   scarp::Packing<scarp::Clump<scarp::DumbbellTemplate>, Rememberer>) {
  auto const packing = filled<PackingType>(6, 5);
  check_same(saved_and_loaded(packing), packing);
}

TEST_CASE("a packing that has no pairs yet comes back without any") {
  auto const packing = grid<Ellipses>(5, 10, 1);
  check_same(saved_and_loaded(packing), packing);
}

TEST_CASE("a packing saved in the middle of shearing ends like one that never stopped") {
  auto uninterrupted = grid<Ellipses>(5, 10, 1, 8e-3);  // so dense that all its life it carries load

  SUBCASE("while its pairs stay") {
    constexpr double strain_step = 1e-9;  // so little that no list of pairs grows old
    shear(uninterrupted, 3000, 0.0);      // until the grid has come to rest
    shear(uninterrupted, 300, strain_step);
    auto loaded = saved_and_loaded(uninterrupted);
    auto const before = uninterrupted;
    check_same(loaded, uninterrupted);
    shear(uninterrupted, 300, strain_step);
    shear(loaded, 300, strain_step);
    check_same(loaded, uninterrupted);
    CHECK(uninterrupted.pairs.first == before.pairs.first);
    CHECK(uninterrupted.pairs.drift > before.pairs.drift);  // a new list would start at zero
    CHECK(uninterrupted.pairs.shear != before.pairs.shear);
  }
  SUBCASE("across new lists of pairs and a flip of the lattice") {
    constexpr double strain_step = 5e-4;
    shear(uninterrupted, 300, strain_step);
    auto loaded = saved_and_loaded(uninterrupted);
    auto const before = uninterrupted;
    check_same(loaded, uninterrupted);
    shear(uninterrupted, 300, strain_step);
    shear(loaded, 300, strain_step);
    check_same(loaded, uninterrupted);
    CHECK(uninterrupted.pairs.first != before.pairs.first);
    CHECK(uninterrupted.pairs.shear != before.pairs.shear);
    CHECK(uninterrupted.cell(0, 1) < before.cell(0, 1));  // it grows but for the flip, which takes a base vector off
  }
}

TEST_CASE("saving replaces a file as a whole or not at all") {
  ScratchFolder const folder;
  auto const path = folder / "state.pack";
  scarp::save_packing(path, grid<Discs>(3, 3, 1));
  auto const before = content(path);
  CHECK_THROWS_WITH_AS(scarp::save_packing(path, Discs{}), doctest::Contains("has no grains"), scarp::InputError);
  CHECK(samples::message_of<scarp::FileError>([&] {
          static_cast<void>(scarp::save_packing(folder / "nowhere" / "state.pack", grid<Discs>(3, 3, 1)));
        }) == samples::Naming{"nowhere"});
  CHECK(content(path) == before);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a file that is missing, or none of a packing, is refused by name") {
  ScratchFolder const folder;
  CHECK_THROWS_WITH_AS(scarp::load_packing<Discs>(folder / "nowhere.pack"),
                       doctest::Contains("nowhere.pack' (there is no such file)"), scarp::InputError);
  scarp::write_file(folder / "table.csv", "id,x,y,r\n1,2,3,4\n");
  CHECK_THROWS_WITH_AS(scarp::load_packing<Discs>(folder / "table.csv"),
                       doctest::Contains("table.csv': it is no packing (it does not begin with SCARPPAK)"),
                       scarp::InputError);
  for (auto const* const bytes : {"", "SCARP", "id,x,y,r\n1,2,3,4\n"}) {
    CHECK(contains(complaint_about(bytes), "it is no packing"));
  }
  CHECK(contains(complaint_about("SCARPPAK"), "it ends inside 'order of bytes'"));
}

TEST_CASE("a file of another machine or version is refused with the reason") {
  auto bytes = bytes_of(grid<Ellipses>(3, 3, 1));
  auto other = bytes;
  std::reverse(other.begin() + 8, other.begin() + 12);
  CHECK(contains(complaint_about(other), "its order of bytes is 0x04030201 (this machine writes 0x01020304)"));
  other = bytes;
  other[12] = std::endian::native == std::endian::little ? 99 : 0;
  CHECK(contains(complaint_about(other), "it is of version"));
  for (std::uint32_t const version : {1U, 3U, 5U}) {  // older ones too
    std::memcpy(other.data() + 12, &version, sizeof(version));
    CHECK(contains(complaint_about(other), fmt::format("it is of version {} (this library reads version 4)", version)));
  }
}

TEST_CASE("a file is refused as another type than it was saved as") {
  CHECK(contains(complaint_about(bytes_of(grid<Discs>(3, 3, 1))),
                 "it has 1 sizes of a grain (the requested type has 2): load it as the type that was saved"));
  CHECK(contains(complaint_about(bytes_of(grid<Spheres>(3, 3, 1))), "it has 3 dimensions"));
  CHECK(
      contains(complaint_about(bytes_of(grid<scarp::Packing<scarp::Ellipse, scarp::LinearFrictional, float>>(3, 3, 1))),
               "it has 4 bytes of a number"));
  CHECK(contains(complaint_about(bytes_of(grid<scarp::Packing<scarp::Ellipse, Rememberer>>(3, 3, 1))),
                 "it has 1 remembered moments of a contact"));
}

namespace {

/// As many discs as the dumbbell has, in other places.
struct Twin {
  static constexpr std::array<scarp::ClumpMember, scarp::DumbbellTemplate::members.size()> members{
      {{.x = 0.0, .y = 0.0, .radius = 1.0}, {.x = 0.1, .y = 0.0, .radius = 1.0}}};
};

}  // namespace

TEST_CASE("clumps of another template are told apart by their content") {
  ScratchFolder const folder;
  scarp::save_packing(folder / "clumps",
                      grid<scarp::Packing<scarp::Clump<scarp::DumbbellTemplate>, scarp::LinearFrictional>>(3, 3, 1));
  CHECK_THROWS_WITH_AS(
      (scarp::load_packing<scarp::Packing<scarp::Clump<Twin>, scarp::LinearFrictional>>(folder / "clumps")),
      doctest::Contains("load it as the shape that was saved"), scarp::InputError);
}

TEST_CASE("a file that was cut off is refused at any length") {
  auto const bytes = bytes_of(filled<Ellipses>(3, 3));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    CAPTURE(length);
    CHECK(complaint_about(bytes.substr(0, length)) != "");
  }
  CHECK(contains(complaint_about(bytes.substr(0, bytes.size() - 1)), "it was cut off"));
  CHECK(contains(complaint_about(bytes + "x"), "or added to"));
}

TEST_CASE("a file of which a byte has changed is refused") {
  auto const bytes = bytes_of(filled<Ellipses>(3, 3));
  scarp::Random random(11);
  for (int k = 0; k < 500; ++k) {
    auto harmed = bytes;
    std::size_t const place = random.next() % bytes.size();
    harmed[place] = static_cast<char>(harmed[place] ^ static_cast<char>(1 + random.next() % 255));
    CAPTURE(place);
    CHECK(complaint_about(harmed) != "");
  }
}

// Not by chance but by a faulty writer: the hash fits, the content does not.
TEST_CASE("a file with wrong members and the right hash is refused, or is a packing whose pairs can be walked") {
  auto const packing = filled<Ellipses>(3, 3);
  auto const bytes = bytes_of(packing);
  scarp::Random random(12);
  int refused = 0;
  constexpr int trials = 3000;
  for (int k = 0; k < trials; ++k) {
    auto harmed = bytes;
    std::size_t const place = 24 + random.next() % (bytes.size() - 32);
    harmed[place] = static_cast<char>(random.next());
    try {
      auto const loaded = scarp::detail::packing_of<Ellipses>(signed_again(harmed));
      std::size_t visited = 0;
      scarp::for_each_near_pair(loaded, law(), [&](auto const&) { ++visited; });
      CHECK(visited == loaded.pairs.count());
    } catch (scarp::InputError const&) {
      ++refused;
    }
  }
  CHECK(refused > 0);
  CHECK(refused < trials);  // most bytes belong to places and memories, which may be anything
}

TEST_CASE("members that do not fit each other are refused") {
  auto const complaint = [](auto change) {
    auto packing = filled<Ellipses>(3, 3);
    change(packing);
    return complaint_about(bytes_of(packing));
  };
  CHECK(
      contains(complaint([](auto& packing) { packing.velocity.resize(8); }), "its arrays of grains differ in length"));
  CHECK(contains(complaint([](auto& packing) { packing.pairs.shear.resize(1); }),
                 "its arrays of pairs differ in length"));
  CHECK(contains(complaint([](auto& packing) { packing.pairs.second[0] = 1000; }),
                 "pairs name grains that are not there"));
  CHECK(
      contains(complaint([](auto& packing) { packing.pairs.first[0] = -1; }), "pairs name grains that are not there"));
  CHECK(contains(complaint([](auto& packing) { packing.pairs.ghost_owner[0] = 9; }), "its ghosts have no owner"));
  CHECK(contains(complaint([](auto& packing) { packing.cell.setZero(); }), "its cell has no positive content"));
}

// A file on somebody's disk, not one that this program has just written. Where the format's version is raised, this
// command writes the new file, and the old one stays to be refused:
// SCARP_STORE=1 ctest --test-dir build -R io/packings/packing_file
TEST_CASE("a packing that was stored is read, or refused with its version where the format has another one now") {
  auto const folder = std::filesystem::path(__FILE__).parent_path() / "../../reference/stored";
  auto const newest = folder / fmt::format("discs_{}.packing", scarp::detail::packing_format.version);
  auto const expected = grid<Discs>(3, 3, 1);
  if (std::getenv("SCARP_STORE") != nullptr) scarp::save_packing(newest, expected);
  REQUIRE(std::filesystem::exists(newest));
  for (auto const& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".packing") continue;
    if (file.path().filename() == newest.filename()) {
      check_same(scarp::load_packing<Discs>(file.path()), expected);
    } else {
      CHECK_REFUSED(scarp::load_packing<Discs>(file.path()), file.path().filename().string(), "it is of version");
    }
  }
}
