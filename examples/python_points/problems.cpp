// SPDX-License-Identifier: BSL-1.0
#include "problems.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "grids.hpp"
#include "materials.hpp"
#include "point_views.hpp"
#include "python_material.hpp"
#include "scarp/core/process.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/solver/analysis.hpp"
#include "scarp/solver/collapse.hpp"
#include "signals.hpp"
#include "water.hpp"

namespace python_points {
namespace {

using Sides = std::vector<std::string>;
using Knots = std::optional<std::vector<std::pair<double, double>>>;

inline constexpr scarp::FileFormat analysis_format{"SCARPPYA", 1, "file of an analysis of Python", "Analysis.save"};

std::optional<scarp::TimeFunction> course(Knots const& knots) {
  if (!knots) return std::nullopt;
  return scarp::TimeFunction(*knots);
}

/// Numbers of a table of whole numbers. columns: of the table, 0 for a list
/// \throws InputError for other types and shapes
std::vector<int> numbers_of(py::object const& given, char const* what, int columns) {
  py::module_ const numpy = py::module_::import("numpy");
  py::array const array = numpy.attr("asarray")(given);
  if (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')
    scarp::reject("{} have the type {} (whole numbers are expected): give node and region numbers from 0", what,
                  std::string(py::str(array.dtype())));
  std::vector<py::ssize_t> const found(array.shape(), array.shape() + array.ndim());
  if (columns > 0 ? found.size() != 2 || found[1] != columns : found.size() != 1)
    scarp::reject("{} have the shape ({}) ({} is expected): give a row to each", what, scarp::listed(found),
                  columns > 0 ? fmt::format("(n, {})", columns) : "(n)");
  using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  auto const wide = Integers::ensure(array);
  std::vector<int> numbers;
  for (py::ssize_t k = 0; k < wide.size(); ++k) {
    auto const number = wide.data()[k];
    if (!std::in_range<int>(number))
      scarp::reject("{} hold {} (no mesh has as many): give numbers from 0", what, number);
    numbers.push_back(static_cast<int>(number));
  }
  return numbers;
}

template <class Number>
py::array table(std::vector<Number>&& values, int columns) {
  auto const rows = static_cast<py::ssize_t>(values.size()) / columns;
  py::array const flat = array_of<Number>(std::move(values), {}, {});
  return flat.attr("reshape")(rows, columns);
}

/// element, nodes, elements, regions of elements, names of regions, boundaries, notes
py::tuple arrays_of(MeshTables tables) {
  auto const sizes = sizes_of(tables.element);
  py::dict boundaries;
  for (auto& [name, facets] : tables.boundaries)
    boundaries[py::str(name)] = table<int>(std::move(facets), sizes.facet_nodes);
  return py::make_tuple(tables.element, table<double>(std::move(tables.nodes), sizes.dim),
                        table<int>(std::move(tables.elements), sizes.nodes),
                        array_of<int>(std::move(tables.element_region), {}, {}), tables.regions, boundaries,
                        tables.notes);
}

/// A model, while no other thread makes an analysis of it.
template <int Dim>
class OwnModel {
 public:
  explicit OwnModel(std::unique_ptr<scarp::Grid<Dim>> grid) : model_(std::move(grid)) {}
  /// \throws std::runtime_error
  scarp::Model<Dim>& now() {
    if (users_ > 0)
      throw std::runtime_error(
          "the model is being made into an analysis by another thread (it does not change meanwhile): wait for it");
    return model_;
  }
  /// Calls work(model), which others cannot change meanwhile.
  template <class Work>
  auto used(Work const& work) {
    struct Use {
      std::atomic<int>& users;
      explicit Use(std::atomic<int>& count) : users(count) { ++users; }
      ~Use() { --users; }
    } const use(users_);
    return work(std::as_const(model_));
  }

 private:
  scarp::Model<Dim> model_;
  std::atomic<int> users_ = 0;
};

/// Boundaries by name: a value, or a pair of a value and an amplitude.
std::vector<WaterBoundary> water_boundaries(py::dict const& given) {
  std::vector<WaterBoundary> boundaries;
  for (auto const& [side, value] : given) {
    bool const has_amplitude = py::isinstance<py::tuple>(value);
    WaterBoundary one{.side = side.cast<std::string>(), .amplitude = scarp::TimeFunction::constant(1.0)};
    if (has_amplitude) {
      auto const [number, knots] = value.cast<std::pair<double, Knots>>();
      one.value = number;
      if (knots) one.amplitude = *course(knots);
    } else {
      one.value = value.cast<double>();
    }
    boundaries.push_back(std::move(one));
  }
  return boundaries;
}

template <int Dim>
std::unique_ptr<OwnModel<Dim>> model_of(std::string const& element, py::object const& nodes, py::object const& elements,
                                        py::object const& element_region, std::vector<std::string> regions,
                                        py::dict const& boundaries, std::string const& kinematics, double thickness) {
  auto const sizes = sizes_of(element);
  MeshTables tables{.element = element, .regions = std::move(regions)};
  auto const places = rows_of(nodes, "positions of nodes", {Dim});
  tables.nodes.assign(places.data(), places.data() + places.size());
  tables.elements = numbers_of(elements, "elements", sizes.nodes);
  tables.element_region = numbers_of(element_region, "regions of elements", 0);
  for (auto const& [name, facets] : boundaries)
    tables.boundaries[name.template cast<std::string>()] =
        numbers_of(py::reinterpret_borrow<py::object>(facets), "facets of a boundary", sizes.facet_nodes);
  return std::make_unique<OwnModel<Dim>>(grid_of<Dim>(tables, kinematics, thickness));
}

/// An analysis, while no other thread has it.
template <int Dim>
class OwnAnalysis {
 public:
  OwnAnalysis(scarp::Model<Dim> const& model, scarp::AnalysisSettings const& settings) : analysis_(model, settings) {}

  /// For readers; the thread that works reads within its observers.
  /// \throws std::runtime_error
  scarp::Analysis<Dim> const& seen() const {
    if (busy_ && std::this_thread::get_id() != owner_) reject_in_use();
    return analysis_;
  }
  /// Calls work(analysis) on this thread. \throws std::runtime_error
  template <class Work>
  auto at_work(Work const& work) {
    if (long process = 0; !busy_.compare_exchange_strong(process, scarp::detail::process_number())) reject_in_use();
    owner_ = std::this_thread::get_id();
    struct Done {
      std::atomic<long>& busy;
      ~Done() { busy = 0; }
    } const done{busy_};
    return work(analysis_);
  }

 private:
  [[noreturn]] void reject_in_use() const {
    throw std::runtime_error(
        busy_ == scarp::detail::process_number()
            ? "the analysis is at work (it serves one call at a time): wait for it, or make one for each thread"
            : "the analysis was at work when this process was forked (nobody ends that here): fork between calls, or "
              "load one that was saved");
  }

  scarp::Analysis<Dim> analysis_;
  std::atomic<long> busy_ = 0;  ///< process in which it works now
  std::thread::id owner_;       ///< thread that works
};

/// Files of fields, which one run writes at a time.
struct OwnSeries {
  scarp::FieldSeries files;
  bool is_in_use = false;  ///< changes under the interpreter's lock
};

/// The files, or none, of a run as long as it lives.
class SeriesUse {
 public:
  /// \throws std::runtime_error
  explicit SeriesUse(OwnSeries* series) : series_(series) {
    if (!series_) return;
    if (series_->is_in_use)
      throw std::runtime_error(
          "the series of files is being written by another run (it serves one at a time): give each run its own");
    series_->is_in_use = true;
  }
  SeriesUse(SeriesUse const&) = delete;
  SeriesUse& operator=(SeriesUse const&) = delete;
  ~SeriesUse() {
    if (series_) series_->is_in_use = false;
  }
  /// The files of a run that begins at a load factor. \throws InputError where there are later ones
  scarp::FieldSeries* from(double load) const {
    if (series_ && load < series_->files.last())
      scarp::reject(
          "the series has files up to the load factor {} (the run begins at {}, and what is there is not written "
          "again): give each run a series of its own",
          series_->files.last(), load);
    return series_ ? &series_->files : nullptr;
  }

 private:
  OwnSeries* series_;
};

using Clock = std::chrono::steady_clock;

Clock::time_point end_of(std::optional<double> const& seconds) {
  if (!seconds) return Clock::time_point::max();
  scarp::require_between("time limit of a run", *seconds, 0.0, 1e9);
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*seconds));
}

/// Passes attempts on to Python and to a series of files.
template <int Dim>
struct Watcher {
  py::object const& observer;
  scarp::FieldSeries* series;
  Signals& signals;
  Clock::time_point end;  ///< of the time limit
  bool stops = false;

  void attempted(scarp::Problem<Dim> const& problem, scarp::StepReport const& report) {
    if (series) series->attempted(problem, report);
    if (observer.is_none()) return;
    py::gil_scoped_acquire const acquire;
    stops = py::bool_(observer(py::cast(report)));
  }
  bool wants_stop() const {
    signals.look();
    return stops || Clock::now() >= end;
  }
};

py::dict report_of(scarp::RunReport const& run, std::string why) {
  return py::dict(
      py::arg("status") = scarp::name(run.verdict.status), py::arg("reason") = scarp::name(run.verdict.reason),
      py::arg("last_failure") = scarp::name(run.last_failure), py::arg("worst_point") = run.worst_point,
      py::arg("load") = run.load, py::arg("steps") = run.steps, py::arg("refused") = run.refused,
      py::arg("iterations") = run.iterations, py::arg("inner_steps") = run.inner_steps,
      py::arg("largest_residual") = run.largest_residual, py::arg("material_seconds") = run.material_seconds,
      py::arg("seconds") = run.seconds, py::arg("why") = std::move(why));
}

template <int Dim>
py::dict advance(OwnAnalysis<Dim>& own, double load, py::object const& observer, OwnSeries* series,
                 std::optional<double> seconds) {
  SeriesUse const use(series);
  auto const [run, why] = own.at_work([&](scarp::Analysis<Dim>& analysis) {
    auto* const files = use.from(analysis.load());
    py::gil_scoped_release const release;
    Signals signals;
    Watcher<Dim> watcher{observer, files, signals, end_of(seconds)};
    auto const report = analysis.to(load, watcher);
    if (files) files->ended(analysis.problem(), report.load);
    return std::pair(report, analysis.why(report));
  });
  return report_of(run, why);
}

py::dict collapse_of(scarp::Collapse const& end) {
  return py::dict(py::arg("failed") = end.failed, py::arg("load") = end.load, py::arg("ratio") = end.ratio,
                  py::arg("run") = report_of(end.run, end.why));
}

template <int Dim>
py::dict find_collapse(OwnAnalysis<Dim>& own, double load, double failed, double failing, py::object const& observer,
                       OwnSeries* series, std::optional<double> seconds) {
  SeriesUse const use(series);
  return collapse_of(own.at_work([&](scarp::Analysis<Dim>& analysis) {
    auto* const files = use.from(analysis.load());
    py::gil_scoped_release const release;
    Signals signals;
    Watcher<Dim> watcher{observer, files, signals, end_of(seconds)};
    auto end = scarp::find_collapse(analysis, load, {.failed = failed, .failing = failing}, watcher);
    if (files) files->ended(analysis.problem(), end.load);
    return end;
  }));
}

/// One number or row for each of `count`.
template <class Of>
auto listed_of(int count, Of const& of) {
  std::vector<decltype(of(0))> values;
  for (int k = 0; k < count; ++k) values.push_back(of(k));
  return values;
}
template <int Dim>
py::array places(std::vector<scarp::Vector<Dim>> values) {
  return array_of<double>(std::move(values), {Dim}, {number_size});
}

scarp::AnalysisSettings settings_of(std::optional<double> tolerance, int max_iterations, double first, double smallest,
                                    double largest, double max_displacement_gradient, double tangent_floor,
                                    int threads) {
  scarp::AnalysisSettings settings;
  settings.solver.tolerance = tolerance;
  settings.solver.max_iterations = max_iterations;
  settings.solver.rule.exact.floor = tangent_floor;
  settings.stepping.first = first;
  settings.stepping.smallest = smallest;
  settings.stepping.largest = largest;
  settings.stepping.max_displacement_gradient = max_displacement_gradient;
  settings.threads = threads;
  return settings;
}

template <int Dim>
void bind(py::module_& module, std::string const& suffix) {
  using Own = OwnModel<Dim>;
  constexpr py::ssize_t size = scarp::voigt_size<Dim>;
  // An unknown name is rejected before anything has changed.
  auto const each = [](Own& self, Sides const& sides, auto const& task) {
    for (auto const& side : sides) static_cast<void>(self.now().grid().boundary_nodes(side));
    for (auto const& side : sides) task(std::string_view(side));
  };
  py::class_<Own>(module, ("Model" + suffix).c_str(), "See scarp.Model.")
      .def(py::init(&model_of<Dim>))
      .def("fix", [=](Own& self, Sides const& sides,
                      int axis) { each(self, sides, [&](auto side) { self.now().fix({side}, axis); }); })
      .def("move",
           [=](Own& self, Sides const& sides, int axis, double rate, Knots const& knots) {
             auto const amplitude = course(knots).value_or(scarp::TimeFunction());
             each(self, sides, [&](auto side) { self.now().move({side}, axis, rate, amplitude); });
           })
      .def("gravity",
           [](Own& self, double weight, std::optional<std::string> const& region) {
             region ? self.now().gravity(*region, weight) : self.now().gravity(weight);
           })
      .def("traction",
           [=](Own& self, Sides const& sides, scarp::Vector<Dim> const& force, Knots const& knots) {
             each(self, sides, [&](auto side) { self.now().traction({side}, force, course(knots)); });
           })
      .def("surcharge",
           [=](Own& self, Sides const& sides, double pressure, Knots const& knots) {
             each(self, sides, [&](auto side) { self.now().surcharge({side}, pressure, course(knots)); });
           })
      .def("water",
           [](Own& self, double shear_modulus, double conductivity, double grain, double void_ratio,
              double bulk_modulus, std::optional<double> table, std::optional<double> largest_time_error,
              Knots const& clock, Sides const& drained, py::dict const& pressures, py::dict const& inflows) {
             attach_water(self.now(), {.shear_modulus = shear_modulus,
                                       .conductivity = conductivity,
                                       .grain = grain,
                                       .void_ratio = void_ratio,
                                       .bulk_modulus = bulk_modulus,
                                       .table = table,
                                       .largest_time_error = largest_time_error,
                                       .clock = course(clock).value_or(scarp::TimeFunction()),
                                       .drained = drained,
                                       .pressures = water_boundaries(pressures),
                                       .inflows = water_boundaries(inflows)});
           })
      .def("set_surface_level", [](Own& self, double height) { self.now().set_surface_level(height); })
      .def("geostatic",
           [](Own& self, double k0, std::string const& region) {
             auto const rest = self.now().geostatic(k0, region);
             return py::dict(py::arg("surcharge") = rest.surcharge, py::arg("unit_weight") = rest.unit_weight,
                             py::arg("k0") = rest.k0);
           })
      .def("depths",
           [](Own& self, std::string const& region) { return array_of<double>(self.now().depths(region), {}, {}); })
      .def("sites",
           [](Own& self, std::string const& region) {
             std::vector<scarp::Vector<Dim>> found;
             for (auto const& site : self.now().sites(region)) found.push_back(site.position);
             return places<Dim>(std::move(found));
           })
      .def("dead_load",
           [](Own& self) {
             Eigen::VectorXd const forces = self.now().dead_loads();
             scarp::Vector<Dim> sum = scarp::Vector<Dim>::Zero();
             for (Eigen::Index k = 0; k < forces.size(); k += Dim) sum += forces.template segment<Dim>(k);
             return sum;
           })
      .def("material", [](Own& self, std::string const& region, Material<Dim> const& material, double length) {
        if (scarp::require_not_negative("nonlocal length of a material", length) > 0.0) {
          self.now().material(region, scarp::Nonlocal{material.provider, length});
        } else {
          self.now().material(region, material.provider);
        }
      });

  using All = OwnAnalysis<Dim>;
  auto const bytes = [](All const& self) {
    auto const& analysis = self.seen();
    return py::bytes(
        scarp::detail::framed(analysis_format, [&](scarp::StateWriter& writer) { writer("analysis", analysis); }));
  };
  py::class_<All>(module, ("Analysis" + suffix).c_str(), "See scarp.Analysis.")
      .def(py::init([](Own& model, std::optional<double> tolerance, int max_iterations, double first, double smallest,
                       double largest, double gradient, double floor, int threads) {
        auto const settings =
            settings_of(tolerance, max_iterations, first, smallest, largest, gradient, floor, threads);
        return model.used(  // before other threads go on
            [&](auto const& own) { return interruptible([&] { return std::make_unique<All>(own, settings); }); });
      }))
      .def("to", &advance<Dim>)
      .def("find_collapse", &find_collapse<Dim>)
      .def_property_readonly("load", [](All const& self) { return self.seen().load(); })
      .def("next_knot", [](All const& self, double load) { return self.seen().problem().next_knot(load); })
      .def("displacement",
           [](All const& self, std::string const& side, int axis) { return self.seen().displacement(side, axis); })
      .def("reaction", [](All const& self, std::string const& side) { return self.seen().reaction(side); })
      .def("positions", [](All const& self) { return places<Dim>(self.seen().problem().grid().positions()); })
      .def("boundary_nodes",
           [](All const& self, std::string const& side) {
             return array_of<int>(self.seen().problem().grid().boundary_nodes(side), {}, {});
           })
      .def("nodal_fields",
           [](All const& self) {
             py::dict fields;
             if (auto const* const field = self.seen().problem().field()) {
               for (auto& [name, values] : field->nodal_fields())
                 fields[py::str(name)] = array_of<double>(std::move(values), {}, {});
             }
             return fields;
           })
      .def("point_positions",
           [](All const& self) {
             auto const& grid = self.seen().problem().grid();
             return places<Dim>(listed_of(grid.point_count(), [&](int k) { return grid.site(k, 0.0).position; }));
           })
      .def("point_elements",
           [](All const& self) {
             auto const& grid = self.seen().problem().grid();
             return array_of<int>(listed_of(grid.point_count(), [&](int k) { return grid.site(k, 0.0).element; }), {},
                                  {});
           })
      .def("volumes",
           [](All const& self) {
             auto const& grid = self.seen().problem().grid();
             return array_of<double>(grid.volumes(Eigen::VectorXd::Zero(grid.dof_count())), {}, {});
           })
      .def("stresses",
           [](All const& self) {
             return array_of<double>(self.seen().problem().committed_stresses(), {size}, {number_size});
           })
      .def("deformations",
           [](All const& self) {
             auto const& grid = self.seen().problem().grid();
             auto values = listed_of(grid.point_count(), [&](int k) { return grid.deformation(k); });
             return array_of<double>(std::move(values), {Dim, Dim}, {number_size, Dim * number_size});
           })
      .def("regions_without_means",
           [](All const& self) {
             auto const& problem = self.seen().problem();
             auto const& grid = problem.grid();
             std::set<std::string> alone(grid.regions().begin(), grid.regions().end());
             auto const* const means = problem.points().means();
             for (int k = 0; means && k < grid.point_count(); ++k) {
               if (means->mean().of(k).size() > 1)
                 alone.erase(grid.regions()[scarp::detail::index(grid.site(k, 0.0).region)]);
             }
             return alone;
           })
      .def("quantities", [](All const& self, int point) { return quantities(self.seen().problem().points(), point); })
      .def("picture",
           [](All const& self, int point) -> py::object {
             if constexpr (Dim == 2) {
               return picture(self.seen().problem().points(), point);
             } else {
               return py::none();
             }
           })
      .def("read",
           [](All& self, py::bytes const& saved) {
             self.at_work([&](scarp::Analysis<Dim>& analysis) {
               scarp::StateReader reader(scarp::detail::payload_of(analysis_format, std::string_view(saved)));
               reader("analysis", analysis);
             });
           })
      .def("bytes", bytes);
  module.def(Dim == 2 ? "python_material" : "python_material_in_space", [](py::object const& written, bool exact) {
    return Material<Dim>{"python",
                         {},
                         exact ? scarp::AnyProvider<Dim>(PythonMaterial<Dim, true>::of(written))
                               : scarp::AnyProvider<Dim>(PythonMaterial<Dim, false>::of(written))};
  });
}

}  // namespace

void bind_problems(py::module_& module) {
  module.def("read_gmsh", [](std::filesystem::path const& file, std::string const& element, int highest_order) {
    return arrays_of(gmsh_tables(file, element, highest_order));
  });
  module.def("box_mesh", [](std::string const& element, std::vector<double> const& lengths,
                            std::vector<int> const& cells) { return arrays_of(box_tables(element, lengths, cells)); });
  module.def("dim_of", [](std::string const& element) { return sizes_of(element).dim; });
  py::class_<scarp::StepReport>(module, "Step", "An attempt at a load step.")
      .def_readonly("number", &scarp::StepReport::step)
      .def_readonly("load", &scarp::StepReport::load)
      .def_readonly("load_increment", &scarp::StepReport::load_increment)
      .def_readonly("worst_point", &scarp::StepReport::worst_point)
      .def_readonly("seconds", &scarp::StepReport::seconds)
      .def_property_readonly("accepted", [](scarp::StepReport const& step) { return step.verdict.acceptable(); })
      .def_property_readonly("status", [](scarp::StepReport const& step) { return scarp::name(step.verdict.status); })
      .def_property_readonly("reason", [](scarp::StepReport const& step) { return scarp::name(step.verdict.reason); })
      .def_property_readonly("iterations", &scarp::StepReport::iterations)
      .def_property_readonly("residual", &scarp::StepReport::residual);
  py::class_<OwnSeries>(
      module, "FieldSeries",
      "Fields for ParaView: folder/fields.pvd, written after the first load step and then `count` times up to the load "
      "factor `to`.")
      .def(py::init([](std::filesystem::path const& folder, double to, int count) {
             return OwnSeries{scarp::FieldSeries(folder, {.to = to, .count = count})};
           }),
           py::arg("folder"), py::arg("to") = 1.0, py::arg("count") = 10);
  bind<2>(module, "");
  bind<3>(module, "InSpace");
}

}  // namespace python_points
