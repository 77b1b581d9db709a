// SPDX-License-Identifier: BSL-1.0
// What a program does that refines its mesh and shares its points out among processes: points are copied, mirrored,
// sent and seen across the border between two processes.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "constitutive/nestings.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/points/point_file.hpp"
#include "scarp/points/region.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "support/files.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Gradient;
using Points = scarp::MaterialPoints<2>;
using Rve = scarp::DemRve<samples::Ellipses, scarp::SamePacking<samples::Ellipses>>;

std::vector<scarp::Site<2>> in_a_row(int count) {
  std::vector<scarp::Site<2>> sites(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) sites[static_cast<std::size_t>(k)] = {.index = k, .position = {0.1 * k, 0.0}};
  return sites;
}

Rve sand() { return {.law = samples::study_law(), .source = {samples::consolidated<samples::Ellipses>(40).packing}}; }

Gradient<2> increment(double size) {
  Gradient<2> gradient;
  gradient << -0.3 * size, size, 0.4 * size, -size;
  return gradient;
}

/// Linear elastic soil that stores its strain in Voigt's notation.
struct StoresVoigtStrain {
  static constexpr int dim = 2;
  struct State {
    scarp::EngineeringStrain<2> strain{-1e-3, -2e-3, 1e-3};
    SCARP_MEMBERS(strain)
  };
  State initial_state(scarp::Site<2> const&) const { return {}; }
  scarp::VoigtStress<2> stress(State const& state) const { return tangent(state) * state.strain; }
  scarp::VoigtTangent<2> tangent(State const&) const { return scarp::IsotropicElasticity{6e6, 4e6}.stiffness<2>(); }
  scarp::Response<2> respond(State const& committed, Gradient<2> const& increment, State& trial) const {
    trial.strain = committed.strain + scarp::to_engineering_strain<2, double>(increment);
    return {stress(trial), {}};
  }
};

/// One load step of all points.
void strain(Points& points, auto const& gradient_of) {
  scarp::SerialExecutor serial;
  for (int k = 0; k < points.size(); ++k) points.gradient(k) = gradient_of(k);
  REQUIRE(points.respond(serial).verdict.acceptable());
  points.commit();
}

/// visit(name, provider) for laws, packings and every adaptor around every adaptor.
void for_each_provider(auto const& visit) {
  visit("packing", sand());
  visit("floor around packing", scarp::StiffnessFloor<Rve>{sand(), 1e-2});
  visit("elastic", scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3));
  visit("mohr_coulomb",
        scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength>{
            scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3),
            {.peak = {.cohesion = 200.0, .friction = 0.5}, .residual = {.cohesion = 100.0, .friction = 0.4}},
            {}});
  nestings::for_each(visit);
}

}  // namespace

TEST_CASE(
    "a copied point responds as the first one; a mirrored one keeps the stress and responds to mirrored strain by "
    "mirrored stress") {
  for_each_provider([](std::string const& name, auto const& provider) {
    CAPTURE(name);
    auto const sites = in_a_row(1);
    Points first(provider, sites);
    for (int step = 1; step <= 3; ++step) strain(first, [&](int) { return increment(2e-5 * step); });
    Points copy(provider, sites);
    Points image(provider, sites);
    copy.copy(0, first, 0);
    image.copy(0, first, 0, true);
    CHECK(copy.pack(0) == first.pack(0));
    auto const start = first.committed_stress(0);
    REQUIRE(start.norm() > 0.0);
    CHECK((image.committed_stress(0) - start).norm() < 1e-9 * start.norm());
    auto const normal = scarp::principal_direction<2>(start);
    scarp::Tensor<2> const mirror = scarp::reflection<2>(normal);
    for (int step = 1; step <= 3; ++step) {
      strain(first, [&](int) { return increment(1e-5 * step); });
      strain(copy, [&](int) { return increment(1e-5 * step); });
      strain(image, [&](int) { return Gradient<2>(mirror * increment(1e-5 * step) * mirror); });
      CHECK(copy.committed_stress(0) == first.committed_stress(0));
      auto const expected = scarp::mirrored_stress<2>(first.committed_stress(0), normal);
      // Local damping of packings acts on components along fixed axes.
      double const tolerance = name.ends_with("packing") ? 2e-3 : 1e-9;
      CHECK((image.committed_stress(0) - expected).norm() < tolerance * (expected - start).norm());
    }
  });
}

TEST_CASE("a mirrored tangent is that of the mirrored strain") {
  scarp::VoigtTangent<2> const tangent{{5.0, 2.0, 0.3}, {1.8, 4.0, 0.7}, {0.2, 0.6, 1.5}};
  scarp::Vector<2> const normal(std::cos(0.7), std::sin(0.7));
  scarp::Mirror<2> const mirror{normal};
  scarp::VoigtTangent<2> image = tangent;
  mirror("tangent", image);
  Gradient<2> const strain = increment(1e-3);
  scarp::Tensor<2> const reflection = scarp::reflection<2>(normal);
  Gradient<2> const reflected = reflection * strain * reflection;
  auto const expected = scarp::mirrored_stress<2>(tangent * scarp::to_engineering_strain<2, double>(strain), normal);
  CHECK((image * scarp::to_engineering_strain<2, double>(reflected) - expected).norm() < 1e-17);
  std::string words;
  CHECK_REFUSED(mirror("words", words), "cannot be mirrored", "words");
}

TEST_CASE("points that are sent together hold what they share once, and share it where they arrive") {
  auto const sites = in_a_row(3);
  Points from(sand(), sites);
  for (int step = 1; step <= 2; ++step) strain(from, [&](int k) { return increment(1e-5 * (k + step)); });
  auto const both = from.pack(std::vector{0, 2});
  CHECK(both.size() < from.pack(0).size() + from.pack(2).size() - 40 * 2 * sizeof(double));
  Points to(sand(), sites);
  to.unpack(std::vector{2, 0}, both);
  CHECK(to.committed_stress(2) == from.committed_stress(0));
  CHECK(to.committed_stress(0) == from.committed_stress(2));
  auto const population = [&](int point) { return to.state<Rve::State>(point).packing.population; };
  to.unpack(1, from.pack(1));
  CHECK(population(1) == population(2));
  CHECK(to.pack(std::vector{1, 2, 0}) == from.pack(std::vector{1, 0, 2}));
}

TEST_CASE("points go on from a file as if they had not stopped, and a file that does not fit changes nothing") {
  samples::ScratchFolder const folder;
  auto const file = folder / "points";
  auto const sites = in_a_row(3);
  std::vector<double> const volumes(3, 0.1);
  scarp::Nonlocal const soil{sand(), 0.25};
  Points first(soil, sites, volumes);
  auto const step = [](Points& points, int number) {
    strain(points, [&](int k) { return increment(1e-5 * (k * k + number)); });
  };
  for (int number = 1; number <= 2; ++number) step(first, number);
  scarp::save_points(file, first);
  Points second(soil, sites, volumes);
  scarp::load_points(file, second);
  for (auto* points : {&first, &second}) step(*points, 3);
  std::vector const all{0, 1, 2};
  CHECK(second.pack(all) == first.pack(all));

  auto const before = second.pack(all);
  std::string bits = scarp::read_file(file);
  Points few(soil, std::span(sites).first(2), std::span(volumes).first(2));
  CHECK_REFUSED(scarp::load_points(file, few), "it has 3 points", "there are 2");
  Points wider(scarp::Nonlocal{sand(), 0.35}, sites, volumes);
  CHECK_REFUSED(scarp::load_points(file, wider), "other means");
  bits[bits.size() / 2] ^= 1;
  scarp::write_file(file, bits, scarp::Durability::handed_over);
  CHECK_REFUSED(scarp::load_points(file, second), "its bytes have changed");
  CHECK_REFUSED(scarp::load_points(folder / "missing", second), "missing");
  CHECK(second.pack(all) == before);
}

TEST_CASE("a file whose states hold more than the points take is refused, and nothing has changed") {
  samples::ScratchFolder const folder;
  auto const file = folder / "points";
  std::array const site{scarp::Site<3>{}};
  auto const elasticity = scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3);
  scarp::MaterialPoints<3> soil(scarp::MohrCoulomb<3>{elasticity, {{.cohesion = 1e3, .friction = 0.5}}}, site);
  scarp::MaterialPoints<3> elastic(scarp::LinearElastic<3>{elasticity}, site);
  soil.gradient(0) = Gradient<3>::Identity() * 1e-5;
  scarp::SerialExecutor serial;
  REQUIRE(soil.respond(serial).verdict.acceptable());
  soil.commit();
  scarp::save_points(file, soil);
  auto const before = elastic.pack(0);
  CHECK_REFUSED(scarp::load_points(file, elastic), "more than the states of these 1 points");
  CHECK(elastic.pack(0) == before);
}

TEST_CASE("points take no states that are not theirs, and then nothing has changed") {
  auto const sites = in_a_row(2);
  Points points(sand(), sites);
  strain(points, [](int k) { return increment(1e-5 * (k + 1)); });
  std::vector const all{0, 1};
  auto const before = points.pack(all);
  Points other(sand(), sites);
  auto const bits = other.pack(all);
  CHECK_REFUSED(points.unpack(all, std::string_view(bits).substr(0, bits.size() - 8)), "save it again");
  CHECK_REFUSED(points.unpack(all, bits + "x"), "more than the states of 2 points");
  CHECK_REFUSED(points.unpack(0, bits), "more than the states of 1 points");
  Points const elastic(scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3), sites);
  CHECK_REFUSED(points.copy(0, elastic, 0), "another type of provider");
  CHECK(points.pack(all) == before);
}

TEST_CASE("a batch refuses numbers, sizes and orders of calls that do not fit") {
  auto const sites = in_a_row(3);
  scarp::SerialExecutor serial;
  Points points(sand(), sites);
  for (int const wrong : {-1, 3}) {
    CAPTURE(wrong);
    CHECK_REFUSED(points.gradient(wrong), "there are 3 points");
    CHECK_REFUSED(points.stress(wrong), "there are 3 points");
    CHECK_REFUSED(points.pack(wrong), "there are 3 points");
    CHECK_REFUSED(points.copy(0, points, wrong), "there are 3 points");
    CHECK_REFUSED(points.tangent(wrong), "there are 3 points");
  }
  CHECK_REFUSED(points.set_gradients({}, serial), "0 displacement gradients", "3 points");
  CHECK_REFUSED(Points(sand(), sites, std::vector<double>(7, 0.1)), "7 volumes", "3 points");
  CHECK_REFUSED(points.commit(), "without a response");
  strain(points, [](int) { return increment(1e-5); });
  CHECK_REFUSED(points.commit(), "without a response");
  auto const before = points.pack(0);
  for (int k = 0; k < 3; ++k) points.gradient(k) = increment(1e-5);
  static_cast<void>(points.respond(serial));
  points.discard();
  CHECK_REFUSED(points.commit(), "without a response");
  CHECK(points.pack(0) == before);
  CHECK_REFUSED(points.unpack(std::vector{0, 0}, points.pack(std::vector{0, 1})), "unpacked twice");
  CHECK_REFUSED(points.extract(0, points.pack(std::vector{0, 1})), "more than the states of 1 points");
  CHECK(points.pack(0) == before);

  Points shared(sand(), sites, {}, [](int point) { return point == 0; });
  CHECK_REFUSED(shared.pack(1), "point 1", "another process owns it");
  CHECK_REFUSED(points.copy(0, shared, 2), "point 2", "another process owns it");
  points.copy(0, shared, 0);
  Points voigt(StoresVoigtStrain{}, sites);
  CHECK_REFUSED(voigt.copy(0, voigt, 1, true), "point 1 cannot be mirrored", "store tensors");

  Points const wide(scarp::Nonlocal{sand(), 0.15}, sites, std::vector<double>(3, 0.1));
  CHECK_REFUSED(points.copy(0, wide, 0), "points with means and points without");
}

TEST_CASE("the stress that holds what means do not contain travels with a point") {
  auto const sites = in_a_row(6);
  std::vector<double> const volumes(6, 0.1);
  scarp::Nonlocal const soil{nestings::Loosening{}, 0.25};
  auto const gradient = [](int k) { return increment(1e-5 * (k * k + 1)); };
  Points from(soil, sites, volumes);
  for (int step = 1; step <= 2; ++step) strain(from, gradient);
  REQUIRE(from.means()->committed(3).tau.norm() > 0.0);
  Points sent(soil, sites, volumes);
  Points copied(soil, sites, volumes);
  std::vector const all{0, 1, 2, 3, 4, 5};
  sent.unpack(all, from.pack(all));
  for (int const point : all) copied.copy(point, from, point);
  CHECK(from.extract(3, from.pack(3)).committed_stress(0) == from.committed_stress(3));
  for (auto* points : {&from, &sent, &copied}) strain(*points, gradient);
  CHECK(sent.stresses() == from.stresses());
  CHECK(copied.stresses() == from.stresses());
  Points image(soil, sites, volumes);
  image.copy(3, from, 3, true);
  auto const total = [](Points const& points) {
    return scarp::VoigtStress<2>(points.committed_stress(3) + points.means()->committed(3).tau);
  };
  CHECK((total(image) - total(from)).norm() < 1e-12 * total(from).norm());
}

TEST_CASE("states go between points that see each other and points too far apart for their length") {
  auto const sites = in_a_row(6);
  scarp::Nonlocal const soil{nestings::Loosening{}, 0.25};
  Points close(soil, sites, std::vector<double>(6, 0.1));
  Points far(soil, std::array{sites[0], sites[3]}, std::vector<double>(2, 0.3));
  REQUIRE(!far.means());
  strain(far, [](int k) { return increment(1e-5 * (k + 1)); });
  close.copy(2, far, 1);
  close.unpack(4, far.pack(1));
  for (int const point : {2, 4}) CHECK(close.committed_stress(point) == far.committed_stress(1));
  far.copy(0, close, 2);
  CHECK(far.committed_stress(0) == close.committed_stress(2));
  far.unpack(1, close.pack(0));
  CHECK(far.committed_stress(1) == close.committed_stress(0));
}

TEST_CASE("a point without means is taken out from among points of which some have means") {
  auto const sites = in_a_row(4);
  std::vector<scarp::Site<2>> places(sites.begin(), sites.end());
  places[3].region = 1;
  std::vector<double> const volumes(4, 0.1);
  std::vector<std::string> const names{"soil", "rock"};
  std::vector<scarp::Region<scarp::AnyProvider<2>>> const regions{
      {"soil", scarp::Nonlocal{nestings::Loosening{}, 0.25}}, {"rock", nestings::Loosening{}}};
  auto points = scarp::points_of_regions<2>(regions, names, places, volumes, [](int) { return true; });
  strain(points, [](int k) { return increment(1e-5 * (k + 1)); });
  for (int const k : {0, 3}) CHECK(points.extract(k, points.pack(k)).committed_stress(0) == points.committed_stress(k));
  CHECK_REFUSED(points.extract(3, points.pack(std::vector{3, 0})), "more than the states of 1 points");
}

TEST_CASE("two processes that exchange the gradients of points near their border see the same means as one") {
  auto const sites = in_a_row(12);
  constexpr double length = 0.25;
  constexpr int border = 6;
  scarp::Nonlocal const soil{nestings::Loosening{}, length};
  Points whole(soil, sites, std::vector<double>(12, 0.1));
  // Each process has its own points and, behind them, those of the other within the length.
  auto const part = [&](int first, int last) {
    std::vector<scarp::Site<2>> own(sites.begin() + first, sites.begin() + last);
    int const count = last - first;
    for (auto const& site : sites) {
      bool const is_own = site.index >= first && site.index < last;
      bool const is_near =
          std::ranges::any_of(std::span(own).first(static_cast<std::size_t>(count)),
                              [&](auto const& one) { return (one.position - site.position).norm() < length; });
      if (!is_own && is_near) own.push_back(site);
    }
    return std::pair(own, Points(soil, own, std::vector<double>(own.size(), 0.1), [=](int k) { return k < count; }));
  };
  auto [left_sites, left] = part(0, border);
  auto [right_sites, right] = part(border, 12);
  CHECK(left.size() == border + 2);
  for (int step = 1; step <= 3; ++step) {
    auto const gradient = [&](int k) { return increment(1e-5 * (k * k + step)); };
    strain(whole, gradient);
    for (int side = 0; side < 2; ++side) {
      Points& points = side == 0 ? left : right;
      auto const& own = side == 0 ? left_sites : right_sites;
      strain(points, [&](int k) { return gradient(own[static_cast<std::size_t>(k)].index); });
      for (int k = 0; k < border; ++k) {
        auto const expected = whole.stress(own[static_cast<std::size_t>(k)].index);
        CHECK((points.stress(k) - expected).norm() < 1e-13 * expected.norm());
      }
    }
  }
}
