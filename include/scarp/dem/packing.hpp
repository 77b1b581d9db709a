// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "scarp/contact/contact_law.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/dem/population.hpp"
#include "scarp/simd/soa_array.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp::detail {

inline void require_valid(bool sound, std::string_view what) {
  if (!sound) reject("its {} (no packing is like that): save it again", what);
}

/// Whether columns have a row for each of `rows`; columns that hold nothing always do.
template <class Scalar, int Count>
bool has_rows(SoaArray<Scalar, Count> const& columns, std::size_t rows) {
  if constexpr (Count == 0) {
    return true;
  } else {
    return columns.rows() == rows;
  }
}

/// What a hash that fits does not show: the numbers of a packing that was read must not lead outside its arrays.
/// \throws InputError
template <class PackingType>
void require_valid_packing(PackingType const& packing) {
  auto const& pairs = packing.pairs;
  std::size_t const grains = packing.grain_count();
  std::size_t const sizes = packing.population ? packing.population->count() : 0;
  auto const rows = static_cast<std::int64_t>(packing.row_count());
  auto const ghosts = static_cast<std::int64_t>(pairs.ghost_owner.size());
  require_valid(sizes == grains && has_rows(packing.velocity, grains) && has_rows(packing.spin, grains) &&
                    has_rows(packing.orientation, grains),
                "arrays of grains differ in length");
  require_valid(packing.cell.allFinite() && packing.cell.determinant() > 0.0, "cell has no positive content");
  require_valid(pairs.second.size() == pairs.count() && has_rows(pairs.normal, pairs.count()) &&
                    has_rows(pairs.shear, pairs.count()) && has_rows(pairs.moment, pairs.count()) &&
                    has_rows(pairs.scalars, pairs.count()) && pairs.ghost_shift.size() == pairs.ghost_owner.size(),
                "arrays of pairs differ in length");
  for (std::int32_t const owner : pairs.ghost_owner) require_valid(owner >= 0 && owner < rows, "ghosts have no owner");
  for (std::size_t p = 0; p < pairs.count(); ++p) {
    require_valid(pairs.first[p] >= 0 && pairs.first[p] < rows && pairs.second[p] > pairs.first[p] &&
                      pairs.second[p] < rows + ghosts,
                  "pairs name grains that are not there");
  }
}

}  // namespace scarp::detail

namespace scarp {

/// What a list of near pairs and its critical step were made from in addition to the grains' places. With another law,
/// or with grains of another mass, the list is made anew.
struct ListBasis {
  double reach = 0.0;                  ///< gap across which the law acts [m]
  double damping_ratio = 0.0;          ///< of the law's dashpots
  double mass = 0.0;                   ///< of all grains [kg]
  std::array<double, 12> stiffness{};  ///< the law's springs at some depths and radii, see `list_basis`

  SCARP_MEMBERS(reach, damping_ratio, mass, stiffness)

  /// Equal but for the round-off of another compiler or instruction set.
  bool agrees_with(ListBasis const& other) const {
    auto const close = [](double a, double b) {
      return a == b || std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
    };
    return close(reach, other.reach) && close(damping_ratio, other.damping_ratio) && close(mass, other.mass) &&
           std::equal(stiffness.begin(), stiffness.end(), other.stiffness.begin(), close);
  }

  friend bool operator==(ListBasis const&, ListBasis const&) = default;
};

/// Pairs of grains closer than a skin (Verlet list), each once. Numbers are *rows*: part p of grain i has row
/// i x part_count + p. A partner across the cell's boundary is a *ghost*: row row_count + g stands for row
/// `ghost_owner[g]` moved by cell x `ghost_shift[g]`. What a shape or law has no memory of is not stored.
/// \tparam Shape a `ParticleShape`
/// \tparam Law a `ContactLaw`
/// \tparam Scalar float or double
template <CheckedShape Shape, CheckedContactLaw Law, class Scalar>
struct VerletList {
  static constexpr int dim = Shape::dim;                                 ///< of the grains' space
  static constexpr int tangential_count = dim == 2 ? 1 : 3;              ///< numbers of a tangential quantity
  using Shift = std::array<std::int8_t, static_cast<std::size_t>(dim)>;  ///< in cells along each base vector

  std::vector<std::int32_t> first;   ///< row of each pair's first grain
  std::vector<std::int32_t> second;  ///< row of each pair's second grain
  /// Unit vectors that the search for each contact starts from.
  SoaArray<Scalar, Shape::warm_starts_normal ? dim : 0> normal;
  SoaArray<Scalar, Law::inputs.shear ? tangential_count : 0> shear;    ///< tangential force on the second grain [N]
  SoaArray<Scalar, Law::inputs.moment ? tangential_count : 0> moment;  ///< on the second grain [N m]
  SoaArray<Scalar, Law::inputs.scalars> scalars;                       ///< further numbers that the law stores
  std::vector<std::int32_t> ghost_owner;                               ///< row of a grain's part, for each ghost
  std::vector<Shift> ghost_shift;                                      ///< from the owner to each ghost
  double drift = 0.0;          ///< bound on how far gaps have shrunk since the list was made [m]
  double skin = -1.0;          ///< gap up to which pairs are listed [m]; negative before the first list
  double critical_step = 0.0;  ///< lower bound of the largest stable time step [s] while the list lasts
  ListBasis basis;             ///< what the list was made for

  /// Number of pairs.
  std::size_t count() const { return first.size(); }

  /// What is saved and loaded.
  SCARP_MEMBERS(first, second, normal, shear, moment, scalars, ghost_owner, ghost_shift, drift, skin, critical_step,
                basis)

  friend bool operator==(VerletList const&, VerletList const&) = default;
};

/// Motion of the cell in the last step. Slip and closing at the contacts follow from it and the grains' velocities.
template <int Dim>
struct LastMove {
  Tensor<Dim> gradient = Tensor<Dim>::Zero();  ///< displacement gradient of the cell
  double duration = 0.0;                       ///< [s], zero at rest
  bool applied = false;                        ///< whether the contacts' memory already contains it

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(gradient, duration, applied);
    visit("gradient of the last move", self.gradient);
    visit("duration of the last move", self.duration);
    visit("answer to the last move", self.applied);
  }

  friend bool operator==(LastMove const&, LastMove const&) = default;
};

/// State of a periodic packing: everything that evolves. Velocities are fluctuations about the affine motion of the
/// cell; the cell's columns are its base vectors [m]. Positions may lie outside the cell by a lattice vector.
/// \tparam ShapePolicy a `ParticleShape`
/// \tparam LawPolicy a `ContactLaw`
/// \tparam ScalarType float or double
template <CheckedShape ShapePolicy, CheckedContactLaw LawPolicy, class ScalarType = double>
struct Packing {
  using Shape = ShapePolicy;              ///< of the grains
  using Law = LawPolicy;                  ///< of the contacts
  using Scalar = ScalarType;              ///< of coordinates and velocities
  static constexpr int dim = Shape::dim;  ///< of the grains' space
  static_assert(Law::inputs.species == 0 || Law::inputs.species == species_count<Shape>(),
                "scarp: a law per pair of species needs grains `WithSpecies<Shape, N>` of as many species");

  std::shared_ptr<Population<Shape, Scalar> const> population;  ///< sizes and masses, shared by copies
  Tensor<dim> cell = Tensor<dim>::Identity();                   ///< columns are base vectors [m]
  SoaArray<Scalar, dim> position;                               ///< of the grains' centres [m]
  SoaArray<Scalar, dim> velocity;                               ///< fluctuation [m/s]
  SoaArray<Scalar, spin_size<dim>> spin;                        ///< fluctuation [rad/s]
  SoaArray<Scalar, Shape::orientation_count> orientation;       ///< axes (cos, sin) of plane grains
  LastMove<dim> last_move;                                      ///< of the cell
  VerletList<Shape, Law, Scalar> pairs;                         ///< near pairs and memory of contacts

  /// Number of grains, each of one or several parts.
  std::size_t grain_count() const { return position.rows(); }
  /// Rows of the pair list without ghosts: one for each part of each grain.
  std::size_t row_count() const { return grain_count() * static_cast<std::size_t>(part_count<Shape>()); }
  /// Volume of the cell [m3] including the out-of-plane thickness in 2D.
  double volume() const { return cell.determinant() * population->thickness(); }

  /// Volume of voids over volume of grains; overlaps are not subtracted from the grains.
  double void_ratio() const { return cell.determinant() / population->content() - 1.0; }

  /// What a saved packing consists of.
  SCARP_MEMBERS(population, cell, position, velocity, spin, orientation, last_move, pairs)

  /// Checks numbers that were read.
  /// \throws InputError for numbers that no packing has
  void after_loading() const { detail::require_valid_packing(*this); }

  /// No velocities and no last move, as of grains that were just placed. Grains that have moved are stopped by
  /// TimeStepper.
  void rest() {
    velocity.resize(grain_count());
    spin.resize(grain_count());
    last_move = {};
  }

  friend bool operator==(Packing const&, Packing const&) = default;
};

/// \throws InputError for a packing without grains
template <class PackingType>
void require_population(PackingType const& packing) {
  if (!packing.population) reject("a packing without grains was to be moved (it has no population): make or load one");
}

/// What a list with this skin [m] follows from: the springs, in a weighted sum over pairs of species, of smallest and
/// of largest grains at the skin, which is how deep a near pair may get at least, and at twice the skin.
template <class PackingType>
ListBasis list_basis(PackingType const& packing, typename PackingType::Law const& law, double skin) {
  auto const& population = *packing.population;
  ListBasis basis{
      .reach = interaction_range_of(law), .damping_ratio = damping_ratio_of(law), .mass = population.mass()};
  std::size_t k = 0;
  for (double const radius : {population.smallest_radius(), population.largest_radius()}) {
    for (double const depth : {skin, 2.0 * skin}) {
      double weight = 1.0;
      for_each_law(law, [&](auto const& one) {
        ContactStiffness const springs = one.stiffness(depth, radius / 2.0);
        basis.stiffness[k] += weight * springs.normal;
        basis.stiffness[k + 1] += weight * springs.tangential;
        basis.stiffness[k + 2] += weight * springs.rolling;
        weight *= 1.37;  // stiffnesses that are exchanged between pairs of species differ in the sum
      });
      k += 3;
    }
  }
  return basis;
}

}  // namespace scarp
