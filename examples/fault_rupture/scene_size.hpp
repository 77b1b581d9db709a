// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "../shared/study/choice.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"

namespace fault_rupture {

/// How large a scene is, known before anything is prepared for it.
struct SceneSize {
  double elements = 0.0;
  double nodes = 0.0;
  double width = 0.0;     ///< [m], of the ground
  double depth = 0.0;     ///< [m]
  double points = 0.0;    ///< of the soil
  double columns = 0.0;   ///< of packings that are made; 0 without packings
  double prepared = 0.0;  ///< packings that points may draw, images too
  double min_area = 0.0;  ///< [m2], of an element along the fault; 0 on a uniform mesh
  double pairs = 0.0;     ///< of points within the length of each other, each with itself too; 0 without a length
};

/// What follows from the soil's points; the mesh's part is left.
SceneSize size_of_soil(Choice const& choice, std::vector<scarp::Site<2>> const& sites);

/// Memory [B] of each of the processes that share the scene's packings out.
double memory_of(Choice const& choice, SceneSize const& size, int processes);

}  // namespace fault_rupture
