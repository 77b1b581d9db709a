// SPDX-License-Identifier: BSL-1.0
#include "specimen.hpp"

template int biaxial_specimen::run<scarp::Tri3>(Choice const&);
