// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "scarp/constitutive/constitutive_provider.hpp"

namespace scarp {

/// What a region may consist of: a ConstitutiveProvider, `AnyProvider`, or `Nonlocal` of one of these.
template <class Type>
concept Material = ConstitutiveProvider<Type> || requires(Type const& material) {
  material.batch();
} || requires(Type const& material) {
  material.neighbourhood();
  material.provider;
};

/// A Material; for another type the compiler names the member that is missing.
template <class Type>
concept CheckedMaterial = Material<Type> || CheckedProvider<Type>;

/// A named region and the material of its points.
template <CheckedMaterial MaterialType>
struct Region {
  std::string name;       ///< of the region in the mesh
  MaterialType provider;  ///< response of the region's points
};

template <class MaterialType>
Region(std::string, MaterialType) -> Region<MaterialType>;

}  // namespace scarp
