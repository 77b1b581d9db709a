// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <utility>

#include "scarp/core/index.hpp"
#include "scarp/io/gmsh/detail/gmsh_content.hpp"

namespace scarp::detail {

/// $Nodes and $ParametricNodes of MSH 2 to 2.2. Gmsh 4.8 Reference Manual, section 9.3
inline void read_gmsh_nodes_2(GmshStream& stream, GmshContent& content, bool parametric) {
  std::size_t const nodes = stream.text_count("the number of nodes", 4);
  stream.to_next_line();
  for (std::size_t n = 0; n < nodes; ++n) {
    auto const tag = stream.value<std::int32_t>("the tag of a node");
    content.nodes.push_back({tag, read_gmsh_position(stream, tag)});
    if (!parametric) continue;
    auto const dim = stream.value<std::int32_t>("the dimension of an entity");
    stream.value<std::int32_t>("the tag of an entity");
    for (int p = 0; p < dim; ++p) stream.value<double>("a parameter of a node");
  }
}

inline std::size_t read_gmsh_count_2(GmshStream& stream, std::string_view what, std::size_t numbers) {
  auto const given = stream.value<std::int32_t>(what);
  if (given < 0) reject("{} has {} for {} (a count is not negative): write it again", stream.place(), given, what);
  return stream.checked_count(static_cast<std::uint64_t>(given), what, numbers);
}

/// $Elements of MSH 2 to 2.2: binary files give a header to several elements, text files the same numbers to each.
inline void read_gmsh_elements_2(GmshStream& stream, GmshContent& content) {
  std::size_t const elements = stream.text_count("the number of elements", 4);
  stream.to_next_line();
  std::size_t following = 1;
  for (std::size_t read = 0; read < elements; read += following) {
    std::int32_t tag = stream.binary() ? 0 : stream.value<std::int32_t>("the tag of an element");
    auto const& type = read_gmsh_type(stream);
    if (stream.binary()) following = read_gmsh_count_2(stream, "the number of elements of a type", index(type.nodes));
    auto const tags = read_gmsh_count_2(stream, "the number of tags of an element", 1);
    if (following == 0 || following > elements - read) {
      reject("{} has {} tags and announces {} elements ({} are missing in all): the file is damaged, write it again",
             stream.place(), tags, following, elements - read);
    }
    for (std::size_t k = 0; k < following; ++k) {
      if (stream.binary()) tag = stream.value<std::int32_t>("the tag of an element");
      GmshElement element{&type, tag};
      for (std::size_t t = 0; t < tags; ++t) {  // the first is that of the physical group, zero for none
        auto const number = stream.value<std::int32_t>("the physical group of an element");
        if (t == 0) add_group(element.groups, number);
      }
      element.nodes.resize(index(type.nodes));
      for (auto& node : element.nodes) node = stream.value<std::int32_t>("a node of an element");
      content.elements.push_back(std::move(element));
    }
  }
}

/// $Entities, $PartitionedEntities, $Nodes and $Elements of MSH 4.0 and 4.1. Gmsh 4.8 Reference Manual, sections 9.1
/// and 9.2
class GmshSections4 {
 public:
  explicit GmshSections4(bool is_40) : is_40_(is_40) {}

  /// partitioned: of a mesh that was shared out among processes, whose parts have the groups of what they are parts of
  void read_entities(GmshStream& stream, bool partitioned) {
    if (!entities_) entities_.emplace();
    if (partitioned) {
      stream.value<std::uint64_t>("the number of partitions");
      auto const ghosts = stream.count("the number of ghost entities", 2);
      for (std::size_t k = 0; k < 2 * ghosts; ++k) stream.value<std::int32_t>("a ghost entity or its partition");
    }
    std::array<std::size_t, 4> counts{};
    for (auto& entities : counts) entities = stream.count("the number of entities", 5);
    for (int dim = 0; dim < 4; ++dim) {
      for (std::size_t k = 0; k < counts[detail::index(dim)]; ++k) read_entity(stream, dim, partitioned);
    }
  }

  void read_nodes(GmshStream& stream, GmshContent& content) const {
    auto const [blocks, nodes] = read_totals(stream, "nodes");
    std::size_t const before = content.nodes.size();
    for (std::size_t k = 0; k < blocks; ++k) {
      auto const dim = read_entity_of_block(stream).first;
      bool const parametric = stream.value<std::int32_t>("whether nodes have parameters") != 0;
      auto const in_block = stream.count("the number of nodes of an entity", 4);
      std::size_t const first = content.nodes.size();
      auto const read_place = [&](GmshNode& node) {
        node.position = read_gmsh_position(stream, node.tag);
        for (int p = 0; parametric && p < dim; ++p) stream.value<double>("a parameter of a node");
      };
      for (std::size_t n = 0; n < in_block; ++n) {
        content.nodes.push_back({read_tag(stream, "the tag of a node"), {}});
        if (is_40_) read_place(content.nodes.back());
      }
      for (std::size_t n = first; !is_40_ && n < first + in_block; ++n) read_place(content.nodes[n]);
    }
    require_total(stream, "nodes", nodes, content.nodes.size() - before);
  }

  void read_elements(GmshStream& stream, GmshContent& content) const {
    auto const [blocks, elements] = read_totals(stream, "elements");
    std::size_t read = 0;
    for (std::size_t k = 0; k < blocks; ++k) {
      auto const place = read_entity_of_block(stream);
      int const dim = place.first;
      auto const entity = entity_of(stream, place);
      auto const& type = read_gmsh_type(stream);
      if (type.dim != dim) {
        reject("{} has elements of type {} ({}) on an entity of dimension {} (they have dimension {}): write it again",
               stream.place(), type.type, type.name, dim, type.dim);
      }
      auto const in_block = stream.count("the number of elements of an entity", index(type.nodes) + 1);
      for (std::size_t e = 0; e < in_block; ++e) {
        auto const tag = read_tag(stream, "the tag of an element");
        auto& element = content.elements.emplace_back(GmshElement{&type, tag, entity.groups, entity.turned});
        element.nodes.resize(index(type.nodes));
        for (auto& node : element.nodes) node = read_tag(stream, "a node of an element");
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

  std::int64_t read_tag(GmshStream& stream, std::string_view what) const {
    return is_40_ ? stream.value<std::int32_t>(what) : stream.value<std::int64_t>(what);
  }

  /// MSH 4.0 has the tag first.
  DimTag read_entity_of_block(GmshStream& stream) const {
    auto const first = stream.value<std::int32_t>("the entity of a block");
    auto const second = stream.value<std::int32_t>("the entity of a block");
    return is_40_ ? DimTag(second, first) : DimTag(first, second);
  }

  Totals read_totals(GmshStream& stream, std::string_view what) const {
    Totals totals{};
    totals.blocks = stream.count(fmt::format("the number of blocks of {}", what), 4);
    totals.entries = stream.count(fmt::format("the number of {}", what), 2);
    if (!is_40_) {
      stream.value<std::uint64_t>("the smallest tag");
      stream.value<std::uint64_t>("the largest tag");
    }
    return totals;
  }

  static void require_total(GmshStream const& stream, std::string_view what, std::size_t announced, std::size_t read) {
    if (announced == read) return;
    reject("the section that ends at {} holds {} {} (it announces {}): the file is damaged, write it again",
           stream.place(), read, what, announced);
  }

  void read_entity(GmshStream& stream, int dim, bool partitioned) {
    int const tag = stream.value<std::int32_t>("the tag of an entity");
    int parent = dim;
    if (partitioned) {
      parent = stream.value<std::int32_t>("the dimension of the entity that is partitioned");
      stream.value<std::int32_t>("the tag of the entity that is partitioned");
      auto const partitions = stream.count("the number of partitions of an entity", 1);
      for (std::size_t k = 0; k < partitions; ++k) stream.value<std::int32_t>("a partition of an entity");
    }
    int const extents = dim == 0 && !is_40_ ? 3 : 6;  // a point, or the corners of a box
    for (int k = 0; k < extents; ++k) stream.value<double>("a coordinate of an entity");
    auto& entity = (*entities_)[{dim, tag}];
    auto const in_groups = stream.count("the number of physical groups of an entity", 1);
    for (std::size_t k = 0; k < in_groups; ++k) {
      auto const group = stream.value<std::int32_t>("the tag of a physical group");
      if (parent == dim) add_group(entity.groups, group);  // between partitions lie curves with the groups of a surface
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
      reject(
          "{} names entity {} of dimension {} (it is listed neither in $Entities nor in $PartitionedEntities): write "
          "it "
          "again, as one file and not by partitions",
          stream.place(), entity.second, entity.first);
    }
    return found->second;
  }

  bool is_40_;
  std::optional<std::map<DimTag, Entity>> entities_{};  ///< none in files without $Entities
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
  GmshSections4 sections_4(version == 4.0);
  content.lists_copies = !is_4;
  bool has_elements = false;
  for (auto name = stream.next_section(); !name.empty(); name = stream.next_section()) {
    if (name == "PhysicalNames") {
      read_gmsh_names(stream, content);
    } else if ((name == "Entities" || name == "PartitionedEntities") && is_4) {
      sections_4.read_entities(stream, name != "Entities");
    } else if (name == "Nodes" || name == "ParametricNodes") {
      is_4 ? sections_4.read_nodes(stream, content) : read_gmsh_nodes_2(stream, content, name != "Nodes");
    } else if (name == "Elements") {
      is_4 ? sections_4.read_elements(stream, content) : read_gmsh_elements_2(stream, content);
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
