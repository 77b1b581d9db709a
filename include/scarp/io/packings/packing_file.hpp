// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/packing.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/detail/framed_file.hpp"
#include "scarp/io/read_file.hpp"

namespace scarp {

namespace detail {

inline constexpr FileFormat packing_format{"SCARPPAK", 3, "packing", "save_packing"};

struct LayoutEntry {
  std::string_view what;
  std::uint32_t value;
};

/// What must agree between a file and the type that it is loaded as.
template <class PackingType>
constexpr auto packing_layout() {
  using Shape = typename PackingType::Shape;
  constexpr ContactNeeds needs = PackingType::Law::needs;
  return std::array{LayoutEntry{"dimensions", Shape::dim},
                    LayoutEntry{"sizes of a grain", Shape::size_count},
                    LayoutEntry{"numbers of an orientation", Shape::orientation_count},
                    LayoutEntry{"parts of a grain", part_count<Shape>()},
                    LayoutEntry{"remembered normals of a contact", Shape::remembers_normal},
                    LayoutEntry{"remembered shear forces of a contact", needs.shear},
                    LayoutEntry{"remembered moments of a contact", needs.moment},
                    LayoutEntry{"further remembered numbers of a contact", static_cast<std::uint32_t>(needs.scalars)},
                    LayoutEntry{"bytes of a number", sizeof(typename PackingType::Scalar)},
                    LayoutEntry{"rows of a full vector",
                                static_cast<std::uint32_t>(Columns<typename PackingType::Scalar, 1>::padding)}};
}

template <class PackingType>
void refuse_other_layout(StateReader& reader) {
  for (LayoutEntry const& entry : packing_layout<PackingType>()) {
    std::uint32_t saved = 0;
    reader(entry.what, saved);
    if (saved != entry.value) {
      refuse("it has {} {} (the type asked for has {}): load it as the type that was saved", saved, entry.what,
             entry.value);
    }
  }
}

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

/// What a hash that fits does not show: the numbers must not lead outside the arrays.
template <class PackingType>
void refuse_unsound(PackingType const& packing) {
  auto const& pairs = packing.pairs;
  std::size_t const grains = packing.grain_count();
  auto const rows = static_cast<std::int64_t>(packing.row_count());
  auto const ghosts = static_cast<std::int64_t>(pairs.ghost_owner.size());
  refuse_unless(packing.population != nullptr && packing.population->count() == grains &&
                    has_rows(packing.velocity, grains) && has_rows(packing.spin, grains) &&
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

/// The packing that stands in the bytes of a file.
template <class PackingType>
PackingType packing_of(std::string_view file) {
  StateReader reader(payload_of(packing_format, file));
  refuse_other_layout<PackingType>(reader);
  PackingType packing;
  reader("packing", packing);
  refuse_unless(reader.at_end(), "members leave bytes over");
  refuse_unsound(packing);
  return packing;
}

}  // namespace detail

/// Writes the whole state of a packing, grains and list of pairs included, so that it goes on as if it had never
/// stopped.
/// \throws InputError for a packing without grains
/// \throws FileError when the file cannot be written; an older file of this name is then untouched
template <class PackingType>
void save_packing(std::filesystem::path const& path, PackingType const& packing,
                  Durability durability = Durability::handed_over) {
  if (packing.population == nullptr) {
    refuse("the packing for '{}' has no grains (there is nothing to save): make it first", path.string());
  }
  auto const bytes = detail::framed(detail::packing_format, [&](StateWriter& file) {
    for (auto const& entry : detail::packing_layout<PackingType>()) file(entry.what, entry.value);
    file("packing", packing);
  });
  write_file(path, bytes, durability);
}

/// The packing of a file, with the bits that were saved; its population is a copy of its own.
/// \throws InputError naming the file for one that is missing, of another type, version or machine, cut off or harmed
template <class PackingType>
PackingType load_packing(std::filesystem::path const& path) {
  std::string const file = read_file(path);
  return naming(fmt::format("cannot load '{}'", path.string()), [&] { return detail::packing_of<PackingType>(file); });
}

}  // namespace scarp
