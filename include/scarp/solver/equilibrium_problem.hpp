// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "scarp/solver/problem.hpp"

namespace scarp {

/// A `Problem` whose elements, and what is attached to them, keep their types for those who read them.
/// \tparam GridType a `Discretisation`
template <class GridType, class Attached = NoAttachment>
class EquilibriumProblem final : public Problem<GridType::dim> {
  using Base = Problem<GridType::dim>;
  using Attaching = detail::AttachedPartOf<GridType::dim, Attached>;

 public:
  static constexpr int dim = GridType::dim;                                ///< of the mesh
  static constexpr bool is_bare = std::is_same_v<Attached, NoAttachment>;  ///< nothing is attached to the mesh

  /// loads [N], shape (degrees of freedom of mesh and attachment)
  /// \throws InputError for sizes that do not fit together
  EquilibriumProblem(GridType grid, MaterialPoints<dim> points, Constraints constraints, LoadHistory loads,
                     Executor const& executor, Attached attached = {})
      : Base(std::make_unique<GridType>(std::move(grid)), std::move(points), std::move(constraints), std::move(loads),
             executor, part_of(std::move(attached))) {}

  GridType const& discretisation() const { return static_cast<GridType const&>(Base::grid()); }  ///< Mesh and elements.
  /// What is attached to the mesh.
  Attached const& attached() const requires(!is_bare) {
    return static_cast<Attaching const&>(*Base::attached_part()).part();
  }

 private:
  static std::unique_ptr<detail::AttachedPart<dim>> part_of(Attached attached) {
    if constexpr (is_bare) {
      return nullptr;
    } else {
      return std::make_unique<Attaching>(std::move(attached));
    }
  }
};

}  // namespace scarp
