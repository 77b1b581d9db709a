// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <any>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/interruption.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/detail/shared_values.hpp"
#include "scarp/points/point_survey.hpp"

namespace scarp {

/// A batch of material points of one or several providers: parameters, committed and trial states, plans, and means
/// over neighbours where a region has them. The material side of `Problem`, and of any program with own points:
/// \code
/// MaterialPoints<2> points(soil, sites);
/// points.gradient(0) = increment;             // of all points, since the last commit
/// ResponseReport const report = points.respond(executor);
/// if (report.verdict.acceptable()) points.commit();  // else: another increment, smaller perhaps
/// \endcode
/// Gradients are those of the displacement since the last commit by the positions at that time. Where points are shared
/// out among processes (see Executor), each evaluates its own and all know all responses. States have `quantities`.
template <int Dim>
class SCARP_EXPORT MaterialPoints {
 public:
  static constexpr int dim = Dim;                   ///< of the points
  using Gradients = std::vector<Gradient<Dim>>;     ///< one for each point
  using Responses = std::vector<Response<Dim>>;     ///< one for each point
  using Stresses = std::vector<VoigtStress<Dim>>;   ///< one for each point [Pa]
  using Tangents = std::vector<VoigtTangent<Dim>>;  ///< one for each point [Pa]

  MaterialPoints() = default;
  /// Points of several materials. material_of: number of each site's material; volumes [m3]: weights of means, empty
  /// where no material has means; owned(number of a point): whether this process evaluates it
  /// \throws InputError for a material that holds no provider, and for counts that differ
  MaterialPoints(std::vector<AnyProvider<Dim>> materials, std::span<int const> material_of,
                 std::span<Site<Dim> const> sites, std::span<double const> volumes,
                 std::function<bool(int)> const& owned)
      : materials_(std::move(materials)) {
    if (!volumes.empty() && volumes.size() != sites.size())
      reject("{} volumes are given for {} points: give one to each, or none", volumes.size(), sites.size());
    if (material_of.size() != sites.size())
      reject("{} numbers of materials are given for {} points: give one to each", material_of.size(), sites.size());
    auto const is_none = [&](int number) { return number < 0 || number >= std::ssize(materials_); };
    if (auto const wrong = std::ranges::find_if(material_of, is_none); wrong != material_of.end())
      reject("a point has the material {} (there are {}): use numbers from 0 on", *wrong, materials_.size());
    if (std::ranges::any_of(materials_, [](auto const& one) { return !one.batch_; }))
      reject("an AnyProvider is used that holds no provider: assign one to it first");
    auto const nonlocal = std::ranges::find_if(materials_, [](auto const& one) { return one.means_ != nullptr; });
    bool const search = nonlocal != materials_.end();
    for (int point = 0; point < std::ssize(sites); ++point) {
      InterruptionCheck::run();
      auto const k = detail::index(point);
      // The stiffness against fluctuation strain follows from the states of all points.
      bool const here = search || owned(point);
      add(material_of[k], materials_[detail::index(material_of[k])].batch_->add(sites[k], point, here));
      if (owned(point)) owned_.push_back(point);
    }
    if (!search) return;
    std::vector<Neighbourhood> neighbourhoods;
    Tangents initial;
    for (int point = 0; point < size(); ++point) {
      neighbourhoods.push_back(material(point).neighbourhood_);
      initial.push_back(committed_tangent(point));
    }
    average(nonlocal->means_(sites, volumes, neighbourhoods, initial));
    for (int point = 0; point < size(); ++point) {
      if (!owned(point)) release(point);
    }
  }

  /// Points of one material in all regions; means do not reach across these. owned: without, all are of this process
  /// \throws InputError for counts that differ
  template <CheckedMaterial MaterialType>
    requires(MaterialType::dim == Dim)
  MaterialPoints(
      MaterialType const& material, std::span<Site<Dim> const> sites, std::span<double const> volumes = {},
      std::function<bool(int)> const& owned = [](int) { return true; })
      : MaterialPoints({AnyProvider<Dim>(material)}, std::vector<int>(sites.size()), sites, volumes, owned) {}

  int size() const { return detail::count(places_); }  ///< Number of points, those of other processes included.
  /// Lets the points see means of their gradients from now on; nothing where every mean is the value itself.
  /// \throws InputError for means over another number of points
  void average(std::unique_ptr<PointMeans<Dim>> means) {
    if (means && means->mean().size() != size())
      reject("means are over {} points (there are {}): make them of all sites", means->mean().size(), size());
    means_ = means && !means->mean().is_local() ? std::move(means) : nullptr;
  }
  /// Means that the points see; null where each sees its own gradient.
  PointMeans<Dim> const* means() const { return means_.get(); }

  /// Cauchy stress [Pa] of a point's committed state, without the stabilising stress of means.
  VoigtStress<Dim> committed_stress(int point) const { return batch(point).stress(local(point)); }
  /// Tangent [Pa] of a point's committed state.
  VoigtTangent<Dim> committed_tangent(int point) const { return batch(point).tangent(local(point)); }
  /// Tangent [Pa] of the state that a point began with, made anew.
  VoigtTangent<Dim> initial_tangent(int point) const { return batch(point).initial_tangent(local(point)); }
  /// Whether the tangents of all points' trial states are derivatives of their responses.
  bool have_exact_tangents() const {
    return std::ranges::all_of(materials_, [](auto const& one) { return one.batch_->has_exact_tangent(); });
  }
  /// Inner (DEM) steps of one response of a point; a weight for partitioning.
  long work(int point) const { return batch(point).work(local(point)); }
  /// Named numbers of a committed state; of a packing void ratio, coordination, balance, in the plane fabrics.
  Quantities quantities(int point) const { return picture<Quantities>(point).value_or(Quantities{}); }
  /// How well the packing of a committed state is balanced; nothing of points without one, and of one that is fluid.
  PackingBalance packing_balance(int point) const { return picture<PackingBalance>(point).value_or(PackingBalance{}); }
  /// What a provider shows of a committed state; nothing where that is no picture.
  template <class Picture>
  std::optional<Picture> picture(int point) const {
    std::any shown = batch(point).shown(local(point), typeid(Picture));
    auto* picture = std::any_cast<Picture>(&shown);
    return picture ? std::optional<Picture>(std::move(*picture)) : std::nullopt;
  }
  /// Stress [Pa] of a stiffness floor in a committed state.
  VoigtStress<Dim> floor_stress(int point) const { return batch(point).floor_stress(local(point)); }
  /// The committed state of a point. \throws InputError unless it is of this type
  template <class State>
  State const& state(int point) const {
    auto const state = picture<State const*>(point);
    if (!state) reject("the state of point {} is requested as another type: take its provider's State", point);
    return **state;
  }

  /// The bits of points' committed states, those of means included; what states share, such as grains, is in it once.
  /// \throws InputError for states that name no members
  std::string pack(std::span<int const> points) const;
  std::string pack(int point) const { return pack(std::span(&point, 1)); }  ///< Bits of one point's committed state.
  /// Other committed states for points, between load steps, by bits of the same providers; shared parts stay so.
  /// \throws InputError for other bits, and for points that are named twice, without any change
  void unpack(std::span<int const> points, std::string_view bits);
  void unpack(int point, std::string_view bits) { unpack(std::span(&point, 1), bits); }  ///< One point.
  /// Gives a point the committed state of another one, as for the children of a refined element; between load steps. In
  /// the mirror of its principal stresses if wanted: the stress stays, and one packing's accidents are not repeated.
  /// \throws InputError for other types of providers, one with means and one without, and states without mirror images
  void copy(int to, MaterialPoints const& from, int point, bool is_mirrored = false);
  /// The point alone, with the state of these bits and without neighbours.
  MaterialPoints extract(int point, std::string_view bits) const;
  void release(int point) { batch(point).release(local(point)); }  ///< Leaves its state to the process that owns it.
  /// What evolves: committed states and those of means. Read in, all are here until released; only own points respond.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit);

  /// Displacement gradient of a point since the last commit, for `respond`; to be set anew after each commit.
  Gradient<Dim>& gradient(int point) { return own_[detail::index(existing(point))]; }
  /// Responses to the gradients of all points: DEM steps are planned at the first response after a commit, and anew for
  /// gradients that need half as many again; points that do not converge take more, at most max_refinements times.
  /// \throws InputError for gradients that are not finite
  ResponseReport respond(Executor const& executor, int max_refinements = 8);
  /// Sets all points' own gradients, and what the points see of them.
  void set_gradients(Gradients own, Executor const& executor);
  /// Fixes every point's number of inner steps from its mean gradient, so that responses are smooth until the next.
  void plan() {
    for (int const point : owned_) batch(point).plan(local(point), seen_[detail::index(point)]);
    is_planned_ = true;
  }
  /// All points respond from their committed states to what they see, with the planned work, or more if far too little.
  ResponseReport evaluate(Executor const& executor) { return evaluate(owned_, executor); }
  /// Points whose last response is not converged take more inner steps, now and until the next plan, if they can.
  ResponseReport refine(Executor const& executor);
  /// The committed stresses as responses: no point has moved.
  void evaluate_committed(Executor const& executor);
  /// Leaves the committed states as they are; the next response plans its work anew, as it should for a smaller step.
  void discard() { is_planned_ = has_trial_ = false; }
  /// The trial states, of the last responses, become the committed ones.
  /// \throws InputError where there is no response since the last commit or discard
  void commit() {
    if (!has_trial_) reject("a commit without a response since the last one (nothing would be kept): respond first");
    if (means_) means_->commit();
    for (auto& one : materials_) one.batch_->commit();
    discard();
  }

  /// Gradients of the points' own displacements, before means.
  Gradients const& own_gradients() const { return own_; }
  /// What the points see: means where there are some.
  Gradients const& gradients() const { return seen_; }
  /// The materials' last responses, without the stabilising stress of means.
  Responses const& responses() const { return responses_; }
  /// Cauchy stress [Pa] of a point's last response, with the stabilising stress of means.
  VoigtStress<Dim> stress(int point) const {
    auto const k = detail::index(existing(point));
    return means_ ? VoigtStress<Dim>(responses_[k].stress + means_->added_stresses()[k]) : responses_[k].stress;
  }
  /// Cauchy stresses [Pa] of the last responses, with the stabilising stress of means.
  Stresses stresses() const {
    Stresses values;
    for (int point = 0; point < size(); ++point) values.push_back(stress(point));
    return values;
  }
  /// Cauchy stresses [Pa] of all points' committed states, without the stabilising stress of means.
  Stresses committed_stresses(Executor const& executor) const {
    Stresses values(detail::index(size()));
    for (int const point : owned_) values[detail::index(point)] = committed_stress(point);
    executor.share(values);
    return values;
  }
  /// Committed stresses with the committed stabilising stress: those that balance the loads.
  Stresses balanced_stresses(Executor const& executor) const {
    Stresses values = committed_stresses(executor);
    if (!means_) return values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += means_->committed(static_cast<int>(k)).tau;
    return values;
  }
  /// Tangent [Pa] of a point's trial state.
  VoigtTangent<Dim> tangent(int point) const { return batch(point).trial_tangent(local(point)); }
  /// Tangents [Pa] of all points' committed states for engineering strain.
  Tangents committed_tangents(Executor const& executor) const {
    return all_tangents(executor, &MaterialPoints::committed_tangent);
  }
  /// Tangents [Pa] of all points' trial states for engineering strain.
  Tangents tangents(Executor const& executor) const { return all_tangents(executor, &MaterialPoints::tangent); }
  /// Right after a commit: the committed response once more from its initial state, with twice the inner steps.
  DoubledResponse<Dim> doubled_response(int point) const {
    return batch(point).doubled(local(point), seen_[detail::index(point)], nullptr);
  }
  /// Right after a commit: takes a copy of the point's state, in bits, through the committed increment with twice the
  /// work; without bits it begins with the committed state and has no response. States without members have none.
  DoubledResponse<Dim> doubled_path(int point, std::string& bits) const {
    return batch(point).doubled(local(point), seen_[detail::index(point)], &bits);
  }

 private:
  /// Where a point is.
  struct Place {
    int material;
    int local;  ///< number within the batch of the material
  };
  using KeptState = std::pair<std::any, MeanState<Dim>>;  ///< a committed state, as a batch and the means keep it

  /// The number of a point. \throws InputError where there is no such point
  int existing(int point) const {
    if (point < 0 || point >= size())
      reject("point {} is named (there are {} points): use numbers from 0 to {}", point, size(), size() - 1);
    return point;
  }
  AnyProvider<Dim> const& material(int point) const {
    return materials_[detail::index(places_[detail::index(existing(point))].material)];
  }
  detail::PointBatch<Dim> const& batch(int point) const { return *material(point).batch_; }
  detail::PointBatch<Dim>& batch(int point) { return *material(point).batch_; }
  int local(int point) const { return places_[detail::index(point)].local; }

  void add(int material, int local) {
    places_.push_back({material, local});
    own_.push_back(Gradient<Dim>::Zero());
    seen_.push_back(Gradient<Dim>::Zero());
    responses_.emplace_back();
    works_.push_back(0);
  }

  /// Also of points that lie too far apart to see each other: states go between these and closer ones.
  bool has_means() const {
    return means_ || std::ranges::any_of(materials_, [](auto const& one) { return one.means_ != nullptr; });
  }
  void write(std::span<int const> points, StateWriter& writer) const;
  std::vector<KeptState> read(std::span<int const> points, StateReader& reader) const;
  void put(std::span<int const> points, std::vector<KeptState> states);

  /// selected: points of this process
  ResponseReport evaluate(std::vector<int> selected, Executor const& executor);
  Tangents all_tangents(Executor const& executor, VoigtTangent<Dim> (MaterialPoints::*of)(int) const) const;

  std::vector<AnyProvider<Dim>> materials_;  ///< with the batches of their points
  std::vector<Place> places_;
  std::vector<int> owned_;        ///< points of this process
  detail::HeldMeans<Dim> means_;  ///< none where each point sees its own gradient
  bool is_planned_ = false;       ///< whether inner steps are fixed for the load step
  bool has_trial_ = false;        ///< whether there is a response since the last commit or discard
  Gradients own_;
  Gradients seen_;
  Responses responses_;
  std::vector<long> works_;  ///< inner steps of the points' last responses
  SharedParts shared_;       ///< of states that were unpacked
};

}  // namespace scarp

#include "scarp/points/evaluated_points.hpp"
#include "scarp/points/stored_states.hpp"

#ifdef SCARP_PRECOMPILED
namespace scarp {
extern template class MaterialPoints<2>;
extern template class MaterialPoints<3>;
}  // namespace scarp
#endif
