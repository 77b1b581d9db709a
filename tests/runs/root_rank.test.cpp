// SPDX-License-Identifier: BSL-1.0
#include "scarp/run/root_rank.hpp"

#include <doctest/doctest.h>

#include "scarp/io/state_bits.hpp"
#include "scarp/observe/observers.hpp"

namespace {

/// An observer whose half follows from what is saved.
struct Halving : scarp::NeverStops {
  double* half;
  double sum = 0.0;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {}
  template <class Problem>
  void ended(Problem const&, double) {}
  void after_loading() { *half = sum / 2.0; }

  SCARP_MEMBERS_EXCEPT((half), sum)
};

/// What the half of a sum of 8 is once it has been loaded.
template <class Make>
double loaded(Make const& make) {
  scarp::SerialExecutor serial;
  double half = 0.0;
  scarp::OnRootRank const saved(serial, [&] { return make(Halving{{}, &half, 8.0}); });
  scarp::StateWriter writer;
  writer("observers", saved);
  scarp::OnRootRank read(serial, [&] { return make(Halving{{}, &half, 0.0}); });
  scarp::StateReader reader(writer.bits());
  reader("observers", read);
  CHECK(reader.at_end());
  return half;
}

}  // namespace

TEST_CASE("an observer of the root rank does what it has to do after loading, alone or among others") {
  CHECK(loaded([](Halving const& one) { return one; }) == 4.0);
  CHECK(loaded([](Halving const& one) { return scarp::Observers(one); }) == 4.0);
}
