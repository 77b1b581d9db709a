// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <utility>

#include "scarp/core/index.hpp"
#include "scarp/io/gmsh/detail/gmsh_content.hpp"

namespace scarp::detail {

/// $Entities, $PartitionedEntities, $Nodes and $Elements of MSH 4.0 and 4.1. Gmsh 4.8 Reference Manual, sections 9.1 and 9.2
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
      auto entity = entity_of(stream, place);
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
        block.tags.push_back(read_tag(stream, "the tag of an element"));
        for (int a = 0; a < type.nodes; ++a) {
          block.nodes.push_back(read_tag(stream, "a node of an element"));
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

}  // namespace scarp::detail
