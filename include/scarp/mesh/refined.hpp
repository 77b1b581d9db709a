// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <numbers>

#include "scarp/core/error.hpp"
#include "scarp/mesh/detail/quadrilaterals.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"

namespace scarp {

/// Wanted size of the elements at a place of the plane [m]: longest side of triangles, side of quadrilaterals.
template <class F>
concept SizeField = requires(F const& field, Vector<2> const& place) {
  { field.size(place) } -> std::convertible_to<double>;
};

namespace detail {

/// Triangles have their longest side as base, the halves of quadrilaterals their common diagonal, the longer one.
template <class Linear>
Bisection bisection_of(Mesh<Linear> const& mesh) {
  Bisection bisection(mesh.nodes);
  auto const length = [&](int a, int b) { return (mesh.nodes[index(a)] - mesh.nodes[index(b)]).norm(); };
  for (int e = 0; e < count(mesh.elements); ++e) {
    auto ring = mesh.elements[index(e)];
    if constexpr (Linear::nodes == 4) {
      if (length(ring[1], ring[3]) > length(ring[0], ring[2])) std::rotate(ring.begin(), ring.begin() + 1, ring.end());
      bisection.triangles.push_back({{ring[2], ring[0], ring[1]}, e});
      bisection.triangles.push_back({{ring[0], ring[2], ring[3]}, e});
    } else {
      auto longest = ring;
      for (int turn = 0; turn < 2; ++turn) {
        std::rotate(ring.begin(), ring.begin() + 1, ring.end());
        if (length(ring[0], ring[1]) > length(longest[0], longest[1])) longest = ring;
      }
      bisection.triangles.push_back({longest, e});
    }
  }
  return bisection;
}

/// Longest side of an element over its size.
template <SizeField Field, std::size_t Corners>
double excess(Field const& field, std::vector<Vector<2>> const& nodes, std::array<int, Corners> const& ring) {
  double longest = 0.0;
  for (std::size_t k = 0; k < Corners; ++k) {
    longest = std::max(longest, (nodes[index(ring[k])] - nodes[index(ring[(k + 1) % Corners])]).norm());
  }
  Vector<2> const centre = centre_of(nodes, ring);
  double const size = field.size(centre);
  if (!(std::isfinite(size) && size > 0.0)) {
    reject("the element size at ({}) is {} m (a finite size above 0 is expected): correct the size field",
           listed(centre), size);
  }
  return longest / size;
}

}  // namespace detail

/// The mesh with elements as small as a field wants. Nodes of the mesh, regions and boundaries stay, no node hangs,
/// sides are straight; the same mesh and field give the same bits.
/// Triangles are bisected where the field wants it at their centre: they come out with a longest side of at most 1.19
/// sizes there and at least half of the mesh's least angle. Quadrilaterals are divided into triangles first; then these
/// become quadrilaterals, sides mostly at most 1.19 sizes where the size is even, 1.7 at most where a triangle has no
/// partner or cells are distorted, and about 2 where the size changes. All of these are divided at least into four, so
/// start from a mesh twice as coarse.
/// A mesh that is fine enough everywhere is returned as it is.
/// \throws InputError for an invalid mesh, a size that is not finite and positive, and more than ten million elements
template <CheckedElement Element, SizeField Field>
  requires(Element::dim == 2)
Mesh<Element> refined(Mesh<Element> const& mesh, Field const& field) {
  using Linear = LinearOf<Element>;
  constexpr bool is_triangle = Linear::nodes == 3;
  static_assert(is_triangle || Linear::nodes == 4, "triangles or quadrilaterals can be refined");
  validate(mesh);
  auto const coarse = corner_mesh(mesh);
  auto const is_coarse = [&](auto const& ring) {
    return detail::excess(field, coarse.nodes, ring) > detail::Bisection::half_a_bisection;
  };
  if (std::none_of(coarse.elements.begin(), coarse.elements.end(), is_coarse)) return mesh;
  auto bisection = detail::bisection_of(coarse);
  constexpr double share = is_triangle ? 1.0 : 0.25 * std::numbers::sqrt2;  // side of a quarter over a diagonal
  bisection.refine([&](auto const& ring) { return share * detail::excess(field, bisection.nodes, ring); });
  auto const region_of = [&](int origin) { return coarse.element_region[detail::index(origin)]; };
  Mesh<Linear> fine{{}, {}, {}, coarse.regions, {}};
  std::vector<std::array<int, 2>> all;
  for (auto const& [name, sides] : coarse.boundaries) {
    auto& parts = fine.boundaries[name];
    for (auto const& side : sides) bisection.append(side, parts);
    all.insert(all.end(), parts.begin(), parts.end());
  }
  if constexpr (is_triangle) {
    for (auto const& triangle : bisection.triangles) {
      fine.elements.push_back(triangle.nodes);
      fine.element_region.push_back(region_of(triangle.origin));
    }
    fine.nodes = std::move(bisection.nodes);
  } else {
    detail::Quadrilaterals made(bisection, region_of, all);
    for (auto& [name, sides] : fine.boundaries) {
      std::vector<std::array<int, 2>> halves;
      for (auto const& [a, b] : sides) {
        halves.push_back({a, made.middle(a, b)});
        halves.push_back({made.middle(a, b), b});
      }
      sides = std::move(halves);
    }
    fine.elements = std::move(made.elements);
    for (int const origin : made.origins) fine.element_region.push_back(region_of(origin));
    fine.nodes = std::move(made.nodes);
  }
  return with_nodes_of<Element>(std::move(fine));
}

}  // namespace scarp
