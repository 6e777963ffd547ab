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
  if (axis.step > 0) text += fmt::format("set {}tics {:g}\n", name, axis.step);
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

std::string series_colour(std::size_t i) {
  // Okabe and Ito's palette, distinguishable for colour-blind readers.
  constexpr const char* kLineColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
  return kLineColours[i % std::size(kLineColours)];
}

namespace {

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
    const std::string colour = series.colour.empty() ? series_colour(s) : series.colour;
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
    const std::string marks = line ? "" : fmt::format("pt {} ps 0.8*{}", s % 2 == 0 ? 7 : 5, kMarkSize);
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
  commands += named ? "set key outside center top horizontal reverse Left samplen 2\n" : "unset key\n";
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
  if (figure.size.style == FigureStyle::kScreen || figure.aligned) return figure;
  figure.columns = std::min(figure.columns, figure.size.style == FigureStyle::kPaper ? 1 : 2);
  const auto columns = static_cast<std::size_t>(figure.columns);
  const std::size_t rows = (figure.plots.size() + columns - 1) / columns;
  const int of_width = rows > 1 && figure.size.style == FigureStyle::kPaperWide ? 2 : figure.columns;
  const bool polar = std::ranges::any_of(figure.plots, &LinePlot::polar);
  const double height_over_width = polar ? 1.25 : rows > 1 ? 0.7 : 0.62;
  figure.size.height =
      static_cast<int>(std::lround(height_over_width * figure.size.width / of_width * static_cast<double>(rows)));
  return figure;
}

}  // namespace

AxisRange FrameGrid::across_of(std::size_t i) const {
  const double width =
      (across.second - across.first - apart[0] * static_cast<double>(columns - 1)) / static_cast<double>(columns);
  const double left = across.first + (width + apart[0]) * static_cast<double>(i % columns);
  return {left, left + width};
}

AxisRange FrameGrid::up_of(std::size_t i) const {
  const double height = (up.second - up.first - apart[1] * static_cast<double>(rows - 1)) / static_cast<double>(rows);
  const double top = up.second - (height + apart[1]) * static_cast<double>(i / columns);
  return {top - height, top};
}

std::string margins(const FigureLayout& at, const AxisRange& across, const AxisRange& up) {
  return fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset bmargin at screen {:.5f}\nset tmargin at "
      "screen {:.5f}\n",
      at.x(across.first), at.x(across.second), at.y(up.first), at.y(up.second));
}

double tic_step(const AxisRange& range, double count) {
  const double wanted = (range.second - range.first) / count, power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= wanted) return factor * power;
  }
  return 10 * power;
}

SmallPrint::SmallPrint(const FigureLayout& at, const std::vector<std::string>& phrases, double left,
                       std::optional<double> right, const char* colour)
    : at_(at),
      left_(left),
      colour_(colour),
      lines_(wrapped(phrases, static_cast<std::size_t>(
                                  std::max(1.0, (right.value_or(at.width() - 0.8) - left) / kSmallCharacter)))) {}

double SmallPrint::height() const { return kSmallLine * static_cast<double>(lines_.size()); }

std::string SmallPrint::commands(double upper) const {
  std::string text;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    text += fmt::format("set label {} at screen {:.5f},{:.5f} left font {} tc rgb '{}'\n", gnuplot_text(lines_[i]),
                        at_.x(left_), at_.y(upper - kSmallLine * static_cast<double>(i)), kSmallFont, colour_);
  }
  return text;
}

void write_figure(const LinePlot& figure, const std::filesystem::path& file, FigureSize size) {
  write_figure(PlotPanels{.plots = {figure}, .size = size}, file);
}

namespace {

// Title above all, small print below: their commands, and the heights that they leave to the panels.
struct PanelFrame {
  std::string commands;
  double head = 0, bottom = 0;
};

PanelFrame panel_frame(const PlotPanels& figure, const FigureLayout& at) {
  const std::vector<std::string> title =
      wrapped({figure.title}, static_cast<std::size_t>((at.width() - 2) / kTitleCharacter));
  const SmallPrint notes(at, figure.notes, 1.2);
  PanelFrame frame{notes.commands(notes.height() - 0.3),
                   figure.title.empty() ? 0 : 0.5 + kTitleLine * static_cast<double>(title.size()),
                   figure.notes.empty() ? 0 : notes.height() + 0.6};
  for (std::size_t i = 0; i < title.size(); ++i) {
    frame.commands += fmt::format("set label {} at screen 0.5,{:.5f} center\n", gnuplot_text(title[i]),
                                  at.y(at.height() - 1.2 - kTitleLine * static_cast<double>(i)));
  }
  return frame;
}

// About six numbers at y over the data, or over the axis's own range.
std::string few_numbers(const LinePlot& plot) {
  AxisRange range{1e300, -1e300};
  for (const Series& series : plot.series) {
    for (const double y : series.y) {
      if (std::isfinite(y)) range = {std::min(range.first, y), std::max(range.second, y)};
    }
  }
  if (plot.y.range) range = *plot.y.range;
  if (plot.y.logarithmic || !(range.first < range.second)) return "";
  return fmt::format("set ytics {:g}\n", tic_step(range, 6));
}

// Each plot starts from gnuplot's default axes.
constexpr const char* kDefaultAxes =
    "unset logscale\nset format\nset xrange [*:*]\nset yrange [*:*]\nset xtics autofreq\nset ytics autofreq\nset "
    "offsets\n";

// The ranges of a plot with equal axes in a frame of this height over width: the smaller one is extended.
void fill_frame(LinePlot& plot, double height_over_width) {
  plot.equal_axes = false;
  const auto extend = [](AxisRange& range, double span) {
    const double more = 0.5 * (span - (range.second - range.first));
    range = {range.first - more, range.second + more};
  };
  const double x = plot.x.range->second - plot.x.range->first, y = plot.y.range->second - plot.y.range->first;
  if (y < height_over_width * x) {
    extend(*plot.y.range, height_over_width * x);
  } else {
    extend(*plot.x.range, y / height_over_width);
  }
}

// The legend of a plot's series in lines above the panels.
class LegendAbove {
 public:
  LegendAbove(const LinePlot& plot, double width) {
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
      const Series& series = plot.series[i];
      if (series.name.empty()) continue;
      const double length = kSample + 0.5 + kSmallCharacter * static_cast<double>(series.name.size()) + 1.5;
      if (lines_.empty() || lines_.back().length + length > width) lines_.emplace_back();
      lines_.back().entries.push_back(
          {series.name, series.colour.empty() ? series_colour(i) : series.colour, lines_.back().length});
      lines_.back().length += length;
    }
  }

  double height() const { return lines_.empty() ? 0 : 0.3 + kLine * static_cast<double>(lines_.size()); }

  // Lines in the middle of `across` below `upper`.
  std::string commands(const FigureLayout& at, const AxisRange& across, double upper) const {
    std::string text;
    double y = upper - 0.5 * kLine;
    for (const Line& line : lines_) {
      const double left = 0.5 * (across.first + across.second - line.length + 1.5);
      for (const Entry& entry : line.entries) {
        const double x = left + entry.x;
        text += fmt::format(
            "set arrow from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} nohead lc rgb '{}' lw 1.6\n"
            "set label {} at screen {:.5f},{:.5f} left font {}\n",
            at.x(x), at.y(y), at.x(x + kSample), at.y(y), entry.colour, gnuplot_text(entry.name),
            at.x(x + kSample + 0.5), at.y(y), kSmallFont);
      }
      y -= kLine;
    }
    return text;
  }

 private:
  static constexpr double kSample = 1.8, kLine = 1.25;
  struct Entry {
    std::string name, colour;
    double x;
  };
  struct Line {
    std::vector<Entry> entries;
    double length = 0;
  };
  std::vector<Line> lines_;
};

void write_aligned(PlotPanels figure, const std::filesystem::path& file) {
  std::vector<LinePlot>& plots = figure.plots;
  const auto columns = static_cast<std::size_t>(figure.columns);
  const auto same = [](const FigureAxis& a, const FigureAxis& b) {
    return a.range.has_value() && a.range == b.range && a.label == b.label;
  };
  const bool one_x = std::ranges::all_of(plots, [&](const LinePlot& plot) { return same(plot.x, plots.front().x); });
  bool one_y = true;  // in each row
  for (std::size_t i = 0; i < plots.size(); ++i) one_y = one_y && same(plots[i].y, plots[i - i % columns].y);

  figure.size.height = figure.size.width;
  const FigureArea square = figure_area(figure.size);
  const double width = square.width / square.em;
  FrameGrid grid{.columns = columns,
                 .rows = (plots.size() + columns - 1) / columns,
                 .across = {6.2, width - 1.6},
                 .up = {},
                 .apart = {one_y ? 1.9 : 4.8, 0}};
  const FigureLayout unknown_height(square);
  const auto title_of = [&](const FigureLayout& at, std::size_t i) {
    const AxisRange across = grid.across_of(i);
    std::vector<std::string> phrases;  // divided where "; " stands
    for (std::string rest = plots[i].title; !rest.empty();) {
      const std::size_t end = std::min(rest.find("; "), rest.size());
      phrases.push_back(rest.substr(0, end));
      rest.erase(0, end + 2);
    }
    return SmallPrint(at, phrases, across.first, across.second + 0.5, "#000000");
  };
  double titles = 0;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    if (!plots[i].title.empty()) titles = std::max(titles, title_of(unknown_height, i).height() + 0.2);
  }
  const LegendAbove legend(plots.front(), width - 3);
  const PanelFrame outer = panel_frame(figure, unknown_height);
  const AxisRange first = grid.across_of(0);
  const double frame_height = *figure.aligned * (first.second - first.first), rows = static_cast<double>(grid.rows);
  const double bottom = outer.bottom + 3.2, top = outer.head + legend.height() + titles + 0.4;
  const bool titled_rows = std::any_of(plots.begin() + static_cast<std::ptrdiff_t>(std::min(columns, plots.size())),
                                       plots.end(), [](const LinePlot& plot) { return !plot.title.empty(); });
  grid.apart[1] = (one_x ? 0.7 : 1.7) + (titled_rows ? titles : 0.2);
  const double height = bottom + rows * frame_height + (rows - 1) * grid.apart[1] + top;
  grid.up = {bottom, height - top};
  figure.size.height = static_cast<int>(std::lround(figure.size.width * height / width));
  const FigureLayout at(figure_area(figure.size));

  std::string data, commands = "set multiplot\nset tics font small\n" + panel_frame(figure, at).commands;
  commands += legend.commands(at, {0, width}, height - outer.head - 0.2);
  std::size_t index = 0;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    LinePlot& plot = plots[i];
    const bool is_lowest = i + columns >= plots.size();
    const AxisRange up = grid.up_of(i);
    if (plot.equal_axes) fill_frame(plot, *figure.aligned);
    if (!is_lowest) plot.x.label.clear();
    if (!grid.is_left(i)) plot.y.label.clear();
    const PlotText text = plot_text(plot, index);
    const std::size_t own = text.commands.rfind("plot ");  // what stands before is replaced in part
    const SmallPrint title = title_of(at, i);
    commands += kDefaultAxes + margins(at, grid.across_of(i), up) + text.commands.substr(0, own);
    if (one_x && !is_lowest) commands += "set format x ''\n";
    if (one_y && !grid.is_left(i)) commands += "set format y ''\n";
    if (plot.x.range) commands += fmt::format("set xtics {:g} offset 0,0.3\n", tic_step(*plot.x.range, 4));
    if (plot.y.range && !plot.y.logarithmic) commands += fmt::format("set ytics {:g}\n", tic_step(*plot.y.range, 5));
    commands += "set xlabel offset 0,0.7+0.25*label_shift\nset ylabel offset 0.8+label_shift,0\nunset key\n";
    if (!plot.title.empty()) commands += title.commands(up.second + title.height() - 0.4);
    commands += text.commands.substr(own) + "unset label\nunset arrow\n";
    data += text.data;
    index += plot.series.size();
  }
  draw_by_gnuplot(file, figure.size, data, commands + "unset multiplot\n");
}

}  // namespace

void write_figure(const PlotPanels& asked, const std::filesystem::path& file) {
  const PlotPanels figure = in_style(asked);
  SEAGLINT_CHECK(!figure.plots.empty() && figure.columns >= 1,
                 fmt::format("{} plots in {} columns", figure.plots.size(), figure.columns));
  if (figure.aligned) return write_aligned(figure, file);
  const auto columns = static_cast<std::size_t>(figure.columns);
  const std::size_t rows = (figure.plots.size() + columns - 1) / columns;
  const FigureLayout at(figure_area(figure.size));
  const PanelFrame frame = panel_frame(figure, at);
  const double width = 1.0 / figure.columns,
               height = at.y(at.height() - frame.head - frame.bottom) / static_cast<double>(rows);

  std::string data, commands = "set multiplot\nset lmargin 11\nset rmargin 3\n" + frame.commands;
  std::size_t index = 0;
  for (std::size_t i = 0; i < figure.plots.size(); ++i) {
    const LinePlot& plot = figure.plots[i];
    const PlotText text = plot_text(plot, index);
    commands +=
        fmt::format(
            "set origin {:.5f},{:.5f}\nset size noratio {:.5f},{:.5f}\n{}set xlabel offset 0,0.3\nset title {}\n",
            width * static_cast<double>(i % columns),
            at.y(frame.bottom) + height * static_cast<double>(rows - 1 - i / columns), width, height, kDefaultAxes,
            gnuplot_text(plot.title)) +
        (figure.size.style == FigureStyle::kScreen || plot.polar ? "" : few_numbers(plot)) + text.commands +
        "unset label\n";
    data += text.data;
    index += plot.series.size();
  }
  draw_by_gnuplot(file, figure.size, data, commands + "unset multiplot\n");
}

}  // namespace seaglint
