// SPDX-License-Identifier: BSL-1.0
#include "scarp/rve/random_packings.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "scarp/dem/fire.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Ellipses;
using scarp::Site;
using Recipe = scarp::IsotropicRecipe<Ellipses, scarp::EllipseGrading>;
using Source = scarp::RandomPackings<Recipe>;
using Rve = scarp::DemRve<Ellipses, Source>;
using PoolRve = scarp::DemRve<Ellipses, scarp::RandomChoice<scarp::SamePacking<Ellipses>>>;

static_assert(scarp::PackingSource<Source, Ellipses> && scarp::ConstitutiveProvider<Rve>);
static_assert(scarp::ConstitutiveProvider<PoolRve>);
static_assert(!scarp::PackingSource<Source, samples::Discs>, "a source of other grains must be refused");
struct RecipeWithoutSeed {
  scarp::Prepared<Ellipses> operator()() const;
};
static_assert(!scarp::PreparesFromSeed<RecipeWithoutSeed>, "a recipe that takes no seed must be refused");

Recipe recipe() {
  return {.cloud = {.grading = samples::grading<Ellipses>(),
                    .grains = 16,
                    .density = samples::density,
                    .thickness = samples::thickness},
          .preparation = {.pressure = samples::pressure},
          .law = samples::study_law()};
}

Site<2> point(int number) {
  Site<2> site;
  site.index = number;
  return site;
}

bool same_bits(Ellipses const& a, Ellipses const& b) {
  return a.population->sizes() == b.population->sizes() && a.cell == b.cell && a.position == b.position &&
         a.orientation == b.orientation && a.pairs == b.pairs;
}

}  // namespace

TEST_CASE("a recipe prepares with its damping") {
  scarp::IsotropicRecipe<Ellipses, scarp::EllipseGrading, scarp::Fire> const relaxed{
      .cloud = recipe().cloud, .preparation = recipe().preparation, .law = samples::study_law()};
  auto heavy = recipe();
  CHECK(same_bits(heavy(3).packing, recipe()(3).packing));
  heavy.damping.factor = 0.7;
  CHECK_FALSE(same_bits(heavy(3).packing, recipe()(3).packing));
  CHECK(relaxed(3).verdict.acceptable());
  CHECK_FALSE(same_bits(relaxed(3).packing, recipe()(3).packing));
}

TEST_CASE("numbers of a family and families have seeds of their own") {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (std::uint64_t number = 0; number < 100; ++number) seeds.insert(scarp::family_seed(seed, number));
  }
  CHECK(seeds.size() == 10'000);
  // Another code: the formula over the generator of tests/core/random_reference.py. A change moves every user's ground.
  CHECK(scarp::family_seed(1, 0) == 2736766839171971727ULL);
  CHECK(scarp::family_seed(1, 1) == 7103620936486572538ULL);
}

TEST_CASE("every point gets a packing of its own that follows from seed and number alone") {
  Source const source{recipe(), 7};
  Ellipses const third = source.at(point(3));
  Ellipses const eighth = source.at(point(8));
  CHECK(!(third.population->sizes() == eighth.population->sizes()));
  CHECK(!(third.position == eighth.position));
  CHECK((third.cell - eighth.cell).norm() > 1e-3 * third.cell.norm());
  // In another order, from a copy: the same bits.
  Source const copy = source;
  CHECK(same_bits(copy.at(point(8)), eighth));
  CHECK(same_bits(copy.at(point(3)), third));
  CHECK(!same_bits(Source{recipe(), 8}.at(point(3)), third));
}

TEST_CASE("a field of points starts from random packings at the prepared pressure") {
  std::vector<Site<2>> const sites{point(5), point(2), point(9)};
  scarp::MaterialPoints<2> const points(Rve{.law = samples::study_law(), .source = {recipe(), 7}}, sites);
  for (int k = 0; k < 3; ++k) {
    CAPTURE(k);
    CHECK(points.state<Rve::State>(k).verdict.acceptable());
    // The servo's tolerance for the largest stress is 1e-4 of the target; the answer is read a step later.
    CHECK(points.committed_stress(k)(0) == samples::Approx(-samples::pressure).epsilon(1e-3));
    CHECK(points.committed_stress(k)(1) == samples::Approx(-samples::pressure).epsilon(1e-3));
  }
  CHECK(points.state<Rve::State>(0).packing.position == Source{recipe(), 7}.at(point(5)).position);
  CHECK(points.committed_stress(0) != points.committed_stress(1));
}

TEST_CASE("points draw from a pool, alike with any number of threads") {
  Source const source{recipe(), 7};
  constexpr int count = 4;
  auto const pool = source.pool(count, scarp::SerialExecutor{});
  scarp::ThreadExecutor threads(3);
  auto const same = source.pool(count, threads);
  REQUIRE(pool.sources.size() == count);
  for (std::size_t k = 0; k < count; ++k) CHECK(same_bits(pool.sources[k].packing, same.sources[k].packing));
  CHECK(same_bits(pool.sources[2].packing, source.at(point(2))));
  std::vector<int> drawn(count);
  int repeated = 0;
  int before = -1;
  for (int number = 0; number < 400; ++number) {
    auto const& packing = pool.at(point(number));
    CHECK(same_bits(packing, same.at(point(number))));
    for (int k = 0; k < count; ++k) {
      if (&packing != &pool.sources[static_cast<std::size_t>(k)].packing) continue;
      ++drawn[static_cast<std::size_t>(k)];
      if (k == before) ++repeated;
      before = k;
    }
  }
  // Binomial with mean 100 and standard deviation 8.7: five of them; the numbers are the same in every run.
  for (int const times : drawn) CHECK(std::abs(times - 100) < 44);
  CHECK(std::abs(repeated - 100) < 44);  // neighbours by number are as alike as any two
}

TEST_CASE("a packing that does not settle is reported with its point") {
  auto hasty = recipe();
  hasty.preparation.consolidation.max_steps = 10;
  Source const source{hasty, 7};
  auto const message_of = [](auto const& attempt) { return samples::message_of<scarp::PreparationError>(attempt); };
  std::string const alone = message_of([&] { source.at(point(41)); });
  CHECK(alone.find("of point 41") != std::string::npos);
  CHECK(alone.find("unreachable") != std::string::npos);
  scarp::ThreadExecutor threads(2);
  CHECK(message_of([&] { source.pool(3, threads); }).find("in the pool, number 0") != std::string::npos);
  CHECK_REFUSED(source.pool(0, threads), "pool of 0");
  CHECK_REFUSED(scarp::RandomChoice<scarp::SamePacking<Ellipses>>{}.at(point(1)), "point 1 ", "empty pool");
}
