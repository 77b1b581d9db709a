// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/dem/contact_frame.hpp"
#include "scarp/dem/grain_view.hpp"

namespace scarp {

/// A pair of grains of a packing at rest in its present positions.
template <int Dim>
struct Contact {
  std::size_t pair;                         ///< row in the list of near pairs
  std::size_t first;                        ///< grain
  std::size_t second;                       ///< grain; the owner where the pair lists a ghost
  ContactGeometry<Dim, double> touch;       ///< overlap, normal and arms at the present positions
  ContactKinematics<Dim, double> approach;  ///< without motion
  ContactMemory<Dim, double> memory;        ///< at the present overlap
  ContactStiffness stiffness;               ///< [N/m], [N m/rad]; sliding not regarded
  double normal_force;                      ///< [N], positive in compression
  Vector<Dim> branch;                       ///< from the first centre to the second [m]
  Vector<Dim> force;                        ///< on the second grain [N]

  /// Unit normal from the first to the second grain.
  Vector<Dim> normal() const { return Eigen::Map<Vector<Dim> const>(touch.normal.data()); }
  /// Tangential force on the second grain [N].
  Vector<Dim> shear_force() const { return force - normal_force * normal(); }
  /// Whether the grains overlap, or the law acts across their gap.
  bool closed() const { return touch.overlap > 0.0 || normal_force != 0.0; }
};

namespace detail {

template <int Dim, class Scalar, int Count>
void read_tangential(SoaArray<Scalar, Count> const& columns, std::size_t row, Tangential<Dim, double>& to) {
  if constexpr (Count == 1) {
    to = static_cast<double>(columns(row, 0));
  } else if constexpr (Count == 3) {
    for (int a = 0; a < 3; ++a) to[detail::index(a)] = static_cast<double>(columns(row, a));
  }
}

}  // namespace detail

/// Memory of the contact of a near pair.
template <class Shape, class Law, class Scalar>
ContactMemory<Shape::dim, double> contact_memory(VerletList<Shape, Law, Scalar> const& pairs, std::size_t pair) {
  constexpr int dim = Shape::dim;
  ContactMemory<dim, double> memory;
  detail::read_tangential<dim>(pairs.shear, pair, memory.shear);
  detail::read_tangential<dim>(pairs.moment, pair, memory.moment);
  if constexpr (Law::inputs.scalars > 0) {
    for (int k = 0; k < Law::inputs.scalars; ++k) {
      memory.scalars[detail::index(k)] = static_cast<double>(pairs.scalars(pair, k));
    }
  }
  return memory;
}

/// Calls visit(Contact) for every near pair, touching or not, in the order of the list. The packing is not changed:
/// forces follow from present positions and memories, without slip.
template <class PackingType, class Visitor>
void for_each_near_pair(PackingType const& packing, typename PackingType::Law const& law, Visitor&& visit) {
  using Shape = typename PackingType::Shape;
  constexpr int dim = PackingType::dim;
  auto const& pairs = packing.pairs;
  for (std::size_t p = 0; p < pairs.count(); ++p) {
    PairGeometry<PackingType> const near(packing, p);
    auto const& touch = near.touch;
    double const radius_first = Shape::contact_radius(near.first);
    double const radius_second = Shape::contact_radius(near.second);
    ContactKinematics<dim, double> still{
        .overlap = touch.overlap,
        .slip_increment = {},
        .reduced_radius = radius_first * radius_second / (radius_first + radius_second)};
    if constexpr (PackingType::Law::inputs.species > 0)
      still.species = {Shape::species(near.first), Shape::species(near.second)};
    auto memory = contact_memory(pairs, p);
    carry_to_frame(memory.shear, {}, touch.normal);
    carry_to_frame(memory.moment, {}, touch.normal);
    auto const response = law.respond(still, memory);
    auto const sideways =
        as_vector(PackingType::Law::inputs.shear ? response.shear : decltype(response.shear){}, touch.normal);
    Contact<dim> contact{p,
                         grain_of_row(packing, detail::index(pairs.first[p])),
                         grain_of_row(packing, detail::index(pairs.second[p])),
                         touch,
                         still,
                         memory,
                         contact_stiffness(law, still),
                         response.normal,
                         Eigen::Map<Vector<dim> const>(near.branch.data()),
                         Eigen::Map<Vector<dim> const>(sideways.data())};
    contact.force += response.normal * contact.normal();
    visit(contact);
  }
}

/// As for_each_near_pair, of pairs that touch or act across a gap only.
template <class PackingType, class Visitor>
void for_each_contact(PackingType const& packing, typename PackingType::Law const& law, Visitor&& visit) {
  for_each_near_pair(packing, law, [&](Contact<PackingType::dim> const& contact) {
    if (contact.closed()) visit(contact);
  });
}

}  // namespace scarp
