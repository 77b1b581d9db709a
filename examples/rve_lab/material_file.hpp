// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "choices.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/read_file.hpp"

namespace rve_lab {

/// Calls visit(name, member, what it is) for all parameters of a material: the names of options and of the file's keys.
template <class AnyMaterial, class Visitor>
void for_each_parameter(AnyMaterial& material, Visitor const& visit) {
  visit("shape", material.shape, "of the grains");
  visit("law", material.law,
        "of the contacts: linear; with discs also hertz (Hertz and Mindlin) and rolling (linear with rolling "
        "resistance)");
  visit("normal-stiffness", material.normal_stiffness, "of linear and rolling contacts [N/m]");
  visit("tangential-stiffness", material.tangential_stiffness, "of linear and rolling contacts [N/m]");
  visit("friction", material.friction, "coefficient");
  visit("modulus", material.modulus, "Young's, of hertz contacts [Pa]");
  visit("poisson", material.poisson, "Poisson's ratio, of hertz contacts");
  visit("rolling-stiffness", material.rolling_stiffness, "of rolling contacts [N m/rad]");
  visit("rolling-friction", material.rolling_friction, "of rolling contacts");
}

/// A packing's material is kept beside it: sand.packing has sand.json.
inline std::filesystem::path material_path(std::filesystem::path packing) { return packing.replace_extension(".json"); }

inline nlohmann::json to_json(Material const& material) {
  nlohmann::json parameters;
  for_each_parameter(material, [&](char const* name, auto const& member, char const*) { parameters[name] = member; });
  return parameters;
}

/// Parameters that a material of this law has.
inline std::vector<std::string> parameters_of(std::string const& law) {
  std::vector<std::string> names{"shape", "law", "friction"};
  if (law == "hertz") {
    names.insert(names.end(), {"modulus", "poisson"});
  } else {
    names.insert(names.end(), {"normal-stiffness", "tangential-stiffness"});
  }
  if (law == "rolling") names.insert(names.end(), {"rolling-stiffness", "rolling-friction"});
  return names;
}

/// Reads the packing's material file (.json), except values that are `is_given`, which may be all of it.
/// prefix: of the names by which values are given
/// \throws InputError naming the file and the key for values that cannot be, and for a material that is not known
inline void read_material(std::filesystem::path const& packing, std::function<bool(std::string const&)> const& is_given,
                          Material& material, std::string_view prefix = "--") {
  if (!std::filesystem::exists(packing))
    scarp::reject("cannot read '{}' (there is no such file): check its name and folder", packing.string());
  auto const path = material_path(packing);
  if (!std::filesystem::is_regular_file(path)) {
    std::string missing;
    for (auto const& name : parameters_of(material.law)) {
      if (!is_given(name)) missing += fmt::format("{}{}{}", missing.empty() ? "" : ", ", prefix, name);
    }
    if (missing.empty()) return;
    scarp::reject("the material of '{}' is not known (there is no '{}' beside it): bring that file back, or give {}",
                  packing.string(), path.string(), missing);
  }
  auto const document = nlohmann::json::parse(scarp::read_file(path), nullptr, false);
  if (!document.is_object() || !document.contains("material") || !document["material"].is_object()) {
    scarp::reject("'{}' holds no material (an object 'material' is wanted): prepare the packing again", path.string());
  }
  auto const& parameters = document["material"];
  for_each_parameter(material, [&](char const* name, auto& member, char const*) {
    if (is_given(name) || !parameters.contains(name)) return;
    using Member = std::remove_reference_t<decltype(member)>;
    auto const& found = parameters[name];
    bool const fits = std::is_same_v<Member, std::string> ? found.is_string() : found.is_number();
    if (!fits)
      scarp::reject("'{}' in '{}' is {} (another kind of value is expected): correct it", name, path.string(),
                    found.dump());
    member = found.get<Member>();
    if constexpr (!std::is_same_v<Member, std::string>)
      scarp::with_context(path.string(), [&] { scarp::require_not_negative(name, member); });
  });
}

}  // namespace rve_lab
