// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <memory>
#include <utility>

#include "scarp/solver/detail/contact_following.hpp"
#include "scarp/solver/problem.hpp"

namespace scarp {

/// A `Problem` whose elements keep their type for those who read them.
/// \tparam GridType a `Discretisation`
template <class GridType>
class EquilibriumProblem final : public Problem<GridType::dim> {
 public:
  static constexpr int dim = GridType::dim;  ///< of the mesh

  /// loads [N], shape (degrees of freedom of mesh, body and field); attached: a body or a load, and a field, any or
  /// none
  /// \throws InputError for sizes that do not fit together, and a second one of a kind
  template <class... Attached>
  EquilibriumProblem(GridType grid, MaterialPoints<dim> points, Constraints constraints, LoadHistory loads,
                     Executor& executor, Attached... attached)
      : Problem<dim>(std::make_unique<GridType>(std::move(grid)), std::move(points), std::move(constraints),
                     std::move(loads), executor, together(std::move(attached)...), following<Attached...>()) {}

  /// Mesh and elements, committed.
  GridType const& discretisation() const { return static_cast<GridType const&>(Problem<dim>::grid()); }

 private:
  template <class... Attached>
  static constexpr detail::MakeFollowing<Problem<dim>> following() {
    constexpr bool with_body = ((!detail::NamesField<Attached> && !std::same_as<Attached, NoAttachment>) || ...);
    if constexpr (with_body) return &detail::follow_contact<dim>;
    return nullptr;
  }
  template <class... Attached>
  static detail::Attachments<dim> together(Attached... attached) {
    detail::Attachments<dim> all;
    (all.add(std::move(attached)), ...);
    return all;
  }
};

}  // namespace scarp
