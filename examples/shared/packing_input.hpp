// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "grain_files.hpp"
#include "print.hpp"
#include "scarp/tensor/tensor.hpp"

namespace examples {

using Tensor = scarp::Tensor<2>;

/// \throws InputError unless the text is four finite numbers of a right-handed cell
inline Tensor parse_cell(std::string const& text) {
  std::vector<double> numbers;
  bool sound = true;
  for (std::size_t begin = 0; begin <= text.size() && sound;) {
    auto const end = std::min(text.find(',', begin), text.size());
    double& number = numbers.emplace_back();
    sound =
        scarp::read_number(scarp::trimmed(std::string_view(text).substr(begin, end - begin)), number) == std::errc{} &&
        std::isfinite(number);
    begin = end + 1;
  }
  if (!sound || numbers.size() != 4) {
    scarp::reject("'{}' is no cell (four numbers with commas in between are wanted): write a1x,a1y,a2x,a2y in m", text);
  }
  Tensor cell;
  cell << numbers[0], numbers[2], numbers[1], numbers[3];
  if (!(cell.determinant() > 0.0)) {
    scarp::reject(
        "the cell '{}' has an area of {} m2 (its base vectors must be right-handed): exchange or correct them", text,
        cell.determinant());
  }
  return cell;
}

/// Branches of the contacts of a table [m], or nothing where it does not hold them: columns branch_x and branch_y, or
/// for discs nx, ny and overlap, which with the radii are equivalent.
inline std::vector<scarp::Vector<2>> branches(scarp::CsvColumns const& contacts, std::vector<double> const& radii_sum) {
  std::vector<scarp::Vector<2>> found;
  if (contacts.has("branch_x") && contacts.has("branch_y")) {
    auto const x = contacts.column("branch_x");
    auto const y = contacts.column("branch_y");
    for (std::size_t c = 0; c < x.size(); ++c) found.emplace_back(x[c], y[c]);
  } else if (!radii_sum.empty() && contacts.has("nx") && contacts.has("ny") && contacts.has("overlap")) {
    auto const x = contacts.column("nx");
    auto const y = contacts.column("ny");
    auto const overlap = contacts.column("overlap");
    for (std::size_t c = 0; c < x.size(); ++c)
      found.push_back((radii_sum[c] - overlap[c]) * scarp::Vector<2>(x[c], y[c]));
  }
  return found;
}

/// Equation of a contact for the cell: branch = x2 - x1 + H image.
struct CellClues {
  std::vector<scarp::Vector<2>> offset;  ///< branch - (x2 - x1) [m]
  std::vector<scarp::Vector<2>> image;   ///< in base vectors

  /// Least squares over the contacts that cross the boundary.
  /// \throws InputError where these do not span the plane
  Tensor solve(std::string const& file) const {
    Tensor normal = Tensor::Zero();
    Tensor right = Tensor::Zero();
    for (std::size_t c = 0; c < offset.size(); ++c) {
      normal += image[c] * image[c].transpose();
      right += offset[c] * image[c].transpose();
    }
    if (!(normal.determinant() > 0.5)) {  // of whole numbers
      scarp::reject(
          "the cell cannot be determined from '{}' (too few of its contacts have branches and cross the boundary): "
          "give --cell a1x,a1y,a2x,a2y",
          file);
    }
    return right * normal.inverse();
  }

  /// \throws InputError for a contact that lies elsewhere in this cell
  void check(Tensor const& cell, scarp::CsvColumns const& contacts) const {
    constexpr double most = 1e-5;  // of the cell, more than the rounding of seven digits
    for (std::size_t c = 0; c < offset.size(); ++c) {
      double const error = (offset[c] - cell * image[c]).norm();
      if (error <= most * cell.norm()) continue;
      scarp::reject(
          "line {} of '{}' lies {} m elsewhere in the cell {},{},{},{} (branch = x2 - x1 + cell x image is "
          "wanted): check the cell and the particles",
          contacts.line(c), contacts.file(), error, cell(0, 0), cell(1, 0), cell(0, 1), cell(1, 1));
    }
  }
};

inline CellClues cell_clues(scarp::CsvColumns const& particles, scarp::CsvColumns const& contacts) {
  std::unordered_map<std::int64_t, std::size_t> row_of;
  if (particles.has("id")) {
    std::size_t row = 0;
    for (auto const id : particles.column<std::int64_t>("id")) {
      if (!row_of.emplace(id, row).second)
        particles.reject_cell(row, "id", "an earlier line has the same", "give each grain an id of its own");
      ++row;
    }
  } else {
    for (std::size_t i = 0; i < particles.rows(); ++i) row_of.emplace(static_cast<std::int64_t>(i), i);
  }
  auto const rows = [&](std::string_view name) {
    std::vector<std::size_t> found;
    for (auto const id : contacts.column<std::int64_t>(name)) {
      auto const known = row_of.find(id);
      if (known == row_of.end())
        contacts.reject_cell(found.size(), name, "no particle has this id", "check which packing the file belongs to");
      found.push_back(known->second);
    }
    return found;
  };
  auto const first = rows("id1");
  auto const second = rows("id2");
  std::vector<double> radii_sum;
  if (particles.has("r")) {
    auto const radius = particles.column("r");
    for (std::size_t c = 0; c < first.size(); ++c) radii_sum.push_back(radius[first[c]] + radius[second[c]]);
  }
  auto const branch = branches(contacts, radii_sum);
  auto const x = particles.column("x");
  auto const y = particles.column("y");
  auto const i = contacts.column("cell_i");
  auto const j = contacts.column("cell_j");
  CellClues clues;
  for (std::size_t c = 0; c < branch.size(); ++c) {
    clues.offset.push_back(branch[c] - scarp::Vector<2>(x[second[c]] - x[first[c]], y[second[c]] - y[first[c]]));
    clues.image.emplace_back(i[c], j[c]);
  }
  return clues;
}

/// The one value of a column that is to be the same for all contacts; nothing where there is no such column.
/// \throws InputError for a mixture
inline std::optional<double> only_value(scarp::CsvColumns const& contacts, std::string_view name) {
  if (!contacts.has(name) || contacts.rows() == 0) return std::nullopt;
  constexpr double same = 1e-9;
  auto const values = contacts.column(name);
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (!(std::abs(values[c] - values[0]) <= same * std::abs(values[0]))) {
      contacts.reject_cell(c, name, fmt::format("the first contact has {}, a law has one value", values[0]),
                           "give contacts of one material");
    }
  }
  return values[0];
}

/// Name of the grains' shape, by their columns.
/// \throws InputError where there are no sizes, and for those of two shapes
inline std::string shape_of(scarp::CsvColumns const& particles) {
  if (particles.has("r") && particles.has("a") && particles.has("b"))
    scarp::reject("'{}' has columns r and a, b (discs have r, ellipses a, b and angle): leave those of one out",
                  particles.file());
  if (particles.has("r")) return "disc";
  if (particles.has("a") && particles.has("b")) return particles.has("eps") ? "superellipse" : "ellipse";
  scarp::reject("'{}' has no sizes of grains (columns r, or a, b and angle, or a, b, eps and angle): add them",
                particles.file());
}

/// Another code's packing from its files: grains, contacts where they are given, cell (columns: base vectors [m]).
struct PackingInput {
  scarp::CsvColumns particles;
  std::optional<scarp::CsvColumns> contacts;
  Tensor cell;
};

/// particles, contacts: names of files; cell: a1x,a1y,a2x,a2y. Where the cell is empty it is that of the file of the
/// particles, or what the contacts that cross the boundary determine.
/// \throws InputError for files that are wrong or do not fit together
inline PackingInput read_packing_input(std::string const& particles, std::string const& contacts,
                                       std::string const& cell) {
  auto file = read_grains(particles);
  if (cell.empty() && contacts.empty() && !file.cell) {
    scarp::reject(
        "the cell is not known (neither --cell nor --contacts is given, nor does '{}' hold it): give --cell "
        "a1x,a1y,a2x,a2y",
        particles);
  }
  if (file.grains.has("z"))
    file.notes.push_back(fmt::format("'{}': the column z is not read: grains are discs", particles));
  print_notes(file.notes);
  PackingInput input{std::move(file.grains), std::nullopt, Tensor::Identity()};
  if (!contacts.empty()) input.contacts = scarp::read_csv(contacts);
  CellClues const clues = input.contacts ? cell_clues(input.particles, *input.contacts) : CellClues{};
  if (!cell.empty()) {
    input.cell = parse_cell(cell);
  } else {
    input.cell = file.cell ? Tensor(file.cell->topLeftCorner<2, 2>()) : clues.solve(contacts);
  }
  if (input.contacts) clues.check(input.cell, *input.contacts);
  return input;
}

/// \throws InputError when a result would take the place of an input
inline void reject_overwriting(std::string const& out, std::initializer_list<std::string> inputs) {
  for (auto const& input : inputs) {
    std::error_code trouble;
    if (!std::filesystem::equivalent(out, input, trouble) || trouble) continue;
    scarp::reject("'{}' would be written over (it is an input): give --out another name", input);
  }
}

}  // namespace examples
