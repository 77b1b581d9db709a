// SPDX-License-Identifier: BSL-1.0
#include "specimen.hpp"

template int biaxial_specimen::run<scarp::Quad4>(Choice const&);
