// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/gmres.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/linear_map.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/core/radius_search.hpp"
#include "scarp/points/point_means.hpp"
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

namespace detail {

template <int Dim>
struct SiteCloud {
  std::span<Site<Dim> const> sites;
  std::size_t kdtree_get_point_count() const { return sites.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return sites[i].position(static_cast<Eigen::Index>(axis));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

}  // namespace detail

/// Means over the points around each, in one region:
/// \f$ w_{ij} = v_j \varphi(r_{ij}/l_i) / \sum_k v_k \varphi(r_{ik}/l_i),\; \varphi(s) = (1-s)^4 (4s+1) \f$
/// below s = 1, zero beyond (H. Wendland, Adv. Comput. Math. 4 (1995) 389). This kernel is positive definite in the
/// plane and in space: no field is turned into its opposite, as the lobes of a bell's or a box's transform would do to
/// waves as short as the length. Its standard deviation along an axis is 0.264 l.
/// sites, volumes [m3] of all points; lengths [m] that a point looks around itself, 0: it stays alone
/// \throws InputError for a length that is negative or not finite, and counts that differ
template <int Dim>
NeighbourMean neighbour_mean(std::span<Site<Dim> const> sites, std::span<double const> volumes,
                             std::span<double const> lengths) {
  using Cloud = detail::SiteCloud<Dim>;
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, Dim, std::uint32_t>;
  if (volumes.size() != sites.size() || lengths.size() != sites.size()) {
    reject("{} volumes and {} lengths are given for {} points: give one of each to every point", volumes.size(),
           lengths.size(), sites.size());
  }
  Cloud const cloud{sites};
  Tree const tree(Dim, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(12));
  auto const unsorted = detail::unsorted_search();
  std::vector<detail::RadiusSearchHit> hits;
  std::vector<std::size_t> first{0};
  std::vector<NeighbourMean::Share> shares;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    double const length = require_not_negative("length that increments are averaged over", lengths[i]);
    require_positive("volume of a point", volumes[i]);
    hits.clear();
    if (length > 0.0) static_cast<void>(tree.radiusSearch(sites[i].position.data(), length * length, hits, unsorted));
    std::erase_if(hits, [&](auto const& hit) {
      return hit.first == i || sites[hit.first].region != sites[i].region || !(hit.second < length * length);
    });
    hits.emplace_back(static_cast<std::uint32_t>(i), 0.0);
    std::ranges::sort(hits, {}, &detail::RadiusSearchHit::first);  // sums run in the order of the points
    double sum = 0.0;
    for (auto const& [j, squared] : hits) {
      double const s = hits.size() == 1 ? 0.0 : std::sqrt(squared) / length;
      double const weight = volumes[j] * std::pow(1.0 - s, 4) * (4.0 * s + 1.0);
      shares.push_back({static_cast<int>(j), weight});
      sum += weight;
    }
    for (std::size_t k = first.back(); k < shares.size(); ++k) shares[k].weight /= sum;
    first.push_back(shares.size());
  }
  return {std::move(first), std::move(shares)};
}

/// Points that see means of the increments around them instead of their own,
/// \f$ \bar G_i = \sum_j w_{ij} J_j G_j / \sum_j w_{ij} J_j \f$, with weights w of the reference configuration and
/// volumes J over the initial ones, and a stress that holds what they do not see:
/// \f$ \sigma_i = \sigma_{material}(\bar G_i) + \tau_i,\;
/// \Delta\tau = s\,C^0 (\Delta\varepsilon - \Delta\bar\varepsilon) - \tau\,|\Delta\bar\varepsilon| / \varepsilon_f \f$
/// (implicit, turned with the mean's rotation). Without tau waves much shorter than the length cost nothing, and bands
/// become as thin as the mesh: strain \f$ \varepsilon = W^{-1} \bar\varepsilon \f$ belongs to any
/// \f$ \bar\varepsilon \f$. A local share of what the material sees would not help, since it softens as well. With s =
/// 1 a uniform elastic body responds as a local one; a tau that did not fade would lock bands, whose strain is never
/// that of its mean. Neighbours fluctuate in volume; with initial volumes as weights the volume of all would grow by
/// more than the materials dilate, since the mean of J is larger than the exponential of the mean of log J.
template <int Dim>
class SCARP_EXPORT NonlocalMeans final : public PointMeans<Dim> {
 public:
  using Gradients = std::vector<Gradient<Dim>>;     ///< one for each point
  using Stresses = std::vector<VoigtStress<Dim>>;   ///< one for each point [Pa]
  using Tangents = std::vector<VoigtTangent<Dim>>;  ///< one for each point [Pa]

  /// neighbourhoods, and tangents [Pa] of the states that the points begin with: of all points; iteration: solves
  /// linear systems of stiffnesses that are not assembled
  /// \throws InputError for numbers that no neighbourhood can have, and counts that differ
  NonlocalMeans(NeighbourMean mean, std::span<Neighbourhood const> neighbourhoods, Tangents const& initial,
                LinearIteration iteration = gmres)
      : PointMeans<Dim>(std::move(mean), iteration),
        tau_(neighbourhoods.size(), VoigtStress<Dim>::Zero()),
        trial_(tau_),
        volume_(neighbourhoods.size(), 1.0),
        trial_volume_(volume_),
        by_own_(neighbourhoods.size(), VoigtTangent<Dim>::Zero()),
        by_mean_(by_own_) {
    if (detail::index(mean_.size()) != neighbourhoods.size() || initial.size() != neighbourhoods.size()) {
      reject("{} neighbourhoods and {} initial tangents are given for {} points: give one of each to every point",
             neighbourhoods.size(), initial.size(), mean_.size());
    }
    for (std::size_t k = 0; k < initial.size(); ++k) {
      fading_.push_back(detail::validated(neighbourhoods[k]).fading);
      stiffness_.push_back(neighbourhoods[k].stiffness * initial[k]);
    }
  }

  std::unique_ptr<PointMeans<Dim>> copy() const override { return std::make_unique<NonlocalMeans>(*this); }
  Gradients average(Gradients const& own, Executor const& executor) override {
    Gradients mean = mean_.means(own, volume_, executor);
    for (std::size_t k = 0; k < own.size(); ++k) {
      trial_volume_[k] = volume_[k] * (Tensor<Dim>::Identity() + own[k]).determinant();
      if (mean_.of(static_cast<int>(k)).size() > 1) update_tau(k, mean[k], own[k] - mean[k]);
    }
    return mean;
  }

  Stresses const& added_stresses() const override { return trial_; }
  SplitTangents<Dim> split(Tangents tangents) const override {
    SplitTangents<Dim> parts{std::move(tangents), Tangents(by_mean_.size(), VoigtTangent<Dim>::Zero())};
    for (std::size_t k = 0; k < by_mean_.size(); ++k) {
      if (mean_.of(static_cast<int>(k)).size() == 1) continue;
      parts.by_mean[k] = parts.by_own[k] + by_mean_[k];
      parts.by_own[k] = by_own_[k];
    }
    return parts;
  }

  LinearMap forces_around(LinearMap of_nodes, LinearMap of_points, Tangents tangents,
                          Executor const& executor) const override {
    return [of_nodes = std::move(of_nodes), of_points = std::move(of_points), tangents = std::move(tangents), this,
            &executor](Eigen::VectorXd const& displacement) {
      Eigen::VectorXd values = of_nodes(displacement);
      auto const of_point = [&](std::size_t k) {
        constexpr int size = voigt_size<Dim>;
        return values.segment<size>(static_cast<Eigen::Index>(size * k));
      };
      std::vector<EngineeringStrain<Dim>> strains(tangents.size());
      for (std::size_t k = 0; k < tangents.size(); ++k) strains[k] = of_point(k);
      strains = mean_.means(strains, volume_, executor);
      for (std::size_t k = 0; k < tangents.size(); ++k) of_point(k) = tangents[k] * strains[k];
      return of_points(values);
    };
  }
  void commit() override {
    for (std::size_t k = 0; k < trial_volume_.size(); ++k) {
      if (!(trial_volume_[k] > 0.0))
        reject("point {} has {} of its initial volume (it is turned inside out): take a smaller step", k,
               trial_volume_[k]);
    }
    tau_ = trial_;
    volume_ = trial_volume_;
  }

  MeanState<Dim> committed(int point) const override {
    return {tau_[detail::index(point)], volume_[detail::index(point)]};
  }
  void set_committed(int point, MeanState<Dim> const& state) override {
    tau_[detail::index(point)] = trial_[detail::index(point)] = state.tau;
    volume_[detail::index(point)] = trial_volume_[detail::index(point)] = state.volume;
  }

 private:
  using PointMeans<Dim>::mean_;

  std::array<double, 4> basis() const override {
    std::array<double, 4> sums{};
    for (int point = 0; point < mean_.size(); ++point) {
      for (auto const& [other, weight] : mean_.of(point)) {
        sums[0] += 1.0;
        sums[1] += weight * weight * (1.0 + other);
      }
      sums[2] += fading_[detail::index(point)];
      sums[3] += stiffness_[detail::index(point)].norm();
    }
    return sums;
  }

  /// tau of a point that sees one gradient and does not see another.
  void update_tau(std::size_t k, Gradient<Dim> const& mean, Gradient<Dim> const& fluctuation) {
    Tensor<Dim> const strain = (mean + mean.transpose()) / 2.0;
    double const size = strain.norm();
    double const faded = 1.0 + size / fading_[k];
    Tensor<Dim> const turn = rotation_factor<Dim, double>(Tensor<Dim>::Identity() + mean);
    VoigtStress<Dim> const whole = tau_[k] + stiffness_[k] * to_engineering_strain<Dim, double>(fluctuation);
    Tensor<Dim> const held = turned<Dim>(turn, from_voigt_stress<Dim, double>(whole)) / faded;
    trial_[k] = to_voigt_stress<Dim, double>(held);
    by_own_[k] = stiffness_[k] / faded;
    by_mean_[k] = -by_own_[k];
    if (size > 0.0) {
      by_mean_[k] -= trial_[k] * to_voigt_stress<Dim, double>(strain).transpose() / (size * fading_[k] * faded);
    }
  }

  std::vector<double> fading_;
  Tangents stiffness_;
  Stresses tau_;
  Stresses trial_;  ///< tau of the last increment
  std::vector<double> volume_;
  std::vector<double> trial_volume_;
  Tangents by_own_;
  Tangents by_mean_;
};

#ifdef SCARP_PRECOMPILED
extern template class NonlocalMeans<2>;
extern template class NonlocalMeans<3>;
#endif

/// sites, volumes [m3], neighbourhoods and tangents [Pa] of the states that they begin with: of all points
/// \throws InputError for numbers that no neighbourhood can have, and counts that differ
template <int Dim>
std::unique_ptr<PointMeans<Dim>> point_means(std::span<Site<Dim> const> sites, std::span<double const> volumes,
                                             std::span<Neighbourhood const> neighbourhoods,
                                             std::vector<VoigtTangent<Dim>> const& initial) {
  std::vector<double> lengths;
  for (auto const& neighbourhood : neighbourhoods) lengths.push_back(detail::validated(neighbourhood).length);
  return std::make_unique<NonlocalMeans<Dim>>(neighbour_mean<Dim>(sites, volumes, lengths), neighbourhoods, initial);
}

/// Any material whose points see means of the increments around them, see NonlocalMeans, so that one that softens has a
/// length of its own: `FaultScene<Nonlocal<Soil>, ...>`, or `Region{"soil", Nonlocal{soil, 2.0}}`.
/// \tparam Provider a `ConstitutiveProvider` or `AnyProvider`
template <class Provider>
struct Nonlocal {
  static constexpr int dim = Provider::dim;  ///< of the material

  Provider provider{};     ///< the material
  double length = 0.0;     ///< radius [m] of the neighbourhood; 0: the material as it is
  double stiffness = 1.0;  ///< against strain that the mean does not see, as a share of the initial tangent
  double fading = 1e-3;    ///< strain after which the stress of that stiffness has faded

  /// Settings of the means, equal for all points.
  Neighbourhood neighbourhood() const { return {length, stiffness, fading}; }

  /// How the neighbours of points are found.
  static constexpr auto means = &point_means<dim>;
};

template <class Provider, class... Numbers>
Nonlocal(Provider, Numbers...) -> Nonlocal<Provider>;

}  // namespace scarp
