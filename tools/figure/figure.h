// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figures of lines and scatters, alone or in panels.

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/figure/gnuplot.h"

namespace seaglint {

using AxisRange = std::pair<double, double>;  // low, high

struct FigureAxis {
  std::string label;               // with its unit, e.g. "range (m)"
  std::optional<AxisRange> range;  // absent: that of the data
  bool logarithmic = false;
};

// gnuplot's commands for the axis of this name, "x", "y", "cb": label, scale and range.
std::string axis_commands(const char* name, const FigureAxis& axis);

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

// Several plots of one figure, in rows of `columns`; none: there is nothing to draw.
struct PlotPanels {
  std::vector<LinePlot> plots;
  int columns = 1;
  FigureSize size;
};

// Throw as draw_by_gnuplot().
void write_figure(const LinePlot& figure, const std::filesystem::path& file, FigureSize size = {});

// Several plots in one figure, in rows of `columns` with aligned frames, below a common `title`.
void write_figure(const std::string& title, std::span<const LinePlot> plots, int columns,
                  const std::filesystem::path& file, FigureSize size = {});
inline void write_figure(const std::string& title, const PlotPanels& panels, const std::filesystem::path& file) {
  write_figure(title, panels.plots, panels.columns, file, panels.size);
}

}  // namespace seaglint
