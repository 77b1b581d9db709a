// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <boost/hana/transform.hpp>

#include "scarp/constitutive/nonlocal_materials.hpp"
#include "scarp/core/index.hpp"
#include "scarp/scene/scene.hpp"
#include "scarp/solver/wide_equations.hpp"

namespace scarp {

namespace detail {

template <class Provider>
struct LocalPart {
  using Type = Provider;
  static Provider const& of(Provider const& provider) { return provider; }
  static Neighbourhood neighbourhood(Provider const&) { return {}; }
};
template <AsksForMeans Provider>
struct LocalPart<Provider> {
  using Type = typename Provider::LocalProvider;
  static Type const& of(Provider const& provider) { return provider.provider; }
  static Neighbourhood neighbourhood(Provider const& provider) {
    return {provider.length, provider.stiffness, provider.fading};
  }
};

}  // namespace detail

/// Materials of a scene in which a region is `Nonlocal`: the regions' local providers, and means within each region
/// that asks. Weights are those of the configuration in which the scene is made.
template <class... Providers>
  requires(AsksForMeans<Providers> || ...)
struct SceneMaterials<Providers...> {
  using Regions = RegionMaterials<typename detail::LocalPart<Providers>::Type...>;
  using Type = NonlocalMaterials<Regions>;

  /// Every process makes states for all points, since the stiffness against unseen strain follows from them, and keeps its own.
  template <class DiscretisationType, class Owned>
  static Type make(DiscretisationType const& discretisation, double surface_level,
                   boost::hana::tuple<Region<Providers>...> const& regions, Owned const& owned) {
    constexpr int dim = DiscretisationType::dim;
    auto const local = boost::hana::transform(regions, []<class Provider>(Region<Provider> const& region) {
      using Part = detail::LocalPart<Provider>;
      return Region<typename Part::Type>{region.name, Part::of(region.provider)};
    });
    Regions materials(discretisation, surface_level, local);
    std::vector<Neighbourhood> of_region(discretisation.mesh().regions.size());
    boost::hana::for_each(regions, [&]<class Provider>(Region<Provider> const& region) {
      of_region[detail::index(region_number(discretisation.mesh(), region.name))] =
          detail::LocalPart<Provider>::neighbourhood(region.provider);
    });
    std::vector<Site<dim>> sites;
    std::vector<Neighbourhood> neighbourhoods;
    for (int point = 0; point < discretisation.point_count(); ++point) {
      sites.push_back(discretisation.site(point, surface_level));
      neighbourhoods.push_back(of_region[detail::index(sites.back().region)]);
    }
    auto const volumes = discretisation.volumes(Eigen::VectorXd::Zero(discretisation.dof_count()));
    Type means(std::move(materials), sites, volumes, neighbourhoods);
    for (int point = 0; point < means.point_count(); ++point) {
      if (!owned(point)) means.visit(point, [](auto& field, int number) { field.forget(number); });
    }
    return means;
  }
};

}  // namespace scarp
