// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>

#include "scarp/io/csv_reader.hpp"
#include "scarp/tensor/tensor.hpp"

namespace examples {

/// Grains of another code's file.
struct GrainFile {
  scarp::CsvColumns grains;                ///< as read_packing takes them
  std::optional<scarp::Tensor<3>> cell{};  ///< base vectors as columns [m], where the file has them
  std::vector<std::string> notes{};        ///< what is in the file and not here, a sentence each
};

namespace detail {

inline std::optional<double> number_in(std::string_view word) {
  double number = 0.0;
  return scarp::read_number(word, number) == std::errc{} ? std::optional(number) : std::nullopt;
}

/// Collects id, x, y, z, r of grains from lines of words. The first line has lost a # at its beginning, later comments
/// are not here.
class GrainLines {
 public:
  using Line = scarp::detail::CsvLine;

  GrainLines(std::string_view text, std::string const& file) : file_(file) {
    for (scarp::TextLines all(text); !all.done();) {
      std::string_view line = all.take();
      bool const marked = line.starts_with('#');
      if (marked && all.number() > 1) continue;
      if (marked) line.remove_prefix(1);
      Line words{all.number(), {}};
      while (!(line = scarp::trimmed(line)).empty()) {
        auto const end = std::min(line.find_first_of(" \t"), line.size());
        words.cells.emplace_back(line.substr(0, end));
        line.remove_prefix(end);
      }
      if (!words.cells.empty()) lines_.push_back(std::move(words));
    }
  }

  std::size_t count() const { return lines_.size(); }
  std::vector<std::string> const& words(std::size_t line) const { return lines_[line].cells; }
  std::string const& word(std::size_t line, std::size_t at) const {
    if (line >= lines_.size()) scarp::reject("'{}' ends too soon (it is cut off): write or copy it again", file_);
    if (at < words(line).size()) return words(line)[at];
    scarp::reject("line {} of '{}' has {} words ({} are needed): check it", lines_[line].number, file_,
                  words(line).size(), at + 1);
  }
  double number(std::size_t line, std::size_t at) const {
    if (auto const value = number_in(word(line, at)); value && std::isfinite(*value)) return *value;
    scarp::reject("line {} of '{}' has '{}' (it is no number): check it", lines_[line].number, file_, word(line, at));
  }
  /// The word behind a key.
  std::size_t behind(std::size_t line, std::string_view key) const {
    auto const& all = words(line);
    auto const found = std::find(all.begin(), all.end(), key);
    if (found == all.end())
      scarp::reject("line {} of '{}' has no {} (a grain has one): check it", lines_[line].number, file_, key);
    return scarp::detail::index(found - all.begin()) + 1;
  }

  /// at: the words of id, x, y, z, and of the radius or, with scale 0.5, of the diameter; without ids they count from 0
  void add(std::size_t line, std::array<std::optional<std::size_t>, 5> const& at, double scale) {
    Line row{lines_[line].number, {std::to_string(rows_.size())}};
    if (at[0]) row.cells[0] = word(line, *at[0]);
    for (std::size_t k = 1; k < at.size(); ++k) row.cells.push_back(word(line, at[k].value()));
    if (auto const size = number_in(row.cells[4]); size && scale != 1.0)
      row.cells[4] = fmt::format("{}", scale * *size);
    rows_.push_back(std::move(row));
  }
  void restart() {
    rows_.clear();
    kinds_.clear();
  }
  /// Remembers the material of a grain, the word that names it.
  void add_kind(std::size_t line, std::size_t at) { kinds_.insert(word(line, at)); }
  /// Notes on what was remembered, and on units other than those of SI.
  void note(std::vector<std::string>& notes, std::string const& units = {}) const {
    if (kinds_.size() > 1) notes.push_back(fmt::format("{} materials are read as one", kinds_.size()));
    if (!units.empty() && units != "si")
      notes.push_back(fmt::format("its units are '{}': lengths are read as m", units));
  }
  /// \throws InputError unless there are as many grains as the file announces, where it does
  void require_complete(std::optional<double> announced) const {
    if (announced && *announced != static_cast<double>(rows_.size()))
      scarp::reject("'{}' announces {} grains and has {} (it is cut off or damaged): write or copy it again", file_,
                    *announced, rows_.size());
  }
  scarp::CsvColumns columns() && { return {file_, {0, {"id", "x", "y", "z", "r"}}, std::move(rows_)}; }

  [[noreturn]] void reject_line(std::size_t line, std::string_view why, std::string_view suggestion) const {
    scarp::reject("line {} of '{}' begins with '{}' ({}): {}", lines_[line].number, file_, word(line, 0), why,
                  suggestion);
  }

 private:
  std::vector<Line> lines_;
  std::string file_;
  std::vector<Line> rows_{};
  std::set<std::string> kinds_{};
};

/// A box with edges along the axes, sheared.
inline scarp::Tensor<3> sheared_box(std::array<double, 3> const& edges, std::array<double, 3> const& tilts = {}) {
  scarp::Tensor<3> cell;
  cell << edges[0], tilts[0], tilts[1], 0.0, edges[1], tilts[2], 0.0, 0.0, edges[2];
  return cell;
}

/// Yade's export.text, export.textExt and SpherePack.save: a line `#format x_y_z_r...`, comments, one line for each
/// grain.
inline GrainFile read_yade(GrainLines lines) {
  std::array<std::optional<std::size_t>, 5> at{std::nullopt, 0, 1, 2, 3};
  std::optional<scarp::Tensor<3>> cell;
  std::vector<std::string> notes;
  auto const& format = lines.count() > 0 && lines.words(0).size() > 1 ? lines.word(0, 1) : std::string();
  bool const has_head = lines.count() > 0 && !number_in(lines.word(0, 0));
  if (has_head && lines.word(0, 0) == "format") {
    if (format.starts_with("id_")) at = {0, 1, 2, 3, 4};
    auto const places = format.find("x_y_z_r");
    if (places > 3) lines.reject_line(0, "places and radii are read", "export it as x_y_z_r");
    if (auto const further = format.substr(places + 7); further.find("clumpId") != std::string::npos) {
      auto const column =
          *at[4] + static_cast<std::size_t>(
                       std::count(further.begin(), further.begin() + std::ptrdiff_t(further.find("clumpId")), '_'));
      for (std::size_t k = 1; k < lines.count(); ++k) {
        if (lines.word(k, column) != "-1")
          lines.reject_line(k, "it is a member of a clump, which would become a grain of its own",
                            "export single spheres");
      }
    } else if (!further.empty()) {
      notes.push_back(fmt::format("of its columns {} those behind r are not read", format));
    }
  } else if (has_head && lines.word(0, 0) == "#PERIODIC::") {
    cell = sheared_box({lines.number(0, 1), lines.number(0, 2), lines.number(0, 3)});
  } else if (has_head && lines.word(0, 0) == "O.cell.hSize") {  // = Matrix3( a , b , ... )
    for (int k = 0; k < 9; ++k)
      (cell ? *cell : cell.emplace())(k / 3, k % 3) = lines.number(0, scarp::detail::index(3 + 2 * k));
  } else if (lines.count() > (has_head ? 1u : 0u) && lines.words(has_head ? 1 : 0).size() != 4) {
    lines.reject_line(0, "its columns are not named; without a line '#format' x y z r are read",
                      "export it as x_y_z_r, or leave other columns out");
  }
  for (std::size_t k = has_head ? 1 : 0; k < lines.count(); ++k) lines.add(k, at, 1.0);
  return {std::move(lines).columns(), cell, std::move(notes)};
}

/// A data file of LAMMPS with the atom style sphere: id, type, diameter, density, x, y, z.
/// docs.lammps.org/read_data.html
inline GrainFile read_lammps_data(GrainLines lines) {
  std::array<double, 3> edges{};
  std::array<double, 3> tilts{};
  std::optional<double> announced;
  bool in_atoms = false;
  std::string units;
  for (std::size_t k = 0; lines.count() > 0 && k + 2 < lines.words(0).size(); ++k)
    if (lines.word(0, k) == "units") units = lines.word(0, k + 2);  // units = si
  for (std::size_t k = 1; k < lines.count(); ++k) {
    auto const& words = lines.words(k);
    if (!number_in(words[0])) {
      in_atoms = words[0] == "Atoms";
      if (in_atoms && words.size() < 3)
        lines.reject_line(k, "its style is not named; sphere has diameters", "write 'Atoms # sphere' where it is that");
      if (in_atoms && words[2] != "sphere")
        lines.reject_line(k, fmt::format("the style '{}' has no diameters", words[2]),
                          "write it with atom_style sphere");
    } else if (in_atoms) {
      lines.add(k, {0, 4, 5, 6, 2}, 0.5);
      lines.add_kind(k, 1);
    } else if (words.size() == 2 && words[1] == "atoms") {
      announced = lines.number(k, 0);
    } else if (words.size() >= 4 && (words[2] == "xlo" || words[2] == "ylo" || words[2] == "zlo")) {
      edges[scarp::detail::index(words[2][0] - 'x')] = lines.number(k, 1) - lines.number(k, 0);
    } else if (words.size() >= 4 && words[3] == "avec") {
      lines.reject_line(k, "a general triclinic box is not read", "write it without triclinic/general");
    } else if (words.size() >= 6 && words[3] == "xy") {
      tilts = {lines.number(k, 0), lines.number(k, 1), lines.number(k, 2)};
    }
  }
  lines.require_complete(announced);
  std::vector<std::string> notes{"densities of grains are not read"};
  lines.note(notes, units);
  return {std::move(lines).columns(), sheared_box(edges, tilts), std::move(notes)};
}

/// The last snapshot of a dump file of LAMMPS, with columns x, y, z and radius or diameter. docs.lammps.org/dump.html
inline GrainFile read_lammps_dump(GrainLines lines) {
  std::optional<scarp::Tensor<3>> cell;
  std::vector<std::string> notes;
  std::optional<double> announced;
  std::string units;
  int snapshots = 0;
  std::size_t begun = 0;  // line of the last snapshot's head that no grains have followed yet
  for (std::size_t k = 0; k < lines.count(); ++k) {
    if (lines.word(k, 0) != "ITEM:") continue;
    if (lines.word(k, 1) == "UNITS") units = lines.word(k + 1, 0);
    if (lines.word(k, 1) == "NUMBER") announced = lines.number(k + 1, 0);
    begun = lines.word(k, 1) == "ATOMS" ? 0 : k;
    if (lines.word(k, 1) == "BOX") {
      if (lines.words(k).size() > 3 && lines.word(k, 3) == "abc")
        lines.reject_line(k, "a general triclinic box is not read", "write it with triclinic/general off");
      auto const& words = lines.words(k);
      bool const walls =
          words.size() > 5 && std::any_of(words.end() - 3, words.end(), [](auto const& word) { return word != "pp"; });
      notes.clear();
      if (walls) notes.emplace_back("boundaries that are not periodic are read as periodic ones");
      std::array<double, 3> tilts{};
      bool const tilted = lines.words(k).size() > 3 && lines.word(k, 3) == "xy";
      for (std::size_t a = 0; tilted && a < 3; ++a) tilts[a] = lines.number(k + 1 + a, 2);
      auto const edge = [&](std::size_t a) { return lines.number(k + 1 + a, 1) - lines.number(k + 1 + a, 0); };
      auto const [xy, xz, yz] = tilts;  // the bounds hold the whole of a sheared box
      double const x_more = std::max({0.0, xy, xz, xy + xz}) - std::min({0.0, xy, xz, xy + xz});
      cell = sheared_box({edge(0) - x_more, edge(1) - std::abs(yz), edge(2)}, tilts);
    } else if (lines.word(k, 1) == "ATOMS") {
      ++snapshots;
      lines.restart();
      std::set<std::string> molecules;
      auto const& words = lines.words(k);
      auto const column = [&](std::string_view name) -> std::optional<std::size_t> {
        auto const found = std::find(words.begin(), words.end(), name);
        return found == words.end() ? std::nullopt : std::optional(scarp::detail::index(found - words.begin()) - 2);
      };
      auto const place = [&](std::string const& axis) { return column(axis) ? column(axis) : column(axis + "u"); };
      bool const radii = column("radius").has_value();
      std::array const at{column("id"), place("x"), place("y"), place("z"),
                          radii ? column("radius") : column("diameter")};
      if (!at[1] || !at[2] || !at[3] || !at[4])
        lines.reject_line(k, "places and sizes are needed", "write it by `dump ... custom ... id x y z radius`");
      while (k + 1 < lines.count() && lines.word(k + 1, 0) != "ITEM:") {
        lines.add(++k, at, radii ? 1.0 : 0.5);
        if (auto const type = column("type")) lines.add_kind(k, *type);
        if (auto const molecule = column("mol");
            molecule && !molecules.insert(lines.word(k, *molecule)).second && lines.word(k, *molecule) != "0")
          lines.reject_line(
              k,
              fmt::format("the grains of molecule {} are one body, which would fall apart", lines.word(k, *molecule)),
              "leave mol out where they are free");
      }
    }
  }
  if (begun > 0) lines.reject_line(begun, "no ITEM: ATOMS follows, the file is cut off", "write or copy it again");
  lines.require_complete(announced);
  lines.note(notes, units);
  if (snapshots > 1) notes.push_back(fmt::format("the last of {} snapshots is read", snapshots));
  return {std::move(lines).columns(), cell, notes};
}

/// A restart file of MercuryDPM: keys with their values.
inline GrainFile read_mercury(GrainLines lines) {
  std::optional<scarp::Tensor<3>> cell;
  std::vector<std::string> notes;
  int fixed = 0;
  for (std::size_t k = 1; k < lines.count(); ++k) {
    auto const& key = lines.word(k, 0);
    if (key == "xMin") {
      cell = sheared_box({lines.number(k, 3) - lines.number(k, 1), lines.number(k, 7) - lines.number(k, 5),
                          lines.number(k, 11) - lines.number(k, 9)});
    } else if (key == "Boundaries") {
      long others = 0;
      for (auto left = lines.number(k, 1); left > 0.0; --left)
        if (lines.word(k + static_cast<std::size_t>(left), 0) != "PeriodicBoundary") ++others;
      if (others > 0) notes.push_back(fmt::format("{} boundaries are not read: the cell is periodic", others));
    } else if (key == "Walls" && lines.number(k, 1) > 0.0) {
      notes.push_back(fmt::format("{} walls are not read: the cell is periodic", lines.word(k, 1)));
    } else if (key == "SphericalParticle" || key == "BaseParticle") {
      lines.reject_line(k, "more particles stand here than are announced", "write or copy the file again");
    } else if (key == "Particles") {
      for (auto left = lines.number(k, 1); left > 0.0; --left) {
        if (lines.word(++k, 0) == "Interactions")
          lines.reject_line(k, "fewer particles stand before it than are announced", "write or copy the file again");
        if (lines.word(k, 0) != "SphericalParticle" && lines.word(k, 0) != "BaseParticle")
          lines.reject_line(k, "spheres are read", "leave other particles out");
        auto const place = lines.behind(k, "position");
        lines.add_kind(k, lines.behind(k, "indSpecies"));
        if (lines.number(k, lines.behind(k, "invMass")) == 0.0) ++fixed;
        lines.add(k, {lines.behind(k, "id"), place, place + 1, place + 2, lines.behind(k, "radius")}, 1.0);
      }
    }
  }
  lines.note(notes);
  if (fixed > 0) notes.push_back(fmt::format("{} fixed grains are read as free ones", fixed));
  return {std::move(lines).columns(), cell, notes};
}

}  // namespace detail

/// Reads the grains of a file, whose form its first lines show: text of Yade, data (style sphere) and dump files of
/// LAMMPS, restart files of MercuryDPM, tables with commas as for read_packing.
/// \throws InputError naming file and line for what cannot be read
inline GrainFile read_grains(std::filesystem::path const& path) {
  auto const text = scarp::read_file(path);
  auto const name = path.string();
  auto const first = text.substr(0, text.find('\n'));
  auto const noted = [&](GrainFile file) {
    for (auto& note : file.notes) note = fmt::format("'{}': {}", name, note);
    return file;
  };
  if (first.starts_with("ITEM:")) return noted(detail::read_lammps_dump({text, name}));
  if (first.starts_with("MercuryDPM")) return noted(detail::read_mercury({text, name}));
  if (text.find("\nAtoms") != std::string::npos) return noted(detail::read_lammps_data({text, name}));
  auto const begin = std::min(first.find_first_not_of(" \t"), first.size());
  bool const numbers = first.find(',') == std::string::npos && first.find_first_of("+-.0123456789") == begin;
  return numbers || first.starts_with('#') ? noted(detail::read_yade({text, name}))
                                           : GrainFile{scarp::CsvColumns(text, name)};
}

}  // namespace examples
