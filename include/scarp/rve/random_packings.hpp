// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/core/executor.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/random.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/rve/packings_by_depth.hpp"

namespace scarp {

/// Seed number `number` of a family: a stream of its own for every number, whoever draws and in whatever order.
inline std::uint64_t family_seed(std::uint64_t seed, std::uint64_t number) {
  constexpr std::uint64_t odd = 0xd1b54a32d192ed03ULL;  // consecutive numbers far apart
  return Random(Random(seed).next() + odd * number).next();
}

/// recipe(seed): a packing whose grains and places follow from the seed alone.
template <class Recipe>
concept PreparesFromSeed = requires(Recipe const& recipe, std::uint64_t seed) {
  recipe(seed).packing;
  { recipe(seed).verdict } -> std::convertible_to<Verdict>;
};

/// A cloud under isotropic pressure; the seed replaces the cloud's.
/// \tparam PackingType a `Packing`
/// \tparam Grading a `SamplesGrains`
template <class PackingType, class Grading, DampsMotion Damping = LocalDamping>
struct IsotropicRecipe {
  Cloud<Grading> cloud{};              ///< grains; its own seed is not used
  IsotropicPreparation preparation{};  ///< pressure and friction of the consolidation
  typename PackingType::Law law{};     ///< contact law of the grains
  Damping damping{};                   ///< of the grains' motion

  /// Packing of one seed, or the reason why it did not come to rest.
  Prepared<PackingType> operator()(std::uint64_t seed) const {
    Cloud<Grading> own = cloud;
    own.seed = seed;
    return preparation.prepare(own.template make<PackingType>(), law, damping);
  }
};

/// One of several sources for every point, drawn at random by the point's number. Points that share a source lie
/// anywhere: taken in turn, a structured mesh would get stripes. Sources of packings by depth, each from its own seed,
/// give ground whose columns differ.
/// \tparam Source a `PackingSource`
template <class Source>
struct RandomChoice {
  std::vector<Source> sources;  ///< at least one
  std::uint64_t seed = 1;       ///< of the draws

  /// \throws InputError when there is no source
  template <int Dim>
  decltype(auto) at(Site<Dim> const& site) const {
    if (sources.empty()) {
      reject("point {} is to draw from an empty pool of packings (none was prepared): prepare at least one",
             site.index);
    }
    return sources[drawn(seed, site.index, sources.size())].at(site);
  }

  /// Which of so many sources a point draws, for those who prepare no more than that.
  static std::size_t drawn(std::uint64_t seed, int point, std::size_t sources) {
    return family_seed(seed, static_cast<std::uint64_t>(point)) % sources;
  }
};

/// A packing of its own for every point, prepared when the point's state is made:
/// \code
/// IsotropicRecipe<Grains, EllipseGrading> recipe{.cloud = {...}, .preparation = {.pressure = 2e5}, .law = law};
/// DemRve<Grains, RandomPackings<decltype(recipe)>> sand{.law = law, .source = {recipe, seed}};
/// \endcode
/// The packing follows from the seed and the point's number. A preparation costs some ten thousand DEM steps, therefore
/// \code
/// auto const pool = RandomPackings{recipe, seed}.pool(32, executor);  // a RandomChoice
/// \endcode
/// prepares a few packings once, at the same time where the executor can, and every point draws one.
template <PreparesFromSeed Recipe>
struct RandomPackings {
  using Packing = decltype(std::declval<Recipe const&>()(std::uint64_t{}).packing);  ///< what a recipe prepares

  Recipe recipe{};         ///< prepares a packing from a seed
  std::uint64_t seed = 1;  ///< of the family of seeds, one for each point

  /// \throws PreparationError, naming the point, when its packing does not come to rest
  Packing at(Site<Packing::dim> const& site) const {
    auto prepared = recipe(family_seed(seed, static_cast<std::uint64_t>(site.index)));
    return of_outcome(std::move(prepared), "of point", site.index);
  }

  /// \throws PreparationError, naming the number in the pool; InputError for a pool of no packings
  RandomChoice<SamePacking<Packing>> pool(int count, Executor const& executor) const {
    if (count < 1) reject("a pool of {} packings was requested (points need one to draw): request at least one", count);
    std::vector<std::optional<Prepared<Packing>>> prepared(detail::index(count));
    executor.for_each(
        count, [&](int k) { prepared[detail::index(k)] = recipe(family_seed(seed, static_cast<std::uint64_t>(k))); });
    RandomChoice<SamePacking<Packing>> choice{{}, family_seed(seed, static_cast<std::uint64_t>(count))};
    for (int k = 0; k < count; ++k) {
      choice.sources.push_back({of_outcome(std::move(*prepared[detail::index(k)]), "in the pool, number", k)});
    }
    return choice;
  }

 private:
  template <class Outcome>
  static Packing of_outcome(Outcome&& outcome, char const* what, int number) {
    Verdict const verdict = outcome.verdict;
    if (!verdict.acceptable()) {
      throw PreparationError(
          fmt::format("the packing {} {} was not prepared ({}): try another seed, a looser cloud or a higher pressure",
                      what, number, name(verdict.reason)));
    }
    return std::forward<Outcome>(outcome).packing;
  }
};

template <class Recipe>
RandomPackings(Recipe, std::uint64_t) -> RandomPackings<Recipe>;

}  // namespace scarp
