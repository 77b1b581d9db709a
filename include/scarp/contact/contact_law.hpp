// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <type_traits>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/named_member.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/simd/pack.hpp"
#include "scarp/simd/vectors.hpp"

SCARP_NAMED_MEMBER(friction)
SCARP_NAMED_MEMBER(friction_coefficient)
SCARP_NAMED_MEMBER(stored_energy)
SCARP_NAMED_MEMBER(interaction_range)
SCARP_NAMED_MEMBER(damping_ratio)
SCARP_NAMED_MEMBER(bond)

namespace scarp {

/// Tangential quantities at a contact: one number along the tangent in 2D, a vector in the tangent plane in 3D.
template <int Dim, class T>
using Tangential = std::conditional_t<Dim == 2, T, std::array<T, 3>>;

/// Rotations and moments: one number about the plane's normal in 2D, a vector in 3D.
template <int Dim, class T>
using Turning = std::conditional_t<Dim == 2, T, std::array<T, 3>>;

/// What a law needs of a contact. What it does not name is neither stored nor computed.
struct ContactInputs {
  bool shear = false;   ///< a tangential force is stored; `slip_increment` is given
  bool moment = false;  ///< a moment is stored; `rotation_increment` is given
  int scalars = 0;      ///< further numbers that are stored, zero for a new contact
  bool radius = false;  ///< `reduced_radius` is given
  bool motion = false;  ///< `overlap_increment`, `tangential_increment`, `reduced_mass` and `time_step` are given
  int species = 0;      ///< number that the law distinguishes; `species` is given
};

/// What a law may look at. Motions are those of the second grain relative to the first during the step; slip and
/// rotation are zero where the memory already contains them.
/// \tparam Dim 2 or 3
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <int Dim, class T>
struct ContactKinematics {
  T overlap;                                  ///< [m], positive in compression
  Tangential<Dim, T> slip_increment;          ///< tangential motion at the contact point [m]
  Turning<Dim, T> rotation_increment{};       ///< rotation [rad]
  T reduced_radius{};                         ///< \f$ R_1 R_2 / (R_1 + R_2) \f$ [m]
  T overlap_increment{};                      ///< growth of the overlap [m]
  Tangential<Dim, T> tangential_increment{};  ///< slip of the step, whether or not the memory contains it [m]
  T reduced_mass{};                           ///< \f$ m_1 m_2 / (m_1 + m_2) \f$ [kg]
  T time_step{};                              ///< [s]; zero while nothing moves
  std::array<T, 2> species{};                 ///< of both grains, 1, 2, ...
};

/// The most numbers that a law, with all that is wrapped around it, may need in `ContactInputs::scalars`.
inline constexpr int max_contact_scalars = 4;

/// Memory of a contact from step to step, as far as its law needs it.
/// \tparam Dim 2 or 3
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <int Dim, class T>
struct ContactMemory {
  Tangential<Dim, T> shear{};                    ///< tangential force on the second grain [N]
  Turning<Dim, T> moment{};                      ///< on the second grain [N m]
  std::array<T, max_contact_scalars> scalars{};  ///< further numbers that the law stores, zero for a new contact

  SCARP_MEMBERS(shear, moment, scalars)
};

/// Response of a law. What its caller does not use costs nothing.
/// \tparam Dim 2 or 3
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <int Dim, class T>
struct ContactForce {
  T normal;                    ///< [N], positive pushes the grains apart
  Tangential<Dim, T> shear{};  ///< on the second grain [N]
  Turning<Dim, T> moment{};    ///< on the second grain [N m], where the law needs a moment
  T dissipated{};              ///< energy lost in the contact during the step [J]
};

/// Stiffness of a closed contact against a small motion, sliding not regarded: forces [N/m], moment [N m/rad].
struct ContactStiffness {
  double normal = 0.0;      ///< along the normal [N/m]
  double tangential = 0.0;  ///< along the tangent [N/m]
  double rolling = 0.0;     ///< against rolling [N m/rad]
};

/// respond(approach, memory): forces of the contact; the memory is brought up to date.
template <class Law>
concept RespondsToApproach = requires(Law const& law, ContactKinematics<2, double> const& approach,
                                      ContactMemory<2, double>& memory) {
  { law.respond(approach, memory) } -> std::same_as<ContactForce<2, double>>;
};

/// The same for packs: the pair loop evaluates several contacts at once, in the plane and in space alike.
template <class Law>
concept RespondsInPacks = requires(Law const& law, ContactKinematics<2, lanes::Pack<double>> const& approach,
                                   ContactMemory<2, lanes::Pack<double>>& memory) {
  { law.respond(approach, memory) } -> std::same_as<ContactForce<2, lanes::Pack<double>>>;
};

/// stiffness(overlap, reduced radius): tangent stiffness of a contact [N/m], for time steps and tangents of packings.
template <class Law>
concept HasContactStiffness = requires(Law const& law) {
  { law.stiffness(0.0, 0.0) } -> std::same_as<ContactStiffness>;  // at an overlap and a reduced radius [m]
};

/// A law names the inputs that it needs, with at most `max_contact_scalars` stored numbers.
template <class Law>
concept NamesContactInputs = requires {
  { Law::inputs } -> std::convertible_to<ContactInputs>;
  requires Law::inputs.scalars <= max_contact_scalars;
};

namespace detail {
/// Where a law, or the innermost law within it, has its friction coefficient; nothing for a law without one.
template <class Law>
auto friction_in(Law& law) {
  if constexpr (requires {
                  { (law.friction) } -> std::same_as<double&>;
                }) {
    return &law.friction;
  } else if constexpr (requires { law.law; }) {
    return friction_in(law.law);
  }
}
}  // namespace detail

/// Friction coefficient of a law: its member `double friction`, or that of the law within it, `law`.
template <class Law>
  requires std::same_as<decltype(detail::friction_in(std::declval<Law&>())), double*>
double& friction_coefficient(Law& law) { return *detail::friction_in(law); }

/// A law with a friction coefficient needs a shear force that is stored: without it none would be computed.
template <class Law>
concept RemembersItsShear = Law::inputs.shear || !requires(Law & law) {
  friction_coefficient(law);
};

/// Force of a contact as a function of its kinematics and memory: an aggregate of parameters with `inputs`, `respond`
/// and `stiffness`.
template <class Law>
concept ContactLaw = std::is_aggregate_v<Law> && NamesContactInputs<Law> && RemembersItsShear<Law> &&
    RespondsToApproach<Law> && RespondsInPacks<Law> && HasContactStiffness<Law>;

/// A law whose friction coefficient can be exchanged, as the preparation of a packing needs.
template <class Law>
concept Frictional = ContactLaw<Law> && requires(Law& law) {
  friction_coefficient(law);
};

/// Calls visit(one) for the laws of all pairs of species, or for the law itself where there is only one.
template <class Law, class Visit>
void for_each_law(Law& law, Visit&& visit) {
  if constexpr (requires { law.laws; }) {
    for (auto& one : law.laws) visit(one);
  } else {
    visit(law);
  }
}

/// Calls visit(double&) for every friction coefficient of a law: none, one, or one for each pair of species.
template <class Law, class Visit>
void for_each_friction(Law& law, Visit&& visit) {
  for_each_law(law, [&](auto& one) {
    if constexpr (Frictional<std::remove_cvref_t<decltype(one)>>) visit(friction_coefficient(one));
  });
}

/// Stiffness of one contact by the law, by the law between its species where there is one for each pair.
template <class Law, int Dim>
ContactStiffness contact_stiffness(Law const& law, ContactKinematics<Dim, double> const& approach) {
  if constexpr (requires { law.laws; }) {
    auto const [first, second] = approach.species;
    return law.between(static_cast<int>(first), static_cast<int>(second))
        .stiffness(approach.overlap, approach.reduced_radius);
  } else {
    return law.stiffness(approach.overlap, approach.reduced_radius);
  }
}

/// stored_energy(approach, memory): what the contact would give back [J].
template <class Law>
concept HasStoredEnergy = ContactLaw<Law> &&
    requires(Law const& law, ContactKinematics<2, double> const& approach, ContactMemory<2, double> const& memory) {
  { law.stored_energy(approach, memory) } -> std::same_as<double>;
};

/// interaction_range(): the widest gap [m] across which the law still acts, such as a bond that is pulled. A law that
/// has none acts on closed contacts only. Write `static_assert(HasInteractionRange<MyLaw>)` after one that has it,
/// which finds a misspelled name.
template <class Law>
concept HasInteractionRange = requires(Law const& law) {
  { law.interaction_range() } -> std::convertible_to<double>;
};

/// A law's interaction range [m]; zero for a law without one.
template <class Law>
constexpr double interaction_range_of(Law const& law) {
  if constexpr (HasInteractionRange<Law>) return law.interaction_range();
  return 0.0;
}

/// bond(memory): bonds a contact, which the law then lets pull.
template <class Law>
concept Bonds = requires(ContactMemory<2, double>& memory) {
  Law::bond(memory);
};

/// damping_ratio(): share of critical damping that the law's dashpots may reach; the time step is the shorter for it.
template <class Law>
concept HasDampingRatio = requires(Law const& law) {
  { law.damping_ratio() } -> std::convertible_to<double>;
};

/// A law's damping ratio; zero for a law without dashpots.
template <class Law>
constexpr double damping_ratio_of(Law const& law) {
  if constexpr (HasDampingRatio<Law>) return law.damping_ratio();
  return 0.0;
}

namespace detail {

/// Names an optional member of a law that cannot be called. Laws that are made of others offer what these offer.
template <class Law>
consteval void check_options_of_law() {
  if constexpr (requires { &Law::law; }) {
    check_options_of_law<decltype(Law::law)>();
  } else if constexpr (requires { &Law::laws; }) {
    check_options_of_law<typename decltype(Law::laws)::value_type>();
  } else {
    static_assert(!names_friction_coefficient<Law>,
                  "scarp: friction_coefficient of a law is never called: name its coefficient `double friction`");
    static_assert(Frictional<Law> || !names_friction<Law>,
                  "scarp: friction of a law is never exchanged: it needs to be `double friction`");
    static_assert(HasStoredEnergy<Law> || !names_stored_energy<Law>,
                  "scarp: stored_energy of a law is never called: it needs `template <int Dim, class T> T "
                  "stored_energy(ContactKinematics<Dim, T> const&, ContactMemory<Dim, T> const&) const` [J]");
    static_assert(HasInteractionRange<Law> || !names_interaction_range<Law>,
                  "scarp: interaction_range of a law is never called: it needs `double interaction_range() const` [m]");
    static_assert(HasDampingRatio<Law> || !names_damping_ratio<Law>,
                  "scarp: damping_ratio of a law is never called: it needs `double damping_ratio() const`");
    static_assert(Bonds<Law> || !names_bond<Law>,
                  "scarp: bond of a law is never called: it needs `template <int Dim, class T> static void "
                  "bond(ContactMemory<Dim, T>&)`");
  }
}

/// Names the missing member of a type that is no `ContactLaw`.
template <class Law>
consteval bool check_contact_law() {
  static_assert(std::is_aggregate_v<Law>,
                "scarp: a contact law is an aggregate of parameters: no constructors, no private or virtual members");
  static_assert(NamesContactInputs<Law>,
                "scarp: a contact law needs `static constexpr ContactInputs inputs{...}`, with at most "
                "max_contact_scalars scalars");
  static_assert(
      !NamesContactInputs<Law> || RemembersItsShear<Law>,
      "scarp: a contact law with a friction coefficient needs `.shear = true` in its inputs: nothing would rub");
  static_assert(
      RespondsToApproach<Law>,
      "scarp: a contact law needs `template <int Dim, class T> ContactForce<Dim, T> respond(ContactKinematics<Dim, T> "
      "const&, ContactMemory<Dim, T>&) const`");
  static_assert(
      !RespondsToApproach<Law> || RespondsInPacks<Law>,
      "scarp: a contact law is evaluated for several contacts at once: make respond a template over the scalar T");
  static_assert(
      HasContactStiffness<Law>,
      "scarp: a contact law needs `ContactStiffness stiffness(double overlap, double reduced_radius) const` [N/m]");
  if constexpr (ContactLaw<Law>) check_options_of_law<Law>();
  return ContactLaw<Law>;
}

/// Compiles the law's response for several contacts at once, before the pair loop does: what cannot be compiled, an
/// `if` on an overlap for example, is then reported with this short name, by clang with the comment below.
template <class Law>
constexpr bool a_law_responds_to_many_contacts_at_once_so_it_takes_lanes_select_for_if() {
  if constexpr (!is_precompiled<Law>) {
    using T = lanes::Pack<double>;
    [[maybe_unused]] auto const response = [](Law const& law, ContactKinematics<2, T> const& approach,
                                              ContactMemory<2, T>& memory) {
      return law.respond(approach, memory);  // many_contacts_at_once: lanes::select in the place of `if`
    };
  }
  return true;
}

}  // namespace detail

/// A `ContactLaw`; for another type the compiler names the missing member.
template <class Law>
concept CheckedContactLaw = detail::check_contact_law<Law>() &&
    detail::a_law_responds_to_many_contacts_at_once_so_it_takes_lanes_select_for_if<Law>();

}  // namespace scarp
