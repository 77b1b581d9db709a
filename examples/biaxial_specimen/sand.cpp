// SPDX-License-Identifier: BSL-1.0
#include "sand.hpp"

#include <type_traits>
#include <variant>

#include "../shared/packing_input.hpp"
#include "../shared/study/study_sand.hpp"
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/random_packings.hpp"
#include "scarp/io/packings/contact_reader.hpp"
#include "scarp/shape/disc.hpp"

namespace biaxial_specimen {

namespace {

template <class Shape>
using PackingOf = scarp::Packing<Shape, scarp::LinearFrictional>;
template <class Shape>
using Pool = scarp::RandomChoice<scarp::SamePacking<PackingOf<Shape>>>;
template <class Shape>
using FieldOf = scarp::ProviderField<scarp::DemRve<PackingOf<Shape>, Pool<Shape>>>;
using AnyField = std::variant<FieldOf<scarp::Disc>, FieldOf<scarp::Ellipse>>;

template <class Shape>
AnyField field(Grains const& grains, double pressure, scarp::LinearFrictional const& law, Pool<Shape> pool,
               std::span<scarp::Site<2> const> sites) {
  return FieldOf<Shape>({.law = law,
                         .source = std::move(pool),
                         .strain_per_step = grains.strain_per_dem_step,
                         .loose_pressure = pressure / 100.0},
                        sites);
}

AnyField prepared(Grains const& grains, double pressure, std::span<scarp::Site<2> const> sites,
                  scarp::ThreadExecutor& executor) {
  auto const law = examples::study_law();
  auto cloud = examples::study_cloud(grains.prepared, grains.seed);
  cloud.density = grains.density;
  cloud.thickness = grains.thickness;
  scarp::IsotropicRecipe<PackingOf<scarp::Ellipse>, scarp::EllipseGrading> const recipe{
      .cloud = cloud,
      .preparation = {.pressure = pressure, .preparation_friction = grains.preparation_friction},
      .law = law};
  int const most = std::min(grains.pool, static_cast<int>(sites.size()));
  return field<scarp::Ellipse>(grains, pressure, law, scarp::RandomPackings{recipe, grains.seed}.pool(most, executor),
                               sites);
}

template <class Shape>
AnyField read(Grains const& grains, double pressure, examples::PackingInput const& input,
              scarp::LinearFrictional const& law, std::span<scarp::Site<2> const> sites) {
  constexpr double tolerance = 1e-6;  // of the file's overlaps against the packing's, over the smallest radius
  auto named = scarp::read_packing<PackingOf<Shape>>(input.particles, input.cell, grains.density, grains.thickness);
  if (input.contacts && input.contacts->has("ftx")) scarp::read_contacts(named, *input.contacts, law, tolerance);
  return field<Shape>(grains, pressure, law, {{{std::move(named.packing)}}}, sites);
}

AnyField any_field(Grains const& grains, double pressure, std::span<scarp::Site<2> const> sites,
                   scarp::ThreadExecutor& executor) {
  if (grains.particles.empty()) return prepared(grains, pressure, sites, executor);
  auto const input = examples::read_packing_input(grains.particles, grains.contacts, grains.cell);
  auto const of_contacts = [&](std::string_view column, double otherwise) {
    return input.contacts ? examples::only_value(*input.contacts, column).value_or(otherwise) : otherwise;
  };
  auto const usual = examples::study_law();
  auto const given = [&](std::optional<double> value, std::string_view column, double otherwise) {
    return value ? *value : of_contacts(column, otherwise);
  };
  scarp::LinearFrictional const law{
      .normal_stiffness = given(grains.normal_stiffness, "kn", usual.normal_stiffness),
      .tangential_stiffness = given(grains.tangential_stiffness, "ks", usual.tangential_stiffness),
      .friction = given(grains.friction, "tan_phi", usual.friction)};
  auto const shape = examples::shape_of(input.particles);
  if (shape == "disc") return read<scarp::Disc>(grains, pressure, input, law, sites);
  if (shape == "ellipse") return read<scarp::Ellipse>(grains, pressure, input, law, sites);
  scarp::refuse("'{}' holds grains of the shape {} (discs and ellipses are built): take other grains", grains.particles,
                shape);
}

}  // namespace

struct Sand::Fields {
  AnyField any;
};

Sand::Sand(Grains const& grains, double pressure, std::span<scarp::Site<2> const> sites,
           scarp::ThreadExecutor& executor)
    : fields_(std::make_unique<Fields>(Fields{any_field(grains, pressure, sites, executor)})) {}
Sand::Sand(Sand&&) noexcept = default;
Sand::~Sand() = default;

int Sand::point_count() const {
  return std::visit([](auto const& field) { return field.point_count(); }, fields_->any);
}
void Sand::plan(int point, scarp::Gradient<2> const& predicted) {
  std::visit([&](auto& field) { field.plan(point, predicted); }, fields_->any);
}
void Sand::refine_plan(int point) {
  std::visit([&](auto& field) { field.refine_plan(point); }, fields_->any);
}
scarp::Response<2> Sand::respond(int point, scarp::Gradient<2> const& increment) {
  return std::visit([&](auto& field) { return field.respond(point, increment); }, fields_->any);
}
long Sand::work(int point) const {
  return std::visit([&](auto const& field) { return field.work(point); }, fields_->any);
}
scarp::VoigtStress<2> Sand::committed_stress(int point) const {
  return std::visit([&](auto const& field) { return field.committed_stress(point); }, fields_->any);
}
scarp::VoigtTangent<2> Sand::committed_tangent(int point) const {
  return std::visit([&](auto const& field) { return field.committed_tangent(point); }, fields_->any);
}
scarp::VoigtTangent<2> Sand::trial_tangent(int point) const {
  return std::visit([&](auto const& field) { return field.trial_tangent(point); }, fields_->any);
}
void Sand::commit() {
  std::visit([](auto& field) { field.commit(); }, fields_->any);
}
scarp::Quantities Sand::committed(int point) const {
  return std::visit([&](auto const& field) { return scarp::RveQuantities{}(field.provider(), field.committed(point)); },
                    fields_->any);
}

scarp::PointBalance point_balance(Sand const& sand, int point, scarp::Gradient<2> const& increment) {
  return std::visit([&](auto const& field) { return scarp::point_balance(field, point, increment); },
                    sand.fields_->any);
}
scarp::DoubledAnswer<2> doubled_answer(Sand const& sand, int point, scarp::Gradient<2> const& increment) {
  return std::visit([&](auto const& field) { return scarp::doubled_answer(field, point, increment); },
                    sand.fields_->any);
}
scarp::DoubledAnswer<2> followed_answer(Sand const& sand, int point, scarp::Gradient<2> const& increment,
                                        std::string& bits) {
  return std::visit([&](auto const& field) { return scarp::followed_answer(field, point, increment, bits); },
                    sand.fields_->any);
}

}  // namespace biaxial_specimen
