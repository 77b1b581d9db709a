// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <utility>

#include "scarp/core/index.hpp"
#include "scarp/io/gmsh/detail/gmsh_content.hpp"

namespace scarp::detail {

/// $Nodes and $Elements of MSH 2.2. Gmsh 4.8 Reference Manual, section 9.3.1
class GmshSections22 {
 public:
  void read_nodes(GmshStream& stream, GmshContent& content) const {
    std::size_t const nodes = stream.text_count("the number of nodes", 4);
    stream.to_next_line();
    content.nodes.reserve(content.nodes.size() + nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
      auto const tag = stream.value<std::int32_t>("the tag of a node");
      content.nodes.push_back({tag, read_gmsh_position(stream, tag)});
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

/// $Entities, $Nodes and $Elements of MSH 4.1. Gmsh 4.8 Reference Manual, section 9.1
class GmshSections41 {
 public:
  void read_entities(GmshStream& stream) {
    entities_.emplace();
    std::array<std::size_t, 4> counts{};
    for (auto& entities : counts) entities = stream.count("the number of entities", 5);
    for (int dim = 0; dim < 4; ++dim) {
      for (std::size_t k = 0; k < counts[detail::index(dim)]; ++k) read_entity(stream, dim);
    }
  }

  void read_nodes(GmshStream& stream, GmshContent& content) const {
    auto const [blocks, nodes] = read_totals(stream, "nodes");
    std::size_t const before = content.nodes.size();
    for (std::size_t k = 0; k < blocks; ++k) {
      auto const dim = stream.value<std::int32_t>("the dimension of an entity");
      stream.value<std::int32_t>("the tag of an entity");
      bool const parametric = stream.value<std::int32_t>("whether nodes have parameters") != 0;
      int const parameters = parametric ? dim : 0;
      auto const in_block = stream.count("the number of nodes of an entity", 4);
      std::size_t const first = content.nodes.size();
      for (std::size_t n = 0; n < in_block; ++n) {
        content.nodes.push_back({stream.value<std::int64_t>("the tag of a node"), {}});
      }
      for (std::size_t n = first; n < first + in_block; ++n) {
        content.nodes[n].position = read_gmsh_position(stream, content.nodes[n].tag);
        for (int p = 0; p < parameters; ++p) stream.value<double>("a parameter of a node");
      }
    }
    require_total(stream, "nodes", nodes, content.nodes.size() - before);
  }

  void read_elements(GmshStream& stream, GmshContent& content) const {
    auto const [blocks, elements] = read_totals(stream, "elements");
    std::size_t read = 0;
    for (std::size_t k = 0; k < blocks; ++k) {
      auto const dim = stream.value<std::int32_t>("the dimension of an entity");
      auto const tag = stream.value<std::int32_t>("the tag of an entity");
      auto entity = entity_of(stream, {dim, tag});
      auto const type = known_gmsh_type(stream, stream.value<std::int32_t>("the type of elements"));
      if (type.dim != dim) {
        reject("{} has elements of type {} ({}) on an entity of dimension {} (they have dimension {}): write it again",
               stream.place(), type.type, type.name, dim, type.dim);
      }
      auto const in_block =
          stream.count("the number of elements of an entity", static_cast<std::size_t>(type.nodes) + 1);
      content.blocks.push_back({type, std::move(entity.groups), entity.turned});
      auto& block = content.blocks.back();
      for (std::size_t e = 0; e < in_block; ++e) {
        block.tags.push_back(stream.value<std::int64_t>("the tag of an element"));
        for (int a = 0; a < type.nodes; ++a) {
          block.nodes.push_back(stream.value<std::int64_t>("a node of an element"));
        }
      }
      read += in_block;
    }
    require_total(stream, "elements", elements, read);
  }

 private:
  struct Entity {
    std::vector<int> groups{};
    bool turned = false;
  };
  struct Totals {
    std::size_t blocks;
    std::size_t entries;
  };

  static Totals read_totals(GmshStream& stream, std::string_view what) {
    Totals totals{};
    totals.blocks = stream.count(fmt::format("the number of blocks of {}", what), 4);
    totals.entries = stream.count(fmt::format("the number of {}", what), 2);
    stream.value<std::uint64_t>("the smallest tag");
    stream.value<std::uint64_t>("the largest tag");
    return totals;
  }

  static void require_total(GmshStream const& stream, std::string_view what, std::size_t announced, std::size_t read) {
    if (announced == read) return;
    reject("the section that ends at {} holds {} {} (it announces {}): the file is damaged, write it again",
           stream.place(), read, what, announced);
  }

  void read_entity(GmshStream& stream, int dim) {
    int const tag = stream.value<std::int32_t>("the tag of an entity");
    int const extents = dim == 0 ? 3 : 6;  // a point, or the corners of a box
    for (int k = 0; k < extents; ++k) stream.value<double>("a coordinate of an entity");
    auto& entity = (*entities_)[{dim, tag}];
    auto const in_groups = stream.count("the number of physical groups of an entity", 1);
    for (std::size_t k = 0; k < in_groups; ++k) {
      auto const group = stream.value<std::int32_t>("the tag of a physical group");
      add_group(entity.groups, group);
      // MSH 2.2 has the elements of a group with negative entities turned already.
      if (k == 0) entity.turned = group < 0;
    }
    if (dim == 0) return;
    auto const sides = stream.count("the number of sides of an entity", 1);
    for (std::size_t k = 0; k < sides; ++k) stream.value<std::int32_t>("the tag of a side of an entity");
  }

  Entity entity_of(GmshStream const& stream, DimTag entity) const {
    if (!entities_) return {};
    auto const found = entities_->find(entity);
    if (found == entities_->end()) {
      reject("{} names entity {} of dimension {} (it is not listed in $Entities): write it again, not partitioned",
             stream.place(), entity.second, entity.first);
    }
    return found->second;
  }

  std::optional<std::map<DimTag, Entity>> entities_{};  ///< none in files without $Entities
};

/// $MeshFormat, which gives the format of all that follows.
/// \return whether the version is 4.1; it is 2.2 otherwise
inline bool read_gmsh_format(GmshStream& stream) {
  constexpr std::string_view other =
      "'{}' is a mesh of MSH {} (2.2 and 4.1 are read): save it in Gmsh with Mesh.MshFileVersion = 4.1";
  auto section = stream.next_section();
  while (section == "Comments") {
    stream.skip_section(section);
    section = stream.next_section();
  }
  if (section == "NOD") reject(other, stream.file(), 1.0);
  if (section != "MeshFormat") {
    reject("'{}' is no Gmsh mesh (it does not begin with $MeshFormat): export the mesh as MSH 4.1", stream.file());
  }
  double const version = stream.text<double>("the version of the format");
  if (version != 2.2 && version != 4.1) reject(other, stream.file(), version);
  int const type = stream.text<int>("the type of the file");
  int const size = stream.text<int>("the size of a number");
  if ((type != 0 && type != 1) || size != 8) {
    reject("'{}' has file type {} and numbers of {} bytes (0 or 1, and 8, are read): write it again", stream.file(),
           type, size);
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
  return version == 4.1;
}

/// bytes: of the file; file: its name in messages
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
