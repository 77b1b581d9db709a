// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "mean_curve.hpp"
#include "preparation.hpp"
#include "scarp/homogenise/balance.hpp"
#include "specimen.hpp"

namespace rve_lab {

/// \throws InputError for a packing that cannot follow the path
template <class PackingType>
Curve tested(PackingType packing, typename PackingType::Law const& law, CurveTest const& test,
             PathKindIn<PackingType::dim> const& path) {
  auto const [steps_per_row, strain_step] = EvenSteps::of(test.row_strain, test.strain_step, 2);
  Specimen<PackingType, scarp::Observe::balance> lab(std::move(packing), law, path, strain_step, test.held);
  Curve curve;
  curve.void_ratio = lab.packing().void_ratio();
  curve.add(scarp::balance(lab.packing(), law).stress, lab.deformation());
  double const middle_of_row = static_cast<double>(steps_per_row / 2) * strain_step;
  auto const rows = static_cast<long>(  // the last middle is beyond the strain
      std::ceil((test.strain - middle_of_row) / test.row_strain + 1.0 - 1e-9));
  scarp::Tensor<PackingType::dim> sum = scarp::Tensor<PackingType::dim>::Zero();
  auto middle = lab.deformation();
  // A path that prescribes another strain goes on to the axial one. Curves of several seeds are cut to the shortest,
  // where those that dilate more lag behind: by a tenth with 60 grains, hence the margin.
  constexpr double margin = 1.25;
  bool const axial = path.strain == axial_strain<PackingType::dim>;
  auto const ends_early = [&] { return !axial && axial_strain(middle) < margin * test.strain; };
  for (long row = 0; row < rows || (ends_early() && row < 3 * rows); ++row) {
    for (long step = 0; step < steps_per_row; ++step) {
      if (step == steps_per_row / 2) middle = lab.deformation();  // seen() is before the move
      if (auto const verdict = lab.step(); !verdict.acceptable())
        scarp::reject("a packing ended with {} at strain {:.4g}: take a smaller --strain-step, or another stress",
                      scarp::name(verdict.reason), path.strain(lab.deformation()));
      sum += lab.seen().stress / static_cast<double>(steps_per_row);
    }
    curve.add(sum, middle);
    sum.setZero();
  }
  return curve;
}

/// As curve_of, of the kinds of grains that are built.
template <class BuiltGrains, class PathKind>
Curve curve_of_built(BuiltGrains grains, Sand const& sand, CurveTest const& test, PathKind const& path) {
  Curve curve;
  with_packing(grains, sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    double isotropic_void_ratio = 0.0;
    curve = tested(Preparation<PackingType>::nearest(sand, law, isotropic_void_ratio), law, test, path);
    curve.isotropic_void_ratio = isotropic_void_ratio;
  });
  return curve;
}

}  // namespace rve_lab
