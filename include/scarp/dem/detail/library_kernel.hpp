// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/time_stepping.hpp"

/// Definitions for the sources of a library alone; see core/precompiled.hpp.
namespace scarp::detail {

template <class Shape, class Law>
using StepperOf = TimeStepper<Packing<Shape, Law>>;

template <class Stepper>
Verdict LibraryKernel<Stepper>::refresh(Stepper const& stepper, PackingType& packing, Law const& law) {
  return stepper.refresh_here(packing, law);
}

template <class Stepper>
template <Observe what>
Verdict LibraryKernel<Stepper>::step(Stepper& stepper, PackingType& packing, Law const& law,
                                     Tensor<dim> const& strain_step, StepObservation<dim>* observed) {
  return stepper.template step_here<what>(packing, law, strain_step, observed);
}

template <class Stepper>
Verdict LibraryKernel<Stepper>::observe(Stepper& stepper, PackingType& packing, Law const& law,
                                        StepObservation<dim>& observed) {
  return stepper.template look<Observe::balance>(packing, law, &observed);
}

}  // namespace scarp::detail

/// The kernels of a shape with all laws of the library, in namespace scarp::detail.
#define SCARP_KERNELS(SHAPE)            \
  SCARP_KERNEL(SHAPE, Frictionless)     \
  SCARP_KERNEL(SHAPE, LinearFrictional) \
  SCARP_KERNEL(SHAPE, HertzMindlin<>)
#define SCARP_KERNEL(SHAPE, ...)                                \
  template struct LibraryKernel<StepperOf<SHAPE, __VA_ARGS__>>; \
  SCARP_KERNEL_STEP(nothing, SHAPE, __VA_ARGS__)                \
  SCARP_KERNEL_STEP(balance, SHAPE, __VA_ARGS__)                \
  SCARP_KERNEL_STEP(energy, SHAPE, __VA_ARGS__)
#define SCARP_KERNEL_STEP(WHAT, SHAPE, ...)                                                                        \
  template Verdict LibraryKernel<StepperOf<SHAPE, __VA_ARGS__>>::step<Observe::WHAT>(                              \
      StepperOf<SHAPE, __VA_ARGS__>&, Packing<SHAPE, __VA_ARGS__>&, __VA_ARGS__ const&, Tensor<SHAPE::dim> const&, \
      StepObservation<SHAPE::dim>*);
