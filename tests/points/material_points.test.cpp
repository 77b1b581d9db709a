// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/material_points.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "constitutive/nestings.hpp"
#include "constitutive/provider_laws.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/solver/make_problem.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "support/approx.hpp"
#include "support/block.hpp"
#include "support/refusals.hpp"

namespace {

namespace hana = boost::hana;
using Grid = scarp::Discretisation<scarp::Tri3>;
using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
using Concrete = scarp::LinearElastic<2>;
using Points = scarp::MaterialPoints<2>;

constexpr double depth = 25.0;

Grid ground_with_footing() {
  auto mesh = scarp::FaultMesh{.depth = depth, .size = 8.0}.generate({-15.0, -5.0});
  scarp::mark_footing_base(mesh, -10.0, 10.0);
  scarp::add_footing_block(mesh, 2.0, 8.0);
  return Grid(mesh);
}

scarp::Region<Soil> soil() { return {"soil", Soil::from_young_poisson(20e6, 0.3, {.unit_weight = 16e3, .k0 = 0.5})}; }
scarp::Region<Concrete> footing() { return {"footing", Concrete::from_young_poisson(20e9, 0.2)}; }

template <class... Materials>
Points made(Grid const& grid, scarp::Region<Materials> const&... regions) {
  return scarp::make_points(grid, depth, hana::make_tuple(regions...), scarp::SerialExecutor{});
}

std::vector<scarp::Site<2>> numbered(int count) {
  std::vector<scarp::Site<2>> sites(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) sites[static_cast<std::size_t>(k)].index = k;
  return sites;
}

void strain(Points& points, double size) {
  for (int k = 0; k < points.size(); ++k) points.gradient(k) = provider_laws::ordinary_increment<2>((k + 1) * size);
}

/// One of two processes, that of the even points; the other one sends nothing.
struct EvenPoints : scarp::SerialExecutor {
  int ranks() const override { return 2; }
  void exchange(Shared const&) const override {}
};

}  // namespace

TEST_CASE("every point answers with the provider of its own region") {
  auto const grid = ground_with_footing();
  Points points = made(grid, soil(), footing());
  REQUIRE(points.size() == grid.point_count());
  scarp::Gradient<2> stretch = scarp::Gradient<2>::Zero();
  stretch(0, 0) = 1e-6;
  scarp::SerialExecutor serial;
  auto const before = points.committed_stresses(serial);
  for (int point = 0; point < points.size(); ++point) points.gradient(point) = stretch;
  CHECK(points.respond(serial).inner_steps == 0);
  CHECK(points.committed_stresses(serial) == before);
  int in_footing = 0;
  for (int point = 0; point < grid.point_count(); ++point) {
    auto const k = static_cast<std::size_t>(point);
    auto const site = grid.site(point, depth);
    bool const above = site.depth < 0.0;
    in_footing += above ? 1 : 0;
    // Analytic: -gamma z in the ground, nothing in the footing.
    double const vertical = above ? 0.0 : -16e3 * site.depth;
    CHECK(points.committed_stress(point)(1) == samples::Approx(vertical).epsilon(1e-14));
    double const shear_modulus = above ? 20e9 / 2.4 : 20e6 / 2.6;  // analytic: E / (2 (1 + nu))
    CHECK(points.committed_tangent(point)(2, 2) == samples::Approx(shear_modulus).epsilon(1e-14));
    double const modulus = points.committed_tangent(point)(0, 0);
    // Round-off of the initial stress, and E - ln U of second order.
    CHECK(points.responses()[k].stress(0) - before[k](0) == samples::Approx(modulus * 1e-6).epsilon(1e-5));
    CHECK(points.work(point) == 0);
  }
  CHECK(in_footing > 0);
  CHECK(in_footing < grid.point_count());
  points.commit();
  CHECK(points.committed_stress(0) != before[0]);
  CHECK(points.committed_stresses(serial) == points.stresses());
}

TEST_CASE("a ground surface that is not one of the mesh is refused, with both levels") {
  auto const grid = ground_with_footing();  // from 0 to 27 m
  auto const refused = [&](double level) {
    return samples::message_of(
        [&] { scarp::make_points(grid, level, hana::make_tuple(soil(), footing()), scarp::SerialExecutor{}); });
  };
  CHECK(refused(62.5) == samples::Naming{"surface is at a height of 62.5 m", "from 0 to 27 m"});
  CHECK(refused(-62.5) == samples::Naming{"surface is at a height of -62.5 m", "from 0 to 27 m"});
  CHECK(refused(24.0) == samples::Naming{"surface is at a height of 24 m", "no node of the mesh"});
  CHECK(refused(depth * 2.0 / 3.0) == samples::Naming{"above the ground surface"});  // the soil's uppermost points
  CHECK(refused(depth).empty());
}

TEST_CASE("the order in which regions are named does not matter") {
  auto const grid = ground_with_footing();
  Points const points = made(grid, soil(), footing());
  Points const other = made(grid, footing(), soil());
  for (int point = 0; point < grid.point_count(); ++point) {
    CHECK(points.committed_stress(point) == other.committed_stress(point));
    CHECK(points.committed_tangent(point) == other.committed_tangent(point));
  }
}

TEST_CASE("materials sit at the points of any integration") {
  using Reduced = scarp::Discretisation<scarp::Quad8, scarp::SmallStrain, scarp::ReducedIntegration>;
  Reduced const grid(scarp::BoxMesh<scarp::Quad8>{.cells = {3, 2}}.generate());
  auto const points = scarp::make_points(grid, 1.0, hana::make_tuple(soil()), scarp::SerialExecutor{});
  CHECK(points.size() == 4 * 3 * 2);
  // Analytic: -gamma z at the points' own depths.
  for (int point = 0; point < grid.point_count(); ++point) {
    double const depth_of_point = grid.site(point, 1.0).depth;
    CHECK(points.committed_stress(point)(1) == samples::Approx(-16e3 * depth_of_point).epsilon(1e-14));
  }
}

TEST_CASE("a point shows its provider's own state, and no other type's") {
  auto const grid = ground_with_footing();
  Points const points = made(grid, soil(), footing());
  auto const check = [&]<class Provider>(int point, Provider const& provider) {
    CHECK(provider.stress(points.state<typename Provider::State>(point)) == points.committed_stress(point));
  };
  for (int point = 0; point < grid.point_count(); ++point) {
    if (grid.site(point, depth).depth < 0.0) {
      check(point, footing().provider);
      CHECK_REFUSED(points.state<Soil::State>(point), fmt::format("state of point {} ", point), "another type");
    } else {
      check(point, soil().provider);
      CHECK_REFUSED(points.state<Concrete::State>(point), fmt::format("state of point {} ", point), "another type");
    }
  }
  CHECK_REFUSED(points.state<int>(7), "state of point 7", "another type");
}

TEST_CASE("points are planned once for a load step, and answer from what is committed until the next commit") {
  scarp::SerialExecutor serial;
  nestings::Loosening const provider;
  Points points(provider, numbered(3));
  strain(points, 1e-4);
  auto const first = points.respond(serial);
  long planned = 0;
  for (int k = 0; k < 3; ++k) {
    planned += provider.plan(provider.initial_state({}), provider_laws::ordinary_increment<2>((k + 1) * 1e-4));
  }
  CHECK(first.inner_steps == planned);
  CHECK(first.verdict == scarp::Verdict{});
  CHECK(first.worst_point == -1);
  auto const stresses = points.stresses();
  strain(points, 1.4e-4);
  CHECK(points.respond(serial).inner_steps == planned);
  CHECK(points.stresses() != stresses);
  strain(points, 1e-4);
  static_cast<void>(points.respond(serial));
  CHECK(points.stresses() == stresses);
  auto const start = provider.initial_state({});
  auto trial = start;
  static_cast<void>(provider.respond(start, points.gradient(2), trial, static_cast<int>(points.work(2))));
  CHECK(points.tangent(2) == provider.tangent(trial));
  CHECK(points.tangents(serial)[2] == points.tangent(2));
  points.commit();
  CHECK(points.committed_stresses(serial) == stresses);
  CHECK(points.balanced_stresses(serial) == stresses);
  CHECK(points.committed_tangents(serial)[2] == provider.tangent(trial));
  CHECK(points.initial_tangent(2) == provider.tangent(start));
  CHECK(points.respond(serial).inner_steps > planned);  // planned anew, from a longer path

  points.evaluate_committed(serial);
  CHECK(points.stresses() == stresses);
  CHECK(points.gradients() == Points::Gradients(3, scarp::Gradient<2>::Zero()));
  CHECK(points.own_gradients() == points.gradients());
}

TEST_CASE("points that do not converge work harder up to so many times, the others not again") {
  scarp::SerialExecutor serial;
  samples::Planning const planning{.needed = 100};
  Points points(planning, numbered(2));
  points.gradient(0)(0, 0) = 3e-6;  // a plan of 31
  points.gradient(1)(0, 0) = 2e-5;  // of 201
  auto const once = points.respond(serial, 0);
  CHECK(once.verdict.status == scarp::Status::not_converged);
  CHECK(once.worst_point == 0);
  CHECK(once.points.count(scarp::Status::ok) == 1);
  planning.calls->clear();
  auto const more = points.respond(serial, 1);
  CHECK(more.verdict.status == scarp::Status::not_converged);
  CHECK(more.inner_steps == 31 + 201 + 62);  // all points once, then the one that is not converged
  auto const enough = points.respond(serial);
  CHECK(enough.verdict.acceptable());
  CHECK(points.work(0) == 124);
  CHECK(points.work(1) == 201);
  std::vector<std::pair<int, int>> calls;
  for (auto const& call : *planning.calls) calls.emplace_back(call.point, call.plan);
  CHECK(calls == std::vector<std::pair<int, int>>{{1, 201}, {0, 31}, {0, 62}, {1, 201}, {0, 62}, {0, 124}});
}

TEST_CASE("answers that are not finite fail, and increments that are not finite are refused by their point") {
  scarp::SerialExecutor serial;
  Points points(samples::Softening{.largest_strain = 1e-3, .silent_point = 1}, numbered(3));
  for (int k = 0; k < 3; ++k) points.gradient(k)(0, 0) = 2e-3;
  auto const answers = points.respond(serial);
  CHECK(answers.verdict == scarp::Verdict{scarp::Status::failed, scarp::Reason::not_finite});
  CHECK(answers.worst_point == 1);
  points.gradient(2)(0, 1) = std::nan("");
  CHECK_REFUSED(points.respond(serial), "displacement gradient of point 2 is not finite");
}

/// Throws for large increments at its second point.
struct Throwing : samples::Softening {
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    if (committed.point == 1 && increment.norm() > 0.5) throw std::runtime_error("no answer");
    return samples::Softening::respond(committed, increment, trial);
  }
};

TEST_CASE("answers of which one is missing are not committed") {
  scarp::SerialExecutor serial;
  Points points(Throwing{}, numbered(3));
  auto const pull = [&](double size) {
    for (int k = 0; k < 3; ++k) points.gradient(k)(0, 0) = size;
  };
  pull(1e-3);
  static_cast<void>(points.respond(serial));
  pull(1.0);
  CHECK_THROWS_AS(static_cast<void>(points.respond(serial)), std::runtime_error);
  CHECK_REFUSED(points.commit(), "respond first");
}

TEST_CASE("answers to other gradients than the present ones are not committed") {
  scarp::SerialExecutor serial;
  Points points(samples::Softening{}, numbered(2));
  for (int k = 0; k < 2; ++k) points.gradient(k)(0, 0) = 1e-3;
  static_cast<void>(points.respond(serial));
  points.evaluate_committed(serial);
  CHECK_REFUSED(points.commit(), "respond first");
  for (int k = 0; k < 2; ++k) points.gradient(k)(0, 0) = 1e-3;
  static_cast<void>(points.respond(serial));
  points.set_gradients(std::vector<scarp::Gradient<2>>(2, scarp::Gradient<2>::Zero()), serial);
  CHECK_REFUSED(points.commit(), "respond first");
}

TEST_CASE("answers are the same bits on any number of threads, of one batch or of several") {
  auto const grid = ground_with_footing();
  auto const stresses = [&](auto&& executor, Points points) {
    strain(points, 1e-7);
    static_cast<void>(points.respond(executor));
    return points.stresses();
  };
  Points const regions = made(grid, soil(), footing());
  Points const planning(nestings::Loosening{}, numbered(200));
  for (auto const& points : {regions, planning}) {
    auto const expected = stresses(scarp::SerialExecutor{}, points);
    CHECK(stresses(scarp::ThreadExecutor(3), points) == expected);
  }
}

TEST_CASE("points are values: copies have states of their own") {
  scarp::SerialExecutor serial;
  Points points(nestings::Loosening{}, numbered(2));
  auto const start = points.committed_stress(1);
  Points copy = points;
  strain(copy, 1e-4);
  static_cast<void>(copy.respond(serial));
  copy.commit();
  CHECK(points.committed_stress(1) == start);
  CHECK(copy.committed_stress(1) != start);
  points = copy;
  CHECK(points.pack(1) == copy.pack(1));
  CHECK(Points{}.size() == 0);
  auto const nothing = Points{}.respond(serial);
  CHECK(nothing.verdict.acceptable());
  CHECK(nothing.worst_point == -1);
}

TEST_CASE("work that a small first iterate planned grows with the increment, and does not shrink again") {
  scarp::SerialExecutor serial;
  Points points(samples::Planning{}, numbered(1));
  auto const work_at = [&](double strain) {
    points.gradient(0).setZero();
    points.gradient(0)(1, 1) = strain;
    static_cast<void>(points.respond(serial));
    return points.work(0);
  };
  CHECK(work_at(0.0) == 1);
  CHECK(work_at(4e-6) == 41);
  CHECK(work_at(6e-6) == 41);  // 61 steps: less than half as many again, for a smooth response
  CHECK(work_at(7e-6) == 71);
  CHECK(work_at(1e-6) == 71);
  points.discard();
  CHECK(work_at(1e-6) == 11);
}

TEST_CASE("a process asks its own points only, and has no states of others until they are read") {
  EvenPoints executor;
  samples::Planning const planning{};
  Points points(planning, numbered(5), {}, [&](int point) { return executor.owns(point); });
  strain(points, 1e-6);
  static_cast<void>(points.respond(executor));
  std::set<int> asked;
  for (auto const& call : *planning.calls) asked.insert(call.point);
  CHECK(asked == std::set{0, 2, 4});
  CHECK(points.work(2) > 0);
  CHECK(points.work(1) == 0);

  nestings::Loosening const packing;
  auto const sites = numbered(5);
  Points own(packing, sites, {}, [&](int point) { return executor.owns(point); });
  Points const all(packing, sites);
  CHECK(own.committed_stress(2) == all.committed_stress(2));
  CHECK_REFUSED(own.committed_stress(1), "another process owns it");
  auto const alone = own.extract(1, all.pack(1));
  CHECK(alone.size() == 1);
  CHECK(alone.committed_stress(0) == all.committed_stress(1));
  CHECK_REFUSED(own.committed_stress(1), "another process owns it");
  own.unpack(1, all.pack(1));
  CHECK_REFUSED(own.unpack(1, all.pack(1) + "x"), "more than the states of 1 points");
  CHECK(own.committed_stress(1) == all.committed_stress(1));
  own.release(1);
  CHECK_REFUSED(own.committed_stress(1), "another process owns it");
}

namespace {

/// Elastic, with a state that nobody can make from nothing.
struct Stateful {
  static constexpr int dim = 2;
  struct State {
    explicit State(Concrete::State const& from) : elastic(from) {}
    Concrete::State elastic;
  };

  Concrete elastic = footing().provider;

  State initial_state(scarp::Site<2> const& site) const { return State(elastic.initial_state(site)); }
  scarp::VoigtStress<2> stress(State const& state) const { return elastic.stress(state.elastic); }
  scarp::VoigtTangent<2> tangent(State const& state) const { return elastic.tangent(state.elastic); }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return elastic.respond(committed.elastic, increment, trial.elastic);
  }
};

}  // namespace

TEST_CASE("states that cannot be left empty or name no members are refused where they would have to") {
  auto const sites = numbered(2);
  scarp::SerialExecutor serial;
  Points points(Stateful{}, sites);
  strain(points, 1e-4);
  CHECK(points.respond(serial).verdict.acceptable());
  CHECK_REFUSED(points.pack(0), "name no members");
  CHECK_REFUSED(points.release(0), "no default constructor");
  CHECK_REFUSED(Points(Stateful{}, sites, {}, [](int point) { return point == 0; }), "no default constructor");
}

TEST_CASE("regions that do not fit the mesh are refused by name") {
  auto const grid = ground_with_footing();
  auto raft = footing();
  raft.name = "raft";
  CHECK_REFUSED(made(grid, soil()), "region 'footing' of the mesh has no material");
  CHECK_REFUSED(made(grid, soil(), raft), "there is no region 'raft' (the mesh has: soil, footing)");
  CHECK_REFUSED(made(grid, soil(), footing(), soil()), "region 'soil' is given two materials");
  std::vector<std::string> const names{"soil"};
  std::vector<scarp::Site<2>> const outside{{.region = 1}};
  CHECK_REFUSED(scarp::points_of_regions<2>(hana::make_tuple(soil()), names, outside, {}, [](int) { return true; }),
                "region '1' of the mesh has no material (point 0 lies in it)");
}

TEST_CASE("points are not refined without a response") {
  Points points(Concrete::from_young_poisson(20e6, 0.3), numbered(1));
  scarp::SerialExecutor const executor;
  auto const refined = [&] { static_cast<void>(points.refine(executor)); };
  CHECK_REFUSED(refined(), "let them respond first");
  strain(points, 1e-3);
  REQUIRE(points.respond(executor).verdict.acceptable());
  SUBCASE("after a commit") { points.commit(); }
  SUBCASE("after a discard") { points.discard(); }
  SUBCASE("at other gradients") { points.set_gradients({2.0 * points.own_gradients()[0]}, executor); }
  CHECK_REFUSED(refined(), "let them respond first");
}

TEST_CASE("the copy of a point that is not there is refused, with means too") {
  std::vector<double> const volumes(2, 1.0);
  Points points(scarp::Nonlocal{Concrete::from_young_poisson(20e6, 0.3), 1.0}, numbered(2), volumes);
  REQUIRE(points.means() != nullptr);
  CHECK_REFUSED(points.copy(0, points, 70), "point 70");
}
