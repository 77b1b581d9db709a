// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <optional>

#include "../shared/study/any_soil.hpp"
#include "../shared/study/scenes.hpp"
#include "scarp/fault/fault_stages.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scene_size.hpp"

namespace fault_rupture {

using Grid = scarp::DefaultGridOf<ChosenGround<Element>>;
using Problem = scarp::EquilibriumProblem<Grid>;

/// What stands on the ground of a scene.
struct Footing {
  scarp::StripFooting strip{};
  std::function<scarp::FootingMotion(Problem const&, double load)> motion{};
};

/// A scene of the reference study as its runs use it: soil and structure are known where it is made alone.
struct Scene {
  ChosenGround<Element> ground{};
  ChosenFault fault{};
  scarp::FaultStages<> stages{};
  double tolerance = 0.0;         ///< of the force residual
  double pressure_floor = 0.0;    ///< [Pa], below which a point's balance counts less
  double rupture_time = 0.0;      ///< of the throw over wet ground [s]
  PackingWriter write_packing{};  ///< nothing for soils without packings
  std::function<Problem(scarp::Executor&)> problem{};
  std::function<double(double depth)> overburden{};  ///< see FaultScene
  std::optional<Footing> footing{};                  ///< nothing on bare ground
};

/// processes: that share the packings out among them; reports on stderr what is prepared where `speaks`
/// \throws scarp::InputError for choices that do not make a scene or need too much memory, scarp::PreparationError
Scene make_scene(Choice const& choice, int processes = 1, bool speaks = false);

/// Prepares nothing.
/// \throws scarp::InputError for choices that do not make a scene
SceneSize size_of_scene(Choice const& choice);

}  // namespace fault_rupture
