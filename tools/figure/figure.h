// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figures of lines and scatters, alone or in panels.

#include <array>
#include <filesystem>
#include <optional>
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

// Ascending places at least `distance` apart within `limits`, as near to the given ascending ones as that leaves from
// the left; closer together where the limits have no room for all.
std::vector<double> apart(std::vector<double> places, double distance, const AxisRange& limits);

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

// Colours of levels, sRGB in 0..1: viridis at 0..1, clamped; the same as gnuplot's palette; marks that stand out from
// all.
using Rgb = std::array<double, 3>;
Rgb viridis(double at);
std::string viridis_palette();
inline constexpr const char* kMarks = "#ff4d4d";

struct LinePlot {
  std::string title;
  FigureAxis x, y;
  std::vector<Series> series;
  bool equal_axes = false;  // one metre is one metre in x and y
  bool legend_above = false;
  // Azimuths x in degrees, the bow up and counter-clockwise, with y outwards from the lower end of its range, which is
  // given; lower values are raised to it.
  bool polar = false;
  struct Mark {
    double x = 0, y = 0;
    std::string name;
  };
  std::vector<Mark> marks = {};  // names above points of the plot, for which y's range leaves room
};

// Several plots of one figure, in rows of `columns` with aligned frames; none: there is nothing to draw.
struct PlotPanels {
  std::vector<LinePlot> plots;
  int columns = 1;
  FigureSize size = {};    // in a style of paper only its proportions are those of the plots, see write_figure()
  std::string title = {};  // above all
  std::vector<std::string> notes = {};  // phrases of the small print below all: radar, aspect, sea, seed, version
};

// One or two columns of a journal have one or at most two plots side by side, each 0.62 (polar: 1.25) of its width
// high, with the legend above. Throw as draw_by_gnuplot().
void write_figure(const PlotPanels& figure, const std::filesystem::path& file);
void write_figure(const LinePlot& figure, const std::filesystem::path& file, FigureSize size = {});

// Places of the parts of a figure, in units of the text's size from the lower left corner.
class FigureLayout {
 public:
  explicit FigureLayout(const FigureArea& area) : width_(area.width / area.em), height_(area.height / area.em) {}

  double width() const { return width_; }
  double height() const { return height_; }
  double x(double em) const { return em / width_; }  // of the figure's width and height
  double y(double em) const { return em / height_; }

 private:
  double width_, height_;
};

// Small print from a line's left end and the uppermost line's height on, in lines that end before the right margin.
class SmallPrint {
 public:
  SmallPrint(const FigureLayout& at, const std::vector<std::string>& phrases, double left);

  double height() const;                     // of all lines
  std::string commands(double upper) const;  // gnuplot's labels; height of the uppermost line

 private:
  FigureLayout at_;
  double left_;
  std::vector<std::string> lines_;
};

inline constexpr double kSmallCharacter = 0.5;  // mean width of a character of small print

}  // namespace seaglint
