// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>

#include "scarp/core/index.hpp"
#include "scarp/simd/pack.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// What the pair loop adds up along the way: nothing, what stress and balance need, or the energies as well.
enum class Observe { nothing, balance, energy };

/// Sums over the contacts of a packing.
template <int Dim>
struct ContactSums {
  Tensor<Dim> moment = Tensor<Dim>::Zero();  ///< force on the second grain (x) branch [N m]
  double force = 0.0;                        ///< |force| [N]
  double contacts = 0.0;                     ///< number that carry a normal force
  bool converged = true;                     ///< whether every contact normal converged
  double deepest = 0.0;                      ///< largest overlap over the reduced radius of its contact
  double stored = 0.0;                       ///< [J], only with Observe::energy
  double dissipated = 0.0;                   ///< during the step [J], only with Observe::energy

  /// Love and Weber's stress [Pa], tension positive, for a packing's volume [m3].
  Tensor<Dim> stress(double volume) const { return -moment / volume; }
};

/// What a step can observe of the packing it moved.
template <int Dim>
struct StepObservation {
  Tensor<Dim> stress = Tensor<Dim>::Zero();  ///< Love and Weber [Pa], tension positive
  double contacts = 0.0;                     ///< number that carry a normal force
  double unbalanced_ratio = 0.0;             ///< mean net force of a grain over mean contact force
  double deepest_overlap = 0.0;              ///< over the reduced radius of its contact

  // Only with Observe::energy, all in [J].
  double stored_energy = 0.0;  ///< in the contacts
  double contact_loss =
      0.0;  ///< in sliders and dashpots since the step before, but for what an observe() in between has seen
  double damping_loss = 0.0;    ///< in damping, during the move
  double kinetic_energy = 0.0;  ///< of fluctuations, mean of before and after the move
};

/// Observation of a packing from its contact sums and net forces, without the energies of a move.
template <class PackingType, class Forces>
StepObservation<PackingType::dim> observation(PackingType const& packing, ContactSums<PackingType::dim> const& sums,
                                              Forces const& forces) {
  StepObservation<PackingType::dim> seen{.stress = sums.stress(packing.volume()),
                                         .contacts = sums.contacts,
                                         .deepest_overlap = sums.deepest,
                                         .stored_energy = sums.stored,
                                         .contact_loss = sums.dissipated};
  if (sums.contacts == 0.0) return seen;
  double unbalanced = 0.0;
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    double squared = 0.0;
    for (int a = 0; a < PackingType::dim; ++a) {
      double const net = static_cast<double>(forces.force(i, a));
      squared += net * net;
    }
    unbalanced += std::sqrt(squared);
  }
  seen.unbalanced_ratio = (unbalanced / static_cast<double>(packing.grain_count())) / (sums.force / sums.contacts);
  return seen;
}

namespace detail {

template <class Lanes>
double lane_sum(Lanes const& values) {
  double sum = 0.0;
  for (std::size_t k = 0; k < Lanes::size(); ++k) sum += static_cast<double>(values[k]);
  return sum;
}

/// `ContactSums` lane by lane.
template <int Dim, class Lanes>
struct LaneSums {
  std::array<Lanes, static_cast<std::size_t>(Dim* Dim)> moment{};
  Lanes force{};
  Lanes contacts{};
  Lanes deepest{};
  Lanes stored{};
  Lanes dissipated{};

  ContactSums<Dim> total() const {
    ContactSums<Dim> sums;
    for (int a = 0; a < Dim; ++a) {
      for (int b = 0; b < Dim; ++b) sums.moment(a, b) = lane_sum(moment[detail::index(a * Dim + b)]);
    }
    sums.force = lane_sum(force);
    sums.contacts = lane_sum(contacts);
    sums.deepest = static_cast<double>(hmax(deepest));
    sums.stored = lane_sum(stored);
    sums.dissipated = lane_sum(dissipated);
    return sums;
  }
};

}  // namespace detail

}  // namespace scarp
