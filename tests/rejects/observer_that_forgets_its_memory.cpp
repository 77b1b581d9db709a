// SPDX-License-Identifier: BSL-1.0
// expect: an observer of a run that is saved names its members
#include <vector>

#include "scarp/io/state_bits.hpp"
#include "scarp/observe/observers.hpp"

/// Remembers the loads, which a run that goes on from a checkpoint would have lost.
struct Loads : scarp::NeverStops {
  std::vector<double> seen;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const& report) {
    seen.push_back(report.load);
  }
#ifdef SCARP_REPAIRED
  SCARP_MEMBERS(seen)
#endif
};

int main() {
  scarp::StateWriter writer;
  writer("observers", scarp::Observers(Loads{}));
}
