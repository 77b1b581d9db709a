// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "scarp/points/detail/point_batch.hpp"
#include "scarp/points/point_means.hpp"
#include "scarp/points/region.hpp"

namespace scarp {

/// Any material, chosen while a program runs, of a region or a list of regions: scenes, solvers and observers are compiled once for
/// all. The responses are the provider's own, bit for bit.
/// \code
/// scarp::AnyProvider<2> soil = stiff ? scarp::AnyProvider<2>(elastic) : scarp::AnyProvider<2>(packings);
/// \endcode
template <int Dim>
class AnyProvider {
 public:
  static constexpr int dim = Dim;  ///< of the providers
  /// Finds the neighbours of all points: sites, volumes [m3], neighbourhoods, tangents [Pa] that they begin with.
  using Means = PointMeans<Dim> (*)(std::span<Site<Dim> const>, std::span<double const>, std::span<Neighbourhood const>,
                                    std::vector<VoigtTangent<Dim>> const&);

  /// Of no use until another one is assigned.
  AnyProvider() = default;

  /// Holds a copy of any provider of this dimension.
  template <ConstitutiveProvider Provider>
    requires(Provider::dim == Dim)
  AnyProvider(Provider provider)  // NOLINT: any provider is one
      : empty_(std::make_shared<detail::PointBatchOf<Provider>>(std::make_shared<Provider>(std::move(provider)))) {}

  /// Holds a copy of a `Nonlocal` material of this dimension.
  template <class Averaged>
    requires(Averaged::dim == Dim && requires(Averaged const& material) { material.neighbourhood(); })
  AnyProvider(Averaged const& material)  // NOLINT: any material is one
      : AnyProvider(material.provider) {
    neighbourhood_ = detail::validated(material.neighbourhood());
    means_ = Averaged::means;
  }

  /// Points of this provider, none yet. \throws InputError where there is no provider
  std::unique_ptr<detail::PointBatch<Dim>> batch() const {
    if (!empty_) reject("an AnyProvider is used that holds no provider: assign one to it first");
    return empty_->without_points();
  }
  Neighbourhood const& own_neighbourhood() const {
    return neighbourhood_;
  }                                       ///< Of a point alone unless it is nonlocal.
  Means means() const { return means_; }  ///< Null unless it is nonlocal.

 private:
  std::shared_ptr<detail::PointBatch<Dim> const> empty_;
  Neighbourhood neighbourhood_{};
  Means means_ = nullptr;
};

}  // namespace scarp
