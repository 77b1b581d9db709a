// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace examples {

/// Where packings respond: on cores by the vector kernel, or by the block program on the same cores or on a card.
enum class Device { none, threads, cuda };

}  // namespace examples
