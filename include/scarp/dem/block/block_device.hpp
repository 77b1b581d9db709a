// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "scarp/core/interruption.hpp"
#include "scarp/dem/block/block_packings.hpp"
#include "scarp/dem/block/block_program.hpp"
#include "scarp/simd/soa_array.hpp"

namespace scarp {

/// Rows of grains, and twice the pairs, are numbers of 16 bits.
template <class Types>
inline constexpr int most_grains = 65'535 / Types::parts;
inline constexpr int most_pairs = 32'760;  ///< see `most_grains`

/// One response of a device.
/// \tparam Types a `BlockTypes`
template <class Types>
struct BlockTask {
  BlockState<Types> committed;                  ///< on the device
  BlockState<Types> trial;                      ///< on the device
  BlockGrains<Types> grains;                    ///< on the device
  int steps;                                    ///< DEM steps
  detail::SmallTensor<Types::dim> strain_step;  ///< displacement gradient of each
};

/// What all tasks of one call have alike.
/// \tparam Types a `BlockTypes`
template <class Types, class Damping>
struct BlockParameters {
  typename Types::Law law;  ///< of the contacts
  Damping damping;          ///< of the grains' motion
  double time_step_share;   ///< of the critical time step
};

/// Where states of packings are and respond by the block program: a card, or the processor in its place. Several
/// threads may call it.
/// \tparam TypesOf a `BlockTypes`
/// \tparam DampingOf a `DampsMotion` that needs no more than the time step
template <class TypesOf, class DampingOf>
class BlockDevice {
 public:
  using Types = TypesOf;                                                     ///< numbers of grains and pairs
  using Damping = DampingOf;                                                 ///< of the grains' motion
  using Grains = Population<typename Types::Shape, typename Types::Scalar>;  ///< of a packing
  using Header = BlockHeader<Types::dim>;                                    ///< comes back from a response
  using Bytes = std::shared_ptr<std::byte>;                                  ///< memory on the device

  std::once_flag compared;  ///< set when a response of the device has been compared with the processor's

  virtual ~BlockDevice() = default;
  /// Whether it responds to many tasks in the time of one, so that all points are to come in one call.
  virtual bool takes_many() const = 0;
  /// Rows of a state for so many grains and near pairs, with room for a longer list; it follows from these two numbers
  /// alone. Nothing for more than there is room for.
  virtual std::optional<BlockSize> room(int grains, int pairs) const = 0;
  virtual std::size_t free_bytes() const = 0;                              ///< That states may still have.
  virtual Bytes allocate(std::size_t bytes) = 0;                           ///< \throws std::bad_alloc
  virtual void write(std::span<std::byte const> from, std::byte* to) = 0;  ///< Copies to the device.
  virtual void read(std::byte const* from, std::span<std::byte> to) = 0;   ///< Copies from the device.
  /// What never changes of grains, on the device from now on.
  virtual BlockGrains<Types> grains(std::shared_ptr<Grains const> const& population) = 0;
  /// Trial states of all tasks. headers: theirs, one for each task
  virtual void respond(std::span<BlockTask<Types> const> tasks, BlockParameters<Types, Damping> const& parameters,
                       std::span<Header> headers) = 0;
};

/// Packings respond on the processor instead of a card: the calling thread runs the block program.
template <class Types, class Damping>
class ProcessorDevice final : public BlockDevice<Types, Damping> {
  using Base = BlockDevice<Types, Damping>;
  using Memory = AlignedVector<std::byte>;

 public:
  bool takes_many() const override { return false; }
  std::optional<BlockSize> room(int grains, int pairs) const override {
    constexpr int row = 8;
    auto const rounded_up = [](int number) { return (number + row - 1) / row * row; };
    if (grains > most_grains<Types> || pairs > most_pairs) return std::nullopt;
    return BlockSize{rounded_up(grains), std::min(rounded_up(std::max(pairs + pairs / 4, 2 * grains)), most_pairs)};
  }
  std::size_t free_bytes() const override { return std::numeric_limits<std::size_t>::max(); }
  typename Base::Bytes allocate(std::size_t bytes) override {
    auto memory = std::make_shared<Memory>(bytes);
    return {memory, memory->data()};
  }
  void write(std::span<std::byte const> from, std::byte* to) override { std::memcpy(to, from.data(), from.size()); }
  void read(std::byte const* from, std::span<std::byte> to) override { std::memcpy(to.data(), from, to.size()); }
  /// Views of the population itself.
  BlockGrains<Types> grains(std::shared_ptr<typename Base::Grains const> const& population) override {
    return block_grains<typename Types::Shape, typename Types::Law>(*population);
  }
  /// One task after the other.
  void respond(std::span<BlockTask<Types> const> tasks, BlockParameters<Types, Damping> const& parameters,
               std::span<typename Base::Header> headers) override {
    thread_local Memory bench;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      InterruptionCheck::run();
      auto const& task = tasks[k];
      bench.resize(BlockBench<Types, HostMemory>::bytes(task.trial.size));
      OneThread const alone{bench.data()};
      BlockProgram<Types, Damping, OneThread> program(alone, task.trial.size, task.grains, parameters.law,
                                                      parameters.damping, parameters.time_step_share);
      program.respond(task.committed, task.trial, task.steps, task.strain_step);
      headers[k] = *task.trial.header;
    }
  }
};

}  // namespace scarp
