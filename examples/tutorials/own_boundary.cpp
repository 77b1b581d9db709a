// SPDX-License-Identifier: BSL-1.0
// User-defined boundary of a packing: plates whose grains follow the mean strain of the cell.
#include "scarp/contact/law_per_species.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/uniform_strain_rim.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/rve/perturbation_tangent.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/with_species.hpp"

#include "lattice.hpp"

using Shape = scarp::WithSpecies<scarp::Disc, 2>;
using Law = scarp::LawPerSpecies<scarp::LinearFrictional, 2>;
using Grains = scarp::Packing<Shape, Law>;

/// Every second column of a lattice is glued to a plate that follows the mean strain; the grains between are free.
struct Plates {
  /// Once a step, before the grains move: holds.hold(grain), or only holds.hold_centre(grain, axis),
  /// holds.hold_spin(grain).
  template <class PackingType>
  void constrain(PackingType const& packing, scarp::GrainHolds<PackingType> const& holds) const {
    for (std::size_t i = 0; i < packing.grain_count(); i += 2) holds.hold(i);
  }
};
static_assert(scarp::ConstrainsGrains<Plates, Grains>);

/// Modulus along x [Pa] of a packing whose grains have found their balance.
template <class Boundary>
double modulus(Grains const& grains, Law const& law, Boundary const& boundary) {
  scarp::PerturbationTangent<scarp::LocalDamping, Boundary> const tangent{.strain = 1e-6, .boundary = boundary};
  return tangent(grains, law)(0, 0);
}

int main() {
  // Springs a, b, c, b along each row: columns of stiff, stiff, soft, soft grains.
  double const a = 6e6, b = 2e6, c = 1e6, friction = 0.5, radius = 5e-3, spacing = 2.0 * radius - 1e-6;
  Law law;
  law.between(1, 1) = {a, a, friction};
  law.between(1, 2) = {b, b, friction};
  law.between(2, 2) = {c, c, friction};
  auto grains = tutorials::lattice<Grains>({radius, 1.0}, {spacing, spacing});
  std::vector<Shape::Size<double>> sizes;
  for (std::size_t i = 0; i < grains.grain_count(); ++i) sizes.push_back({radius, i % 4 < 2 ? 1.0 : 2.0});
  grains.population = std::make_shared<scarp::Population<Shape> const>(sizes, 2650.0, 1.0);

  // Free grains: four springs in series. Plates: between two of them a and b, or c and b, in series. All held: the
  // mean.
  double const in_series = 4.0 / (1.0 / a + 2.0 / b + 1.0 / c), mean = (a + 2.0 * b + c) / 4.0;
  double const between_plates = 1.0 / (1.0 / a + 1.0 / b) + 1.0 / (1.0 / c + 1.0 / b);
  bool good = tutorials::agree("modulus, periodic [Pa]", modulus(grains, law, scarp::Periodic{}), in_series, 1e-3);
  good &= tutorials::agree("modulus between plates [Pa]", modulus(grains, law, Plates{}), between_plates, 1e-3);
  scarp::UniformStrainRim const everywhere{.width = 4.0};
  good &= tutorials::agree("modulus, all grains held [Pa]", modulus(grains, law, everywhere), mean, 1e-3);

  // As a material.
  using Source = scarp::SamePacking<Grains>;
  using Tangent = scarp::AffineTangent;
  scarp::DemRve<Grains, Source, Tangent, scarp::LocalDamping, Plates> const soil{
      .law = law, .source = {grains}, .strain_per_step = 1e-8};
  auto const start = soil.initial_state({});
  auto trial = start;
  double const strain = 1e-5;
  auto const response = soil.respond(start, scarp::Gradient<2>{{-strain, 0.0}, {0.0, 0.0}}, trial);
  // At the start the grains are not in balance: what they relax by is that of a response without strain.
  auto still = start;
  auto const relaxed = soil.respond(start, scarp::Gradient<2>::Zero(), still, 1000);
  double const found = (relaxed.stress(0) - response.stress(0)) / strain;
  return tutorials::agree("modulus of the material [Pa]", found, between_plates, 1e-2) && good ? 0 : 1;
}
