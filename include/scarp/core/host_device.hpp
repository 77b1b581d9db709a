// SPDX-License-Identifier: BSL-1.0
#pragma once

/// Stands before functions that threads of a card run as well as those of the processor. Laws and shapes, through which
/// packs of lanes pass too, carry `constexpr` instead: nvcc rejects vectors in functions with this word and takes
/// constexpr functions for both sides (--expt-relaxed-constexpr). A function with this word that calls one with neither
/// is an error of nvcc (-Werror cross-execution-space-call); a constexpr function that does so is compiled to nothing,
/// without a message.
#if defined(__CUDACC__)
#define SCARP_HOST_DEVICE __host__ __device__
#define SCARP_DEVICE_CONSTEXPR constexpr
#else
#define SCARP_HOST_DEVICE
/// `constexpr` where nvcc compiles: elsewhere the word would change which products g++ contracts, and so the last bits
/// of a step.
#define SCARP_DEVICE_CONSTEXPR
#endif
