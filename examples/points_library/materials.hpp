// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <variant>

#include "scarp/points/any_provider.hpp"
#include "scarp_points.h"

namespace points_library {

/// A material in the plane or in space.
using Material = std::variant<scarp::AnyProvider<2>, scarp::AnyProvider<3>>;

/// A material from lines "key value" or "key = value"; what follows # is a comment.
///
/// kind elastic | mohr-coulomb | packing; dimension 2 (plane strain, the default) or 3.
/// Elastic and mohr-coulomb: young [Pa], poisson; initial stress of level ground surcharge [Pa], unit-weight [N/m3], k0
/// (1).
/// Mohr-coulomb: cohesion [Pa], friction and dilation [degrees], tension [Pa].
/// Packing: options of a sand (`examples::Sand`, those of rve_lab), of which discs, ellipses and spheres with linear
/// contacts are built;
/// sand: a file of such options, of which those beside it count first; or file: a packing that rve_lab prepared, with
/// the .sand of its name. Also strain-per-step and unbalanced-tolerance of responses.
/// folder: where a relative `sand` or `file` begins
/// \throws InputError for a key that is unknown or given twice, text that is no value, and parameters that no material
/// can have
Material material_of(std::string_view text, std::filesystem::path const& folder = {});

/// \throws InputError naming the file
Material read_material(std::filesystem::path const& path);

/// The material behind a handle of C. \throws InputError for one that is not alive
std::shared_ptr<Material const> material_at(scarp_material const* handle);

}  // namespace points_library
