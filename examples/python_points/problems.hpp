// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <pybind11/pybind11.h>

namespace python_points {

/// Meshes, models and analyses. Compiled in a source of its own.
void bind_problems(pybind11::module_& module);

}  // namespace python_points
