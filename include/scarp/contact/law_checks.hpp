// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstddef>

#include "scarp/contact/contact_law.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Rejects a law whose parameters its own validate() rejects, or whose members contradict each other, which compiles
/// but gives wrong forces: a stiffness against a motion, a radius or a scalar that `inputs` does not name, a force
/// across a gap without interaction_range(), a dashpot without damping_ratio(). An interaction range of more than the
/// grain's diameter is rejected too: pairs with others between them would act on each other, and the cell would have to
/// be wider still.
/// radius [m]: of a grain, for the size of overlap and gap that are tried, 1e-6 of it
/// \throws InputError
template <ContactLaw Law>
void require_consistent(Law const& law, double radius) {
  detail::validated(law);
  if constexpr (requires { law.laws; }) {
    for_each_law(law, [&](auto const& one) { require_consistent(one, radius); });
    return;
  }
  double const reach = interaction_range_of(law);
  if (!(reach >= 0.0 && reach <= 2.0 * radius)) {
    reject(
        "the contact law acts across gaps of up to {} m (grains of a diameter of {} m have others between them there): "
        "give "
        "less strength, or stiffer springs",
        reach, 2.0 * radius);
  }
  double const depth = 1e-6 * radius;
  ContactStiffness const stiffness = law.stiffness(depth, radius / 2.0);
  if (!Law::inputs.shear && stiffness.tangential != 0.0) {
    reject(
        "the contact law has a tangential stiffness of {} N/m (its inputs do not name .shear, so no shear force would "
        "act): add `.shear = true` to its inputs, or give no tangential stiffness",
        stiffness.tangential);
  }
  if (!Law::inputs.moment && stiffness.rolling != 0.0) {
    reject(
        "the contact law has a rolling stiffness of {} N m/rad (its inputs do not name .moment, so no moment would "
        "act): add `.moment = true` to its inputs, or give no rolling stiffness",
        stiffness.rolling);
  }
  ContactMemory<2, double> memory;
  auto const require_remembered = [&] {
    for (std::size_t k = detail::index(Law::inputs.scalars); k < memory.scalars.size(); ++k) {
      if (memory.scalars[k] != 0.0)
        reject(
            "the contact law writes the scalar {} of a contact (its inputs name .scalars = {}, so it would be "
            "forgotten): name as many as it uses",
            k, Law::inputs.scalars);
    }
  };
  double reduced_radius = radius / 2.0;
  auto const forces = [&](double overlap, double closing, double sliding = 0.0, double slip = 0.0) {
    memory = {};
    if constexpr (Bonds<Law>) {
      if (overlap < 0.0) Law::bond(memory);
      require_remembered();
    }
    ContactKinematics<2, double> const approach{.overlap = overlap,
                                                .slip_increment = slip,
                                                .reduced_radius = reduced_radius,
                                                .overlap_increment = closing,
                                                .tangential_increment = sliding,
                                                .reduced_mass = 1.0,
                                                .time_step = 1e-6,
                                                .species = {1.0, 1.0}};
    auto const found = law.respond(approach, memory);
    require_remembered();
    return found;
  };
  auto const still = forces(depth, 0.0);
  if (!std::isfinite(still.normal))
    reject("the contact law has a force of {} N at an overlap of {} m (a number is expected): check its parameters",
           still.normal, depth);
  auto const slid = forces(depth, 0.0, 0.0, depth);
  if constexpr (!Law::inputs.radius) {
    reduced_radius = 0.0;
    auto const without = forces(depth, 0.0, 0.0, depth);
    if (without.normal != slid.normal || without.shear != slid.shear)
      reject(
          "the contact law's force depends on the reduced radius (its inputs do not name .radius, so it would be "
          "zero): add `.radius = true` to its inputs");
    reduced_radius = radius / 2.0;
  }
  if (Law::inputs.motion && damping_ratio_of(law) == 0.0 &&
      (forces(depth, 1e-3 * depth).normal != still.normal || forces(depth, 0.0, 1e-3 * depth).shear != still.shear)) {
    reject(
        "the contact law's force depends on how fast the contact closes or slides (it has no damping_ratio(), or one "
        "of 0, so the time step would be that of its springs alone): give it `double damping_ratio() const`, the share "
        "of critical damping that its dashpots reach");
  }
  double const gap = reach + depth;
  double const force = forces(-gap, 0.0).normal;
  if (force != 0.0) {
    reject(
        "the contact law has a force of {} N across a gap of {} m (its interaction_range() is {} m, so pairs that far "
        "apart would be left out): give it as far as the force reaches, or no force beyond it",
        force, gap, reach);
  }
}

}  // namespace scarp
