// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "materials.hpp"
#include "scarp/core/process.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/points/nonlocal.hpp"

namespace python_points {

inline constexpr scarp::FileFormat points_format{"SCARPPYP", 4, "file of points of Python", "MaterialPoints.save"};

/// Where points are and what they weigh.
template <int Dim>
struct Places {
  std::vector<scarp::Vector<Dim>> positions{};  ///< [m]
  std::vector<double> depths{};                 ///< [m]
  std::vector<int> indices{};                   ///< by which points draw their packings
  std::vector<double> volumes{};                ///< [m3], empty for points without means
  double length = 0.0;                          ///< [m] of means
  SCARP_MEMBERS(positions, depths, indices, volumes, length)
};

/// Points of one material with all that is needed to make them again.
template <int Dim>
class Points {
 public:
  Points(Material<Dim> material, Places<Dim> places) : material_(std::move(material)), places_(std::move(places)) {
    std::vector<scarp::Site<Dim>> sites;
    for (std::size_t k = 0; k < places_.positions.size(); ++k)
      sites.push_back({.index = places_.indices[k], .position = places_.positions[k], .depth = places_.depths[k]});
    points_ = places_.length > 0.0 ? scarp::MaterialPoints<Dim>(scarp::Nonlocal{material_.provider, places_.length},
                                                                sites, places_.volumes)
                                   : scarp::MaterialPoints<Dim>(material_.provider, sites, places_.volumes);
  }

  /// The points, while no other thread has them.
  /// \throws std::runtime_error
  scarp::MaterialPoints<Dim>& now() {
    if (long const process = busy_) reject_in_use(process);
    return points_;
  }

  /// Calls work(points, executor), which returns the report of a response, on this thread, with the executor's threads.
  /// \throws std::runtime_error like now()
  template <class Work>
  void at_work(int threads, Work const& work) {
    if (long process = 0; !busy_.compare_exchange_strong(process, scarp::detail::process_number()))
      reject_in_use(process);
    struct Done {
      std::atomic<long>& busy;
      ~Done() { busy = 0; }
    } const done{busy_};
    if (!team_ || threads_ != threads) team_ = std::make_unique<scarp::ThreadExecutor>(threads);
    threads_ = threads;
    report_ = work(points_, *team_);
  }

  void discard() {
    now().discard();
    report_ = {};
  }

  /// \throws InputError for states that must not be kept
  void commit() {
    auto& points = now();
    auto const& last = report_.verdict;
    if (!last.acceptable()) {
      scarp::reject("point {} is {} ({}; a commit would keep it): respond to a smaller increment, or discard",
                    report_.worst_point, scarp::name(last.status), scarp::name(last.reason));
    }
    points.commit();
  }

  std::string bytes() {
    auto const& points = now();
    return scarp::detail::framed(points_format, [&](scarp::StateWriter& writer) {
      writer("dimensions", Dim);
      writer("kind", material_.kind);
      writer("material", material_.bits);
      writer("places", places_);
      writer("points", points);
    });
  }
  /// reader: behind the dimensions
  static std::unique_ptr<Points> read(scarp::StateReader& reader) {
    std::string kind;
    std::string material;
    Places<Dim> places;
    reader("kind", kind);
    reader("material", material);
    reader("places", places);
    auto points = std::make_unique<Points>(restored<Dim>(kind, material), std::move(places));
    reader("points", points->points_);
    return points;
  }

  Material<Dim> const& material() const { return material_; }

  /// Of the last response. \throws std::runtime_error like now()
  scarp::ResponseReport const& report() {
    static_cast<void>(now());
    return report_;
  }

 private:
  /// process: where they respond
  [[noreturn]] static void reject_in_use(long process) {
    throw std::runtime_error(process == scarp::detail::process_number()
                                 ? "the points respond to another thread (they serve one at a time): wait for it, or "
                                   "give each thread its own"
                                 : "the points responded to a thread when this process was forked from its own (nobody "
                                   "ends that here): fork "
                                   "between responses, or load points that were saved");
  }

  Material<Dim> material_;
  Places<Dim> places_;
  scarp::MaterialPoints<Dim> points_;
  scarp::ResponseReport report_{};
  std::atomic<long> busy_ = 0;  ///< process in which they respond now
  std::unique_ptr<scarp::ThreadExecutor> team_;
  int threads_ = 0;
};

}  // namespace python_points
