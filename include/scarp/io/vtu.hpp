// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/json.hpp"
#include "scarp/mesh/cells.hpp"

namespace scarp {

/// Base64 text of some bytes, with padding (RFC 4648, section 4).
inline std::string base64(std::span<std::byte const> bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::size_t group = 3;
  std::string text;
  text.reserve((bytes.size() + group - 1) / group * 4);
  for (std::size_t first = 0; first < bytes.size(); first += group) {
    std::size_t const given = std::min(group, bytes.size() - first);
    unsigned bits = 0;
    for (std::size_t k = 0; k < group; ++k) {
      bits = bits << 8U | (k < given ? std::to_integer<unsigned>(bytes[first + k]) : 0U);
    }
    for (std::size_t k = 0; k <= group; ++k) {
      text += k <= given ? letters[bits >> (6U * (group - k)) & 63U] : '=';
    }
  }
  return text;
}

/// Text that may stand between the quotes of an XML attribute.
inline std::string xml_text(std::string_view text) {
  std::string safe;
  for (char const letter : text) {
    switch (letter) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      default: safe += letter;
    }
  }
  return safe;
}

/// A named quantity at all nodes or all elements, numbers flat and component running fastest.
/// A vector (dim components) is written with three and a tensor (dim * dim, row by row) with nine, the added ones
/// zero, as VTK wants them; other counts, such as a Voigt stress, and fields with named components are written as they
/// are.
struct VtuField {
  std::string name;    ///< as ParaView lists it
  int components = 1;  ///< numbers of each node or element
  /// one entry for each node or element, its components side by side
  std::variant<std::span<double const>, std::span<int const>> values;
  std::vector<std::string> component_names{};  ///< empty or one for each component, such as xx, yy, xy
};

/// Fields of a VTU file.
struct VtuFields {
  std::vector<VtuField> at_nodes{};     ///< with values at the nodes
  std::vector<VtuField> at_elements{};  ///< with values in the elements
};

namespace detail {

template <class Number>
constexpr std::string_view vtk_type_name() {
  if constexpr (std::same_as<Number, double>) {
    return "Float64";
  } else if constexpr (std::same_as<Number, std::uint8_t>) {
    return "UInt8";
  } else {
    static_assert(std::same_as<Number, std::int32_t>, "a VTU array holds double, int or uint8_t");
    return "Int32";
  }
}

/// One inline DataArray: base64 of the number of bytes (UInt64) followed by the bytes.
template <class Number>
std::string vtu_array(std::string_view name, int components, std::vector<Number> const& values,
                      std::vector<std::string> const& component_names = {}) {
  std::uint64_t const length = values.size() * sizeof(Number);
  std::vector<std::byte> bytes(sizeof(length) + length);
  std::memcpy(bytes.data(), &length, sizeof(length));
  if (length > 0) {
    std::memcpy(bytes.data() + sizeof(length), values.data(), length);
  }
  std::string extra;
  for (std::size_t k = 0; k < component_names.size(); ++k) {
    extra += fmt::format(" ComponentName{}=\"{}\"", k, xml_text(component_names[k]));
  }
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"binary\">{}</DataArray>\n",
      vtk_type_name<Number>(), xml_text(name), components, extra, base64(bytes));
}

/// Vectors and tensors of fewer dimensions filled up with zeros to three.
template <class Number>
std::vector<Number> vtk_padded(std::span<Number const> values, int rows, int columns, int wanted_rows,
                               int wanted_columns) {
  std::size_t const entries = values.size() / index(rows * columns);
  std::vector<Number> padded(entries * index(wanted_rows * wanted_columns), Number(0));
  for (std::size_t entry = 0; entry < entries; ++entry) {
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < columns; ++j) {
        padded[entry * index(wanted_rows * wanted_columns) + index(i * wanted_columns + j)] =
            values[entry * index(rows * columns) + index(i * columns + j)];
      }
    }
  }
  return padded;
}

inline std::string vtu_field(VtuField const& field, std::size_t entries, std::string_view place, int dim) {
  constexpr int space = 3;  // VTK's
  return std::visit(
      [&](auto const values) {
        using Number = std::remove_const_t<typename decltype(values)::element_type>;
        if (field.components < 1 || values.size() != entries * index(field.components)) {
          reject("field '{}' has {} numbers (there are {} {} with {} components): size it accordingly", field.name,
                 values.size(), entries, place, field.components);
        }
        if (!field.component_names.empty() && count(field.component_names) != field.components) {
          reject("field '{}' has {} component names (it has {} components): name each or none", field.name,
                 field.component_names.size(), field.components);
        }
        if (dim > 1 && field.components == dim && field.component_names.empty()) {
          return vtu_array(field.name, space, vtk_padded<Number>(values, 1, dim, 1, space));
        }
        if (dim > 1 && field.components == dim * dim && field.component_names.empty()) {
          return vtu_array(field.name, space * space, vtk_padded<Number>(values, dim, dim, space, space));
        }
        return vtu_array(field.name, field.components, std::vector<Number>(values.begin(), values.end()),
                         field.component_names);
      },
      field.values);
}

/// A name that VTK can read and that no other field has.
inline void require_field_name(std::string const& name, std::set<std::string>& known) {
  bool sound = !name.empty() && valid_utf8(name) == name;
  for (char const letter : name) sound = sound && static_cast<unsigned char>(letter) >= 0x20 && letter != 0x7f;
  if (!sound)
    reject("a field is named '{}' (names are of one letter and more in UTF-8, without control characters): rename it",
           valid_utf8(name));
  if (!known.insert(name).second)
    reject("two fields are named '{}' (a file cannot distinguish them): rename one", name);
}

inline std::string vtu_fields(std::vector<VtuField> const& fields, std::string_view tag, std::size_t entries,
                              std::string_view place, int dim) {
  std::string text = fmt::format("<{}>\n", tag);
  std::set<std::string> known;
  for (auto const& field : fields) {
    require_field_name(field.name, known);
    std::set<std::string> components;
    for (auto const& name : field.component_names) require_field_name(name, components);
    text += vtu_field(field, entries, place, dim);
  }
  return text + fmt::format("</{}>\n", tag);
}

inline std::string vtu_cells(Cells const& cells) {
  std::vector<std::int32_t> offsets;
  for (int end = 1; end <= cells.count(); ++end) offsets.push_back(end * cells.nodes);
  std::vector<std::uint8_t> const types(offsets.size(), cells.vtk_type);
  return "<Cells>\n" + vtu_array("connectivity", 1, cells.connectivity) + vtu_array("offsets", 1, offsets) +
         vtu_array("types", 1, types) + "</Cells>\n";
}

}  // namespace detail

/// Writes an unstructured grid for ParaView and the like: XML with inline base64 binary, in full precision.
/// positions [m]: of the nodes, such as the deformed ones. The region of every element, where it has one, is added as
/// the cell field "region".
/// \throws InputError for fields of the wrong length, and for names of fields that are there twice or no text
/// \throws FileError when the file cannot be written; an older file of this name is then untouched
template <int Dim>
void write_vtu(std::filesystem::path const& path, Cells const& cells, std::vector<Vector<Dim>> const& positions,
               VtuFields const& fields = {}) {
  constexpr int dim = Dim;
  constexpr bool little = std::endian::native == std::endian::little;
  std::vector<double> flat;
  for (auto const& position : positions) {
    flat.insert(flat.end(), position.begin(), position.end());
  }
  auto at_elements = fields.at_elements;
  if (!cells.regions.empty()) at_elements.push_back({"region", 1, std::span<int const>(cells.regions), {}});
  auto const elements = static_cast<std::size_t>(cells.count());
  auto const points = detail::vtk_padded<double>(flat, 1, dim, 1, 3);
  write_file(
      path, fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
                        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" "
                        "NumberOfCells=\"{}\">\n",
                        little ? "LittleEndian" : "BigEndian", positions.size(), cells.count()) +
                "<Points>\n" + detail::vtu_array("Points", 3, points) + "</Points>\n" + detail::vtu_cells(cells) +
                detail::vtu_fields(fields.at_nodes, "PointData", positions.size(), "nodes", dim) +
                detail::vtu_fields(at_elements, "CellData", elements, "elements", dim) +
                "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

/// Writes a mesh with its nodes at other positions.
/// \throws InputError also for another number of positions than nodes
template <class Element>
void write_vtu(std::filesystem::path const& path, Mesh<Element> const& mesh,
               std::vector<Vector<Element::dim>> const& positions, VtuFields const& fields = {}) {
  if (positions.size() != mesh.nodes.size()) {
    reject("{} positions are given (the mesh has {} nodes): give one for each", positions.size(), mesh.nodes.size());
  }
  write_vtu<Element::dim>(path, cells_of(mesh), positions, fields);
}

/// A time series of VTU files in one folder, listed in `<folder>/<name>.pvd`, which ParaView opens as one animation.
class PvdSeries {
 public:
  /// Time and file, relative to the folder.
  using Entry = std::pair<double, std::string>;

  /// folder: of the list and of the files; name: of the list, without its ending
  PvdSeries(std::filesystem::path folder, std::string name) : folder_(std::move(folder)), name_(std::move(name)) {}

  std::filesystem::path path() const { return folder_ / (name_ + ".pvd"); }  ///< File of the list.

  /// Times and files that are listed, in order of time.
  std::vector<Entry> const& entries() const { return entries_; }

  /// Lists one more file and rewrites the list as a whole, so that an interrupted run leaves a complete one.
  /// time: the load factor or what the pictures are ordered by, increasing; file: name relative to the folder
  /// \throws InputError for a time that is not above the last one, FileError when the list cannot be written
  void add(double time, std::filesystem::path const& file) {
    if (!std::isfinite(time) || (!entries_.empty() && !(time > entries_.back().first))) {
      reject("time {} of '{}' cannot be added (times must be finite and increase): order the files", time,
             file.string());
    }
    auto entries = entries_;  // those of before where the list cannot be written
    entries.emplace_back(time, file.generic_string());
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (auto const& [when, what] : entries) {
      text += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", when,
                          xml_text(valid_utf8(what)));
    }
    write_file(path(), text + "</Collection>\n</VTKFile>\n");
    entries_ = std::move(entries);
  }

  SCARP_MEMBERS_EXCEPT((folder_, name_), entries_)

 private:
  std::filesystem::path folder_;
  std::string name_;
  std::vector<Entry> entries_;
};

}  // namespace scarp
