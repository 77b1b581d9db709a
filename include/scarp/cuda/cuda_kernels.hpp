// SPDX-License-Identifier: BSL-1.0
#pragma once

// For the source that nvcc compiles.
#include <cuda_runtime.h>

#include <bit>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/cuda/cuda_device.hpp"
#include "scarp/cuda/cuda_team.hpp"

namespace scarp {

namespace detail {

/// A response of a block of threads. Rows are constants, so that every address of shared memory is one.
template <class Types, class Damping, int Threads, int BlocksPerProcessor, int Grains, int Pairs>
__global__ void __launch_bounds__(Threads, BlocksPerProcessor)
    respond_kernel(BlockTask<Types> const* tasks, BlockParameters<Types, Damping> parameters,
                   BlockHeader<Types::dim>* headers) {
  constexpr BlockSize size{Grains, Pairs};
  auto const& task = tasks[blockIdx.x];
  BlockState<Types> const trial(reinterpret_cast<std::byte*>(task.trial.header), size);
  CudaTeam<Threads> const team;
  BlockProgram<Types, Damping, CudaTeam<Threads>> program(team, size, task.grains, parameters.law, parameters.damping,
                                                          parameters.time_step_share);
  program.respond(task.committed, trial, task.steps, task.strain_step);
  if (threadIdx.x == 0) headers[blockIdx.x] = *task.trial.header;
}

inline void require_cuda(cudaError_t error, char const* what) {
  if (error == cudaSuccess) return;
  cudaGetLastError();  // else the next launch would report it again
  throw CudaError(std::string(what) + ": " + cudaGetErrorString(error));
}

/// Pieces of memory on a card; what is given back is used again.
class CudaMemory : public std::enable_shared_from_this<CudaMemory> {
 public:
  CudaMemory() = default;
  CudaMemory(CudaMemory const&) = delete;
  CudaMemory& operator=(CudaMemory const&) = delete;
  ~CudaMemory() { give_back(); }

  std::shared_ptr<std::byte> allocate(std::size_t bytes) {
    std::lock_guard const lock(mutex_);
    void* at = nullptr;
    if (auto& free = free_[bytes]; !free.empty()) {
      at = free.back();
      free.pop_back();
    } else if (cudaMalloc(&at, bytes) != cudaSuccess) {
      cudaGetLastError();
      give_back();
      require_cuda(cudaMalloc(&at, bytes), "memory for packings on the card (fewer points or grains need less)");
    }
    return {static_cast<std::byte*>(at), [self = shared_from_this(), bytes](std::byte* memory) {
              std::lock_guard const held(self->mutex_);
              self->free_[bytes].push_back(memory);
            }};
  }
  /// A piece of a size that others have too, for what has another size in each call.
  std::shared_ptr<std::byte> scratch(std::size_t bytes) { return allocate(std::bit_ceil(bytes)); }

  template <class T>
  std::shared_ptr<std::byte> uploaded(T const* from, std::size_t count) {
    auto memory = scratch(count * sizeof(T));
    copy(from, memory.get(), count * sizeof(T), cudaMemcpyHostToDevice);
    return memory;
  }

  /// Copies in the order of the calling thread, and waits.
  static void copy(void const* from, void* to, std::size_t bytes, cudaMemcpyKind kind) {
    require_cuda(cudaMemcpyAsync(to, from, bytes, kind, cudaStreamPerThread), "copy");
    require_cuda(cudaStreamSynchronize(cudaStreamPerThread), "the card");
  }

 private:
  void give_back() {
    for (auto& [bytes, free] : free_) {
      for (void* const at : free) cudaFree(at);
      free.clear();
    }
  }

  std::mutex mutex_;
  std::map<std::size_t, std::vector<void*>> free_;
};

}  // namespace detail

/// Packings on a card, with a kernel for each of these rooms, smallest first. Calls of several threads run side by
/// side.
template <class Types, class Damping, BlockSize... Rooms>
class CudaDevice final : public BlockDevice<Types, Damping> {
  using Base = BlockDevice<Types, Damping>;
  using Scalar = typename Types::Scalar;
  static constexpr int threads = 256;
  template <BlockSize Room>
  static constexpr std::size_t shared = BlockBench<Types, SharedMemory>::bytes(Room);  ///< of a block [bytes]
  static constexpr std::size_t most_shared = 227 * 1024;  ///< of a multiprocessor of compute capability 9.0 [bytes]
  static constexpr std::size_t of_team = 5 * 1024;        ///< at most, beside the packing [bytes]
  template <BlockSize Room>
  static constexpr int blocks = 2 * (shared<Room> + of_team) <= most_shared ? 2 : 1;  ///< on a multiprocessor
  template <BlockSize Room>
  static constexpr auto kernel = detail::respond_kernel<Types, Damping, threads, blocks<Room>, Room.grains, Room.pairs>;
  static_assert(((shared<Rooms> + of_team <= most_shared) && ...),
                "scarp: a room is too large for the shared memory of a block");
  static_assert(((Rooms.grains <= most_grains<Types> && Rooms.pairs <= most_pairs) && ...),
                "scarp: a room has more grains or pairs than their numbers of 16 bits");

 public:
  /// \throws InputError where there is no such card, and for one that cannot run the kernels
  explicit CudaDevice(int number) : number_(number) {
    int count = 0;
    if (auto const error = cudaGetDeviceCount(&count); error != cudaSuccess || number < 0 || number >= count)
      reject("card {} is asked for (there are {}; CUDA says: {}): run without a card, or on a machine with one", number,
             count, cudaGetErrorString(error));
    choose();
    (prepare<Rooms>(), ...);
  }

  bool takes_many() const override { return true; }

  std::optional<BlockSize> room(int grains, int pairs) const override {
    for (int const wanted : {pairs + pairs / 8, pairs}) {
      for (BlockSize const size : {Rooms...}) {
        if (grains <= size.grains && wanted <= size.pairs) return size;
      }
    }
    return std::nullopt;
  }

  std::size_t free_bytes() const override {
    choose();
    std::size_t free = 0, all = 0;
    detail::require_cuda(cudaMemGetInfo(&free, &all), "memory of the card");
    return free;
  }
  typename Base::Bytes allocate(std::size_t bytes) override {
    choose();
    return memory_->allocate(bytes);
  }
  void write(std::span<std::byte const> from, std::byte* to) override {
    choose();
    detail::CudaMemory::copy(from.data(), to, from.size(), cudaMemcpyHostToDevice);
  }
  void read(std::byte const* from, std::span<std::byte> to) override {
    choose();
    detail::CudaMemory::copy(from, to.data(), to.size(), cudaMemcpyDeviceToHost);
  }

  /// Uploads them once; they are forgotten with the population.
  BlockGrains<Types> grains(std::shared_ptr<typename Base::Grains const> const& population) override {
    std::lock_guard const lock(mutex_);
    if (auto const known = grains_.find(population.get());
        known != grains_.end() && known->second.owner.lock() == population)
      return known->second.view;
    std::erase_if(grains_, [](auto const& one) { return one.second.owner.expired(); });
    choose();
    auto view = block_grains<typename Types::Shape, typename Types::Law>(*population);
    auto const stride = static_cast<std::size_t>(view.stride);
    Uploaded made{population,
                  {memory_->uploaded(view.size, static_cast<std::size_t>(Types::sizes) * stride),
                   memory_->uploaded(view.inverse_mass, stride), memory_->uploaded(view.inverse_inertia, stride),
                   memory_->uploaded(view.bounding_radius, population->count())},
                  view};
    made.view.size = reinterpret_cast<Scalar const*>(made.arrays[0].get());
    made.view.inverse_mass = reinterpret_cast<Scalar const*>(made.arrays[1].get());
    made.view.inverse_inertia = reinterpret_cast<Scalar const*>(made.arrays[2].get());
    made.view.bounding_radius = reinterpret_cast<double const*>(made.arrays[3].get());
    return grains_.insert_or_assign(population.get(), std::move(made)).first->second.view;
  }

  /// A block of threads for each task, a launch for each room.
  void respond(std::span<BlockTask<Types> const> tasks, BlockParameters<Types, Damping> const& parameters,
               std::span<typename Base::Header> headers) override {
    choose();
    (respond_in<Rooms>(tasks, parameters, headers), ...);
  }

 private:
  /// What never changes of grains, on the card.
  struct Uploaded {
    std::weak_ptr<typename Base::Grains const> owner;
    std::vector<std::shared_ptr<std::byte>> arrays;
    BlockGrains<Types> view;
  };

  /// For the calling thread: each has a card of its own choice.
  void choose() const { detail::require_cuda(cudaSetDevice(number_), "choice of the card"); }

  template <BlockSize Room>
  void prepare() {
    auto const bytes = static_cast<int>(shared<Room>);
    if (auto const error = cudaFuncSetAttribute(kernel<Room>, cudaFuncAttributeMaxDynamicSharedMemorySize, bytes);
        error != cudaSuccess)
      reject(
          "card {} cannot run the kernel of {} grains (it needs {} bytes of shared memory; CUDA says: {}): compile for "
          "this card (CMAKE_CUDA_ARCHITECTURES), or leave that room out",
          number_, Room.grains, bytes, cudaGetErrorString(error));
  }

  template <BlockSize Room>
  void respond_in(std::span<BlockTask<Types> const> tasks, BlockParameters<Types, Damping> const& parameters,
                  std::span<typename Base::Header> headers) {
    using Header = typename Base::Header;
    std::vector<BlockTask<Types>> own;
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      if (tasks[k].trial.size.grains != Room.grains || tasks[k].trial.size.pairs != Room.pairs) continue;
      own.push_back(tasks[k]);
      numbers.push_back(k);
    }
    if (own.empty()) return;
    InterruptionCheck::run();
    auto const on_card = memory_->uploaded(own.data(), own.size());
    auto const reports = memory_->scratch(own.size() * sizeof(Header));
    kernel<Room><<<static_cast<unsigned>(own.size()), threads, shared<Room>, cudaStreamPerThread>>>(
        reinterpret_cast<BlockTask<Types> const*>(on_card.get()), parameters, reinterpret_cast<Header*>(reports.get()));
    detail::require_cuda(cudaGetLastError(), "start of the kernel");
    std::vector<Header> found(own.size());
    detail::CudaMemory::copy(reports.get(), found.data(), found.size() * sizeof(Header), cudaMemcpyDeviceToHost);
    for (std::size_t k = 0; k < found.size(); ++k) headers[numbers[k]] = found[k];
  }

  int number_;
  std::mutex mutex_;
  std::shared_ptr<detail::CudaMemory> memory_ = std::make_shared<detail::CudaMemory>();
  std::map<typename Base::Grains const*, Uploaded> grains_;
};

}  // namespace scarp

/// In the source that nvcc compiles: defines `cuda_device<TYPES, DAMPING>` with kernels for rooms, smallest first, such
/// as
/// \code
/// SCARP_CUDA_DEVICE(Types, scarp::LocalDamping, scarp::BlockSize{100, 336}, scarp::BlockSize{400, 1216})
/// \endcode
#define SCARP_CUDA_DEVICE(TYPES, DAMPING, ...)                                                         \
  template <>                                                                                          \
  std::shared_ptr<scarp::BlockDevice<TYPES, DAMPING>> scarp::cuda_device<TYPES, DAMPING>(int number) { \
    return std::make_shared<scarp::CudaDevice<TYPES, DAMPING, __VA_ARGS__>>(number);                   \
  }
