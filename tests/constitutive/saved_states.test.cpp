// SPDX-License-Identifier: BSL-1.0
// What is saved comes back: the bits of a state that was read in are those of the one that was saved, and so are its
// next answers.
#include <doctest/doctest.h>

#include "constitutive/nestings.hpp"
#include "constitutive/provider_laws.hpp"
#include "constitutive/umats.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/strength.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using scarp::Gradient;
using scarp::Site;

template <class T>
std::string bits_of(T const& value) {
  scarp::StateWriter writer;
  writer("value", value);
  return writer.bits();
}

template <class T>
void read(std::string const& bits, T& value) {
  scarp::StateReader reader(bits);
  reader("value", value);
  CHECK(reader.at_end());
}

/// Squeezed, sheared, then widened until it is fluid.
template <int Dim>
std::vector<Gradient<Dim>> path(double size) {
  std::vector<Gradient<Dim>> all;
  for (double const part : {0.3, 1.0, -0.4}) all.push_back(provider_laws::ordinary_increment<Dim>(part * size));
  for (double const part : {-1.0, 2.0, 20.0, 30.0}) all.push_back(part * size * Gradient<Dim>::Identity());
  all.push_back(provider_laws::ordinary_increment<Dim>(size));
  return all;
}

template <class Provider>
void same_answers(Provider const& provider, typename Provider::State saved, typename Provider::State loaded,
                  double size) {
  constexpr int dim = Provider::dim;
  CHECK(provider.stress(loaded) == provider.stress(saved));
  CHECK(provider.tangent(loaded) == provider.tangent(saved));
  for (double const part : {0.5, -1.5}) {
    auto const increment = provider_laws::ordinary_increment<dim>(part * size);
    auto trial = saved;
    auto trial_of_loaded = loaded;
    auto const expected = provider.respond(saved, increment, trial);
    auto const answer = provider.respond(loaded, increment, trial_of_loaded);
    CHECK(answer.stress == expected.stress);
    CHECK(answer.verdict == expected.verdict);
    CHECK(bits_of(trial_of_loaded) == bits_of(trial));
    saved = trial;
    loaded = trial_of_loaded;
  }
}

/// At every station of a path, read into a blank state and into one with another past.
template <class Provider>
void what_is_saved_comes_back(Provider const& provider, double size = 2e-4) {
  constexpr int dim = Provider::dim;
  static_assert(scarp::Described<typename Provider::State>);
  Site<dim> site;
  site.index = 3;
  site.depth = 5.0;
  auto state = provider.initial_state(site);
  auto const start = bits_of(state);
  for (auto const& increment : path<dim>(size)) {
    auto const before = state;
    static_cast<void>(provider.respond(before, increment, state));
    auto const bits = bits_of(state);
    auto blank = scarp::empty_state(provider, site);
    read(bits, blank);
    CHECK(bits_of(blank) == bits);
    same_answers(provider, state, blank, size);
    auto other = before;
    read(bits, other);
    CHECK(bits_of(other) == bits);
    same_answers(provider, state, other, size);
  }
  // A law that nothing could break is none: the path has left its mark.
  CHECK(bits_of(state) != start);
}

/// Points, read where there are none of their states, at once and one by one.
template <class Material>
void points_come_back(Material const& material) {
  std::vector<Site<2>> sites(6);
  for (int k = 0; k < 6; ++k)
    sites[static_cast<std::size_t>(k)] = {.index = k, .position = {0.5 * k, 1.0}, .depth = k + 1.0};
  scarp::MaterialPoints<2> points(material, sites);
  auto const increment = provider_laws::ordinary_increment<2>(3e-4);
  auto const answer = [&](auto& asked, double part) {
    scarp::SerialExecutor serial;
    for (int point = 0; point < asked.size(); ++point) asked.gradient(point) = part * increment;
    static_cast<void>(asked.respond(serial));
    auto after = asked;
    after.commit();
    std::string bits;
    for (int point = 0; point < asked.size(); ++point) {
      auto const& response = asked.responses()[static_cast<std::size_t>(point)];
      bits += bits_of(response.stress) + bits_of(response.verdict) + after.pack(point);
    }
    return bits;
  };
  static_cast<void>(answer(points, 1.0));
  points.commit();
  auto const nobody = [](int) { return false; };
  scarp::MaterialPoints<2> elsewhere(material, sites, {}, nobody);
  CHECK_REFUSED(bits_of(elsewhere), "point 0", "another process owns it");
  read(bits_of(points), elsewhere);
  CHECK(bits_of(elsewhere) == bits_of(points));
  scarp::MaterialPoints<2> sent(material, sites, {}, nobody);
  scarp::MaterialPoints<2> loaded(material, sites);
  for (int point = 0; point < points.size(); ++point) {
    sent.unpack(point, points.pack(point));
    CHECK(sent.committed_stress(point) == points.committed_stress(point));
    auto const alone = sent.extract(point, points.pack(point));
    CHECK(alone.committed_stress(0) == points.committed_stress(point));
    CHECK(alone.committed_tangent(0) == points.committed_tangent(point));
    CHECK(alone.quantities(0) == points.quantities(point));
    loaded.unpack(point, elsewhere.pack(point));
  }
  CHECK(answer(loaded, 0.5) == answer(points, 0.5));
  scarp::MaterialPoints<2> other(material, sites);
  static_cast<void>(answer(other, -1.0));
  other.commit();
  read(bits_of(elsewhere), other);
  CHECK(answer(other, 0.5) == answer(points, 0.5));
  points.release(2);
  read(bits_of(elsewhere), points);
  CHECK(bits_of(points) == bits_of(elsewhere));
}

using Discs = samples::Discs;
using Glued = scarp::Packing<scarp::Disc, scarp::RollingResistance<scarp::CohesiveBond<scarp::LinearFrictional>>>;

template <class PackingType>
PackingType lattice() {
  return samples::triangular_lattice<PackingType>(4, 5e-3, 0.998e-2);
}

/// Of few steps: what is asked is that answers are the same, not that they are good.
template <class PackingType>
auto rve(typename PackingType::Law const& law, PackingType packing) {
  return scarp::DemRve<PackingType, scarp::SamePacking<PackingType>>{
      .law = law, .source = {std::move(packing)}, .min_steps = 5, .max_steps = 20};
}

auto discs() { return rve(samples::study_law(), lattice<Discs>()); }

}  // namespace

TEST_CASE("what is saved comes back: elasticity and plasticity, in the plane and in space") {
  auto const elasticity = scarp::IsotropicElasticity::from_lame(3e6, 2e6);
  scarp::Strength const strength{.cohesion = 5e2, .friction = 0.5, .dilation = 0.1};
  what_is_saved_comes_back(scarp::LinearElastic<2>{elasticity});
  what_is_saved_comes_back(scarp::LinearElastic<3>{elasticity});
  what_is_saved_comes_back(scarp::LinearElastic<2, scarp::GeostaticStress<2>>{elasticity, {1e4, 2e4, 0.5}});
  what_is_saved_comes_back(scarp::MohrCoulomb<2>{elasticity, {strength}});
  what_is_saved_comes_back(scarp::MohrCoulomb<3>{elasticity, {strength}});
  what_is_saved_comes_back(scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength>{
      elasticity, {.peak = strength, .residual = {.friction = 0.3}}, {1e3, 2e3, 0.5}});
}

TEST_CASE("what is saved comes back: a user's UMAT, in the plane and in space") {
  what_is_saved_comes_back(umats::hardening<2>());
  what_is_saved_comes_back(umats::hardening<3>());
}

TEST_CASE("what is saved comes back: packings of several shapes and laws") {
  what_is_saved_comes_back(discs());
  auto loose = rve(samples::study_law(), samples::loose_cloud<samples::Ellipses>(16, 1));
  loose.fluid_start = true;
  what_is_saved_comes_back(loose);
  // Dashpots ask how long the last move took.
  using Damped = scarp::HertzMindlin<scarp::HertzRestitution>;
  using DampedDiscs = scarp::Packing<scarp::Disc, Damped>;
  what_is_saved_comes_back(
      rve(Damped::of({.modulus = 1e8, .poisson = 0.25}, 0.5, {.restitution = 0.3}), lattice<DampedDiscs>()));
  what_is_saved_comes_back(
      rve<Glued>({.law = {samples::study_law(), 10.0, 10.0}, .rolling_stiffness = 10.0, .rolling_friction = 0.1},
                 lattice<Glued>()));
}

TEST_CASE("what is saved comes back: a packing that becomes fluid, within each adaptor") {
  nestings::for_each_adaptor([](auto adaptor) {
    CAPTURE(std::string(adaptor.name));
    what_is_saved_comes_back(adaptor.around(discs()));
  });
}

TEST_CASE("what is saved comes back: every adaptor around every adaptor") {
  nestings::for_each([](std::string const& name, auto const& provider) {
    CAPTURE(name);
    what_is_saved_comes_back(provider);
  });
}

TEST_CASE("what is saved comes back: points, also where there was no state of one") {
  nestings::for_each([](std::string const& name, auto const& provider) {
    CAPTURE(name);
    points_come_back(provider);
    points_come_back(scarp::AnyProvider<2>(provider));
  });
}

TEST_CASE("what is saved comes back: points that see means of their neighbours") {
  std::vector<Site<2>> sites(6);
  for (int k = 0; k < 6; ++k)
    sites[static_cast<std::size_t>(k)] = {.index = k, .position = {0.5 * k, 1.0}, .depth = 1.0};
  std::vector<double> const volumes(6, 0.25);
  auto const made = [&](scarp::Neighbourhood const& wide) {
    return scarp::MaterialPoints<2>(scarp::Nonlocal<nestings::Loosening>{{}, wide.length, wide.stiffness, wide.fading},
                                    sites, volumes);
  };
  auto const answer = [&](auto& points, double part) {
    for (int k = 0; k < 6; ++k) points.gradient(k) = provider_laws::ordinary_increment<2>(part * 1e-4 * (k % 3));
    scarp::SerialExecutor serial;
    static_cast<void>(points.respond(serial));
    std::string bits = bits_of(points.means()->added_stresses());
    for (auto const& response : points.responses()) bits += bits_of(response.stress);
    return bits;
  };
  scarp::Neighbourhood const wide{.length = 1.2};
  auto points = made(wide);
  static_cast<void>(answer(points, 1.0));
  points.commit();
  auto loaded = made(wide);
  read(bits_of(points), loaded);
  CHECK(bits_of(loaded) == bits_of(points));
  CHECK(answer(loaded, 0.5) == answer(points, 0.5));
  // Stresses against fluctuation strain belong to the means that they came from.
  for (auto const& other : {scarp::Neighbourhood{.length = 0.9}, scarp::Neighbourhood{.length = 1.2, .stiffness = 0.5},
                            scarp::Neighbourhood{.length = 1.2, .fading = 2e-3}}) {
    auto elsewhere = made(other);
    CHECK_REFUSED(read(bits_of(points), elsewhere), "points that see other means");
  }
}
