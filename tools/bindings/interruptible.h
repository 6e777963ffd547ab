// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Long work called from Python: other Python threads go on, and Ctrl-C stops it.

#include <pybind11/pybind11.h>

#include <exception>
#include <functional>
#include <future>
#include <optional>

#include "sim/core/process/parallel.h"

namespace seaglint {

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
