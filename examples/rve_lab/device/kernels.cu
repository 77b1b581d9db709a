// SPDX-License-Identifier: BSL-1.0
// Kernels of discs and ellipses with linear contacts: so many grains and near pairs, up to what the memory of a block
// holds.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/cuda/cuda_kernels.hpp"
#include "scarp/dem/damping.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"

using OfDiscs = scarp::BlockTypes<scarp::Disc, scarp::LinearFrictional, double>;
using OfEllipses = scarp::BlockTypes<scarp::Ellipse, scarp::LinearFrictional, double>;

SCARP_CUDA_DEVICE(OfDiscs, scarp::LocalDamping, scarp::BlockSize{100, 336}, scarp::BlockSize{400, 1216},
                  scarp::BlockSize{1000, 3000})
SCARP_CUDA_DEVICE(OfEllipses, scarp::LocalDamping, scarp::BlockSize{100, 336}, scarp::BlockSize{400, 1216},
                  scarp::BlockSize{800, 2432})
