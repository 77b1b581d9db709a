// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <variant>

#include "../shared/study/any_soil.hpp"
#include "../shared/study/scenes.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scene_size.hpp"

namespace fault_rupture {

/// A scene of the reference study, compiled once for all soils.
template <class Structure>
struct Scene : scarp::FaultScene<scarp::Nonlocal<scarp::AnyProvider<2>>, Structure, scarp::QuasiNewton<>,
                                 ChosenGround<Element>, ChosenFault> {
  double tolerance = 0.0;         ///< of the force residual
  double pressure_floor = 0.0;    ///< [Pa], below which a point's balance counts less
  PackingWriter write_packing{};  ///< nothing for soils without packings
};

#ifdef FAULT_RUPTURE_WATER
template <class Structure>
using OnGround = scarp::Saturated<Structure>;
#else
template <class Structure>
using OnGround = Structure;
#endif
using FreeField = OnGround<scarp::NoStructure>;
using TiedFooting = OnGround<scarp::TiedFooting>;
using SlidingFooting = OnGround<FrictionalFooting>;
using AnyScene = std::variant<Scene<FreeField>, Scene<TiedFooting>, Scene<SlidingFooting>>;

/// processes: that share the packings out among them; reports on stderr what is prepared where `speaks`
/// \throws scarp::InputError for choices that do not make a scene or need too much memory, scarp::PreparationError
AnyScene make_scene(Choice const& choice, int processes = 1, bool speaks = false);

/// Prepares nothing.
/// \throws scarp::InputError for choices that do not make a scene
SceneSize size_of_scene(Choice const& choice);

}  // namespace fault_rupture
