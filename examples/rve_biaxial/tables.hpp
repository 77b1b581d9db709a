// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <vector>

#include "../shared/print.hpp"
#include "report.hpp"

namespace rve_biaxial {

inline void print_packings(std::vector<Result> const& results, double window) {
  examples::print(stdout, "{:>8} {:>8} {:>8} {:>8} {:>9} {:>9}   peaks through a window of {} axial strain\n",
                  "friction", "seed", "e", "Z", "phi_max", "psi_max", window);
  for (auto const& result : results) {
    auto const peak = peak_angles(result.rows, window);
    examples::print(stdout, "{:>8} {:>8} {:>8.4f} {:>8.3f} {:>9.2f} {:>9.2f}\n", result.preparation_friction,
                    result.seed, result.rows.front().void_ratio, result.rows.front().coordination, peak.friction_angle,
                    peak.dilation_angle);
  }
}

inline void print_friction(std::span<Result const> packings, std::vector<double> const& windows) {
  auto const spread = [&](auto const& measure) {
    auto const found = spread_over(packings, measure);
    return fmt::format("{:.4f} +- {:.4f}", found.mean, found.deviation);
  };
  examples::print(stdout, "\npreparation friction {}: e {}, Z {}\n", packings.front().preparation_friction,
                  spread([](Result const& r) { return r.rows.front().void_ratio; }),
                  spread([](Result const& r) { return r.rows.front().coordination; }));
  for (double const window : windows) {
    auto const [phi, psi] = peak_spreads(packings, window);
    if (!std::isfinite(phi.mean)) continue;  // the test is shorter than the window
    examples::print(stdout, "window {:<6} phi_max {:6.2f} +- {:.2f}   psi_max {:6.2f} +- {:.2f} degrees\n", window,
                    phi.mean, phi.deviation, psi.mean, psi.deviation);
  }
  auto const secant = spread_over(packings, [](Result const& r) { return secant_dilation_angle(r.rows); });
  if (std::isfinite(secant.mean)) {  // all tests went beyond its largest contraction
    examples::print(stdout, "secant from largest contraction to the end: psi {:.2f} +- {:.2f} degrees\n", secant.mean,
                    secant.deviation);
  }
  for (Moment const& moment : moments) {
    examples::print(stdout, "fabric at {:<5} contacts {}, grains {}\n", moment.name,
                    spread([&](Result const& r) { return moment.row(r).contact_fabric; }),
                    spread([&](Result const& r) { return moment.row(r).particle_fabric; }));
  }
  if (packings.size() > 1)
    examples::print(stdout, "stress of two packings apart, root mean square: {:.3f}\n", stress_scatter(packings));
}

inline void print_lines(std::vector<Result> const& results, std::vector<double> const& windows) {
  examples::print(stdout, "\nlines over the void ratio:\n");
  for (auto const& angle : all_angles(windows)) {
    auto const line = fit(results, angle);
    if (!line) continue;
    auto const place = line->meets(angle.study());
    examples::print(stdout,
                    "{:<10} {:<6} {:7.2f} {:+8.1f} e, packings +- {:.2f} degrees; meets the reference study's {} {}\n",
                    angle.name(), angle.window > 0.0 ? fmt::format("{}", angle.window) : "", line->at_zero, line->slope,
                    line->residual, angle.study(),
                    place ? fmt::format("at e {:.4f}", *place)
                          : fmt::format("nowhere in e {:.4f} to {:.4f}", line->least, line->most));
  }
}

inline void print_tables(std::vector<Result> const& results, double smoothing) {
  auto const windows = all_windows(smoothing);
  print_packings(results, smoothing);
  auto const groups = by_friction(results);
  for (auto const& packings : groups) print_friction(packings, windows);
  if (groups.size() > 1) print_lines(results, windows);
  examples::print(stdout, "\nthe study:  phi_max 30.8, psi_max 6.6 (e 0.160 to 0.179, window not stated)\n");
  examples::print(stdout, "SudoDEM:    phi_max 36.6 (e 0.153), 33.8 (e 0.173), window 0.005\n");
}

}  // namespace rve_biaxial
