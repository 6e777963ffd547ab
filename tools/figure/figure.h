// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figures of lines and scatters, alone or in panels.

#include <array>
#include <cstddef>
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
  double step = 0;  // between numbers; 0: by the range
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

// Colour of the i-th series of a plot that names none.
std::string series_colour(std::size_t i);

struct LinePlot {
  std::string title;
  FigureAxis x, y;
  std::vector<Series> series;
  bool equal_axes = false;  // one metre is one metre in x and y; of aligned plots both ranges are given
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
  // Height over width of frames that stand close together in every style; the figure's height follows. Labels, and the
  // numbers of ranges that are equal, stand at the left and the lower edge alone, the legend of the first plot above
  // all.
  std::optional<double> aligned = {};
};

// One or two columns of a journal have one or at most two plots side by side, unless they are aligned, each 0.62 (in
// several rows 0.7, polar 1.25) of the width of a column high, with the legend above. Throw as draw_by_gnuplot().
void write_figure(const PlotPanels& figure, const std::filesystem::path& file);
void write_figure(const LinePlot& figure, const std::filesystem::path& file, FigureSize size = {});

// What a figure of any content has in common with others.
struct FigureText {
  std::string title;
  std::vector<std::string> notes;  // phrases of the small print
  FigureStyle style = FigureStyle::kScreen;
};

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

// Equal frames in rows, the first one above at the left; in units of the text's size.
struct FrameGrid {
  std::size_t columns = 1, rows = 1;
  AxisRange across, up;           // of all frames together
  std::array<double, 2> apart{};  // neighbours, across and up

  AxisRange across_of(std::size_t i) const;  // of the i-th frame
  AxisRange up_of(std::size_t i) const;
  bool is_left(std::size_t i) const { return i % columns == 0; }
};

// gnuplot's margins of a frame.
std::string margins(const FigureLayout& at, const AxisRange& across, const AxisRange& up);

// About `count` steps over a range, of 1, 2 or 5 times a power of ten.
double tic_step(const AxisRange& range, double count);

// Small print from a line's left end and the uppermost line's height on, in lines that end before `right`, unless given
// the figure's margin.
class SmallPrint {
 public:
  SmallPrint(const FigureLayout& at, const std::vector<std::string>& phrases, double left,
             std::optional<double> right = {}, const char* colour = "#404040");

  double height() const;                     // of all lines
  std::string commands(double upper) const;  // gnuplot's labels; height of the uppermost line

 private:
  FigureLayout at_;
  double left_;
  const char* colour_;
  std::vector<std::string> lines_;
};

inline constexpr double kSmallCharacter = 0.5;  // mean width of a character of small print

}  // namespace seaglint
