// SPDX-License-Identifier: BSL-1.0
// User-defined source of packings, one for each point: a lattice whose overlap grows with depth and varies at random.
#include "scarp/bvp/default_grid.hpp"
#include "scarp/constitutive/correlated_field.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/shape/disc.hpp"

#include "lattice.hpp"

using Grains = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
constexpr scarp::LinearFrictional law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.5};

/// The packing that a point starts with; here its pressure is gamma z (1 + 0.2 X), X a random field of unit variance.
/// RandomPackings{recipe, seed} does the same with packings that are prepared from a cloud.
struct LatticeByDepth {
  scarp::CorrelatedField<2> field{{.lengths = {2.0, 0.5}, .seed = 7}};
  double unit_weight = 16e3;  // [N/m3]

  double pressure(scarp::Site<2> const& site) const {
    return unit_weight * site.depth * (1.0 + 0.2 * field(site.position));
  }
  Grains at(scarp::Site<2> const& site) const {
    double const radius = 5e-3, wanted = pressure(site);  // k u / d = p with d = 2 r - u
    double const overlap = 2.0 * radius * wanted / (law.normal_stiffness + wanted);
    double const spacing = 2.0 * radius - overlap;
    return tutorials::lattice<Grains>({radius}, {spacing, spacing});
  }
};
static_assert(scarp::PackingSource<LatticeByDepth, Grains>);

int main() {
  double const height = 2.0;
  auto const mesh = scarp::BoxMesh<scarp::Quad4>{.lengths = {4.0, height}, .cells = {4, 2}}.generate();
  scarp::DefaultGrid<scarp::Quad4> const grid(mesh);
  LatticeByDepth const source;
  scarp::DemRve<Grains, LatticeByDepth> const sand{.law = law, .source = source};
  bool good = true;
  double lowest = 1e300, highest = 0.0;  // of what the random field makes of gamma z
  for (int point = 0; point < grid.point_count(); ++point) {
    auto const site = grid.site(point, height);  // a scene with Region{"soil", sand} makes its states likewise
    double const found = -sand.stress(sand.initial_state(site))(1);
    double const share = found / (source.unit_weight * site.depth);
    lowest = std::min(lowest, share);
    highest = std::max(highest, share);
    good &= std::abs(found / source.pressure(site) - 1.0) < 1e-9;
  }
  fmt::print("{} points, pressure over that of the depth from {:.3f} to {:.3f}\n", grid.point_count(), lowest, highest);
  return good && highest - lowest > 0.1 ? 0 : 1;
}
