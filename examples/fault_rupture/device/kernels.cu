// SPDX-License-Identifier: BSL-1.0
// Kernels of the reference study's ellipses: so many grains and near pairs.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/cuda/cuda_kernels.hpp"
#include "scarp/dem/damping.hpp"
#include "scarp/shape/ellipse.hpp"

using Types = scarp::BlockTypes<scarp::Ellipse, scarp::LinearFrictional, double>;

SCARP_CUDA_DEVICE(Types, scarp::LocalDamping, scarp::BlockSize{100, 336}, scarp::BlockSize{400, 1216})
