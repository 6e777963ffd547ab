// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <sstream>
#include <string_view>
#include <thread>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

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

// Defers Ctrl-C while a child process exists, until it has ended. While an object of this type exists, on any thread,
// SIGINT and SIGTERM are only recorded. The destructor of the last one restores the previous handlers and raises a
// recorded signal again. A signal that was ignored stays ignored.
class DeferredSignals {
 public:
  DeferredSignals();
  ~DeferredSignals();
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;

  // True if a signal was recorded since the oldest existing object was constructed: stop, clean up, throw Interrupted.
  static bool pending();
};

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

namespace fs = std::filesystem;

// A file in memory without a name, for input and output of child processes.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content = {});  // throws WorkError with the system error
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  // At the beginning of the file; closed in child processes unless it is duplicated for them.
  int descriptor() const { return descriptor_; }

  // The whole content; throws WorkError.
  std::string content() const;

 private:
  int descriptor_;
};

[[noreturn]] void fail_in_memory() { throw WorkError(fmt::format("file in memory: {}", std::strerror(errno))); }

// Calls transfer(done), which returns a number of bytes as read() does, until all are transferred.
template <class Transfer>
void transfer_all(std::size_t bytes, Transfer transfer) {
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t count = transfer(done);
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = EIO;
    if (count <= 0) fail_in_memory();
    done += static_cast<std::size_t>(count);
  }
}

MemoryFile::MemoryFile(std::string_view content) : descriptor_(::memfd_create("seaglint", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail_in_memory();
  try {
    transfer_all(content.size(), [&](std::size_t done) {
      return ::pwrite(descriptor_, content.data() + done, content.size() - done, static_cast<off_t>(done));
    });
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::content() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail_in_memory();
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  transfer_all(bytes.size(), [&](std::size_t done) {
    return ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
  });
  return bytes;
}

WorkError cannot_start(int error) {
  return WorkError(
      fmt::format("gnuplot cannot be started ({}): install the package gnuplot-nox", std::strerror(error)));
}

// Waits for a child process and returns its status; Ctrl-C ends it. Throws WorkError.
int wait_for(pid_t child) {
  constexpr std::chrono::milliseconds kLook{5};  // a hundredth of gnuplot's run time
  for (;;) {
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) throw WorkError(fmt::format("gnuplot was lost ({})", std::strerror(errno)));
    if (DeferredSignals::pending()) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(kLook);
  }
}

constexpr int kDataFile = 3;  // the descriptor by which gnuplot reads the data

// The figure that gnuplot draws. Script, data and figure are in memory: gnuplot neither checks its writes, so that a
// figure on a full disk has gaps, nor ends with an error when data cannot be read. Throws WorkError, Interrupted after
// Ctrl-C.
std::string run_gnuplot(const std::string& script, const std::string& data) {
  const MemoryFile commands(script), numbers(data), figure, messages;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // The standard streams first: the files in memory have other numbers, kDataFile perhaps among them.
  posix_spawn_file_actions_adddup2(&actions, commands.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, figure.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.descriptor(), STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&actions, numbers.descriptor(), kDataFile);
  std::string program = "gnuplot", option = "-d", input = "/dev/stdin";  // -d: no start-up files of the user
  char* const arguments[] = {program.data(), option.data(), input.data(), nullptr};
  pid_t child = 0;
  const int refused = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (refused != 0) throw cannot_start(refused);
  const int status = wait_for(child);
  if (DeferredSignals::pending()) throw Interrupted();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return figure.content();
  std::string text = messages.content();
  text.erase(0, text.find_first_not_of(" \n"));
  std::replace(text.begin(), text.end(), '\n', ' ');
  throw WorkError(fmt::format("gnuplot failed: {}", text.substr(0, 500)));
}

// Throws WorkError without the end mark of the figure's format.
void require_whole(const std::string& figure, const fs::path& file) {
  const std::string extension = file.extension();
  const std::string_view end = extension == ".png" ? "IEND\xae\x42\x60\x82" : extension == ".svg" ? "</svg>" : "%%EOF";
  const std::size_t last = figure.find_last_not_of(" \r\n");
  if (last == std::string::npos || !std::string_view(figure).substr(0, last + 1).ends_with(end))
    throw WorkError(fmt::format("{}: gnuplot did not write it to its end: is there memory for it?", file.string()));
}

constexpr double kSmall = 0.8;                                                   // of the text
constexpr double kInch_mm = 25.4, kPixels = 96, kPaperDots = 300, kPoints = 72;  // of an inch

double width_mm(FigureStyle style) { return style == FigureStyle::kPaper ? 88 : 180; }

double text_points(FigureStyle style) {
  return style == FigureStyle::kScreen ? 11 : style == FigureStyle::kPaper ? 7 : 8;
}

// gnuplot's terminal: points of text are those of the style in every format, lines and marks in proportion.
std::string terminal_command(const std::string& extension, FigureSize size) {
  const FigureArea area = figure_area(size);
  const double points = text_points(size.style);
  const bool paper = size.style != FigureStyle::kScreen;
  std::string kind;
  if (extension == ".png") {
    const double scale = paper ? kPaperDots / kPixels : 1;
    kind = fmt::format(
        "pngcairo size {:.0f},{:.0f} font 'DejaVu Sans,{:g}' fontscale {:g} linewidth {:g} pointscale {:g}",
        scale * area.width, scale * area.height, points, scale, (paper ? 0.7 : 1) * scale, (paper ? 0.6 : 1) * scale);
  } else if (extension == ".svg") {
    kind = fmt::format("svg size {:.0f},{:.0f} font 'DejaVu Sans,{:.4g}' linewidth {:g}", area.width, area.height,
                       area.em, paper ? 0.7 : 1);
  } else {
    kind = fmt::format(
        "pdfcairo size {:.4f}in,{:.4f}in font 'DejaVu Sans,{:g}' fontscale 1 linewidth {:g} pointscale {:g}",
        area.width / kPixels, area.height / kPixels, points, paper ? 0.7 : 1, paper ? 0.6 : 1);
  }
  const bool svg = extension == ".svg";
  // gnuplot places labels in .svg farther from the axes and draws tics and marks larger than in the other formats.
  return fmt::format(
      "set terminal {} noenhanced background '#ffffff'\n{} = 'DejaVu Sans,{:.4g}'\n{} = {:g}\n{} = {:g}\nset tics "
      "scale "
      "{:g}\n",
      kind, kSmallFont, kSmall * (svg ? area.em : points), kLabelShift, svg ? 1.3 : 0.0, kMarkSize,
      svg ? (paper ? 0.5 : 0.8) : 1.0, svg ? (paper ? 0.5 : 0.7) : 1.0);
}

// The PNG with its dots per inch (chunk pHYs, dots per metre), after the header of 33 bytes.
std::string with_dots_per_inch(const std::string& png, double dots) {
  const auto big_endian = [](std::uint32_t value) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
  };
  const std::string per_metre = big_endian(static_cast<std::uint32_t>(std::lround(dots / kInch_mm * 1e3)));
  const std::string chunk = "pHYs" + per_metre + per_metre + '\x01';
  const auto sum = ::crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
  return png.substr(0, 33) + big_endian(9) + chunk + big_endian(static_cast<std::uint32_t>(sum)) + png.substr(33);
}

// The PDF with a constant date, of the same length.
std::string without_date(std::string pdf) {
  constexpr std::string_view kDate = "/CreationDate (D:", kNone = "19700101000000";
  if (const std::size_t at = pdf.find(kDate); at != std::string::npos)
    pdf.replace(at + kDate.size(), kNone.size(), kNone);
  return pdf;
}

}  // namespace

FigureStyle figure_style(const std::string& name) {
  return name == "paper" ? FigureStyle::kPaper : name == "paper-wide" ? FigureStyle::kPaperWide : FigureStyle::kScreen;
}

FigureArea figure_area(FigureSize size) {
  const double width = size.style == FigureStyle::kScreen ? size.width : width_mm(size.style) / kInch_mm * kPixels;
  return {width, width * size.height / size.width, text_points(size.style) * kPixels / kPoints};
}

std::string gnuplot_text(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "'";
}

std::string gnuplot_number(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : "NaN"; }

void require_gnuplot() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/bin:/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((fs::path(folder) / "gnuplot").c_str(), X_OK) == 0) return;
  }
  throw cannot_start(ENOENT);
}

void require_figure(const fs::path& file) {
  if (file.empty()) return;
  if (file.extension() != ".png" && file.extension() != ".svg" && file.extension() != ".pdf")
    throw InputError(fmt::format("{}: a figure's name ends in .png, .svg or .pdf", file.string()));
  require_writable(file);
  require_gnuplot();
}

std::string figure_bytes(const fs::path& name, FigureSize size, const std::string& data, const std::string& commands) {
  const std::string extension = name.extension();
  const DeferredSignals held;
  std::string script = terminal_command(extension, size);
  script +=
      "set encoding utf8\nset datafile missing '?'\nset pointintervalbox 0\nset tics out nomirror\nset border lw "
      "0.8\n";
  script += fmt::format("{} = '/proc/self/fd/{}'\n", kGnuplotData, kDataFile);
  script += commands + "set output\n";
  std::string figure = run_gnuplot(script, data);
  require_whole(figure, name);
  if (extension == ".png" && size.style != FigureStyle::kScreen) figure = with_dots_per_inch(figure, kPaperDots);
  return extension == ".pdf" ? without_date(std::move(figure)) : figure;
}

void draw_by_gnuplot(const fs::path& file, FigureSize size, const std::string& data, const std::string& commands) {
  require_figure(file);
  const DeferredSignals held;  // released when the file is complete
  write_file(file, figure_bytes(file, size, data, commands));
}

}  // namespace seaglint
