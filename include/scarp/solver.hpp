// SPDX-License-Identifier: BSL-1.0
/// \file
/// Equilibrium of a problem with its materials: load stepping, Newton-like iterations, linear solvers, executors.
/// `load_stepping.hpp` grows the load and cuts steps back; `quasi_newton.hpp` takes any tangent rule and mixing.
/// An executor asks the points: serial, threads; ranks with `rank_executor.hpp` (component scarp::mpi).
/// Problems whose points see means of their neighbours need `wide_equations.hpp` too.
/// Linear solvers of SuiteSparse are `cholmod.hpp` and `umfpack.hpp` (component scarp::suitesparse).
/// What does not converge is a verdict with a reason.
#pragma once

#include "scarp/solver/anderson_mixing.hpp"
#include "scarp/solver/bfgs_mixing.hpp"
#include "scarp/solver/consistent_tangent.hpp"
#include "scarp/solver/dynamic_relaxation.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/executor.hpp"
#include "scarp/solver/frozen_tangent.hpp"
#include "scarp/solver/line_search.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/one_of.hpp"
#include "scarp/solver/plain_step.hpp"
#include "scarp/solver/point_secant.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "scarp/solver/sparse_ldlt.hpp"
#include "scarp/solver/sparse_lu.hpp"
#include "scarp/solver/thread_executor.hpp"
