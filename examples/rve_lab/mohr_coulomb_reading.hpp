// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laboratory_results.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"

namespace rve_lab {

/// Mohr-Coulomb parameters read from a drained test without cohesion: peak friction and dilation, Young's modulus and
/// Poisson's ratio of the secant to half of the peak, the ratio within 0 and 0.49 and the dilation from 0 to the
/// friction. Their own drained test has the peak and E50 of the curve; it is straight where the curve bends, and stays
/// at the peak where the curve softens.
/// \throws InputError for a test without friction, with tension or without a secant, and for one whose stress ratio
/// rises to its end, as that of elastic material
template <int Dim>
scarp::MohrCoulomb<Dim> mohr_coulomb_of(LaboratoryResults<Dim> const& results) {
  double const friction = results.peak.friction();
  if (!(friction > 0.0))
    scarp::reject("the test mobilises no friction (a strength is read from it): shear material that has one");
  if (!(friction < std::numbers::pi / 2.0))
    scarp::reject("the minor principal stress becomes tension (no friction angle carries it): test under compression");
  if (std::isnan(results.secant_modulus))
    scarp::reject(
        "q does not rise through the half of its largest change (no secant modulus can be read): begin the test before "
        "it is sheared");
  if (results.rises)
    scarp::reject(
        "the stress ratio rises to the end of the test, to a friction angle of {:.1f} degrees (a strength is read "
        "where it no "
        "longer rises): go to a larger strain; elastic material has no strength",
        friction * 180.0 / std::numbers::pi);
  double const poisson = std::clamp(results.poisson(), 0.0, 0.49);
  double const young = Dim == 2 ? results.secant_modulus * (1.0 - poisson * poisson) : results.secant_modulus;
  scarp::MohrCoulomb<Dim> const soil{
      scarp::IsotropicElasticity::from_young_poisson(young, poisson),
      {{.friction = friction, .dilation = std::clamp(results.peak_dilation, 0.0, friction)}},
      {}};
  soil.validate();
  return soil;
}

}  // namespace rve_lab
