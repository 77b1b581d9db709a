// SPDX-License-Identifier: BSL-1.0
#include "chosen_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "scarp/fault/mesh_file_ground.hpp"

namespace fault_rupture {

template <class E>
scarp::Mesh<E> ChosenGround<E>::mesh(std::vector<double> const& edges) const {
  if (given && strip) return scarp::RefinedGround{scarp::MeshFileGround<E>{*given}, *strip}.mesh(edges);
  if (given) return scarp::MeshFileGround<E>{*given}.mesh(edges);
  if (strip) return scarp::RefinedGround{scarp::StructuredGround<E>{layer}, *strip}.mesh(edges);
  return layer.generate<E>(edges);
}

template <class E>
double ChosenGround<E>::surface_level() const {
  return given ? scarp::surface_level(*given) : layer.depth;
}

template <class E>
double ChosenGround<E>::depth() const {
  return given ? scarp::surface_level(*given) - scarp::bottom_level(*given) : layer.depth;
}

namespace {

constexpr double largest_size = 5.0;  ///< [m], far from the strip, in the reference study's ground

/// Cells whose elements have the size itself after whole bisections.
void make_coarse(scarp::FaultMesh& layer, double size, double largest) {
  while (size * std::numbers::sqrt2 <= largest) size *= std::numbers::sqrt2;
  bool const diagonals = layer.pattern == scarp::Pattern::left || layer.pattern == scarp::Pattern::right;
  layer.size = is_triangle ? (diagonals ? size / std::numbers::sqrt2 : size) : 2.0 * size;
  layer.coarsening = 1.0;
}

/// The median of the elements whose centre is within an eighth of the depth of the fault's own line, as a size of cells
/// [m].
template <class E>
double size_along_fault(ChosenGround<E> const& ground, ChosenFault const& fault) {
  constexpr auto corners = static_cast<std::size_t>(scarp::LinearOf<E>::nodes);
  auto const& mesh = *ground.given;
  scarp::Vector<2> const tip(fault.tip, scarp::bottom_level(mesh));
  scarp::Vector<2> const across(std::sin(fault.dip), std::cos(fault.dip));
  std::vector<double> areas;
  double least = std::numeric_limits<double>::infinity();
  for (auto const& nodes : mesh.elements) {
    scarp::Vector<2> centre = scarp::Vector<2>::Zero();
    double area = 0.0;
    for (std::size_t k = 0; k < corners; ++k) {
      scarp::Vector<2> const from = mesh.nodes[static_cast<std::size_t>(nodes[k])] - tip;
      scarp::Vector<2> const to = mesh.nodes[static_cast<std::size_t>(nodes[(k + 1) % corners])] - tip;
      centre += from / corners;
      area += 0.5 * (from.x() * to.y() - to.x() * from.y());
    }
    least = std::min(least, area);
    if (std::abs(centre.dot(across)) <= ground.depth() / 8.0) areas.push_back(area);
  }
  auto const middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  if (!areas.empty()) std::ranges::nth_element(areas, middle);
  return std::sqrt((is_triangle ? 4.0 : 1.0) * (areas.empty() ? least : *middle));
}

}  // namespace

template <class E>
void measure_mesh(Choice& choice, std::vector<std::string>& notes) {
  ChosenGround<E> ground;
  ground.given = scarp::ground_from_file<E>(choice.mesh, &notes, choice.mesh_order).given;
  auto const [left, right] = std::ranges::minmax(ground.given->nodes, {}, [](auto const& node) { return node.x(); });
  choice.depth = ground.depth();
  constexpr double least = 0.1, most = 1000.0;  // [m], as of --depth
  if (!(choice.depth >= least && choice.depth <= most))
    scarp::reject("the ground of '{}' is {:.4g} m deep (from {} m to {} m are expected): give lengths in metres",
                  choice.mesh, choice.depth, least, most);
  choice.left = left.x();
  choice.width = right.x() - left.x();
  choice.mesh_size = size_along_fault(ground, fault_of(choice));
}

template <class E>
double size_for(double length) {
  // Quadratic elements may be larger (docs/error-against-time.md).
  constexpr double share = E::nodes == 6 ? 0.71 : E::nodes == 8 ? 0.58 : 0.41;
  return std::stod(fmt::format("{:.3g}", share * length));  // as it may be given
}

template <class E>
void choose_strip(Choice& choice) {
  double const usual_size = choice.mesh.empty() ? Choice{}.size * choice.scale() : choice.mesh_size;
  double const shortest = 0.01 * choice.depth;  // some hundred thousand triangles
  auto const size = size_for<E>(choice.length);
  if (!(choice.length > 0.0 && size < usual_size)) return;
  if (choice.length < shortest) {
    scarp::reject(
        "--length is {} m (from {} m on, a hundredth of the depth, the mesh is made for it): choose a longer one, or "
        "give "
        "--size for a uniform mesh",
        choice.length, shortest);
  }
  choice.size = size;
  if (choice.strip_width == 0.0) choice.strip_width = 2.0 * choice.scale() + 2.0 * choice.length;
}

template <class E>
ChosenGround<E> ground_of(Choice const& choice) {
  double const scale = choice.scale();
  std::optional<PilotSize> strip;
  if (!choice.strained.empty())
    strip = {.strained = choice.strained,
             .margin = choice.strip_width / 2.0,
             .fine = choice.size,
             .coarse = std::max(choice.size, scale * largest_size),
             .transition = scale * 8.0};
  if (!choice.mesh.empty())
    return {.strip = std::move(strip),
            .given = scarp::ground_from_file<E>(choice.mesh, nullptr, choice.mesh_order).given};
  auto const pattern = choice.pattern.value_or(is_triangle ? MeshPattern::crossed : MeshPattern::quads);
  scarp::FaultMesh layer{.left = choice.left,
                         .right = choice.left + choice.width,
                         .depth = choice.depth,
                         .tip = choice.tip,
                         .size = choice.size,
                         .row_aspect = choice.aspect};
  layer.band_left = choice.tip + scale * layer.band_left;
  layer.band_right = choice.tip + scale * layer.band_right;
  switch (pattern) {
    case MeshPattern::left: layer.pattern = scarp::Pattern::left; break;
    case MeshPattern::right: layer.pattern = scarp::Pattern::right; break;
    case MeshPattern::quads: layer.pattern = scarp::Pattern::quads; break;
    case MeshPattern::crossed: layer.pattern = scarp::Pattern::crossed; break;
    case MeshPattern::jittered:
      layer.pattern = is_triangle ? scarp::Pattern::crossed : scarp::Pattern::quads;
      layer.jitter = 0.25;
      layer.seed = choice.mesh_seed;
      break;
  }
  if (choice.elements > 0) layer = layer.with_about<E>(choice.elements);
  if (strip) make_coarse(layer, choice.size, scale * largest_size);
  return {.layer = layer, .strip = std::move(strip)};
}

template struct ChosenGround<Element>;
template void measure_mesh<Element>(Choice&, std::vector<std::string>&);
template double size_for<Element>(double);
template void choose_strip<Element>(Choice&);
template ChosenGround<Element> ground_of(Choice const&);

}  // namespace fault_rupture
