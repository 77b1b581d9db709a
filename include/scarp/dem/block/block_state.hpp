// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "scarp/contact/contact_law.hpp"
#include "scarp/core/host_device.hpp"
#include "scarp/shape/particle_shape.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// How many numbers grains and pairs have in a block.
/// \tparam ShapeType of the grains; \tparam LawType of the contacts; \tparam ScalarType of coordinates and velocities
template <class ShapeType, class LawType, class ScalarType>
struct BlockTypes {
  using Shape = ShapeType;                                           ///< of the grains
  using Law = LawType;                                               ///< of the contacts
  using Scalar = ScalarType;                                         ///< of coordinates and velocities
  static constexpr int dim = Shape::dim;                             ///< of space
  static constexpr int turns = spin_size<dim>;                       ///< components of a rotation
  static constexpr int axes = Shape::orientation_count;              ///< numbers of an orientation
  static constexpr int poses = Shape::pose_count;                    ///< numbers that the contact search sees of a part
  static constexpr int sizes = Shape::size_count;                    ///< numbers of a size
  static constexpr int parts = part_count<Shape>();                  ///< of a grain
  static constexpr int tangential = dim == 2 ? 1 : 3;                ///< components of a tangential quantity
  static constexpr int shears = Law::inputs.shear ? tangential : 0;  ///< components of a stored tangential force
  static constexpr int moments = Law::inputs.moment ? tangential : 0;      ///< components of a stored moment
  static constexpr int memories = shears + moments + Law::inputs.scalars;  ///< numbers that a contact stores
  static constexpr int normals = Shape::warm_starts_normal ? dim : 0;      ///< components of a stored normal
  static constexpr int forces = dim + 2 * turns;                           ///< force and both torques of a pair
  static constexpr int shifts = dim == 2 ? 9 : 27;                         ///< images of a grain, itself included
  static constexpr int no_shift = shifts / 2;                              ///< number of the grain itself among these
};

/// Most grains and near pairs that the memory of a block holds.
struct BlockSize {
  int grains = 0;  ///< most grains
  int pairs = 0;   ///< most near pairs
};

/// Why a block stopped. A verdict follows from the first four; what is left the vector kernel responds to.
enum class Trouble : std::int32_t { none, not_finite, cell_collapsed, lost_grain, unconverged_touch, list_full };

/// What a state holds beside arrays, and what a response has observed.
template <int Dim>
struct BlockHeader {
  using Square = std::array<double, static_cast<std::size_t>(Dim* Dim)>;  ///< a tensor, row by row

  Square cell{};                    ///< base vectors as columns [m]
  Square gradient{};                ///< displacement gradient of the last move
  double duration = 0.0;            ///< of the last move [s]
  double drift = 0.0;               ///< see VerletList [m]
  double skin = 0.0;                ///< see VerletList [m]
  double reach = 0.0;               ///< of the law [m]
  double critical_step = 0.0;       ///< [s]
  std::int32_t grains = 0;          ///< in the packing
  std::int32_t pairs = 0;           ///< in the list
  std::int32_t applied = 0;         ///< 1 where the contacts' memory contains the last move
  Trouble trouble = Trouble::none;  ///< why the response ended early
  std::int32_t steps = 0;           ///< of the last response
  std::int32_t lists = 0;           ///< made in the last response
  Square moment{};                  ///< sum of force (x) branch [N m]
  Square kinetic{};                 ///< sum of m v (x) v [N m]
  double contacts = 0.0;            ///< that carry a force
  double force = 0.0;               ///< sum of the contact forces' sizes [N]
  double deepest = 0.0;             ///< overlap over reduced radius
  double unbalanced = 0.0;          ///< sum of the net forces' sizes [N]
  /// Stiffness times volume [N m] in Voigt's notation, row by row from the diagonal on.
  std::array<double, static_cast<std::size_t>(voigt_size<Dim>*(voigt_size<Dim> + 1) / 2)> stiffness{};
};

namespace detail {
/// Bytes of an array, rounded up so that the next one is aligned.
SCARP_HOST_DEVICE constexpr std::size_t laid_out_bytes(std::size_t count, std::size_t each) {
  constexpr std::size_t alignment = 16;
  return (count * each + alignment - 1) / alignment * alignment;
}
}  // namespace detail

/// The state of a packing in one piece of memory: a header and columns of numbers, one column after the other.
/// \tparam Types a `BlockTypes`
template <class Types>
struct BlockState {
  using Scalar = typename Types::Scalar;  ///< of coordinates and velocities

  BlockSize size;                             ///< rows of the columns
  BlockHeader<Types::dim>* header = nullptr;  ///< what is no array
  Scalar* position = nullptr;                 ///< of grains [m]
  Scalar* velocity = nullptr;                 ///< of grains [m/s]
  Scalar* spin = nullptr;                     ///< of grains [rad/s]
  Scalar* orientation = nullptr;              ///< of grains
  Scalar* normal = nullptr;                   ///< of pairs
  Scalar* memory = nullptr;                   ///< of pairs: shear, moment, scalars
  std::uint16_t* first = nullptr;             ///< row of a pair's first grain part
  std::uint16_t* second = nullptr;            ///< row of a pair's second grain part
  std::uint8_t* shift = nullptr;              ///< number of the second grain's image

  /// A state that begins at `at`; without arrays where that is null.
  SCARP_HOST_DEVICE constexpr BlockState(std::byte* at, BlockSize rows) : size(rows) {
    if (at == nullptr) return;
    lay_out([&]<class T>(T*& array, std::size_t count) {
      array = static_cast<T*>(static_cast<void*>(at));
      at += detail::laid_out_bytes(count, sizeof(T));
    });
  }

  /// Bytes of a state.
  static SCARP_HOST_DEVICE constexpr std::size_t bytes(BlockSize rows) {
    std::size_t sum = 0;
    BlockState unplaced(rows);
    unplaced.lay_out([&]<class T>(T*&, std::size_t count) { sum += detail::laid_out_bytes(count, sizeof(T)); });
    return sum;
  }

 private:
  SCARP_HOST_DEVICE constexpr explicit BlockState(BlockSize rows) : size(rows) {}

  template <class Place>
  SCARP_HOST_DEVICE constexpr void lay_out(Place const& place) {
    auto const grains = static_cast<std::size_t>(size.grains);
    auto const pairs = static_cast<std::size_t>(size.pairs);
    place(header, 1);
    place(position, Types::dim * grains);
    place(velocity, Types::dim * grains);
    place(spin, Types::turns * grains);
    place(orientation, Types::axes * grains);
    place(normal, Types::normals * pairs);
    place(memory, Types::memories * pairs);
    place(first, pairs);
    place(second, pairs);
    place(shift, pairs);
  }
};

/// What never changes of the grains; many states share it.
/// \tparam Types a `BlockTypes`
template <class Types>
struct BlockGrains {
  using Scalar = typename Types::Scalar;  ///< of sizes

  Scalar const* size;             ///< columns of `stride` numbers
  Scalar const* inverse_mass;     ///< [1/kg]
  Scalar const* inverse_inertia;  ///< [1/(kg m2)]
  double const* bounding_radius;  ///< [m]
  int stride;                     ///< numbers of a column
  double largest_radius;          ///< [m]
  double largest_eccentricity;    ///< see Population [m]
  double largest_normal_change;   ///< see Population [rad]
  double unique_minimum_depth;    ///< see Population [m]
};

}  // namespace scarp
