// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/contact/contact_law.hpp"
#include "scarp/core/precompiled.hpp"

namespace scarp {

namespace detail {

/// What of a contact law is missing, in words.
template <class Law>
struct MissingOfContactLaw {
  static_assert(std::is_aggregate_v<Law>,
                "scarp: a contact law is an aggregate of parameters: no constructors, no private or virtual members");
  static_assert(NamesContactNeeds<Law>,
                "scarp: a contact law needs `static constexpr ContactNeeds needs{...}`, with at most "
                "most_contact_scalars scalars");
  static_assert(
      !NamesContactNeeds<Law> || RemembersItsShear<Law>,
      "scarp: a contact law with friction_coefficient() needs `.shear = true` in its needs: nothing would rub");
  static_assert(RespondsToApproach<Law>,
                "scarp: a contact law needs `template <int Dim, class T> ContactForce<Dim, T> respond(Approach<Dim, T> "
                "const&, ContactMemory<Dim, T>&) const`");
  static_assert(
      !RespondsToApproach<Law> || RespondsInPacks<Law>,
      "scarp: a contact law is asked for several contacts at once: make respond a template over the scalar T");
  static_assert(
      TellsContactStiffness<Law>,
      "scarp: a contact law needs `ContactStiffness stiffness(double overlap, double reduced_radius) const` [N/m]");
  static constexpr bool nothing = false;
};

/// Compiles the law's answer for several contacts at once, before the pair loop does: what cannot be compiled, an `if`
/// on an overlap say, is then reported with this short name, by clang with the comment below, and not from within the loop.
template <class Law>
constexpr bool a_law_answers_many_contacts_at_once_so_it_takes_lanes_select_for_if() {
  if constexpr (!is_precompiled<Law>) {
    using T = lanes::Pack<double>;
    [[maybe_unused]] auto const answer = [](Law const& law, Approach<2, T> const& approach,
                                            ContactMemory<2, T>& memory) {
      return law.respond(approach, memory);  // many_contacts_at_once: lanes::select in the place of `if`
    };
  }
  return true;
}

}  // namespace detail

/// A `ContactLaw`; of one that is none the compiler says in words what is missing.
template <class Law>
concept CheckedContactLaw = (ContactLaw<Law> || detail::MissingOfContactLaw<Law>::nothing) &&
                            detail::a_law_answers_many_contacts_at_once_so_it_takes_lanes_select_for_if<Law>();

}  // namespace scarp
