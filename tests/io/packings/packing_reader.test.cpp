// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/packings/packing_reader.hpp"

#include <doctest/doctest.h>

#include "../../../examples/shared/contact_reader.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "scarp/shape/clump.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/shape/superellipse.hpp"
#include "support/approx.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

/// A shape that the library's tables do not know, as a user adds it.
struct Coin : scarp::Disc {};

template <>
struct scarp::GrainColumns<Coin> {
  static constexpr std::array<std::string_view, 1> size{"coin radius"};
};

namespace {

using samples::contains;
using samples::message_of;

using Discs = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
using Ellipses = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;

static_assert(!scarp::HasGrainColumns<scarp::LinearFrictional>);

constexpr double density = 2650.0;  // [kg/m3]
constexpr double thickness = 0.2;   // [m]

std::filesystem::path reference(char const* name) {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "reference" / name;
}

scarp::LinearFrictional law() { return {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55}; }

/// Base vectors of Yade's cell, the columns of its hSize.
scarp::Tensor<2> yade_cell() {
  scarp::Tensor<2> cell;
  cell << 0.19516606047263926, 0.0008502401980710722, 0.0, 0.19043137125613024;
  return cell;
}

scarp::NamedPacking<Discs> yade_packing(scarp::Tensor<2> const& cell = yade_cell()) {
  return scarp::read_packing<Discs>(reference("yade/particles.csv"), cell, density, thickness);
}

/// Reads grains of radius 0.5 and the like from text, in a square cell of side 10 m.
template <class PackingType = Discs>
scarp::NamedPacking<PackingType> grains(std::string_view text) {
  return scarp::read_packing<PackingType>(scarp::CsvColumns(text, "grains.csv"),
                                          10.0 * scarp::Tensor<PackingType::dim>::Identity(), density, 1.0);
}

template <class PackingType = Discs>
std::string complaint_about(std::string_view text) {
  return message_of([&] { grains<PackingType>(text); });
}

constexpr std::string_view two_discs = "id,x,y,r\n20,0.25,5,0.5\n10,9.3,-5,0.5\n";

std::string complaint_about_contacts(std::string_view text) {
  return message_of([&] {
    auto named = grains(two_discs);
    examples::read_contacts(named, scarp::CsvColumns(text, "contacts.csv"), law());
  });
}

}  // namespace

// Expected values of this case: Yade 2023.02a, see tests/reference/README.md; the numbers are those of its functions
// getStress, getStressAndTangent and fabricTensor. Both codes sum 872 contacts in double: 1e-6 leaves room for the
// digits that are given, not for another contact or another convention.
TEST_CASE("a packing of Yade's with its shear forces has Yade's stress, tangent, fabric and void ratio") {
  auto named = yade_packing();
  examples::read_contacts(named, reference("yade/contacts.csv"), law());
  auto const& packing = named.packing;
  auto const state = scarp::balance(packing, law());
  CHECK(state.contacts == 872);
  constexpr double relative = 1e-6;
  auto const near = [&](double expected) { return samples::Approx(expected).epsilon(relative); };
  CHECK(state.stress(0, 0) == near(-200000.0379345945));
  CHECK(state.stress(0, 1) == near(-0.2002965082033865));
  CHECK(state.stress(1, 0) == near(-0.20029650887530226));
  CHECK(state.stress(1, 1) == near(-199999.98436821403));

  // Yade leaves the tangential part out where the shear force is exactly zero: here it is nowhere.
  std::size_t unsheared = 0;
  scarp::for_each_contact(packing, law(), [&](auto const& contact) { unsheared += contact.memory.shear == 0.0; });
  CHECK(unsheared == 0);
  auto const tangent = scarp::to_voigt_tangent<2>(scarp::contact_tangent(packing, law()));
  CHECK(tangent(0, 0) == near(35594172.46918926));
  CHECK(tangent(1, 1) == near(35592618.6500566));
  CHECK(tangent(2, 2) == near(17796697.779811487));
  CHECK(tangent(0, 2) == near(19979.818617200144));
  CHECK(tangent(1, 2) == near(19979.81861718862));
  CHECK(std::abs(tangent(0, 1)) < relative * tangent(2, 2));  // equal stiffnesses cancel

  auto const fabric = scarp::contact_network(packing, law()).fabric;
  CHECK(fabric(0, 0) == near(0.5010209421012718));
  CHECK(fabric(0, 1) == near(0.00042532993014984105));
  CHECK(packing.void_ratio() == near(0.16638427244932621));
}

TEST_CASE("shear forces come from the file, contact by contact, with the sign that the pair needs") {
  auto named = yade_packing();
  auto const at_rest = named.packing.position;
  examples::read_contacts(named, reference("yade/contacts.csv"), law());
  auto const table = scarp::read_csv(reference("yade/contacts.csv"));
  auto const first = table.column<std::int64_t>("id1");
  auto const second = table.column<std::int64_t>("id2");
  auto const fx = table.column("ftx");
  auto const fy = table.column("fty");
  CHECK(at_rest.rows() == 400);
  std::map<std::pair<std::int64_t, std::int64_t>, scarp::Vector<2>> listed;  // force on the grain with the larger id
  for (std::size_t c = 0; c < table.rows(); ++c) {
    double const sign = first[c] < second[c] ? 1.0 : -1.0;
    listed[std::minmax(first[c], second[c])] = sign * scarp::Vector<2>(fx[c], fy[c]);
  }
  REQUIRE(listed.size() == 872);  // the cell is so wide that no two grains touch twice
  double largest = 0.0;
  double worst = 0.0;
  scarp::for_each_contact(named.packing, law(), [&](auto const& contact) {
    auto const i = named.ids[contact.first];
    auto const j = named.ids[contact.second];
    auto const& expected = listed.at(std::minmax(i, j));
    scarp::Vector<2> const force = (i < j ? 1.0 : -1.0) * contact.shear_force();
    largest = std::max(largest, expected.norm());
    worst = std::max(worst, (force - expected).norm());
  });
  CHECK(largest == samples::Approx(1.7921545373672846e-4));  // Yade's max_abs_shear_force
  // shear_force() is a difference of numbers of some 1000 N: its round-off is 1e-13 N, Yade's frame turns to 1e-12.
  CHECK(worst < 1e-11);
}

TEST_CASE("contacts are found where the file's cell is not reduced and its images are others than ours") {
  auto const straight = [] {
    auto named = yade_packing();
    examples::read_contacts(named, reference("yade/contacts.csv"), law());
    return named;
  }();
  // The same lattice by other base vectors: a2' = a2 + 3 a1, so that shift (i, j) becomes (i - 3 j, j).
  scarp::Tensor<2> oblique = yade_cell();
  oblique.col(1) += 3.0 * oblique.col(0);
  auto named = yade_packing(oblique);
  auto const table = scarp::read_csv(reference("yade/contacts.csv"));
  auto const i = table.column<int>("cell_i");
  auto const j = table.column<int>("cell_j");
  std::string text = "id1,id2,cell_i,cell_j,ftx,fty\n";
  for (std::size_t c = 0; c < table.rows(); ++c) {
    // Every other contact is told from the other side.
    bool const turned = c % 2 == 1;
    double const sign = turned ? -1.0 : 1.0;
    auto const first = table.column<int>(turned ? "id2" : "id1")[c];
    auto const second = table.column<int>(turned ? "id1" : "id2")[c];
    text += fmt::format("{},{},{},{},{},{}\n", first, second, (turned ? -1 : 1) * (i[c] - 3 * j[c]),
                        (turned ? -1 : 1) * j[c], sign * table.column("ftx")[c], sign * table.column("fty")[c]);
  }
  examples::read_contacts(named, scarp::CsvColumns(text, "oblique.csv"), law());
  auto const expected = scarp::balance(straight.packing, law());
  auto const state = scarp::balance(named.packing, law());
  CHECK(state.contacts == 872);
  // Wrapping by other vectors costs round-off of positions, 1e-16 m of overlaps of 1e-4 m.
  CHECK((state.stress - expected.stress).norm() < 1e-9 * expected.stress.norm());
  // Shear forces of 1e-4 N show in the stress's shear part: the wrong sign of every other one would change it.
  CHECK(state.stress(0, 1) == samples::Approx(expected.stress(0, 1)).epsilon(1e-6));
}

// Expected: SudoDEM2D 6666937. The cell is L0 (exp ex, exp ey) with the logarithmic strains ex, ey at the start of
// shearing and L0^2 = sum of pi a^2 / 0.42. Positions are rounded to 5e-8 m, overlaps are 4.5e-5 m in the mean.
TEST_CASE("a packing of SudoDEM's has SudoDEM's contacts and void ratio") {
  auto const path = reference("sudodem/A_particles.csv");
  double discs = 0.0;
  for (double const a : scarp::read_csv(path).column("a")) discs += std::numbers::pi * a * a;
  double const side = std::sqrt(discs / 0.42);
  scarp::Tensor<2> cell = scarp::Tensor<2>::Zero();
  cell(0, 0) = side * std::exp(-0.5063647597133606);
  cell(1, 1) = side * std::exp(-0.50607017741176);
  CHECK(cell(0, 0) == samples::Approx(0.16526).epsilon(1e-4));  // as the README rounds it
  auto packing = scarp::read_packing<Ellipses>(path, cell, density, thickness).packing;
  CHECK(packing.void_ratio() == samples::Approx(0.15343875585097405).epsilon(1e-6));
  REQUIRE(scarp::rebuild_pairs(packing, 1e-3).acceptable());
  auto const state = scarp::balance(packing, law());
  CHECK(state.contacts == 956);
  // Without their shear forces contacts give the mean stress only: normal forces carry all of it in discs, nearly in
  // these.
  CHECK(state.stress.trace() / 2.0 == samples::Approx(-2e5).epsilon(0.01));
}

TEST_CASE("grains may have any ids, and none at all") {
  auto const named = grains(two_discs);
  CHECK(named.ids == std::vector<std::int64_t>{20, 10});
  CHECK(named.grain.at(10) == 1);
  CHECK(named.packing.position(1, 1) == -5.0);  // not wrapped
  CHECK(named.packing.population->size(0)[0] == 0.5);
  CHECK(grains("r,y,x\n0.5,1,2\n").ids == std::vector<std::int64_t>{0});
}

TEST_CASE("each shape has its columns") {
  auto const spheres = grains<Spheres>("id,x,y,z,r\n1,1,2,3,0.5\n").packing;
  CHECK(spheres.position.row(0) == std::array{1.0, 2.0, 3.0});
  CHECK(spheres.population->size(0)[0] == 0.5);

  auto const ellipses = grains<Ellipses>("id,x,y,a,b,angle\n1,1,2,0.5,0.25,0.3\n").packing;
  CHECK(ellipses.population->size(0) == std::array{0.5, 0.25});
  CHECK(ellipses.orientation.row(0) == std::array{std::cos(0.3), std::sin(0.3)});

  using Superellipses = scarp::Packing<scarp::Superellipse, scarp::LinearFrictional>;
  auto const superellipses = grains<Superellipses>("x,y,a,b,eps,angle\n1,2,0.5,0.25,0.8,0.3\n").packing;
  CHECK(superellipses.population->size(0) == std::array{0.5, 0.25, 0.8});
  CHECK(contains(complaint_about<Superellipses>("x,y,a,b,eps,angle\n1,2,0.5,0.25,1.95,0\n"),
                 "line 2 of 'grains.csv': exponent"));

  using Clumps = scarp::Packing<scarp::Clump<scarp::DumbbellTemplate>, scarp::LinearFrictional>;
  auto const clumps = grains<Clumps>("x,y,scale,angle\n1,2,0.5,0\n").packing;
  CHECK(clumps.population->size(0) == std::array{0.5});
}

TEST_CASE("a new shape brings its columns along") {
  using Coins = scarp::Packing<Coin, scarp::LinearFrictional>;
  CHECK(grains<Coins>("x,y,coin radius\n1,2,0.5\n").packing.population->size(0)[0] == 0.5);
}

TEST_CASE("numbers in single precision are those of the file, rounded") {
  using Floats = scarp::Packing<scarp::Disc, scarp::LinearFrictional, float>;
  auto named = scarp::read_packing<Floats>(reference("yade/particles.csv"), yade_cell(), density, thickness);
  // Positions of 0.2 m are good to 1e-8 m, 3e-6 of the smallest radius.
  examples::read_contacts(named, reference("yade/contacts.csv"), law(), 1e-4);
  CHECK(scarp::balance(named.packing, law()).stress.trace() / 2.0 == samples::Approx(-2e5).epsilon(1e-3));
}

TEST_CASE("grains that cannot be are refused with their line") {
  CHECK(complaint_about("x,y,r\n") == samples::Naming{"'grains.csv' lists no grain"});
  CHECK(complaint_about("id,x,y,r\n7,1,1,0.5\n8,3,3,0.5\n7,5,5,0.5\n") ==
        samples::Naming{"line 4 of 'grains.csv'", "'7' in column 'id'", "line 2"});
  CHECK(contains(complaint_about("x,y,r\n1,1,0.5\n3,3,0\n"),
                 "line 3 of 'grains.csv' has '0' in column 'r' (a size is above zero)"));
  CHECK(contains(complaint_about<Ellipses>("x,y,a,b,angle\n1,1,0.5,-0.2,0\n"), "'-0.2' in column 'b'"));
  CHECK(contains(complaint_about("x,y,r\n1,1e9,0.5\n"), "'1e9' in column 'y' (it is more than a million cells away)"));
  CHECK(contains(complaint_about("x,y,r\nnan,1,0.5\n"), "line 2 of 'grains.csv' has 'nan' in column 'x'"));
  CHECK(contains(complaint_about("x,y\n1,1\n"), "has no column 'r'"));
  CHECK(contains(complaint_about<Ellipses>("x,y,a,b\n1,1,0.5,0.3\n"), "has no column 'angle'"));
  CHECK(contains(complaint_about("id,x,y,r\n1.5,1,1,0.5\n"), "it is no whole number"));
}

TEST_CASE("grains that lie in one another are refused by their ids, also across the boundary of the cell") {
  CHECK(contains(complaint_about("id,x,y,r\n3,9.9,5,0.5\n5,5,5,1\n7,0.2,5,0.5\n"),
                 "grains 3 and 7 of 'grains.csv' overlap by 0.7"));
  CHECK(contains(complaint_about("x,y,r\n1,1,0.5\n1,1,0.5\n"), "grains 0 and 1 of 'grains.csv' overlap by 1 m"));
  CHECK(contains(complaint_about<Ellipses>("x,y,a,b,angle\n1,1,0.5,0.3,0\n1,1,0.5,0.3,1\n"), "grains 0 and 1"));
  CHECK(contains(complaint_about<Spheres>("x,y,z,r\n1,1,1,0.5\n1,1,1,0.5\n"), "grains 0 and 1"));
  CHECK(complaint_about("id,x,y,r\n3,9.9,5,0.5\n7,0.5,5,0.5\n") == "");  // 0.4 m: deep, yet outside
}

TEST_CASE("a cell that cannot hold the grains is refused") {
  auto const in_cell = [](double xx, double yy) {
    return message_of([&] {
      scarp::read_packing<Discs>(scarp::CsvColumns("x,y,r\n1,1,0.5\n", "grains.csv"),
                                 scarp::Vector<2>(xx, yy).asDiagonal().toDenseMatrix(), density, thickness);
    });
  };
  CHECK(contains(in_cell(10.0, -10.0), "has a content of -100"));
  CHECK(contains(in_cell(std::nan(""), 10.0), "must be finite"));
  CHECK(contains(in_cell(10.0, 0.9), "do not fit into their cell"));
  CHECK(in_cell(10.0, 1.1) == "");
}

TEST_CASE("contacts are set by ids and images that refer to places as the file has them") {
  // Grain 10 stands at y = -5, one cell below grain 20; 0.95 m apart across the boundary of x.
  auto named = grains(two_discs);
  examples::read_contacts(named, scarp::CsvColumns("id1,id2,cell_i,cell_j,ftx,fty\n20,10,-1,1,0,7\n", "contacts.csv"),
                          law());
  int contacts = 0;
  scarp::for_each_contact(named.packing, law(), [&](auto const& contact) {
    ++contacts;
    bool const upright = named.ids[contact.second] == 10;
    CHECK(contact.shear_force()(1) == samples::Approx(upright ? 7.0 : -7.0));
  });
  CHECK(contacts == 1);
  CHECK(named.packing.pairs.critical_step > 0.0);
}

TEST_CASE("shear forces in space are laid into the tangent plane") {
  auto named = grains<Spheres>("id,x,y,z,r\n1,1,5,5,0.5\n2,1.95,5,5,0.5\n");
  examples::read_contacts(
      named, scarp::CsvColumns("id1,id2,cell_i,cell_j,cell_k,ftx,fty,ftz\n2,1,0,0,0,0,3,-4\n", "contacts.csv"), law());
  REQUIRE(named.packing.pairs.count() == 1);
  CHECK(named.packing.pairs.shear.row(0) == std::array{0.0, -3.0, 4.0});
}

TEST_CASE("contacts that cannot be are refused with their line") {
  std::string const head = "id1,id2,cell_i,cell_j,ftx,fty\n";
  CHECK(contains(complaint_about_contacts(head + "20,11,-1,1,0,0\n"),
                 "line 2 of 'contacts.csv' has '11' in column 'id2' (no grain of the packing has this id)"));
  CHECK(contains(complaint_about_contacts(head + "20,10,0,0,0,0\n"),
                 "line 2 of 'contacts.csv' lists a contact of grains 20 and 10 (they are not near each other"));
  CHECK(contains(complaint_about_contacts(head + "20,10,-1,1,0,0\n10,20,1,-1,0,0\n"), "(line 2 lists the same)"));
  CHECK(contains(complaint_about_contacts(head + "20,10,-1.5,1,0,0\n"), "it is no whole number"));
  CHECK(contains(complaint_about_contacts("id1,id2,cell_i,cell_j,ftx\n"), "has no column 'fty'"));
  CHECK(contains(complaint_about_contacts("id1,id2,cell_i,cell_j,ftx,fty,overlap\n20,10,-1,1,0,0,0.051\n"),
                 "has '0.051' in column 'overlap' (in the packing it is 0.0"));
  CHECK(complaint_about_contacts("id1,id2,cell_i,cell_j,ftx,fty,overlap\n20,10,-1,1,0,0,0.05\n") == "");
}

TEST_CASE("contacts are refused for a packing that already has its pairs, and then nothing changes") {
  auto named = grains(two_discs);
  std::string const text = "id1,id2,cell_i,cell_j,ftx,fty\n20,10,-1,1,0,7\n";
  scarp::CsvColumns const good(text, "contacts.csv");
  auto const before = named.packing;
  CHECK_REFUSED(examples::read_contacts(named, scarp::CsvColumns(text + "20,20,0,0,0,0\n", "contacts.csv"), law()),
                "line 3 of 'contacts.csv'");
  CHECK(named.packing == before);
  examples::read_contacts(named, good, law());
  CHECK_THROWS_WITH_AS(examples::read_contacts(named, good, law()), doctest::Contains("right after the grains"),
                       scarp::InputError);
}

TEST_CASE("grains too small or too large to have a mass are refused") {
  for (double const radius : {1e-300, 1e-160, 1e200}) {
    CAPTURE(radius);
    auto const said = message_of([&] { scarp::Population<scarp::Disc>({{radius}}, density, 1.0); });
    CHECK(contains(said, "beyond what a number here can hold"));
  }
}

TEST_CASE("grains in space are not read as grains in the plane, and a plane with a height is one") {
  std::string const complaint = complaint_about("x,y,z,r\n1,1,1,0.5\n4,4,2,0.5\n");
  CHECK(contains(complaint, "line 3 of 'grains.csv'"));
  CHECK(contains(complaint, "column 'z'"));
  CHECK(complaint_about("x,y,z,r\n1,1,2,0.5\n4,4,2,0.5\n").empty());
}

TEST_CASE("contacts of a packing whose cell has become too thin for its grains are refused") {
  auto named = grains(two_discs);
  named.packing.cell *= 0.05;
  CHECK_REFUSED(examples::read_contacts(
                    named, scarp::CsvColumns("id1,id2,cell_i,cell_j,ftx,fty\n10,20,1,-1,0,0\n", "contacts.csv"), law()),
                "contacts.csv", "cell is too thin for its grains");
}
