// SPDX-License-Identifier: BSL-1.0
// The providers, compiled once for the module and for same_path.
#include "materials.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>

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

scarp::Umat* umat_in(std::string const& file) {
  if (file.empty()) scarp::reject("a UMAT has no file (a shared library is expected): give it, file='soil.so'");
  // With a slash the loader searches no folders of its own.
  auto const path = std::filesystem::absolute(file);
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library)
    scarp::reject("the library of a UMAT does not load ({}): compile it, gfortran -O2 -shared -fPIC soil.f -o soil.so",
                  dlerror());
  // The loader gives the library that it has under this name, whatever has become of the file.
  static std::mutex mutex;
  static std::map<std::filesystem::path, std::filesystem::file_time_type> loaded;
  std::scoped_lock const lock(mutex);
  std::error_code gone;  // a file that was deleted meanwhile stays loaded
  auto const written = std::filesystem::last_write_time(path, gone);
  if (!gone && loaded.try_emplace(path, written).first->second != written)
    scarp::reject(
        "'{}' was compiled anew since it was loaded (the loader keeps the old one): start Python anew, or give it "
        "another name",
        file);
  void* const symbol = dlsym(library, "umat_");
  if (!symbol)
    scarp::reject("'{}' has no UMAT (the symbol umat_ is expected): name the subroutine UMAT, in C umat_", file);
  return reinterpret_cast<scarp::Umat*>(symbol);
}

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
