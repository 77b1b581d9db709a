// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>

#include "scarp/core/interruption.hpp"

namespace python_points {

namespace py = pybind11;

/// Ends long work by the exception of Python's signal handlers (Ctrl-C), which run where this was made: on Python's
/// main thread.
class Signals {
 public:
  /// Runs the handlers every now and then. \throws py::error_already_set once one of them has failed
  void look() {
    if (is_over_) std::rethrow_exception(failure_);
    auto const moment = std::chrono::steady_clock::now();
    if (std::this_thread::get_id() != owner_ || moment < next_) return;
    next_ = moment + std::chrono::milliseconds(100);
    py::gil_scoped_acquire const acquire;
    if (PyErr_CheckSignals() == 0) return;
    failure_ = std::make_exception_ptr(py::error_already_set());
    is_over_ = true;
    std::rethrow_exception(failure_);
  }

 private:
  std::thread::id owner_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point next_{};
  std::exception_ptr failure_;
  std::atomic<bool> is_over_ = false;
  std::function<void()> const look_ = [this] { look(); };
  scarp::InterruptionCheck const check_{&look_};
};

/// Calls work without the interpreter's lock, while Ctrl-C ends it.
template <class Work>
auto interruptible(Work const& work) {
  py::gil_scoped_release const release;
  Signals signals;
  return work();
}

}  // namespace python_points
