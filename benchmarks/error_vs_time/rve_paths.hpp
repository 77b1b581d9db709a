// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "rve_packings.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "scarp/run/resources.hpp"
#include "sweep_table.hpp"

namespace error_vs_time {

/// Knobs of one packing under a path; the defaults are those of scarp::DemRve.
struct RveSettings {
  double strain_per_step = 1e-5;
  double settling = 0.0;          ///< share of the steps spent without strain before each sample
  double averaging_window = 0.0;  ///< strain around a sample over which stress is averaged; 0: as it stands there
  double damping = 0.2;
  double time_step_share = scarp::default_time_step_share;
  double response_steps = 10.0;  ///< of the servo
  int grains = 400;
};

/// A test of the laboratory, sampled `samples` times.
struct Path {
  std::function<scarp::Loading<2>(double rate)> loading;
  double strain = 0.0;
  int samples = 0;
  bool volume_is_free = true;  ///< else the ratio of lateral to axial stress is reported instead of the dilation
};

/// What a path leaves behind at its samples.
class Samples {
 public:
  explicit Samples(Path const& path)
      : path_(path), stress_(3 * path.samples), fabric_(2 * path.samples), other_(path.samples) {
    stress_.setZero();
  }

  void add_stress(int sample, scarp::Tensor<2> const& stress, double weight) {
    stress_.segment<3>(3 * sample) += weight * scarp::to_voigt_stress<2>(stress);
  }

  template <class PackingType>
  void look(int sample, PackingType const& packing, typename PackingType::Law const& law, double first_area) {
    auto const fabric = scarp::fabric_deviator(scarp::contact_network(packing, law).fabric);
    fabric_.segment<2>(2 * sample) << fabric(0, 0), fabric(0, 1);
    other_(sample) = -std::log(packing.cell.determinant() / first_area);
  }

  void report(Measured& measured) {
    if (!path_.volume_is_free) {
      for (int k = 0; k < path_.samples; ++k) other_(k) = stress_(3 * k) / stress_(3 * k + 1);
    }
    measured.add("stress", stress_);
    measured.add(path_.volume_is_free ? "dilation" : "K0", other_);
    measured.add("fabric", fabric_);
  }

 private:
  Path const& path_;
  Eigen::VectorXd stress_;
  Eigen::VectorXd fabric_;
  Eigen::VectorXd other_;
};

/// The last steps of an interval between two samples stand still (settling); their rate makes up for it.
template <class PackingType, class Damping>
Measured walk(PackingType packing, typename PackingType::Law const& law, Damping const& damping,
              RveSettings const& settings, Path const& path) {
  scarp::CpuTime const clock;
  Measured measured;
  scarp::TimeStepper<PackingType, Damping> stepper;
  stepper.damping = damping;
  stepper.time_step_share = settings.time_step_share;
  double const interval = path.strain / path.samples;
  long const steps = std::lround(interval / settings.strain_per_step);
  long const settled = std::lround(settings.settling * static_cast<double>(steps));
  double const rate = interval / static_cast<double>(steps - settled);
  auto const loading = path.loading(rate);
  auto still = loading;
  still.gradient_per_step.setZero();
  scarp::CellDriver<PackingType> drive(packing, law, loading, {.response_steps = settings.response_steps});
  Samples samples(path);
  double const first_area = packing.cell.determinant();
  // At most the whole interval, so that no step belongs to two samples.
  long const half_window = std::min(std::lround(0.5 * settings.averaging_window / rate), (steps - 1) / 2);
  double const weight = 1.0 / static_cast<double>(2 * half_window + 1);
  long const all = steps * path.samples + half_window + 1;
  for (long step = 0; step < all; ++step) {
    // Before its move the packing has made `step` steps.
    long const nearest = (step + steps / 2) / steps;
    if (step == nearest * steps && nearest > 0 && nearest <= path.samples) {
      samples.look(static_cast<int>(nearest - 1), packing, law, first_area);
    }
    if (step % steps == 0) drive.load(loading);
    if (step % steps == steps - settled) drive.load(still);
    if (measured.verdict = drive.step(stepper); !measured.verdict.acceptable()) return measured;
    if (nearest > 0 && nearest <= path.samples && std::abs(step - nearest * steps) <= half_window) {
      samples.add_stress(static_cast<int>(nearest - 1), drive.seen().stress, weight);
    }
  }
  measured.seconds = clock.seconds();
  measured.inner_steps = all;
  samples.report(measured);
  return measured;
}

}  // namespace error_vs_time
