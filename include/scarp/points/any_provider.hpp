// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>
#include <utility>

#include "scarp/points/detail/point_batch.hpp"

namespace scarp {

/// Any provider, chosen while a program runs, as the material of a region: scenes, solvers and observers are compiled once for all.
/// The responses are the provider's own, bit for bit.
/// \code
/// scarp::AnyProvider<2> soil = stiff ? scarp::AnyProvider<2>(elastic) : scarp::AnyProvider<2>(packings);
/// \endcode
template <int Dim>
class AnyProvider {
 public:
  static constexpr int dim = Dim;  ///< of the providers

  /// Of no use until another one is assigned.
  AnyProvider() = default;

  /// Holds a copy of any provider of this dimension.
  template <ConstitutiveProvider Provider>
    requires(Provider::dim == Dim)
  AnyProvider(Provider provider)  // NOLINT: any provider is one
      : empty_(std::make_shared<detail::PointBatchOf<Provider>>(std::make_shared<Provider>(std::move(provider)))) {}

  /// Points of this provider, none yet. \throws InputError where there is no provider
  std::unique_ptr<detail::PointBatch<Dim>> batch() const {
    if (!empty_) reject("an AnyProvider is used that holds no provider: assign one to it first");
    return empty_->without_points();
  }

 private:
  std::shared_ptr<detail::PointBatch<Dim> const> empty_;
};

}  // namespace scarp
