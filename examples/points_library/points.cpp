// SPDX-License-Identifier: BSL-1.0
// The C functions of scarp_points.h.
#include <mutex>
#include "handles.hpp"
#include "materials.hpp"
#include "scarp/core/process.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/points/point_file.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace points_library {
namespace {

/// A batch and what a C program may do next with it.
struct Points {
  std::variant<scarp::MaterialPoints<2>, scarp::MaterialPoints<3>> batch;
  std::unique_ptr<scarp::ThreadExecutor> team{};
  int threads = 0;             ///< as they were requested for the team
  bool has_gradients = false;  ///< since the last commit
  bool has_response = false;   ///< to these gradients
  bool is_acceptable = false;  ///< so that it can be committed
  std::mutex mutex{};
  std::atomic<long> process = 0;  ///< that has locked the mutex last

  void forget() { has_gradients = has_response = is_acceptable = false; }
};

Handles<Material const>& materials() {
  static Handles<Material const> handles("a material");
  return handles;
}
Handles<Points>& batches() {
  static Handles<Points> handles("points");
  return handles;
}

int add_material(scarp_material** handle, auto const& make) {
  return guarded([&] {
    *given(handle, "the address of the material's handle") = nullptr;
    *handle = static_cast<scarp_material*>(materials().add(std::make_shared<Material const>(make())));
  });
}

/// work(Points&, MaterialPoints<dim>&) on a batch that no other thread uses meanwhile
template <class Work>
int with_points(scarp_points const* handle, Work const& work) {
  return guarded([&] {
    auto const points = batches().at(handle);
    std::unique_lock lock(points->mutex, std::try_to_lock);
    long const process = scarp::detail::process_number();
    if (!lock) {
      if (long const other = points->process; other != 0 && other != process)
        scarp::reject(
            "the points were used by a thread of process {} when this process was forked from it (nobody ends that "
            "here): fork between calls, or make other points",
            other);
      lock.lock();
    }
    points->process = process;
    return std::visit([&](auto& batch) { return work(*points, batch); }, points->batch);
  });
}

scarp_verdict to_c(scarp::Verdict const& verdict, int point) {
  return {static_cast<int>(verdict.status), static_cast<int>(verdict.reason), scarp::name(verdict.status).data(),
          scarp::name(verdict.reason).data(), point};
}

void require_numbers(std::size_t numbers, int points, long each, std::string_view what) {
  auto const wanted = static_cast<std::size_t>(points) * static_cast<std::size_t>(each);
  if (numbers != wanted)
    scarp::reject("{} numbers of {} are given ({} points have {}): give as many", numbers, what, points, wanted);
}

/// Rows first, whatever the order in memory is.
template <class Matrix>
void copy_rows(Matrix const& matrix, double*& to) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) *to++ = matrix(i, j);
  }
}

/// value(batch, point): a matrix of fixed size
template <class Value>
int copy_all(scarp_points const* handle, double* to, std::size_t numbers, std::string_view what, bool of_response,
             Value const& value) {
  return with_points(handle, [&](Points& points, auto& batch) {
    given(to, what);
    if (of_response && !points.has_response)
      scarp::reject("{} are requested without a response (since the last commit or discard): respond first", what);
    require_numbers(numbers, batch.size(), decltype(value(batch, 0))::SizeAtCompileTime, what);
    for (int point = 0; point < batch.size(); ++point) copy_rows(value(batch, point), to);
  });
}

}  // namespace

std::shared_ptr<Material const> material_at(scarp_material const* handle) { return materials().at(handle); }

}  // namespace points_library

using namespace points_library;  // NOLINT: the functions of the header stand in no namespace

extern "C" {

char const* scarp_last_error(void) { return last_error().c_str(); }

int scarp_material_read(char const* path, scarp_material** material) {
  return add_material(material, [&] { return read_material(given(path, "the name of the material's file")); });
}
int scarp_material_parse(char const* text, scarp_material** material) {
  return add_material(material, [&] { return material_of(given(text, "the text of the material")); });
}
int scarp_material_dimension(scarp_material const* material, int* dimension) {
  return guarded([&] { *given(dimension, "the dimension") = materials().at(material)->index() == 0 ? 2 : 3; });
}
int scarp_material_free(scarp_material* material) {
  return guarded([&] { materials().remove(material); });
}

int scarp_points_create(scarp_material const* material, int count, double const* depths, scarp_points** points) {
  return guarded([&] {
    *given(points, "the address of the points' handle") = nullptr;
    auto const kept = materials().at(material);
    scarp::require_at_least("the number of points", count, 1);
    auto made = std::make_shared<Points>();
    std::visit(
        [&]<int dim>(scarp::AnyProvider<dim> const& provider) {
          std::vector<scarp::Site<dim>> sites;
          for (int k = 0; k < count; ++k) {
            double const depth = depths ? scarp::require_finite("the depth of a point", depths[k]) : 0.0;
            sites.push_back({.index = k, .depth = depth});
          }
          made->batch = scarp::MaterialPoints<dim>(provider, sites);
        },
        *kept);
    *points = static_cast<scarp_points*>(batches().add(std::move(made)));
  });
}
int scarp_points_free(scarp_points* points) {
  return guarded([&] { batches().remove(points); });
}
int scarp_points_count(scarp_points const* points, int* count) {
  return with_points(points, [&](Points&, auto& batch) { *given(count, "the count") = batch.size(); });
}

int scarp_points_set_gradients(scarp_points* points, double const* gradients, size_t numbers) {
  return with_points(points, [&]<int dim>(Points& own, scarp::MaterialPoints<dim>& batch) {
    given(gradients, "the array of gradients");
    require_numbers(numbers, batch.size(), dim * dim, "gradients");
    for (std::size_t k = 0; k < numbers; ++k) {
      if (!std::isfinite(gradients[k]))
        scarp::reject("the gradient of point {} has {} in it (finite numbers are expected): take a smaller step",
                      k / (dim * dim), gradients[k]);
    }
    for (int point = 0; point < batch.size(); ++point, gradients += dim * dim)
      batch.gradient(point) = Eigen::Map<Eigen::Matrix<double, dim, dim, Eigen::RowMajor> const>(gradients);
    own.forget();
    own.has_gradients = true;
  });
}
int scarp_points_respond(scarp_points* points, int threads, scarp_verdict* worst) {
  return with_points(points, [&](Points& own, auto& batch) -> int {
    if (!own.has_gradients)
      scarp::reject("a response is requested without gradients (since the last commit): set them first");
    own.has_response = own.is_acceptable = false;
    if (!own.team || own.threads != threads) {
      own.team.reset();
      own.team = std::make_unique<scarp::ThreadExecutor>(threads);
      own.threads = threads;
    }
    scarp::ResponseReport const report = batch.respond(*own.team);
    own.has_response = true;
    own.is_acceptable = report.verdict.acceptable();
    if (worst) *worst = to_c(report.verdict, report.worst_point);
    if (own.is_acceptable) return SCARP_DONE;
    last_error() =
        fmt::format("point {} is {} ({}): set a smaller increment, after scarp_points_discard", report.worst_point,
                    scarp::name(report.verdict.status), scarp::name(report.verdict.reason));
    return SCARP_NOT_ACCEPTABLE;
  });
}
int scarp_points_verdict(scarp_points const* points, int point, scarp_verdict* verdict) {
  return with_points(points, [&](Points& own, auto& batch) {
    given(verdict, "the verdict");
    if (!own.has_response) scarp::reject("a verdict is requested without a response: respond first");
    static_cast<void>(batch.stress(point));  // rejects a point that is not there
    *verdict = to_c(batch.responses()[static_cast<std::size_t>(point)].verdict, point);
  });
}
int scarp_points_stresses(scarp_points const* points, double* stresses, size_t numbers) {
  return copy_all(points, stresses, numbers, "stresses", true, [](auto& batch, int k) { return batch.stress(k); });
}
int scarp_points_tangents(scarp_points const* points, double* tangents, size_t numbers) {
  return copy_all(points, tangents, numbers, "tangents", true, [](auto& batch, int k) { return batch.tangent(k); });
}
int scarp_points_committed_stresses(scarp_points const* points, double* stresses, size_t numbers) {
  return copy_all(points, stresses, numbers, "stresses", false,
                  [](auto& batch, int k) { return batch.committed_stress(k); });
}
int scarp_points_committed_tangents(scarp_points const* points, double* tangents, size_t numbers) {
  return copy_all(points, tangents, numbers, "tangents", false,
                  [](auto& batch, int k) { return batch.committed_tangent(k); });
}

int scarp_points_commit(scarp_points* points) {
  return with_points(points, [&](Points& own, auto& batch) {
    if (!own.is_acceptable)
      scarp::reject(
          "a commit is requested without an acceptable response (nothing sound would be kept): respond first");
    batch.commit();
    own.forget();
  });
}
int scarp_points_discard(scarp_points* points) {
  return with_points(points, [&](Points& own, auto& batch) {
    batch.discard();
    own.forget();
  });
}

int scarp_points_pack(scarp_points const* points, int point, void* bytes, size_t room, size_t* length) {
  return with_points(points, [&](Points&, auto& batch) {
    std::string const bits = batch.pack(point);
    *given(length, "the address of the length") = bits.size();
    if (!bytes) return;
    if (room < bits.size())
      scarp::reject("there is room for {} bytes (the state of point {} has {}): give more", room, point, bits.size());
    std::memcpy(bytes, bits.data(), bits.size());
  });
}
int scarp_points_unpack(scarp_points* points, int point, void const* bytes, size_t length) {
  return with_points(points, [&](Points& own, auto& batch) {
    batch.unpack(point, {static_cast<char const*>(given(bytes, "the array of bytes")), length});
    own.forget();
  });
}
int scarp_points_save(scarp_points const* points, char const* path) {
  return with_points(points,
                     [&](Points&, auto& batch) { scarp::save_points(given(path, "the name of the file"), batch); });
}
int scarp_points_load(scarp_points* points, char const* path) {
  return with_points(points, [&](Points& own, auto& batch) {
    scarp::load_points(given(path, "the name of the file"), batch);
    own.forget();
  });
}

int scarp_points_quantity(scarp_points const* points, int point, char const* name, double* value) {
  return with_points(points, [&](Points&, auto& batch) {
    std::string_view const wanted = given(name, "the name of the quantity");
    given(value, "the address of the value");
    std::string known;
    for (auto const& [one, number] : batch.quantities(point)) {
      if (one == wanted) return static_cast<void>(*value = number);
      known += (known.empty() ? "" : ", ") + std::string(one);
    }
    scarp::reject("point {} has no quantity '{}' (it has: {}): use one of these names", point, wanted,
                  known.empty() ? "none" : known);
  });
}
int scarp_points_work(scarp_points const* points, int point, long long* steps) {
  return with_points(points,
                     [&](Points&, auto& batch) { *given(steps, "the address of the steps") = batch.work(point); });
}
}
