// SPDX-License-Identifier: BSL-1.0
#include "../../examples/shared/elastic_solve.hpp"
#include "../../examples/shared/field_error.hpp"

#include <cmath>
#include <numbers>

#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "subjects.hpp"
#include "sweep.hpp"

namespace error_vs_time {

namespace {

/// A column between smooth walls whose unit weight grows and falls over the height,
/// \f$ \gamma = \gamma_0 (1 + \sin(\pi y / H)) \f$; with the top free and the constrained modulus M,
/// \f$ M u'' = \gamma \f$: \f$ M u' = -\gamma_0 (H - y + (H/\pi)(1 + \cos(\pi y/H))) \f$. No element holds that.
struct Column {
  static constexpr double height = 4.0;        ///< [m]
  static constexpr double width = 2.0;         ///< [m]
  static constexpr double unit_weight = 20e3;  ///< [N/m3]
  scarp::LinearElastic<2> solid = scarp::LinearElastic<2>::from_young_poisson(10e6, 0.3);

  double modulus() const { return solid.elasticity.lame_lambda + 2.0 * solid.elasticity.shear_modulus; }
  static double weight(double y) { return unit_weight * (1.0 + std::sin(std::numbers::pi * y / height)); }
  /// Vertical stress [Pa].
  static double stress(double y) {
    double const k = std::numbers::pi / height;
    return -unit_weight * (height - y + (1.0 + std::cos(k * y)) / k);
  }
  double settlement(double y) const {
    double const k = std::numbers::pi / height;
    return unit_weight / modulus() * (height * y - y * y / 2.0 + (y + std::sin(k * y) / k) / k);
  }
  /// Force on the left wall [N], \f$ \lambda/M \int \sigma_{yy} dy \f$.
  double wall_force() const {
    double const k = std::numbers::pi / height;
    double const integral = unit_weight * (height * height / 2.0 + height / k);
    return solid.elasticity.lame_lambda / modulus() * integral;
  }
};

enum class Kind { tri3, tri6, quad4, quad8 };

struct ColumnSettings {
  Kind element = Kind::quad4;
  int cells = 8;  ///< over the width, twice as many over the height
};

/// Bends the grid lines by up to a twentieth of the width, so that the mesh does not fit the solution.
scarp::Vector<2> bent(scarp::Vector<2> const& place) {
  double const bump = 0.05 * Column::width * std::sin(std::numbers::pi * place.x() / Column::width) *
                      std::sin(std::numbers::pi * place.y() / Column::height);
  return place + bump * scarp::Vector<2>(1.0, -0.7);
}

template <class Element>
Measured settle(ColumnSettings const& settings) {
  Column const column;
  auto const mesh =
      scarp::BoxMesh<Element>{
          .lengths = {Column::width, Column::height}, .cells = {settings.cells, 2 * settings.cells}, .map = bent}
          .generate();
  scarp::Discretisation<Element, scarp::SmallStrain, scarp::FullIntegration> const grid(mesh);
  scarp::Constraints constraints(mesh);
  for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
  for (auto const* side : {"left", "right"})
    for (int const node : boundary_nodes(mesh, side)) constraints.fix(node, 0);
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(grid.dof_count());
  auto const loads = examples::varying_body_force(
      grid, [](scarp::Vector<2> const& x) { return scarp::Vector<2>(0.0, -Column::weight(x.y())); });
  auto const found = examples::elastic_solve(grid, column.solid, constraints, still, loads);

  auto const exact = [&](scarp::Vector<2> const& x) { return scarp::Vector<2>(0.0, -column.settlement(x.y())); };
  auto const exact_gradient = [&](scarp::Vector<2> const& x) {
    scarp::Gradient<2> gradient = scarp::Gradient<2>::Zero();
    gradient(1, 1) = Column::stress(x.y()) / column.modulus();
    return gradient;
  };
  auto const error = examples::field_error(mesh, found, exact, exact_gradient);
  auto const size = examples::field_error(mesh, still, exact, exact_gradient);
  std::vector<scarp::VoigtTangent<2>> const tangents(static_cast<std::size_t>(grid.point_count()),
                                                     column.solid.tangent({}));
  std::vector<scarp::VoigtStress<2>> const unstressed(tangents.size(), scarp::VoigtStress<2>::Zero());
  Eigen::VectorXd const forces = grid.stiffness(still, unstressed, tangents) * found - loads;
  double wall = 0.0;
  for (int const node : boundary_nodes(mesh, "left")) wall += forces(2 * node);
  Measured measured;
  // The distance from the exact field stands across it: its norm over the field's is the relative error.
  measured.add("displacement", Eigen::Vector2d(size.value, error.value));
  measured.add("strain", Eigen::Vector2d(size.gradient, error.gradient));
  measured.add("wall force", wall);
  return measured;
}
/// The norms of the exact field, which every mesh integrates a little differently, from a fine one.
Measured exact_response() {
  constexpr int fine = 64;
  auto measured = settle<scarp::Tri3>({.cells = fine});
  for (auto& [name, values] : measured.responses) {
    if (values.size() == 2) values(1) = 0.0;
    if (values.size() == 1) values(0) = Column{}.wall_force();
  }
  return measured;
}

SweepTable elastic_column(Options const& options) {
  int const levels = options.quick ? 3 : 5;
  Sweep sweep("elastic column", ColumnSettings{}, [](ColumnSettings const& settings) {
    switch (settings.element) {
      case Kind::tri3: return settle<scarp::Tri3>(settings);
      case Kind::tri6: return settle<scarp::Tri6>(settings);
      case Kind::quad4: return settle<scarp::Quad4>(settings);
      case Kind::quad8: break;
    }
    return settle<scarp::Quad8>(settings);
  });
  sweep.exact(exact_response());
  std::vector<double> sizes;
  for (int k = 0; k < levels; ++k) sizes.push_back(1.0 / std::exp2(k + 1));
  std::pair<char const*, Kind> const kinds[] = {
      {"Tri3", Kind::tri3}, {"Tri6", Kind::tri6}, {"Quad4", Kind::quad4}, {"Quad8", Kind::quad8}};
  for (auto const& [name, kind] : kinds) {
    sweep.vary(
        fmt::format("{}, cell over width", name),
        [kind = kind](ColumnSettings& settings, double size) {
          settings.element = kind;
          settings.cells = static_cast<int>(std::lround(1.0 / size));
        },
        sizes);
  }
  return sweep.run(options.repetitions_or(3));
}

bool const registered = register_subject({.name = "elastic_column",
                                          .question = "which element and mesh reproduce an elastic column?",
                                          .run = elastic_column});

}  // namespace

}  // namespace error_vs_time
