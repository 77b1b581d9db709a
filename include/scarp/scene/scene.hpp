// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/bvp/loads.hpp"
#include "scarp/scene/region_materials.hpp"
#include "scarp/solver/equilibrium_problem.hpp"

namespace scarp {

/// The material side of a scene from its regions; scene/nonlocal_scene.hpp says it for regions that need their neighbours.
template <class... Providers>
struct SceneMaterials {
  using Type = RegionMaterials<Providers...>;

  /// owned(point): points that are asked in this process
  template <class DiscretisationType, class Owned>
  static Type make(DiscretisationType const& discretisation, double surface_level,
                   boost::hana::tuple<Region<Providers>...> const& regions, Owned const& owned) {
    return {discretisation, surface_level, regions, owned};
  }
};

/// The composition root: one discretisation, a provider for each region, constraints and loads, as a problem that a
/// solver can take. Regions are written as values, `make_problem(..., hana::make_tuple(Region{"soil", soil}))`.
template <class DiscretisationType, class Executor, class Attached, class... Providers>
using SceneProblem =
    EquilibriumProblem<DiscretisationType, typename SceneMaterials<Providers...>::Type, Executor, Attached>;

/// \throws InputError when the parts do not fit together
template <class DiscretisationType, CheckedExecutor Executor,
          CheckedAttachment<DiscretisationType::dim> Attached = NoAttachment, class... Providers>
SceneProblem<DiscretisationType, Executor, Attached, Providers...> make_problem(
    DiscretisationType discretisation, double surface_level, boost::hana::tuple<Region<Providers>...> const& regions,
    Constraints constraints, LoadHistory loads, Executor& executor, Attached attached = {}) {
  auto materials = SceneMaterials<Providers...>::make(discretisation, surface_level, regions,
                                                      [&](int point) { return owns_point(executor, point); });
  return {std::move(discretisation), std::move(materials), std::move(constraints), std::move(loads), executor,
          std::move(attached)};
}

}  // namespace scarp
