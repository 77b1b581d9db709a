// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "scarp/core/status.hpp"
#include "scarp/dem/grain_view.hpp"
#include "scarp/dem/periodic_images.hpp"

namespace scarp {

namespace detail {

/// A periodic pair named once: the first has the smaller number, or the shift of the second is lexicographically positive.
template <int Dim>
struct PairName {
  std::int32_t first;
  std::int32_t second;
  std::array<int, static_cast<std::size_t>(Dim)> shift;
  friend auto operator<=>(PairName const&, PairName const&) = default;
};

/// A pair of the former list; `swapped` when its name in the new cell has exchanged roles.
template <int Dim>
struct FormerPair {
  PairName<Dim> name;
  std::size_t row;
  bool swapped;
};

/// A pair of the new list; `second` numbers grains and images, `former` is null for a pair that was not listed before.
template <int Dim>
struct NearPair {
  std::int32_t first;
  std::int32_t second;
  Point<Dim, double> normal;
  FormerPair<Dim> const* former;
};

/// The present list under the names that its pairs have in the new cell, sorted.
template <class PackingType>
std::vector<FormerPair<PackingType::dim>> former_pairs(PackingType const& packing,
                                                       Renaming<PackingType::dim> const& renaming) {
  constexpr int dim = PackingType::dim;
  auto const& pairs = packing.pairs;
  std::size_t const grains = packing.grain_count();
  std::vector<FormerPair<dim>> former;
  former.reserve(pairs.count());
  for (std::size_t p = 0; p < pairs.count(); ++p) {
    auto const i = static_cast<std::size_t>(pairs.first[p]);
    auto const second = static_cast<std::size_t>(pairs.second[p]);
    std::size_t const j = grain_owner(packing, second);
    Vector<dim> shift = Vector<dim>::Zero();
    if (second >= grains) {
      for (int a = 0; a < dim; ++a) shift(a) = pairs.ghost_shift[second - grains][static_cast<std::size_t>(a)];
    }
    shift = (renaming.old_to_new * shift).eval();
    PairName<dim> name{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), {}};
    for (std::size_t a = 0; a < name.shift.size(); ++a) {
      name.shift[a] =
          static_cast<int>(std::lround(shift(static_cast<int>(a)))) + renaming.moved[j][a] - renaming.moved[i][a];
    }
    int const direction = sign_of(name.shift);
    bool const swapped = direction < 0 || (direction == 0 && i > j);
    if (swapped) {
      std::swap(name.first, name.second);
      for (auto& component : name.shift) component = -component;
    }
    former.push_back({name, p, swapped});
  }
  std::sort(former.begin(), former.end(), [](auto const& a, auto const& b) { return a.name < b.name; });
  return former;
}

template <int Dim>
FormerPair<Dim> const* find_former(std::vector<FormerPair<Dim>> const& former, PairName<Dim> const& name) {
  auto const known = std::lower_bound(former.begin(), former.end(), name,
                                      [](auto const& pair, auto const& wanted) { return pair.name < wanted; });
  return known != former.end() && known->name == name ? &*known : nullptr;
}

/// Where the contact search starts: at the remembered normal, for a new pair along the line of centres.
template <class PackingType>
Point<PackingType::dim, double> start_normal(PackingType const& packing, FormerPair<PackingType::dim> const* former,
                                             Point<PackingType::dim, double> const& branch, double distance) {
  Point<PackingType::dim, double> start{};
  for (std::size_t a = 0; a < start.size(); ++a) {
    start[a] = distance > 0.0 ? branch[a] / distance : (a == 0 ? 1.0 : 0.0);
  }
  if constexpr (PackingType::Shape::remembers_normal) {
    if (former != nullptr) {
      double const sign = former->swapped ? -1.0 : 1.0;
      for (std::size_t a = 0; a < start.size(); ++a) {
        start[a] = sign * static_cast<double>(packing.pairs.normal(former->row, static_cast<int>(a)));
      }
    }
  }
  return start;
}

/// All pairs whose gap is below `skin` [m], sorted by (first, second).
template <class PackingType>
std::vector<NearPair<PackingType::dim>> find_near_pairs(PackingType const& packing,
                                                        GrainsAndImages<PackingType::dim> const& all,
                                                        std::vector<FormerPair<PackingType::dim>> const& former,
                                                        double skin) {
  using Shape = typename PackingType::Shape;
  constexpr int dim = PackingType::dim;
  auto const& population = *packing.population;
  std::size_t const grains = packing.grain_count();
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, GrainsAndImages<dim>>,
                                                   GrainsAndImages<dim>, dim, std::uint32_t>;
  Tree const tree(dim, all, nanoflann::KDTreeSingleIndexAdaptorParams(12));
  nanoflann::SearchParams unsorted;
  unsorted.sorted = false;

  using Pose = decltype(grain_pose(packing, 0));
  std::vector<Pose> poses(grains);
  for (std::size_t i = 0; i < grains; ++i) poses[i] = grain_pose(packing, i);

  std::vector<NearPair<dim>> found;
  std::vector<std::pair<std::uint32_t, double>> hits;
  for (std::size_t i = 0; i < grains; ++i) {
    double const own_radius = Shape::bounding_radius(population.size(i));
    double const radius = own_radius + population.largest_radius() + skin;
    hits.clear();
    tree.radiusSearch(all.points[i].place.data(), radius * radius, hits, unsorted);
    std::sort(hits.begin(), hits.end());
    for (auto const& [point, squared] : hits) {
      auto const& partner = all.points[point];
      auto const j = static_cast<std::size_t>(partner.owner);
      if (point < grains && point <= i) continue;
      double const touching = own_radius + Shape::bounding_radius(population.size(j)) + skin;
      if (squared > touching * touching) continue;
      PairName<dim> name{static_cast<std::int32_t>(i), partner.owner, {}};
      Point<dim, double> branch;
      for (std::size_t a = 0; a < branch.size(); ++a) {
        name.shift[a] = partner.shift[a];
        branch[a] = partner.place[a] - all.points[i].place[a];
      }
      auto const* const known = find_former(former, name);
      auto const start = start_normal(packing, known, branch, std::sqrt(squared));
      auto const touch = settled_touch<Shape>(poses[i], poses[j], branch, start);
      if (touch.overlap < -skin) continue;
      found.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(point), touch.normal, known});
    }
  }
  return found;
}

/// Only images that some pair uses become ghosts, in their order.
template <class Pairs, int Dim>
void write_members(Pairs& next, std::vector<NearPair<Dim>> const& found, GrainsAndImages<Dim> const& all,
                   std::size_t grains) {
  std::vector<std::int32_t> ghost_number(all.points.size(), -1);
  for (auto const& pair : found) ghost_number[static_cast<std::size_t>(pair.second)] = 0;
  for (std::size_t point = grains; point < all.points.size(); ++point) {
    if (ghost_number[point] < 0) continue;
    ghost_number[point] = static_cast<std::int32_t>(grains + next.ghost_owner.size());
    next.ghost_owner.push_back(all.points[point].owner);
    next.ghost_shift.push_back(all.points[point].shift);
  }
  next.first.reserve(found.size());
  next.second.reserve(found.size());
  for (auto const& pair : found) {
    auto const point = static_cast<std::size_t>(pair.second);
    next.first.push_back(pair.first);
    next.second.push_back(point < grains ? pair.second : ghost_number[point]);
  }
}

/// Normals of all pairs, and shear forces of those that were listed before.
template <class Shape, class Law, class Scalar>
void write_memory(NearPairs<Shape, Law, Scalar>& next, std::vector<NearPair<Shape::dim>> const& found,
                  NearPairs<Shape, Law, Scalar> const& former) {
  constexpr int dim = Shape::dim;
  next.normal.resize(found.size());
  next.shear.resize(found.size());
  for (std::size_t p = 0; p < found.size(); ++p) {
    auto const& pair = found[p];
    if constexpr (Shape::remembers_normal) {
      for (int a = 0; a < dim; ++a) next.normal(p, a) = static_cast<Scalar>(pair.normal[static_cast<std::size_t>(a)]);
    }
    if (pair.former == nullptr) continue;
    auto shear = former.shear.row(pair.former->row);
    if constexpr (dim == 3) {  // a vector on the second grain changes sign with the roles; the plane's number does not
      if (pair.former->swapped) {
        for (auto& component : shear) component = -component;
      }
    }
    next.shear.set_row(p, shear);
  }
  if constexpr (Shape::remembers_normal) {
    for (std::size_t p = found.size(); p < next.normal.padded_rows(); ++p) next.normal.column(0)[p] = Scalar(1);
  }
}

template <class PackingType>
bool positions_are_finite(PackingType const& packing) {
  for (int a = 0; a < PackingType::dim; ++a) {
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      if (!std::isfinite(packing.position(i, a))) return false;
    }
  }
  return true;
}

}  // namespace detail

/// Whether the cell, with its base vectors reduced, is wider than two grains in touch and the skin, the reach of the search,
/// so that no image further away than the next cell's can come near.
template <class PackingType>
bool cell_is_wide_enough(PackingType const& packing, double skin) {
  constexpr int dim = PackingType::dim;
  if (!(packing.cell.allFinite() && packing.cell.determinant() > 0.0)) return false;
  Tensor<dim> const reduced = packing.cell * lattice_reduction<dim>(packing.cell).template cast<double>();
  return least_height<dim>(reduced) > 2.0 * packing.population->largest_radius() + skin;
}

/// Makes the list of pairs whose gap is below `skin` [m] (nanoflann k-d tree over grains and ghosts), carrying over normals
/// and shear forces of pairs that stay. Reduces the cell and wraps positions on the way. Deterministic.
/// \return failed / cell_collapsed for a cell too thin for its grains, failed / not_finite for positions that are no numbers
template <class PackingType>
Verdict rebuild_pairs(PackingType& packing, double skin) {
  constexpr int dim = PackingType::dim;
  if (!cell_is_wide_enough(packing, skin)) return {Status::failed, Reason::cell_collapsed};
  if (!detail::positions_are_finite(packing)) return {Status::failed, Reason::not_finite};
  detail::Renaming<dim> const renaming = detail::reduce_and_wrap(packing);
  auto const former = detail::former_pairs(packing, renaming);
  auto const all = detail::grains_and_images(packing, 2.0 * packing.population->largest_radius() + skin);
  auto const found = detail::find_near_pairs(packing, all, former, skin);
  decltype(packing.pairs) next;
  next.skin = skin;
  detail::write_members(next, found, all, packing.grain_count());
  detail::write_memory(next, found, packing.pairs);
  packing.pairs = std::move(next);
  return {};
}

}  // namespace scarp
