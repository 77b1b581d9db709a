// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "scarp/bvp/default_grid.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/solver/detail/ground_top.hpp"
#include "scarp/solver/make_problem.hpp"

namespace scarp {

/// A boundary-value problem as it is written down: boundaries held and loaded by name, materials by region, weight.
/// \code
/// Model model(read_gmsh<Tri6>("slope.msh"));
/// model.fix({"left", "right"}, 0);
/// model.fix({"bottom"}, 1);
/// model.gravity(18e3);
/// model.material("soil", LinearElastic<2, GeostaticStress<2>>::from_young_poisson(50e6, 0.3, model.geostatic(0.5)));
/// Analysis analysis(model);
/// RunReport const run = analysis.to(1.0);
/// \endcode
/// The materials' initial stresses need not balance the loads: what is missing is held by forces which fade while the
/// load factor goes from 0 to 1, and the loads grow meanwhile. That is how ground is balanced, and how it is excavated:
/// give the mesh without what is taken away, and the stress that was there. Then the load factor drives what has an
/// amplitude of its own.
template <int Dim>
class SCARP_EXPORT Model {
 public:
  static constexpr int dim = Dim;                         ///< of space
  using Names = std::initializer_list<std::string_view>;  ///< of boundaries or regions

  /// Elements, kinematics and integration of the program's choice.
  explicit Model(std::unique_ptr<Grid<Dim>> grid);
  /// Elements, kinematics and integration of the program's choice, by value.
  /// \throws InputError for elements that do not copy themselves
  template <std::derived_from<Grid<Dim>> GridType>
  explicit Model(GridType grid) : Model(std::make_unique<GridType>(std::move(grid))) {
    auto const copy = grid_->copy();
    if (auto const& own = *copy; typeid(own) != typeid(GridType))
      reject("the elements of a model are copied as another type (their class has no copy() of its own): override it");
  }
  /// Updated Lagrangian elements with their default integration; thickness [m] out of the plane.
  template <class Element>
  explicit Model(Mesh<Element> mesh, double thickness = 1.0)
      : Model(DefaultGrid<Element>(std::move(mesh), thickness)) {}

  Grid<Dim> const& grid() const { return *grid_; }  ///< Mesh and elements.

  /// Height [m] from which depths are measured: that of the highest node unless it was set.
  double surface_level() const {
    if (level_) return *level_;
    auto const above = [](auto const& a, auto const& b) { return a(dim - 1) < b(dim - 1); };
    return (*std::ranges::max_element(grid_->nodes(), above))(dim - 1);
  }
  /// Sets that height [m], also above the mesh, where the former surface is taken away.
  void set_surface_level(double height) { level_ = require_finite("level of the ground surface", height); }

  /// Where the material points of a region are, of all without a name.
  /// \throws InputError for an unknown region
  std::vector<Site<Dim>> sites(std::string_view region = {}) const;
  std::vector<Site<Dim>> sites(Names) const = delete;  // two names in braces would be read as one
  /// Their depths [m].
  /// \throws InputError for an unknown region, and for ground that is highest in one place only where no level was set
  std::vector<double> depths(std::string_view region = {}) const;
  std::vector<double> depths(Names) const = delete;

  /// Holds boundaries along an axis.
  /// \throws InputError for an unknown boundary or axis
  void fix(Names sides, int axis) { move(sides, axis, 0.0); }
  /// Holds boundaries along all axes.
  /// \throws InputError for an unknown boundary
  void fix(Names sides) {
    Constraints all = constraints_;  // a rejected call changes nothing
    for (auto const side : sides)
      for (int const node : grid_->boundary_nodes(side)) all.fix(node);
    constraints_ = std::move(all);
  }
  /// Moves boundaries along an axis by rate [m] times the growth of `amplitude` since the load factor 0.
  /// \throws InputError for an unknown boundary or axis, and nodes that are moved in another way already
  void move(Names sides, int axis, double rate, TimeFunction const& amplitude = {});

  /// Any provider, or a `Nonlocal` one, for the points of a region.
  template <CheckedMaterial MaterialType>
    requires(MaterialType::dim == dim)
  void material(std::string_view region, MaterialType const& of_points) {
    regions_.push_back({std::string(region), of_points});
  }
  /// The same for several regions.
  template <CheckedMaterial MaterialType>
    requires(MaterialType::dim == dim)
  void material(Names regions, MaterialType const& of_points) {
    for (auto const region : regions) material(region, of_points);
  }

  /// A field on the elements, as it is now, such as a `PoreWater`.
  /// \throws InputError for a second one
  template <FieldAttachment Field>
  void attach(Field const& field) {
    if (field_) reject("a second field is attached to the model (it can have one): leave one out");
    field_ = [field] { return std::make_unique<detail::AttachedFieldOf<dim, Field>>(field); };
  }

  /// Weight of all regions [N/m3], downwards along the last axis.
  /// \throws InputError after the stress at rest was taken
  void gravity(double unit_weight) {
    require_not_at_rest();
    std::ranges::fill(weights_, require_not_negative("unit weight", unit_weight));
  }
  /// Weight of regions [N/m3].
  /// \throws InputError for an unknown region, and after the stress at rest was taken
  void gravity(Names regions, double unit_weight) {
    require_not_at_rest();
    require_not_negative("unit weight", unit_weight);
    auto weights = weights_;  // a rejected call changes nothing
    for (auto const region : regions) weights[detail::index(region_number(*grid_, region))] = unit_weight;
    weights_ = std::move(weights);
  }
  /// Weight of one region [N/m3], as above.
  void gravity(std::string_view region, double unit_weight) { gravity(Names{region}, unit_weight); }
  /// Force per area [Pa] on boundaries of the initial mesh, grown to its full size at the load factor 1, or with an
  /// amplitude.
  /// \throws InputError for an unknown boundary
  void traction(Names sides, Vector<Dim> const& per_area, std::optional<TimeFunction> const& amplitude = {});
  /// Vertical pressure [Pa], downwards along the last axis, on boundaries of the initial mesh, as a traction.
  /// \throws InputError for an unknown boundary, and without amplitude after the stress at rest was taken
  void surcharge(Names sides, double pressure, std::optional<TimeFunction> const& amplitude = {}) {
    if (!amplitude) require_not_at_rest();
    require_finite("surcharge", pressure);
    Vector<dim> downwards = Vector<dim>::Zero();
    downwards(dim - 1) = -pressure;
    traction(sides, downwards, amplitude);
    if (amplitude) return;
    for (auto const side : sides) surcharges_[std::string(side)] += pressure;
  }

  /// Stress of level ground at rest, of one unit weight below one surcharge: those of a region, or of all, and of the
  /// whole surface. Others belong to the material itself.
  /// \throws InputError for an unknown region, one without weight or below another unit weight, several of different
  /// weights without a name, surcharges that differ or press on a part of the surface, and ground that is highest in
  /// one place only where no level was set
  GeostaticStress<Dim> geostatic(double k0, std::string_view region = {}) const;
  GeostaticStress<Dim> geostatic(double, Names) const = delete;

  /// Weight and surcharges [N], shape (dof_count), without those that have an amplitude of their own.
  Eigen::VectorXd dead_loads() const;
  /// External forces [N] by load factor, without those that hold what the initial stresses leave unbalanced.
  /// of_dead_loads: amplitude of weight and surcharges
  LoadHistory external_loads(TimeFunction const& of_dead_loads) const;

  /// For solvers. The executor outlives the problem.
  /// \throws InputError when the parts do not fit together
  Problem<Dim> problem(Executor& executor) const;

 private:
  void require_not_at_rest() const {
    if (is_at_rest_)
      reject("weight or surcharge are given after the stress at rest was taken: give them before, or an amplitude");
  }

  std::unique_ptr<Grid<Dim>> grid_;
  Constraints constraints_;
  std::vector<Region<AnyProvider<dim>>> regions_;
  std::vector<double> weights_;               ///< of the regions [N/m3]
  std::map<std::string, double> surcharges_;  ///< of the sides [Pa], without those with an amplitude
  mutable bool is_at_rest_ = false;           ///< whether the stress at rest was taken
  std::vector<Eigen::VectorXd> tractions_;
  LoadHistory later_;  ///< with amplitudes of their own
  std::optional<double> level_;
  std::function<std::unique_ptr<detail::AttachedField<dim>>()> field_;
};

// Outside of the class, so that a library can contain them.

template <int Dim>
Model<Dim>::Model(std::unique_ptr<Grid<Dim>> grid)
    : grid_(detail::present(std::move(grid))), constraints_(*grid_), weights_(grid_->regions().size()) {}

template <int Dim>
std::vector<Site<Dim>> Model<Dim>::sites(std::string_view region) const {
  int const number = region.empty() ? -1 : region_number(*grid_, region);
  double const level = surface_level();
  std::vector<Site<dim>> found;
  for (int point = 0; point < grid_->point_count(); ++point) {
    auto const site = grid_->site(point, level);
    if (number < 0 || site.region == number) found.push_back(site);
  }
  return found;
}

template <int Dim>
GeostaticStress<Dim> Model<Dim>::geostatic(double k0, std::string_view region) const {
  detail::GroundTop<Dim> const top(*grid_, surface_level());
  if (!level_) top.require_level();
  double const weight = top.weight(weights_, region);
  double const surcharge = top.surcharge(surcharges_);
  is_at_rest_ = true;
  return {.surcharge = surcharge, .unit_weight = weight, .k0 = k0};
}

template <int Dim>
std::vector<double> Model<Dim>::depths(std::string_view region) const {
  if (!level_) detail::GroundTop<Dim>(*grid_, surface_level()).require_level();
  std::vector<double> found;
  for (auto const& site : sites(region)) found.push_back(site.depth);
  return found;
}

template <int Dim>
void Model<Dim>::move(Names sides, int axis, double rate, TimeFunction const& amplitude) {
  Constraints all = constraints_;  // a rejected call changes nothing
  for (auto const side : sides)
    for (int const node : grid_->boundary_nodes(side)) all.move(node, axis, rate, amplitude);
  constraints_ = std::move(all);
}

template <int Dim>
void Model<Dim>::traction(Names sides, Vector<Dim> const& per_area, std::optional<TimeFunction> const& amplitude) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(grid_->dof_count());
  for (auto const side : sides) {
    if (std::ranges::count(sides, side) > 1)
      reject("the boundary '{}' is named twice in one call (its load would double): name it once", side);
    forces += grid_->traction(side, per_area);
  }
  if (amplitude) {
    later_.add(std::move(forces), *amplitude);
  } else {
    tractions_.push_back(std::move(forces));
  }
}

template <int Dim>
Eigen::VectorXd Model<Dim>::dead_loads() const {
  Eigen::VectorXd forces = grid_->body_force(
      [&](int region) -> Vector<dim> { return -weights_[detail::index(region)] * Vector<dim>::Unit(dim - 1); });
  for (auto const& traction : tractions_) forces += traction;
  return forces;
}

template <int Dim>
LoadHistory Model<Dim>::external_loads(TimeFunction const& of_dead_loads) const {
  LoadHistory loads = later_;
  loads.add(dead_loads(), of_dead_loads);
  return loads;
}

template <int Dim>
Problem<Dim> Model<Dim>::problem(Executor& executor) const {
  std::optional<MaterialPoints<dim>> points;
  executor.together([&] { points.emplace(detail::points_at(*grid_, surface_level(), regions_, executor)); });
  detail::Attachments<dim> attached{nullptr, field_ ? field_() : nullptr};
  Eigen::VectorXd before;
  grid_->internal_force(Eigen::VectorXd::Zero(grid_->dof_count()), points->balanced_stresses(executor), before);
  if (attached.field) {
    Eigen::VectorXd const force = attached.field->ground_force();
    if (force.size() == before.size()) before += force;  // the problem rejects a field of another mesh
  }
  LoadHistory loads = later_;
  loads.add(before, TimeFunction({{0.0, 1.0}, {1.0, 0.0}}));
  loads.add(dead_loads(), TimeFunction::ramp(0.0, 1.0));
  Constraints constraints = constraints_;
  if (attached.field) {
    constraints.add_dofs(attached.field->extra_dofs());
    loads.add_dofs(attached.field->extra_dofs());
  }
  return {grid_->copy(), std::move(*points), std::move(constraints), std::move(loads), executor, std::move(attached)};
}

template <class Element>
Model(Mesh<Element>, double = 1.0) -> Model<Element::dim>;
template <class GridType>
Model(GridType) -> Model<GridType::dim>;

#ifdef SCARP_PRECOMPILED
extern template class Model<2>;
extern template class Model<3>;
#endif

}  // namespace scarp
