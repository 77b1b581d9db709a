// SPDX-License-Identifier: BSL-1.0
#include "pairings/neighbour_oracle.hpp"
#include "pairings/pairing_laws.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/superellipse.hpp"

using PairingsOfOvals = pairings::Of<scarp::Ellipse, scarp::Superellipse>;
static_assert(std::tuple_size_v<PairingsOfOvals> == 2 * pairings::laws_per_shape);

PAIRINGS_OBEY_THE_LAWS(PairingsOfOvals);
NEIGHBOURS_ARE_THOSE_OF_ALL_PAIRS(scarp::Ellipse, scarp::Superellipse)
