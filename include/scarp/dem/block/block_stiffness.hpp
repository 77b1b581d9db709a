// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/block/block_pairs.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp::detail {

/// Numbers of a symmetric stiffness in Voigt's notation, row by row from the diagonal on.
template <int Dim>
inline constexpr int stiffness_count = voigt_size<Dim>*(voigt_size<Dim> + 1) / 2;

/// Adds springs of one contact to a stiffness times volume [N m], as `contact_tangent` and `to_voigt_tangent` do.
template <int Dim>
SCARP_HOST_DEVICE constexpr void add_springs(std::array<double, static_cast<std::size_t>(stiffness_count<Dim>)>& sum,
                                             double along, double across, SmallVector<Dim> const& normal,
                                             SmallVector<Dim> const& branch) {
  constexpr auto indices = voigt_indices<Dim>();
  auto const both = [&](std::size_t i, std::size_t j) { return (normal[i] * branch[j] + normal[j] * branch[i]) / 2.0; };
  std::size_t number = 0;
  for (std::size_t p = 0; p < indices.size(); ++p) {
    auto const i = static_cast<std::size_t>(indices[p].first);
    auto const j = static_cast<std::size_t>(indices[p].second);
    for (std::size_t q = p; q < indices.size(); ++q) {
      auto const k = static_cast<std::size_t>(indices[q].first);
      auto const l = static_cast<std::size_t>(indices[q].second);
      double const branches = (i == k ? branch[j] * branch[l] : 0.0) + (j == k ? branch[i] * branch[l] : 0.0) +
                              (i == l ? branch[j] * branch[k] : 0.0) + (j == l ? branch[i] * branch[k] : 0.0);
      sum[number++] += (along - across) * both(i, j) * both(k, l) + across * branches / 4.0;
    }
  }
}

/// Whether the grains of a pair overlap [m], or the law acts across their gap.
template <class Work>
SCARP_HOST_DEVICE constexpr bool acts(Work const& work, int p, double overlap, double reduced_radius) {
  if constexpr (HasInteractionRange<typename Work::Law>) {
    ContactKinematics<Work::dim, double> still{};
    still.overlap = overlap;
    still.reduced_radius = reduced_radius;
    ContactMemory<Work::dim, double> memory;
    each_memory<typename Work::Types>(
        memory, [&](int k, double& value) { value = static_cast<double>(work.bench.memory(k, p)); });
    if (work.law.respond(still, memory).normal != 0.0) return true;
  }
  return overlap > 0.0;
}

/// Stiffness times volume [N m] of all contacts under uniform strain, see `contact_tangent`. Nothing of the work
/// changes.
template <class Work>
[[gnu::noinline,
  gnu::cold]] SCARP_HOST_DEVICE constexpr std::array<double, static_cast<std::size_t>(stiffness_count<Work::dim>)>
block_stiffness(Work const& work) {
  using Shape = typename Work::Shape;
  constexpr int dim = Work::dim;
  constexpr std::size_t all = static_cast<std::size_t>(stiffness_count<dim>);
  constexpr std::size_t at_once = all < 12 ? all : 12;  // numbers of one sum of a team
  std::array<double, all> stiffness{};
  for (std::size_t from = 0; from < all; from += at_once) {
    auto const part = work.team.template sum<at_once>([&](int lane) {
      std::array<double, all> own{};
      auto const& b = work.bench;
      for (int p = lane; p < work.pair_count; p += lane_total) {
        auto const first = work.template pose<double>(b.first[p]);
        auto const second = work.template pose<double>(b.second[p]);
        auto const branch =
            work.template branch<double>(b.first[p] / Work::Types::parts, b.second[p] / Work::Types::parts, b.shift[p]);
        auto const touch = Shape::touch(first, second, branch, work.template normal<double>(p));
        double const radius_first = Shape::contact_radius(first);
        double const radius_second = Shape::contact_radius(second);
        double const radius = radius_first * radius_second / (radius_first + radius_second);
        if (!acts(work, p, touch.overlap, radius)) continue;
        auto const springs = work.law.stiffness(touch.overlap, radius);
        add_springs<dim>(own, springs.normal, springs.tangential, touch.normal, branch);
      }
      std::array<double, at_once> these{};
      for (std::size_t k = 0; k < at_once && from + k < all; ++k) these[k] = own[from + k];
      return these;
    });
    for (std::size_t k = 0; k < at_once && from + k < all; ++k) stiffness[from + k] = part[k];
  }
  return stiffness;
}

}  // namespace scarp::detail
