// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Parallel loops over independent indices, and functions for several kinds of processor. Results do not depend on the
// number of threads, since each index writes its own element, nor on the processor.

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

// SEAGLINT_FUNCTION_VERSIONS("avx2", "default") before a function: it is also compiled for the processors named, one of
// which is selected at program start. Without contraction (-ffp-contract=off) all versions give the same bits as long
// as lanes are independent.
//
// Empty where the selection is missing or wrong: on other machines; with clang, which takes "arch=x86-64-v3" and then
// tests the processor's vendor (releases 14 and 16); under sanitizers, whose run-time library starts after the
// selection.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SEAGLINT_FUNCTION_VERSIONS(...) __attribute__((target_clones(__VA_ARGS__)))
#else
#define SEAGLINT_FUNCTION_VERSIONS(...)
#endif
