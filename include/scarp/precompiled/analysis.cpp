// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/analysis.hpp"

namespace scarp {
template class Model<2>;
template class Model<3>;
template class Analysis<2>;
template class Analysis<3>;
}  // namespace scarp
