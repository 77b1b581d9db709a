// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>

#include "scarp/dem/contacts.hpp"
#include "scarp/io/csv.hpp"

namespace scarp {

/// Writes a plane packing for drawing: packing_grains.csv (x, y, half axes a, b, cos and sin of the major axis; [m]),
/// packing_contacts.csv (branch from x1, y1 to x2, y2 [m], normal force [N]), packing_cell.csv (base vectors [m]).
/// \throws FileError when a file cannot be written
template <class PackingType>
void write_packing_tables(std::filesystem::path const& folder, PackingType const& packing,
                          typename PackingType::Law const& law) {
  using Shape = typename PackingType::Shape;
  static_assert(Shape::dim == 2 && (Shape::size_count == 1 || Shape::size_count == 2),
                "tables are written for discs and ellipses");
  CsvTable grains({"x", "y", "a", "b", "cos", "sin"});
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    auto const size = packing.population->size(i);
    double c = 1.0;
    double s = 0.0;
    if constexpr (Shape::orientation_count == 2) {
      c = static_cast<double>(packing.orientation(i, 0));
      s = static_cast<double>(packing.orientation(i, 1));
    }
    grains.add(packing.position(i, 0), packing.position(i, 1), size.front(), size.back(), c, s);
  }
  CsvTable contacts({"x1", "y1", "x2", "y2", "normal_force"});
  for_each_contact(packing, law, [&](Contact<2> const& contact) {
    auto const from = row_position(packing, contact.first);
    contacts.add(from[0], from[1], from[0] + contact.branch(0), from[1] + contact.branch(1), contact.normal_force);
  });
  CsvTable cell({"a1x", "a1y", "a2x", "a2y"});
  cell.add(packing.cell(0, 0), packing.cell(1, 0), packing.cell(0, 1), packing.cell(1, 1));
  grains.write(folder / "packing_grains.csv");
  contacts.write(folder / "packing_contacts.csv");
  cell.write(folder / "packing_cell.csv");
}

}  // namespace scarp
