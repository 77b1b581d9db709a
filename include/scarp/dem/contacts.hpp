// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/grain_view.hpp"

namespace scarp {

/// A pair of grains of a packing at rest in its present positions.
template <int Dim>
struct Contact {
  std::size_t pair;    ///< row in the list of near pairs
  std::size_t first;   ///< grain
  std::size_t second;  ///< grain; the owner where the pair lists a ghost
  Touch<Dim, double> touch;
  Vector<Dim> branch;             ///< from the first centre to the second [m]
  Vector<Dim> force;              ///< on the second grain [N]
  double normal_force;            ///< [N], positive in compression
  Tangential<Dim, double> shear;  ///< tangential force on the second grain [N]

  Vector<Dim> normal() const { return Eigen::Map<Vector<Dim> const>(touch.normal.data()); }
};

/// Calls visit(Contact) for every near pair, touching or not, in the order of the list. The packing is not changed: forces
/// follow from present positions and remembered shear, without slip.
template <class PackingType, class Visitor>
void for_each_near_pair(PackingType const& packing, typename PackingType::Law const& law, Visitor&& visit) {
  using Shape = typename PackingType::Shape;
  constexpr int dim = PackingType::dim;
  auto const& pairs = packing.pairs;
  for (std::size_t p = 0; p < pairs.count(); ++p) {
    auto const i = static_cast<std::size_t>(pairs.first[p]);
    auto const second = static_cast<std::size_t>(pairs.second[p]);
    std::size_t const j = grain_owner(packing, second);
    auto const from = grain_position(packing, i);
    auto const to = grain_position(packing, second);
    Point<dim, double> branch;
    Point<dim, double> start{};
    for (std::size_t a = 0; a < branch.size(); ++a) branch[a] = to[a] - from[a];
    if constexpr (Shape::remembers_normal) {
      for (std::size_t a = 0; a < start.size(); ++a)
        start[a] = static_cast<double>(pairs.normal(p, static_cast<int>(a)));
    }
    auto const touch = settled_touch<Shape>(grain_pose(packing, i), grain_pose(packing, j), branch, start);
    Contact<dim> contact{p, i, j, touch, Eigen::Map<Vector<dim> const>(branch.data()), {}, 0.0, {}};
    Approach<dim, double> const still{touch.overlap, {}};
    if constexpr (PackingType::Law::remembers_shear && dim == 2) {
      contact.shear = static_cast<double>(pairs.shear(p, 0));
    }
    contact.normal_force = law.respond(still, contact.shear);
    contact.force = contact.normal_force * contact.normal();
    if constexpr (PackingType::Law::remembers_shear && dim == 2) {
      contact.force += contact.shear * Vector<dim>(-touch.normal[1], touch.normal[0]);
    }
    visit(contact);
  }
}

/// The same for pairs that touch.
template <class PackingType, class Visitor>
void for_each_contact(PackingType const& packing, typename PackingType::Law const& law, Visitor&& visit) {
  for_each_near_pair(packing, law, [&](Contact<PackingType::dim> const& contact) {
    if (contact.touch.overlap > 0.0) visit(contact);
  });
}

}  // namespace scarp
