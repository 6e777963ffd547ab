// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/trial_time.h"

#include <pthread.h>
#include <time.h>

#include <chrono>

namespace seaglint {

namespace {

double seconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double thread_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

TimeLimit::TimeLimit(double processor_s, const StopFlag* outer) {
  clockid_t clock = CLOCK_PROCESS_CPUTIME_ID;
  pthread_getcpuclockid(pthread_self(), &clock);
  const double end_s = seconds_of(clock) + processor_s;
  over_ = processor_s <= 0 || (outer != nullptr && *outer);
  watch_ = std::thread([this, clock, end_s, outer] {
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, std::chrono::milliseconds(20), [this] { return is_ended_; })) {
      if (seconds_of(clock) >= end_s || (outer != nullptr && *outer)) {
        over_ = true;
        return;
      }
    }
  });
}

TimeLimit::~TimeLimit() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  ended_.notify_all();
  watch_.join();
}

}  // namespace seaglint
