// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/packing.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/framed_file.hpp"
#include "scarp/io/read_file.hpp"

namespace scarp {

namespace detail {

inline constexpr FileFormat packing_format{"SCARPPAK", 4, "packing", "save_packing"};

struct LayoutEntry {
  std::string_view what;
  std::uint32_t value;
};

/// What must agree between a file and the type that it is loaded as.
template <class PackingType>
constexpr auto packing_layout() {
  using Shape = typename PackingType::Shape;
  constexpr ContactInputs inputs = PackingType::Law::inputs;
  return std::array{LayoutEntry{"dimensions", Shape::dim},
                    LayoutEntry{"sizes of a grain", Shape::size_count},
                    LayoutEntry{"numbers of an orientation", Shape::orientation_count},
                    LayoutEntry{"parts of a grain", part_count<Shape>()},
                    LayoutEntry{"remembered normals of a contact", Shape::warm_starts_normal},
                    LayoutEntry{"remembered shear forces of a contact", inputs.shear},
                    LayoutEntry{"remembered moments of a contact", inputs.moment},
                    LayoutEntry{"further remembered numbers of a contact", static_cast<std::uint32_t>(inputs.scalars)},
                    LayoutEntry{"bytes of a number", sizeof(typename PackingType::Scalar)},
                    LayoutEntry{"rows of a full vector",
                                static_cast<std::uint32_t>(SoaArray<typename PackingType::Scalar, 1>::padding)}};
}

template <class PackingType>
void reject_other_layout(StateReader& reader) {
  for (LayoutEntry const& entry : packing_layout<PackingType>()) {
    std::uint32_t saved = 0;
    reader(entry.what, saved);
    if (saved != entry.value) {
      reject("it has {} {} (the requested type has {}): load it as the type that was saved", saved, entry.what,
             entry.value);
    }
  }
}

/// The packing that stands in the bytes of a file.
template <class PackingType>
PackingType packing_of(std::string_view file) {
  StateReader reader(payload_of(packing_format, file));
  reject_other_layout<PackingType>(reader);
  PackingType packing;
  reader("packing", packing);
  require_valid(reader.at_end(), "members leave bytes over");
  require_valid(packing.population != nullptr, "grains have no sizes");
  return packing;
}

}  // namespace detail

/// Writes the whole state of a packing, grains and list of pairs included, so that it resumes as if it had never
/// stopped.
/// \throws InputError for a packing without grains
/// \throws FileError when the file cannot be written; an older file of this name is then untouched
template <class PackingType>
void save_packing(std::filesystem::path const& path, PackingType const& packing,
                  Durability durability = Durability::handed_over) {
  if (packing.population == nullptr) {
    reject("the packing for '{}' has no grains (there is nothing to save): make it first", path.string());
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
  return with_context(fmt::format("cannot load '{}'", path.string()),
                      [&] { return detail::packing_of<PackingType>(file); });
}

}  // namespace scarp
