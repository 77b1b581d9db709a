// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <cstdint>
#include <string_view>

#include "scarp/core/columns.hpp"
#include "scarp/core/error.hpp"

namespace scarp::detail {

inline void refuse_unless(bool sound, std::string_view what) {
  if (!sound) refuse("its {} (no packing is like that): save it again", what);
}

/// Whether columns have a row for each of `rows`; columns that hold nothing always do.
template <class Scalar, int Count>
bool has_rows(Columns<Scalar, Count> const& columns, std::size_t rows) {
  if constexpr (Count == 0) {
    return true;
  } else {
    return columns.rows() == rows;
  }
}

/// What a hash that fits does not show: the numbers of a packing that was read must not lead outside its arrays.
/// \throws InputError
template <class PackingType>
void refuse_unsound(PackingType const& packing) {
  auto const& pairs = packing.pairs;
  std::size_t const grains = packing.grain_count();
  std::size_t const sizes = packing.population ? packing.population->count() : 0;
  auto const rows = static_cast<std::int64_t>(packing.row_count());
  auto const ghosts = static_cast<std::int64_t>(pairs.ghost_owner.size());
  refuse_unless(sizes == grains && has_rows(packing.velocity, grains) && has_rows(packing.spin, grains) &&
                    has_rows(packing.orientation, grains),
                "arrays of grains differ in length");
  refuse_unless(packing.cell.allFinite() && packing.cell.determinant() > 0.0, "cell has no positive content");
  refuse_unless(pairs.second.size() == pairs.count() && has_rows(pairs.normal, pairs.count()) &&
                    has_rows(pairs.shear, pairs.count()) && has_rows(pairs.moment, pairs.count()) &&
                    has_rows(pairs.scalars, pairs.count()) && pairs.ghost_shift.size() == pairs.ghost_owner.size(),
                "arrays of pairs differ in length");
  for (std::int32_t const owner : pairs.ghost_owner) refuse_unless(owner >= 0 && owner < rows, "ghosts have no owner");
  for (std::size_t p = 0; p < pairs.count(); ++p) {
    refuse_unless(pairs.first[p] >= 0 && pairs.first[p] < rows && pairs.second[p] > pairs.first[p] &&
                      pairs.second[p] < rows + ghosts,
                  "pairs name grains that are not there");
  }
}

}  // namespace scarp::detail
