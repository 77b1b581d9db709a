// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>

namespace scarp {
template <int Dim>
class AnyProvider;
}

namespace fault_rupture {

struct Sand;
/// Puts the packings of a sand on a device; empty where they stay on the processor.
using ToDevice = std::function<scarp::AnyProvider<2>(Sand const& sand)>;

}  // namespace fault_rupture
