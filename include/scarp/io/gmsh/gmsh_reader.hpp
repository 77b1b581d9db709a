// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>

#include "scarp/io/gmsh/detail/gmsh_assembly.hpp"
#include "scarp/io/gmsh/detail/gmsh_sections_22.hpp"
#include "scarp/io/gmsh/detail/gmsh_sections_41.hpp"
#include "scarp/io/read_file.hpp"

namespace scarp {

namespace detail {

/// $MeshFormat, which says how the rest is to be read.
/// \return whether the version is 4.1; it is 2.2 otherwise
inline bool read_gmsh_format(GmshStream& stream) {
  constexpr std::string_view other =
      "'{}' is a mesh of MSH {} (2.2 and 4.1 are read): save it in Gmsh with Mesh.MshFileVersion = 4.1";
  auto section = stream.next_section();
  while (section == "Comments") {
    stream.skip_section(section);
    section = stream.next_section();
  }
  if (section == "NOD") refuse(other, stream.file(), 1.0);
  if (section != "MeshFormat") {
    refuse("'{}' is no Gmsh mesh (it does not begin with $MeshFormat): export the mesh as MSH 4.1", stream.file());
  }
  double const version = stream.text<double>("the version of the format");
  if (version != 2.2 && version != 4.1) refuse(other, stream.file(), version);
  int const type = stream.text<int>("the type of the file");
  int const size = stream.text<int>("the size of a number");
  if ((type != 0 && type != 1) || size != 8) {
    refuse("'{}' has file type {} and numbers of {} bytes (0 or 1, and 8, are read): write it again", stream.file(),
           type, size);
  }
  if (type == 1) {
    stream.to_next_line();
    stream.be_binary(false);
    auto const one = stream.value<std::uint32_t>("the number one");
    constexpr std::uint32_t swapped = 1U << 24U;
    if (one != 1 && one != swapped) {
      refuse("{} has {:#x} where the number one should stand (it tells the order of bytes): write it again",
             stream.place(), one);
    }
    stream.be_binary(one == swapped);
  }
  stream.end_section(section);
  return version == 4.1;
}

/// bytes: of the file; file: its name in complaints
inline GmshContent read_gmsh_content(std::string bytes, std::string const& file) {
  GmshStream stream(std::move(bytes), file);
  GmshContent content{.file = file};
  bool const is_41 = read_gmsh_format(stream);
  GmshSections22 const sections_22;
  GmshSections41 sections_41;
  bool has_elements = false;
  for (auto name = stream.next_section(); !name.empty(); name = stream.next_section()) {
    if (name == "PhysicalNames") {
      read_gmsh_names(stream, content);
    } else if (name == "Entities" && is_41) {
      sections_41.read_entities(stream);
    } else if (name == "Nodes") {
      is_41 ? sections_41.read_nodes(stream, content) : sections_22.read_nodes(stream, content);
    } else if (name == "Elements") {
      is_41 ? sections_41.read_elements(stream, content) : sections_22.read_elements(stream, content);
      has_elements = true;
    } else {
      stream.skip_section(name);
      continue;
    }
    stream.end_section(name);
  }
  if (!has_elements) {
    refuse("'{}' has no section $Elements (it is cut off or holds a geometry only): mesh it and save it again",
           content.file);
  }
  return content;
}

}  // namespace detail

/// Reads a mesh of Gmsh: MSH 2.2 or 4.1, text or binary, of any order of bytes. Physical groups of the elements'
/// dimension become regions, those of one dimension less boundaries; without a name they are called
/// "physical_<tag>". Elements in no group form the region "mesh". Nodes and elements are numbered in the order of their
/// tags; nodes of no element, points and elements of lower dimension in no group are left out. Lengths in [m].
/// \throws InputError naming file and line, byte, node or element for what is no mesh of such elements, is damaged,
/// turned inside out, or in 2D not flat in z
template <HasGmshType Element>
Mesh<Element> read_gmsh(std::filesystem::path const& path) {
  return detail::assemble_gmsh<Element>(detail::read_gmsh_content(read_file(path), path.string()));
}

}  // namespace scarp
