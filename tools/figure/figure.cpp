// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/figure.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstddef>
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

namespace {

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

// Nine samples of matplotlib's viridis (Smith and van der Walt, CC0).
constexpr const char* kViridis =
    "set palette defined (0 '#440154', 1 '#472c7a', 2 '#3b518b', 3 '#2c718e', 4 '#21908d', 5 '#27ad81', 6 '#5cc863', 7 "
    "'#aadc32', "
    "8 '#fde725')\n";
constexpr const char* kBlueWhiteRed =
    "set palette defined (-1 '#2166ac', -0.5 '#92c5de', 0 '#ffffff', 0.5 '#f4a582', 1 '#b2182b')\n";
// Okabe and Ito's palette, distinguishable for colour-blind readers.
constexpr const char* kLineColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

// A string in gnuplot's single quotes; line breaks would end the command.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "'";
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : "NaN"; }

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

constexpr int kData = 3;  // the descriptor by which gnuplot reads the data

// The figure that gnuplot draws. Script, data and figure are in memory: gnuplot neither checks its writes, so that a
// figure on a full disk has gaps, nor ends with an error when data cannot be read. Throws WorkError, Interrupted after
// Ctrl-C.
std::string run_gnuplot(const std::string& script, const std::string& data) {
  const MemoryFile commands(script), numbers(data), figure, messages;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // The standard streams first: the files in memory have other numbers, kData perhaps among them.
  posix_spawn_file_actions_adddup2(&actions, commands.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, figure.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.descriptor(), STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&actions, numbers.descriptor(), kData);
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
  const std::string_view end = file.extension() == ".png" ? "IEND\xae\x42\x60\x82" : "</svg>";
  const std::size_t last = figure.find_last_not_of(" \r\n");
  if (last == std::string::npos || !std::string_view(figure).substr(0, last + 1).ends_with(end))
    throw WorkError(fmt::format("{}: gnuplot did not write it to its end: is there memory for it?", file.string()));
}

std::string axis_commands(const char* name, const FigureAxis& axis) {
  std::string text = fmt::format("set {}label {}\n", name, quoted(axis.label));
  if (axis.logarithmic) text += fmt::format("set logscale {0}\nset format {0} '%.0e'\n", name);
  if (axis.range)
    text += fmt::format("set {}range [{}:{}]\n", name, number(axis.range->first), number(axis.range->second));
  return text;
}

// Runs gnuplot and writes the figure.
void draw(const fs::path& file, FigureSize size, const std::string& title, const std::string& data,
          const std::string& commands) {
  require_figure(file);
  const std::string extension = file.extension();
  const DeferredSignals held;  // released when the file is complete
  std::string script = fmt::format("set terminal {} size {},{} font 'DejaVu Sans,11' noenhanced background '#ffffff'\n",
                                   extension == ".png" ? "pngcairo" : "svg", size.width, size.height);
  script +=
      "set encoding utf8\nset datafile missing '?'\nset pointintervalbox 0\nset tics out nomirror\nset border lw "
      "0.8\n";
  script += fmt::format("data = '/proc/self/fd/{}'\n", kData);
  if (!title.empty()) script += fmt::format("set title {}\n", quoted(title));
  script += commands + "set output\n";
  const std::string figure = run_gnuplot(script, data);
  require_whole(figure, file);
  write_file(file, figure);
}

}  // namespace

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
  if (file.extension() != ".png" && file.extension() != ".svg")
    throw InputError(fmt::format("{}: a figure's name ends in .png or .svg", file.string()));
  require_writable(file);
  require_gnuplot();
}

void write_figure(const Heatmap& figure, const fs::path& file, FigureSize size) {
  const std::size_t columns = figure.x_cells.size(), rows = figure.y_cells.size();
  SEAGLINT_CHECK(columns >= 1 && rows >= 1 && figure.values.size() == columns * rows,
                 fmt::format("{} values for {} x {} cells", figure.values.size(), rows, columns));
  // Vertices of the cells, so that a single row or column is also drawn: pm3d colours a cell by its first vertex.
  const auto corners = [](const std::vector<double>& cells) {
    const double step = cells.size() > 1 ? (cells.back() - cells.front()) / static_cast<double>(cells.size() - 1) : 1;
    std::vector<double> out;
    for (std::size_t i = 0; i <= cells.size(); ++i) out.push_back(cells[0] + (static_cast<double>(i) - 0.5) * step);
    return out;
  };
  const std::vector<double> x = corners(figure.x_cells), y = corners(figure.y_cells);
  const bool image = columns > 1 && rows > 1;
  std::string data;
  if (image) {
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        data += fmt::format("{:.9g} {:.9g} {}\n", figure.x_cells[i], figure.y_cells[j],
                            number(figure.values[j * columns + i]));
      }
      data += "\n";
    }
  } else {
    for (std::size_t j = 0; j <= rows; ++j) {
      for (std::size_t i = 0; i <= columns; ++i) {
        data += fmt::format("{:.9g} {:.9g} {}\n", x[i], y[j],
                            number(figure.values[std::min(j, rows - 1) * columns + std::min(i, columns - 1)]));
      }
      data += "\n";
    }
  }
  data += "\n\n";
  for (const auto& marker : figure.markers) data += fmt::format("{} {}\n", number(marker[0]), number(marker[1]));

  FigureAxis x_axis = figure.x, y_axis = figure.y;
  if (!x_axis.range) x_axis.range = AxisRange{x.front(), x.back()};
  if (!y_axis.range) y_axis.range = AxisRange{y.front(), y.back()};
  std::string commands = axis_commands("x", x_axis) + axis_commands("y", y_axis) + axis_commands("cb", figure.colour) +
                         (figure.diverging ? kBlueWhiteRed : kViridis);
  commands += image ? "" : "set pm3d map corners2color c1\n";
  commands += "set bmargin 5\nset key at screen 0.99, screen 0.02 right bottom horizontal reverse Left samplen 1\n";
  for (const auto& box : figure.boxes) {
    commands += fmt::format("set object rectangle from {},{} to {},{} front fs empty border lc rgb '#ff3b30' lw 1.6\n",
                            number(box[0]), number(box[2]), number(box[1]), number(box[3]));
  }
  commands += "set key outside bottom right horizontal reverse Left samplen 1\n";
  commands +=
      image ? "plot data index 0 using 1:2:3 with image notitle" : "splot data index 0 using 1:2:3 with pm3d notitle";
  if (!figure.markers.empty()) {
    commands += fmt::format(", data index 1 using 1:2{} with points pt 6 ps 1.6 lw 1.3 lc rgb '#ff3b30' {}",
                            image ? "" : ":(0)",
                            figure.marker_name.empty() ? "notitle" : "title " + quoted(figure.marker_name));
  }
  draw(file, size, figure.title, data, commands + "\n");
}

namespace {

// The commands that draw a plot whose series start at `first_index` of the data, and the data of these series.
struct PlotText {
  std::string commands, data;
};

PlotText plot_text(const LinePlot& figure, std::size_t first_index) {
  std::string data, plots;
  bool named = false;
  for (std::size_t s = 0; s < figure.series.size(); ++s) {
    const Series& series = figure.series[s];
    SEAGLINT_CHECK(
        series.x.size() == series.y.size() && (series.interval.empty() || series.interval.size() == series.x.size()),
        fmt::format("series {}: {} x, {} y, {} intervals", s, series.x.size(), series.y.size(),
                    series.interval.size()));
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const auto interval =
          series.interval.empty() ? std::array<double, 2>{series.y[i], series.y[i]} : series.interval[i];
      data += fmt::format("{} {} {} {}\n", number(series.x[i]), number(series.y[i]), number(interval[0]),
                          number(interval[1]));
    }
    if (series.x.empty()) data += "NaN NaN NaN NaN\n";
    data += "\n\n";
    const std::string colour = series.colour.empty() ? kLineColours[s % std::size(kLineColours)] : series.colour;
    const std::string title = series.name.empty() ? "notitle" : "title " + quoted(series.name);
    named = named || !series.name.empty();
    const std::string index = fmt::format("data index {} using ", first_index + s);
    if (series.style == SeriesStyle::kBand) {
      plots += fmt::format("{}1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.3 noborder {}, ", index,
                           colour, title);
      continue;
    }
    if (!series.interval.empty()) {
      plots += fmt::format("{}1:2:3:4 with yerrorbars lc rgb '{}' lw 1.2 ps 0 notitle, ", index, colour);
    }
    const bool line = series.style == SeriesStyle::kLines;
    const char* style = line ? "lines" : series.style == SeriesStyle::kPoints ? "points" : "linespoints";
    const std::string marks = line ? "" : fmt::format("pt {} ps 0.8", s % 2 == 0 ? 7 : 5);
    plots += fmt::format("{}1:2 with {} lc rgb '{}' lw {:g} {} {}, ", index, style, colour, series.width, marks, title);
  }
  SEAGLINT_CHECK(!plots.empty(), "a plot without series");
  std::string commands = axis_commands("x", figure.x) + axis_commands("y", figure.y);
  commands += "set grid lc rgb '#d8d8d8' lw 0.6\n";
  const char* place = figure.legend_above ? "outside center top horizontal" : "outside right top";
  commands += named ? fmt::format("set key {} reverse Left samplen 2\n", place) : "unset key\n";
  if (!figure.x.range && !figure.x.logarithmic)
    commands += "set autoscale xfix\nset offsets graph 0.03, graph 0.03, 0, 0\n";
  if (figure.equal_axes) commands += "set size ratio -1\n";
  return {commands + "plot " + plots.substr(0, plots.size() - 2) + "\n", data};
}

}  // namespace

void write_figure(const LinePlot& figure, const fs::path& file, FigureSize size) {
  const PlotText text = plot_text(figure, 0);
  draw(file, size, figure.title, text.data, text.commands);
}

void write_figure(const std::string& title, std::span<const LinePlot> plots, int columns, const fs::path& file,
                  FigureSize size) {
  SEAGLINT_CHECK(!plots.empty() && columns >= 1, fmt::format("{} plots in {} columns", plots.size(), columns));
  const std::size_t rows = (plots.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
  std::string data,
      commands = fmt::format("set multiplot layout {},{} rowsfirst title {}\nset lmargin 11\nset rmargin 3\n", rows,
                             columns, quoted(title));
  std::size_t index = 0;
  for (const LinePlot& plot : plots) {
    const PlotText text = plot_text(plot, index);
    // Each plot starts from gnuplot's default axes.
    commands += fmt::format(
                    "unset logscale\nset format\nset xlabel offset 0,0.3\nset xrange [*:*]\nset yrange [*:*]\nset "
                    "offsets\nset title {}\n",
                    quoted(plot.title)) +
                text.commands;
    data += text.data;
    index += plot.series.size();
  }
  draw(file, size, "", data, commands + "unset multiplot\n");
}

Heatmap rv_figure(const RvMap& map, std::span<const ScatteringCentre> centres, const std::string& title,
                  double floor_db) {
  double peak = 0;
  for (const Complex& value : map.values) peak = std::max(peak, std::abs(value));
  Heatmap figure;
  figure.title = title;
  figure.x.label = "range against the reference point (m), positive = farther";
  figure.y.label = "velocity (m/s), positive = receding";
  figure.colour = {"|RV| against the peak (dB)", AxisRange{floor_db, 0}, false};
  figure.x_cells = map.range_m;
  figure.y_cells = map.velocity_mps;
  for (const Complex& value : map.values) {
    const double ratio = peak > 0 ? std::abs(value) / peak : 0;
    figure.values.push_back(ratio > 0 ? std::max(floor_db, 20 * std::log10(ratio)) : floor_db);
  }
  for (const ScatteringCentre& centre : centres) figure.markers.push_back({centre.range_m, centre.velocity_mps});
  figure.marker_name = "scattering centres";
  return figure;
}

}  // namespace seaglint
