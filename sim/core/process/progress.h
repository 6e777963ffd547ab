// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Progress bar with remaining time, shown on a terminal only and only for work longer than two seconds.

#include <atomic>
#include <chrono>
#include <cstddef>
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

  void advance(std::size_t steps = 1);  // thread-safe

 private:
  std::string what_, steps_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_draw_;  // guarded by mutex_, as is shown_
  std::mutex mutex_;
  bool terminal_ = false;
  bool shown_ = false;
};

// One line, e.g. "maps  [#######.............]  35 %, 2 min 10 s left", with steps named also ", 3.1 maps/s"; done <=
// total, elapsed_s > 0.
std::string progress_line(const std::string& what, std::size_t done, std::size_t total, double elapsed_s,
                          const std::string& steps = {});

}  // namespace seaglint
