// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/dem/critical_step.hpp"
#include "scarp/dem/local_damping.hpp"
#include "scarp/dem/neighbour_list.hpp"
#include "scarp/dem/pair_loop.hpp"

namespace scarp {

/// What a step can tell of the packing it moved.
template <int Dim>
struct StepObservation {
  Tensor<Dim> stress = Tensor<Dim>::Zero();  ///< Love and Weber [Pa], tension positive
  double contacts = 0.0;
  double unbalanced_ratio = 0.0;  ///< mean net force of a grain over mean contact force
};

/// Moves a packing explicitly (leap-frog) while its cell follows a velocity gradient. Holds the scratch memory, so one
/// stepper serves many packings in turn but only one thread.
template <class PackingType, class Damping = LocalDamping>
class TimeStepper {
 public:
  static constexpr int dim = PackingType::dim;
  using Shape = typename PackingType::Shape;
  using Law = typename PackingType::Law;
  using Scalar = typename PackingType::Scalar;
  using Lanes = Pack<Scalar>;

  Damping damping{};
  /// Gap up to which pairs are listed, as a share of the largest radius: a wider skin lists more pairs, a thinner one is
  /// rebuilt more often.
  double skin_ratio = 0.1;

  /// Share of the packing's critical step that is used as the time step. The critical step is a lower bound, 1.4 to 1.6
  /// times below the limit where packings of ellipses were seen to blow up.
  double time_step_share = 1.0;

  /// Makes the pair list where there is none or it has become too old, and the critical step with it.
  Verdict refresh(PackingType& packing, Law const& law) const {
    if (packing.pairs.drift <= packing.pairs.skin) return {};  // false also when the drift is no number
    Verdict const verdict = rebuild_pairs(packing, skin_ratio * packing.population->largest_radius());
    if (verdict.acceptable()) packing.pairs.critical_step = critical_step(packing, law);
    return verdict;
  }

  /// One time step while the cell follows the displacement gradient `strain_step` (velocity gradient x time step).
  /// With `Observe`, `observed` receives the state before the move.
  template <bool Observe = false>
  Verdict step(PackingType& packing, Law const& law, Tensor<dim> const& strain_step,
               StepObservation<dim>* observed = nullptr) {
    if (Verdict const verdict = refresh(packing, law); !verdict.acceptable()) return verdict;
    double const time_step = time_step_share * packing.pairs.critical_step;
    ContactSums<dim> const sums = pair_forces<Observe>(packing, law, strain_step, time_step, scratch_);
    if constexpr (Observe) *observed = observe(packing, sums);
    Tensor<dim> const cell_step = exponential(strain_step);
    move_grains(packing, cell_step, time_step, (strain_step(1, 0) - strain_step(0, 1)) / 2.0);
    packing.cell = (cell_step * packing.cell).eval();
    packing.pairs.drift += strain_step.norm() * (2.0 * packing.population->largest_radius() + packing.pairs.skin);
    return {};
  }

  /// Stress and balance of the packing as it stands; no grain moves, but remembered normals and
  /// shear limits are brought up to date and an old pair list is renewed.
  Verdict observe(PackingType& packing, Law const& law, StepObservation<dim>& observed) {
    if (Verdict const verdict = refresh(packing, law); !verdict.acceptable()) return verdict;
    observed = observe(packing, pair_forces<true>(packing, law, Tensor<dim>::Zero(), 0.0, scratch_));
    return {};
  }

 private:
  StepObservation<dim> observe(PackingType const& packing, ContactSums<dim> const& sums) const {
    StepObservation<dim> seen{sums.stress(packing.volume()), sums.contacts, 0.0};
    if (sums.contacts == 0.0) return seen;
    double unbalanced = 0.0;
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      Scalar const* const net = scratch_.forces.data() + i * PairScratch<Shape, Scalar>::force_size;
      double squared = 0.0;
      for (std::size_t a = 0; a < dim; ++a) squared += static_cast<double>(net[a]) * static_cast<double>(net[a]);
      unbalanced += std::sqrt(squared);
    }
    seen.unbalanced_ratio = (unbalanced / static_cast<double>(packing.grain_count())) / (sums.force / sums.contacts);
    return seen;
  }

  /// Taylor series to fourth order: exact to round-off for the strains of one time step.
  static Tensor<dim> exponential(Tensor<dim> const& small) {
    Tensor<dim> const identity = Tensor<dim>::Identity();
    return identity + small * (identity + small * (identity + small * (identity + small / 4.0) / 3.0) / 2.0);
  }

  void move_grains(PackingType& packing, Tensor<dim> const& cell_step, double time_step, double affine_turn) {
    constexpr std::size_t width = Lanes::size();
    constexpr std::size_t force_size = PairScratch<Shape, Scalar>::force_size;
    auto const& population = *packing.population;
    Lanes const dt(static_cast<Scalar>(time_step));
    Lanes fastest(Scalar(0));
    Lanes fastest_spin(Scalar(0));
    std::size_t const grains = packing.grain_count();
    std::size_t const padded = packing.position.padded_rows();
    scratch_.forces.resize(std::max(scratch_.forces.size(), padded * force_size));
    for (std::size_t i = grains; i < padded; ++i) {
      for (std::size_t k = 0; k < force_size; ++k) scratch_.forces[i * force_size + k] = Scalar(0);
    }
    for (std::size_t start = 0; start < padded; start += width) {
      Lanes const inverse_mass = load(population.inverse_mass() + start);
      Lanes const inverse_inertia = load(population.inverse_inertia() + start);
      auto const force =
          load_quads<Scalar>([&](std::size_t lane) { return scratch_.forces.data() + (start + lane) * force_size; });
      Point<dim, Lanes> place;
      for (int a = 0; a < dim; ++a) place[static_cast<std::size_t>(a)] = load(packing.position.column(a) + start);
      Lanes speed(Scalar(0));
      for (int a = 0; a < dim; ++a) {
        Lanes velocity = load(packing.velocity.column(a) + start);
        velocity = damping.next_velocity(velocity, force[static_cast<std::size_t>(a)], inverse_mass * dt);
        store(velocity, packing.velocity.column(a) + start);
        speed += velocity * velocity;
        Lanes moved = velocity * dt;
        for (int b = 0; b < dim; ++b) {
          moved += Lanes(static_cast<Scalar>(cell_step(a, b))) * place[static_cast<std::size_t>(b)];
        }
        store(moved, packing.position.column(a) + start);
      }
      Lanes spin = load(packing.spin.column(0) + start);
      spin = damping.next_velocity(spin, force[dim], inverse_inertia * dt);
      store(spin, packing.spin.column(0) + start);
      if constexpr (Shape::orientation_count == 2) {
        // Cayley's rotation keeps (cos, sin) a unit vector to round-off.
        Lanes const half = (spin * dt + Lanes(static_cast<Scalar>(affine_turn))) * Lanes(Scalar(0.5));
        Lanes const scale = Lanes(Scalar(1)) / (Lanes(Scalar(1)) + half * half);
        Lanes const c = (Lanes(Scalar(1)) - half * half) * scale;
        Lanes const s = Lanes(Scalar(2)) * half * scale;
        Lanes const x = load(packing.orientation.column(0) + start);
        Lanes const y = load(packing.orientation.column(1) + start);
        store(x * c - y * s, packing.orientation.column(0) + start);
        store(x * s + y * c, packing.orientation.column(1) + start);
      }
      using std::experimental::max;
      fastest = max(fastest, speed);
      fastest_spin = max(fastest_spin, spin * spin);
    }
    double const speed = std::sqrt(static_cast<double>(hmax(fastest)));
    double const spin = std::sqrt(static_cast<double>(hmax(fastest_spin)));
    packing.pairs.drift += 2.0 * time_step * (speed + spin * population.largest_eccentricity());
  }

  PairScratch<Shape, Scalar> scratch_;
};

}  // namespace scarp
