// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <map>

#include "scarp/core/index.hpp"
#include "scarp/dem/contacts.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/io/packings/packing_reader.hpp"

namespace examples {

namespace detail {

/// One line of a table of contacts.
template <int Dim>
struct ListedContact {
  std::size_t first;          ///< grain
  std::size_t second;         ///< grain
  scarp::Vector<Dim> branch;  ///< between the centres [m]
  scarp::Vector<Dim> shear;   ///< force on the second grain [N]
};

template <class PackingType>
std::vector<std::size_t> grains_of(scarp::NamedPacking<PackingType> const& named, scarp::CsvColumns const& table,
                                   std::string_view column) {
  std::vector<std::size_t> grains;
  for (std::int64_t const id : table.column<std::int64_t>(column)) {
    auto const known = named.grain.find(id);
    if (known == named.grain.end()) {
      table.reject_cell(grains.size(), column, "no grain of the packing has this id",
                        "check that both files are of one packing");
    }
    grains.push_back(known->second);
  }
  return grains;
}

/// Images are counted from where the grains stand in their file: the packing must still be as it was read.
template <class PackingType>
std::vector<ListedContact<PackingType::dim>> listed_contacts(scarp::NamedPacking<PackingType> const& named,
                                                             scarp::CsvColumns const& table) {
  constexpr int dim = PackingType::dim;
  constexpr std::array<std::string_view, 3> image_names{"cell_i", "cell_j", "cell_k"};
  constexpr std::array<std::string_view, 3> shear_names{"ftx", "fty", "ftz"};
  auto const first = grains_of(named, table, "id1");
  auto const second = grains_of(named, table, "id2");
  std::vector<ListedContact<dim>> listed(table.rows());
  for (std::size_t c = 0; c < listed.size(); ++c) {
    listed[c] = {first[c], second[c], scarp::Vector<dim>::Zero(), scarp::Vector<dim>::Zero()};
  }
  for (int a = 0; a < dim; ++a) {
    auto const images = table.column<std::int64_t>(image_names[scarp::detail::index(a)]);
    auto const forces = table.column(shear_names[scarp::detail::index(a)]);
    auto const* const place = named.packing.position.column(a);
    for (std::size_t c = 0; c < listed.size(); ++c) {
      listed[c].branch += named.packing.cell.col(a) * static_cast<double>(images[c]);
      listed[c].branch(a) += static_cast<double>(place[second[c]]) - static_cast<double>(place[first[c]]);
      listed[c].shear(a) = forces[c];
    }
  }
  return listed;
}

/// The near pairs of a packing by the grains that they join.
template <int Dim>
class PairsOfGrains {
 public:
  template <class PackingType>
  PairsOfGrains(PackingType const& packing, typename PackingType::Law const& law)
      : same_(packing.population->largest_radius() / 2.0) {
    scarp::for_each_near_pair(packing, law, [&](scarp::Contact<Dim> const& contact) {
      contacts_.emplace(std::pair(std::minmax({contact.first, contact.second})), contact);
    });
  }

  /// The pair that a line of a file speaks of, null for none; where they name the grains in opposite orders, the line
  /// is turned round. Branches distinguish images: they differ by lattice vectors, which are longer than two largest
  /// radii.
  scarp::Contact<Dim> const* find(ListedContact<Dim>& listed) const {
    auto const [begin, end] = contacts_.equal_range(std::pair(std::minmax({listed.first, listed.second})));
    for (int order = 0; order < 2; ++order) {
      for (auto pair = begin; pair != end; ++pair) {
        scarp::Contact<Dim> const& contact = pair->second;
        if (contact.first == listed.first && (contact.branch - listed.branch).norm() < same_) return &contact;
      }
      listed = {listed.second, listed.first, -listed.branch, -listed.shear};
    }
    return nullptr;
  }

 private:
  double same_;  ///< [m]
  std::multimap<std::pair<std::size_t, std::size_t>, scarp::Contact<Dim>> contacts_;
};

template <class Scalar, int Count, int Dim>
void write_shear(scarp::SoaArray<Scalar, Count>& columns, scarp::Contact<Dim> const& contact,
                 scarp::Vector<Dim> const& force) {
  scarp::Point<Dim, double> vector;
  for (std::size_t a = 0; a < vector.size(); ++a) vector[a] = force(static_cast<int>(a));
  auto const shear = scarp::tangential_part(vector, contact.touch.normal);
  if constexpr (Count == 1) {
    columns(contact.pair, 0) = static_cast<Scalar>(shear);
  } else {
    for (int a = 0; a < Count; ++a) {
      columns(contact.pair, a) = static_cast<Scalar>(shear[scarp::detail::index(a)]);
    }
  }
}

}  // namespace detail

/// Reads the shear memory of contacts, and makes the list of pairs on the way. Columns id1, id2; cell_i, cell_j
/// (cell_k): image of the second grain in base vectors, counted from where the grains stand in their file; ftx, fty
/// (ftz): shear force on the second grain [N]. Where there is a column overlap [m], it must agree with the packing's
/// within `tolerance` times the smallest radius; its default is far above round-off of numbers written in full and far
/// below an overlap that carries load.
/// \throws InputError naming the line for unknown grains, contacts of grains that are not near, contacts listed twice,
/// and overlaps that disagree; the packing is then as before
template <class PackingType>
void read_contacts(scarp::NamedPacking<PackingType>& named, scarp::CsvColumns const& table,
                   typename PackingType::Law const& law, double tolerance = 1e-6) {
  constexpr int dim = PackingType::dim;
  static_assert(PackingType::Law::inputs.shear, "a law without shear memory has no use for a table of shear forces");
  static_assert(scarp::part_count<typename PackingType::Shape>() == 1,
                "grains of several parts may touch more than once");
  if (named.packing.pairs.skin >= 0.0) {
    scarp::reject(
        "the contacts of '{}' cannot be read (the packing has a list of pairs, so its grains may have changed places): "
        "read them right after the grains",
        table.file());
  }
  auto packing = named.packing;
  auto listed = detail::listed_contacts(named, table);
  if (!scarp::TimeStepper<PackingType>{}.refresh(packing, law).acceptable()) {
    scarp::reject(
        "the contacts of '{}' cannot be read (the packing's cell is too thin for its grains): use a larger packing",
        table.file());
  }
  detail::PairsOfGrains<dim> const pairs(packing, law);
  auto const overlaps = table.has("overlap") ? table.column("overlap") : std::vector<double>{};
  double const allowed = tolerance * packing.population->smallest_radius();
  std::unordered_map<std::size_t, std::size_t> row_of_pair;
  for (std::size_t c = 0; c < listed.size(); ++c) {
    scarp::Contact<dim> const* const contact = pairs.find(listed[c]);
    if (contact == nullptr) {
      scarp::reject(
          "line {} of '{}' lists a contact of grains {} and {} (they are not near each other at this image): check "
          "that "
          "both files are of one moment, and the cell",
          table.line(c), table.file(), named.ids[listed[c].first], named.ids[listed[c].second]);
    }
    auto const [other, is_new] = row_of_pair.emplace(contact->pair, c);
    if (!is_new) {
      scarp::reject("line {} of '{}' lists a contact of grains {} and {} (line {} lists the same): remove one",
                    table.line(c), table.file(), named.ids[listed[c].first], named.ids[listed[c].second],
                    table.line(other->second));
    }
    if (!overlaps.empty() && !(std::abs(overlaps[c] - contact->touch.overlap) <= allowed)) {
      table.reject_cell(c, "overlap", fmt::format("in the packing it is {} m", contact->touch.overlap),
                        "check that both files are of one moment, or allow a wider tolerance");
    }
    detail::write_shear(packing.pairs.shear, *contact, listed[c].shear);
  }
  named.packing = std::move(packing);
}

/// Reads the contacts of a CSV file.
/// \throws InputError for a file that cannot be read, and for contacts that do not fit the packing
template <class PackingType>
void read_contacts(scarp::NamedPacking<PackingType>& named, std::filesystem::path const& path,
                   typename PackingType::Law const& law, double tolerance = 1e-6) {
  read_contacts(named, scarp::read_csv(path), law, tolerance);
}

}  // namespace examples
