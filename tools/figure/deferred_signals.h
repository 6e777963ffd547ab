// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Defers Ctrl-C while a child process or temporary files exist, until they have ended or are removed.

namespace seaglint {

// While an object of this type exists, on any thread, SIGINT and SIGTERM are only recorded. The destructor of the last
// one restores the previous handlers and raises a recorded signal again. A signal that was ignored stays ignored.
class DeferredSignals {
 public:
  DeferredSignals();
  ~DeferredSignals();
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;

  // True if a signal was recorded since the oldest existing object was constructed: stop, clean up, throw Interrupted.
  static bool pending();
};

}  // namespace seaglint
