// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "device_packings.hpp"
#include "scarp/dem/block/block_device.hpp"
#include "scarp/dem/critical_step.hpp"
#include "scarp/dem/damping.hpp"

namespace scarp_benchmark {

/// Points on a device without a provider: one call gives all their trial states, always from their first states.
/// \tparam PackingType a `Packing` in the plane
template <class PackingType>
class DevicePoints {
 public:
  using Types = scarp::BlockTypesOf<PackingType>;                         ///< numbers of grains and pairs
  using Device = scarp::BlockDevice<Types, scarp::LocalDamping>;          ///< where the points are
  using Parameters = scarp::BlockParameters<Types, scarp::LocalDamping>;  ///< of all responses

  /// Point k starts with packing k modulo their number; each has its list of pairs. rooms: the device that sizes of
  /// states are those of
  DevicePoints(std::shared_ptr<Device> device, std::vector<PackingType> const& packings, std::size_t points,
               Device const& rooms)
      : device_(std::move(device)), parameters_{law_of_study<PackingType>(), {}, scarp::default_time_step_share} {
    for (std::size_t k = 0; k < points; ++k) {
      auto const& packing = packings[k % packings.size()];
      auto const size =
          rooms.room(static_cast<int>(packing.grain_count()), static_cast<int>(packing.pairs.count())).value();
      scarp::AlignedVector<std::byte> here(State::bytes(size));
      scarp::to_block(packing, State(here.data(), size));
      auto const memory_of = [&] { return memory_.emplace_back(device_->allocate(here.size())).get(); };
      std::byte* const first = memory_of();
      device_->write(here, first);
      tasks_.push_back({State(first, size), State(memory_of(), size), device_->grains(packing.population), 0, {}});
    }
    headers_.resize(points);
  }

  /// Responses of the first points. steps: of each; strain: of a step
  /// \return seconds that the device's call took
  double respond(std::span<int const> steps, double strain) {
    std::size_t const points = steps.size();
    for (std::size_t k = 0; k < points; ++k) {
      tasks_[k].steps = steps[k];
      tasks_[k].strain_step = scarp::detail::row_by_row<2>(strain_step(strain, k));
    }
    auto const begin = std::chrono::steady_clock::now();
    device_->respond(std::span(tasks_).first(points), parameters_, std::span(headers_).first(points));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  /// What the last response of a point reports.
  typename Device::Header const& header(std::size_t point) const { return headers_[point]; }

  /// Lists that the last responses of the first points have made.
  long lists(std::size_t points) const {
    long sum = 0;
    for (std::size_t k = 0; k < points; ++k) sum += headers_[k].lists;
    return sum;
  }
  /// Responses of the first points that ended early.
  long troubles(std::size_t points) const {
    return std::count_if(headers_.begin(), headers_.begin() + static_cast<std::ptrdiff_t>(points),
                         [](auto const& header) { return header.trouble != scarp::Trouble::none; });
  }

  /// All numbers of a point's trial state, without rows that hold neither a grain nor a pair.
  std::string content(std::size_t point) const {
    auto const size = tasks_[point].trial.size;
    scarp::AlignedVector<std::byte> bytes(State::bytes(size));
    device_->read(memory_[2 * point + 1].get(), bytes);
    State const state(bytes.data(), size);
    std::string all;
    auto const take = [&]<class T>(T const* from, int columns, int rows, int stride) {
      for (int k = 0; k < columns; ++k)
        all.append(static_cast<char const*>(static_cast<void const*>(from + k * stride)),
                   sizeof(T) * static_cast<std::size_t>(rows));
    };
    take(state.header, 1, 1, 1);
    int const grains = state.header->grains;
    int const pairs = state.header->pairs;
    take(state.position, Types::dim, grains, size.grains);
    take(state.velocity, Types::dim, grains, size.grains);
    take(state.spin, Types::turns, grains, size.grains);
    take(state.orientation, Types::axes, grains, size.grains);
    take(state.normal, Types::normals, pairs, size.pairs);
    take(state.memory, Types::memories, pairs, size.pairs);
    take(state.first, 1, pairs, size.pairs);
    take(state.second, 1, pairs, size.pairs);
    take(state.shift, 1, pairs, size.pairs);
    return all;
  }

 private:
  using State = scarp::BlockState<Types>;

  std::shared_ptr<Device> device_;
  Parameters parameters_;
  std::vector<typename Device::Bytes> memory_;  ///< first and trial state of each point
  std::vector<scarp::BlockTask<Types>> tasks_;
  std::vector<typename Device::Header> headers_;
};

}  // namespace scarp_benchmark
