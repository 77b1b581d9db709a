// SPDX-License-Identifier: BSL-1.0
#include "../specimen.hpp"
#include "scarp/bvp/default_grid.hpp"
#include "scarp/bvp/pore_water.hpp"
#include "scarp/mesh/box_mesh.hpp"

namespace biaxial_specimen {

namespace {

/// Pores full of water that flows within the specimen and does not leave it.
template <class ElementType>
struct Undrained {
  using Element = ElementType;
  using Grid = scarp::DefaultGrid<Element>;
  using Lateral = scarp::FollowingPressure<typename Element::Facet>;
  using Water = scarp::PoreWater<Grid, scarp::KozenyCarman>;
  static constexpr bool have_water = true;

  /// A specimen without a file.
  static scarp::Mesh<Element> own_mesh(Choice const& choice) {
    return scarp::BoxMesh<Element>{.lengths = {choice.width, choice.height}, .cells = {choice.columns, choice.rows}}
        .generate();
  }

  static Water field(Choice const& choice, Grid const& grid, scarp::MaterialPoints<2> const& points) {
    auto const up = [](auto const& node) { return node.y(); };
    auto const [low, high] = std::ranges::minmax(grid.nodes(), {}, up);
    double void_ratio = 0.0;
    double shear_modulus = 0.0;
    for (int point = 0; point < points.size(); ++point) {
      for (auto const& [quantity, value] : points.quantities(point))
        if (quantity == "void_ratio") void_ratio += value / points.size();
      shear_modulus += points.committed_tangent(point)(2, 2) / points.size();
    }
    double const end = choice.steps * choice.axial_strain_step;
    scarp::WaterAtRest rest;
    rest.level = up(high) + choice.pore_pressure / rest.unit_weight;
    return {grid,
            {.grain = choice.grain_diameter},
            {.shear_modulus = shear_modulus,
             .void_ratio = void_ratio,
             .clock = scarp::TimeFunction({{0.0, 0.0}, {end, end * (up(high) - up(low)) / choice.rate}}),
             .at_rest = rest}};
  }

  /// Volume average [Pa], over elements that have the mean of their corners.
  template <class Problem>
  static double mean_excess_pressure(Problem const& problem) {
    auto const& grid = problem.discretisation();
    auto const pressures = problem.template attached<Water>().pressures();
    auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
    constexpr int corners = scarp::LinearOf<Element>::nodes;
    double sum = 0.0;
    double volume = 0.0;
    for (std::size_t point = 0; point < volumes.size(); ++point) {
      auto const& element = grid.mesh().elements[point / Grid::points_per_element];
      for (std::size_t a = 0; a < corners; ++a)
        sum += volumes[point] * pressures[static_cast<std::size_t>(element[a])] / corners;
      volume += volumes[point];
    }
    return sum / volume;
  }
};

}  // namespace

int run_undrained(Choice const& choice) { return run_with<Undrained<scarp::Quad8>>(choice); }

}  // namespace biaxial_specimen
