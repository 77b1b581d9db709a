// SPDX-License-Identifier: BSL-1.0
#include "pairings/neighbour_oracle.hpp"
#include "pairings/pairing_laws.hpp"
#include "scarp/shape/clump.hpp"

using PairingsOfDiscs = pairings::Of<scarp::Disc, scarp::Dumbbell>;
static_assert(std::tuple_size_v<PairingsOfDiscs> == 2 * pairings::laws_per_shape);

PAIRINGS_OBEY_THE_LAWS(PairingsOfDiscs);
NEIGHBOURS_ARE_THOSE_OF_ALL_PAIRS(scarp::Disc, scarp::Dumbbell)
