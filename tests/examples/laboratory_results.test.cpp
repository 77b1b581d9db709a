// SPDX-License-Identifier: BSL-1.0

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "../../examples/rve_lab/calibration_report.hpp"
#include "../../examples/rve_lab/evaluation_table.hpp"
#include "../../examples/rve_lab/laboratory_results.hpp"
#include "../../examples/rve_lab/laboratory_tests.hpp"
#include "../../examples/rve_lab/mohr_coulomb_reading.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/points/laboratory_paths.hpp"
#include "support/approx.hpp"
#include "support/files.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;
using Rows = std::vector<rve_lab::LaboratoryRow<2>>;

constexpr double degree = std::numbers::pi / 180.0;

template <int Dim, class Provider>
auto rows_of(Provider const& provider, scarp::PathConditions<Dim> const& conditions, double length, int count) {
  scarp::MaterialPoints<Dim> points(provider, std::array{scarp::Site<Dim>{}});
  scarp::PointPath<Dim> path(points, conditions, {.tolerance = 1e-11});
  scarp::SerialExecutor serial;
  std::vector<rve_lab::LaboratoryRow<Dim>> rows{{0.0, path.stress(0), path.strain(0)}};
  for (int k = 0; k < count; ++k) {
    REQUIRE(path.advance(length / count, serial).verdict.acceptable());
    rows.push_back({path.length(), path.stress(0), path.strain(0)});
  }
  return rows;
}

/// Elastic material whose second point bears an axial stress of 150 kPa only; with `all_fail` the others a little more.
struct Uneven {
  static constexpr int dim = 2;
  using Elastic = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  struct State {
    Elastic::State own;
    int number = 0;
    SCARP_MEMBERS(own, number)
  };
  Elastic elastic = Elastic::from_young_poisson(20e6, 0.3, {.surcharge = 100e3});
  bool all_fail = false;

  State initial_state(scarp::Site<2> const& site) const { return {elastic.initial_state(site), site.index}; }
  scarp::VoigtStress<2> stress(State const& state) const { return elastic.stress(state.own); }
  scarp::VoigtTangent<2> tangent(State const& state) const { return elastic.tangent(state.own); }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    trial = committed;
    auto response = elastic.respond(committed.own, increment, trial.own);
    double const most = committed.number == 1 ? 150e3 : all_fail ? 150.9e3 : 1e9;
    if (response.stress(1) < -most) response.verdict = {scarp::Status::failed, scarp::Reason::no_contacts};
    return response;
  }
};

/// Drained compression at a lateral pressure of 1 with deviators and volumetric strains of functions of the axial
/// strain.
template <class Deviator, class Volume>
Rows drawn(Deviator const& deviator, Volume const& volume, double end, int count) {
  Rows rows;
  for (int k = 0; k <= count; ++k) {
    double const axial = end * k / count;
    rows.push_back({axial, {-1.0, -1.0 - deviator(axial), 0.0}, {axial - volume(axial), -axial, 0.0}});
  }
  return rows;
}

}  // namespace

TEST_CASE_TEMPLATE("Mohr-Coulomb parameters are read from Mohr-Coulomb's own curve", Number,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Number::value;
  scarp::MohrCoulomb<dim, scarp::GeostaticStress<dim>> const soil{
      scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3),
      {{.friction = 35.0 * degree, .dilation = 8.0 * degree}},
      {.surcharge = 1e5}};
  auto const rows = rows_of<dim>(soil, scarp::drained_path<dim>(), 0.04, 400);
  auto const results = rve_lab::laboratory_results<dim>(rows);
  // The elastic strain of an increment is its logarithm to 1e-9; the curve is straight to its corner, but for the row
  // across it.
  CHECK(results.peak.friction() == Approx(35.0 * degree).epsilon(1e-9));
  CHECK(results.residual.friction() == Approx(35.0 * degree).epsilon(1e-9));
  CHECK(results.peak_dilation == Approx(8.0 * degree).epsilon(1e-6));
  CHECK(results.shear_modulus == Approx(20e6 / 2.6).epsilon(1e-8));
  CHECK(results.k0 == Approx((1.0 - std::sin(35.0 * degree)) / (1.0 + std::sin(35.0 * degree))).epsilon(1e-9));
  auto const read = rve_lab::mohr_coulomb_of(results);
  CHECK(read.elasticity.shear_modulus == Approx(20e6 / 2.6).epsilon(1e-6));
  CHECK(read.elasticity.lame_lambda == Approx(soil.elasticity.lame_lambda).epsilon(1e-6));
  CHECK(read.strength.strength.friction == results.peak.friction());
  CHECK_FALSE(results.rises);
  // Contraction ends at the corner: the last elastic row.
  REQUIRE(results.phase_transformation);
  CHECK(results.phase_transformation->q() <= results.peak.q() * (1.0 + 1e-9));
  CHECK(results.phase_transformation->q() > 0.9 * results.peak.q());
}

TEST_CASE("results of a synthetic drained test") {
  constexpr double top = 3.0, at = 0.02, turn = 0.01, share = 0.4;
  auto const deviator = [](double axial) {  // largest, `top`, at `at`
    double const x = axial / at;
    return top * 2.0 * x / (1.0 + x * x);
  };
  auto const volume = [](double axial) { return share * axial * (1.0 - axial / (2.0 * turn)); };  // largest at `turn`
  constexpr int count = 1000;
  constexpr double end = 0.1;
  auto const rows = drawn(deviator, volume, end, count);
  auto const results = rve_lab::laboratory_results<2>(rows);
  CHECK(results.peak.length == Approx(at));
  CHECK(results.peak.q() == Approx(top));
  CHECK(results.peak.p() == Approx(1.0 + top / 2.0));
  CHECK(std::sin(results.peak.friction()) == Approx(top / (2.0 + top)));
  CHECK(results.residual.q() == Approx(deviator(end)));
  REQUIRE(results.phase_transformation);
  CHECK(results.phase_transformation->length == Approx(turn));
  CHECK(results.phase_transformation->volumetric_strain() == Approx(volume(turn)));
  CHECK(results.phase_transformation->void_ratio(0.6) == Approx(1.6 * std::exp(-volume(turn)) - 1.0));
  // Dilation grows to the last row where nine tenths of the peak friction are mobilised: dv / da behind it.
  double last = 0.0;
  for (auto const& row : rows) {
    double const sine = deviator(row.length) / (2.0 + deviator(row.length));
    if (std::asin(sine) >= 0.9 * std::asin(top / (2.0 + top))) last = row.length;
  }
  double const rate = share * (1.0 - (last + end / count / 2.0) / turn);
  CHECK(std::sin(results.peak_dilation) == Approx(-rate / (2.0 - rate)).epsilon(1e-10));
  // The sum of the increments from `turn` to the end: the volume has changed by volume(end) - volume(turn).
  double const volume_change = volume(end) - volume(turn);
  CHECK(std::sin(results.secant_dilation) == Approx(-volume_change / (2.0 * (end - turn) - volume_change)));
  // q = top / 2 at x = 2 - sqrt 3; linear between rows of x = 5e-3.
  double const half = (2.0 - std::sqrt(3.0)) * at;
  CHECK(results.secant_modulus == Approx(top / 2.0 / half).epsilon(1e-4));
  CHECK(results.secant_poisson == Approx(1.0 - volume(half) / half).epsilon(1e-4));
  double const first = end / count;
  CHECK(results.shear_modulus == Approx(deviator(first) / (2.0 * (2.0 * first - volume(first)))));
}

TEST_CASE("the peak of a plateau is where it begins, whatever its round-off is") {
  auto const plateau = [](double axial) { return axial < 0.02 ? 100.0 * axial : 2.0 + 1e-13 * axial; };
  auto const results = rve_lab::laboratory_results<2>(drawn(
      plateau, [](double) { return 0.0; }, 0.1, 100));
  CHECK(results.peak.length == Approx(0.02));
}

TEST_CASE("a stress ratio that rises to the end is no peak") {
  auto const nothing = [](double) { return 0.0; };
  auto const ends = [&](auto const& deviator, double end) {
    auto const results = rve_lab::laboratory_results<2>(drawn(deviator, nothing, end, 100), end / 20.0);
    if (results.rises) CHECK_REFUSED(rve_lab::mohr_coulomb_of(results), "rises to the end", "degrees");
    return results.rises;
  };
  for (double const end : {1e-3, 0.02, 0.5}) {  // elastic material, whatever its angle
    CAPTURE(end);
    CHECK(ends([](double axial) { return 200.0 * axial; }, end));
  }
  // A hyperbola has risen to 10/11 of its asymptote at ten times its half strain, to 9/10 at nine times: by 1 %; to 2/3
  // at twice: by 3.6 %.
  auto const hyperbola = [](double axial) { return 3.0 * axial / (0.01 + axial); };
  CHECK_FALSE(ends(hyperbola, 0.1));
  CHECK(ends(hyperbola, 0.01));  // half: by 5.5 %
  // A load that falls when the test ends hides no rise.
  auto const released = [](double axial) { return axial < 0.0985 ? 20.0 * axial : 1.9; };
  CHECK(ends(released, 0.1));
  // A plateau that scatters, the last value the largest, and a peak before the end.
  CHECK_FALSE(ends([](double axial) { return 2.0 + 0.01 * std::sin(2000.0 * axial) + axial; }, 0.1));
  CHECK_FALSE(ends([](double axial) { return axial < 0.05 ? 60.0 * axial : 4.5 - 30.0 * axial; }, 0.1));
}

TEST_CASE("a window takes means of stresses, and only the way to the first turn counts") {
  // Rows of 0.001 with one spike: a window of 0.004 has four increments.
  auto const spike = [](double axial) { return std::abs(axial - 0.05) < 1e-9 ? 2.0 : 1.0; };
  auto rows = drawn(
      spike, [](double axial) { return -axial; }, 0.1, 100);
  CHECK(rve_lab::laboratory_results<2>(rows).peak.q() == Approx(2.0));
  auto const smooth = rve_lab::laboratory_results<2>(rows, 0.004);
  CHECK(smooth.peak.q() == Approx((3.0 + 2.0) / 4.0));
  CHECK(smooth.residual.length == Approx(0.0985));
  CHECK(std::sin(smooth.peak_dilation) == Approx(1.0 / 3.0).epsilon(1e-9));  // 1 / (2 + 1)
  CHECK_FALSE(smooth.phase_transformation);
  rows.push_back(rows[98]);
  rows.back().stress(1) = -9.0;
  CHECK(rve_lab::laboratory_results<2>(rows).peak.q() == Approx(2.0));
}

TEST_CASE("a minor stress in tension mobilises a right angle, and no stress mobilises nothing") {
  using Row = rve_lab::LaboratoryRow<2>;
  auto const friction = [](double lateral, double axial) {
    return Row{0.0, {-lateral, -axial, 0.0}, scarp::EngineeringStrain<2>::Zero()}.friction();
  };
  CHECK(friction(1.0, 3.0) == Approx(30.0 * degree));  // sin 30 = (3 - 1) / (3 + 1)
  CHECK(friction(0.0, 3.0) == Approx(90.0 * degree));
  CHECK(std::isnan(friction(std::nan(""), 3.0)));
  CHECK(friction(-1.0, 3.0) == Approx(90.0 * degree));
  CHECK(friction(-3.0, 1.0) == Approx(90.0 * degree));
  CHECK(friction(-1.0, -1.0) == Approx(90.0 * degree));
  CHECK(friction(0.0, 0.0) == 0.0);
  // A material with cohesion, drawn at no lateral pressure: results are numbers, and no Mohr-Coulomb parameters come of
  // them.
  Rows rows;
  for (int k = 0; k <= 20; ++k) {
    double const axial = 1e-3 * k;
    rows.push_back({axial, {0.1, -1.0 - 100.0 * axial, 0.0}, {0.5 * axial, -axial, 0.0}});
  }
  auto const results = rve_lab::laboratory_results<2>(rows, 0.004);
  CHECK(results.peak.friction() == Approx(90.0 * degree));
  CHECK_REFUSED(rve_lab::mohr_coulomb_of(results), "friction");
}

TEST_CASE("phase transformation of an undrained test is where the pressure is least") {
  Rows rows;
  for (int k = 0; k <= 50; ++k) {
    double const axial = 1e-3 * k, mean = 1.0 + 400.0 * (axial - 0.02) * (axial - 0.02), shear = 0.5 * k / 50.0;
    rows.push_back({axial, {-mean + shear, -mean - shear, 0.0}, {axial, -axial, 0.0}});
  }
  auto const results = rve_lab::laboratory_results<2>(rows);
  REQUIRE(results.phase_transformation);
  CHECK(results.phase_transformation->length == Approx(0.02));
}

TEST_CASE("what has no results is rejected, and what a test does not have is no number") {
  Rows rows{{0.0, {-1.0, -1.0, 0.0}, {0.0, 0.0, 0.0}}};
  CHECK_REFUSED(rve_lab::laboratory_results<2>(rows), "1 rows");
  rows.push_back({0.01, {-2.0, -2.0, 0.0}, {-0.01, -0.01, 0.0}});
  CHECK_REFUSED(rve_lab::laboratory_results<2>(rows, 0.02), "shorter than the window 0.02");
  CHECK_REFUSED(rve_lab::laboratory_results<2>(rows, -1.0), "is -1");
  auto const isotropic = rve_lab::laboratory_results<2>(rows);
  CHECK(std::isnan(isotropic.shear_modulus));
  CHECK(std::isnan(isotropic.secant_modulus));
  CHECK_REFUSED(rve_lab::mohr_coulomb_of(isotropic), "mobilises no friction");
  CHECK_REFUSED(rve_lab::mean_rows<2>({}), "no test");
  CHECK_REFUSED(rve_lab::mean_rows<2>({rows, {rows.front()}}), "1 rows, the first 2");
}

TEST_CASE("a test that fails ends for itself, the others go on") {
  samples::ScratchFolder const folder;
  rve_lab::Laboratory choice;
  choice.strain = 0.01;
  rve_lab::LaboratoryRun<2> run(choice, Uneven{}, 3, folder / "test.csv");
  run.run(nullptr);
  auto const& tests = run.tests();
  CHECK(tests[1].verdict.reason == scarp::Reason::no_contacts);
  CHECK(tests[1].length() == Approx(50e3 / 20e6 * (1.0 - 0.3 * 0.3)).epsilon(0.1));
  CHECK(tests[1].rows.back().axial_strain() == Approx(tests[1].length()));
  for (std::size_t const k : {std::size_t{0}, std::size_t{2}}) {
    CHECK(tests[k].verdict.acceptable());
    CHECK(tests[k].length() == Approx(0.01).epsilon(1e-9));
  }
  CHECK(run.farthest() == std::vector{&tests[0], &tests[2]});
  CHECK(run.farthest_rows().front().size() == tests[0].rows.size());
}

TEST_CASE("the mean of tests that all failed ends where their rows are of equal lengths") {
  samples::ScratchFolder const folder;
  rve_lab::Laboratory choice;
  choice.strain = 0.01;
  rve_lab::LaboratoryRun<2> run(choice, Uneven{.all_fail = true}, 2, folder / "test.csv");
  run.run(nullptr);
  auto const& tests = run.tests();
  REQUIRE(tests[0].rows.size() == tests[1].rows.size());
  CHECK(tests[0].length() > tests[1].length() + 1e-6);
  auto const rows = run.farthest_rows();
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].size() == tests[0].rows.size() - 1);
  CHECK(rows[0].back().length == Approx(rows[1].back().length).epsilon(1e-12));
}

TEST_CASE("what a calibration hardly determines is told by the scale of its search") {
  rve_lab::Calibration calibration{.free = {{"normal-stiffness", 2e6, 2e8}, {"friction", 0.1, 1.0}},
                                   .observations = {{.name = "e50", .wanted = 1e7}}};
  Eigen::VectorXd const one = Eigen::VectorXd::Ones(1);
  rve_lab::Evaluation const best{.shares = Eigen::VectorXd::Constant(2, 0.3), .values = one, .scatter = one};
  auto const lines = [&](double error) {
    rve_lab::Sensitivities const found{.slopes = Eigen::MatrixXd::Zero(1, 2),
                                       .covariance = error * error * Eigen::MatrixXd::Identity(2, 2)};
    return rve_lab::CalibrationReport(calibration, best, best, found, one, {}).parameter_lines();
  };
  for (auto const& line : lines(0.3)) CHECK(line.ends_with(": the data hardly determine it"));
  for (auto const& line : lines(0.2)) CHECK_FALSE(line.ends_with("determine it"));
}

TEST_CASE("columns of two tables that end at one strain, but for round-off, have names of their own") {
  samples::ScratchFolder const folder;
  rve_lab::Calibration calibration{.free = {{"friction", 0.1, 1.0}}};
  for (double const strain : {0.07, std::nextafter(0.07, 1.0)})
    calibration.observations.push_back({.name = "volumetric strain", .wanted = 0.0, .strain = strain});
  rve_lab::EvaluationTable const table(folder / "evaluations.csv", calibration, false);
  CHECK(scarp::read_file(folder / "evaluations.csv").find("volumetric strain at 0.07 of table 2") != std::string::npos);
}
