// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <vector>

#include "scarp/dem/contacts.hpp"
#include "scarp/dem/observation.hpp"

namespace scarp {

/// Stress and equilibrium of a packing at rest, as a step would observe them but without the forces of dashpots; the
/// packing is not changed. After a step contacts lack the slip of that step: `TimeStepper::observe` has it. Love and
/// Weber's mean stress has f the force on the second grain and l the branch from first to second,
/// \f$ \sigma = -\frac1V \sum f \otimes l \f$.
template <class PackingType>
StepObservation<PackingType::dim> balance(PackingType const& packing, typename PackingType::Law const& law) {
  constexpr int dim = PackingType::dim;
  struct {
    std::vector<Vector<dim>> of_grain;
    double force(std::size_t grain, int axis) const { return of_grain[grain](axis); }
  } net{std::vector<Vector<dim>>(packing.grain_count(), Vector<dim>::Zero())};
  ContactSums<dim> sums;
  for_each_contact(packing, law, [&](Contact<dim> const& contact) {
    ++sums.contacts;
    sums.moment += contact.force * contact.branch.transpose();
    sums.force += contact.force.norm();
    sums.deepest = std::max(sums.deepest, contact.touch.overlap / contact.approach.reduced_radius);
    net.of_grain[contact.first] -= contact.force;
    net.of_grain[contact.second] += contact.force;
  });
  auto seen = observation(packing, sums, net);
  seen.stress.array() += 0.0;  // no negative zeros where nothing touches
  return seen;
}

/// The part of the stress that moving grains carry, \f$ -\frac1V \sum m\, v \otimes v \f$ with the fluctuation
/// velocities [Pa], tension positive. Apart from Love and Weber's, to which it is small in a quasi-static packing.
template <class PackingType>
Tensor<PackingType::dim> kinetic_stress(PackingType const& packing) {
  constexpr int dim = PackingType::dim;
  Tensor<dim> sum = Tensor<dim>::Zero();
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    Vector<dim> velocity;
    for (int a = 0; a < dim; ++a) velocity(a) = static_cast<double>(packing.velocity(i, a));
    sum -= velocity * velocity.transpose() / static_cast<double>(packing.population->inverse_mass()[i]);
  }
  return sum / packing.volume();
}

}  // namespace scarp
