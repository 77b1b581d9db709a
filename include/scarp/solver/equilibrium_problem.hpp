// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "scarp/solver/problem.hpp"

namespace scarp {

/// A `Problem` whose elements keep their type for those who read them.
/// \tparam GridType a `Discretisation`
template <class GridType>
class EquilibriumProblem final : public Problem<GridType::dim> {
 public:
  static constexpr int dim = GridType::dim;  ///< of the mesh

  /// loads [N], shape (degrees of freedom of mesh and attachment)
  /// \throws InputError for sizes that do not fit together
  template <class Attached = NoAttachment>
  EquilibriumProblem(GridType grid, MaterialPoints<dim> points, Constraints constraints, LoadHistory loads,
                     Executor& executor, Attached attached = {})
      : Problem<dim>(std::make_unique<GridType>(std::move(grid)), std::move(points), std::move(constraints),
                     std::move(loads), executor, part_of(std::move(attached))) {}

  /// Mesh and elements, committed.
  GridType const& discretisation() const { return static_cast<GridType const&>(Problem<dim>::grid()); }

 private:
  template <class Attached>
  static std::unique_ptr<detail::AttachedPart<dim>> part_of(Attached attached) {
    if constexpr (std::is_same_v<Attached, NoAttachment>) {
      return nullptr;
    } else {
      return std::make_unique<detail::AttachedPartOf<dim, Attached>>(std::move(attached));
    }
  }
};

}  // namespace scarp
