// SPDX-License-Identifier: BSL-1.0
#include "pairings/neighbour_oracle.hpp"
#include "pairings/pairing_laws.hpp"
#include "scarp/shape/sphere.hpp"

using PairingsOfSpheres = pairings::Of<scarp::Sphere>;
static_assert(std::tuple_size_v<PairingsOfSpheres> == pairings::laws_per_shape);

PAIRINGS_OBEY_THE_LAWS(PairingsOfSpheres);
NEIGHBOURS_ARE_THOSE_OF_ALL_PAIRS(scarp::Sphere)
