// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <boost/hana/at.hpp>
#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/loads.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/material_field.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/solver/equilibrium_problem.hpp"

namespace scarp {

/// A named region of the mesh and the provider of its points.
template <CheckedProvider ProviderType>
struct Region {
  using Provider = ProviderType;

  std::string name;
  Provider provider;
};

template <class Provider>
Region(std::string, Provider) -> Region<Provider>;

/// The material side of a model of several regions, each with its own type of provider: this is where they meet.
template <CheckedProvider... Providers>
class SCARP_EXPORT RegionMaterials {
 public:
  static constexpr int dim = std::common_type_t<std::integral_constant<int, Providers::dim>...>::value;
  static_assert(((Providers::dim == dim) && ...), "all regions of a scene have the same dimension");

  /// surface_level [m]: height of the ground surface, from which depths are measured; owned(point): points that are asked
  /// in this process
  /// \throws InputError for a region that the mesh does not have, one given twice, or one of the mesh without provider
  template <class Element, class Motion, class Scheme, class Owned>
  RegionMaterials(Discretisation<Element, Motion, Scheme> const& discretisation, double surface_level,
                  boost::hana::tuple<Region<Providers>...> const& regions, Owned const& owned)
      : where_(detail::index(discretisation.point_count())),
        fields_(make_fields(discretisation, surface_level, regions, owned, std::index_sequence_for<Providers...>{})) {
    for (std::size_t point = 0; point < where_.size(); ++point) {
      if (where_[point].field >= 0) continue;
      int const region = discretisation.site(static_cast<int>(point), surface_level).region;
      refuse("region '{}' of the mesh has no provider (point {} lies in it): add a Region of this name",
             discretisation.mesh().regions[detail::index(region)], point);
    }
  }

  template <class DiscretisationType>
  RegionMaterials(DiscretisationType const& discretisation, double surface_level,
                  boost::hana::tuple<Region<Providers>...> const& regions)
      : RegionMaterials(discretisation, surface_level, regions, [](int) { return true; }) {}

  int point_count() const { return detail::count(where_); }

  /// Calls visit(field, local point) with the provider field that a point belongs to.
  template <class Visit>
  void visit(int point, Visit&& visit) const {
    visit_in(fields_, point, visit);
  }
  template <class Visit>
  void visit(int point, Visit&& visit) {
    visit_in(fields_, point, visit);
  }

  void plan(int point, Gradient<dim> const& predicted) {
    visit(point, [&](auto& field, int local) { field.plan(local, predicted); });
  }
  void refine_plan(int point) {
    visit(point, [](auto& field, int local) { field.refine_plan(local); });
  }
  Response<dim> respond(int point, Gradient<dim> const& increment) {
    Response<dim> response;
    visit(point, [&](auto& field, int local) { response = field.respond(local, increment); });
    return response;
  }
  long work(int point) const {
    long work = 0;
    visit(point, [&](auto const& field, int local) { work = field.work(local); });
    return work;
  }
  VoigtStress<dim> committed_stress(int point) const {
    VoigtStress<dim> stress;
    visit(point, [&](auto const& field, int local) { stress = field.committed_stress(local); });
    return stress;
  }
  VoigtTangent<dim> committed_tangent(int point) const {
    VoigtTangent<dim> tangent;
    visit(point, [&](auto const& field, int local) { tangent = field.committed_tangent(local); });
    return tangent;
  }
  VoigtTangent<dim> trial_tangent(int point) const {
    VoigtTangent<dim> tangent;
    visit(point, [&](auto const& field, int local) { tangent = field.trial_tangent(local); });
    return tangent;
  }
  void commit() {
    boost::hana::for_each(fields_, [](auto& field) { field.commit(); });
  }

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(where_, fields_);
    boost::hana::for_each(self.fields_, [&](auto& field) { visit("region", field); });
  }

 private:
  struct Place {
    int field = -1;
    int local = -1;
  };

  /// Every field is told its number: in which order they are made is up to the compiler.
  template <class DiscretisationType, class Owned, std::size_t... Numbers>
  boost::hana::tuple<ProviderField<Providers>...> make_fields(DiscretisationType const& discretisation,
                                                              double surface_level,
                                                              boost::hana::tuple<Region<Providers>...> const& regions,
                                                              Owned const& owned, std::index_sequence<Numbers...>) {
    return boost::hana::make_tuple(make_field(discretisation, surface_level, boost::hana::at_c<Numbers>(regions), owned,
                                              static_cast<int>(Numbers))...);
  }

  template <class DiscretisationType, class Provider, class Owned>
  ProviderField<Provider> make_field(DiscretisationType const& discretisation, double surface_level,
                                     Region<Provider> const& region, Owned const& owned, int field) {
    int const number = region_number(discretisation.mesh(), region.name);
    std::vector<Site<dim>> sites;
    for (int point = 0; point < discretisation.point_count(); ++point) {
      auto const site = discretisation.site(point, surface_level);
      if (site.region != number) continue;
      if (where_[detail::index(point)].field >= 0) {
        refuse("region '{}' is given two providers (only one can answer): leave one out", region.name);
      }
      where_[detail::index(point)] = {field, detail::count(sites)};
      sites.push_back(site);
    }
    return ProviderField<Provider>(region.provider, sites, owned);
  }

  template <class Fields, class Visit>
  void visit_in(Fields& fields, int point, Visit& visit) const {
    Place const place = where_[detail::index(point)];
    int number = 0;
    boost::hana::for_each(fields, [&](auto& field) {
      if (number++ == place.field) visit(field, place.local);
    });
  }

  std::vector<Place> where_;
  boost::hana::tuple<ProviderField<Providers>...> fields_;
};

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
template <class DiscretisationType, ExecutesTasks Executor,
          AttachmentOrNone<DiscretisationType::dim> Attached = NoAttachment, class... Providers>
SceneProblem<DiscretisationType, Executor, Attached, Providers...> make_problem(
    DiscretisationType discretisation, double surface_level, boost::hana::tuple<Region<Providers>...> const& regions,
    Constraints constraints, LoadHistory loads, Executor& executor, Attached attached = {}) {
  std::optional<typename SceneMaterials<Providers...>::Type> materials;
  together(executor, [&] {
    materials.emplace(SceneMaterials<Providers...>::make(discretisation, surface_level, regions,
                                                         [&](int point) { return owns_point(executor, point); }));
  });
  return {std::move(discretisation), std::move(*materials), std::move(constraints), std::move(loads), executor,
          std::move(attached)};
}

}  // namespace scarp
