// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "../../examples/surface_orders/elastic_ground.hpp"
#include "support/elements.hpp"

namespace {

/// Order of the surface's error between 4 and 8 rows, against 32 rows of quadratic elements.
template <class Element>
double surface_order(surface_orders::Step step = surface_orders::Step::moments) {
  // Without Poisson's effect the upper corners, held at the sides and free above, are not singular.
  static auto const exact = surface_orders::surface<scarp::Quad8>({.rows = 32, .poisson = 0.0});
  auto const error = [&](int rows) {
    return surface_orders::distance(surface_orders::surface<Element>({.rows = rows, .poisson = 0.0, .step = step}),
                                    exact);
  };
  return std::log2(error(4) / error(8));
}

}  // namespace

TEST_CASE_TEMPLATE("the surface over a fault converges by the element's order, its tip included", Element, scarp::Tri3,
                   scarp::Quad8 ALSO_NIGHTLY(scarp::Tri6)) {
  // Analytic: order p + 1, since the step at the tip has the moments of the real one; a tenth of an order is not there
  // yet.
  CHECK(surface_order<Element>() > (scarp::HasMidSides<Element> ? 2.8 : 1.9));
}

TEST_CASE("a step that lies in the facet right of the tip costs every element its order") {
  CHECK(surface_order<scarp::Tri3>(surface_orders::Step::one_facet) < 1.2);
  CHECK(surface_order<scarp::Quad8>(surface_orders::Step::one_facet) < 1.2);
}
