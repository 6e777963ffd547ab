// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Parallel loops over independent indices. Results do not depend on the number of threads: each index writes its own
// element.

#include <atomic>
#include <cstddef>
#include <functional>

namespace seaglint {

// Set by Ctrl-C (tools), polled by long computations.
using StopFlag = std::atomic<bool>;

// Number of threads to use for a request: 0 means all processors. At least 1.
int thread_count(int requested);

// Calls body(i) for every i in [0, count), on at most `threads` threads; indices are assigned in order.
// The exception of the lowest failing index is rethrown after all threads have stopped. Throws Interrupted when *stop
// becomes true.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body,
                  const StopFlag* stop = nullptr);

}  // namespace seaglint
