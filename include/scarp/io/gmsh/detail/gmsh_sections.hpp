// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/io/gmsh/detail/gmsh_sections_2.hpp"
#include "scarp/io/gmsh/detail/gmsh_sections_4.hpp"

namespace scarp::detail {

/// $MeshFormat, which gives the format of all that follows.
/// \return the version: 2 to 2.2, 4.0 or 4.1
inline double read_gmsh_format(GmshStream& stream) {
  auto const section = stream.next_section();
  if (section != "MeshFormat") {
    reject(
        "'{}' is no mesh of MSH 2 or 4 (it does not begin with $MeshFormat): save it by `gmsh FILE -save -format "
        "msh41`",
        stream.file());
  }
  double const version = stream.text<double>("the version of the format");
  if (!(version >= 2.0 && version <= 2.2) && version != 4.0 && version != 4.1) {
    reject("'{}' is a mesh of MSH {} (2 to 2.2, 4.0 and 4.1 are read): save it by `gmsh FILE -save -format msh41`",
           stream.file(), version);
  }
  int const type = stream.text<int>("the type of the file");
  int const size = stream.text<int>("the size of a number");
  if ((type != 0 && type != 1) || (type == 1 && size != 8)) {
    reject("'{}' has file type {} and numbers of {} bytes (text is 0, binary is 1 with 8 bytes): write it again",
           stream.file(), type, size);
  }
  if (type == 1) {
    stream.to_next_line();
    stream.be_binary(false);
    auto const one = stream.value<std::uint32_t>("the number one");
    constexpr std::uint32_t swapped = 1U << 24U;
    if (one != 1 && one != swapped) {
      reject("{} has {:#x} where the number one is expected (it gives the order of bytes): write it again",
             stream.place(), one);
    }
    stream.be_binary(one == swapped);
  }
  stream.end_section(section);
  return version;
}

/// bytes: of the file; file: its name in messages
inline GmshContent read_gmsh_content(std::string bytes, std::string const& file) {
  GmshStream stream(std::move(bytes), file);
  GmshContent content{.file = file};
  double const version = read_gmsh_format(stream);
  bool const is_4 = version >= 4.0;
  GmshSections2 const sections_2;
  GmshSections4 sections_4(version == 4.0);
  content.lists_copies = !is_4;
  bool has_elements = false;
  for (auto name = stream.next_section(); !name.empty(); name = stream.next_section()) {
    if (name == "PhysicalNames") {
      read_gmsh_names(stream, content);
    } else if ((name == "Entities" || name == "PartitionedEntities") && is_4) {
      sections_4.read_entities(stream, name != "Entities");
    } else if (name == "Nodes" || name == "ParametricNodes") {
      is_4 ? sections_4.read_nodes(stream, content) : sections_2.read_nodes(stream, content, name != "Nodes");
    } else if (name == "Elements") {
      is_4 ? sections_4.read_elements(stream, content) : sections_2.read_elements(stream, content);
      has_elements = true;
    } else if (name == "ElementData" && stream.mentions("\"gmsh:physical\"")) {
      read_gmsh_group_data(stream, content);
    } else {
      stream.skip_section(name);
      if (name != "Comments") content.skipped.push_back(name);
      continue;
    }
    stream.end_section(name);
  }
  if (!has_elements) {
    reject("'{}' has no section $Elements (it is cut off or holds a geometry only): mesh it and save it again",
           content.file);
  }
  return content;
}

}  // namespace scarp::detail
