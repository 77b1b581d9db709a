// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>

#include "scarp/dem/packing_picture.hpp"
#include "scarp/io/csv.hpp"

namespace scarp {

/// Writes a plane packing for drawing: STEM_grains.csv (x, y, half axes a, b, cos and sin of the major axis; [m]),
/// STEM_contacts.csv (branch from x1, y1 to x2, y2 [m], normal force [N], unit normal nx, ny), STEM_cell.csv (base
/// vectors [m]).
/// \throws FileError when a file cannot be written
inline void write_packing_tables(std::filesystem::path const& folder, PackingPicture const& picture,
                                 std::string const& stem = "packing") {
  CsvTable grains({"x", "y", "a", "b", "cos", "sin"});
  for (auto const& grain : picture.grains)
    grains.add(grain.centre(0), grain.centre(1), grain.a, grain.b, grain.axis(0), grain.axis(1));
  CsvTable contacts({"x1", "y1", "x2", "y2", "normal_force", "nx", "ny"});
  for (auto const& contact : picture.contacts) {
    Vector<2> const to = contact.from + contact.branch;
    contacts.add(contact.from(0), contact.from(1), to(0), to(1), contact.normal_force, contact.normal(0),
                 contact.normal(1));
  }
  CsvTable cell({"a1x", "a1y", "a2x", "a2y"});
  cell.add(picture.cell(0, 0), picture.cell(1, 0), picture.cell(0, 1), picture.cell(1, 1));
  grains.write(folder / (stem + "_grains.csv"));
  contacts.write(folder / (stem + "_contacts.csv"));
  cell.write(folder / (stem + "_cell.csv"));
}

/// Tables of a packing. \throws FileError when a file cannot be written
template <class PackingType>
void write_packing_tables(std::filesystem::path const& folder, PackingType const& packing,
                          typename PackingType::Law const& law) {
  static_assert(HasPicture<PackingType>, "tables are written for discs and ellipses");
  write_packing_tables(folder, packing_picture(packing, law));
}

}  // namespace scarp
