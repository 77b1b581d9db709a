// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <stdexcept>

#include "scarp/dem/block/block_device.hpp"

namespace scarp {

/// What CUDA reports: a message of its own, and what was being done.
struct CudaError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A card on which packings respond, a block of threads for each. No header of CUDA is needed here: the one source that
/// nvcc compiles defines it for these types by `SCARP_CUDA_DEVICE`, see cuda/cuda_kernels.hpp.
/// number: of the card
/// \tparam Types a `BlockTypes` \tparam Damping a `DampsMotion` that needs no more than the time step
/// \throws InputError where there is no such card; CudaError for what CUDA reports, as all members do
template <class Types, class Damping>
std::shared_ptr<BlockDevice<Types, Damping>> cuda_device(int number = 0);

}  // namespace scarp
