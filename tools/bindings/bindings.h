// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The Python module seaglint._core: its parts, NumPy arrays, interruptible work; the package beside it gives these
// functions their names, checks and documentation (tools/bindings/seaglint).

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim/core/process/parallel.h"

namespace seaglint {

void bind_rcs(pybind11::module_& module);    // RcsRequest, rcs; Exports, compare
void bind_scene(pybind11::module_& module);  // Pipeline; sea, motion

// Vectors as NumPy arrays without a copy.

// The array owns the values; their number is the product of the shape.
template <class T>
pybind11::array_t<T> array_of(std::vector<T>&& values, std::vector<pybind11::ssize_t> shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  T* data = owned->data();
  const pybind11::capsule owner(owned.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return pybind11::array_t<T>(std::move(shape), data, owner);
}

template <class T>
pybind11::array_t<T> array_of(std::vector<T>&& values) {
  const auto count = static_cast<pybind11::ssize_t>(values.size());
  return array_of(std::move(values), {count});
}

template <class T>
pybind11::array_t<T> copy_of(const std::vector<T>& values) {
  return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

// Long work called from Python: other Python threads go on, and Ctrl-C stops it.

// Calls work(stop) in a thread of its own without Python's lock and waits for its end; sets `stop` as soon as a signal
// of Python is pending, whose exception (KeyboardInterrupt) is then thrown. Exceptions of the work propagate.
template <class Result>
Result interruptible(const std::function<Result(const StopFlag&)>& work) {
  StopFlag stop{false};
  std::future<Result> result = std::async(std::launch::async, [&] { return work(stop); });
  std::optional<pybind11::error_already_set> signal;
  while (true) {
    {
      const pybind11::gil_scoped_release release;
      if (result.wait_for(std::chrono::milliseconds(20)) == std::future_status::ready) break;
    }
    if (!signal && PyErr_CheckSignals() != 0) {
      signal.emplace();  // thrown below, once the work has ended
      stop = true;
    }
  }
  if (signal) {
    try {
      result.get();
    } catch (const std::exception&) {  // Interrupted
    }
    throw *signal;
  }
  return result.get();
}

}  // namespace seaglint
