// SPDX-License-Identifier: BSL-1.0
// How does Python call packings as materials? Points that respond to NumPy arrays, with their states inside: a biaxial
// test.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <set>
#include <thread>

#include "../shared/sand/sand_file.hpp"
#include "keywords.hpp"
#include "point_views.hpp"
#include "points.hpp"
#include "problems.hpp"
#include "scarp/core/build_info.hpp"
#include "signals.hpp"

namespace python_points {
namespace {

template <int Dim>
py::tuple respond(Points<Dim>& points, py::object const& given, int threads, int refinements, bool tangents) {
  auto const gradients = rows_of(given, "displacement gradients", {Dim, Dim});
  auto const rows = gradients.template unchecked<3>();
  std::vector<scarp::VoigtStress<Dim>> stresses;
  std::vector<scarp::VoigtTangent<Dim>> moduli;
  std::vector<scarp::Verdict> verdicts;
  points.at_work(threads, [&](auto& all, auto& executor) {
    py::gil_scoped_release const release;
    if (rows.shape(0) != all.size())
      scarp::reject("{} displacement gradients are given for {} points: give one to each", rows.shape(0), all.size());
    for (int k = 0; k < all.size(); ++k) {
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) all.gradient(k)(i, j) = rows(k, i, j);
      }
    }
    Signals signals;
    scarp::ResponseReport report;
    try {
      report = all.respond(executor, refinements);
    } catch (py::error_already_set const&) {  // DEM steps may have been refined on the way
      all.discard();
      throw;
    }
    stresses = all.stresses();
    if (tangents) moduli = all.tangents(executor);
    for (auto const& response : all.responses()) verdicts.push_back(response.verdict);
    return report;
  });
  constexpr py::ssize_t size = scarp::voigt_size<Dim>;
  return py::make_tuple(
      array_of<double>(std::move(stresses), {size}, {number_size}),
      tangents ? py::object(array_of<double>(std::move(moduli), {size, size}, {number_size, size * number_size}))
               : py::none(),
      array_of<scarp::Verdict>(std::move(verdicts), {}, {}));
}

template <class Number, class Of>
py::array of_all(int count, std::vector<py::ssize_t> const& shape, std::vector<py::ssize_t> const& strides,
                 Of const& of) {
  std::vector<decltype(of(0))> values;
  for (int k = 0; k < count; ++k) values.push_back(of(k));
  return array_of<Number>(std::move(values), shape, strides);
}

template <int Dim>
Places<Dim> places_of(py::object const& positions, py::object const& volumes, double length, py::object const& depths,
                      std::optional<std::vector<int>> indices) {
  Places<Dim> places;
  places.length = scarp::require_not_negative("length of means", length);
  auto const rows = rows_of(positions, "positions", {Dim});
  auto const column = [&](py::object const& given, char const* what) {
    if (given.is_none()) return std::vector<double>{};
    auto const found = rows_of(given, what, {});
    if (found.size() != rows.shape(0))
      scarp::reject("{} {} are given for {} points: give one to each", found.size(), what, rows.shape(0));
    return std::vector<double>(found.data(), found.data() + found.size());
  };
  for (py::ssize_t k = 0; k < rows.shape(0); ++k) {
    places.positions.emplace_back(Eigen::Map<scarp::Vector<Dim> const>(rows.data(k, 0)));
    if (!places.positions.back().allFinite()) scarp::reject("the position of point {} is not finite: correct it", k);
    places.indices.push_back(indices ? -1 : static_cast<int>(k));
  }
  if (indices) {
    if (indices->size() != places.indices.size())
      scarp::reject("{} indices are given for {} points: give one to each", indices->size(), places.indices.size());
    for (int const index : *indices) {
      if (index < 0) scarp::reject("index {} is given to a point (0 or more is expected): correct it", index);
    }
    places.indices = std::move(*indices);
  }
  places.volumes = column(volumes, "volumes");
  places.depths = column(depths, "depths");
  places.depths.resize(places.positions.size());
  return places;
}

/// \throws InputError for what is none
int whole_number(py::object const& given, char const* what) {
  try {
    return given.cast<int>();
  } catch (py::cast_error const&) {
    scarp::reject("{} are {} (a whole number is expected): correct it", what,
                  scarp::shortened(std::string(py::repr(given))));
  }
}

/// progress, threads: of the preparation; the other keywords are the material's
template <int Dim>
Material<Dim> made(std::string const& kind, py::dict keywords) {
  py::object const progress = keywords.attr("pop")("progress", py::none());
  py::object const wanted = keywords.attr("pop")("threads", 1);
  int const threads = whole_number(wanted, "threads");
  std::string const bits = with_material<Dim>(kind, [&]<class Recipe>(std::type_identity<Recipe>) {
    Recipe recipe;
    std::set<std::string> given;
    for (auto const& [name, value] : keywords) given.insert(name.template cast<std::string>());
    take_keywords(keywords, recipe);
    if constexpr (requires { recipe.complete(given); }) {
      recipe.complete(given);
    } else if (threads > 1) {
      scarp::reject("threads is {} (discs, ellipses and spheres alone prepare their packings by several): leave it out",
                    threads);
    }
    return bits_of(recipe);
  });
  auto const tell = [&](int done, int total, std::string const& text) {
    if (progress.is_none()) return;
    py::gil_scoped_acquire const acquire;
    progress(done, total, text);
  };
  return interruptible([&] { return prepared<Dim>(kind, bits, threads, tell); });
}

/// The options of a sand's file as keywords. given: keywords that replace some
py::dict sand_keywords(std::filesystem::path const& file, std::set<std::string> const& given) {
  auto const is_given = [&](std::string name) {
    std::ranges::replace(name, '-', '_');
    return given.contains(name);
  };
  return keywords_of(examples::read_sand(file, {}, is_given));
}

template <int Dim>
py::dict defaults(std::string const& kind) {
  return with_material<Dim>(kind, []<class Recipe>(std::type_identity<Recipe>) { return keywords_of(Recipe{}); });
}

/// Names of an enumeration, by number.
template <auto last>
py::tuple names_up_to() {
  constexpr auto count = static_cast<std::size_t>(last) + 1;
  static_assert(name(decltype(last)(count)) == "unknown", "there are more: name the last one");
  py::tuple names(count);
  for (std::size_t k = 0; k < count; ++k) names[k] = name(decltype(last)(k));
  return names;
}

/// Bytes of an object that holds some, such as a bytearray.
py::bytes bytes_of(py::buffer const& held) {
  PyObject* const bytes = PyBytes_FromObject(held.ptr());
  if (!bytes) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(bytes);
}

py::object load(std::string_view bytes) {
  scarp::StateReader reader(scarp::detail::payload_of(points_format, bytes));
  int dimensions = 0;
  reader("dimensions", dimensions);
  if (dimensions == 2) return py::cast(interruptible([&] { return Points<2>::read(reader); }));
  if (dimensions == 3) return py::cast(interruptible([&] { return Points<3>::read(reader); }));
  scarp::reject("it holds points of {} dimensions (2 or 3 are known): save it again", dimensions);
}

template <int Dim>
void bind(py::module_& module, char const* material_name, char const* points_name) {
  using All = Points<Dim>;
  constexpr py::ssize_t size = scarp::voigt_size<Dim>;
  py::class_<Material<Dim>>(module, material_name, "A material and what it was made from; immutable.")
      .def_readonly("kind", &Material<Dim>::kind)
      .def_property_readonly("dim", [](Material<Dim> const&) { return Dim; })
      .def(py::pickle([](Material<Dim> const& self) { return py::make_tuple(self.kind, py::bytes(self.bits)); },
                      [](py::tuple const& saved) {
                        return restored<Dim>(saved[0].cast<std::string>(), saved[1].cast<std::string>());
                      }));
  module.def(Dim == 2 ? "made" : "made_in_space", &made<Dim>);
  module.def(Dim == 2 ? "defaults" : "defaults_in_space", &defaults<Dim>);
  module.def("points", [](Material<Dim> const& material, py::object const& positions, py::object const& volumes,
                          double length, py::object const& depths, std::optional<std::vector<int>> indices) {
    auto places = places_of<Dim>(positions, volumes, length, depths, std::move(indices));
    return interruptible([&] { return std::make_unique<All>(material, std::move(places)); });
  });
  py::class_<All>(module, points_name, "Material points; see scarp.MaterialPoints.")
      .def("__len__", [](All& self) { return self.now().size(); })
      .def_property_readonly("material", &All::material)
      .def("respond", &respond<Dim>, py::arg("gradients"), py::arg("threads") = 1, py::arg("refinements") = 4,
           py::arg("tangents") = true,
           "gradients[n, d, d]: of the displacement since the last commit, d u_i / d x_j. Returns stresses[n, v] [Pa], "
           "tangents[n, v, v] [Pa] "
           "and verdicts[n] with the fields status and reason, see scarp.statuses and scarp.reasons. Voigt order xx, "
           "yy, xy or xx, yy, zz, yz, zx, xy.")
      .def("commit", &All::commit, "Keeps the last response.")
      .def(
          "discard", [](All& self) { self.discard(); }, "Lets the next response plan its work anew.")
      .def(
          "report",
          [](All& self) {
            auto const& [verdict, worst, steps, survey] = self.report();
            return py::dict(py::arg("status") = scarp::name(verdict.status),
                            py::arg("reason") = scarp::name(verdict.reason), py::arg("worst_point") = worst,
                            py::arg("inner_steps") = steps);
          },
          "Of the last response: the worst status, its reason and point, DEM steps of all points.")
      .def(
          "stresses",
          [](All& self) {
            return of_all<double>(self.now().size(), {size}, {number_size},
                                  [&](int k) { return self.now().committed_stress(k); });
          },
          "Committed stresses [Pa].")
      .def(
          "tangents",
          [](All& self) {
            return of_all<double>(self.now().size(), {size, size}, {number_size, size * number_size},
                                  [&](int k) { return self.now().committed_tangent(k); });
          },
          "Tangents [Pa] of the committed states.")
      .def_property_readonly(
          "work",
          [](All& self) { return of_all<long>(self.now().size(), {}, {}, [&](int k) { return self.now().work(k); }); },
          "DEM steps of each point's last response.")
      .def(
          "quantities", [](All& self, int point) { return quantities(self.now(), point); }, py::arg("point"),
          "Named numbers of a committed state; p and q [Pa], mean and largest difference of the principal stresses.")
      .def(
          "copy",
          [](All& self, int to, All& source, int point, bool mirrored) {
            self.now().copy(to, source.now(), point, mirrored);
          },
          py::arg("to"), py::arg("source"), py::arg("point"), py::arg("mirrored") = false,
          "Gives a point the committed state of another one.")
      .def("pack", [](All& self, std::vector<int> const& points) { return py::bytes(self.now().pack(points)); })
      .def("unpack", [](All& self, std::vector<int> const& points,
                        py::buffer const& bits) { self.now().unpack(points, std::string_view(bytes_of(bits))); })
      .def("save", [](All& self, std::filesystem::path const& path) { scarp::write_file(path, self.bytes()); })
      .def("__deepcopy__", [](All& self, py::dict const&) { return load(self.bytes()); })
      .def("__reduce__", [](All& self) {
        return py::make_tuple(py::module_::import("scarp").attr("loads"), py::make_tuple(py::bytes(self.bytes())));
      });
}

}  // namespace
}  // namespace python_points

PYBIND11_MODULE(_points, module) {
  using namespace python_points;
  PYBIND11_NUMPY_DTYPE(scarp::Verdict, status, reason);
  bind<2>(module, "Material", "Points");
  bind<3>(module, "MaterialInSpace", "PointsInSpace");
  bind_problems(module);
  module.def("sand_keywords", &sand_keywords);
  module.def("load", [](std::filesystem::path const& path) {
    auto const file = scarp::read_file(path);
    return scarp::with_context(fmt::format("cannot load '{}'", path.string()), [&] { return load(file); });
  });
  module.def("loads", [](py::buffer const& bytes) { return load(std::string_view(bytes_of(bytes))); });
  module.attr("statuses") = names_up_to<scarp::Status::failed>();
  module.attr("reasons") = names_up_to<scarp::Reason::time_error>();
  static_cast<py::class_<Points<2>>>(module.attr("Points"))
      .def(
          "picture", [](Points<2>& self, int point) { return picture(self.now(), point); }, py::arg("point"),
          "Of a packing: cell (columns are base vectors [m]), grains (x, y, half axes a and b, axis of a), contacts "
          "(from x, y, branch x, y, "
          "normal x, y, normal force [N]).");
  constexpr auto build = scarp::build_info();
  module.attr("build") = py::dict(py::arg("version") = scarp::version, py::arg("compiler") = build.compiler,
                                  py::arg("compiler_version") = build.compiler_version,
                                  py::arg("instruction_set") = build.instruction_set);
}
