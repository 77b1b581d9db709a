// SPDX-License-Identifier: BSL-1.0
// A packing as a point on a laboratory path, against the same packing whose cell a servo drives.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "scarp/dem/drive.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/points/laboratory_paths.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "support/packings.hpp"

namespace {

using samples::Ellipses;
using Rve = scarp::DemRve<Ellipses, scarp::SamePacking<Ellipses>>;

constexpr double end = 0.01;  // axial strain

struct End {
  double axial = 0.0;   // stress [Pa], compression positive
  double volume = 0.0;  // strain, contraction positive
};

Ellipses const& packing() { return samples::consolidated<Ellipses>(200).packing; }

/// rate: axial strain of a DEM step
End servo(double rate) {
  Ellipses grains = packing();
  scarp::TimeStepper<Ellipses> stepper;
  auto const law = samples::study_law();
  scarp::CellDriver<Ellipses> drive(grains, law, scarp::drained_compression<2>(rate, samples::pressure));
  double const start = grains.cell.determinant();
  for (long step = 0; step < std::lround(end / rate); ++step) REQUIRE(drive.step(stepper).acceptable());
  return {-scarp::balance(grains, law).stress(1, 1), -std::log(grains.cell.determinant() / start)};
}

End point(double rate, int increments) {
  Rve const sand{.law = samples::study_law(), .source = {packing()}, .strain_per_step = rate};
  scarp::MaterialPoints<2> points(sand, std::array{scarp::Site<2>{}});
  scarp::PointPath<2> path(points, scarp::drained_path<2>(), {.tolerance = 1e-5});
  scarp::SerialExecutor serial;
  for (int k = 0; k < increments; ++k) REQUIRE(path.advance(end / increments, serial).verdict.acceptable());
  CHECK(std::abs(path.stress(0)(0) + samples::pressure) < 1e-5 * std::abs(path.stress(0)(1)) + 10.0);
  return {-path.stress(0)(1), -path.strain(0).head<2>().sum()};
}

}  // namespace

TEST_CASE("drained compression of a packing: as its cell driven by a servo, the better the smaller the DEM steps") {
  auto const apart = [](double rate, int increments) {
    End const reference = servo(rate);
    End const found = point(rate, increments);
    double const stress = std::abs(found.axial / reference.axial - 1.0);
    double const volume = std::abs(found.volume - reference.volume);
    MESSAGE(rate << " a step, " << increments << " increments: stress " << stress << ", volume " << volume << " apart");
    return std::max(stress, volume);
  };
  // The servo lags behind the held stress by some steps, times the stiffness; increments hold it at their ends.
  double const coarse = apart(2e-5, 5);
  double const fine = apart(2e-6, 5);
  CHECK(fine < 0.25 * coarse);
  CHECK(fine < 2e-4);
  CHECK(apart(2e-6, 20) < 2e-4);
}
