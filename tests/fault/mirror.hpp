// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "scarp/element/tri3.hpp"
#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/thread_executor.hpp"

/// A layer over a fault, and what a mirror at x = 0 shows of both.
namespace mirror {

struct Ground {
  using Element = scarp::Tri3;

  scarp::FaultMesh layer{.size = 3.5, .jitter = 0.25};
  bool mirrored = false;

  scarp::Mesh<Element> mesh(std::vector<double> const& edges) const {
    auto made = layer.generate<Element>(edges);
    if (!mirrored) return made;
    for (auto& node : made.nodes) node.x() = -node.x();
    for (auto& element : made.elements) std::swap(element[1], element[2]);
    for (auto& [name, facets] : made.boundaries) {
      for (auto& facet : facets) std::swap(facet[0], facet[1]);
    }
    std::swap(made.boundaries["left"], made.boundaries["right"]);
    return made;
  }
  double surface_level() const { return layer.depth; }
};

struct Fault {
  double tip = 0.0;
  bool mirrored = false;

  scarp::Vector<2> left() const { return mirrored ? slip(-1.0) : scarp::Vector<2>(0.0, 0.0); }
  scarp::Vector<2> right() const { return mirrored ? scarp::Vector<2>(0.0, 0.0) : slip(1.0); }

 private:
  static scarp::Vector<2> slip(double sense) {
    auto const slides = scarp::NormalFault{}.right();
    return {sense * slides.x(), slides.y()};
  }
};

inline double largest_difference(std::vector<scarp::Vector<2>> const& some,
                                 std::vector<scarp::Vector<2>> const& others) {
  double largest = 0.0;
  for (std::size_t k = 0; k < some.size(); ++k) largest = std::max(largest, (some[k] - others[k]).norm());
  return largest;
}

/// Places of all nodes after the rupture, seen in the mirror for a mirrored scene; empty where a stage stopped.
template <class Scene>
std::vector<scarp::Vector<2>> ruptured(Scene scene, bool mirrored) {
  scene.ground.mirrored = mirrored;
  scene.fault.mirrored = mirrored;
  scarp::ThreadExecutor threads;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(threads);
  if (!scene.settle(problem, no_observer).verdict.acceptable() ||
      !scene.rupture(problem, no_observer).verdict.acceptable())
    return {};
  auto places = problem.discretisation().positions();
  for (auto& place : places) place.x() *= mirrored ? -1.0 : 1.0;
  return places;
}

}  // namespace mirror
