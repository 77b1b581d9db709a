// SPDX-License-Identifier: BSL-1.0
#include "soil.hpp"

#include <cmath>
#include <set>

#include "../shared/study/soils.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/points/nonlocal.hpp"

namespace dealii_fault {

/// Points of any provider.
template <class Provider>
PointMaker points_of(Provider provider, double length) {
  return [soil = scarp::Nonlocal<Provider>{std::move(provider), length}](Sites const& sites,
                                                                         std::vector<double> const& volumes, int own) {
    return Points(soil, sites, volumes, [own](int point) { return point < own; });
  };
}

PointMaker soil_of(fault_rupture::Choice const& choice, Sites const& sites) {
  using fault_rupture::Soil;
  if (choice.soil == Soil::elastic) return points_of(fault_rupture::make_elastic_soil(choice), choice.length);
  if (choice.soil == Soil::mohr_coulomb) return points_of(fault_rupture::make_frictional_soil(choice), choice.length);
  return points_of(fault_rupture::make_sand(choice, sites), choice.length);
}

PointMaker stress_free_soil() {
  fault_rupture::Choice const choice;
  return points_of(scarp::LinearElastic<2>::from_young_poisson(choice.young_modulus, 0.25), 0.0);
}

std::array<std::vector<double>, 2> cell_lines(double size) {
  std::array<std::set<double>, 2> lines;
  for (auto const& node : scarp::FaultMesh{.size = size}.generate<scarp::Quad4>().nodes) {
    for (int axis = 0; axis < 2; ++axis)
      lines[static_cast<std::size_t>(axis)].insert(std::round(1e9 * node(axis)) / 1e9);
  }
  return {std::vector(lines[0].begin(), lines[0].end()), std::vector(lines[1].begin(), lines[1].end())};
}

}  // namespace dealii_fault
