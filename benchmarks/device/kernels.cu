// SPDX-License-Identifier: BSL-1.0
// Kernels of the benchmark's ellipses in both precisions: so many grains and near pairs.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/cuda/cuda_kernels.hpp"
#include "scarp/dem/damping.hpp"
#include "scarp/shape/ellipse.hpp"

using Double = scarp::BlockTypes<scarp::Ellipse, scarp::LinearFrictional, double>;
using Float = scarp::BlockTypes<scarp::Ellipse, scarp::LinearFrictional, float>;

SCARP_CUDA_DEVICE(Double, scarp::LocalDamping, scarp::BlockSize{100, 336}, scarp::BlockSize{400, 1216})
SCARP_CUDA_DEVICE(Float, scarp::LocalDamping, scarp::BlockSize{100, 336}, scarp::BlockSize{400, 1216})
