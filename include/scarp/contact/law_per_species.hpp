// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>

#include "scarp/contact/contact_law.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// One contact law with parameters of its own for every pair of species, i with j as j with i; grains are
/// `WithSpecies<Shape, Species>`. Each contact evaluates the laws of all pairs and selects one: for few species, two or
/// three.
template <ContactLaw Law, int Species>
  requires(Species >= 1 && Law::inputs.species == 0)
struct LawPerSpecies {
  static constexpr ContactInputs inputs = [] {
    ContactInputs all = Law::inputs;
    all.species = Species;
    return all;
  }();

  std::array<Law, detail::index(Species*(Species + 1) / 2)> laws{};  ///< of 1-1, 1-2, ... 2-2, 2-3, ...

  /// The law between two species, 1 to `Species`. \throws InputError for others
  Law& between(int first, int second) { return laws[checked_place(first, second)]; }
  /// The law between two species, 1 to `Species`. \throws InputError for others
  Law const& between(int first, int second) const { return laws[checked_place(first, second)]; }

  void validate() const {
    for (Law const& law : laws) detail::validated(law);
  }

  /// Bonds a contact under the laws of all pairs of species, which share one memory.
  template <int Dim, class T>
  static constexpr void bond(ContactMemory<Dim, T>& memory) requires Bonds<Law> {
    Law::bond(memory);
  }

  template <int Dim, class T>
  constexpr ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const& approach,
                                         ContactMemory<Dim, T>& memory) const {
    ContactMemory<Dim, T> const before = memory;
    ContactForce<Dim, T> force = laws[0].respond(approach, memory);
    for_each_pair_but_first(approach, [&](Law const& law, auto const& is_pair) {
      ContactMemory<Dim, T> after = before;
      ContactForce<Dim, T> const other = law.respond(approach, after);
      auto const take = [&](auto& own, auto const& others) { own = lanes::select(is_pair, others, own); };
      take(force.normal, other.normal);
      take(force.dissipated, other.dissipated);
      if constexpr (inputs.shear) take(force.shear, other.shear);
      if constexpr (inputs.shear) take(memory.shear, after.shear);
      if constexpr (inputs.moment) take(force.moment, other.moment);
      if constexpr (inputs.moment) take(memory.moment, after.moment);
      if constexpr (inputs.scalars > 0) take(memory.scalars, after.scalars);
    });
    return force;
  }

  /// The largest of all pairs at an overlap and a reduced radius [m], which bounds the time step; that of one contact
  /// is `contact_stiffness`.
  constexpr ContactStiffness stiffness(double overlap, double reduced_radius) const {
    ContactStiffness most;
    for (Law const& law : laws) {
      auto const own = law.stiffness(overlap, reduced_radius);
      most = {.normal = std::max(most.normal, own.normal),
              .tangential = std::max(most.tangential, own.tangential),
              .rolling = std::max(most.rolling, own.rolling)};
    }
    return most;
  }

  template <int Dim, class T>
    requires HasStoredEnergy<Law>
  constexpr T stored_energy(ContactKinematics<Dim, T> const& approach, ContactMemory<Dim, T> const& memory) const {
    T energy = laws[0].stored_energy(approach, memory);
    for_each_pair_but_first(approach, [&](Law const& law, auto const& is_pair) {
      energy = lanes::select(is_pair, law.stored_energy(approach, memory), energy);
    });
    return energy;
  }

  constexpr double interaction_range() const {
    return max_of([](Law const& law) { return interaction_range_of(law); });
  }
  constexpr double damping_ratio() const {
    return max_of([](Law const& law) { return damping_ratio_of(law); });
  }

 private:
  static std::size_t checked_place(int first, int second) {
    if (std::min(first, second) < 1 || std::max(first, second) > Species)
      reject("there is no law between species {} and {} (there are 1 to {}): use these numbers", first, second,
             Species);
    return place(first, second);
  }

  static constexpr std::size_t place(int first, int second) {
    int const low = std::min(first, second) - 1;
    return detail::index(low * Species - low * (low - 1) / 2 + std::max(first, second) - 1 - low);
  }

  /// visit(law, mask of the contacts that are of its pair of species)
  template <int Dim, class T, class Visit>
  constexpr void for_each_pair_but_first(ContactKinematics<Dim, T> const& approach, Visit&& visit) const {
    T const low = lanes::at_most(approach.species[0], approach.species[1]);
    T const high = lanes::at_least(approach.species[0], approach.species[1]);
    for (int i = 1; i <= Species; ++i) {
      for (int j = std::max(i, 2); j <= Species; ++j)
        visit(laws[place(i, j)], low == broadcast<T>(i) && high == broadcast<T>(j));
    }
  }

  template <class Number>
  constexpr double max_of(Number&& number) const {
    double most = number(laws[0]);
    for (Law const& law : laws) most = std::max(most, number(law));
    return most;
  }
};

static_assert(ContactLaw<LawPerSpecies<LinearFrictional, 2>>);

}  // namespace scarp
