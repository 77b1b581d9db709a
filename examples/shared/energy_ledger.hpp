// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/time_stepping.hpp"

namespace examples {

/// Where the work done on a packing goes. All energies [J] are changes since the first entry; the balance
/// work_in = stored + contact_loss + damping_loss + kinetic closes up to the error of the time steps.
template <int Dim>
struct EnergyLedger {
  double work_in = 0.0;       ///< \f$ \int V \sigma : D\,dt \f$ of the cell
  double stored = 0.0;        ///< elastic energy of the contacts
  double contact_loss = 0.0;  ///< in sliders and dashpots of the contacts
  double damping_loss = 0.0;  ///< in the damping of the scheme
  double kinetic = 0.0;       ///< of the fluctuations about the affine motion

  /// Work that no other entry accounts for [J]: the error of the time steps.
  double gap() const { return work_in - stored - contact_loss - damping_loss - kinetic; }

  /// One entry for each step in turn: what the step observed, with the cell's volume [m3] before its move and the
  /// displacement gradient of the move. Rates between two entries are their means.
  void enter(scarp::StepObservation<Dim> const& seen, double volume, scarp::Tensor<Dim> const& strain_step) {
    scarp::Tensor<Dim> const force = seen.stress * volume;
    if (begun_) {
      work_in += ((former_force_ + force) / 2.0).cwiseProduct(former_step_).sum();
      contact_loss += seen.contact_loss;
      damping_loss += (former_damping_ + seen.damping_loss) / 2.0;
    } else {
      first_stored_ = seen.stored_energy;
      first_kinetic_ = seen.kinetic_energy;
    }
    stored = seen.stored_energy - first_stored_;
    kinetic = seen.kinetic_energy - first_kinetic_;
    begun_ = true;
    former_force_ = force;
    former_step_ = (strain_step + strain_step.transpose()) / 2.0;
    former_damping_ = seen.damping_loss;
  }

 private:
  bool begun_ = false;
  scarp::Tensor<Dim> former_force_ = scarp::Tensor<Dim>::Zero();
  scarp::Tensor<Dim> former_step_ = scarp::Tensor<Dim>::Zero();
  double former_damping_ = 0.0;
  double first_stored_ = 0.0;
  double first_kinetic_ = 0.0;
};

}  // namespace examples
