// SPDX-License-Identifier: BSL-1.0
// Every setting of every provider that cannot be: refused where the provider is first used, by its name and its value.
#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include "../../benchmarks/shared/condensed_tangent.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/constitutive/varied_parameters.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/rve/perturbation_tangent.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

using Discs = samples::Discs;
using Elastic = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
using Rve = scarp::DemRve<Discs, scarp::SamePacking<Discs>>;
using Trial = scarp::DemRve<Discs, scarp::SamePacking<Discs>, scarp::PerturbationTangent<>>;
using Condensed = scarp::DemRve<Discs, scarp::SamePacking<Discs>, benchmarks::CondensedTangent>;
using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength>;

Elastic elastic() { return Elastic::from_young_poisson(20e6, 0.3, {.surcharge = 1e3, .unit_weight = 16e3, .k0 = 0.5}); }

template <class Provider>
Provider packing() {
  return {.law = samples::study_law(), .source = {samples::triangular_lattice<Discs>(4, 5e-3, 0.998e-2)}};
}

Soil soil() {
  scarp::Strength const strength{.cohesion = 1e3, .friction = 0.5, .dilation = 0.1};
  return {scarp::IsotropicElasticity::from_young_poisson(20e6, 0.3), {strength, strength}, elastic().initial};
}

/// A sound provider makes a state; each change of it is refused in the words beside it.
template <class Provider>
void check_table(Provider const& sound,
                 std::vector<std::pair<std::function<void(Provider&)>, char const*>> const& table) {
  CHECK_NOTHROW(sound.initial_state({.depth = 1.0}));
  for (auto const& [change, words] : table) {
    Provider wrong = sound;
    change(wrong);
    CHECK_REFUSED(wrong.initial_state({.depth = 1.0}), words);
  }
}

}  // namespace

TEST_CASE("settings of a packing as material that cannot be are refused") {
  check_table<Rve>(
      packing<Rve>(),
      {
          {[](Rve& rve) { rve.strain_per_step = 0.0; }, "strain per DEM step is 0"},
          {[](Rve& rve) { rve.strain_per_step = not_a_number; }, "strain per DEM step is nan"},
          {[](Rve& rve) { rve.strain_per_step = 0.1; }, "strain per DEM step is 0.1 (it must lie between"},
          {[](Rve& rve) { rve.inertial_number = -1.0; }, "inertial number is -1"},
          {[](Rve& rve) { rve.unbalanced_tolerance = 0.0; }, "unbalanced tolerance is 0"},
          {[](Rve& rve) { rve.time_step_share = inf; }, "share of the critical time step is inf"},
          {[](Rve& rve) { rve.pressure_floor = -1.0; }, "pressure floor is -1"},
          {[](Rve& rve) { rve.min_steps = 0; }, "least number of DEM steps of a response is 0"},
          {[](Rve& rve) { rve.max_steps = 19; }, "most DEM steps of a response is 19"},
          {[](Rve& rve) { rve.law.friction = -0.1; }, "friction of the contact law is -0.1"},
          {[](Rve& rve) { rve.law.normal_stiffness = 0.0; }, "normal stiffness of the contact law is 0"},
          {[](Rve& rve) { rve.source.packing = {}; }, "a packing of zero grains"},
          {[](Rve& rve) { rve.source.packing.position(0, 0) = not_a_number; }, "cannot be used (not_finite)"},
      });
}

TEST_CASE("settings of a packing's tangent that cannot be are refused") {
  check_table<Trial>(
      packing<Trial>(),
      {
          {[](Trial& rve) { rve.tangent_policy.strain = not_a_number; }, "strain of a packing's modes is nan"},
          {[](Trial& rve) { rve.tangent_policy.strain_steps = 0; }, "number of steps that strain a packing is 0"},
          {[](Trial& rve) { rve.tangent_policy.unbalanced_tolerance = 0.0; }, "of a packing at rest is 0"},
          {[](Trial& rve) { rve.tangent_policy.max_steps = 0; }, "most steps of a settling is 0"},
          {[](Trial& rve) { rve.tangent_policy.check_every = 0; }, "between looks at the balance is 0"},
      });
  check_table<Condensed>(
      packing<Condensed>(),
      {
          {[](Condensed& rve) { rve.tangent_policy.regularisation = -1.0; },
           "spring to the ground of a condensed packing is -1"},
          {[](Condensed& rve) { rve.tangent_policy.sliding.shear_share = 1.5; }, "tangential stiffness is 1.5"},
          {[](Condensed& rve) { rve.tangent_policy.sliding.nearness = 0.0; }, "as a share, is 0"},
      });
}

TEST_CASE("a packing without contacts carries nothing and is refused, unless a point may start so") {
  Rve loose{.law = samples::study_law(), .source = {samples::triangular_lattice<Discs>(4, 5e-3, 1.01e-2)}};
  CHECK_REFUSED(loose.initial_state({.index = 3}), "the packing of point 3 has 0 contacts");
  loose.fluid_start = true;
  CHECK(loose.initial_state({.index = 3}).verdict == scarp::Verdict{scarp::Status::fluid, scarp::Reason::no_contacts});
  scarp::StiffnessFloor<Rve> const floor{.provider = loose};
  CHECK_REFUSED(floor.initial_state({.index = 3}), "point 3 has no initial stiffness");
}

TEST_CASE("parameters of elastic and plastic ground that cannot be are refused") {
  check_table<Elastic>(
      elastic(), {
                     {[](Elastic& soil) { soil.elasticity.shear_modulus = 0.0; }, "shear modulus is 0"},
                     {[](Elastic& soil) { soil.elasticity.lame_lambda = -1e9; }, "bulk modulus is -"},
                     {[](Elastic& soil) { soil.initial.surcharge = -1.0; }, "surcharge on the ground surface is -1"},
                     {[](Elastic& soil) { soil.initial.unit_weight = not_a_number; }, "unit weight is nan"},
                     {[](Elastic& soil) { soil.initial.k0 = -0.5; }, "K0, is -0.5"},
                     {[](Elastic& soil) { soil.initial.buoyancy.lift = -1.0; }, "below the water table is -1"},
                     {[](Elastic& soil) { soil.initial.buoyancy.water_table = not_a_number; }, "water table is not a"},
                     {[](Elastic& soil) {
                        soil.initial.buoyancy = {0.0, 1e6};
                      },
                      "the ground would float"},
                 });
  CHECK_REFUSED(elastic().initial_state({.index = 7, .depth = not_a_number}), "initial stress of point 7");
  check_table<Soil>(
      soil(),
      {
          {[](Soil& soil) { soil.elasticity.shear_modulus = not_a_number; }, "shear modulus is nan"},
          {[](Soil& soil) { soil.strength.peak.cohesion = not_a_number; }, "cohesion is nan"},
          {[](Soil& soil) { soil.strength.residual.friction = 30.0; }, "friction angle is 30"},
          {[](Soil& soil) { soil.strength.peak.dilation = 0.6; }, "dilation is 0.6"},
          {[](Soil& soil) { soil.strength.softening_strain = not_a_number; }, "from peak to residual strength is nan"},
          {[](Soil& soil) { soil.initial.k0 = not_a_number; }, "K0, is nan"},
      });
}

TEST_CASE("settings of adaptors that cannot be are refused") {
  using Floor = scarp::StiffnessFloor<Elastic>;
  check_table<Floor>(
      {.provider = elastic()},
      {
          {[](Floor& floor) { floor.share = not_a_number; }, "share of a fluid point's stiffness is nan"},
          {[](Floor& floor) { floor.shear_modulus = not_a_number; }, "shear modulus of a fluid point is nan"},
      });
  using Varied = scarp::VariedParameters<Elastic>;
  check_table<Varied>({elastic(), [](Elastic const& common, scarp::Site<2> const&) { return common; }},
                      {
                          {[](Varied& varied) { varied.vary = nullptr; }, "no function varies"},
                          {[](Varied& varied) { varied.vary = [](auto const&, auto const&) { return Elastic{}; }; },
                           "shear modulus is 0"},
                      });
}

TEST_CASE("means over neighbours that cannot be are refused") {
  std::vector<scarp::Site<2>> const sites(2);
  std::vector<double> const volumes{1.0, 1.0};
  std::vector<scarp::VoigtTangent<2>> const initial(2, elastic().tangent({}));
  auto const means = [&](scarp::Neighbourhood const& second) {
    return scarp::point_means<2>(sites, volumes, std::vector<scarp::Neighbourhood>{{}, second}, initial);
  };
  CHECK_NOTHROW(means({.length = 2.0}));
  CHECK_REFUSED(means({.length = not_a_number}), "length that increments are averaged over is nan");
  CHECK_REFUSED(means({.stiffness = -1.0}), "stiffness against fluctuation strain is -1");
  CHECK_REFUSED(means({.fading = 0.0}), "strain after which fluctuation stress has faded is 0");
  std::vector<scarp::Neighbourhood> const one(1);
  CHECK_REFUSED(scarp::point_means<2>(sites, volumes, one, initial), "2 volumes and 1 lengths are given for 2 points");
  CHECK_REFUSED(scarp::point_means<2>(sites, volumes, std::vector<scarp::Neighbourhood>(2), {}),
                "2 neighbourhoods and 0 initial tangents are given for 2 points");

  auto const make = [&](scarp::Neighbourhood const& of, std::span<double const> weights) {
    return scarp::MaterialPoints<2>(scarp::Nonlocal<Elastic>{elastic(), of.length, of.stiffness, of.fading}, sites,
                                    weights);
  };
  CHECK_NOTHROW(make({.length = 2.0}, volumes));
  CHECK_REFUSED(make({.length = not_a_number}, volumes), "length that increments are averaged over is nan");
  CHECK_REFUSED(make({.stiffness = -1.0}, volumes), "stiffness against fluctuation strain is -1");
  CHECK_REFUSED(make({.fading = 0.0}, volumes), "strain after which fluctuation stress has faded is 0");
  CHECK_REFUSED(make({}, std::vector{1.0}), "1 volumes are given for 2 points");
  CHECK_REFUSED(make({.length = 2.0}, {}), "0 volumes and 2 lengths are given for 2 points");
}

TEST_CASE("depths of packings that are not in order are refused") {
  auto const packing = samples::triangular_lattice<Discs>(4, 5e-3, 0.998e-2);
  using Column = scarp::PackingsByDepth<Discs>;
  CHECK_REFUSED((Column{{1.0}, {}}.at({})), "1 depths with 0 packings");
  CHECK_REFUSED((Column{{1.0, 1.0}, {packing, packing}}.at({})), "depth 1 m follows 1 m");
  CHECK_REFUSED((Column{{not_a_number}, {packing}}.at({})), "depth nan m");
  CHECK_REFUSED((Column{{1.0}, {packing}}.at({.index = 5, .depth = not_a_number})), "point 5 lies nan m deep");
}
