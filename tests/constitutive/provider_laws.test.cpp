// SPDX-License-Identifier: BSL-1.0
#include "constitutive/provider_laws.hpp"

#include "constitutive/umats.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/constitutive/varied_parameters.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "support/packings.hpp"

namespace provider_laws {

template <int Dim>
struct Sample<scarp::LinearElastic<Dim>> {
  using Provider = scarp::LinearElastic<Dim>;
  using State = typename Provider::State;
  static constexpr double increment = 1e-3;
  static constexpr double rest = 1e-15;  // round-off
  static constexpr double rotation_step = 0.5;
  static constexpr double rotation = 1e-13;  // round-off of the stretch, 1e-16, times modulus over stress, 14
  static constexpr bool elastic = true;

  static Provider provider() { return Provider::from_lame(3e6, 2e6); }
  static State state(Provider const&) { return {VoigtStress<Dim>::LinSpaced(-5e5, 1e5)}; }
  static bool same(State const& a, State const& b) { return a.stress == b.stress; }
};

/// A state of a provider that stores the stress in space.
template <int Dim>
auto stressed_in_space(auto const& provider) {
  auto state = provider.initial_state({});
  state.stress = VoigtStress<3>::LinSpaced(-5e5, 1e5);
  if (Dim == 2) state.stress.template segment<2>(3).setZero();  // nothing shears out of the plane
  return state;
}

/// Cohesion keeps all increments of the laws well inside the surface, where the answer is smooth.
template <int Dim>
struct Sample<scarp::MohrCoulomb<Dim>> : Sample<scarp::LinearElastic<Dim>> {
  using Provider = scarp::MohrCoulomb<Dim>;
  using State = typename Provider::State;

  static Provider provider() {
    return {scarp::IsotropicElasticity::from_lame(3e6, 2e6), {{.cohesion = 1e6, .friction = 0.5}}, {}};
  }
  static State state(Provider const& provider) { return stressed_in_space<Dim>(provider); }
  static bool same(State const& a, State const& b) {
    return a.stress == b.stress && a.plastic_shear == b.plastic_shear && a.tangent == b.tangent;
  }
};

template <int Dim>
struct Sample<scarp::UmatProvider<Dim>> : Sample<scarp::LinearElastic<Dim>> {
  using Provider = scarp::UmatProvider<Dim>;
  using State = typename Provider::State;

  static Provider provider() { return umats::elastic<Dim>(); }
  static State state(Provider const& provider) { return stressed_in_space<Dim>(provider); }
  static bool same(State const& a, State const& b) {
    return a.stress == b.stress && a.strain == b.strain && a.variables == b.variables && a.tangent == b.tangent;
  }
};

/// An adaptor around plane elasticity obeys the laws as that does.
struct AdaptedElastic : Sample<scarp::LinearElastic<2>> {
  using Inner = scarp::LinearElastic<2>;
  static Inner inner() { return Sample<Inner>::provider(); }
  static bool same(auto const& a, auto const& b) { return a.own.stress == b.own.stress; }
  static auto state(auto const& provider) {
    auto state = provider.initial_state({});
    state.own = Sample<Inner>::state(inner());
    return state;
  }
};

template <>
struct Sample<scarp::VariedParameters<scarp::LinearElastic<2>>> : AdaptedElastic {
  static scarp::VariedParameters<Inner> provider() {
    return {{}, [](Inner const&, scarp::Site<2> const&) { return inner(); }};
  }
};

template <>
struct Sample<scarp::StiffnessFloor<scarp::LinearElastic<2>>> : AdaptedElastic {
  static scarp::StiffnessFloor<Inner> provider() { return {inner()}; }
};

template <class PackingType>
struct Sample<scarp::DemRve<PackingType, scarp::SamePacking<PackingType>>> {
  using Provider = scarp::DemRve<PackingType, scarp::SamePacking<PackingType>>;
  using State = typename Provider::State;
  static constexpr double increment = 1e-3;
  static constexpr double rest = 1e-4;  // the preparation's own tolerance of stress and balance
  static constexpr double rotation_step = 3.141592653589793 / 180.0;
  static constexpr double rotation = 1e-4;  // the same, and the square of the angle of one time step, 1e-6
  static constexpr bool elastic = false;

  static Provider provider() {
    return {.law = samples::study_law(), .source = {samples::consolidated<PackingType>(80).packing}};
  }
  static State state(Provider const& provider) { return provider.initial_state({}); }
  static bool same(State const& a, State const& b) {
    return a.packing == b.packing && a.stress == b.stress && a.unbalanced_ratio == b.unbalanced_ratio &&
           a.verdict == b.verdict;
  }
};

}  // namespace provider_laws

using ElasticInPlane = scarp::LinearElastic<2>;
using ElasticInSpace = scarp::LinearElastic<3>;
using RveOfDiscs = scarp::DemRve<samples::Discs, scarp::SamePacking<samples::Discs>>;
using RveOfEllipses = scarp::DemRve<samples::Ellipses, scarp::SamePacking<samples::Ellipses>>;
#define EVERY_PROVIDER                                                                                  \
  ElasticInPlane, ElasticInSpace, scarp::MohrCoulomb<2>, scarp::MohrCoulomb<3>, scarp::UmatProvider<2>, \
      scarp::UmatProvider<3>, RveOfDiscs, RveOfEllipses, scarp::VariedParameters<ElasticInPlane>,       \
      scarp::StiffnessFloor<ElasticInPlane>

TEST_CASE_TEMPLATE("every provider: committed state is never touched", Provider, EVERY_PROVIDER) {
  provider_laws::committed_state_is_never_touched<Provider>();
}

TEST_CASE_TEMPLATE("every provider: the same input gives the same bits, whatever the trial state held", Provider,
                   EVERY_PROVIDER) {
  provider_laws::same_input_gives_the_same_bits<Provider>();
}

TEST_CASE_TEMPLATE("every provider: a zero increment changes nothing", Provider, EVERY_PROVIDER) {
  provider_laws::a_zero_increment_changes_nothing<Provider>();
}

TEST_CASE_TEMPLATE("every provider: a rotation turns the stress", Provider, EVERY_PROVIDER) {
  provider_laws::a_rotation_turns_the_stress<Provider>();
}

TEST_CASE_TEMPLATE("every provider: a rotation on top of a strain turns its answer", Provider, EVERY_PROVIDER) {
  provider_laws::a_rotation_on_top_of_a_strain_turns_its_answer<Provider>();
}

TEST_CASE_TEMPLATE("every provider: a closed cycle of strain gives no energy", Provider, EVERY_PROVIDER) {
  provider_laws::a_closed_cycle_of_strain_gives_no_energy<Provider>();
}

TEST_CASE_TEMPLATE("every provider: the tangent is the derivative of the stress, or an upper bound of it", Provider,
                   EVERY_PROVIDER) {
  provider_laws::the_tangent_is_the_derivative_or_bounds_it<Provider>();
}

TEST_CASE_TEMPLATE("every provider: an increment that is no number fails with a reason", Provider, EVERY_PROVIDER) {
  provider_laws::not_a_number_fails_with_a_reason<Provider>();
}

TEST_CASE_TEMPLATE("every provider: a tiny increment moves the stress no further than the tangent allows", Provider,
                   EVERY_PROVIDER) {
  provider_laws::the_answer_does_not_jump<Provider>();
}
