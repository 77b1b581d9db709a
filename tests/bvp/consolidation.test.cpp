// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "../../examples/consolidation/column.hpp"
#include "../../examples/shared/plane_strain.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "support/approx.hpp"

namespace {

using consolidation::Column;
using samples::Approx;
using scarp::ConstantPermeability;
using scarp::PoreWater;
using scarp::Quad8;
using scarp::TimeFunction;

template <class Element, class Motion = scarp::SmallStrain>
using Ground = scarp::Discretisation<Element, Motion>;

constexpr double mobility = 1e-9;  // [m2/(Pa s)]

/// A flow of so much mobility [m2/(Pa s)]; bulk_modulus [Pa]: of the water, which keeps its volume by default.
ConstantPermeability flow_of(double passes, double bulk_modulus = std::numeric_limits<double>::infinity()) {
  scarp::Water const water{.bulk_modulus = bulk_modulus};
  return {passes * water.unit_weight, water};
}

/// Lines from 0 to a length, equally far apart.
std::vector<double> even_lines(double length, int cells) {
  std::vector<double> lines;
  for (int k = 0; k <= cells; ++k) lines.push_back(length * k / cells);
  return lines;
}

/// Makes what lies above a height [m] a region of its own.
template <class Element>
void split_above(scarp::Mesh<Element>& mesh, char const* name, double height) {
  mesh.regions.push_back(name);
  auto const is_above = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)].y() > height - 1e-9; };
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::ranges::all_of(mesh.elements[e], is_above))
      mesh.element_region[e] = static_cast<int>(mesh.regions.size()) - 1;
}

/// Conductivity that falls with the square of the volume 1 + e; water that keeps its volume.
struct SquareOfVolume {
  double mobility_at_start = 0.0;  ///< [m2/(Pa s)]
  double void_ratio = 0.0;

  void validate() const {}
  double mobility(double now) const {
    double const grown = (1.0 + now) / (1.0 + void_ratio);
    return mobility_at_start * grown * grown;
  }
  double storage(double) const { return 0.0; }
};

/// Ground of width 2 and height 1 between rigid, smooth, impermeable plates, which drains at its sides; in the time
/// factor T = c t. Mandel, Geotechnique 3 (1953) 287; for any water Cheng and Detournay, Int. J. Numer. Anal. Meth.
/// Geomech. 12 (1988) 551.
class Mandel {
 public:
  /// storage: bulk modulus of the ground times the storage of its water, 0 for water that keeps its volume
  Mandel(double poisson, double storage) : poisson_(poisson), skempton_(1.0 / (1.0 + storage)) {
    double const part = skempton_ * (1.0 - 2.0 * poisson);
    undrained_ = (3.0 * poisson + part) / (3.0 - part);
    double const slope = (1.0 - poisson) / (undrained_ - poisson);
    for (int k = 0; k < 60; ++k) {
      double low = k * std::numbers::pi;
      double high = low + std::numbers::pi / 2.0;
      for (int halved = 0; halved < 60; ++halved) {
        double const middle = (low + high) / 2.0;
        (std::tan(middle) < slope * middle ? low : high) = middle;
      }
      roots_.push_back(low);
    }
  }
  /// \f$ \frac{u}{q} = \frac{2 B (1+\nu_u)}{3} \sum_k \frac{\sin a_k (1 - \cos a_k)}{a_k - \sin a_k \cos a_k} e^{-a_k^2
  /// T},\; \tan a_k = \frac{1-\nu}{\nu_u-\nu} a_k \f$ in the middle, q mean pressure of the plates
  double pressure(double time_factor) const {
    double const sum = over_roots(time_factor, [](double root) { return std::sin(root) * (1.0 - std::cos(root)); });
    return 2.0 * skempton_ * (1.0 + undrained_) / 3.0 * sum;
  }
  /// \f$ \frac{2 G}{q} w = 1-\nu - 2(1-\nu_u) \sum_k \frac{\sin a_k \cos a_k}{a_k - \sin a_k \cos a_k} e^{-a_k^2 T}
  /// \f$, 1 - \nu_u at once
  double settlement(double time_factor) const {
    if (time_factor == 0.0) return 1.0 - undrained_;
    double const sum = over_roots(time_factor, [](double root) { return std::sin(root) * std::cos(root); });
    return 1.0 - poisson_ - 2.0 * (1.0 - undrained_) * sum;
  }

 private:
  template <class Part>
  double over_roots(double time_factor, Part const& part) const {
    double sum = 0.0;
    for (double const root : roots_)
      sum += part(root) / (root - std::sin(root) * std::cos(root)) * std::exp(-root * root * time_factor);
    return sum;
  }

  double poisson_, skempton_;
  double undrained_ = 0.0;  ///< Poisson's ratio
  std::vector<double> roots_;
};

/// A quarter of the ground, whose upper plate settles as Mandel's does: so it carries a force that stays.
template <class Element>
void check_mandel(Mandel const& form, double poisson, double storage) {
  auto const soil = scarp::LinearElastic<2>::from_young_poisson(1e6, poisson);
  double const shear = soil.elasticity.shear_modulus;
  double const bulk = soil.elasticity.lame_lambda + 2.0 * shear / 3.0;
  double const rate = mobility / (1.0 / (bulk + 4.0 * shear / 3.0) + storage / bulk);  // c [m2/s]
  constexpr int cells = 40;
  std::vector<double> lines;  // closer towards the drain, beside which the first step loses the pressure of an element
  for (int k = cells; k >= 0; --k) lines.push_back(1.0 - std::pow(k / static_cast<double>(cells), 1.5));
  Ground<Element> const grid(examples::mesh_of_lines<Element>(lines, {0.0, 0.5, 1.0}));
  consolidation::Clock clock(1e-4 / rate);
  int const steps = 240;
  clock.add(2.0 / rate, steps);
  auto const time = clock.time();
  constexpr double pores_per_volume = 0.5;
  PoreWater water(
      grid,
      flow_of(mobility, storage > 0.0 ? pores_per_volume * bulk / storage : std::numeric_limits<double>::infinity()),
      {.shear_modulus = shear, .void_ratio = 1.0, .clock = time});
  water.drain({"right"});
  std::vector<std::pair<double, double>> settlements{{0.0, 0.0}};
  for (int k = 1; k <= steps + 2; ++k) settlements.emplace_back(k, form.settlement(rate * time(k)) / (2.0 * shear));
  scarp::Model model(grid);
  model.fix({"left"}, 0);
  model.fix({"bottom"}, 1);
  model.move({"top"}, 1, -1.0, TimeFunction(settlements));
  model.material("soil", soil);
  model.attach(water);
  scarp::Analysis analysis(model, {.stepping = consolidation::by_the_clock, .threads = 1});
  double of_pressure = 0.0, of_force = 0.0, peak = 0.0, at = 0.0;
  for (int k = 1; k <= steps + 2; ++k) {
    REQUIRE(analysis.to(k).verdict.acceptable());
    auto const& pores = analysis.problem().template attached<decltype(water)>();
    double const time_factor = rate * pores.time();
    double const now = pores.pressures()[0];
    if (now > peak) {
      peak = now;
      at = time_factor;
    }
    if (time_factor < 0.0099) continue;
    of_pressure = std::max(of_pressure, std::abs(now - form.pressure(time_factor)));
    of_force = std::max(of_force, std::abs(-analysis.reaction("top").y() - 1.0));
  }
  MESSAGE("peak ", peak, " at T ", at, "; from T = 0.01 on largest error of the pressure ", of_pressure,
          ", of the plate's force ", of_force);
  CHECK(of_pressure < 5e-3);
  CHECK(of_force < 5e-3);
}

struct Layer {
  double thickness = 0.0;  ///< [m]
  double passes = 0.0;     ///< mobility [m2/(Pa s)]
  double modulus = 0.0;    ///< constrained [Pa]
};

/// Two layers of ground whose load stays; the top drains, the base too or not.
/// Schiffman and Stein, J. Soil Mech. Found. Div. ASCE 96 (1970) 1499.
struct Layers {
  Layer lower, upper;
  bool base_drains = false;

  /// Time of the time factor 1, with the whole resistance and compliance, of half of the height where both ends drain
  /// [s].
  double unit_of_time() const {
    double const resistance = lower.thickness / lower.passes + upper.thickness / upper.passes;
    double const compliance = lower.thickness / lower.modulus + upper.thickness / upper.modulus;
    return resistance * compliance / (base_drains ? 4.0 : 1.0);
  }

  /// \f$ u/q = \sum_j c_j \varphi_j(z) e^{-\omega_j^2 t} \f$: each \f$ \varphi_j \f$ solves
  /// \f$ (k \varphi')' = -\omega^2 \varphi/M \f$
  std::function<double(double, double)> pressure() const {
    struct Mode {
      double rate, in_upper, in_lower;
    };
    double const down = std::sqrt(upper.passes * upper.modulus);  // roots of c_v
    double const up = std::sqrt(lower.passes * lower.modulus);
    double const depth = upper.thickness / down;
    double const height = lower.thickness / up;
    auto const at_base = [=, drains = base_drains](double angle) { return drains ? std::sin(angle) : std::cos(angle); };
    // Jump of the flow at the interface.
    auto const jump = [&](double rate) {
      double const a = rate * depth, b = rate * height;
      double const slope = base_drains ? std::cos(b) : -std::sin(b);
      return upper.passes / down * std::cos(a) * at_base(b) + lower.passes / up * std::sin(a) * slope;
    };
    std::vector<Mode> modes;
    double const step = 0.01 / (depth + height);
    for (double rate = step; rate < 1e4 * step; rate += step) {
      if (jump(rate) * jump(rate + step) > 0.0) continue;
      double low = rate, high = rate + step;
      for (int halved = 0; halved < 60; ++halved) {
        double const middle = (low + high) / 2.0;
        (jump(low) * jump(middle) > 0.0 ? low : high) = middle;
      }
      double const a = low * depth, b = low * height, over = at_base(b), under = std::sin(a);
      double const turned = base_drains ? 1.0 - std::cos(b) : std::sin(b);
      double const twice = std::sin(2.0 * b) * (base_drains ? -0.25 : 0.25);
      double const load = over * (1.0 - std::cos(a)) * down / upper.modulus + under * turned * up / lower.modulus;
      double const norm = over * over * (a / 2.0 - std::sin(2.0 * a) / 4.0) * down / upper.modulus +
                          under * under * (b / 2.0 + twice) * up / lower.modulus;
      modes.push_back({low, over * load / norm, under * load / norm});
    }
    return [=, base = lower.thickness, top = lower.thickness + upper.thickness](double time, double place) {
      double sum = 0.0;
      for (auto const& mode : modes)
        sum += std::exp(-mode.rate * mode.rate * time) *
               (place > base ? mode.in_upper * std::sin(mode.rate * (top - place) / down)
                             : mode.in_lower * at_base(mode.rate * place / up));
      return sum;
    };
  }
};

/// Largest error of the pressure over the load from T = 0.1 on.
double error_of_layers(Layers const& layers, std::function<double(double, double)> const& exact) {
  constexpr int rows = 20;
  auto mesh = examples::mesh_of_lines<Quad8>({0.0, 1.0 / rows}, even_lines(1.0, rows));
  split_above(mesh, "upper", layers.lower.thickness);
  Ground<Quad8> const grid(std::move(mesh));
  double const unit = layers.unit_of_time();
  consolidation::Clock clock(1e-4 * unit);
  std::vector<double> ends;
  for (double const stage : {0.01, 0.1, 0.2, 0.5, 1.0}) ends.push_back(clock.add(stage * unit, 40));
  PoreWater water(grid, flow_of(layers.lower.passes),
                  {.shear_modulus = layers.lower.modulus / 2.0, .clock = clock.time()});
  water.region("upper", flow_of(layers.upper.passes), 0.7);
  water.drain({"top"});
  if (layers.base_drains) water.drain({"bottom"});
  scarp::Model model(grid);
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"}, 1);
  model.surcharge({"top"}, 1.0, TimeFunction::ramp(0.0, 1.0));
  model.material("soil", scarp::LinearElastic<2>::from_young_poisson(layers.lower.modulus, 0.0));
  model.material("upper", scarp::LinearElastic<2>::from_young_poisson(layers.upper.modulus, 0.0));
  model.attach(water);
  scarp::Analysis analysis(model, {.stepping = consolidation::by_the_clock, .threads = 1});
  REQUIRE(analysis.to(ends.front()).verdict.acceptable());
  double error = 0.0;
  for (std::size_t stage = 1; stage < ends.size(); ++stage) {
    REQUIRE(analysis.to(ends[stage]).verdict.acceptable());
    auto const& pores = analysis.problem().attached<decltype(water)>();
    auto const found = pores.pressures();
    for (int row = 0; row <= rows; ++row) {
      auto const corner = static_cast<std::size_t>(2 * row);  // two in each row, before the nodes on edges
      double const place = grid.nodes()[corner].y();
      error = std::max(error, std::abs(found[corner] - exact(pores.time(), place)));
    }
  }
  return error;
}

}  // namespace

TEST_CASE("ground of large strain settles as Xie and Leo's") {
  // Analytic: 1/m_vl is a modulus of the logarithmic strain, S = H (1 - e^{-m_vl q}) U(T), T = k_0 t/(m_vl gamma_w H^2)
  // (Xie and Leo 2004, Comput. Geotech. 31, 301). Another code: settlements of geotecha's test_xieandleo2004.py.
  constexpr double height = 10.0, width = 0.05;                      // [m]
  constexpr double load = 100e3, modulus = 250e3, void_ratio = 3.0;  // [Pa]
  constexpr double passes = 1e-9 / 10e3;                             // [m2/(Pa s)]
  constexpr std::array settlements{0.11763799, 0.17944781, 0.27373398, 0.41756036, 0.63695657,
                                   0.97162877, 1.48178939, 2.22256023, 2.97627998, 3.27758078};  // [m]
  std::vector<double> lines;
  constexpr int rows = 30;
  for (int k = rows; k >= 0; --k) lines.push_back(height * (1.0 - std::pow(k / static_cast<double>(rows), 2)));
  Ground<Quad8, scarp::UpdatedLagrangian> const grid(examples::mesh_of_lines<Quad8>({0.0, width}, lines));
  double from = 4e5;  // [s]
  consolidation::Clock clock(from);
  std::vector<double> ends;
  for (std::size_t k = 0; k < settlements.size(); ++k) {
    double const time = 4e6 * std::pow(2000.0, static_cast<double>(k) / 9.0);
    ends.push_back(clock.add(time, static_cast<int>(std::ceil(60.0 * std::log10(time / from)))));
    from = time;
  }
  PoreWater water(grid, SquareOfVolume{passes, void_ratio},
                  {.shear_modulus = modulus / 2.0, .void_ratio = void_ratio, .clock = clock.time()});
  water.drain({"top"});
  scarp::Model model(grid);
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"}, 1);
  model.surcharge({"top"}, load, TimeFunction::ramp(0.0, 1.0));
  model.material("soil", scarp::LinearElastic<2>::from_young_poisson(modulus, 0.0));
  model.attach(water);
  auto stepping = consolidation::by_the_clock;
  stepping.max_displacement_gradient = 0.1;  // the load in parts, for the top settles by a third at once
  scarp::Analysis analysis(model, {.stepping = stepping, .threads = 1});
  scarp::RunReport run;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    run = joined(run, analysis.to(ends[k]));
    REQUIRE(run.verdict.acceptable());
    auto const& pores = analysis.problem().attached<decltype(water)>();
    double const exact = height * (1.0 - std::exp(-load / modulus)) *
                         Column::degree(passes * modulus * pores.time() / (height * height));
    CHECK(exact == Approx(settlements[k]).epsilon(1e-4));
    double const found = -analysis.displacement("top", 1);
    MESSAGE("settlement ", found, " of ", settlements[k], ", error ", found / settlements[k] - 1.0);
    CHECK(found == Approx(settlements[k]).epsilon(0.01));
    CHECK(pores.expelled() == Approx(width * found).epsilon(1e-5));
  }
  MESSAGE(run.iterations, " iterations in ", run.steps, " steps");
}

TEST_CASE("the pressure between rigid plates rises before it falls, as Mandel's") {
  Mandel const soft(0.2, 0.0);
  // Analytic: the series with 60 roots in 30 digits.
  for (auto const& [time_factor, pressure] :
       {std::pair(0.01, 0.52188), {0.05, 0.54944}, {0.1, 0.54771}, {0.5, 0.29639}, {1.0, 0.12942}, {2.0, 0.02468}})
    CHECK(std::abs(soft.pressure(time_factor) - pressure) < 1e-5);
  check_mandel<scarp::Tri6>(soft, 0.2, 0.0);
  check_mandel<Quad8>(soft, 0.2, 0.0);
  check_mandel<Quad8>(Mandel(0.0, 0.0), 0.0, 0.0);
  // Storage of MOOSE's mandel.i (K = 1, M = 4.705882); its Biot coefficient, 0.6, is that of grains that are softer.
  double const storage = 1.0 / 4.705882;
  check_mandel<Quad8>(Mandel(0.2, storage), 0.2, storage);
}

TEST_CASE("two layers consolidate as Schiffman and Stein's, and a column between two drains as Terzaghi's") {
  Layer const part{.thickness = 0.37, .passes = mobility, .modulus = 1e6};
  Layers const one{.lower = {0.63, part.passes, part.modulus}, .upper = part};
  auto const series = one.pressure();
  for (double const place : {0.0, 0.3, 0.63, 0.9})
    CHECK(std::abs(series(0.1 * one.unit_of_time(), place) - Column::pressure(0.1, place)) < 1e-9);

  auto const check = [](std::string const& what, double error) {
    MESSAGE(what, ", largest error of the pressure ", error);
    CHECK(error < 5e-3);
  };
  Layers layers{.lower = {0.6, mobility, 1e6}, .upper = {0.4, mobility / 4.0, 0.5e6}};
  check("sand below clay", error_of_layers(layers, layers.pressure()));
  layers.base_drains = true;
  check("the same between two drains", error_of_layers(layers, layers.pressure()));
  std::swap(layers.lower.passes, layers.upper.passes);
  check("clay below sand between two drains", error_of_layers(layers, layers.pressure()));
  layers.upper = {0.4, layers.lower.passes, layers.lower.modulus};
  double const unit = layers.unit_of_time();
  check("one layer between two drains", error_of_layers(layers, [=](double time, double place) {
          return Column::pressure(time / unit, 2.0 * std::abs(place - 0.5));
        }));
}
