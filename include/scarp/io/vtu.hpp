// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <variant>

#include "scarp/io/atomic_file.hpp"
#include "scarp/io/detail/base64.hpp"
#include "scarp/io/detail/xml_text.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// A named quantity at all nodes or all elements, numbers flat and component running fastest.
/// A vector (dim components) is written with three and a tensor (dim * dim, row by row) with nine, the added ones
/// zero, as VTK wants them; other counts, such as a Voigt stress, and fields with named components are written as they are.
struct VtuField {
  std::string name;
  int components = 1;
  std::variant<std::span<double const>, std::span<int const>> values;
  std::vector<std::string> component_names{};  ///< empty or one for each component, such as xx, yy, xy
};

struct VtuFields {
  std::vector<VtuField> at_nodes{};
  std::vector<VtuField> at_elements{};
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
          refuse("field '{}' has {} numbers (there are {} {} with {} components): size it accordingly", field.name,
                 values.size(), entries, place, field.components);
        }
        if (!field.component_names.empty() && count(field.component_names) != field.components) {
          refuse("field '{}' has {} component names (it has {} components): name each or none", field.name,
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

inline std::string vtu_fields(std::vector<VtuField> const& fields, std::string_view tag, std::size_t entries,
                              std::string_view place, int dim) {
  std::string text = fmt::format("<{}>\n", tag);
  for (auto const& field : fields) {
    text += vtu_field(field, entries, place, dim);
  }
  return text + fmt::format("</{}>\n", tag);
}

template <class Element>
std::string vtu_cells(Mesh<Element> const& mesh) {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int32_t> offsets;
  for (auto const& element : mesh.elements) {
    connectivity.insert(connectivity.end(), element.begin(), element.end());
    offsets.push_back(count(connectivity));
  }
  std::vector<std::uint8_t> const types(mesh.elements.size(), static_cast<std::uint8_t>(Element::vtk_cell_type));
  return "<Cells>\n" + vtu_array("connectivity", 1, connectivity) + vtu_array("offsets", 1, offsets) +
         vtu_array("types", 1, types) + "</Cells>\n";
}

}  // namespace detail

/// Writes an unstructured grid for ParaView and the like: XML with inline base64 binary, in full precision.
/// positions [m]: of the nodes, such as the deformed ones, shape (nodes of the mesh). The region of every element is
/// added as the cell field "region".
/// \throws InputError for fields or positions of the wrong length
/// \throws FileError when the file cannot be written; an older file of this name is then untouched
template <class Element>
void write_vtu(std::filesystem::path const& path, Mesh<Element> const& mesh,
               std::vector<Vector<Element::dim>> const& positions, VtuFields const& fields = {}) {
  constexpr int dim = Element::dim;
  constexpr bool little = std::endian::native == std::endian::little;
  if (positions.size() != mesh.nodes.size()) {
    refuse("{} positions are given (the mesh has {} nodes): give one for each", positions.size(), mesh.nodes.size());
  }
  std::vector<double> flat;
  for (auto const& position : positions) {
    flat.insert(flat.end(), position.begin(), position.end());
  }
  auto at_elements = fields.at_elements;
  at_elements.push_back({"region", 1, std::span<int const>(mesh.element_region), {}});
  auto const points = detail::vtk_padded<double>(flat, 1, dim, 1, 3);
  write_file(
      path, fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
                        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" "
                        "NumberOfCells=\"{}\">\n",
                        little ? "LittleEndian" : "BigEndian", mesh.nodes.size(), mesh.elements.size()) +
                "<Points>\n" + detail::vtu_array("Points", 3, points) + "</Points>\n" + detail::vtu_cells(mesh) +
                detail::vtu_fields(fields.at_nodes, "PointData", mesh.nodes.size(), "nodes", dim) +
                detail::vtu_fields(at_elements, "CellData", mesh.elements.size(), "elements", dim) +
                "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace scarp
