// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {

int thread_count(int requested) {
  SEAGLINT_CHECK(requested >= 0, fmt::format("{} threads requested", requested));
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body, const StopFlag* stop) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::atomic<bool> interrupted{false};
  std::mutex mutex;
  std::size_t failed_index = count;
  std::exception_ptr failure;

  // Indices are assigned in order, so every index below a failing one has been started and is completed: the lowest
  // failure does not depend on the number of threads.
  const auto work = [&] {
    while (!failed) {
      const std::size_t i = next++;
      if (i >= count) return;
      if (stop != nullptr && *stop) {
        interrupted = true;
        return;
      }
      try {
        body(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (i < failed_index) {
          failed_index = i;
          failure = std::current_exception();
        }
        failed = true;
      }
    }
  };

  // The calling thread is one of them; if the system cannot start more, the started ones do the work.
  const std::size_t helpers = std::min(count, static_cast<std::size_t>(thread_count(threads))) - (count > 0 ? 1 : 0);
  std::vector<std::thread> pool;
  pool.reserve(helpers);
  try {
    while (pool.size() < helpers) pool.emplace_back(work);
  } catch (const std::system_error&) {
  }
  work();
  for (std::thread& thread : pool) thread.join();

  if (interrupted) throw Interrupted();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace seaglint
