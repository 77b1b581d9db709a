// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/fault/bedrock_motion.hpp"

namespace scarp {

/// A fault both of whose sides move: the left one takes a share of the slip, the other way.
/// \code
/// SharedSlip<NormalFault>{{.dip = 1.0}, 0.5}
/// \endcode
template <BedrockMotion Fault>
struct SharedSlip : Fault {
  double left_share = 0.5;  ///< from 0 to 1

  /// \throws InputError for a share out of range, or what the fault refuses
  Vector<2> left() const { return Fault::left() - slip_of_left(); }
  Vector<2> right() const { return Fault::right() - slip_of_left(); }

 private:
  Vector<2> slip_of_left() const {
    if (!(left_share >= 0.0 && left_share <= 1.0)) {
      refuse("the left side takes {} of the slip (a share is from 0 to 1): choose one in this range", left_share);
    }
    return left_share * (Fault::right() - Fault::left());
  }
};

}  // namespace scarp
