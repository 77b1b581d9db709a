// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

#include "scarp/dem/contacts.hpp"

namespace scarp {

struct Disc;
struct Ellipse;

namespace detail {
/// A shape without the species of its grains.
template <class Shape>
struct BareShape {
  using Type = Shape;
};
template <class Shape>
  requires requires { typename Shape::Bare; }
struct BareShape<Shape> {
  using Type = typename Shape::Bare;
};
/// Half axes among the numbers of a grain's size; 0 for grains that are neither discs nor ellipses.
template <class Shape>
inline constexpr std::size_t half_axes = std::same_as<typename BareShape<Shape>::Type, Disc>      ? 1
                                         : std::same_as<typename BareShape<Shape>::Type, Ellipse> ? 2
                                                                                                  : 0;
}  // namespace detail

/// Whether `packing_picture` accepts packings of this type: discs and ellipses in the plane.
template <class PackingType>
concept HasPicture = detail::half_axes<typename PackingType::Shape>
!= 0;

/// A plane packing as a drawing needs it, whatever its grains and its contact law are.
struct PackingPicture {
  /// A grain as an ellipse.
  struct Grain {
    Vector<2> centre;        ///< [m], perhaps outside of the cell
    double a = 0.0;          ///< half axis along `axis` [m]
    double b = 0.0;          ///< half axis across [m]
    Vector<2> axis{1.0, 0};  ///< unit vector
  };
  /// A contact and its normal force.
  struct Contact {
    Vector<2> from;             ///< centre of the first grain [m]
    Vector<2> branch;           ///< from there to the centre of the second one [m]
    Vector<2> normal;           ///< unit vector, towards the second grain
    double normal_force = 0.0;  ///< [N], positive in compression
  };

  Tensor<2> cell;                   ///< columns are base vectors [m]
  std::vector<Grain> grains{};      ///< of the packing, in its order
  std::vector<Contact> contacts{};  ///< those that touch
};

/// The packing stays as it is.
template <HasPicture PackingType>
PackingPicture packing_picture(PackingType const& packing, typename PackingType::Law const& law) {
  PackingPicture picture{.cell = packing.cell};
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    auto const size = packing.population->size(i);
    PackingPicture::Grain grain{{packing.position(i, 0), packing.position(i, 1)},
                                size.front(),
                                size[detail::half_axes<typename PackingType::Shape> - 1]};
    if constexpr (PackingType::Shape::orientation_count == 2) {
      grain.axis = {static_cast<double>(packing.orientation(i, 0)), static_cast<double>(packing.orientation(i, 1))};
    }
    picture.grains.push_back(grain);
  }
  for_each_contact(packing, law, [&](Contact<2> const& contact) {
    auto const from = row_position(packing, contact.first);
    picture.contacts.push_back({{from[0], from[1]}, contact.branch, contact.normal(), contact.normal_force});
  });
  return picture;
}

}  // namespace scarp
