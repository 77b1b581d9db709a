// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <any>
#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/points/any_provider.hpp"

namespace scarp {

/// The states of material points of one or several providers, as `MaterialPoints` holds them: made at sites, read by name or type,
/// copied, sent and saved. Types of providers are hidden: what a state holds is read by name (`quantities`), or by its type (`state`).
template <int Dim>
class SCARP_EXPORT PointStates {
 public:
  static constexpr int dim = Dim;                   ///< of the points
  using Stresses = std::vector<VoigtStress<Dim>>;   ///< one for each point [Pa]
  using Tangents = std::vector<VoigtTangent<Dim>>;  ///< one for each point [Pa]

  PointStates() = default;
  /// Points of several regions; a site's region is the number of its name in `names`.
  /// volumes [m3]: weights of means, empty where no region has means; owned(number of a point): whether this process evaluates it
  /// \throws InputError for a region that has no name here, is given twice or has no material, and for counts that differ
  PointStates(std::vector<Region<AnyProvider<Dim>>> const& regions, std::span<std::string const> names,
              std::span<Site<Dim> const> sites, std::span<double const> volumes,
              std::function<bool(int)> const& owned) {
    std::vector<int> numbers(names.size(), -1);
    for (auto const& region : regions) {
      auto const named = std::ranges::find(names, region.name);
      if (named == names.end()) {
        reject("there is no region '{}' (the mesh has: {}): use one of these names", region.name, listed(names));
      }
      int& number = numbers[static_cast<std::size_t>(named - names.begin())];
      if (number >= 0) reject("region '{}' is given two providers (only one can respond): leave one out", region.name);
      number = add_material(region.provider);
    }
    for (std::size_t k = 0; k < sites.size(); ++k) {
      int const region = sites[k].region;
      if (region < 0 || region >= std::ssize(numbers) || numbers[detail::index(region)] < 0) {
        reject("region '{}' of the mesh has no provider (point {} lies in it): add a Region of this name",
               region < 0 || region >= std::ssize(names) ? std::to_string(region) : names[detail::index(region)], k);
      }
    }
    fill(sites, volumes, owned, [&](Site<Dim> const& site) { return numbers[detail::index(site.region)]; });
  }

  /// Points of several regions, of different types.
  template <class... Materials>
  PointStates(boost::hana::tuple<Region<Materials>...> const& regions, std::span<std::string const> names,
              std::span<Site<Dim> const> sites, std::span<double const> volumes, std::function<bool(int)> const& owned)
      : PointStates(listed_regions(regions), names, sites, volumes, owned) {}

  /// Points of one material, whatever their regions are; means do not reach across these. owned: without, all are of this process
  /// \throws InputError for counts that differ
  PointStates(
      AnyProvider<Dim> const& material, std::span<Site<Dim> const> sites, std::span<double const> volumes = {},
      std::function<bool(int)> const& owned = [](int) { return true; }) {
    int const number = add_material(material);
    fill(sites, volumes, owned, [&](Site<Dim> const&) { return number; });
  }

  /// Points of one material of any type.
  template <CheckedMaterial MaterialType>
    requires(MaterialType::dim == Dim)
  PointStates(
      MaterialType const& material, std::span<Site<Dim> const> sites, std::span<double const> volumes = {},
      std::function<bool(int)> const& owned = [](int) { return true; })
      : PointStates(AnyProvider<Dim>(material), sites, volumes, owned) {}

  int size() const { return detail::count(places_); }  ///< Number of points, those of other processes included.
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
  /// Of the committed states, as the next ones: without the stabilising stress.
  VoigtStress<Dim> committed_stress(int point) const { return batch(point).stress(local(point)); }
  VoigtTangent<Dim> committed_tangent(int point) const { return batch(point).tangent(local(point)); }  ///< [Pa]
  /// Whether the tangents of all points' trial states are derivatives of their responses.
  bool have_exact_tangents() const {
    return std::ranges::all_of(batches_, [](auto const& one) { return one->has_exact_tangent(); });
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
  /// The bits of points' committed states, those of means included; what states share, such as grains, is in it once.
  /// \throws InputError for states that name no members
  std::string pack(std::span<int const> points) const {
    StateWriter writer;
    for (int const point : points) {
      batch(point).write(local(point), writer);
      if (has_means()) writer("means", mean_state(point));
    }
    return std::move(writer.bits());
  }
  std::string pack(int point) const { return pack(std::span(&point, 1)); }  ///< Bits of one point's committed state.
  /// Other committed states for points, between load steps, by the bits of as many points of the same providers; points share again
  /// what those shared.
  /// \throws InputError for other bits, and for points that are named twice, without any change
  void unpack(std::span<int const> points, std::string_view bits) {
    StateReader reader(bits, &shared_);
    std::vector<std::pair<std::any, MeanState<Dim>>> states;
    std::vector<int> sorted(points.begin(), points.end());
    std::ranges::sort(sorted);
    if (auto const twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
      reject("point {} is to be unpacked twice: name each point once", *twice);
    for (int const point : points) {
      states.emplace_back(batch(point).read(local(point), reader), MeanState<Dim>{});
      if (has_means()) reader("means", states.back().second);
    }
    if (!reader.at_end())
      reject("it holds more than the states of {} points: unpack what was packed of such points", points.size());
    for (std::size_t k = 0; k < points.size(); ++k) put(points[k], std::move(states[k].first), states[k].second);
  }
  /// Another committed state for one point, by bits of a point of the same provider.
  void unpack(int point, std::string_view bits) { unpack(std::span(&point, 1), bits); }
  /// Gives a point the committed state of another one, as for the children of a refined element; between load steps. In the mirror
  /// of its principal stresses if wanted: the stress stays, and one packing's accidents are not repeated.
  /// \throws InputError for a point of another type of provider, for one with means and one without, and for states that cannot be mirrored
  void copy(int to, PointStates const& from, int point, bool is_mirrored = false) {
    if (has_means() != from.has_means())
      reject("point {} is to be copied between points with means and points without: take the same material for both",
             point);
    MeanState<Dim> state = from.mean_state(point);
    std::optional<Mirror<Dim>> mirror;
    if (is_mirrored) {
      mirror = {principal_direction<Dim>(from.committed_stress(point) + state.tau)};
      state.tau = mirrored_stress<Dim>(state.tau, mirror->normal);
    }
    put(to, batch(to).state_from(from.batch(point), from.local(point), mirror), state);
  }
  /// The point alone, with the state of these bits and without neighbours.
  PointStates extract(int point, std::string_view bits) const {
    PointStates one;
    one.batches_.emplace_back(batch(point).without_points());
    one.add(0, batch(point).site(local(point)), false);
    StateReader reader(bits);
    auto state = one.batch(0).read(0, reader);
    if (MeanState<Dim> unused; has_means()) reader("means", unused);
    if (!reader.at_end())
      reject("it holds more than the state of point {}: extract what was packed of this point", point);
    one.put(0, std::move(state), {});
    return one;
  }
  /// Leaves a point without state, since another process owns it.
  void release(int point) { batch(point).release(local(point)); }
  /// What evolves: the committed states, and those of means. Read in, those of all points are here until they are forgotten; only own
  /// points respond.
  template <class Self, class Visit>
  static void members(Self& points, Visit&& visit) {
    std::conditional_t<std::is_const_v<Self>, PointStates const, PointStates>& self = points;
    SCARP_ALL_MEMBERS(batches_, neighbourhoods_, search_, places_, owned_, means_, is_planned_, has_trial_, shared_);
    using Visitor = std::remove_cvref_t<Visit>;
    if (self.means_) PointMeans<Dim>::basis_members(*self.means_, visit);
    for (auto& one : self.batches_) {
      if constexpr (std::same_as<Visitor, StateWriter>) one->write_all(visit);
      if constexpr (std::same_as<Visitor, StateReader>) one->read_all(visit);
    }
    if (self.means_) visit("means", *self.means_);
  }
  /// No response and no plan belongs to states that were loaded.
  void after_loading() { is_planned_ = has_trial_ = false; }

 protected:
  /// Batch of a point and its number within.
  struct Place {
    int batch;  ///< number of the batch
    int local;  ///< number within the batch
  };
  /// The number of a point. \throws InputError where there is no such point
  int existing(int point) const {
    if (point < 0 || point >= size())
      reject("point {} is named (there are {} points): use numbers from 0 to {}", point, size(), size() - 1);
    return point;
  }
  /// Points of one provider to which a point belongs.
  detail::PointBatch<Dim>& batch(int point) {
    return *batches_[detail::index(places_[detail::index(existing(point))].batch)].held;
  }
  /// Points of one provider to which a point belongs.
  detail::PointBatch<Dim> const& batch(int point) const {
    return *batches_[detail::index(places_[detail::index(existing(point))].batch)].held;
  }
  int local(int point) const { return places_[detail::index(point)].local; }  ///< Number of a point within its batch.

  std::vector<detail::CopiedBatch<Dim>> batches_;  ///< one for each provider
  std::vector<int> owned_;                         ///< points of this process
  std::optional<PointMeans<Dim>> means_;           ///< nothing where each point sees its own gradient
  bool is_planned_ = false;                        ///< whether inner steps are fixed for the load step
  bool has_trial_ = false;                         ///< whether there is a response since the last commit or discard

 private:
  template <class... Materials>
  static std::vector<Region<AnyProvider<Dim>>> listed_regions(boost::hana::tuple<Region<Materials>...> const& regions) {
    static_assert(((Materials::dim == Dim) && ...), "scarp: all materials have the dimension of the points");
    std::vector<Region<AnyProvider<Dim>>> list;
    boost::hana::for_each(regions, [&](auto const& region) { list.push_back({region.name, region.provider}); });
    return list;
  }

  /// \return number of its batch
  int add_material(AnyProvider<Dim> const& material) {
    batches_.emplace_back(material.batch());
    neighbourhoods_.push_back(material.own_neighbourhood());
    if (material.means()) search_ = material.means();
    return detail::count(batches_) - 1;
  }

  /// Every process makes states for all points where some see means, since the stiffness against fluctuation strain follows from them.
  void fill(std::span<Site<Dim> const> sites, std::span<double const> volumes, std::function<bool(int)> const& owned,
            std::function<int(Site<Dim> const&)> const& batch_of) {
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

  void put(int point, std::any state, MeanState<Dim> const& of_means) {
    batch(point).put(local(point), std::move(state));
    if (means_) means_->set_committed(point, of_means);
    is_planned_ = has_trial_ = false;
  }

  /// Also of points that lie too far apart to see each other: states go between these and closer ones.
  bool has_means() const { return search_ || means_; }
  MeanState<Dim> mean_state(int point) const { return means_ ? means_->committed(point) : MeanState<Dim>{}; }

  void add(int batch, Site<Dim> const& site, bool here) {
    auto& among = batches_[detail::index(batch)];
    places_.push_back({batch, among->size()});
    among->add(site, size() - 1, here);
  }

  std::vector<Neighbourhood> neighbourhoods_;          ///< of the batches
  typename AnyProvider<Dim>::Means search_ = nullptr;  ///< where points see means
  std::vector<Place> places_;
  SharedParts shared_;  ///< of states that were unpacked
};

}  // namespace scarp
