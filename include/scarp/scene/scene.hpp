// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/bvp/loads.hpp"
#include "scarp/scene/region_materials.hpp"
#include "scarp/solver/equilibrium_problem.hpp"

namespace scarp {

/// The composition root: one discretisation, a provider for each region, constraints and loads, as a problem that a
/// solver can take. Regions are written as values, `make_problem(..., hana::make_tuple(Region{"soil", soil}))`.
template <class DiscretisationType, class Executor, class Attached, class... Providers>
using SceneProblem = EquilibriumProblem<DiscretisationType, RegionMaterials<Providers...>, Executor, Attached>;

/// \throws InputError when the parts do not fit together
template <class DiscretisationType, class Executor, class Attached = NoAttachment, class... Providers>
SceneProblem<DiscretisationType, Executor, Attached, Providers...> make_problem(
    DiscretisationType discretisation, double surface_level, boost::hana::tuple<Region<Providers>...> const& regions,
    Constraints constraints, LoadHistory loads, Executor& executor, Attached attached = {}) {
  RegionMaterials<Providers...> materials(discretisation, surface_level, regions,
                                          [&](int point) { return owns_point(executor, point); });
  return {std::move(discretisation), std::move(materials), std::move(constraints), std::move(loads), executor,
          std::move(attached)};
}

}  // namespace scarp
