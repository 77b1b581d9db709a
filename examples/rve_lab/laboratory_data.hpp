// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/io/csv_reader.hpp"

namespace rve_lab {

/// A table of a test in the laboratory, compression positive, with strains of 1 and stresses of Pa or, where their
/// names say so, of per cent and kPa: axial_strain and volumetric_strain (or eps1 and epsv) and stress_ratio (q/p), or
/// q and p. Columns of path.csv will do. Strains are logarithmic; those over initial lengths and volumes have names
/// that begin with engineering_.
struct LabTable {
  std::string file;
  std::vector<double> strain;
  std::vector<double> sine{};         ///< of the mobilised friction angle; empty without stresses
  std::vector<double> sine_strain{};  ///< at which the sines are: of means over a row its middle
  std::vector<double> volumetric{};   ///< empty where it is not given
  std::vector<double> held{};         ///< stress that the path holds, at each row [Pa]; empty without q and p
  bool has_ratio = false;             ///< whether stresses are those of a stress_ratio: q and p tell what is held only

  /// triaxial: p is the mean of three principal stresses, q/p becomes \f$ \sin\varphi = 3 (q/p) / (6 + q/p) \f$; else
  /// of two,
  /// \f$ \sin\varphi = (q/p) / 2 \f$. holds_p: whether the path holds p and not the lateral stress
  /// \throws InputError for columns that are missing, and for values that no test has, with what they may be instead
  static LabTable read(std::string const& file, bool triaxial, bool holds_p) {
    auto const table = scarp::read_csv(file);
    LabTable lab{.file = file,
                 .strain = needed(table, "axial strain",
                                  {{"axial_strain"},
                                   {"axial_strain_percent", 0.01},
                                   {"eps1"},
                                   {"eps1_percent", 0.01},
                                   {"engineering_axial_strain"},
                                   {"engineering_axial_strain_percent", 0.01}})};
    if (lab.strain.size() < 3)
      scarp::reject("'{}' has {} rows (three at least make a curve): complete it", file, lab.strain.size());
    lab.sine_strain = lab.strain;
    lab.volumetric = found(table, {{"volumetric_strain"},
                                   {"volumetric_strain_percent", 0.01},
                                   {"epsv"},
                                   {"epsv_percent", 0.01},
                                   {"engineering_volumetric_strain"},
                                   {"engineering_volumetric_strain_percent", 0.01}});
    if (lab.volumetric.empty()) reject_other_volume(table);
    lab.sine = found(table, {{"stress_ratio"}});
    lab.has_ratio = !lab.sine.empty();
    bool const means = table.has("mean_q");
    bool const has_p = table.has(means ? "mean_p" : "p") || table.has("p_kPa");
    if ((means || table.has("q") || table.has("q_kPa")) && (has_p || !lab.has_ratio)) {
      auto const q = found(table, {{"mean_q"}, {"q"}, {"q_kPa", 1e3}});
      auto const p = needed(table, "mean stress", {{means ? "mean_p" : "p"}, {"p_kPa", 1e3}});
      if (!lab.has_ratio) lab.sine.resize(p.size());
      for (std::size_t row = 0; row < p.size(); ++row) {
        lab.held.push_back(holds_p ? p[row] : p[row] - q[row] / (triaxial ? 3.0 : 2.0));
        if (lab.has_ratio) continue;
        if (!(p[row] > 0.0))
          scarp::reject("line {} of '{}': p is {} Pa (a mean stress above 0 is expected): correct it", table.line(row),
                        file, p[row]);
        lab.sine[row] = q[row] / p[row];
        if (means && row > 0) lab.sine_strain[row] = (lab.strain[row - 1] + lab.strain[row]) / 2.0;
      }
    }
    if (lab.sine.empty() && lab.volumetric.empty())
      scarp::reject(
          "'{}' has no stress_ratio, no q and p, and no volumetric_strain (line 1 names {}; one of these is expected): "
          "name a column so",
          file, scarp::shortened(scarp::listed(table.names())));
    for (auto const& name : table.names()) {
      bool const is_stress = name.size() > 1 && std::string_view("qQpP").find(name[0]) != std::string_view::npos &&
                             std::string_view(" ([").find(name[1]) != std::string_view::npos;
      if (lab.sine.empty() && is_stress)
        scarp::reject(
            "'{}' has a column '{}' that is not read (stresses are q and p, or q_kPa and p_kPa): rename it, or leave "
            "it out",
            file, name);
    }
    for (double& ratio : lab.sine) ratio = triaxial ? 3.0 * ratio / (6.0 + ratio) : ratio / 2.0;
    lab.require_possible(table);
    return lab;
  }

  /// Stress that the test held [Pa]; none where the table has no stresses.
  /// \throws InputError for one that is not held
  std::optional<double> held_stress() const {
    constexpr double lowest = 1e3;  // [Pa], below those of any laboratory
    if (held.empty()) return std::nullopt;
    auto const [least, most] = std::ranges::minmax(held);
    if (!(least > 0.0 && most - least <= 0.2 * most))
      scarp::reject(
          "the stress that the test of '{}' holds goes from {:.4g} to {:.4g} Pa by its q and p (within 20 % of each "
          "other are "
          "expected): check their units, --triaxial and --path, or give stress_ratio and --lateral-stress",
          file, least, most);
    double const middle = (least + most) / 2.0;
    if (middle < lowest)
      scarp::reject(
          "the test of '{}' holds {:.4g} Pa by its q and p (at least {} Pa is expected): name the columns q_kPa and "
          "p_kPa where they "
          "are in kPa",
          file, middle, lowest);
    return middle;
  }

 private:
  /// \throws InputError for a column that may be the volumetric strain and is not read
  static void reject_other_volume(scarp::CsvColumns const& table) {
    for (auto const& name : table.names()) {
      std::string small = name;
      for (char& letter : small) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      if (small.starts_with("engineering_")) small.erase(0, small.find('_') + 1);
      if (small.starts_with("vol") || small.starts_with("epsv") || small.starts_with("eps_v"))
        scarp::reject(
            "'{}' has a column '{}' that is not read (volumetric strains are volumetric_strain or epsv, with _percent "
            "where they are): rename it, or leave it out",
            table.file(), name);
    }
  }

  struct Name {
    char const* name;
    double unit = 1.0;
  };

  static std::vector<double> found(scarp::CsvColumns const& table, std::initializer_list<Name> names) {
    for (auto const& [name, unit] : names) {
      if (!table.has(name)) continue;
      auto values = table.column<double>(name);
      for (std::size_t row = 0; row < values.size(); ++row) {
        double& value = values[row];
        value *= unit;
        if (!std::string_view(name).starts_with("engineering_")) continue;
        if (!(value < 1.0))
          scarp::reject(
              "line {} of '{}': {} is {} (below 1 is possible): let its name end in _percent where it is in per cent",
              table.line(row), table.file(), name, value);
        value = -std::log1p(-value);
      }
      return values;
    }
    return {};
  }

  static std::vector<double> needed(scarp::CsvColumns const& table, std::string_view what,
                                    std::initializer_list<Name> names) {
    auto values = found(table, names);
    std::vector<std::string> known;
    for (auto const& one : names) known.emplace_back(one.name);
    if (values.empty() && table.rows() > 0)
      scarp::reject("'{}' has no column of the {} (line 1 names {}; {} are known): rename one or add it", table.file(),
                    what, scarp::shortened(scarp::listed(table.names())), scarp::listed(known));
    return values;
  }

  void require_possible(scarp::CsvColumns const& table) const {
    constexpr double most_strain = 0.5, most_angle = 70.0, slight = 2e-3;
    auto const place = [&](std::size_t row) { return fmt::format("line {} of '{}'", table.line(row), file); };
    for (std::size_t row = 0; row < strain.size(); ++row) {
      if (row > 0 && strain[row] < strain[row - 1])
        scarp::reject("{}: the axial strain {} follows {} (it is not to decrease): give one loading path", place(row),
                      strain[row], strain[row - 1]);
      if (strain[row] > most_strain)
        scarp::reject(
            "{}: the axial strain is {} (at most {} is expected): let the name of its column end in _percent where it "
            "is in per cent",
            place(row), strain[row], most_strain);
      if (!volumetric.empty() && std::abs(volumetric[row]) > 3.0 * std::abs(strain[row]) + slight) {
        std::string const why = row == 0 ? "a test begins at 0): leave out what came before it"
                                         : "at most three times as much is expected): let the name of its column end "
                                           "in _percent where it is in per cent";
        scarp::reject("{}: the volumetric strain is {} at an axial strain of {} ({}", place(row), volumetric[row],
                      strain[row], why);
      }
      if (row + 1 == strain.size() && !(strain[row] > strain.front()))
        scarp::reject("'{}': the axial strain is {} in all rows (it is to increase): check the column", file,
                      strain[row]);
      double const limit = std::sin(most_angle * std::numbers::pi / 180.0);
      if (!sine.empty() && !(std::abs(sine[row]) <= limit))
        scarp::reject(
            "{}: q over p gives a sine of the friction angle of {:.4g} (at most {:.2f}, {} degrees, is expected): give "
            "q and p in one unit",
            place(row), sine[row], limit, most_angle);
    }
  }
};

}  // namespace rve_lab
