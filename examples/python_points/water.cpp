// SPDX-License-Identifier: BSL-1.0
#include "water.hpp"

#include "elements.hpp"
#include "scarp/bvp/pore_water.hpp"

namespace python_points {
namespace {

/// Either of the permeabilities, so that each kind of element is compiled once.
struct EitherFlow {
  bool is_of_grains = false;
  scarp::ConstantPermeability constant{};
  scarp::KozenyCarman of_grains{};

  void validate() const { is_of_grains ? of_grains.validate() : constant.validate(); }
  double mobility(double void_ratio) const {
    return is_of_grains ? of_grains.mobility(void_ratio) : constant.mobility(void_ratio);
  }
  double storage(double void_ratio) const { return constant.storage(void_ratio); }
};

/// Whether the model has elements of this kind, which then have the water.
template <class GridType>
bool attached_to(scarp::Model<GridType::dim>& model, WaterOptions const& options) {
  auto const* const grid = dynamic_cast<GridType const*>(&model.grid());
  if (!grid) return false;
  if (options.grain != 0.0 && options.conductivity != 0.0)
    scarp::reject(
        "water has a conductivity of {} m/s and a grain of {} m (one of them gives the permeability): leave one out",
        options.conductivity, options.grain);
  if (double const start = options.clock(0.0); start != 0.0)
    scarp::reject(
        "the clock of the pore water shows {} s at the load factor 0 (0 s is expected there, where the initial state "
        "is): count the time from there",
        start);
  scarp::Water const water{.bulk_modulus = options.bulk_modulus};
  EitherFlow const flow{options.grain != 0.0, {options.conductivity, water}, {.grain = options.grain, .water = water}};
  scarp::PoreWaterSettings settings{.shear_modulus = options.shear_modulus,
                                    .void_ratio = options.void_ratio,
                                    .clock = options.clock,
                                    .largest_time_error = options.largest_time_error};
  if (options.table) settings.at_rest = scarp::WaterAtRest{.level = *options.table};
  scarp::PoreWater attached(*grid, flow, settings);
  for (auto const& side : options.drained) attached.drain({side});
  for (auto const& [side, value, amplitude] : options.pressures) attached.prescribe({side}, value, amplitude);
  for (auto const& [side, value, amplitude] : options.inflows) attached.inflow({side}, value, amplitude);
  model.attach(attached);
  return true;
}

}  // namespace

template <int Dim>
void attach_water(scarp::Model<Dim>& model, WaterOptions const& options) {
  bool const has_water = any_element([&]<class Element>(std::string_view, std::type_identity<Element>) {
    if constexpr (Element::dim == Dim) {
      return attached_to<scarp::DefaultGrid<Element>>(model, options) ||
             attached_to<SmallGrid<Element>>(model, options);
    } else {
      return false;
    }
  });
  if (!has_water)
    scarp::reject("water is given to elements that have none here (see the list of scarp.Mesh): take another kind");
}

template void attach_water<2>(scarp::Model<2>&, WaterOptions const&);
template void attach_water<3>(scarp::Model<3>&, WaterOptions const&);

}  // namespace python_points
