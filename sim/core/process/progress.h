// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Progress with remaining time: on a terminal a bar, for work longer than two seconds; elsewhere a line a minute.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

namespace seaglint {

class Progress {
 public:
  // steps: unit in the rate ("views": 3.1 views/s); empty: no rate.
  Progress(std::string what, std::size_t total, std::string steps = {});
  ~Progress();  // clears the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // say() gets forecast_line() once, when the first steps (those made side by side) and a second have passed, of work
  // whose first half is not over. Before the work.
  void announce(std::size_t first, int threads, std::function<void(const std::string&)> say);

  void advance(std::size_t steps = 1);  // thread-safe

 private:
  void announce_when_due(std::size_t done);

  std::string what_, steps_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_draw_;  // guarded by mutex_, as is shown_
  std::mutex mutex_;
  bool terminal_ = false;
  bool shown_ = false;
  std::size_t first_ = 1;
  int threads_ = 1;
  std::function<void(const std::string&)> say_;  // empty when said; guarded by mutex_
  std::atomic<bool> announces_{false};
};

// "about 12 min for 721 views on 2 threads", by the time of those done; empty if all take less than ten seconds.
// 0 < done <= total.
std::string forecast_line(const std::string& steps, std::size_t done, std::size_t total, double elapsed_s, int threads);

// One line, e.g. "maps  [#######.............]  35 %, 2 min 10 s left", with steps named also ", 3.1 maps/s"; done <=
// total, elapsed_s > 0.
std::string progress_line(const std::string& what, std::size_t done, std::size_t total, double elapsed_s,
                          const std::string& steps = {});

}  // namespace seaglint
