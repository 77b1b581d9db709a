// SPDX-License-Identifier: BSL-1.0
// A packing as a point on a laboratory path, against the same packing whose cell a servo drives.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "scarp/dem/drive.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/points/laboratory_paths.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "support/packings.hpp"

namespace {

using samples::Ellipses;
using Rve = scarp::DemRve<Ellipses, scarp::SamePacking<Ellipses>>;

constexpr double rate = 2e-6;  // axial strain of a DEM step
constexpr double end = 0.01;
constexpr double row = 2e-3;

struct Curve {
  std::vector<double> axial, volume;  // stress [Pa] and strain, compression positive
};

Ellipses const& packing() { return samples::consolidated<Ellipses>(200).packing; }

Curve servo() {
  Ellipses grains = packing();
  scarp::TimeStepper<Ellipses> stepper;
  auto const law = samples::study_law();
  scarp::CellDriver<Ellipses> drive(grains, law, scarp::drained_compression<2>(rate, samples::pressure));
  double const start = grains.cell.determinant();
  Curve curve;
  long const steps_per_row = std::lround(row / rate);
  for (long step = 1; step <= std::lround(end / rate); ++step) {
    REQUIRE(drive.step(stepper).acceptable());
    if (step % steps_per_row != 0) continue;
    curve.axial.push_back(-scarp::balance(grains, law).stress(1, 1));
    curve.volume.push_back(-std::log(grains.cell.determinant() / start));
  }
  return curve;
}

Curve points(double increment) {
  Rve const sand{.law = samples::study_law(), .source = {packing()}, .strain_per_step = rate};
  scarp::MaterialPoints<2> point(sand, std::array{scarp::Site<2>{}});
  scarp::PointPath<2> path(point, scarp::drained_path<2>(), {.tolerance = 1e-5});
  scarp::SerialExecutor serial;
  Curve curve;
  int iterations = 0, cuts = 0;
  for (double next = row; path.length() < end - 1e-9; next += row) {
    while (path.length() < next - 1e-9) {
      auto const report = path.advance(increment, serial);
      REQUIRE(report.verdict.acceptable());
      iterations += report.iterations;
      cuts += report.cut_backs;
    }
    curve.axial.push_back(-path.stress(0)(1));
    curve.volume.push_back(-path.strain(0).head<2>().sum());
  }
  std::printf("increment %g: iterations %d cuts %d\n", increment, iterations, cuts);
  return curve;
}

}  // namespace

TEST_CASE("drained compression of a packing: as its cell driven by a servo") {
  Curve const reference = servo();
  for (double const increment : {2e-3, 1e-3, 2.5e-4}) {
    auto const curve = points(increment);
    for (std::size_t k = 0; k < curve.axial.size(); ++k)
      std::printf("%10.1f %10.1f   %10.6f %10.6f\n", curve.axial[k], reference.axial[k], curve.volume[k],
                  reference.volume[k]);
  }
}
