// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "scarp/dem/contacts.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/io/packings/packing_reader.hpp"
#include "scarp/shape/disc.hpp"

namespace rve_lab {

/// STEM_particles.csv, as read_packing reads it.
template <class PackingType>
scarp::CsvTable particle_table(PackingType const& packing) {
  using Shape = typename PackingType::Shape;
  std::vector<std::string> columns{"id", "x", "y"};
  for (auto const name : scarp::GrainColumns<Shape>::size) columns.emplace_back(name);
  if constexpr (Shape::orientation_count == 2) columns.emplace_back(scarp::GrainColumns<Shape>::angle);
  scarp::CsvTable table(columns);
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    std::vector<double> cells{static_cast<double>(i), packing.position(i, 0), packing.position(i, 1)};
    for (double const size : packing.population->size(i)) cells.push_back(size);
    if constexpr (Shape::orientation_count == 2) {
      cells.push_back(std::atan2(packing.orientation(i, 1), packing.orientation(i, 0)));
    }
    table.add(std::span<double const>(cells));
  }
  return table;
}

/// STEM_contacts.csv: image of the second grain in base vectors, its branch from the first, forces on it.
/// kn, ks and tan_phi only where the law has constant stiffnesses, as a replay requires them.
template <class PackingType>
scarp::CsvTable contact_table(PackingType const& packing, typename PackingType::Law law) {
  constexpr bool constant = requires { law.normal_stiffness; };
  std::vector<std::string> columns{"id1", "id2", "cell_i", "cell_j", "nx",       "ny",      "overlap",
                                   "fnx", "fny", "ftx",    "fty",    "branch_x", "branch_y"};
  if constexpr (constant) columns.insert(columns.end(), {"kn", "ks", "tan_phi"});
  scarp::CsvTable table(columns);
  auto const place = [&](std::size_t i) { return scarp::Vector<2>(packing.position(i, 0), packing.position(i, 1)); };
  scarp::for_each_contact(packing, law, [&](scarp::Contact<2> const& contact) {
    scarp::Vector<2> const between = place(contact.second) - place(contact.first);
    scarp::Vector<2> const image = packing.cell.inverse() * (contact.branch - between);
    scarp::Vector<2> const n = contact.normal();
    scarp::Vector<2> const t = contact.shear_force();
    std::vector<double> cells{static_cast<double>(contact.first),
                              static_cast<double>(contact.second),
                              std::round(image(0)) + 0.0,  // not -0
                              std::round(image(1)) + 0.0,
                              n(0),
                              n(1),
                              contact.touch.overlap,
                              contact.normal_force * n(0),
                              contact.normal_force * n(1),
                              t(0),
                              t(1),
                              contact.branch(0),
                              contact.branch(1)};
    if constexpr (constant) {
      cells.insert(cells.end(), {law.normal_stiffness, law.tangential_stiffness, law.friction});
    }
    table.add(std::span<double const>(cells));
  });
  return table;
}

/// The grains as another code reads them: STEM.txt for ymport.text of Yade, with the cell in its first line; STEM.data
/// for LAMMPS (sphere, dimension 2), turned so that the first edge of the cell lies along x.
/// \throws FileError when a file cannot be written
template <class PackingType>
  requires std::same_as<typename PackingType::Shape, scarp::Disc>
void write_for_code(std::string const& code, std::filesystem::path const& stem, PackingType const& packing) {
  bool const is_yade = code == "yade";
  auto const& population = *packing.population;
  double const thickness = population.thickness();
  scarp::Vector<2> const along =
      is_yade ? scarp::Vector<2>(1.0, 0.0) : scarp::Vector<2>(packing.cell.col(0).normalized());
  scarp::Tensor<2> turn;
  turn << along.x(), along.y(), -along.y(), along.x();
  scarp::Tensor<2> const cell = turn * packing.cell;
  std::string text =
      is_yade ? fmt::format("# O.cell.hSize = Matrix3( {} , {} , 0 , {} , {} , 0 , 0 , 0 , {} )\n", cell(0, 0),
                            cell(0, 1), cell(1, 0), cell(1, 1), thickness)
              : fmt::format(
                    "discs\n\n{} atoms\n1 atom types\n\n0 {} xlo xhi\n0 {} ylo yhi\n{} {} zlo zhi\n{} 0 0 xy xz yz\n\n"
                    "Atoms # sphere\n\n",
                    packing.grain_count(), cell(0, 0), cell(1, 1), -thickness / 2.0, thickness / 2.0, cell(0, 1));
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    double const r = population.size(i)[0];
    scarp::Vector<2> const at = turn * scarp::Vector<2>(packing.position(i, 0), packing.position(i, 1));
    text += is_yade ? fmt::format("{} {} 0 {}\n", at.x(), at.y(), r)
                    : fmt::format("{} 1 {} {} {} {} 0\n", i + 1, 2.0 * r, population.density(), at.x(), at.y());
  }
  scarp::write_file(stem.string() + (is_yade ? ".txt" : ".data"), text);
}

/// Writes STEM_particles.csv, STEM_contacts.csv and STEM_cell.csv (base vectors [m]).
/// The list of pairs is to be in order, as a Specimen keeps it.
/// \throws FileError when a file cannot be written
template <class PackingType>
void write_state(std::filesystem::path const& folder, std::string const& stem, PackingType const& packing,
                 typename PackingType::Law const& law) {
  scarp::CsvTable cell({"a1x", "a1y", "a2x", "a2y"});
  cell.add(packing.cell(0, 0), packing.cell(1, 0), packing.cell(0, 1), packing.cell(1, 1));
  particle_table(packing).write(folder / (stem + "_particles.csv"));
  contact_table(packing, law).write(folder / (stem + "_contacts.csv"));
  cell.write(folder / (stem + "_cell.csv"));
}

}  // namespace rve_lab
