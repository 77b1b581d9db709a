// SPDX-License-Identifier: BSL-1.0
#include "../../examples/shared/energy_ledger.hpp"

#include <doctest/doctest.h>

#include "../../examples/shared/laboratory_loadings.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/shape/sphere.hpp"
#include "support/packings.hpp"

namespace {

using examples::EnergyLedger;
using scarp::Loading;
using scarp::Observe;

using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;

/// The ledger of `steps` steps under a loading.
template <class PackingType>
EnergyLedger<PackingType::dim> ledger_of(PackingType packing, scarp::LinearFrictional const& law,
                                         Loading<PackingType::dim> const& loading, int steps) {
  scarp::TimeStepper<PackingType> stepper;
  scarp::CellDriver<PackingType, Observe::energy> drive(packing, law, loading);
  EnergyLedger<PackingType::dim> ledger;
  for (int step = 0; step < steps; ++step) {
    double const volume = packing.volume();
    REQUIRE(drive.step(stepper).acceptable());
    ledger.enter(drive.seen(), volume, drive.strain_step());
  }
  return ledger;
}

/// Every part of the balance is there, and the balance closes: rates are integrated with the mean of two steps, whose
/// error is of second order in a step's motion; 1e-3 of the work is far above that and far below any part that could be
/// missing.
template <int Dim>
void check_closed(EnergyLedger<Dim> const& ledger) {
  CHECK(ledger.work_in > 0.0);
  CHECK(ledger.stored > 0.0);
  CHECK(ledger.contact_loss > 0.02 * ledger.work_in);
  CHECK(ledger.damping_loss > 0.0);
  CHECK(std::abs(ledger.gap()) < 1e-3 * ledger.work_in);
}

}  // namespace

TEST_CASE_TEMPLATE("the energy of a sheared plane packing is accounted for", PackingType, samples::Discs,
                   samples::Ellipses) {
  auto const& packing = samples::consolidated<PackingType>(80).packing;
  check_closed(ledger_of(packing, samples::study_law(), scarp::drained_compression<2>(1e-5, samples::pressure), 2000));
  check_closed(ledger_of(packing, samples::study_law(), examples::simple_shear<2>(1e-5), 2000));
}

TEST_CASE("the balance closes over reversals, whose steps belong to the motion before them") {
  auto packing = samples::consolidated<samples::Ellipses>(80).packing;
  scarp::TimeStepper<samples::Ellipses> stepper;
  scarp::CellDriver<samples::Ellipses, Observe::energy> drive(packing, samples::study_law(),
                                                              examples::simple_shear<2>(1e-5));
  EnergyLedger<2> ledger;
  for (int step = 0; step < 2000; ++step) {
    if (step % 20 == 10) drive.load(drive.loading().reversed());
    double const volume = packing.volume();
    REQUIRE(drive.step(stepper).acceptable());
    ledger.enter(drive.seen(), volume, drive.strain_step());
  }
  // A hundred reversals: with the slip of one step counted the wrong way round at each, the gap is of the work's own
  // size.
  CHECK(std::abs(ledger.gap()) < 0.01 * ledger.work_in);
  MESSAGE("gap " << ledger.gap() << " of work " << ledger.work_in);
}

TEST_CASE("the energy of sheared spheres is accounted for") {
  scarp::LinearFrictional const law{.normal_stiffness = 1e6, .tangential_stiffness = 4e5, .friction = 0.3};
  scarp::Cloud<scarp::SphereGrading> const cloud{
      .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = 100, .density = 2650.0, .seed = 1};
  scarp::IsotropicPreparation const preparation{.pressure = 1e5};
  auto const prepared = preparation.prepare(cloud.make<Spheres>(), law);
  REQUIRE(prepared.verdict.acceptable());
  check_closed(ledger_of(prepared.packing, law, scarp::drained_compression<3>(1e-5, 1e5), 2000));
}
