// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/random_packings.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace python_points {

/// progress(packings that are done, packings in all, what happens now); may throw to stop the preparation.
using Progress = std::function<void(int, int, std::string const&)>;

/// Materials by name: members are the keywords that Python gives, `prepare` is called once before `provider`, which makes a
/// provider from a prepared or a saved material.
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

/// Grains, preparation and responses of a packing.
struct SandOptions {
  int grains = 400;
  long seed = 1;
  double smallest = 4e-3;  ///< radius or major half axis [m]
  double largest = 6e-3;   ///< [m]
  double aspect = 0.75;    ///< of ellipses
  double density = 2650.0;
  double thickness = 0.2;             ///< out of plane [m]
  double normal_stiffness = 6e6;      ///< [N/m]
  double tangential_stiffness = 6e6;  ///< [N/m]
  double friction = 0.55;
  double pressure = 2e5;  ///< isotropic [Pa]
  double preparation_friction = 0.1;
  double void_ratio = 0.0;  ///< at the isotropic pressure, by bisection of the preparation friction; 0: as that gives
  double vertical_pressure = 0.0;        ///< [Pa], to which it is then compressed without lateral strain (K0); 0: not
  double overconsolidation_ratio = 1.0;  ///< of the vertical pressure
  int packings = 1;                      ///< of different seeds, of which every point draws one
  double strain_per_step = 1e-5;
  double unbalanced_tolerance = 0.05;
  int min_steps = 20;
  int max_steps = 20'000;
  std::string file{};  ///< of save_packing, instead of a preparation
  SCARP_MEMBERS(grains, seed, smallest, largest, density, normal_stiffness, tangential_stiffness, friction, pressure,
                preparation_friction, void_ratio, vertical_pressure, overconsolidation_ratio, packings, strain_per_step,
                unbalanced_tolerance, min_steps, max_steps, file)  // the others with the shapes that have them
};

template <class Shape>
struct Sand {
  using Law = scarp::LinearFrictional;
  using Packing = scarp::Packing<Shape, Law>;

  SandOptions options{};
  std::vector<Packing> packings{};

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("options", self.options);
    if constexpr (std::is_same_v<Shape, scarp::Ellipse>) visit("aspect", self.options.aspect);
    if constexpr (Shape::dim == 2) visit("thickness", self.options.thickness);
    visit("packings", self.packings);
  }

  Law law() const { return {options.normal_stiffness, options.tangential_stiffness, options.friction}; }

  /// \throws InputError, PreparationError
  void prepare(int threads, Progress const& progress) {
    if (!options.file.empty()) {
      packings = {scarp::load_packing<Packing>(options.file)};
      return;
    }
    scarp::require_between("number of packings", options.packings, 1, 100'000);
    packings.resize(static_cast<std::size_t>(options.packings));
    std::atomic<int> done = 0;
    scarp::ThreadExecutor(threads).for_each(options.packings, [&](int k) {
      auto const tell = [&](std::string const& text) { progress(done, options.packings, text); };
      auto const seed = static_cast<std::uint64_t>(options.seed);
      packings[static_cast<std::size_t>(k)] =
          one(k == 0 ? seed : scarp::family_seed(seed, static_cast<std::uint64_t>(k)), tell);
      ++done;
      tell(fmt::format("packing {} has void ratio {:.4f}", k, packings[static_cast<std::size_t>(k)].void_ratio()));
    });
  }

  auto provider() const {
    using Same = scarp::SamePacking<Packing>;
    scarp::RandomChoice<Same> pool{{}, static_cast<std::uint64_t>(options.seed)};
    for (auto const& packing : packings) pool.sources.push_back({packing});
    return scarp::DemRve<Packing, scarp::RandomChoice<Same>>{.law = law(),
                                                             .source = std::move(pool),
                                                             .strain_per_step = options.strain_per_step,
                                                             .min_steps = options.min_steps,
                                                             .max_steps = options.max_steps,
                                                             .unbalanced_tolerance = options.unbalanced_tolerance};
  }

 private:
  template <class Tell>
  Packing one(std::uint64_t seed, Tell const& tell) const {
    auto const cloud = [&] {
      if constexpr (std::is_same_v<Shape, scarp::Ellipse>) {
        return scarp::Cloud<scarp::EllipseGrading>{.grading = {options.smallest, options.largest, options.aspect}};
      } else {
        return scarp::Cloud<scarp::RadiusGrading<Shape>>{.grading = {options.smallest, options.largest}};
      }
    }();
    auto own = cloud;
    own.grains = options.grains, own.density = options.density, own.seed = seed;
    if constexpr (Shape::dim == 2) own.thickness = options.thickness;
    auto const loose = own.template make<Packing>();
    Packing packing =
        options.void_ratio > 0.0 ? by_void_ratio(loose, tell) : consolidated(loose, options.preparation_friction, tell);
    if (options.vertical_pressure == 0.0) return packing;
    tell("compressed without lateral strain");
    std::vector<double> path{options.overconsolidation_ratio * options.vertical_pressure};
    if (options.overconsolidation_ratio > 1.0) path.push_back(options.vertical_pressure);
    auto column = scarp::OneDimensionalCompression{}.compress(std::move(packing), law(), path);
    return settled(std::move(column.back()), "compressed one-dimensionally");
  }

  template <class Tell>
  Packing consolidated(Packing const& loose, double friction, Tell const& tell) const {
    tell(fmt::format("consolidated at friction {:.4f}", friction));
    scarp::IsotropicPreparation const preparation{.pressure = options.pressure, .preparation_friction = friction};
    return settled(preparation.prepare(loose, law()), "consolidated");
  }

  /// The more friction while it is consolidated, the looser.
  template <class Tell>
  Packing by_void_ratio(Packing const& loose, Tell const& tell) const {
    constexpr double tolerance = 5e-4;
    double const wanted = options.void_ratio;
    double low = 0.0;
    double high = options.friction;
    Packing dense = consolidated(loose, low, tell);
    Packing open = consolidated(loose, high, tell);
    for (int halvings = 0; halvings < 16; ++halvings) {
      if (std::abs(dense.void_ratio() - wanted) <= tolerance) return dense;
      if (std::abs(open.void_ratio() - wanted) <= tolerance) return open;
      if (!(dense.void_ratio() < wanted && wanted < open.void_ratio())) break;
      double const middle = (low + high) / 2.0;
      Packing between = consolidated(loose, middle, tell);
      bool const is_dense = between.void_ratio() < wanted;
      (is_dense ? low : high) = middle;
      (is_dense ? dense : open) = std::move(between);
    }
    scarp::reject(
        "void ratio {} is not reached (preparation frictions of {} and {} give {:.4f} and {:.4f}): choose another one, "
        "or another seed",
        wanted, low, high, dense.void_ratio(), open.void_ratio());
  }

  static Packing settled(scarp::Prepared<Packing> prepared, char const* what) {
    if (!prepared.verdict.acceptable()) {
      throw scarp::PreparationError(
          fmt::format("a packing could not be {} ({}): try another seed, more grains or a higher pressure", what,
                      scarp::name(prepared.verdict.reason)));
    }
    return std::move(prepared.packing);
  }
};

/// Calls task(std::type_identity<Material>) with the material of a name. \throws InputError for an unknown one
template <int Dim, class Task>
auto with_material(std::string const& kind, Task const& task) {
  if (kind == "linear_elastic") return task(std::type_identity<LinearElastic<Dim>>{});
  if (kind == "mohr_coulomb") return task(std::type_identity<MohrCoulomb<Dim>>{});
  if constexpr (Dim == 2) {
    if (kind == "discs") return task(std::type_identity<Sand<scarp::Disc>>{});
    if (kind == "ellipses") return task(std::type_identity<Sand<scarp::Ellipse>>{});
  } else {
    if (kind == "spheres") return task(std::type_identity<Sand<scarp::Sphere>>{});
  }
  scarp::reject("there is no material '{}' in {} dimensions (linear_elastic, mohr_coulomb, {}): choose one", kind, Dim,
                Dim == 2 ? "discs, ellipses" : "spheres");
}

/// A provider and the bits of what it was made from, packings included.
template <int Dim>
struct Material {
  std::string kind;
  std::string bits;
  scarp::AnyProvider<Dim> provider;
};

/// bits: of the material with its keywords, not prepared yet. Compiled in one source, so that all programs get the same numbers.
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
