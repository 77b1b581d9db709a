// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "scarp/core/error.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp_points.h"

namespace points_library {

/// A number that no object of any kind has had before.
inline std::uintptr_t new_number() {
  static std::atomic<std::uintptr_t> last = 0;
  return last += 16;
}

/// Objects behind opaque pointers, which are numbers: one that was freed, or is of another kind, is rejected.
template <class Object>
class Handles {
 public:
  explicit Handles(std::string_view kind) : kind_(kind) {}

  void* add(std::shared_ptr<Object> object) {
    std::lock_guard const lock(mutex_);
    auto const number = new_number();
    objects_.emplace(number, std::move(object));
    return reinterpret_cast<void*>(number);  // NOLINT: never followed
  }

  /// \throws InputError for a handle that is null, was freed or never made
  std::shared_ptr<Object> at(void const* handle) const {
    std::lock_guard const lock(mutex_);
    auto const found = objects_.find(reinterpret_cast<std::uintptr_t>(handle));
    if (found == objects_.end()) reject_freed(handle);
    return found->second;
  }

  void remove(void const* handle) {
    std::lock_guard const lock(mutex_);
    if (objects_.erase(reinterpret_cast<std::uintptr_t>(handle)) == 0) reject_freed(handle);
  }

 private:
  [[noreturn]] void reject_freed(void const* handle) const {
    if (!handle) scarp::reject("the handle of {} is null (a handle is expected): make it first", kind_);
    scarp::reject("the handle of {} is not alive (it was freed, or is no such handle): make another one", kind_);
  }

  std::string_view kind_;
  mutable std::mutex mutex_;
  std::map<std::uintptr_t, std::shared_ptr<Object>> objects_;
};

/// What scarp_last_error returns on this thread.
inline std::string& last_error() {
  thread_local std::string text;
  return text;
}

/// The status of work, which returns one of its own or nothing; no exception leaves it.
template <class Work>
int guarded(Work const& work) noexcept {
  try {
    try {
      if constexpr (std::is_void_v<decltype(work())>) {
        work();
        return SCARP_DONE;
      } else {
        return work();
      }
    } catch (scarp::InputError const& error) {
      last_error() = error.what();
      return SCARP_WRONG_INPUT;
    } catch (scarp::FileError const& error) {
      last_error() = error.what();
      return SCARP_FILE_ERROR;
    } catch (std::bad_alloc const& error) {
      last_error() = fmt::format("the work was not done ({}): free memory or use fewer threads", error.what());
    } catch (std::exception const& error) {
      last_error() = error.what();
    } catch (...) {
      last_error() = "the work was not done (for an unknown reason): report what led to it";
    }
  } catch (...) {  // no memory for the text: the last one stays
  }
  return SCARP_FAILURE;
}

/// \throws InputError for a null pointer
template <class T>
T* given(T* pointer, std::string_view what) {
  if (!pointer) scarp::reject("{} is null (an address is expected): give one", what);
  return pointer;
}

}  // namespace points_library
