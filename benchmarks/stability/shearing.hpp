// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <string>

#include "scarp/dem/loading.hpp"
#include "stability/stability_case.hpp"
#include "support/packings.hpp"

namespace stability {

/// Discs that are prepared at a pressure, relieved to another one, and compressed along one axis while the other
/// stress is held.
struct Shearing {
  scarp::LinearFrictional law{};
  int grains = 40;
  double prepared_at = 2e5;       ///< [Pa]
  double pressure = 2e5;          ///< [Pa]
  double strain_per_step = 1e-5;  ///< along the axis
  double strain = 0.02;
};

/// What came of it. `strength` is the mean over the second half of the path.
struct Sheared {
  scarp::Verdict verdict{};
  double strength =
      0.0;            ///< \f$ (\sigma_1 - \sigma_3)/(\sigma_1 + \sigma_3) \f$, the sin of the mobilised friction angle
  double held = 0.0;  ///< mean deviation of the held stress over its target
  double skew_share = 0.0;  ///< of the stress
  double overlap = 0.0;     ///< deepest, over the reduced radius
  double time_step = 0.0;   ///< [s]

  std::string words() const {
    return fmt::format(
        "{}{}{}, held stress within {:.1g}, time step {:.2g} s, deepest overlap {:.1g} of the reduced radius",
        name(verdict.status), verdict.acceptable() ? "" : " / ", verdict.acceptable() ? "" : name(verdict.reason), held,
        time_step, overlap);
  }
};

/// Brings a packing from one isotropic pressure to a smaller one, a tenth at a time. The cell's fastest strain
/// follows the strain of the springs: at once, grains would fly apart.
template <class PackingType>
scarp::Verdict relieve(PackingType& packing, typename PackingType::Law const& law, double from, double to,
                       long max_steps = 50'000) {
  scarp::TimeStepper<PackingType> stepper;
  double const modulus = scarp::spring_modulus(packing, law);
  while (from > to) {
    from = std::max(0.1 * from, to);
    scarp::Servo const servo{.feedback = {.fastest = 0.1 * from / modulus},
                             .stress_tolerance = 1e-2,
                             .unbalanced_tolerance = 1e-2,
                             .max_steps = max_steps};
    scarp::VoigtStress<PackingType::dim> target = scarp::VoigtStress<PackingType::dim>::Zero();
    target.template head<PackingType::dim>().setConstant(-from);
    if (auto const verdict = servo.reach(stepper, packing, law, scarp::Loading<PackingType::dim>::stress(target));
        !verdict.acceptable())
      return verdict;
  }
  return {};
}

template <class Grains = samples::Discs>
Sheared prepared_and_sheared(Shearing const& path) {
  using scarp::Tensor;
  auto [packing, verdict] = scarp::IsotropicPreparation{.pressure = path.prepared_at}.prepare(
      samples::loose_cloud<Grains>(path.grains, 3), path.law);
  Sheared end{.verdict = verdict, .time_step = scarp::default_time_step_share * packing.pairs.critical_step};
  if (verdict.acceptable()) end.verdict = relieve(packing, path.law, path.prepared_at, path.pressure);
  if (!end.verdict.acceptable()) return end;
  scarp::TimeStepper<Grains> stepper;
  scarp::CellDriver<Grains> drive(packing, path.law,
                                  scarp::drained_compression<2>(path.strain_per_step, path.pressure));
  long const steps = std::lround(path.strain / path.strain_per_step);
  Tensor<2> mean = Tensor<2>::Zero();
  for (long step = 0; step < steps; ++step) {
    end.verdict = drive.step(stepper);
    if (!end.verdict.acceptable()) return end;
    auto const& seen = drive.seen();
    if (2 * step >= steps) mean += seen.stress / (0.5 * static_cast<double>(steps) * path.pressure);
    end.held += std::abs(seen.stress(0, 0) / path.pressure + 1.0) / static_cast<double>(steps);
    end.overlap = std::max(end.overlap, seen.deepest_overlap);
  }
  double const shear = 0.5 * (mean(0, 1) + mean(1, 0));
  double const pressure = -0.5 * mean.trace();
  end.strength = std::hypot(0.5 * (mean(0, 0) - mean(1, 1)), shear) / pressure;
  end.skew_share = std::abs(mean(0, 1) - mean(1, 0)) / pressure;
  end.time_step = scarp::default_time_step_share * packing.pairs.critical_step;
  return end;
}

}  // namespace stability
