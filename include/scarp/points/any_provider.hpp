// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "scarp/points/detail/point_batch_of.hpp"
#include "scarp/points/point_means.hpp"

namespace scarp {

template <int Dim>
class MaterialPoints;

/// Any material, chosen while a program runs, of a region or a list of regions: scenes, solvers and observers are
/// compiled once for all. The responses are the provider's own, bit for bit.
/// \code
/// scarp::AnyProvider<2> soil = stiff ? scarp::AnyProvider<2>(elastic) : scarp::AnyProvider<2>(packings);
/// \endcode
template <int Dim>
class AnyProvider {
 public:
  static constexpr int dim = Dim;  ///< of the providers

  /// No provider: it can be used once another one is assigned.
  AnyProvider() = default;

  /// Holds a copy of any provider of this dimension.
  template <ConstitutiveProvider Provider>
    requires(Provider::dim == Dim)
  AnyProvider(Provider provider)  // NOLINT: any provider is one
      : batch_(
            std::make_unique<detail::PointBatchOf<Provider>>(std::make_shared<Provider const>(std::move(provider)))) {}

  /// Holds a copy of a `Nonlocal` material of this dimension.
  template <class Averaged>
    requires(Averaged::dim == Dim && requires(Averaged const& material) { material.neighbourhood(); })
  AnyProvider(Averaged const& material)  // NOLINT: any material is one
      : AnyProvider(material.provider) {
    neighbourhood_ = detail::validated(material.neighbourhood());
    means_ = Averaged::means;
  }

  /// Holds another copy; the providers share their parameters.
  AnyProvider(AnyProvider const& other) : neighbourhood_(other.neighbourhood_), means_(other.means_) {
    if (other.batch_) batch_ = other.batch_->copy();
  }
  AnyProvider(AnyProvider&&) noexcept = default;
  /// Holds another material from now on.
  AnyProvider& operator=(AnyProvider other) noexcept {
    std::swap(batch_, other.batch_);
    neighbourhood_ = other.neighbourhood_;
    means_ = other.means_;
    return *this;
  }
  ~AnyProvider() = default;

 private:
  friend class MaterialPoints<Dim>;

  /// Finds the neighbours of all points: sites, volumes [m3], neighbourhoods, tangents [Pa] that they begin with.
  using Means = std::unique_ptr<PointMeans<Dim>> (*)(std::span<Site<Dim> const>, std::span<double const>,
                                                     std::span<Neighbourhood const>,
                                                     std::vector<VoigtTangent<Dim>> const&);

  std::unique_ptr<detail::PointBatch<Dim>> batch_;  ///< without points, but within MaterialPoints
  Neighbourhood neighbourhood_{};                   ///< of a point alone unless the material is nonlocal
  Means means_ = nullptr;                           ///< null unless the material is nonlocal
};

/// What a region may consist of: whatever `AnyProvider` holds.
template <class Type>
concept Material = std::convertible_to<Type const&, AnyProvider<Type::dim>>;

/// A Material; for another type the compiler names the member that is missing.
template <class Type>
concept CheckedMaterial = Material<Type> || CheckedProvider<Type>;

}  // namespace scarp
