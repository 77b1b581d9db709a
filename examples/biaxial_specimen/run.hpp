// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "choice.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"

namespace biaxial_specimen {

/// Tests a mesh of one kind of element; each is compiled in a source of its own.
/// \return exit code of the program
template <class Element>
int run(Choice const& choice);

/// Tests a specimen whose pores are full of water, of Quad8, see water/undrained.cpp.
/// \return exit code of the program
int run_undrained(Choice const& choice);

extern template int run<scarp::Tri3>(Choice const&);
extern template int run<scarp::Tri6>(Choice const&);
extern template int run<scarp::Quad4>(Choice const&);
extern template int run<scarp::Quad8>(Choice const&);

}  // namespace biaxial_specimen
