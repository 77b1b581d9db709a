// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/io/gmsh/detail/gmsh_sections_4.hpp"

namespace scarp::detail {

/// $Nodes, $ParametricNodes and $Elements of MSH 2 to 2.2. Gmsh 4.8 Reference Manual, section 9.3
class GmshSections2 {
 public:
  void read_nodes(GmshStream& stream, GmshContent& content, bool parametric) const {
    std::size_t const nodes = stream.text_count("the number of nodes", 4);
    stream.to_next_line();
    content.nodes.reserve(content.nodes.size() + nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
      auto const tag = stream.value<std::int32_t>("the tag of a node");
      content.nodes.push_back({tag, read_gmsh_position(stream, tag)});
      if (!parametric) continue;
      auto const dim = stream.value<std::int32_t>("the dimension of an entity");
      stream.value<std::int32_t>("the tag of an entity");
      for (int p = 0; p < dim; ++p) stream.value<double>("a parameter of a node");
    }
  }

  /// Binary files give a header to several elements, text files the same numbers to each.
  void read_elements(GmshStream& stream, GmshContent& content) const {
    std::size_t const elements = stream.text_count("the number of elements", 4);
    stream.to_next_line();
    for (std::size_t read = 0; read < elements;) {
      Header header;
      std::int32_t tag = 0;
      std::size_t following = 1;
      if (stream.binary()) {
        header.type = stream.value<std::int32_t>("the type of elements");
        auto const type = known_gmsh_type(stream, header.type);
        following = entries(stream, "the number of elements of a type", static_cast<std::size_t>(type.nodes));
        header.tags = entries(stream, "the number of tags of an element", 1);
        if (following == 0 || following > elements - read) {
          reject(
              "{} has {} tags and announces {} elements ({} are missing in all): the file is damaged, write it again",
              stream.place(), header.tags, following, elements - read);
        }
      } else {
        tag = stream.value<std::int32_t>("the tag of an element");
        header.type = stream.value<std::int32_t>("the type of an element");
        known_gmsh_type(stream, header.type);
        header.tags = entries(stream, "the number of tags of an element", 1);
      }
      for (std::size_t k = 0; k < following; ++k) {
        if (stream.binary()) tag = stream.value<std::int32_t>("the tag of an element");
        read_element(stream, content, header, tag);
      }
      read += following;
    }
  }

 private:
  struct Header {
    int type = 0;
    std::size_t tags = 0;  ///< the first is that of the physical group, zero for none
  };

  static std::size_t entries(GmshStream& stream, std::string_view what, std::size_t numbers) {
    auto const given = stream.value<std::int32_t>(what);
    if (given < 0) reject("{} has {} for {} (a count is not negative): write it again", stream.place(), given, what);
    return stream.checked_count(static_cast<std::uint64_t>(given), what, numbers);
  }

  static void read_element(GmshStream& stream, GmshContent& content, Header const& header, std::int64_t tag) {
    std::vector<int> groups;
    for (std::size_t k = 0; k < header.tags; ++k) {
      auto const number = stream.value<std::int32_t>("the physical group of an element");
      if (k == 0) add_group(groups, number);
    }
    auto& blocks = content.blocks;
    if (blocks.empty() || blocks.back().type.type != header.type || blocks.back().groups != groups) {
      blocks.push_back({known_gmsh_type(stream, header.type), std::move(groups)});
    }
    auto& block = blocks.back();
    block.tags.push_back(tag);
    for (int a = 0; a < block.type.nodes; ++a) {
      block.nodes.push_back(stream.value<std::int32_t>("a node of an element"));
    }
  }
};

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
