// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "scarp/contact/law_checks.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/dem/boundary.hpp"
#include "scarp/dem/critical_step.hpp"
#include "scarp/dem/damping.hpp"
#include "scarp/dem/neighbour_list.hpp"
#include "scarp/dem/pair_loop.hpp"
#include "scarp/tensor/finite_strain.hpp"

namespace scarp {

namespace detail {

/// The kernel of a stepper in a library: `TimeStepper` of the same names. Defined by dem/detail/library_kernel.hpp.
template <class Stepper>
struct SCARP_EXPORT LibraryKernel {
  using PackingType = typename Stepper::PackingType;
  using Law = typename Stepper::Law;
  static constexpr int dim = PackingType::dim;

  static Verdict refresh(Stepper const& stepper, PackingType& packing, Law const& law);
  template <Observe what>
  static Verdict step(Stepper& stepper, PackingType& packing, Law const& law, Tensor<dim> const& strain_step,
                      StepObservation<dim>* observed);
  static Verdict observe(Stepper& stepper, PackingType& packing, Law const& law, StepObservation<dim>& observed);
};

template <class PackingType, class... Policies>
inline constexpr bool kernel_is_precompiled =
    is_precompiled<typename PackingType::Shape>&& is_precompiled<typename PackingType::Law>&&
        std::is_same_v<typename PackingType::Scalar, double> &&
    (... && is_precompiled<Policies>);

}  // namespace detail

/// Moves a packing explicitly (leap-frog) while its cell follows a velocity gradient; a damping or relaxation gives the
/// velocities, a boundary holds grains on the cell's motion. Holds the scratch memory, so one stepper serves many
/// packings in turn but only one thread.
/// \tparam PackingOf a `Packing`
/// \tparam Damping a `DampsMotion`, with the whole packing in view a `SeesAllGrains`
/// \tparam Boundary a `ConstrainsGrains`
template <class PackingOf, DampsMotion Damping = LocalDamping, ConstrainsGrains<PackingOf> Boundary = Periodic>
class TimeStepper {
  static_assert(SeesAllGrains<Damping, PackingOf> || !detail::names_before_move<Damping>,
                "scarp: before_move of a damping is never called: it needs (PackingType const& packing, "
                "NetForces<PackingType> const& forces, double time_step)");

 public:
  using PackingType = PackingOf;                ///< type of the packings that it moves
  static constexpr int dim = PackingType::dim;  ///< of the packing's space
  using Shape = typename PackingType::Shape;    ///< of the grains
  using Law = typename PackingType::Law;        ///< of the contacts
  using Scalar = typename PackingType::Scalar;  ///< of coordinates and velocities
  using Lanes = lanes::Pack<Scalar>;            ///< as many numbers as a register holds

  Damping damping{};                          ///< what gives the velocities
  [[no_unique_address]] Boundary boundary{};  ///< what holds grains
  /// Gap up to which pairs are listed, as a share of the largest radius: a wider skin lists more pairs, a thinner one
  /// is rebuilt more often. Of the law only its reach comes on top, so that laws that act in touch share one list.
  double skin_ratio = 0.2;

  double time_step_share = default_time_step_share;  ///< of the lower bound of the critical step

  /// \throws InputError for parameters that no step can be made with; every call checks
  void validate() const {
    detail::validated(damping);
    detail::validated(boundary);
    require_positive("skin over the largest radius", skin_ratio);
    require_positive("share of the critical time step", time_step_share);
  }

  /// Makes the pair list where it is missing, too old or of another law or other masses, and the critical step with it.
  /// \return failed / not_finite also for a friction that is no number: clamped by it, forces would pass for ordinary
  /// ones
  /// \throws InputError for a negative friction, and for a law that `require_consistent` rejects when the list is made
  /// for it
  Verdict refresh(PackingType& packing, Law const& law) const {
    if constexpr (in_library) {
      return Library::refresh(*this, packing, law);
    } else {
      return refresh_here(packing, law);
    }
  }

  /// One time step while the cell follows the displacement gradient `strain_step` (velocity gradient x time step).
  template <Observe what = Observe::nothing>
    requires(what == Observe::nothing)
  Verdict step(PackingType& packing, Law const& law, Tensor<dim> const& strain_step) {
    return step<what>(packing, law, strain_step, nullptr);
  }
  /// The same; when it observes, `observed` receives the state before the move.
  template <Observe what = Observe::nothing>
  Verdict step(PackingType& packing, Law const& law, Tensor<dim> const& strain_step, StepObservation<dim>* observed) {
    if constexpr (in_library) {
      return Library::template step<what>(*this, packing, law, strain_step, observed);
    } else {
      return step_here<what>(packing, law, strain_step, observed);
    }
  }

  /// Stress and balance of the packing as it stands; no grain moves, but contacts are brought up to date, which the
  /// next step would do in the same way, and an old pair list is renewed.
  Verdict observe(PackingType& packing, Law const& law, StepObservation<dim>& observed) {
    if constexpr (in_library) {
      return Library::observe(*this, packing, law, observed);
    } else {
      return look<Observe::balance>(packing, law, &observed);
    }
  }

  /// Sets the grains' velocities to zero, after the contacts have responded to the last move.
  Verdict stop(PackingType& packing, Law const& law) {
    StepObservation<dim> unused;
    Verdict const verdict = observe(packing, law, unused);
    packing.rest();
    return verdict;
  }

 private:
  using Layout = RowLayout<Shape, Law>;
  using Library = detail::LibraryKernel<TimeStepper>;
  friend Library;
  static constexpr bool in_library = detail::kernel_is_precompiled<PackingType, Damping, Boundary>;

  Verdict refresh_here(PackingType& packing, Law const& law) const {
    validate();
    bool is_sound = true;
    Law own = law;
    for_each_friction(own, [&](double friction) {
      is_sound = is_sound && std::isfinite(friction);
      if (friction < 0.0) require_not_negative("friction of the contact law", friction);
    });
    if (!is_sound) return {Status::failed, Reason::not_finite};
    detail::validated(law);
    // The first is false also when the drift is no number.
    if (packing.pairs.drift <= packing.pairs.skin &&
        packing.pairs.basis.agrees_with(list_basis(packing, law, packing.pairs.skin)))
      return {};
    return renew(packing, law);
  }

  [[gnu::noinline, gnu::cold]] Verdict renew(PackingType& packing, Law const& law) const {
    require_population(packing);
    double const skin = skin_ratio * packing.population->largest_radius();
    if (!packing.pairs.basis.agrees_with(list_basis(packing, law, packing.pairs.skin)))
      require_consistent(law, packing.population->largest_radius());
    Verdict const verdict = rebuild_pairs(packing, skin, interaction_range_of(law));
    if (!verdict.acceptable()) return verdict;
    packing.pairs.critical_step = critical_step(packing, law);
    packing.pairs.basis = list_basis(packing, law, skin);
    return {};
  }

  /// Net forces of the grains where they stand, and what is observed of them.
  template <Observe what>
  Verdict look(PackingType& packing, Law const& law, StepObservation<dim>* observed) {
    if (Verdict const verdict = refresh_here(packing, law); !verdict.acceptable()) return verdict;
    ContactSums<dim> const sums = pair_forces<what>(packing, law, scratch_);
    if (!sums.converged) return {Status::failed, Reason::unconverged_normal};
    boundary.constrain(std::as_const(packing), GrainHolds<PackingType>(packing, scratch_.forces.data()));
    if constexpr (what != Observe::nothing)
      *observed = observation(packing, sums, NetForces<PackingType>{scratch_.forces.data()});
    return {};
  }

  template <Observe what>
  Verdict step_here(PackingType& packing, Law const& law, Tensor<dim> const& strain_step,
                    StepObservation<dim>* observed) {
    if (!strain_step.allFinite()) return {Status::failed, Reason::not_finite};
    if (Verdict const verdict = look<what>(packing, law, observed); !verdict.acceptable()) return verdict;
    double const time_step = time_step_share * packing.pairs.critical_step;
    if constexpr (SeesAllGrains<Damping, PackingType>)
      damping.before_move(std::as_const(packing), NetForces<PackingType>{scratch_.forces.data()}, time_step);
    Tensor<dim> const cell_step = exponential_of_small<dim>(strain_step);
    auto const energies = move_grains<what>(packing, cell_step, time_step, strain_step);
    if constexpr (what == Observe::energy) {
      observed->damping_loss = energies.damped;
      observed->kinetic_energy = energies.kinetic;
    }
    packing.cell = (cell_step * packing.cell).eval();
    packing.last_move = {strain_step, time_step};
    packing.pairs.drift += strain_step.norm() * (2.0 * packing.population->largest_radius() + packing.pairs.skin +
                                                 packing.pairs.basis.reach);
    return {};
  }

  struct Energies {
    double damped = 0.0;
    double kinetic = 0.0;
  };

  /// Advances velocity and position, or spin and orientation, of one component; adds up energies where they are wanted.
  template <Observe what>
  Lanes advance(Scalar* velocities, Lanes const& force, Lanes const& inverse_inertia, Lanes const& dt, Lanes& damped,
                Lanes& kinetic) const {
    Lanes const before = lanes::load(velocities);
    Lanes const after = damping.next_velocity(before, force, inverse_inertia * dt);
    lanes::store(after, velocities);
    if constexpr (what == Observe::energy) {
      Lanes const inertia = Lanes(Scalar(1)) / max(inverse_inertia, smallest_normal<Lanes>());  // padding never moves
      damped += (before + after) * Lanes(Scalar(0.5)) * (force * dt - (after - before) * inertia);
      kinetic += (before * before + after * after) * inertia * Lanes(Scalar(0.25));
    }
    return after;
  }

  template <Observe what>
  Energies move_grains(PackingType& packing, Tensor<dim> const& cell_step, double time_step,
                       Tensor<dim> const& strain_step) {
    constexpr std::size_t width = Lanes::size();
    constexpr std::size_t force_size = Layout::force_size;
    auto const& population = *packing.population;
    Lanes const dt = broadcast<Lanes>(time_step);
    Lanes fastest(Scalar(0));
    Lanes fastest_spin(Scalar(0));
    Lanes everything(Scalar(0));  // a sum keeps what is no number, a maximum may pass over it
    Lanes damped(Scalar(0));
    Lanes kinetic(Scalar(0));
    std::array<Lanes, static_cast<std::size_t>(dim * dim)> cell;
    for (int a = 0; a < dim; ++a) {
      for (int b = 0; b < dim; ++b) cell[detail::index(a * dim + b)] = broadcast<Lanes>(cell_step(a, b));
    }
    std::size_t const grains = packing.grain_count();
    std::size_t const padded = packing.position.padded_rows();
    scratch_.forces.resize(std::max(scratch_.forces.size(), padded * force_size));
    std::fill(scratch_.forces.begin() + static_cast<std::ptrdiff_t>(grains * force_size),
              scratch_.forces.begin() + static_cast<std::ptrdiff_t>(padded * force_size), Scalar(0));
    for (std::size_t start = 0; start < padded; start += width) {
      Lanes const inverse_mass = lanes::load(population.inverse_mass() + start);
      Lanes const inverse_inertia = lanes::load(population.inverse_inertia() + start);
      std::array<std::array<Lanes, 4>, force_size / 4> force;
      for (std::size_t quad = 0; quad < force.size(); ++quad) {
        force[quad] = lanes::from_quads<Scalar>([&](std::size_t lane) {
          return lanes::FourScalars<Scalar>::read(scratch_.forces.data() + (start + lane) * force_size + 4 * quad);
        });
      }
      Point<dim, Lanes> place;
      for (int a = 0; a < dim; ++a) place[detail::index(a)] = lanes::load(packing.position.column(a) + start);
      Lanes speed(Scalar(0));
      for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
        int const column = static_cast<int>(a);
        Lanes const velocity =
            advance<what>(packing.velocity.column(column) + start, force[0][a], inverse_mass, dt, damped, kinetic);
        speed += velocity * velocity;
        Lanes moved = velocity * dt;
        for (std::size_t b = 0; b < static_cast<std::size_t>(dim); ++b)
          moved += cell[a * static_cast<std::size_t>(dim) + b] * place[b];
        lanes::store(moved, packing.position.column(column) + start);
        everything += moved;
      }
      Lanes turning(Scalar(0));
      for (int k = 0; k < spin_size<dim>; ++k) {
        std::size_t const entry = Layout::torque + detail::index(k);
        Lanes const torque = force[entry / 4][entry % 4];
        Lanes const spin = advance<what>(packing.spin.column(k) + start, torque, inverse_inertia, dt, damped, kinetic);
        turning += spin * spin;
        if constexpr (Shape::orientation_count == 2) turn_axes(packing, start, spin * dt, strain_step);
      }
      fastest = max(fastest, speed);
      fastest_spin = max(fastest_spin, turning);
      everything += speed + turning;
    }
    double const speed = std::sqrt(static_cast<double>(hmax(fastest)));
    double const spin = std::sqrt(static_cast<double>(hmax(fastest_spin)));
    packing.pairs.drift += 2.0 * time_step * (speed + spin * population.largest_eccentricity());
    double const sum = static_cast<double>(detail::lane_sum(everything));
    if (!std::isfinite(sum)) packing.pairs.drift = std::numeric_limits<double>::quiet_NaN();
    return {detail::lane_sum(damped), detail::lane_sum(kinetic)};
  }

  /// Turns the axes (cos, sin) of plane grains by their own rotation and the cell's. Cayley's rotation keeps them unit
  /// vectors to round-off.
  static void turn_axes(PackingType& packing, std::size_t start, Lanes const& turn, Tensor<dim> const& strain_step) {
    Lanes const x = lanes::load(packing.orientation.column(0) + start);
    Lanes const y = lanes::load(packing.orientation.column(1) + start);
    auto const axis = turned_axis<Lanes>({x, y}, turn + detail::affine_turn<2, Lanes>(strain_step));
    lanes::store(axis[0], packing.orientation.column(0) + start);
    lanes::store(axis[1], packing.orientation.column(1) + start);
  }

  PairScratch<Scalar> scratch_;
};

}  // namespace scarp
