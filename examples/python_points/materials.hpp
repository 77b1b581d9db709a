// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "../shared/device/made_device.hpp"
#include "../shared/sand/built.hpp"
#include "../shared/sand/ground.hpp"
#include "../shared/sand/preparation.hpp"
#include "../shared/sand/sand_file.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/constitutive/umat_provider.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/random_packings.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace python_points {

/// progress(packings that are done, packings in all, what happens now); may throw to stop the preparation.
using Progress = std::function<void(int, int, std::string const&)>;

/// The UMAT of a shared library, which stays loaded. \throws InputError for one that cannot be loaded or has none
scarp::Umat* umat_in(std::string const& file);

/// Materials by name: members are the keywords that Python gives, `prepare` is called once before `provider`, which
/// makes a provider from a prepared or a saved material.
template <int Dim>
struct LinearElastic {
  double young = 0.0;  ///< [Pa]
  double poisson = 0.0;
  double surcharge = 0.0;    ///< [Pa]
  double unit_weight = 0.0;  ///< [N/m3]
  double k0 = 1.0;
  SCARP_MEMBERS(young, poisson, surcharge, unit_weight, k0)

  void prepare(int, Progress const&) {}
  auto provider() const {
    using Ground = scarp::GeostaticStress<Dim>;
    return scarp::LinearElastic<Dim, Ground>::from_young_poisson(young, poisson, Ground{surcharge, unit_weight, k0});
  }
};

template <int Dim>
struct MohrCoulomb {
  LinearElastic<Dim> elastic{};
  scarp::Strength strength{};

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    LinearElastic<Dim>::members(self.elastic, visit);
    visit("cohesion", self.strength.cohesion);
    visit("friction", self.strength.friction);
    visit("dilation", self.strength.dilation);
    visit("tension", self.strength.tension);
  }
  void prepare(int, Progress const&) {}
  auto provider() const {
    auto const below = elastic.provider();
    return scarp::MohrCoulomb<Dim, scarp::GeostaticStress<Dim>>{below.elasticity, {strength}, below.initial};
  }
};

/// A user's UMAT in a shared library.
template <int Dim>
struct Umat {
  std::string file{};                ///< shared library with the symbol umat_
  std::string name = "UMAT";         ///< CMNAME
  std::vector<double> properties{};  ///< PROPS
  std::vector<double> variables{};   ///< STATEV at the start
  double time_step = 1.0;            ///< of an increment [s]
  int components = Dim == 2 ? 4 : 6;
  double surcharge = 0.0;    ///< [Pa]
  double unit_weight = 0.0;  ///< [N/m3]
  double k0 = 1.0;
  SCARP_MEMBERS(file, name, properties, variables, time_step, components, surcharge, unit_weight, k0)

  /// States keep the path as it was found here.
  void prepare(int, Progress const&) {
    if (!file.empty()) file = std::filesystem::absolute(file).string();
  }
  /// \throws InputError for a library that cannot be loaded or has no UMAT
  auto provider() const {
    using Ground = scarp::GeostaticStress<Dim>;
    return scarp::UmatProvider<Dim, Ground>{.umat = umat_in(file),
                                            .name = name,
                                            .properties = properties,
                                            .variables = variables,
                                            .initial = Ground{surcharge, unit_weight, k0},
                                            .time_step = time_step,
                                            .components = components};
  }
};

/// Packings of several seeds, or of several depths.
template <class Packing>
struct StartPackings {
  std::variant<scarp::RandomChoice<scarp::SamePacking<Packing>>, scarp::PackingsByDepth<Packing>> of{};
  std::vector<double> depths{};  ///< [m] that ground was asked for; empty where packings serve at any

  Packing const& at(scarp::Site<Packing::dim> const& site) const {
    auto const& packing = std::visit([&](auto const& source) -> Packing const& { return source.at(site); }, of);
    double const allowed = 1e-6 * (1.0 + site.depth);  // [m], round-off of a surface level
    auto const is_here = [&](double depth) { return std::abs(depth - site.depth) <= allowed; };
    if (!depths.empty() && !std::ranges::any_of(depths, is_here))
      scarp::reject(
          "point {} is {:.6g} m deep (its ground was made for other depths, {:.6g} to {:.6g} m): make it with "
          "depths=model.depths(), after set_surface_level",
          site.index, site.depth, std::ranges::min(depths), std::ranges::max(depths));
    return packing;
  }
};

/// How packings respond.
struct ResponseOptions {
  double strain_per_step = 1e-5;
  double unbalanced_tolerance = 0.05;
  int min_steps = 20;
  int max_steps = 20'000;
  double pressure_floor = 0.0;   ///< [Pa], see DemRve
  double stiffness_floor = 0.0;  ///< share of a fluid point's stiffness, see StiffnessFloor; 0: none
  std::string device = "none";   ///< where packings respond: none (the vector kernel), threads or cuda, see DeviceRve
  SCARP_MEMBERS(strain_per_step, unbalanced_tolerance, min_steps, max_steps, pressure_floor, stiffness_floor, device)

  /// grains: of a packing
  /// \throws InputError for an unknown device, and one that this program or this machine does not have
  template <class Packing>
  scarp::AnyProvider<Packing::dim> provider(typename Packing::Law const& law, StartPackings<Packing> source,
                                            int grains) const {
    scarp::DemRve<Packing, StartPackings<Packing>> sand{.law = law,
                                                        .source = std::move(source),
                                                        .strain_per_step = strain_per_step,
                                                        .min_steps = min_steps,
                                                        .max_steps = max_steps,
                                                        .unbalanced_tolerance = unbalanced_tolerance,
                                                        .pressure_floor = pressure_floor};
    if (device == "none") return floored(std::move(sand));
    if (device != "threads" && device != "cuda")
      scarp::reject("the device is '{}' (none, threads or cuda is expected): choose one", device);
    using OnDevice = scarp::DeviceRve<decltype(sand)>;
    if constexpr (Packing::dim == 3) {  // 400 spheres need more memory in double precision than a block of a card has
      if (device == "cuda")
        scarp::reject("the device of spheres is '{}' (none or threads is expected): choose one", device);
      using Block = scarp::ProcessorDevice<typename OnDevice::Types, typename OnDevice::Damping>;
      return floored(OnDevice{std::move(sand), std::make_shared<Block>()});
    } else {
      auto const where = device == "cuda" ? examples::Device::cuda : examples::Device::threads;
      return floored(OnDevice{std::move(sand), examples::made_device<OnDevice>(where, grains, 1)});
    }
  }

 private:
  template <class Sand>
  scarp::AnyProvider<Sand::dim> floored(Sand sand) const {
    if (stiffness_floor == 0.0) return sand;
    return scarp::StiffnessFloor<Sand>{.provider = std::move(sand), .share = stiffness_floor};
  }
};

/// Whether grains of this shape with linear contacts have an option, by its name with underscores.
template <class Shape>
bool has_option(std::string_view name) {
  if (name == "aspect") return std::is_same_v<Shape, scarp::Ellipse>;
  if (name == "thickness") return Shape::dim == 2;
  return name != "exponent" && name != "modulus" && name != "poisson" && !name.starts_with("rolling_");
}

/// A sand and responses of its packings.
struct SandOptions {
  examples::Sand sand{};
  int packings = 1;    ///< of different seeds, of which every point draws one
  std::string file{};  ///< of save_packing, instead of a preparation
  ResponseOptions responses{};
  SCARP_MEMBERS_EXCEPT((sand), packings, file, responses)
};

template <class Shape>
struct Sand {
  using Packing = examples::Linear<Shape>;

  SandOptions options{.sand = {.shape = examples::name_in_sand<Shape>}};
  std::vector<Packing> packings{};

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    examples::Sand::members(self.options.sand, [&](std::string_view name, auto& member) {
      if (has_option<Shape>(name)) visit(name, member);
    });
    visit("options", self.options);
    visit("packings", self.packings);
  }

  auto law() const { return examples::law_of<typename Packing::Law>(options.sand); }

  /// \throws InputError, PreparationError
  void prepare(int threads, Progress const& progress) {
    auto const& sand = options.sand;
    if (!options.file.empty()) {
      with_packing(examples::Built<Packing>{}, sand, [](auto, auto const&) {});
      packings = {scarp::load_packing<Packing>(options.file)};
      return;
    }
    with_packing(examples::Built<Packing>{}, sand, [](auto, auto const&) {});
    scarp::require_between("number of packings", options.packings, 1, 100'000);
    packings.resize(static_cast<std::size_t>(options.packings));
    std::atomic<int> done = 0;
    scarp::ThreadExecutor(threads).for_each(options.packings, [&](int k) {
      auto const tell = [&](std::string const& text) { progress(done, options.packings, text); };
      auto const seed = k == 0 ? sand.seed : scarp::family_seed(sand.seed, static_cast<std::uint64_t>(k));
      auto& own = packings[static_cast<std::size_t>(k)];
      own = examples::prepared<Packing>(sand, law(), seed, tell, sand.void_ratio_tolerance);
      ++done;
      tell(fmt::format("packing {} has void ratio {:.4f}", k, own.void_ratio()));
    });
  }

  auto provider() const {
    using Same = scarp::SamePacking<Packing>;
    scarp::RandomChoice<Same> pool{{}, options.sand.seed};
    for (auto const& packing : packings) pool.sources.push_back({packing});
    return options.responses.provider<Packing>(law(), {std::move(pool)},
                                               static_cast<int>(packings.front().grain_count()));
  }

  /// The grains and the law of a packing's file, from the .sand beside it, but for keywords that are given.
  /// \throws InputError, also for keywords that only a preparation uses
  void complete(std::set<std::string> const& given) {
    if (options.file.empty()) return;
    auto const is_given = [&](std::string name) {
      std::ranges::replace(name, '-', '_');
      return given.contains(name);
    };
    examples::require_of_grains(options.sand, is_given, options.file);
    if (options.packings != 1)
      scarp::reject("packings is {} (the packing of '{}' is one): leave it out", options.packings, options.file);
    options.sand = examples::sand_of_packing(options.file, options.sand, is_given, "");
  }
};

/// Level ground of a sand: a packing for every depth, see LevelGround.
template <class Shape>
struct LevelGround {
  using Packing = examples::Linear<Shape>;

  examples::Sand sand{.shape = examples::name_in_sand<Shape>};
  std::vector<double> depths{};  ///< [m] of the points
  double surcharge = 4e3;        ///< [Pa]
  double unit_weight = 15.68e3;  ///< [N/m3]
  ResponseOptions responses{};

  struct Compressed {
    double depth = 0.0;  ///< [m]
    Packing packing{};
    SCARP_MEMBERS(depth, packing)
  };
  std::vector<Compressed> column{};  ///< by depth

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    examples::Sand::members(self.sand, [&](std::string_view name, auto& member) {
      if (has_option<Shape>(name) && name != "k0" && name != "vertical_pressure") visit(name, member);
    });
    visit("depths", self.depths);
    visit("surcharge", self.surcharge);
    visit("unit_weight", self.unit_weight);
    visit("responses", self.responses);
    visit("column", self.column);
  }

  auto law() const { return examples::law_of<typename Packing::Law>(sand); }

  /// \throws InputError, PreparationError
  void prepare(int, Progress const& progress) {
    with_packing(examples::Built<Packing>{}, sand, [](auto, auto const&) {});
    auto ground = examples::level_ground<Packing>(sand, law(), sand.seed, unit_weight, surcharge, depths);
    column.clear();
    for (std::size_t k = 0; k < ground.depths.size(); ++k)
      column.push_back({ground.depths[k], std::move(ground.packings[k])});
    auto const count = static_cast<int>(column.size());
    progress(count, count, fmt::format("{} packings of the ground are compressed", count));
  }

  auto provider() const {
    scarp::PackingsByDepth<Packing> ground;
    for (auto const& [depth, packing] : column) {
      ground.depths.push_back(depth);
      ground.packings.push_back(packing);
    }
    return responses.provider<Packing>(law(), {std::move(ground), depths}, sand.grains);
  }
};

/// Calls task(std::type_identity<Material>) with the material of a name. \throws InputError for an unknown one
template <int Dim, class Task>
auto with_material(std::string const& kind, Task const& task) {
  if (kind == "linear_elastic") return task(std::type_identity<LinearElastic<Dim>>{});
  if (kind == "mohr_coulomb") return task(std::type_identity<MohrCoulomb<Dim>>{});
  if (kind == "umat") return task(std::type_identity<Umat<Dim>>{});
  if constexpr (Dim == 2) {
    if (kind == "discs") return task(std::type_identity<Sand<scarp::Disc>>{});
    if (kind == "ellipses") return task(std::type_identity<Sand<scarp::Ellipse>>{});
    if (kind == "ground_of_discs") return task(std::type_identity<LevelGround<scarp::Disc>>{});
    if (kind == "ground_of_ellipses") return task(std::type_identity<LevelGround<scarp::Ellipse>>{});
  } else {
    if (kind == "spheres") return task(std::type_identity<Sand<scarp::Sphere>>{});
  }
  scarp::reject("there is no material '{}' in {} dimensions (linear_elastic, mohr_coulomb, umat, {}): choose one", kind,
                Dim, Dim == 2 ? "discs, ellipses, ground_of_discs, ground_of_ellipses" : "spheres");
}

/// A provider and the bits of what it was made from, packings included.
template <int Dim>
struct Material {
  std::string kind;
  std::string bits;
  scarp::AnyProvider<Dim> provider;
};

/// bits: of the material with its keywords, not prepared yet. Compiled in one source, so that all programs get the same
/// numbers.
/// \throws InputError, PreparationError, and what progress throws
template <int Dim>
Material<Dim> prepared(std::string const& kind, std::string_view bits, int threads, Progress const& progress);
template <int Dim>
Material<Dim> restored(std::string const& kind, std::string_view bits);

template <class Recipe>
std::string bits_of(Recipe const& recipe) {
  scarp::StateWriter writer;
  writer("material", recipe);
  return std::move(writer.bits());
}

}  // namespace python_points
