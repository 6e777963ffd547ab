// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/deferred_signals.h"

#include <signal.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>

namespace seaglint {
namespace {

constexpr std::array kHeld{SIGINT, SIGTERM};

// Signal handlers can access static storage only.
std::atomic<int> noted_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void note(int signal) { noted_signal = signal; }

// Number of DeferredSignals objects, and the previous handlers.
struct Holding {
  std::mutex mutex;
  int holders = 0;
  std::array<struct sigaction, kHeld.size()> before{};
};

Holding& holding() {
  static Holding all;
  return all;
}

}  // namespace

DeferredSignals::DeferredSignals() {
  Holding& all = holding();
  const std::lock_guard lock(all.mutex);
  if (all.holders++ > 0) return;
  noted_signal = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < kHeld.size(); ++i) {
    sigaction(kHeld[i], nullptr, &all.before[i]);
    if (all.before[i].sa_handler != SIG_IGN) sigaction(kHeld[i], &action, nullptr);
  }
}

DeferredSignals::~DeferredSignals() {
  Holding& all = holding();
  const std::lock_guard lock(all.mutex);
  if (--all.holders > 0) return;
  for (std::size_t i = 0; i < kHeld.size(); ++i) sigaction(kHeld[i], &all.before[i], nullptr);
  if (noted_signal != 0) raise(noted_signal);
}

bool DeferredSignals::pending() { return noted_signal != 0; }

}  // namespace seaglint
