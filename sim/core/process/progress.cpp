// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace seaglint {

namespace {

constexpr std::chrono::seconds kQuiet{2};          // shorter work shows nothing
constexpr std::chrono::milliseconds kRedraw{200};  // redraw interval
constexpr std::chrono::minutes kLogged{1};         // from line to line where standard error is no terminal
constexpr double kForecastAfter_s = 1;             // steps are timed for so long
constexpr double kLeastForecast_s = 10;            // shorter work is not announced

std::string duration(double seconds) {
  const auto s = static_cast<long>(std::ceil(std::min(seconds, 1e9)));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

// In the digits that an estimate has.
std::string about(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", 5 * std::round(seconds / 5));
  if (seconds < 100 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string forecast_line(const std::string& steps, std::size_t done, std::size_t total, double elapsed_s,
                          int threads) {
  const double seconds = elapsed_s * static_cast<double>(total) / static_cast<double>(done);
  if (seconds < kLeastForecast_s) return "";
  return fmt::format("about {} for {} {} on {} thread{}", about(seconds), total, steps, threads,
                     threads == 1 ? "" : "s");
}

std::string progress_line(const std::string& what, std::size_t done, std::size_t total, double elapsed_s,
                          const std::string& steps) {
  constexpr std::size_t kWidth = 20;
  const double fraction = total == 0 ? 1 : std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
  const auto filled = static_cast<std::size_t>(fraction * kWidth);
  const std::string left = fraction > 0 ? duration(elapsed_s * (1 - fraction) / fraction) + " left" : "no estimate yet";
  const std::string rate = steps.empty() || done == 0
                               ? std::string()
                               : fmt::format(", {:.3g} {}/s", static_cast<double>(done) / elapsed_s, steps);
  return fmt::format("{}  [{}{}] {:3.0f} %, {}{}", what, std::string(filled, '#'), std::string(kWidth - filled, '.'),
                     std::floor(100 * fraction), left, rate);
}

Progress::Progress(std::string what, std::size_t total, std::string steps)
    : what_(std::move(what)),
      steps_(std::move(steps)),
      total_(total),
      start_(std::chrono::steady_clock::now()),
      terminal_(::isatty(STDERR_FILENO) == 1) {
  next_draw_ = terminal_ ? start_ + kQuiet : start_ + kLogged;
}

Progress::~Progress() {
  if (shown_) {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
  }
}

void Progress::announce(std::size_t first, int threads, std::function<void(const std::string&)> say) {
  first_ = first;
  threads_ = threads;
  announces_ = say != nullptr;
  say_ = std::move(say);
}

void Progress::announce_when_due(std::size_t done) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock || !say_ || done < first_ || 2 * done > total_) return;
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (elapsed_s < kForecastAfter_s) return;
  const std::string line = forecast_line(steps_, done, total_, elapsed_s, threads_);
  if (line.empty()) return;
  if (shown_) std::fputs("\r\033[K", stderr);
  say_(line);
  say_ = nullptr;
  announces_ = false;
}

void Progress::advance(std::size_t steps) {
  const std::size_t done = done_ += steps;
  if (announces_) announce_when_due(done);
  // Skips drawing when another thread is drawing.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  const auto now = std::chrono::steady_clock::now();
  if (!lock || now < next_draw_) return;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const std::string line = progress_line(what_, done, total_, elapsed_s, steps_);
  next_draw_ = terminal_ ? now + kRedraw : now + kLogged;
  shown_ = terminal_;
  std::fputs((terminal_ ? "\r" + line + "\033[K" : line + "\n").c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace seaglint
