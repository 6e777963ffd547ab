// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/figure.h"

#include <fmt/format.h>
#include <algorithm>

#include <algorithm>
#include <cmath>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// Nine samples of matplotlib's viridis (Smith and van der Walt, CC0).
constexpr double kViridis[9][3] = {{0x44, 0x01, 0x54}, {0x47, 0x2c, 0x7a}, {0x3b, 0x51, 0x8b},
                                   {0x2c, 0x71, 0x8e}, {0x21, 0x90, 0x8d}, {0x27, 0xad, 0x81},
                                   {0x5c, 0xc8, 0x63}, {0xaa, 0xdc, 0x32}, {0xfd, 0xe7, 0x25}};

}  // namespace

Rgb viridis(double at) {
  const double x = std::clamp(at, 0.0, 1.0) * 8;
  const int below = std::min(7, static_cast<int>(x));
  Rgb colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = (kViridis[below][c] + (x - below) * (kViridis[below + 1][c] - kViridis[below][c])) / 255;
  return colour;
}

std::string viridis_palette() {
  std::string text = "set palette defined (";
  for (int i = 0; i < 9; ++i)
    text += fmt::format("{}{} '#{:02x}{:02x}{:02x}'", i > 0 ? ", " : "", i, static_cast<int>(kViridis[i][0]),
                        static_cast<int>(kViridis[i][1]), static_cast<int>(kViridis[i][2]));
  return text + ")\n";
}

std::string axis_commands(const char* name, const FigureAxis& axis) {
  std::string text = fmt::format("set {}label {}\n", name, gnuplot_text(axis.label));
  if (axis.logarithmic) text += fmt::format("set logscale {0}\nset format {0} '%.0e'\n", name);
  if (axis.range) {
    text += fmt::format("set {}range [{}:{}]\n", name, gnuplot_number(axis.range->first),
                        gnuplot_number(axis.range->second));
  }
  return text;
}

std::vector<double> apart(std::vector<double> places, double distance, const AxisRange& limits) {
  if (places.size() > 1)
    distance = std::min(distance, (limits.second - limits.first) / static_cast<double>(places.size() - 1));
  double least = limits.first, most = limits.second;
  for (double& place : places) {
    place = std::max(place, least);
    least = place + distance;
  }
  for (std::size_t i = places.size(); i-- > 0;) {
    places[i] = std::min(places[i], most);
    most = places[i] - distance;
  }
  return places;
}

namespace {

// Okabe and Ito's palette, distinguishable for colour-blind readers.
constexpr const char* kLineColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

// Axes of a polar plot: gnuplot leaves out points below the lower end of the radius, which is the centre.
std::string polar_commands(const FigureAxis& radius) {
  SEAGLINT_CHECK(radius.range.has_value(), "a polar plot needs the range of its levels");
  const auto& [low, high] = *radius.range;
  const double step = (high - low) / 10 > 5 ? 20 : high - low > 30 ? 10 : 5;
  return fmt::format(
      "set polar\nset angles degrees\nset theta top counterclockwise\nset trange [0:360]\nset rrange [{:g}:{:g}]\n"
      "unset xtics\nunset ytics\nunset border\nset border polar\nunset xlabel\nunset ylabel\nunset raxis\n"
      "set rtics {:g},{:g} scale 0 font {}\nset ttics 0,30 font {}\n"
      "set ttics add ('0 bow' 0, '180 stern' 180)\nset lmargin 5\nset rmargin 5\n"
      "set grid polar 30 lt 1 lc rgb '#d8d8d8' lw 0.6\nset size ratio 1\n",
      low, high, low + step, step, kSmallFont, kSmallFont);
}

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
      const double x = figure.polar ? series.x[i] - 360 * std::floor(series.x[i] / 360) : series.x[i],
                   y = figure.polar ? std::max(series.y[i], figure.y.range->first) : series.y[i];
      data += fmt::format("{} {} {} {}\n", gnuplot_number(x), gnuplot_number(y), gnuplot_number(interval[0]),
                          gnuplot_number(interval[1]));
    }
    if (series.x.empty()) data += "NaN NaN NaN NaN\n";
    data += "\n\n";
    const std::string colour = series.colour.empty() ? kLineColours[s % std::size(kLineColours)] : series.colour;
    const std::string title = series.name.empty() ? "notitle" : "title " + gnuplot_text(series.name);
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
  std::string commands;
  if (figure.polar) {
    commands = polar_commands(figure.y);
  } else {
    commands = axis_commands("x", figure.x) + axis_commands("y", figure.y);
    commands += "set grid lc rgb '#d8d8d8' lw 0.6\n";
  }
  for (const LinePlot::Mark& mark : figure.marks) {
    commands += fmt::format("set label {} at first {:.9g},{:.9g} left rotate by 60 offset 0,0.4 font {}\n",
                            gnuplot_text(mark.name), mark.x, mark.y, kSmallFont);
  }
  const char* place = figure.legend_above ? "outside center top horizontal" : "outside right top";
  commands += named ? fmt::format("set key {} reverse Left samplen 2\n", place) : "unset key\n";
  if (!figure.polar && !figure.x.range && !figure.x.logarithmic)
    commands += "set autoscale xfix\nset offsets graph 0.03, graph 0.03, 0, 0\n";
  if (figure.equal_axes) commands += "set size ratio -1\n";
  commands += "plot " + plots.substr(0, plots.size() - 2) + "\n";
  if (figure.polar)
    commands +=
        "unset polar\nset lmargin 11\nset rmargin 3\nunset rtics\nunset ttics\nunset grid\nset border 31\nset "
        "xtics\nset ytics\n";
  return {commands, data};
}

// Phrases in lines of at most `most` characters: a phrase is divided only where it is longer than a line.
std::vector<std::string> wrapped(const std::vector<std::string>& phrases, std::size_t most) {
  std::vector<std::string> lines;
  const auto append = [&](const std::string& text) {
    if (!lines.empty() && lines.back().size() + 1 + text.size() <= most) {
      lines.back() += " " + text;
    } else {
      lines.push_back(text);
    }
  };
  for (const std::string& phrase : phrases) {
    std::string text = phrase + (&phrase == &phrases.back() ? "" : ";");
    if (text.size() <= most) {
      append(text);
      continue;
    }
    for (std::size_t end; (end = text.find(' ')) != std::string::npos; text.erase(0, end + 1))
      append(text.substr(0, end));
    append(text);
  }
  return lines;
}

// In units of the text's size.
constexpr double kSmallLine = 1.15;                        // height of a line of small print
constexpr double kTitleLine = 1.4, kTitleCharacter = 0.6;  // height, mean width of a character

// The figure as a style has it.
PlotPanels in_style(PlotPanels figure) {
  if (figure.size.style == FigureStyle::kScreen) return figure;
  const bool polar = std::ranges::any_of(figure.plots, &LinePlot::polar);
  const double height_over_width = polar ? 1.25 : 0.62;
  figure.columns = std::min(figure.columns, figure.size.style == FigureStyle::kPaper ? 1 : 2);
  for (LinePlot& plot : figure.plots) plot.legend_above = true;
  const auto columns = static_cast<std::size_t>(figure.columns);
  const std::size_t rows = (figure.plots.size() + columns - 1) / columns;
  figure.size.height =
      static_cast<int>(std::lround(height_over_width * figure.size.width / figure.columns * static_cast<double>(rows)));
  return figure;
}

}  // namespace

SmallPrint::SmallPrint(const FigureLayout& at, const std::vector<std::string>& phrases, double left)
    : at_(at),
      left_(left),
      lines_(wrapped(phrases, static_cast<std::size_t>((at.width() - left - 0.8) / kSmallCharacter))) {}

double SmallPrint::height() const { return kSmallLine * static_cast<double>(lines_.size()); }

std::string SmallPrint::commands(double upper) const {
  std::string text;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    text += fmt::format("set label {} at screen {:.5f},{:.5f} left font {} tc rgb '#404040'\n", gnuplot_text(lines_[i]),
                        at_.x(left_), at_.y(upper - kSmallLine * static_cast<double>(i)), kSmallFont);
  }
  return text;
}

void write_figure(const LinePlot& figure, const std::filesystem::path& file, FigureSize size) {
  write_figure(PlotPanels{.plots = {figure}, .size = size}, file);
}

void write_figure(const PlotPanels& asked, const std::filesystem::path& file) {
  const PlotPanels figure = in_style(asked);
  SEAGLINT_CHECK(!figure.plots.empty() && figure.columns >= 1,
                 fmt::format("{} plots in {} columns", figure.plots.size(), figure.columns));
  const auto columns = static_cast<std::size_t>(figure.columns);
  const std::size_t rows = (figure.plots.size() + columns - 1) / columns;
  const FigureLayout at(figure_area(figure.size));
  const std::vector<std::string> title =
      wrapped({figure.title}, static_cast<std::size_t>((at.width() - 2) / kTitleCharacter));
  const SmallPrint notes(at, figure.notes, 1.2);
  const double bottom = figure.notes.empty() ? 0 : notes.height() + 0.6;
  const double head = figure.title.empty() ? 0 : 0.5 + kTitleLine * static_cast<double>(title.size());
  const double width = 1.0 / figure.columns, height = at.y(at.height() - head - bottom) / static_cast<double>(rows);

  std::string data, commands = "set multiplot\nset lmargin 11\nset rmargin 3\n" + notes.commands(notes.height() - 0.3);
  for (std::size_t i = 0; i < title.size(); ++i) {
    commands += fmt::format("set label {} at screen 0.5,{:.5f} center\n", gnuplot_text(title[i]),
                            at.y(at.height() - 1.2 - kTitleLine * static_cast<double>(i)));
  }
  std::size_t index = 0;
  for (std::size_t i = 0; i < figure.plots.size(); ++i) {
    const LinePlot& plot = figure.plots[i];
    const PlotText text = plot_text(plot, index);
    // Each plot starts from gnuplot's default axes.
    commands += fmt::format(
                    "set origin {:.5f},{:.5f}\nset size noratio {:.5f},{:.5f}\nunset logscale\nset format\nset xlabel "
                    "offset 0,0.3\nset xrange [*:*]\nset yrange [*:*]\nset offsets\nset title {}\n",
                    width * static_cast<double>(i % columns),
                    at.y(bottom) + height * static_cast<double>(rows - 1 - i / columns), width, height,
                    gnuplot_text(plot.title)) +
                text.commands + "unset label\n";
    data += text.data;
    index += plot.series.size();
  }
  draw_by_gnuplot(file, figure.size, data, commands + "unset multiplot\n");
}

}  // namespace seaglint
