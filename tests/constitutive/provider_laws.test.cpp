// SPDX-License-Identifier: BSL-1.0
#include "constitutive/provider_laws.hpp"

#include "dem/sample_packings.hpp"
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"

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

TEST_CASE_TEMPLATE("every provider: committed state is never touched", Provider, ElasticInPlane, ElasticInSpace,
                   RveOfDiscs, RveOfEllipses) {
  provider_laws::committed_state_is_never_touched<Provider>();
}

TEST_CASE_TEMPLATE("every provider: the same input gives the same bits, whatever the trial state held", Provider,
                   ElasticInPlane, ElasticInSpace, RveOfDiscs, RveOfEllipses) {
  provider_laws::same_input_gives_the_same_bits<Provider>();
}

TEST_CASE_TEMPLATE("every provider: a zero increment changes nothing", Provider, ElasticInPlane, ElasticInSpace,
                   RveOfDiscs, RveOfEllipses) {
  provider_laws::a_zero_increment_changes_nothing<Provider>();
}

TEST_CASE_TEMPLATE("every provider: a rotation turns the stress", Provider, ElasticInPlane, ElasticInSpace, RveOfDiscs,
                   RveOfEllipses) {
  provider_laws::a_rotation_turns_the_stress<Provider>();
}

TEST_CASE_TEMPLATE("every provider: the tangent is the derivative of the stress, or an upper bound of it", Provider,
                   ElasticInPlane, ElasticInSpace, RveOfDiscs, RveOfEllipses) {
  provider_laws::the_tangent_is_the_derivative_or_bounds_it<Provider>();
}

TEST_CASE_TEMPLATE("every provider: an increment that is no number fails with a reason", Provider, ElasticInPlane,
                   ElasticInSpace, RveOfDiscs, RveOfEllipses) {
  provider_laws::not_a_number_fails_with_a_reason<Provider>();
}

TEST_CASE_TEMPLATE("every provider: a tiny increment moves the stress no further than the tangent allows", Provider,
                   ElasticInPlane, ElasticInSpace, RveOfDiscs, RveOfEllipses) {
  provider_laws::the_answer_does_not_jump<Provider>();
}
