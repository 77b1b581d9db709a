// SPDX-License-Identifier: BSL-1.0
// Two species of grains in one packing, sand and rubber, with a contact law for each pair.
#include "scarp/contact/law_per_species.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/rve/perturbation_tangent.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/with_species.hpp"

#include "lattice.hpp"

int main() {
  using Shape = scarp::WithSpecies<scarp::Disc, 2>;
  using Law = scarp::LawPerSpecies<scarp::LinearFrictional, 2>;
  using Grains = scarp::Packing<Shape, Law>;

  // The springs of two grains stand in series: k = 2 k1 k2 / (k1 + k2) between them, k1 and k2 among their like.
  double const sand = 6e6, rubber = 1e6, between = 2.0 * sand * rubber / (sand + rubber), friction = 0.5;
  Law law;
  law.between(1, 1) = {sand, sand, friction};
  law.between(1, 2) = {between, between, friction};  // and 2 with 1
  law.between(2, 2) = {rubber, rubber, friction};

  // A square lattice whose columns are sand, sand, rubber, rubber; the last number of a grain's size is its species.
  double const radius = 5e-3, spacing = 2.0 * radius - 1e-6;
  auto grains = tutorials::lattice<Grains>({radius, 1.0}, {spacing, spacing});
  std::vector<Shape::Size<double>> sizes;
  for (std::size_t i = 0; i < grains.grain_count(); ++i) sizes.push_back({radius, i % 4 < 2 ? 1.0 : 2.0});
  grains.population = std::make_shared<scarp::Population<Shape> const>(sizes, 2650.0, 1.0);

  // Uniform strain: the springs of all contacts side by side, per thickness of 1 m.
  scarp::TimeStepper<Grains> stepper;
  bool good = stepper.refresh(grains, law).acceptable();
  auto const uniform = scarp::contact_tangent(grains, law);
  good &= tutorials::agree("uniform strain, along x [Pa]", uniform(0, 0), (sand + rubber + 2.0 * between) / 4.0, 1e-3);
  good &= tutorials::agree("uniform strain, along y [Pa]", uniform(3, 3), (sand + rubber) / 2.0, 1e-3);

  // Grains that find their balance: along x the springs of a row stand in series, along y columns side by side.
  auto const balanced = scarp::PerturbationTangent<>{.strain = 1e-6}(grains, law);
  good &= tutorials::agree("modulus along x [Pa]", balanced(0, 0), between, 1e-3);
  good &= tutorials::agree("modulus along y [Pa]", balanced(1, 1), (sand + rubber) / 2.0, 1e-3);
  return good ? 0 : 1;
}
