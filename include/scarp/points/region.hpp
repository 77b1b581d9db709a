// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/points/material_points.hpp"

namespace scarp {

/// A named region and the material of its points.
template <CheckedMaterial MaterialType>
struct Region {
  std::string name;       ///< of the region in the mesh
  MaterialType provider;  ///< response of the region's points
};

template <class MaterialType>
Region(std::string, MaterialType) -> Region<MaterialType>;

/// Points of several regions; a site's region is the number of its name in `names`.
/// volumes [m3]: weights of means, empty where no region has means; owned(number of a point): whether this process
/// evaluates it
/// \throws InputError for a region that has no name here, is given twice or has no material, and for counts that differ
template <int Dim>
MaterialPoints<Dim> points_of_regions(std::vector<Region<AnyProvider<Dim>>> const& regions,
                                      std::span<std::string const> names, std::span<Site<Dim> const> sites,
                                      std::span<double const> volumes, std::function<bool(int)> const& owned) {
  std::vector<AnyProvider<Dim>> materials;
  std::vector<int> numbers(names.size(), -1);
  for (auto const& region : regions) {
    auto const named = std::ranges::find(names, region.name);
    if (named == names.end())
      reject("there is no region '{}' (the mesh has: {}): use one of these names", region.name, listed(names));
    int& number = numbers[static_cast<std::size_t>(named - names.begin())];
    if (number >= 0) reject("region '{}' is given two materials (only one can respond): leave one out", region.name);
    number = detail::count(materials);
    materials.push_back(region.provider);
  }
  std::vector<int> material_of;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    int const region = sites[k].region;
    if (region < 0 || region >= std::ssize(numbers) || numbers[detail::index(region)] < 0) {
      reject("region '{}' of the mesh has no material (point {} lies in it): add a Region of this name",
             region < 0 || region >= std::ssize(names) ? std::to_string(region) : names[detail::index(region)], k);
    }
    material_of.push_back(numbers[detail::index(region)]);
  }
  return {std::move(materials), material_of, sites, volumes, owned};
}

/// Points of several regions, of different types.
template <int Dim, class... Materials>
MaterialPoints<Dim> points_of_regions(boost::hana::tuple<Region<Materials>...> const& regions,
                                      std::span<std::string const> names, std::span<Site<Dim> const> sites,
                                      std::span<double const> volumes, std::function<bool(int)> const& owned) {
  static_assert(((Materials::dim == Dim) && ...), "scarp: all materials have the dimension of the points");
  std::vector<Region<AnyProvider<Dim>>> list;
  boost::hana::for_each(regions, [&](auto const& region) { list.push_back({region.name, region.provider}); });
  return points_of_regions<Dim>(list, names, sites, volumes, owned);
}

}  // namespace scarp
