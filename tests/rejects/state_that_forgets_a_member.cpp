// SPDX-License-Identifier: BSL-1.0
// expect: structured binding|decomposes into
// expect: Forgetful
#include "scarp/io/state_bits.hpp"

/// Has a member that is neither saved nor left out in words; a private one counts like others.
class Forgetful {
 public:
#ifdef SCARP_REPAIRED
  SCARP_MEMBERS(stress_, plastic_shear_)
#else
  SCARP_MEMBERS(stress_)
#endif

 private:
  double stress_ = 0.0;
  double plastic_shear_ = 0.0;
};

int main() {
  scarp::StateWriter writer;
  writer("state", Forgetful{});
}
