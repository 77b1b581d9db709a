// SPDX-License-Identifier: BSL-1.0
#include "chosen_ground.hpp"

#include "../tell.hpp"
#include "scarp/fault/given_ground.hpp"

namespace fault_rupture {

template <class E>
scarp::Mesh<E> ChosenGround<E>::mesh(std::vector<double> const& edges) const {
  return given ? scarp::GivenGround<E>{*given}.mesh(edges) : layer.generate<E>(edges);
}

template <class E>
double ChosenGround<E>::surface_level() const {
  return given ? scarp::surface_level(*given) : layer.depth;
}

template <class E>
double ChosenGround<E>::depth() const {
  return given ? scarp::surface_level(*given) - scarp::bottom_level(*given) : layer.depth;
}

template <class E>
ChosenGround<E> ground_of(Choice const& choice) {
  if (!choice.mesh.empty()) {
    std::vector<std::string> notes;
    auto ground = scarp::ground_from_file<E>(choice.mesh, &notes);
    examples::tell(notes);
    return {.given = std::move(ground.given)};
  }
  auto const pattern = choice.pattern.value_or(is_triangle ? MeshPattern::crossed : MeshPattern::quads);
  scarp::FaultMesh layer{.tip = choice.tip, .size = choice.size, .row_aspect = choice.aspect};
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
  if (choice.triangles > 0) layer = layer.with_about<E>(choice.triangles);
  return {.layer = layer};
}

template struct ChosenGround<Element>;
template ChosenGround<Element> ground_of(Choice const&);

}  // namespace fault_rupture
