// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Ctrl-C while files lie about that only this process knows of: it waits until they are gone.

namespace seaglint {

// While one of these lives, on any thread, SIGINT and SIGTERM are noted and do nothing else. When the last one goes,
// what was in force before is in force again, and a signal that was noted is sent anew. A signal that is ignored stays
// so.
class DeferredSignals {
 public:
  DeferredSignals();
  ~DeferredSignals();
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;

  // One has come since the first of those that live now began: stop, clean up, throw Interrupted.
  static bool pending();
};

}  // namespace seaglint
