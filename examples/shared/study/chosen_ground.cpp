// SPDX-License-Identifier: BSL-1.0
#include "chosen_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "../print.hpp"
#include "scarp/fault/mesh_file_ground.hpp"

namespace fault_rupture {

template <class E>
scarp::Mesh<E> ChosenGround<E>::mesh(std::vector<double> const& edges) const {
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

constexpr double largest_size = 5.0;  ///< [m], far from the strip

/// Cells whose elements have the size itself after whole bisections.
void make_coarse(scarp::FaultMesh& layer, double size) {
  while (size * std::numbers::sqrt2 <= largest_size) size *= std::numbers::sqrt2;
  bool const diagonals = layer.pattern == scarp::Pattern::left || layer.pattern == scarp::Pattern::right;
  layer.size = is_triangle ? (diagonals ? size / std::numbers::sqrt2 : size) : 2.0 * size;
  layer.coarsening = 1.0;
}

}  // namespace

template <class E>
void choose_strip(Choice& choice) {
  constexpr double shortest = 0.25;  // [m], some hundred thousand triangles
  // Quadratic elements may be larger (docs/error-against-time.md).
  constexpr double share = E::nodes == 6 ? 0.71 : E::nodes == 8 ? 0.58 : 0.41;
  auto const size = std::stod(fmt::format("{:.3g}", share * choice.length));  // as it may be given
  if (!(choice.length > 0.0 && size < Choice{}.size)) return;
  if (choice.length < shortest) {
    scarp::reject(
        "--length is {} m (from {} m on the mesh is made for it): choose a longer one, or give --size for a uniform "
        "mesh",
        choice.length, shortest);
  }
  choice.size = size;
  if (choice.strip_width == 0.0) choice.strip_width = 2.0 + 2.0 * choice.length;
}

template <class E>
ChosenGround<E> ground_of(Choice const& choice) {
  if (!choice.mesh.empty()) {
    std::vector<std::string> notes;
    auto ground = scarp::ground_from_file<E>(choice.mesh, &notes, choice.mesh_order);
    examples::print_notes(notes);
    return {.given = std::move(ground.given)};
  }
  auto const pattern = choice.pattern.value_or(is_triangle ? MeshPattern::crossed : MeshPattern::quads);
  scarp::FaultMesh layer{.tip = choice.tip, .size = choice.size, .row_aspect = choice.aspect};
  layer.band_left += choice.tip;
  layer.band_right += choice.tip;
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
  if (choice.strained.empty()) return {.layer = layer};
  make_coarse(layer, choice.size);
  return {.layer = layer,
          .strip = scarp::PilotSize{.strained = choice.strained,
                                    .margin = choice.strip_width / 2.0,
                                    .fine = choice.size,
                                    .coarse = std::max(choice.size, largest_size),
                                    .transition = 8.0}};
}

template struct ChosenGround<Element>;
template void choose_strip<Element>(Choice&);
template ChosenGround<Element> ground_of(Choice const&);

}  // namespace fault_rupture
