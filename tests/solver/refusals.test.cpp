// SPDX-License-Identifier: BSL-1.0
// What this room refuses, and with which names and numbers.
#include "support/refusals.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Settings with one of them changed, and the words of the refusal.
template <class Settings, class Value>
void refuses(Value Settings::*setting, std::initializer_list<Value> wrong, std::string_view words) {
  for (Value const value : wrong) {
    CAPTURE(value);
    Settings settings;
    settings.*setting = value;
    CHECK_REFUSED(settings.validate(), words, fmt::format("is {}", value));
  }
  CHECK_NOTHROW(Settings{}.validate());
}

}  // namespace

TEST_CASE("load stepping refuses settings with which a run would not end or not begin") {
  using scarp::LoadStepping;
  refuses(&LoadStepping::first, {not_a_number, infinity, 0.0, -1e-3, 1e-9}, "first load increment");
  refuses(&LoadStepping::smallest, {not_a_number, infinity, 0.0, -1e-3}, "smallest load increment");
  refuses(&LoadStepping::largest, {not_a_number, 0.0, -1.0, 1e-9}, "largest load increment");
  refuses(&LoadStepping::max_displacement_gradient, {not_a_number, infinity, 0.0, -1.0},
          "largest gradient of a load step");
  refuses(&LoadStepping::growth, {not_a_number, infinity, 0.0, -1.4, 0.9}, "growth of the load increment");
  refuses(&LoadStepping::shrinkage, {not_a_number, infinity, 0.0, -0.5, 1.1}, "shrinkage of the load increment");
  refuses(&LoadStepping::grow_below, {-1}, "iterations up to which the load increment grows");
  refuses(&LoadStepping::shrink_above, {5, -1}, "iterations beyond which the load increment shrinks");
}

TEST_CASE("solvers refuse settings with which no step could be accepted") {
  using Newton = scarp::QuasiNewton<>;
  for (double const tolerance : {not_a_number, infinity, 0.0, -1e-3}) {
    CHECK_REFUSED(Newton{.tolerance = tolerance}.validate(), "tolerance of the force residual",
                  fmt::format("is {}", tolerance));
  }
  refuses(&Newton::max_iterations, {0, -1}, "most iterations of a load step");
  refuses(&Newton::divergence_limit, {not_a_number, 0.0, 1e-3}, "residual beyond which a step is given up");
  refuses(&Newton::max_refinements, {-1}, "most refinements of an iteration");
  refuses(&Newton::tangent_interval, {0, -1}, "load steps that share the provider's tangents");
}

TEST_CASE("tangent rules refuse shares outside of their range, also within a solver") {
  using scarp::ConsistentTangent;
  using scarp::PointwiseBroyden;
  refuses(&PointwiseBroyden::provider_share, {not_a_number, -0.1, 1.1}, "share of the provider's tangent");
  refuses(&PointwiseBroyden::floor, {not_a_number, 1.1, infinity}, "floor of a learned tangent");
  refuses(&PointwiseBroyden::min_strain_change, {not_a_number, -1e-7, infinity}, "least change of strain");
  refuses(&ConsistentTangent::floor, {not_a_number, -0.1, 1.1}, "share of the first tangent");
  CHECK_REFUSED(scarp::QuasiNewton<>{.rule = {.learned = {.provider_share = 2.0}}}.validate(),
                "share of the provider's tangent is 2");
}
