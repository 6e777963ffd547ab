// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figures by gnuplot: heat maps, lines and scatters to .png or .svg, chosen by the file's name; the figure of a range-
// velocity map.

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "classify/features/scattering_centres.h"
#include "radar/rvmap/rv_map.h"

namespace seaglint {

// Defers Ctrl-C while a child process or temporary files exist, until they have ended or are removed.

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

using AxisRange = std::pair<double, double>;  // low, high

struct FigureAxis {
  std::string label;               // with its unit, e.g. "range (m)"
  std::optional<AxisRange> range;  // absent: that of the data
  bool logarithmic = false;
};

struct Heatmap {
  std::string title;
  FigureAxis x, y;
  FigureAxis colour;            // values outside its range are clipped
  std::vector<double> x_cells;  // centres of equal cells, ascending
  std::vector<double> y_cells;
  std::vector<double> values;                  // [y][x]; NaN is drawn white
  std::vector<std::array<double, 2>> markers;  // x, y of open circles
  std::string marker_name;                     // in the legend, when not empty
  std::vector<std::array<double, 4>> boxes;    // x low, x high, y low, y high of frames
  bool diverging = false;                      // blue below the middle of the colour's range, white there, red above
};

// kBand: the area between the interval's ends.
enum class SeriesStyle { kLines, kPoints, kLinesPoints, kBand };

struct Series {
  std::string name;  // in the legend, when not empty
  std::vector<double> x;
  std::vector<double> y;                        // NaN breaks a line
  std::vector<std::array<double, 2>> interval;  // low, high of error bars; empty or one per point
  SeriesStyle style = SeriesStyle::kLines;
  std::string colour = {};  // "#0072b2"; empty: by the place among the series
  double width = 1.6;       // of lines, pixels
};

// Every comparison has these, whatever else it shows.
inline constexpr const char* kReferenceColour = "#000000";
inline constexpr const char* kComputedColour = "#0072b2";
inline constexpr const char* kKnownColour = "#009e73";       // exact and closed-form values
inline constexpr const char* kDifferenceColour = "#d55e00";  // compared less reference

struct LinePlot {
  std::string title;
  FigureAxis x, y;
  std::vector<Series> series;
  bool equal_axes = false;  // one metre is one metre in x and y
  bool legend_above = false;
};

struct FigureSize {
  int width = 900;  // pixels
  int height = 560;
};

// Several plots of one figure, in rows of `columns`; none: there is nothing to draw.
struct PlotPanels {
  std::vector<LinePlot> plots;
  int columns = 1;
  FigureSize size;
};

// Throws WorkError where gnuplot is missing, as write_figure() would, so that it is reported before any work.
void require_gnuplot();

// Throws, as write_figure() would but before any work, where the name ends in neither .png nor .svg, the directory is
// not writable or gnuplot is missing. An empty name passes.
void require_figure(const std::filesystem::path& file);

// Writes the figure completely or not at all. Text is literal (no markup), and every name is that of a file: none is a
// pipe to gnuplot, which draws in memory. Throws InputError for a file that is neither .png nor .svg, WorkError when
// gnuplot is missing or fails (with its message) or the file cannot be written. Ctrl-C ends gnuplot and takes effect
// after it; if the process continues, Interrupted is thrown.
void write_figure(const Heatmap& figure, const std::filesystem::path& file, FigureSize size = {});
void write_figure(const LinePlot& figure, const std::filesystem::path& file, FigureSize size = {});

// Several plots in one figure, in rows of `columns` with aligned frames, below a common `title`.
void write_figure(const std::string& title, std::span<const LinePlot> plots, int columns,
                  const std::filesystem::path& file, FigureSize size = {});
inline void write_figure(const std::string& title, const PlotPanels& panels, const std::filesystem::path& file) {
  write_figure(title, panels.plots, panels.columns, file, panels.size);
}

// Figure of a range-velocity map.

// |RV| in dB relative to its peak, down to floor_db (< 0), with the scattering centres as circles.
Heatmap rv_figure(const RvMap& map, std::span<const ScatteringCentre> centres, const std::string& title,
                  double floor_db = -40);

}  // namespace seaglint
