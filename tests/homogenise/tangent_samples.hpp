// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <doctest/doctest.h>

#include <map>

#include "../../benchmarks/shared/sliding_springs.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "support/factorisations.hpp"
#include "support/packings.hpp"

namespace samples {

using scarp::Tensor;
using scarp::VoigtTangent;

template <class PackingType>
PackingType listed(PackingType packing, typename PackingType::Law const& law) {
  scarp::TimeStepper<PackingType> stepper;
  REQUIRE(stepper.refresh(packing, law).acceptable());
  return packing;
}

/// A consolidated packing of 80 grains in the amplitude of pure shear, at 0.5 %; many of its contacts slide.
template <class PackingType>
PackingType const& sheared() {
  static PackingType const packing = [] {
    auto const& prepared = consolidated<PackingType>(80);
    REQUIRE(prepared.verdict.acceptable());
    PackingType moved = prepared.packing;
    scarp::TimeStepper<PackingType> stepper;
    Tensor<2> strain = Tensor<2>::Zero();
    strain.diagonal() << 1e-5, -1e-5;
    for (int k = 0; k < 500; ++k) REQUIRE(stepper.step(moved, study_law(), strain).acceptable());
    return moved;
  }();
  return packing;
}

/// The same brought to rest to round-off, where contacts may have drawn back from their limit.
template <class PackingType>
PackingType const& settled_after_shear() {
  static PackingType const packing = [] {
    PackingType settled = sheared<PackingType>();
    scarp::TimeStepper<PackingType> stepper;
    for (int k = 0; k < 20'000; ++k) REQUIRE(stepper.step(settled, study_law(), Tensor<2>::Zero()).acceptable());
    settled.rest();
    return settled;
  }();
  return packing;
}

/// Tangent [Pa] under uniform strain in which contacts at their shear limit slide, \f$ \frac1V \sum S_{ik} l_j l_l \f$.
struct UniformStrain {
  benchmarks::SlidingSprings sliding{};

  template <class PackingType>
  VoigtTangent<PackingType::dim> operator()(PackingType const& packing, typename PackingType::Law const& law) const {
    constexpr int dim = PackingType::dim;
    scarp::FullTangent<dim> sum = scarp::FullTangent<dim>::Zero();
    scarp::for_each_contact(packing, law, [&](scarp::Contact<dim> const& contact) {
      Tensor<dim> const spring = sliding.spring(contact, law);
      for (int j = 0; j < dim; ++j) {
        for (int l = 0; l < dim; ++l)
          sum.template block<dim, dim>(dim * j, dim * l) += contact.branch(j) * contact.branch(l) * spring;
      }
    });
    return scarp::to_voigt_tangent<dim>(sum / packing.volume());
  }
};

inline double min_eigenvalue(VoigtTangent<2> const& tangent) {
  return eigenvalues((tangent + tangent.transpose()) / 2.0)(0);
}

/// Analytic: a quarter turn exchanges x and y and changes the sign of shear, C' = P C P.
template <class Tangent, class PackingType>
void check_quarter_turn(Tangent const& tangent, PackingType const& packing, typename PackingType::Law const& law,
                        double tolerance) {
  VoigtTangent<2> exchange;
  exchange << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  VoigtTangent<2> const here = tangent(packing, law);
  VoigtTangent<2> const there = tangent(turned(packing, 3.141592653589793 / 2.0), law);
  CHECK((there - exchange * here * exchange).norm() < tolerance * here.norm());
  CHECK((there - here).norm() > 10.0 * tolerance * here.norm());  // otherwise there is nothing to turn
}

template <class Tangent, class PackingType>
void check_purity(Tangent const& tangent, PackingType const& packing, typename PackingType::Law const& law) {
  PackingType const before = packing;
  VoigtTangent<2> const first = tangent(packing, law);
  CHECK(packing == before);
  CHECK(tangent(packing, law) == first);  // nothing is remembered from call to call
}

}  // namespace samples
