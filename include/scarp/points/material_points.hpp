// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <any>
#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/index.hpp"
#include "scarp/points/detail/point_batch.hpp"
#include "scarp/points/point_means.hpp"
#include "scarp/points/point_survey.hpp"
#include "scarp/points/region.hpp"

namespace scarp {

/// A batch of material points of one or several providers: parameters, committed and trial states, plans, and means over neighbours
/// where a region has them. The material side of `EquilibriumProblem`, and of any program that has points of its own:
/// \code
/// MaterialPoints<2> points(soil, sites);
/// points.gradient(0) = increment;             // of all points, since the last commit
/// ResponseReport const report = points.respond(executor);
/// if (report.verdict.acceptable()) points.commit();  // else: another increment, smaller perhaps
/// \endcode
/// Gradients are those of the displacement since the last commit by the positions at that time. Where points are shared out among
/// processes (see SharesPoints), each evaluates its own and all know all responses. Types of providers are hidden: what a state
/// holds is read by name (`quantities`), or by its type (`state`).
template <int Dim>
class MaterialPoints {
 public:
  static constexpr int dim = Dim;
  using Gradients = std::vector<Gradient<Dim>>;
  using Responses = std::vector<Response<Dim>>;
  using Stresses = std::vector<VoigtStress<Dim>>;
  using Tangents = std::vector<VoigtTangent<Dim>>;

  MaterialPoints() = default;

  /// Points of several regions; a site's region is the number of its name in `names`.
  /// volumes [m3]: weights of means, empty where no region has means; owned(number of a point): whether this process evaluates it
  /// \throws InputError for a region that has no name here, is given twice or has no material, and for counts that differ
  template <class... Materials, std::predicate<int> Owned>
  MaterialPoints(boost::hana::tuple<Region<Materials>...> const& regions, std::span<std::string const> names,
                 std::span<Site<Dim> const> sites, std::span<double const> volumes, Owned const& owned) {
    std::vector<int> numbers(names.size(), -1);
    boost::hana::for_each(regions, [&](auto const& region) {
      auto const named = std::ranges::find(names, region.name);
      if (named == names.end()) {
        reject("there is no region '{}' (the mesh has: {}): use one of these names", region.name, listed(names));
      }
      int& number = numbers[static_cast<std::size_t>(named - names.begin())];
      if (number >= 0) reject("region '{}' is given two providers (only one can respond): leave one out", region.name);
      number = add_material(region.provider);
    });
    for (std::size_t k = 0; k < sites.size(); ++k) {
      int const region = sites[k].region;
      if (region < 0 || region >= std::ssize(numbers) || numbers[detail::index(region)] < 0) {
        reject("region '{}' of the mesh has no provider (point {} lies in it): add a Region of this name",
               region < 0 || region >= std::ssize(names) ? fmt::to_string(region) : names[detail::index(region)], k);
      }
    }
    fill(
        sites, volumes, [&](Site<Dim> const& site) { return numbers[detail::index(site.region)]; }, owned);
  }

  /// Points of one material, whatever their regions are; means do not reach across these.
  /// \throws InputError for counts that differ
  template <CheckedMaterial MaterialType, std::predicate<int> Owned>
  MaterialPoints(MaterialType const& material, std::span<Site<Dim> const> sites, std::span<double const> volumes,
                 Owned const& owned) {
    int const number = add_material(material);
    fill(
        sites, volumes, [&](Site<Dim> const&) { return number; }, owned);
  }
  template <CheckedMaterial MaterialType>
  MaterialPoints(MaterialType const& material, std::span<Site<Dim> const> sites, std::span<double const> volumes = {})
      : MaterialPoints(material, sites, volumes, [](int) { return true; }) {}

  int size() const { return detail::count(places_); }

  /// Lets the points see means of their gradients from now on; nothing where every mean is the value itself.
  /// \throws InputError for means over another number of points
  void average(PointMeans<Dim> means) {
    if (means.mean().size() != size())
      reject("means are over {} points (there are {}): make them of all sites", means.mean().size(), size());
    means_.reset();
    if (!means.mean().is_local()) means_ = std::move(means);
  }
  /// Means that the points see; null where each sees its own gradient.
  PointMeans<Dim> const* means() const { return means_ ? &*means_ : nullptr; }

  /// Displacement gradient of a point since the last commit, for `respond`; to be set anew after each commit.
  Gradient<Dim>& gradient(int point) { return own_[detail::index(existing(point))]; }

  /// Responses to the gradients of all points: DEM steps are planned at the first response after a commit, and points that do not converge take
  /// harder, up to so many times and until the next commit.
  /// \throws InputError for gradients that are not finite
  template <ExecutesTasks Executor>
  ResponseReport respond(Executor& executor, int max_refinements = 4) {
    for (int point = 0; point < size(); ++point) {
      if (!own_[detail::index(point)].allFinite())
        reject("the displacement gradient of point {} is not finite: take a smaller step", point);
    }
    set_gradients(own_, executor);
    if (!is_planned_) plan();
    ResponseReport answers = evaluate(executor);
    for (int k = 0; k < max_refinements && answers.verdict.status == Status::not_converged; ++k)
      answers = refine(executor);
    return answers;
  }

  /// Sets all points' own gradients, and what the points see of them.
  template <ExecutesTasks Executor>
  void set_gradients(Gradients own, Executor& executor) {
    if (own.size() != places_.size())
      reject("{} displacement gradients are given for {} points: give one to each", own.size(), places_.size());
    own_ = std::move(own);
    seen_ = means_ ? means_->average(own_, executor) : own_;
  }

  /// Fixes every point's number of inner steps from its mean gradient, so that responses are smooth functions of gradients until the next plan.
  void plan() {
    for (int const point : owned_) batch(point).plan(local(point), seen_[detail::index(point)]);
    is_planned_ = true;
  }

  /// All points respond from their committed states to what they see, with the work that is planned.
  template <ExecutesTasks Executor>
  ResponseReport evaluate(Executor& executor) {
    return evaluate(owned_, executor);
  }

  /// Points whose last response is not converged take more inner steps, now and until the next plan; one that cannot would only repeat its response.
  template <ExecutesTasks Executor>
  ResponseReport refine(Executor& executor) {
    std::vector<int> harder;
    for (int const point : owned_) {
      if (responses_[detail::index(point)].verdict.status == Status::not_converged && batch(point).refine(local(point)))
        harder.push_back(point);
    }
    return evaluate(harder, executor);
  }

  /// The committed stresses as responses: no point has moved.
  template <ExecutesTasks Executor>
  void evaluate_committed(Executor& executor) {
    auto const committed = committed_stresses(executor);
    for (std::size_t k = 0; k < committed.size(); ++k) responses_[k] = {committed[k], {}};
    set_gradients(Gradients(committed.size(), Gradient<Dim>::Zero()), executor);
  }

  /// Leaves the committed states as they are; the next response plans its work anew, as it should for a smaller step.
  void discard() { is_planned_ = has_trial_ = false; }

  /// The trial states, of the last responses, become the committed ones.
  /// \throws InputError where there is no response since the last commit or discard
  void commit() {
    if (!has_trial_) reject("a commit without a response since the last one (nothing would be kept): respond first");
    for (auto& one : batches_) one->commit();
    if (means_) means_->commit();
    is_planned_ = has_trial_ = false;
  }

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
  Stresses stresses() const {
    Stresses values(places_.size());
    for (int point = 0; point < size(); ++point) values[detail::index(point)] = stress(point);
    return values;
  }
  /// Of the committed states, as the next ones: without the stabilising stress.
  VoigtStress<Dim> committed_stress(int point) const { return batch(point).stress(local(point)); }
  VoigtTangent<Dim> committed_tangent(int point) const { return batch(point).tangent(local(point)); }
  template <ExecutesTasks Executor>
  Stresses committed_stresses(Executor& executor) const {
    Stresses values(places_.size());
    for (int const point : owned_) values[detail::index(point)] = committed_stress(point);
    share(values, executor);
    return values;
  }
  /// Committed stresses with the stabilising stress: those that balance the loads after a commit.
  template <ExecutesTasks Executor>
  Stresses balanced_stresses(Executor& executor) const {
    Stresses values = committed_stresses(executor);
    if (!means_) return values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += means_->added_stresses()[k];
    return values;
  }
  /// Tangent [Pa] of a point's trial state.
  VoigtTangent<Dim> tangent(int point) const { return batch(point).trial_tangent(local(point)); }
  template <ExecutesTasks Executor>
  Tangents committed_tangents(Executor& executor) const {
    return all_tangents(executor, [&](int point) { return committed_tangent(point); });
  }
  template <ExecutesTasks Executor>
  Tangents tangents(Executor& executor) const {
    return all_tangents(executor, [&](int point) { return tangent(point); });
  }
  /// Tangent [Pa] of the state that a point began with, made anew.
  VoigtTangent<Dim> initial_tangent(int point) const { return batch(point).initial_tangent(local(point)); }

  /// Inner (DEM) steps of one response of a point; a weight for partitioning.
  long work(int point) const { return batch(point).work(local(point)); }

  /// Named numbers of a committed state; of a packing void ratio, coordination, balance, in the plane fabrics.
  Quantities quantities(int point) const { return batch(point).quantities(local(point)); }
  /// How well the packing of a committed state is balanced; nothing of points without one, and of one that is fluid.
  PackingBalance packing_balance(int point) const { return batch(point).balance(local(point)); }
  /// What a provider shows of a committed state; nothing where that is no picture.
  template <class Picture>
  std::optional<Picture> picture(int point) const {
    std::any shown = batch(point).picture(local(point));
    auto* picture = std::any_cast<Picture>(&shown);
    return picture ? std::optional<Picture>(std::move(*picture)) : std::nullopt;
  }
  /// Stress [Pa] of a stiffness floor in a committed state.
  VoigtStress<Dim> floor_stress(int point) const { return batch(point).floor_stress(local(point)); }

  /// The committed state of a point. \throws InputError unless it is of this type
  template <class State>
  State const& state(int point) const {
    auto const* state = static_cast<State const*>(batch(point).state(local(point), typeid(State)));
    if (!state) reject("the state of point {} is requested as another type: take its provider's State", point);
    return *state;
  }
  /// The provider of a point. \throws InputError unless it is of this type
  template <class Provider>
  Provider const& provider(int point) const {
    auto const* provider = static_cast<Provider const*>(batch(point).provider(typeid(Provider)));
    if (!provider) reject("the provider of point {} is requested as another type: take its own", point);
    return *provider;
  }

  /// Right after a commit: the committed response once more from its initial state, with twice the inner steps.
  DoubledResponse<Dim> doubled_response(int point) const {
    return batch(point).doubled_response(local(point), seen_[detail::index(point)]);
  }
  /// Right after a commit: takes a copy of the point's state, in bits, through the committed increment with twice the work; without
  /// bits it begins with the committed state and has no response. Of states that name no members bits stay empty.
  DoubledResponse<Dim> doubled_path(int point, std::string& bits) const {
    return batch(point).doubled_path(local(point), seen_[detail::index(point)], bits);
  }

  /// The bits of points' committed states, tau of means included; what states share, such as grains, is in it once.
  /// \throws InputError for states that name no members
  std::string pack(std::span<int const> points) const {
    StateWriter writer;
    for (int const point : points) {
      batch(point).write(local(point), writer);
      if (means_) writer("tau", means_->committed_tau(point));
    }
    return std::move(writer.bits());
  }
  std::string pack(int point) const { return pack(std::span(&point, 1)); }
  /// Other committed states for points, between load steps, by the bits of as many points of the same providers; points share again
  /// what those shared.
  /// \throws InputError for other bits, and for points that are named twice, without any change
  void unpack(std::span<int const> points, std::string_view bits) {
    StateReader reader(bits, &shared_);
    std::vector<std::pair<std::any, VoigtStress<Dim>>> states;
    for (int const point : points) {
      if (std::ranges::count(points, point) > 1)
        reject("point {} is to be unpacked twice: name each point once", point);
      states.emplace_back(batch(point).read(local(point), reader), VoigtStress<Dim>::Zero());
      if (means_) reader("tau", states.back().second);
    }
    if (!reader.at_end())
      reject("it holds more than the states of {} points: unpack what was packed of such points", points.size());
    for (std::size_t k = 0; k < points.size(); ++k) put(points[k], std::move(states[k].first), states[k].second);
  }
  void unpack(int point, std::string_view bits) { unpack(std::span(&point, 1), bits); }
  /// Gives a point the committed state of another one, as for the children of a refined element; between load steps. In the mirror
  /// x -> -x if wanted, so that one packing's accidents are not repeated.
  /// \throws InputError for a point of another type of provider, for one with means and one without, and for states that cannot be mirrored
  void copy(int to, MaterialPoints const& from, int point, bool is_mirrored = false) {
    if (means_.has_value() != from.means_.has_value())
      reject("point {} is to be copied between points with means and points without: take the same material for both",
             point);
    VoigtStress<Dim> tau = from.means_ ? from.means_->committed_tau(point) : VoigtStress<Dim>::Zero();
    if (is_mirrored) tau = mirrored_stress<Dim>(tau);
    put(to, batch(to).state_from(from.batch(point), from.local(point), is_mirrored), tau);
  }
  /// The point alone, with the state of these bits and without neighbours.
  MaterialPoints extract(int point, std::string_view bits) const {
    MaterialPoints one;
    one.batches_.emplace_back(batch(point).without_points());
    one.add(0, batch(point).site(local(point)), false);
    StateReader reader(bits);
    auto state = one.batch(0).read(0, reader);
    if (VoigtStress<Dim> tau; means_) reader("tau", tau);
    if (!reader.at_end())
      reject("it holds more than the state of point {}: extract what was packed of this point", point);
    one.put(0, std::move(state), VoigtStress<Dim>::Zero());
    return one;
  }
  /// Leaves a point without state, since another process owns it.
  void release(int point) { batch(point).release(local(point)); }

  /// What evolves: the committed states, and tau of means. Read in, those of all points are here until they are forgotten; only own
  /// points respond.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(batches_, neighbourhoods_, search_, places_, owned_, own_, seen_, responses_, works_, means_,
                      is_planned_, has_trial_, shared_);
    using Visitor = std::remove_cvref_t<Visit>;
    if (self.means_) PointMeans<Dim>::basis_members(*self.means_, visit);
    for (auto& one : self.batches_) {
      if constexpr (std::same_as<Visitor, StateWriter>) one->write_all(visit);
      if constexpr (std::same_as<Visitor, StateReader>) one->read_all(visit);
    }
    if (self.means_) visit("means", *self.means_);
  }
  void after_loading() { is_planned_ = has_trial_ = false; }

 private:
  struct Place {
    int batch;
    int local;
  };
  /// A batch that is copied with its points.
  struct Batch {
    std::unique_ptr<detail::PointBatch<Dim>> held;

    Batch(std::unique_ptr<detail::PointBatch<Dim>> batch) : held(std::move(batch)) {}
    Batch(Batch const& other) : held(other.held->copy()) {}
    Batch(Batch&&) noexcept = default;
    Batch& operator=(Batch other) noexcept {
      held = std::move(other.held);
      return *this;
    }
    ~Batch() = default;
    detail::PointBatch<Dim>* operator->() { return held.get(); }
    detail::PointBatch<Dim> const* operator->() const { return held.get(); }
  };
  using Search = PointMeans<Dim> (*)(std::span<Site<Dim> const>, std::span<double const>,
                                     std::span<Neighbourhood const>, Tangents const&);

  int existing(int point) const {
    if (point < 0 || point >= size())
      reject("point {} is named (there are {} points): use numbers from 0 to {}", point, size(), size() - 1);
    return point;
  }
  detail::PointBatch<Dim>& batch(int point) {
    return *batches_[detail::index(places_[detail::index(existing(point))].batch)].held;
  }
  detail::PointBatch<Dim> const& batch(int point) const {
    return *batches_[detail::index(places_[detail::index(existing(point))].batch)].held;
  }
  int local(int point) const { return places_[detail::index(point)].local; }

  /// \return number of its batch
  template <class MaterialType>
  int add_material(MaterialType const& material) {
    static_assert(MaterialType::dim == Dim, "scarp: all materials have the dimension of the points");
    if constexpr (ConstitutiveProvider<MaterialType>) {
      batches_.emplace_back(
          std::make_unique<detail::PointBatchOf<MaterialType>>(std::make_shared<MaterialType const>(material)));
    } else if constexpr (requires { material.batch(); }) {
      batches_.emplace_back(material.batch());
    } else {
      add_material(material.provider);
      neighbourhoods_.back() = detail::validated(material.neighbourhood());
      search_ = MaterialType::means;
      return detail::count(batches_) - 1;
    }
    neighbourhoods_.emplace_back();
    return detail::count(batches_) - 1;
  }

  /// Every process makes states for all points where some see means, since the stiffness against fluctuation strain follows from them.
  template <class BatchOf, class Owned>
  void fill(std::span<Site<Dim> const> sites, std::span<double const> volumes, BatchOf const& batch_of,
            Owned const& owned) {
    if (!volumes.empty() && volumes.size() != sites.size())
      reject("{} volumes are given for {} points: give one to each, or none", volumes.size(), sites.size());
    for (int point = 0; point < std::ssize(sites); ++point) {
      auto const& site = sites[detail::index(point)];
      add(batch_of(site), site, search_ || owned(point));
      if (owned(point)) owned_.push_back(point);
    }
    if (!search_) return;
    std::vector<Neighbourhood> neighbourhoods;
    Tangents initial;
    for (int point = 0; point < size(); ++point) {
      neighbourhoods.push_back(neighbourhoods_[detail::index(places_[detail::index(point)].batch)]);
      initial.push_back(committed_tangent(point));
    }
    average(search_(sites, volumes, neighbourhoods, initial));
    for (int point = 0; point < size(); ++point) {
      if (!owned(point)) release(point);
    }
  }

  void put(int point, std::any state, VoigtStress<Dim> const& tau) {
    batch(point).put(local(point), std::move(state));
    if (means_) means_->set_committed_tau(point, tau);
    is_planned_ = has_trial_ = false;
  }

  void add(int batch, Site<Dim> const& site, bool here) {
    auto& among = batches_[detail::index(batch)];
    places_.push_back({batch, among->size()});
    among->add(site, size() - 1, here);
    own_.push_back(Gradient<Dim>::Zero());
    seen_.push_back(own_.back());
    responses_.emplace_back();
    works_.push_back(0);
  }

  /// Completes an array over all points by what other processes know.
  template <class Value, class Executor>
  static void share(std::vector<Value>& values, Executor& executor) {
    if constexpr (SharesPoints<Executor>) executor.share(values);
  }

  /// selected: points of this process
  template <class Executor>
  ResponseReport evaluate(std::vector<int> selected, Executor& executor) {
    // The longest responses first: one that begins last would keep the other threads waiting.
    std::ranges::stable_sort(selected, std::ranges::greater{}, [&](int point) { return work(point); });
    std::vector<int> own;
    for (int const point : selected) own.push_back(local(point));
    // Points that work are tasks of their own, others of one batch go together.
    constexpr int max_together = 64;
    std::vector<int> first{0};
    for (int k = 1; k < std::ssize(selected); ++k) {
      int const point = selected[detail::index(k)];
      if (work(point) > 0 || k - first.back() == max_together ||
          &batch(point) != &batch(selected[detail::index(k - 1)]))
        first.push_back(k);
    }
    if (!selected.empty()) first.push_back(detail::count(selected));
    together(executor, [&] {
      executor.for_each(detail::count(first) - 1, [&](int task) {
        auto const from = detail::index(first[detail::index(task)]);
        auto const count = detail::index(first[detail::index(task + 1)]) - from;
        batch(selected[from]).respond(std::span(own).subspan(from, count), seen_, responses_);
      });
    });
    constexpr long not_asked = -1;
    std::vector<long> worked(places_.size(), not_asked);
    for (int const point : selected) {
      auto& response = responses_[detail::index(point)];
      // Prescribed nodes would hide a NaN from the residual of the free ones.
      if (!response.stress.allFinite()) response.verdict = {Status::failed, Reason::not_finite};
      worked[detail::index(point)] = work(point);
    }
    share(responses_, executor);
    share(worked, executor);
    has_trial_ = true;
    ResponseReport answers;
    for (int point = 0; point < size(); ++point) {
      auto const k = detail::index(point);
      if (worked[k] != not_asked) {
        works_[k] = worked[k];
        answers.inner_steps += worked[k];
      }
      Verdict const verdict = responses_[k].verdict;
      answers.points.add(point, verdict.status, works_[k]);
      if (!verdict.acceptable() && (answers.worst_point < 0 || verdict.status > answers.verdict.status)) {
        answers.verdict = verdict;
        answers.worst_point = point;
      }
    }
    return answers;
  }

  template <class Executor, class TangentOf>
  Tangents all_tangents(Executor& executor, TangentOf const& tangent_of) const {
    Tangents values(places_.size());
    together(executor, [&] {
      executor.for_each(detail::count(owned_), [&](int task) {
        int const point = owned_[detail::index(task)];
        values[detail::index(point)] = tangent_of(point);
      });
    });
    share(values, executor);
    return values;
  }

  std::vector<Batch> batches_;
  std::vector<Neighbourhood> neighbourhoods_;  ///< of the batches
  Search search_ = nullptr;                    ///< where points see means
  std::vector<Place> places_;
  std::vector<int> owned_;  ///< points of this process
  Gradients own_;
  Gradients seen_;
  Responses responses_;
  std::vector<long> works_;  ///< inner steps of the points' last responses
  std::optional<PointMeans<Dim>> means_;
  bool is_planned_ = false;
  bool has_trial_ = false;  ///< whether there is a response since the last commit or discard
  SharedParts shared_;      ///< of states that were unpacked
};

}  // namespace scarp
