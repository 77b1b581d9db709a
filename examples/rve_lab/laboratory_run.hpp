// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <nlohmann/json.hpp>

#include "choices.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/run/run_folder.hpp"

namespace rve_lab {

/// Tests `count` points of a material and writes test.csv, row by row, and summary.json.
/// \return whether the path came to its end
template <int Dim>
bool test_material(Laboratory const& choice, scarp::AnyProvider<Dim> const& material, int count, scarp::RunFolder& own,
                   nlohmann::json const& described);

}  // namespace rve_lab
