// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stdexcept>
#include <vector>

#include "scarp/contact/law_checks.hpp"
#include "scarp/dem/drive.hpp"

namespace scarp {

/// A packing could not be brought to where it is needed.
class PreparationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A packing and whether it got where it was to go.
/// \tparam PackingType a `Packing`
template <class PackingType>
struct Prepared {
  PackingType packing;  ///< as far as it got
  Verdict verdict;      ///< acceptable where its targets are met
};

/// From a loose cloud to a packing under isotropic pressure: consolidation at a *preparation friction*, the knob of the
/// density, then relaxation at the law's own friction. The cell may tilt, so that no shear stress is left.
struct IsotropicPreparation {
  double pressure = 0.0;              ///< [Pa], positive
  double preparation_friction = 0.1;  ///< of all contacts; 0 gives the densest packing
  Servo consolidation{.stress_tolerance = 1e-3, .unbalanced_tolerance = 1e-3};  ///< at the preparation friction
  Servo relaxation{};                                                           ///< at the law's own friction

  /// \throws InputError
  void validate() const {
    require_positive("pressure of the preparation", pressure);
    require_not_negative("preparation friction", preparation_friction);
    consolidation.validate();
    relaxation.validate();
  }

  /// Brings a cloud to isotropic pressure and to rest, first at the preparation friction, then at that of the law.
  /// \throws InputError for parameters that validate() rejects or a law that contradicts itself
  template <class PackingType, DampsMotion Damping = LocalDamping, ConstrainsGrains<PackingType> Boundary = Periodic>
  Prepared<PackingType> prepare(PackingType cloud, typename PackingType::Law law, Damping const& damping = {},
                                Boundary const& boundary = {}) const {
    validate();
    require_population(cloud);
    require_consistent(law, cloud.population->largest_radius());
    constexpr int dim = PackingType::dim;
    VoigtStress<dim> target = VoigtStress<dim>::Zero();
    target.template head<dim>().setConstant(-pressure);
    auto const loading = Loading<dim>::stress(target);
    TimeStepper<PackingType, Damping, Boundary> stepper;
    stepper.damping = damping;
    stepper.boundary = boundary;
    auto prepared_by = law;
    for_each_friction(prepared_by, [&](double& friction) { friction = preparation_friction; });
    Verdict verdict = consolidation.reach(stepper, cloud, prepared_by, loading);
    if (verdict.acceptable()) verdict = relaxation.reach(stepper, cloud, law, loading);
    if (Verdict const stopped = stepper.stop(cloud, law); verdict.acceptable()) verdict = stopped;
    return {std::move(cloud), verdict};
  }
};

/// One-dimensional compression of one packing, as under the growing overburden of level ground: lateral strain zero,
/// shear stress zero, vertical stress (last axis) through a list of targets. A copy is stored at each.
struct OneDimensionalCompression {
  /// How each target is approached and what counts as reached.
  Servo servo{.feedback = {.fastest = 1e-5}, .stress_tolerance = 1e-3, .unbalanced_tolerance = 1e-4};

  /// vertical_pressures [Pa], positive, in the order of the path: one below the pressure before it unloads
  /// \return one packing per pressure; the list ends early at one whose verdict is not acceptable
  /// \throws InputError for a pressure that is not finite and positive
  template <class PackingType, DampsMotion Damping = LocalDamping, ConstrainsGrains<PackingType> Boundary = Periodic>
  std::vector<Prepared<PackingType>> compress(PackingType packing, typename PackingType::Law const& law,
                                              std::vector<double> const& vertical_pressures,
                                              Damping const& damping = {}, Boundary const& boundary = {}) const {
    constexpr int dim = PackingType::dim;
    Loading<dim> loading;
    for (int k = dim - 1; k < voigt_size<dim>; ++k) loading.controls.push_back(component_control<dim>(k, 0.0));
    TimeStepper<PackingType, Damping, Boundary> stepper;
    stepper.damping = damping;
    stepper.boundary = boundary;
    std::vector<Prepared<PackingType>> column;
    for (double const pressure : vertical_pressures) {
      loading.controls.front().target = -require_positive("vertical pressure", pressure);
      Verdict verdict = servo.reach(stepper, packing, law, loading);
      if (Verdict const stopped = stepper.stop(packing, law); verdict.acceptable()) verdict = stopped;
      column.push_back({packing, verdict});
      if (!verdict.acceptable()) break;
    }
    return column;
  }
};

}  // namespace scarp
