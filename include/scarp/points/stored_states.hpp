// SPDX-License-Identifier: BSL-1.0
/// \file
/// How states of material points are packed, saved, copied and read.
#pragma once

#include <concepts>
#include <numeric>
#include <type_traits>

#include "scarp/points/material_points.hpp"

namespace scarp {

template <int Dim>
void MaterialPoints<Dim>::write(std::span<int const> points, StateWriter& writer) const {
  for (int const point : points) {
    batch(point).write(local(point), writer);
    if (has_means()) writer("means", means_ ? means_->committed(point) : MeanState<Dim>{});
  }
}

template <int Dim>
auto MaterialPoints<Dim>::read(std::span<int const> points, StateReader& reader) const -> std::vector<KeptState> {
  std::vector<KeptState> states;
  for (int const point : points) {
    states.emplace_back(batch(point).read(local(point), reader), MeanState<Dim>{});
    if (has_means()) reader("means", states.back().second);
  }
  return states;
}

template <int Dim>
void MaterialPoints<Dim>::put(std::span<int const> points, std::vector<KeptState> states) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    batch(points[k]).put(local(points[k]), std::move(states[k].first));
    if (means_) means_->set_committed(points[k], states[k].second);
  }
  discard();
}

template <int Dim>
std::string MaterialPoints<Dim>::pack(std::span<int const> points) const {
  StateWriter writer;
  write(points, writer);
  return std::move(writer.bits());
}

template <int Dim>
void MaterialPoints<Dim>::unpack(std::span<int const> points, std::string_view bits) {
  std::vector<int> sorted(points.begin(), points.end());
  std::ranges::sort(sorted);
  if (auto const twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    reject("point {} is to be unpacked twice: name each point once", *twice);
  StateReader reader(bits, &shared_);
  auto states = read(points, reader);
  if (!reader.at_end())
    reject("it holds more than the states of {} points: unpack what was packed of such points", points.size());
  put(points, std::move(states));
}

template <int Dim>
void MaterialPoints<Dim>::copy(int to, MaterialPoints const& from, int point, bool is_mirrored) {
  if (has_means() != from.has_means())
    reject("point {} is to be copied between points with means and points without: take the same material for both",
           point);
  from.existing(point);
  MeanState<Dim> state = from.means_ ? from.means_->committed(point) : MeanState<Dim>{};
  std::optional<Mirror<Dim>> mirror;
  if (is_mirrored) {
    mirror = {principal_direction<Dim>(from.committed_stress(point) + state.tau)};
    state.tau = mirrored_stress<Dim>(state.tau, mirror->normal);
  }
  put(std::span(&to, 1), {{batch(to).state_from(local(to), from.batch(point), from.local(point), mirror), state}});
}

template <int Dim>
MaterialPoints<Dim> MaterialPoints<Dim>::extract(int point, std::string_view bits) const {
  MaterialPoints one;
  auto& only = one.materials_.emplace_back();
  only.batch_ = batch(point).alone(local(point));
  only.means_ = material(point).means_;
  one.add(0, 0);
  one.owned_ = {0};
  StateReader reader(bits, &one.shared_);
  auto states = read(std::span(&point, 1), reader);
  if (!reader.at_end()) reject("it holds more than the states of 1 points: extract what was packed of one");
  int const first = 0;
  one.put(std::span(&first, 1), std::move(states));
  return one;
}

template <int Dim>
template <class Self, class Visit>
void MaterialPoints<Dim>::members(Self& self, Visit&& visit) {
  SCARP_ALL_MEMBERS(materials_, places_, owned_, means_, is_planned_, has_trial_, own_, seen_, responses_, works_,
                    shared_);
  int count = self.size();
  int dimensions = Dim;
  visit("points", count);
  visit("dimensions", dimensions);
  if (count != self.size() || dimensions != Dim)
    reject("it has {} points in {} dimensions (there are {} in {}): load it into points at the same sites", count,
           dimensions, self.size(), Dim);
  if (self.means_) PointMeans<Dim>::basis_members(*self.means_, visit);
  std::vector<int> all(self.places_.size());
  std::iota(all.begin(), all.end(), 0);
  if constexpr (std::same_as<std::remove_cvref_t<Visit>, StateWriter>) self.write(all, visit);
  if constexpr (std::same_as<std::remove_cvref_t<Visit>, StateReader>) self.put(all, self.read(all, visit));
}

}  // namespace scarp
