// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/material_field.hpp"
#include "scarp/constitutive/neighbour_mean.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/finite_strain.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Any provider whose points see means of the increments around them, so that a material that softens has a length of
/// its own. Named in a scene, `FaultScene<Nonlocal<Soil>, ...>`, it makes the scene's materials `NonlocalMaterials`
/// (include scene/nonlocal_scene.hpp); its points are those of the provider itself.
template <CheckedProvider ProviderType>
struct Nonlocal {
  using LocalProvider = ProviderType;
  using State = typename LocalProvider::State;
  using Plan = PlanOf<LocalProvider>;
  static constexpr int dim = LocalProvider::dim;

  LocalProvider provider{};
  double length = 0.0;     ///< radius [m] of the neighbourhood; 0: the provider as it is
  double stiffness = 1.0;  ///< against strain that the mean does not see, as a share of the initial tangent
  double fading = 1e-3;    ///< strain after which the stress of that stiffness has faded

  State initial_state(Site<dim> const& site) const { return provider.initial_state(site); }
  VoigtStress<dim> stress(State const& state) const { return provider.stress(state); }
  VoigtTangent<dim> tangent(State const& state) const { return provider.tangent(state); }
  Plan plan(State const& committed, Gradient<dim> const& increment) const requires PlansWork<LocalProvider> {
    return provider.plan(committed, increment);
  }
  Plan refined(Plan const& plan) const requires PlansWork<LocalProvider> { return provider.refined(plan); }
  template <class... PlanType>
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial,
                        PlanType const&... plan) const {
    return provider.respond(committed, increment, trial, plan...);
  }
};

/// A provider that asks its field for means over neighbours.
template <class Provider>
concept AsksForMeans = ConstitutiveProvider<Provider> && requires(Provider const& provider) {
  requires ConstitutiveProvider<typename Provider::LocalProvider>;
  { provider.provider } -> std::convertible_to<typename Provider::LocalProvider const&>;
  { provider.length } -> std::convertible_to<double>;
  { provider.stiffness } -> std::convertible_to<double>;
  { provider.fading } -> std::convertible_to<double>;
};

/// How far a point looks around itself, and what holds the strain that it then does not see.
struct Neighbourhood {
  double length = 0.0;     ///< radius [m]; 0: the point is a local one
  double stiffness = 1.0;  ///< share of the point's initial tangent
  double fading = 1e-3;    ///< strain after which the stress against unseen strain has faded

  /// \throws InputError for numbers that are negative or not finite, and a fading strain of zero
  void validate() const {
    require_not_negative("length that increments are averaged over", length);
    require_not_negative("stiffness against unseen strain", stiffness);
    require_positive("strain after which unseen stress has faded", fading);
  }
};

/// Any field whose points see weighted means of the increments around them instead of their own,
/// \f$ \bar G_i = \sum_j w_{ij} G_j \f$, with weights of the reference configuration, and a stress that holds what they
/// do not see:
/// \f$ \sigma_i = \sigma_{field}(\bar G_i) + \tau_i,\;
/// \Delta\tau = s\,C^0 (\Delta\varepsilon - \Delta\bar\varepsilon) - \tau\,|\Delta\bar\varepsilon| / \varepsilon_f \f$
/// (implicit, turned with the mean's rotation). Without tau waves much shorter than the length cost nothing, and bands
/// become as thin as the mesh: strain \f$ \varepsilon = W^{-1} \bar\varepsilon \f$ belongs to any
/// \f$ \bar\varepsilon \f$. A local share of what the material sees would not help, since it softens as well. With s =
/// 1 a uniform elastic body answers as a local one; a tau that did not fade would lock bands, whose strain is never
/// that of its mean. `committed_stress` is the field's own, without tau.
template <MaterialField Field>
class NonlocalMaterials {
 public:
  static constexpr int dim = Field::dim;
  using Stresses = std::vector<VoigtStress<dim>>;
  using Tangents = std::vector<VoigtTangent<dim>>;

  /// sites, volumes [m3] and neighbourhoods: of all points of the field
  /// \throws InputError for lengths or stiffnesses that are negative or not finite, fading strains that are not
  /// positive, and counts that differ
  NonlocalMaterials(Field field, std::span<Site<dim> const> sites, std::span<double const> volumes,
                    std::span<Neighbourhood const> neighbourhoods)
      : field_(std::move(field)),
        mean_(mean_of(field_, sites, volumes, neighbourhoods)),
        committed_(sites.size(), VoigtStress<dim>::Zero()),
        trial_(committed_),
        by_own_(sites.size(), VoigtTangent<dim>::Zero()),
        by_mean_(by_own_) {
    for (std::size_t k = 0; k < sites.size(); ++k) {
      fading_.push_back(neighbourhoods[k].fading);
      stiffness_.push_back(neighbourhoods[k].stiffness * field_.committed_tangent(static_cast<int>(k)));
    }
  }

  Field const& local() const { return field_; }
  NeighbourMean<dim> const& mean() const { return mean_; }

  /// Puts what the points see in the place of their own gradients; tau belongs to them from then on.
  template <class Executor>
  void average(std::vector<Gradient<dim>>& gradients, Executor& executor) {
    own_ = gradients;
    if (mean_.is_local()) return;
    gradients = mean_.means(own_, executor);
    for (std::size_t k = 0; k < own_.size(); ++k) {
      if (mean_.of(static_cast<int>(k)).size() > 1) hold(k, gradients[k], own_[k] - gradients[k]);
    }
  }

  /// The points' own gradients in the last increment that was averaged.
  std::vector<Gradient<dim>> const& own_gradients() const { return own_; }

  /// tau [Pa] of all points in the last increment that was averaged.
  Stresses const& added_stresses() const { return trial_; }
  /// Derivatives [Pa] of the points' whole stresses by their own strains and by the means that they see, in the last increment
  /// that was averaged; tangents: the field's by what they see. A point alone has its own strain only.
  SplitTangents<dim> split(Tangents tangents) const {
    SplitTangents<dim> parts{std::move(tangents), Tangents(by_mean_.size(), VoigtTangent<dim>::Zero())};
    for (std::size_t k = 0; k < by_mean_.size(); ++k) {
      if (mean_.of(static_cast<int>(k)).size() == 1) continue;
      parts.by_mean[k] = parts.by_own[k] + by_mean_[k];
      parts.by_own[k] = by_own_[k];
    }
    return parts;
  }

  int point_count() const { return field_.point_count(); }
  void plan(int point, Gradient<dim> const& predicted) { field_.plan(point, predicted); }
  void refine_plan(int point) { field_.refine_plan(point); }
  Response<dim> respond(int point, Gradient<dim> const& increment) { return field_.respond(point, increment); }
  long work(int point) const { return field_.work(point); }
  VoigtStress<dim> committed_stress(int point) const { return field_.committed_stress(point); }
  VoigtTangent<dim> committed_tangent(int point) const { return field_.committed_tangent(point); }
  VoigtTangent<dim> trial_tangent(int point) const { return field_.trial_tangent(point); }
  void commit() {
    field_.commit();
    committed_ = trial_;
  }

  /// The composed field's, for observers.
  template <class Visit>
  void visit(int point, Visit&& visit) const {
    field_.visit(point, visit);
  }
  template <class Visit>
  void visit(int point, Visit&& visit) {
    field_.visit(point, visit);
  }

  /// What evolves: the field and tau, beside what they depend on.
  /// \throws InputError when it reads what points with other neighbours, or another stiffness against unseen strain, have come to
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(field_, mean_, fading_, stiffness_, own_, committed_, trial_, by_own_, by_mean_);
    auto const own = self.basis();
    auto saved = own;
    visit("basis", saved);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (!(std::abs(saved[k] - own[k]) <= 1e-9 * std::abs(own[k])))  // round-off of another compiler
        refuse(
            "a saved state is of points that see other means, {} for {} (another mesh, length, stiffness or fading): "
            "go on "
            "with the same ones",
            saved[k], own[k]);
    }
    visit("field", self.field_);
    visit("tau", std::span(self.committed_));
  }
  void after_loading() { trial_ = committed_; }

 private:
  static NeighbourMean<dim> mean_of(Field const& field, std::span<Site<dim> const> sites,
                                    std::span<double const> volumes, std::span<Neighbourhood const> neighbourhoods) {
    std::size_t const count = detail::index(field.point_count());
    if (sites.size() != count || volumes.size() != count || neighbourhoods.size() != count) {
      refuse("{} sites, {} volumes and {} neighbourhoods are given for {} points: give one of each to every point",
             sites.size(), volumes.size(), neighbourhoods.size(), count);
    }
    std::vector<double> lengths;
    for (auto const& neighbourhood : neighbourhoods) lengths.push_back(detail::validated(neighbourhood).length);
    return {sites, volumes, lengths};
  }

  /// Tells neighbours, their weights and the stresses against unseen strain from others.
  std::array<double, 4> basis() const {
    std::array<double, 4> sums{};
    for (int point = 0; point < point_count(); ++point) {
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
  void hold(std::size_t k, Gradient<dim> const& seen, Gradient<dim> const& unseen) {
    Tensor<dim> const strain = (seen + seen.transpose()) / 2.0;
    double const size = strain.norm();
    double const faded = 1.0 + size / fading_[k];
    Tensor<dim> const turn = rotation_factor<dim, double>(Tensor<dim>::Identity() + seen);
    VoigtStress<dim> const whole = committed_[k] + stiffness_[k] * to_engineering_strain<dim, double>(unseen);
    Tensor<dim> const turned = turn * from_voigt_stress<dim, double>(whole) * turn.transpose() / faded;
    trial_[k] = to_voigt_stress<dim, double>(turned);
    by_own_[k] = stiffness_[k] / faded;
    by_mean_[k] = -by_own_[k];
    if (size > 0.0) {
      by_mean_[k] -= trial_[k] * to_voigt_stress<dim, double>(strain).transpose() / (size * fading_[k] * faded);
    }
  }

  Field field_;
  NeighbourMean<dim> mean_;
  std::vector<double> fading_;
  Tangents stiffness_;
  std::vector<Gradient<dim>> own_;
  Stresses committed_;
  Stresses trial_;
  Tangents by_own_;
  Tangents by_mean_;
};

}  // namespace scarp
