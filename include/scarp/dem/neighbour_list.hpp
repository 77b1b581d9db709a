// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/core/radius_search.hpp"
#include "scarp/core/status.hpp"
#include "scarp/dem/detail/periodic_images.hpp"
#include "scarp/dem/grain_view.hpp"

namespace scarp {

namespace detail {

/// A periodic pair of rows named once: the first has the smaller number, or the shift of the second is
/// lexicographically positive.
template <int Dim>
struct PairName {
  std::int32_t first;
  std::int32_t second;
  std::array<int, static_cast<std::size_t>(Dim)> shift;
  friend auto operator<=>(PairName const&, PairName const&) = default;
};

/// A pair of the previous list; `swapped` when its name in the new cell has exchanged roles.
template <int Dim>
struct FormerPair {
  PairName<Dim> name;
  std::size_t row;
  bool swapped;
};

/// A pair of the new list by its rows; those of `second` number grains first and then images, `former` is null for a
/// pair that was not listed before.
template <int Dim>
struct NearPair {
  std::int32_t first;
  std::int32_t second;
  Point<Dim, double> normal;
  FormerPair<Dim> const* former;
};

/// The present list under the names that its pairs have in the new cell, sorted.
/// `owner_of`, `shift_of`: of ghosts; rows below `rows` are no ghosts
template <int Dim>
std::vector<FormerPair<Dim>> former_pairs(std::vector<std::int32_t> const& first,
                                          std::vector<std::int32_t> const& second,
                                          std::vector<std::int32_t> const& owner_of,
                                          std::vector<std::array<std::int8_t, index(Dim)>> const& shift_of,
                                          std::size_t rows, Renaming<Dim> const& renaming) {
  std::vector<FormerPair<Dim>> former;
  former.reserve(first.size());
  for (std::size_t p = 0; p < first.size(); ++p) {
    auto const i = detail::index(first[p]);
    auto j = detail::index(second[p]);
    Vector<Dim> shift = Vector<Dim>::Zero();
    if (j >= rows) {
      for (int a = 0; a < Dim; ++a) shift(a) = shift_of[j - rows][detail::index(a)];
      j = detail::index(owner_of[j - rows]);
    }
    shift = (renaming.old_to_new * shift).eval();
    std::size_t const parts = rows / renaming.moved.size();
    PairName<Dim> name{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), {}};
    for (std::size_t a = 0; a < name.shift.size(); ++a) {
      name.shift[a] = static_cast<int>(std::lround(shift(static_cast<int>(a)))) + renaming.moved[j / parts][a] -
                      renaming.moved[i / parts][a];
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

/// Where the contact search starts: at the stored normal, for a new pair along the line of centres.
template <class Shape, class Normals>
Point<Shape::dim, double> start_normal(Normals const& remembered, FormerPair<Shape::dim> const* former,
                                       Point<Shape::dim, double> const& branch, double distance) {
  Point<Shape::dim, double> start{};
  for (std::size_t a = 0; a < start.size(); ++a) {
    start[a] = distance > 0.0 ? branch[a] / distance : (a == 0 ? 1.0 : 0.0);
  }
  if constexpr (Shape::warm_starts_normal) {
    if (former != nullptr) {
      double const sign = former->swapped ? -1.0 : 1.0;
      for (std::size_t a = 0; a < start.size(); ++a) {
        start[a] = sign * static_cast<double>(remembered(former->row, static_cast<int>(a)));
      }
    }
  }
  return start;
}

/// Poses of all parts of all grains.
template <class PackingType>
std::vector<PoseOf<typename PackingType::Shape>> row_poses(PackingType const& packing) {
  std::vector<PoseOf<typename PackingType::Shape>> poses(packing.row_count());
  for (std::size_t row = 0; row < poses.size(); ++row) poses[row] = row_pose(packing, row);
  return poses;
}

/// All pairs whose gap is below `reach` [m], sorted by (first, second); nothing where a touch is not found. A law's
/// memory does not matter: compiled once for each shape.
template <class Shape, class Scalar, class Normals>
std::optional<std::vector<NearPair<Shape::dim>>> find_near_pairs(Population<Shape, Scalar> const& population,
                                                                 std::vector<PoseOf<Shape>> const& poses,
                                                                 GrainsAndImages<Shape::dim> const& all,
                                                                 std::vector<FormerPair<Shape::dim>> const& former,
                                                                 Normals const& remembered, double reach) {
  constexpr int dim = Shape::dim;
  constexpr int parts = part_count<Shape>();
  std::size_t const grains = population.count();
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, GrainsAndImages<dim>>,
                                                   GrainsAndImages<dim>, dim, std::uint32_t>;
  Tree const tree(dim, all, nanoflann::KDTreeSingleIndexAdaptorParams(12));
  auto const unsorted = unsorted_search();

  std::vector<NearPair<dim>> found;
  std::vector<RadiusSearchHit> hits;
  for (std::size_t i = 0; i < grains; ++i) {
    double const own_radius = population.bounding_radius(i);
    double const radius = own_radius + population.largest_radius() + reach;
    hits.clear();
    static_cast<void>(tree.radiusSearch(all.points[i].place.data(), radius * radius, hits, unsorted));
    std::erase_if(hits, [&](auto const& hit) {
      auto const j = detail::index(all.points[hit.first].owner);
      double const touching = own_radius + population.bounding_radius(j) + reach;
      return hit.first <= i || hit.second > touching * touching;
    });
    std::ranges::sort(hits, {}, &RadiusSearchHit::first);
    for (int part = 0; part < parts; ++part) {
      std::size_t const row = i * parts + detail::index(part);
      for (auto const& [point, squared] : hits) {
        auto const& partner = all.points[point];
        Point<dim, double> branch;
        for (std::size_t a = 0; a < branch.size(); ++a) branch[a] = partner.place[a] - all.points[i].place[a];
        for (int other = 0; other < parts; ++other) {
          std::size_t const partner_row = detail::index(partner.owner * parts + other);
          PairName<dim> name{static_cast<std::int32_t>(row), static_cast<std::int32_t>(partner_row), {}};
          for (std::size_t a = 0; a < branch.size(); ++a) name.shift[a] = partner.shift[a];
          auto const* const known = find_former(former, name);
          auto const start = start_normal<Shape>(remembered, known, branch, std::sqrt(squared));
          auto const touch = converged_contact<Shape>(poses[row], poses[partner_row], branch, start);
          if (touch.overlap < -reach) continue;
          if (touch.normal_error != 0.0) return std::nullopt;
          found.push_back({name.first, static_cast<std::int32_t>(point) * parts + other, touch.normal, known});
        }
      }
    }
  }
  return found;
}

/// The pairs in another order: neighbours in the list have different grains, so that the pair loop need not wait for
/// one pair's forces before it can add the next one's. Within groups, whose grains stay in the nearest caches.
template <int Dim>
std::vector<NearPair<Dim>> interleaved(std::vector<NearPair<Dim>> const& sorted) {
  constexpr std::size_t strands = 16;  // at least the lanes of a pack
  constexpr std::size_t group = 64 * strands;
  std::vector<NearPair<Dim>> woven;
  woven.reserve(sorted.size());
  for (std::size_t begin = 0; begin < sorted.size(); begin += group) {
    std::size_t const end = std::min(begin + group, sorted.size());
    std::size_t const stride = (end - begin + strands - 1) / strands;
    for (std::size_t first = begin; first < begin + stride; ++first) {
      for (std::size_t at = first; at < end; at += stride) woven.push_back(sorted[at]);
    }
  }
  return woven;
}

/// Only rows of images that some pair uses become ghosts, in their order.
template <int Parts, class Pairs, int Dim>
void write_members(Pairs& next, std::vector<NearPair<Dim>> const& found, GrainsAndImages<Dim> const& all,
                   std::size_t rows) {
  std::vector<std::int32_t> ghost_number(all.points.size() * Parts, -1);
  for (auto const& pair : found) ghost_number[detail::index(pair.second)] = 0;
  for (std::size_t row = rows; row < ghost_number.size(); ++row) {
    if (ghost_number[row] < 0) continue;
    auto const& image = all.points[row / Parts];
    ghost_number[row] = static_cast<std::int32_t>(rows + next.ghost_owner.size());
    next.ghost_owner.push_back(image.owner * Parts + static_cast<std::int32_t>(row % Parts));
    next.ghost_shift.push_back(image.shift);
  }
  next.first.reserve(found.size());
  next.second.reserve(found.size());
  for (auto const& pair : found) {
    auto const row = detail::index(pair.second);
    next.first.push_back(pair.first);
    next.second.push_back(row < rows ? pair.second : ghost_number[row]);
  }
}

/// Normals of all pairs, and the contacts' memory of those that were listed before.
template <class Shape, class Law, class Scalar>
void write_memory(VerletList<Shape, Law, Scalar>& next, std::vector<NearPair<Shape::dim>> const& found,
                  VerletList<Shape, Law, Scalar> const& former) {
  constexpr int dim = Shape::dim;
  next.normal.resize(found.size());
  next.shear.resize(found.size());
  next.moment.resize(found.size());
  next.scalars.resize(found.size());
  // With the roles exchanged a vector on the second grain changes sign; the plane's tangent turns round with it.
  constexpr bool shear_turns = dim == 3;
  auto const carried = [](auto values, bool turned) {
    if (turned) {
      for (auto& value : values) value = -value;
    }
    return values;
  };
  for (std::size_t p = 0; p < found.size(); ++p) {
    auto const& pair = found[p];
    if constexpr (Shape::warm_starts_normal) {
      for (int a = 0; a < dim; ++a) next.normal(p, a) = static_cast<Scalar>(pair.normal[detail::index(a)]);
    }
    if (pair.former == nullptr) continue;
    std::size_t const row = pair.former->row;
    next.shear.set_row(p, carried(former.shear.row(row), shear_turns && pair.former->swapped));
    next.moment.set_row(p, carried(former.moment.row(row), pair.former->swapped));
    next.scalars.set_row(p, former.scalars.row(row));
  }
  if constexpr (Shape::warm_starts_normal) {
    for (std::size_t p = found.size(); p < next.normal.padded_rows(); ++p) next.normal.column(0)[p] = Scalar(1);
  }
}

}  // namespace detail

/// Whether the cell, with its base vectors reduced, is wider than the largest grain and the reach of the search, so
/// that no image further away than the next cell's can come near.
template <class PackingType>
bool cell_is_wide_enough(PackingType const& packing, double reach) {
  constexpr int dim = PackingType::dim;
  if (!(packing.cell.allFinite() && packing.cell.determinant() > 0.0)) return false;
  Tensor<dim> const reduced = packing.cell * lattice_reduction<dim>(packing.cell).template cast<double>();
  return min_height<dim>(reduced) > 2.0 * packing.population->largest_radius() + reach;
}

/// Makes the Verlet list: the pairs whose gap is below `skin` + `law_reach` [m] (nanoflann k-d tree over grains and
/// ghosts), carrying over normals and memories of pairs that stay. The list is good until gaps have shrunk by the skin;
/// `law_reach` is the gap across which the contact law acts. Reduces the cell and wraps positions. Deterministic; a
/// packing whose list fails stays as it was.
/// \return failed / cell_collapsed for a cell too thin for its grains, failed / not_finite for positions that are no
/// numbers, failed / lost_grain for one that is more than a million cells away, failed / unconverged_normal where the
/// shape does not find how two grains touch
template <class PackingType>
Verdict rebuild_pairs(PackingType& packing, double skin, double law_reach = 0.0) {
  constexpr int dim = PackingType::dim;
  using Scalar = typename PackingType::Scalar;
  auto& pairs = packing.pairs;
  double const reach = skin + law_reach;
  if (!cell_is_wide_enough(packing, reach)) return {Status::failed, Reason::cell_collapsed};
  auto cell = packing.cell;
  auto places = detail::grain_places(packing);
  for (auto const& place : places) {
    if (!place.allFinite()) return {Status::failed, Reason::not_finite};
  }
  detail::Renaming<dim> renaming;
  if (!detail::reduce_and_wrap(cell, places, renaming)) return {Status::failed, Reason::lost_grain};
  for (auto& place : places) place = place.template cast<Scalar>().template cast<double>().eval();  // as stored
  auto const former = detail::former_pairs<dim>(pairs.first, pairs.second, pairs.ghost_owner, pairs.ghost_shift,
                                                packing.row_count(), renaming);
  auto const all = detail::grains_and_images<dim>(cell, places, 2.0 * packing.population->largest_radius() + reach);
  auto const sorted =
      detail::find_near_pairs(*packing.population, detail::row_poses(packing), all, former, pairs.normal, reach);
  if (!sorted) return {Status::failed, Reason::unconverged_normal};
  auto const found = detail::interleaved(*sorted);
  decltype(packing.pairs) next;
  next.skin = skin;
  detail::write_members<part_count<typename PackingType::Shape>()>(next, found, all, packing.row_count());
  detail::write_memory(next, found, pairs);
  pairs = std::move(next);
  packing.cell = cell;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (int a = 0; a < dim; ++a) packing.position(i, a) = static_cast<Scalar>(places[i](a));
  }
  return {};
}

}  // namespace scarp
