// SPDX-License-Identifier: BSL-1.0
// expect: ConstitutiveProvider
// expect: Responds
#include "scarp/constitutive/constitutive_provider.hpp"

#ifdef SCARP_REPAIRED
template <class State>
using Committed = State const&;
#else
template <class State>
using Committed = State&;
#endif

/// Wants to write to the committed state, which a provider must leave untouched.
struct Meddler {
  static constexpr int dim = 2;
  struct State {
    scarp::VoigtStress<2> stress = scarp::VoigtStress<2>::Zero();
  };
  State initial_state(scarp::Site<2> const&) const { return {}; }
  scarp::VoigtStress<2> stress(State const& state) const { return state.stress; }
  scarp::VoigtTangent<2> tangent(State const&) const { return scarp::VoigtTangent<2>::Identity(); }
  scarp::Response<2> respond(Committed<State> committed, scarp::Gradient<2> const&, State& trial) const {
    trial = committed;
    return {trial.stress, {}};
  }
};

template <scarp::ConstitutiveProvider Provider>
int points(Provider const&) {
  return 1;
}

int main() { return points(Meddler{}); }
