// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/model.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/solver/analysis.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;
using Grid = scarp::Discretisation<scarp::Quad4, scarp::SmallStrain, scarp::BBar>;

constexpr double height = 4.0, weight = 18e3, young = 40e6;

/// A column of ground, 2 m wide, on rollers.
scarp::Model<2> column() {
  scarp::Model<2> model(
      Grid(scarp::BoxMesh<scarp::Quad4>{.lengths = scarp::Vector<2>(2.0, height), .cells = {2, 8}}.generate()));
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"});
  model.gravity(weight);
  return model;
}

}  // namespace

TEST_CASE("ground at rest does not move, and its base carries it") {
  auto model = column();
  model.surcharge({"top"}, 5e3);
  using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  model.material("soil", Soil::from_young_poisson(young, 0.25, model.geostatic(0.4)));
  scarp::Analysis analysis(model, {.threads = 1});
  auto const run = analysis.to(1.0);
  REQUIRE(run.verdict.acceptable());
  CHECK(std::abs(analysis.displacement("top", 1)) < 1e-9 * height);
  CHECK(analysis.reaction("bottom").y() == Approx(2.0 * (height * weight + 5e3)).epsilon(1e-9));
  CHECK(analysis.reaction("left").x() == Approx(0.4 * height * (5e3 + weight * height / 2.0)).epsilon(1e-9));
  CHECK(model.dead_loads().sum() == Approx(-2.0 * (height * weight + 5e3)).epsilon(1e-9));
}

TEST_CASE("weight that the initial stress does not balance settles the ground, later loads have their own amplitude") {
  auto model = column();
  model.material("soil", scarp::LinearElastic<2>::from_young_poisson(young, 0.25));
  model.surcharge({"top"}, 30e3, scarp::TimeFunction::ramp(1.0, 2.0));
  scarp::Analysis analysis(model, {.threads = 1});
  double const modulus = young * 0.75 / (1.25 * 0.5);  // one-dimensional compression
  REQUIRE(analysis.to(1.0).verdict.acceptable());
  double const by_weight =
      weight * height * height / (2.0 * modulus);  // analytic, exact at the nodes but for logarithms of strains of 1e-3
  CHECK(analysis.displacement("top", 1) == Approx(-by_weight).epsilon(1e-4));
  REQUIRE(analysis.to(2.0).verdict.acceptable());
  CHECK(analysis.load() == 2.0);
  CHECK(analysis.displacement("top", 1) == Approx(-by_weight - 30e3 * height / modulus).epsilon(1e-4));
  CHECK(analysis.reaction("bottom").y() == Approx(2.0 * (height * weight + 30e3)).epsilon(1e-6));
}

TEST_CASE("a boundary that is moved pulls what it carries, and a run that ends early says where and why") {
  auto model = column();
  model.move({"top"}, 1, 0.01, scarp::TimeFunction::ramp(1.0, 2.0));
  using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
  model.material("soil", scarp::Nonlocal{Soil{.elasticity = scarp::IsotropicElasticity::from_young_poisson(young, 0.25),
                                              .strength = {{.cohesion = 10e3, .friction = 0.5}},
                                              .initial = model.geostatic(0.5)},
                                         1.0});
  scarp::Analysis analysis(model, {.threads = 1});
  auto const first = analysis.to(1.0);
  CHECK(analysis.why(first) == "the load factor 1 was reached");
  REQUIRE(analysis.to(1.1).verdict.acceptable());
  CHECK(analysis.displacement("top", 1) == Approx(1e-3).epsilon(1e-9));
  double const modulus = young * 0.75 / (1.25 * 0.5);  // one-dimensional
  double const pulled = modulus * 1e-3 / height * 2.0;
  CHECK(analysis.reaction("top").y() == Approx(pulled).epsilon(1e-3));  // analytic, logarithms of strains of 1e-4
  scarp::AnalysisSettings impatient{.solver = {.max_iterations = 1}, .threads = 1};
  scarp::Analysis other(model, impatient);
  auto const run = other.to(2.0);
  REQUIRE(!run.verdict.acceptable());
  CHECK(other.why(run).starts_with(fmt::format("stopped at the load factor {:.6g}: ", run.load)));
  CHECK(other.why(run).ends_with("step_too_small, after iterations_spent"));
}

TEST_CASE("names that the mesh does not have, and regions without material, are rejected in words") {
  auto model = column();
  CHECK(samples::message_of([&] { model.fix({"botom"}, 1); }) == samples::Naming{"there is no boundary 'botom'"});
  CHECK(samples::message_of([&] { model.gravity("clay", 1e4); }) == samples::Naming{"there is no region 'clay'"});
  CHECK(samples::message_of([&] { static_cast<void>(model.depths("clay")); }) ==
        samples::Naming{"there is no region 'clay'"});
  CHECK(samples::message_of([&] { model.gravity(-1.0); }) == samples::Naming{"unit weight"});
  CHECK(samples::message_of([&] { scarp::Analysis{model}; }) ==
        samples::Naming{"region 'soil' of the mesh has no material"});
  model.material("clay", scarp::LinearElastic<2>::from_young_poisson(young, 0.25));
  CHECK(samples::message_of([&] { scarp::Analysis{model}; }) == samples::Naming{"there is no region 'clay'"});
}

TEST_CASE("a call that is rejected changes nothing of the model") {
  auto model = column();
  model.material("soil", scarp::LinearElastic<2>::from_young_poisson(young, 0.25));
  scarp::SerialExecutor serial;
  auto const prescribed = model.problem(serial).constraints().prescribed_dofs();
  auto const loads = model.dead_loads();
  CHECK_REFUSED(model.move({"top"}, 0, 0.01), "prescribed twice");  // at the corners of left and right alone
  CHECK_REFUSED(model.move({"top", "roof"}, 1, 0.01), "no boundary 'roof'");
  CHECK(model.problem(serial).constraints().prescribed_dofs() == prescribed);
  CHECK_REFUSED(model.traction({"top", "roof"}, scarp::Vector<2>(0.0, 1e3)), "no boundary 'roof'");
  CHECK(model.dead_loads() == loads);
}

TEST_CASE("an observer that throws leaves the analysis where its last step is") {
  auto model = column();
  model.move({"top"}, 1, -0.01, scarp::TimeFunction::ramp(1.0, 2.0));
  model.material("soil", scarp::LinearElastic<2, scarp::GeostaticStress<2>>::from_young_poisson(young, 0.25,
                                                                                                model.geostatic(0.5)));
  struct FullDisk {
    int steps = 0;
    void attempted(scarp::Problem<2> const&, scarp::StepReport const&) {
      if (++steps == 3) throw std::runtime_error("disk full");
    }
    static bool wants_stop() { return false; }
  } observer;
  scarp::Analysis analysis(model, {.threads = 1});
  REQUIRE(analysis.to(1.0).verdict.acceptable());
  CHECK_THROWS_WITH_AS(static_cast<void>(analysis.to(2.0, observer)), "disk full", std::runtime_error);
  CHECK(analysis.load() > 1.0);
  CHECK(analysis.displacement("top", 1) == Approx(-0.01 * (analysis.load() - 1.0)).epsilon(1e-9));
  REQUIRE(analysis.to(2.0).verdict.acceptable());
  CHECK(analysis.displacement("top", 1) == Approx(-0.01).epsilon(1e-9));
  CHECK_REFUSED(analysis.displacement("top", 2), "axis 2");
}

TEST_CASE("elements that copy themselves as another type are rejected") {
  using Elements = Grid;
  struct Own : Elements {
    using Elements::Elements;
  };
  CHECK_REFUSED(scarp::Model<2>(Own(scarp::BoxMesh<scarp::Quad4>{.cells = {1, 1}}.generate())), "override it");
}

TEST_CASE("the stress at rest belongs to a weight that is given before") {
  auto model = column();
  model.gravity(0.0);
  CHECK_REFUSED(model.geostatic(0.5), "give gravity first");
  model.gravity("soil", weight);
  model.surcharge({"top"}, 20e3);
  model.surcharge({"top"}, 5e3);
  auto const at_rest = model.geostatic(0.5);
  CHECK(at_rest.unit_weight == weight);
  CHECK(at_rest.surcharge == 25e3);
  CHECK_REFUSED(model.gravity(1e3), "give them before");
  CHECK_REFUSED(model.surcharge({"top"}, 1e3), "give them before");
  auto other = column();
  other.surcharge({"top"}, 1e3);
  other.surcharge({"left"}, 2e3);
  CHECK_REFUSED(other.geostatic(0.5), "surcharges of");
}

TEST_CASE("depths are those below the highest node, or below a level that is given") {
  auto model = column();
  auto const depths = model.depths("soil");
  REQUIRE(std::ssize(depths) == model.grid().point_count());
  CHECK(*std::ranges::max_element(depths) < height);
  CHECK(*std::ranges::min_element(depths) > 0.0);
  model.set_surface_level(height + 1.0);
  CHECK(model.depths("soil").front() == Approx(depths.front() + 1.0).epsilon(1e-12));
}

TEST_CASE("ground at rest is level at its top, or has a level that was set") {
  scarp::BoxMesh<scarp::Quad4> const box{.lengths = scarp::Vector<2>(2.0, height), .cells = {2, 4}};
  auto mesh = box.generate();
  for (auto& node : mesh.nodes) node.y() *= 1.0 + 0.01 * node.x();
  scarp::Model<2> tilted{Grid(std::move(mesh))};
  tilted.gravity(weight);
  CHECK_REFUSED(tilted.geostatic(0.5), "highest at (2, 4.08) and not level there");
  CHECK_REFUSED(tilted.depths(), "not level there");
  tilted.set_surface_level(1.02 * height);
  CHECK(tilted.geostatic(0.5).unit_weight == weight);
}

namespace {

/// The column in two layers, the lower one 1 m thick, or with a surface in two halves.
scarp::Model<2> layers() {
  auto mesh = scarp::BoxMesh<scarp::Quad4>{.lengths = scarp::Vector<2>(2.0, height), .cells = {2, 8}}.generate();
  mesh.regions = {"sand", "clay"};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    mesh.element_region[e] = mesh.nodes[static_cast<std::size_t>(mesh.elements[e][2])].y() < 1.1 ? 1 : 0;
  mesh.boundaries["half"] = {mesh.boundaries.at("top").front()};
  scarp::Model<2> model(Grid(std::move(mesh)));
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"});
  return model;
}

}  // namespace

TEST_CASE("weights and materials of regions together are those of each") {
  auto model = layers();
  model.gravity({"sand", "clay"}, weight);
  model.material({"sand", "clay"}, scarp::LinearElastic<2>::from_young_poisson(young, 0.25));
  CHECK(model.dead_loads().sum() == Approx(-2.0 * height * weight).epsilon(1e-9));
  scarp::Analysis analysis(model, {.threads = 1});
  REQUIRE(analysis.to(1.0).verdict.acceptable());
  CHECK(analysis.reaction("bottom").y() == Approx(2.0 * height * weight).epsilon(1e-6));
  CHECK_REFUSED(model.gravity({"clay", "peat"}, 1.0), "peat");
  CHECK(model.dead_loads().sum() == Approx(-2.0 * height * weight).epsilon(1e-9));
  CHECK_REFUSED(model.surcharge({"top"}, std::nan("")), "surcharge");
  CHECK_REFUSED(model.surcharge({"top", "top"}, 1.0), "named twice");
}

TEST_CASE("the stress at rest is that of one weight below a whole surface") {
  auto model = layers();
  model.gravity("sand", 16e3);
  model.gravity("clay", 20e3);
  CHECK_REFUSED(model.geostatic(0.5), "from 16000 to 20000 N/m3");
  CHECK_REFUSED(model.geostatic(0.5, "clay"), "below ground of another unit weight");
  CHECK(model.geostatic(0.5, "sand").unit_weight == 16e3);
  auto mesh = scarp::BoxMesh<scarp::Quad4>{.lengths = scarp::Vector<2>(2.0, height), .cells = {2, 8}}.generate();
  mesh.regions = {"sand", "silt", "clay"};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) mesh.element_region[e] = 2 - static_cast<int>(e) / 6;
  scarp::Model<2> three{Grid(std::move(mesh))};
  three.gravity({"sand", "silt"}, 16e3);
  three.gravity("clay", 20e3);
  CHECK(three.geostatic(0.5, "silt").unit_weight == 16e3);
  CHECK_REFUSED(three.geostatic(0.5, "clay"), "below ground of another unit weight");
  auto equal = layers();
  equal.gravity({"sand", "clay"}, weight);
  equal.surcharge({"half"}, 0.0);
  CHECK(equal.geostatic(0.5, "clay").unit_weight == weight);
  auto partly = layers();
  partly.gravity(weight);
  partly.surcharge({"half"}, 50e3);
  CHECK_REFUSED(partly.geostatic(0.5), "a part of the surface");
  auto later = layers();
  later.gravity(weight);
  later.surcharge({"half"}, 50e3, scarp::TimeFunction::ramp(1.0, 2.0));
  CHECK(later.geostatic(0.5).surcharge == 0.0);
}

TEST_CASE("a support carries the part of the weight that acts on ground without stress") {
  auto model = column();
  model.material("soil", scarp::LinearElastic<2>::from_young_poisson(young, 0.25));
  scarp::Analysis analysis(model, {.threads = 1});
  REQUIRE(analysis.to(0.5).verdict.acceptable());
  CHECK(analysis.reaction("bottom").y() == Approx(height * weight).epsilon(1e-5));
}
