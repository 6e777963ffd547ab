// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/figure.h"

#include <fmt/format.h>

#include "sim/core/process/error.h"

namespace seaglint {

std::string axis_commands(const char* name, const FigureAxis& axis) {
  std::string text = fmt::format("set {}label {}\n", name, gnuplot_text(axis.label));
  if (axis.logarithmic) text += fmt::format("set logscale {0}\nset format {0} '%.0e'\n", name);
  if (axis.range) {
    text += fmt::format("set {}range [{}:{}]\n", name, gnuplot_number(axis.range->first),
                        gnuplot_number(axis.range->second));
  }
  return text;
}

namespace {

// Okabe and Ito's palette, distinguishable for colour-blind readers.
constexpr const char* kLineColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

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
      data += fmt::format("{} {} {} {}\n", gnuplot_number(series.x[i]), gnuplot_number(series.y[i]),
                          gnuplot_number(interval[0]), gnuplot_number(interval[1]));
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

void write_figure(const LinePlot& figure, const std::filesystem::path& file, FigureSize size) {
  const PlotText text = plot_text(figure, 0);
  draw_by_gnuplot(file, size, text.data, "set title " + gnuplot_text(figure.title) + "\n" + text.commands);
}

void write_figure(const std::string& title, std::span<const LinePlot> plots, int columns,
                  const std::filesystem::path& file, FigureSize size) {
  SEAGLINT_CHECK(!plots.empty() && columns >= 1, fmt::format("{} plots in {} columns", plots.size(), columns));
  const std::size_t rows = (plots.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
  std::string data,
      commands = fmt::format("set multiplot layout {},{} rowsfirst title {}\nset lmargin 11\nset rmargin 3\n", rows,
                             columns, gnuplot_text(title));
  std::size_t index = 0;
  for (const LinePlot& plot : plots) {
    const PlotText text = plot_text(plot, index);
    // Each plot starts from gnuplot's default axes.
    commands += fmt::format(
                    "unset logscale\nset format\nset xlabel offset 0,0.3\nset xrange [*:*]\nset yrange [*:*]\nset "
                    "offsets\nset title {}\n",
                    gnuplot_text(plot.title)) +
                text.commands;
    data += text.data;
    index += plot.series.size();
  }
  draw_by_gnuplot(file, size, data, commands + "unset multiplot\n");
}

}  // namespace seaglint
