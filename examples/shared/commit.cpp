// SPDX-License-Identifier: BSL-1.0
// The only source that is compiled anew with every commit.
#include "example_commit.hpp"

#include <string_view>

namespace examples {
std::string_view commit();
std::string_view commit() { return SCARP_COMMIT; }
}  // namespace examples
