// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "scarp/core/error.hpp"

namespace scarp {

namespace detail {

/// How a value that processes share is sent: as its bytes, where it may be copied so.
template <class Value>
struct LyingInMemory {
  static_assert(std::is_trivially_copyable_v<Value>, "scarp: values that ranks share are copied byte by byte");
  static constexpr std::size_t size = sizeof(Value);
  static void write(Value const& value, std::byte* to) { std::memcpy(to, &value, size); }
  static void read(std::byte const* from, Value& value) { std::memcpy(&value, from, size); }
};

}  // namespace detail

/// Runs tasks. This class is one process; an heir such as `RankExecutor` is one of several that run the same program,
/// each of which owns some of the material points. All of them must call together(), agree(), on_first() and share()
/// alike.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Calls task(i) once for every i in [0, count), in any order, perhaps at the same time.
  virtual void for_each(int count, std::function<void(int)> const& task) const = 0;

  virtual int ranks() const { return 1; }                                     ///< Number of processes.
  virtual int rank() const { return 0; }                                      ///< Number of this process, from zero.
  virtual int threads() const { return 1; }                                   ///< Threads of this process.
  virtual bool owns(int point) const { return point % ranks() == rank(); }    ///< Whether this process has a point.
  virtual void together(std::function<void()> const& work) const { work(); }  ///< What it throws is thrown on all.
  virtual bool agree(bool flag) const { return flag; }                        ///< \return the first process' flag

  /// The first process does a task, which may fetch points; the others serve meanwhile: bytes_of(point) returns the
  /// bytes. What one of them throws ends the work of all.
  virtual void on_first(std::function<void()> const& task, std::function<std::string(int)> const&) const { task(); }

  /// On the first process, within on_first(): what the owner of a point returns.
  /// \throws InputError with the owner's words where it could not
  virtual std::string fetch(int point) const {
    reject("the state of point {} is requested from another process (this is the only one): take it from the points",
           point);
  }

  /// Completes an array over all points of which every process has the entries of its own.
  template <class Value>
  void share(std::vector<Value>& values) const {
    if (ranks() == 1) return;
    using Lying = detail::LyingInMemory<Value>;
    exchange({values.size(), Lying::size, [&](std::size_t k, std::byte* to) { Lying::write(values[k], to); },
              [&](std::size_t k, std::byte const* from) { Lying::read(from, values[k]); }});
  }

 protected:
  /// An array over all points as bytes.
  struct Shared {
    std::size_t count;                                        ///< of the entries
    std::size_t bytes;                                        ///< of an entry
    std::function<void(std::size_t, std::byte*)> write;       ///< an entry
    std::function<void(std::size_t, std::byte const*)> read;  ///< an entry
  };
  /// Sends the entries of own points, receives those of others.
  virtual void exchange(Shared const&) const {
    reject("values of points of other processes are needed (this executor exchanges none): let it override exchange");
  }
};

/// One task after the other on the calling thread.
class SerialExecutor : public Executor {
 public:
  /// Calls task(i) for i from 0 to count - 1, in this order.
  void for_each(int count, std::function<void(int)> const& task) const override {
    for (int i = 0; i < count; ++i) task(i);
  }
};

}  // namespace scarp
