// SPDX-License-Identifier: BSL-1.0
// The providers, compiled once for the module and for same_path.
#include "materials.hpp"

namespace python_points {

namespace {

template <int Dim, class Prepare>
Material<Dim> material_of(std::string const& kind, std::string_view bits, Prepare const& prepare) {
  return with_material<Dim>(kind, [&]<class Recipe>(std::type_identity<Recipe>) {
    Recipe recipe;
    scarp::StateReader reader(bits);
    reader("material", recipe);
    prepare(recipe);
    return Material<Dim>{kind, bits_of(recipe), recipe.provider()};
  });
}

}  // namespace

template <int Dim>
Material<Dim> prepared(std::string const& kind, std::string_view bits, int threads, Progress const& progress) {
  return material_of<Dim>(kind, bits, [&](auto& recipe) { recipe.prepare(threads, progress); });
}

template <int Dim>
Material<Dim> restored(std::string const& kind, std::string_view bits) {
  return material_of<Dim>(kind, bits, [](auto&) {});
}

template Material<2> prepared<2>(std::string const&, std::string_view, int, Progress const&);
template Material<3> prepared<3>(std::string const&, std::string_view, int, Progress const&);
template Material<2> restored<2>(std::string const&, std::string_view);
template Material<3> restored<3>(std::string const&, std::string_view);

}  // namespace python_points
