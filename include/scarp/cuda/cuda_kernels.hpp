// SPDX-License-Identifier: BSL-1.0
#pragma once

// For the source that nvcc compiles.
#include <cuda_runtime.h>

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/cuda/cuda_device.hpp"
#include "scarp/cuda/cuda_team.hpp"

namespace scarp {

/// A response of a block of threads. Rows are constants, so that every address of shared memory is one.
template <class Types, class Damping, int Threads, int BlocksPerProcessor, int Grains, int Pairs>
__global__ void __launch_bounds__(Threads, BlocksPerProcessor)
    respond_kernel(BlockTask<Types> const* tasks, BlockParameters<Types, Damping> parameters,
                   BlockHeader<Types::dim>* headers) {
  constexpr BlockSize size{Grains, Pairs};
  auto const& task = tasks[blockIdx.x];
  auto const placed = [&](BlockState<Types> const& state) {
    return BlockState<Types>(reinterpret_cast<std::byte*>(state.header), size);
  };
  CudaTeam<Threads> const team;
  BlockProgram<Types, Damping, CudaTeam<Threads>> program(team, size, task.grains, parameters.law, parameters.damping,
                                                          parameters.time_step_share);
  program.respond(placed(task.committed), placed(task.trial), task.steps, task.strain_step);
  if (threadIdx.x == 0) headers[blockIdx.x] = *task.trial.header;
}

namespace detail {

inline void require_cuda(cudaError_t error, char const* what) {
  if (error != cudaSuccess) throw CudaError(std::string(what) + ": " + cudaGetErrorString(error));
}

/// Pieces of memory on a card; what is given back is used again.
class CudaMemory : public std::enable_shared_from_this<CudaMemory> {
 public:
  CudaMemory() = default;
  CudaMemory(CudaMemory const&) = delete;
  CudaMemory& operator=(CudaMemory const&) = delete;
  ~CudaMemory() {
    for (auto const& [bytes, free] : free_) {
      for (void* const at : free) cudaFree(at);
    }
  }

  std::shared_ptr<std::byte> allocate(std::size_t bytes) {
    std::lock_guard const lock(mutex_);
    void* at = nullptr;
    if (auto& free = free_[bytes]; !free.empty()) {
      at = free.back();
      free.pop_back();
    } else {
      require_cuda(cudaMalloc(&at, bytes), "memory for packings on the card (fewer points or grains need less)");
    }
    return {static_cast<std::byte*>(at), [self = shared_from_this(), bytes](std::byte* memory) {
              std::lock_guard const lock(self->mutex_);
              self->free_[bytes].push_back(memory);
            }};
  }

  template <class T>
  std::shared_ptr<std::byte> uploaded(T const* from, std::size_t count) {
    auto memory = allocate(count * sizeof(T));
    copy(from, memory.get(), count * sizeof(T), cudaMemcpyHostToDevice);
    return memory;
  }

  /// Copies in the order of the calling thread, and waits.
  static void copy(void const* from, void* to, std::size_t bytes, cudaMemcpyKind kind) {
    require_cuda(cudaMemcpyAsync(to, from, bytes, kind, cudaStreamPerThread), "copy");
    require_cuda(cudaStreamSynchronize(cudaStreamPerThread), "the card");
  }

 private:
  std::mutex mutex_;
  std::map<std::size_t, std::vector<void*>> free_;
};

}  // namespace detail

/// Packings on a card, with a kernel for each of these rooms, smallest first. Calls of several threads run side by side.
template <class Types, class Damping, BlockSize... Rooms>
class CudaDevice final : public BlockDevice<Types, Damping> {
  using Base = BlockDevice<Types, Damping>;
  using Scalar = typename Types::Scalar;
  static constexpr int threads = 256;
  static constexpr std::size_t shared_memory = 227 * 1024;  ///< of a processor of compute capability 9.0, for blocks

 public:
  /// \throws InputError where there is no such card
  explicit CudaDevice(int number) {
    int count = 0;
    if (auto const error = cudaGetDeviceCount(&count); error != cudaSuccess || number >= count)
      reject("card {} is asked for (there are {}; CUDA says: {}): run without a card, or on a machine with one", number,
             count, cudaGetErrorString(error));
    detail::require_cuda(cudaSetDevice(number), "choice of the card");
  }

  bool takes_many() const override { return true; }

  BlockSize room(int grains, int pairs) const override {
    BlockSize found{};
    for (int const wanted : {pairs + pairs / 8, pairs}) {
      for (BlockSize const size : {Rooms...}) {
        if (found.grains == 0 && grains <= size.grains && wanted <= size.pairs) found = size;
      }
    }
    if (found.grains == 0)
      reject("a packing has {} grains and {} near pairs (no kernel has that room): add one to SCARP_CUDA_DEVICE",
             grains, pairs);
    return found;
  }

  std::size_t free_bytes() const override {
    std::size_t free = 0, all = 0;
    detail::require_cuda(cudaMemGetInfo(&free, &all), "memory of the card");
    return free;
  }
  typename Base::Bytes allocate(std::size_t bytes) override { return memory_->allocate(bytes); }
  void write(std::span<std::byte const> from, std::byte* to) override {
    detail::CudaMemory::copy(from.data(), to, from.size(), cudaMemcpyHostToDevice);
  }
  void read(std::byte const* from, std::span<std::byte> to) override {
    detail::CudaMemory::copy(from, to.data(), to.size(), cudaMemcpyDeviceToHost);
  }

  BlockGrains<Types> grains(std::shared_ptr<typename Base::Grains const> const& population) override {
    std::lock_guard const lock(mutex_);
    auto const known = grains_.find(population);
    if (known != grains_.end()) return known->second.view;
    auto view = block_grains<typename Types::Shape, typename Types::Law>(*population);
    auto const stride = static_cast<std::size_t>(view.stride);
    Uploaded made{{memory_->uploaded(view.size, static_cast<std::size_t>(Types::sizes) * stride),
                   memory_->uploaded(view.inverse_mass, stride), memory_->uploaded(view.inverse_inertia, stride),
                   memory_->uploaded(view.bounding_radius, population->count())},
                  view};
    made.view.size = reinterpret_cast<Scalar const*>(made.arrays[0].get());
    made.view.inverse_mass = reinterpret_cast<Scalar const*>(made.arrays[1].get());
    made.view.inverse_inertia = reinterpret_cast<Scalar const*>(made.arrays[2].get());
    made.view.bounding_radius = reinterpret_cast<double const*>(made.arrays[3].get());
    return grains_.emplace(population, std::move(made)).first->second.view;
  }

  void respond(std::span<BlockTask<Types> const> tasks, BlockParameters<Types, Damping> const& parameters,
               std::span<typename Base::Header> headers) override {
    (respond_in<Rooms>(tasks, parameters, headers), ...);
  }

 private:
  /// What never changes of grains, on the card.
  struct Uploaded {
    std::vector<std::shared_ptr<std::byte>> arrays;
    BlockGrains<Types> view;
  };

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
    constexpr std::size_t shared = BlockBench<Types, SharedMemory>::bytes(Room);
    static_assert(shared <= shared_memory, "scarp: this room is too large for the shared memory of a block");
    constexpr int blocks = 2 * (shared + 5 * 1024) <= shared_memory ? 2 : 1;  // with what the team itself shares
    auto* const kernel = respond_kernel<Types, Damping, threads, blocks, Room.grains, Room.pairs>;
    detail::require_cuda(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, shared),
                         "shared memory of the kernel");
    auto const on_card = memory_->uploaded(own.data(), own.size());
    auto const reports = memory_->allocate(own.size() * sizeof(Header));
    kernel<<<static_cast<unsigned>(own.size()), threads, shared, cudaStreamPerThread>>>(
        reinterpret_cast<BlockTask<Types> const*>(on_card.get()), parameters, reinterpret_cast<Header*>(reports.get()));
    detail::require_cuda(cudaGetLastError(), "start of the kernel");
    std::vector<Header> found(own.size());
    detail::CudaMemory::copy(reports.get(), found.data(), found.size() * sizeof(Header), cudaMemcpyDeviceToHost);
    for (std::size_t k = 0; k < found.size(); ++k) headers[numbers[k]] = found[k];
  }

  std::mutex mutex_;
  std::shared_ptr<detail::CudaMemory> memory_ = std::make_shared<detail::CudaMemory>();
  std::map<std::shared_ptr<typename Base::Grains const>, Uploaded> grains_;
};

}  // namespace scarp

/// In the source that nvcc compiles: defines `cuda_device<TYPES, DAMPING>` with kernels for rooms, smallest first, such as
/// \code
/// SCARP_CUDA_DEVICE(Types, scarp::LocalDamping, {100, 304}, {400, 1216})
/// \endcode
#define SCARP_CUDA_DEVICE(TYPES, DAMPING, ...)                                                         \
  template <>                                                                                          \
  std::shared_ptr<scarp::BlockDevice<TYPES, DAMPING>> scarp::cuda_device<TYPES, DAMPING>(int number) { \
    return std::make_shared<scarp::CudaDevice<TYPES, DAMPING, __VA_ARGS__>>(number);                   \
  }
