// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Processor time of trial maps, and its limit.

#include <condition_variable>
#include <mutex>
#include <thread>

#include "sim/core/process/parallel.h"

namespace seaglint {

// Processor time of the calling thread, s.
double thread_seconds();

// A flag that becomes true when the thread that makes the limit has used `processor_s` more seconds of processor time,
// or when *outer becomes true.
class TimeLimit {
 public:
  TimeLimit(double processor_s, const StopFlag* outer);
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  ~TimeLimit();

  const StopFlag* flag() const { return &over_; }

 private:
  StopFlag over_{false};
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_ended_ = false;
  std::thread watch_;
};

}  // namespace seaglint
