// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/map_figure.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr const char* kBlueWhiteRed =
    "set palette defined (-1 '#2166ac', -0.5 '#92c5de', 0 '#ffffff', 0.5 '#f4a582', 1 '#b2182b')\n";

// Equal cells along an axis; one cell is divided in two, which an image needs.
struct CellAxis {
  std::vector<double> centres;
  std::vector<std::size_t> of;  // index of the cell of each centre
  AxisRange edges;
};

double step_of(const std::vector<double>& cells) {
  return cells.size() > 1 ? (cells.back() - cells.front()) / static_cast<double>(cells.size() - 1) : 1;
}

CellAxis cell_axis(const std::vector<double>& cells) {
  const double half = 0.5 * step_of(cells);
  CellAxis axis{cells, {}, {cells.front() - half, cells.back() + half}};
  for (std::size_t i = 0; i < cells.size(); ++i) axis.of.push_back(i);
  if (cells.size() == 1) axis = {{cells[0] - 0.5 * half, cells[0] + 0.5 * half}, {0, 0}, axis.edges};
  return axis;
}

std::string image_data(const CellMap& map, const CellAxis& x, const CellAxis& y) {
  std::string data;
  for (std::size_t j = 0; j < y.centres.size(); ++j) {
    for (std::size_t i = 0; i < x.centres.size(); ++i) {
      data += fmt::format("{:.9g} {:.9g} {}\n", x.centres[i], y.centres[j],
                          gnuplot_number(map.values[y.of[j] * map.x.size() + x.of[i]]));
    }
    data += "\n";
  }
  return data + "\n\n";
}

// Step of the tics along an axis of this height in units of the text's size.
double upright_step(const AxisRange& range, const AxisRange& up) {
  constexpr double kApart = 1.7, kFewest = 2, kMost = 10;
  const auto [low, high] = std::minmax(range.first, range.second);
  return tic_step({low, high}, std::clamp((up.second - up.first) / kApart, kFewest, kMost));
}

// Left end of a frame: room for the label and the longest number of its axis.
double left_of(const AxisRange& range, const AxisRange& up) {
  constexpr double kLeast = 5.6, kLabel = 4, kDigit = 0.62;
  const double step = upright_step(range, up);
  const auto [low, high] = std::minmax(range.first, range.second);
  std::size_t longest = 0;
  for (double tic = std::ceil(low / step); tic * step <= high; ++tic)
    longest = std::max(longest, fmt::format("{:.6g}", tic * step).size());
  return std::max(kLeast, kLabel + kDigit * static_cast<double>(longest));
}

// The panel of a profile above the map, with names at its peaks: each on a line that leads to a place of its own.
std::string profile_commands(const Heatmap& figure, const FigureLayout& at, const AxisRange& across,
                             const AxisRange& up) {
  const ProfileAbove& profile = *figure.profile;
  std::string text = margins(at, across, up) + axis_commands("y", profile.y);
  if (profile.y.range) text += fmt::format("set ytics {:g}\n", upright_step(*profile.y.range, up));
  text += "set xlabel ''\nset format x ''\nset grid lc rgb '#d8d8d8' lw 0.6\n";
  const AxisRange range = *figure.x.range;
  const auto screen_x = [&](double x) {
    return across.first + (x - range.first) / (range.second - range.first) * (across.second - across.first);
  };
  const auto screen_y = [&](double y) {
    const AxisRange levels = *profile.y.range;
    return up.first + (y - levels.first) / (levels.second - levels.first) * (up.second - up.first);
  };
  std::vector<ProfileAbove::Peak> peaks = profile.peaks;
  std::ranges::sort(peaks, {}, &ProfileAbove::Peak::x);
  constexpr double kApart = 1.45;  // of neighbouring names
  std::vector<double> places;
  for (const auto& peak : peaks) places.push_back(screen_x(peak.x));
  places = apart(std::move(places), kApart, {across.first, across.second + 1});
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    text += fmt::format("set label {} at screen {:.5f},{:.5f} left rotate by 45 font small\n",
                        gnuplot_text(peaks[i].name), at.x(places[i] + 0.1), at.y(up.second + 0.9));
    for (const auto& [x0, y0, x1, y1] :
         {std::array{screen_x(peaks[i].x), screen_y(peaks[i].value), screen_x(peaks[i].x), up.second},
          std::array{screen_x(peaks[i].x), up.second, places[i], up.second + 0.7}}) {
      text +=
          fmt::format("set arrow from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} nohead lc rgb '#808080' lw 0.6\n",
                      at.x(x0), at.y(y0), at.x(x1), at.y(y1));
    }
  }
  return text;
}

}  // namespace

FigureSize map_size(FigureStyle style) {
  return style == FigureStyle::kPaper ? FigureSize{880, 860, style} : FigureSize{900, 640, style};
}

void write_figure(const Heatmap& figure, const std::filesystem::path& file, FigureSize size) {
  const std::size_t columns = figure.map.x.size(), rows = figure.map.y.size();
  SEAGLINT_CHECK(columns >= 1 && rows >= 1 && figure.map.values.size() == columns * rows,
                 fmt::format("{} values for {} x {} cells", figure.map.values.size(), rows, columns));
  const bool inset = figure.whole.has_value();
  Heatmap shown = figure;
  const CellAxis x = cell_axis(figure.map.x), y = cell_axis(figure.map.y);
  if (!shown.x.range) shown.x.range = x.edges;
  if (!shown.y.range) shown.y.range = y.edges;
  if (figure.upside_down) std::swap(shown.y.range->first, shown.y.range->second);
  std::string data = image_data(figure.map, x, y);

  // Frames: the map, below it the inset with the legend and the small print at its side. Lines of small print depend on
  // the width alone.
  const FigureLayout asked(figure_area(size));
  const double strip_left = inset ? 3.6 + 0.38 * asked.width() : 1.2;
  const bool legend = !figure.rings.empty() || !figure.line.empty();
  const double legend_height = legend ? 1.3 * (!figure.rings.empty() + !figure.line.empty()) + 0.4 : 0;
  const double strip =
      std::max(inset ? 9.0 : 0.0, 0.9 + legend_height + SmallPrint(asked, figure.notes, strip_left).height());
  const double title = figure.profile ? 2.0 : 2.2, bottom = strip + 4.1;
  std::size_t longest = 0;  // name of a peak
  if (figure.profile) {
    for (const auto& peak : figure.profile->peaks) longest = std::max(longest, peak.name.size());
  }
  const double names = longest > 0 ? 1.6 + std::sqrt(0.5) * kSmallCharacter * static_cast<double>(longest) : 0;
  const auto up_to = [&](double height) {
    const double top = height - title - names;
    return AxisRange{bottom, figure.profile ? bottom + 0.5 * (top - bottom) : top};
  };
  AxisRange across{left_of(*shown.y.range, up_to(asked.height())), asked.width() - (figure.right ? 12.4 : 7)};
  std::optional<double> x_step;
  if (figure.equal_axes) {
    constexpr double kApart = 2.6;  // of tics
    constexpr double kHighest = 1;  // of the width
    const double ratio =
        std::abs((shown.y.range->second - shown.y.range->first) / (shown.x.range->second - shown.x.range->first));
    const double room = kHighest * asked.width() - bottom - title,
                 wide = std::min(across.second - across.first, room / ratio);
    size.height = static_cast<int>(std::lround(size.width * (bottom + wide * ratio + title) / asked.width()));
    const double middle = 0.5 * (across.first + across.second);
    across = {middle - 0.5 * wide, middle + 0.5 * wide};
    x_step = tic_step(*shown.x.range, std::clamp(wide / kApart, 3.0, 10.0));
  }
  const FigureLayout at(figure_area(size));
  const SmallPrint notes(at, figure.notes, strip_left);
  const AxisRange up = up_to(at.height());
  const double top = at.height() - title - names;

  std::string commands = "set multiplot\nunset key\n";
  commands += figure.diverging ? kBlueWhiteRed : viridis_palette();
  commands += notes.commands(strip - legend_height - 0.6);
  commands += fmt::format("set label {} at screen {:.5f},{:.5f} center\n", gnuplot_text(figure.title),
                          at.x(0.5 * (across.first + across.second)), at.y(at.height() - 1.2));
  commands += axis_commands("x", shown.x);
  std::size_t index = 1;
  if (figure.profile) {
    const AxisRange above{up.second + 0.8, top};
    commands += profile_commands(shown, at, across, above);
    for (std::size_t i = 0; i < columns; ++i)
      data += fmt::format("{:.9g} {}\n", figure.map.x[i], gnuplot_number(figure.profile->values[i]));
    data += "\n\n";
    commands += fmt::format(
        "plot {} index {} using 1:2 with lines lc rgb '{}' lw 1.2\nunset label\nunset arrow\nunset grid\nset "
        "format x\n",
        kGnuplotData, index++, figure.profile->colour);
    commands += axis_commands("x", shown.x);
  }
  commands += margins(at, across, up) + axis_commands("y", shown.y) + axis_commands("cb", figure.colour);
  if (x_step) commands += fmt::format("set xtics {:g}\n", *x_step);
  commands += fmt::format("set ytics {:g}\n", upright_step(*shown.y.range, up));
  if (figure.colour.range) commands += fmt::format("set cbtics {:g}\n", upright_step(*figure.colour.range, up));
  commands +=
      "set xlabel offset 0,0.4+0.25*label_shift\nset ylabel offset label_shift,0\nset cblabel offset "
      "1-0.4*label_shift,0\n";
  commands += fmt::format("set colorbox user origin screen {:.5f},{:.5f} size screen {:.5f},{:.5f}\n",
                          at.x(across.second + (figure.right ? 6.4 : 0.9)), at.y(up.first), at.x(1),
                          at.y(up.second - up.first));
  if (figure.right) {
    const auto right_value = [&](double value) { return (value - figure.right->zero) / figure.right->unit; };
    commands += fmt::format("set y2tics out\nset y2label {} offset 0.5-0.4*label_shift,0\nset y2range [{}:{}]\n",
                            gnuplot_text(figure.right->label), gnuplot_number(right_value(shown.y.range->first)),
                            gnuplot_number(right_value(shown.y.range->second)));
  }
  if (legend) {
    commands += fmt::format(
        "set key at screen {:.5f},{:.5f} left top vertical Left reverse samplen 1.5 spacing 1.1 font small\n",
        at.x(strip_left - 0.5), at.y(strip));
  }
  commands += fmt::format("plot {} index 0 using 1:2:3 with image notitle", kGnuplotData);
  const auto drawn = [&](const std::vector<std::array<double, 2>>& points, const std::string& style,
                         const std::string& name, const char* colour = kMarks) {
    if (points.empty()) return;
    for (const auto& point : points) data += fmt::format("{} {}\n", gnuplot_number(point[0]), gnuplot_number(point[1]));
    data += "\n\n";
    commands += fmt::format(", {} index {} using 1:2 with {} lc rgb '{}' title {}", kGnuplotData, index++, style,
                            colour, gnuplot_text(name));
  };
  drawn(figure.outline, "lines lw 0.6", "", "#60ffffff");
  drawn(figure.line, "lines lw 1.4 dt 2", figure.line_name);
  drawn(figure.rings, "points pt 6 ps 1.3*mark_size lw 1.4", figure.ring_name);
  commands += "\nunset label\nunset key\n";
  if (inset) {
    const CellAxis whole_x = cell_axis(figure.whole->x), whole_y = cell_axis(figure.whole->y);
    data += image_data(*figure.whole, whole_x, whole_y);
    const FigureAxis x_axis{"", whole_x.edges, false}, y_axis{"", whole_y.edges, false};
    commands += "unset colorbox\nunset y2tics\nunset y2label\nset border lw 0.5\nset tics out nomirror font small\n";
    commands += margins(at, {3.4, 2.4 + 0.38 * at.width()}, {1.7, strip - 0.6});
    commands += axis_commands("x", x_axis) + axis_commands("y", y_axis);
    commands += fmt::format("set xtics {:g} offset 0,0.5\nset ytics {:g} offset 0.6,0\n", tic_step(whole_x.edges, 5),
                            tic_step(whole_y.edges, 5));
    commands += fmt::format(
        "set label 'whole map' at graph 0.03,0.88 left font small tc rgb '#ffffff' front\nset object rectangle from "
        "{},{} to {},{} front fs empty border lc rgb '{}' lw 1\n",
        gnuplot_number(shown.x.range->first), gnuplot_number(shown.y.range->first),
        gnuplot_number(shown.x.range->second), gnuplot_number(shown.y.range->second), kMarks);
    commands += fmt::format("plot {} index {} using 1:2:3 with image notitle\n", kGnuplotData, index++);
  }
  draw_by_gnuplot(file, size, data, commands + "unset multiplot\n");
}

void write_figure(const HeatmapPanels& figure, const std::filesystem::path& file) {
  SEAGLINT_CHECK(!figure.maps.empty() && figure.columns >= 1,
                 fmt::format("{} maps in {} columns", figure.maps.size(), figure.columns));
  constexpr double kHeightOverWidth = 0.62;
  FigureSize size{.width = figure.width, .height = figure.width, .style = figure.style};
  const FigureArea square = figure_area(size);
  const double width = square.width / square.em;
  const std::size_t columns = std::min(figure.maps.size(), static_cast<std::size_t>(figure.columns));
  FrameGrid grid{
      .columns = columns, .rows = (figure.maps.size() + columns - 1) / columns, .across = {5.4, width - 7.2}, .up = {}};
  const auto axes_of = [](const Heatmap& map) {
    return std::pair{map.x.range.value_or(cell_axis(map.map.x).edges),
                     map.y.range.value_or(cell_axis(map.map.y).edges)};
  };
  const bool one_range = std::ranges::all_of(
      figure.maps, [&](const Heatmap& map) { return axes_of(map) == axes_of(figure.maps.front()); });
  grid.apart[0] = one_range ? 0.9 : 3.6;

  // Texts above each frame, of one height: the title, then the small print.
  const auto texts = [&](const FigureLayout& at, std::size_t i) {
    const AxisRange across = grid.across_of(i);
    const Heatmap& map = figure.maps[i];
    return std::array{SmallPrint(at, {map.title}, across.first, across.second, "#000000"),
                      SmallPrint(at, map.notes, across.first, across.second)};
  };
  const FigureLayout unknown_height(square);
  double above = 0;
  for (std::size_t i = 0; i < figure.maps.size(); ++i) {
    const auto [title, notes] = texts(unknown_height, i);
    above = std::max(above, title.height() + notes.height() + 0.4);
  }
  const SmallPrint below(unknown_height, figure.notes, 1.2);
  const double head = figure.title.empty() ? 0.4 : 2.2,
               bottom = below.height() + (figure.notes.empty() ? 0 : 0.8) + 3.2;
  grid.apart[1] = above + (one_range ? 0.4 : 1.7);
  const AxisRange first = grid.across_of(0);
  const double rows = static_cast<double>(grid.rows);
  const double height =
      bottom + rows * kHeightOverWidth * (first.second - first.first) + (rows - 1) * grid.apart[1] + above + head;
  grid.up = {bottom, height - head - above};
  size.height = static_cast<int>(std::lround(figure.width * height / width));
  const FigureLayout at(figure_area(size));

  const FigureAxis& colour = figure.maps.front().colour;
  std::string data, commands = "set multiplot\nunset key\nset tics out nomirror font small\n";
  commands += figure.maps.front().diverging ? kBlueWhiteRed : viridis_palette();
  commands += axis_commands("cb", colour) + "set cblabel offset 1-0.4*label_shift,0\n";
  commands += fmt::format("set colorbox user origin screen {:.5f},{:.5f} size screen {:.5f},{:.5f}\n",
                          at.x(grid.across.second + 0.9), at.y(grid.up_of(figure.maps.size() - 1).first), at.x(1),
                          at.y(grid.up.second - grid.up_of(figure.maps.size() - 1).first));
  commands += SmallPrint(at, figure.notes, 1.2).commands(below.height() - 0.3);
  if (!figure.title.empty()) {
    commands +=
        fmt::format("set label {} at screen 0.5,{:.5f} center\n", gnuplot_text(figure.title), at.y(height - 1.2));
  }
  commands += fmt::format(
      "set label {} at screen {:.5f},{:.5f} center\nset label {} at screen {:.5f},{:.5f} center rotate by 90\n",
      gnuplot_text(figure.maps.front().x.label), at.x(0.5 * (grid.across.first + grid.across.second)),
      at.y(bottom - 2.5), gnuplot_text(figure.maps.front().y.label), at.x(1.2),
      at.y(0.5 * (grid.up.first + grid.up.second)));
  for (std::size_t i = 0; i < figure.maps.size(); ++i) {
    const Heatmap& map = figure.maps[i];
    const auto [title, notes] = texts(at, i);
    const AxisRange across = grid.across_of(i), up = grid.up_of(i);
    const auto [x, y] = axes_of(map);
    data += image_data(map.map, cell_axis(map.map.x), cell_axis(map.map.y));
    commands += title.commands(up.second + title.height() + notes.height() - 0.4) +
                notes.commands(up.second + notes.height() - 0.4);
    const bool is_lowest = i + columns >= figure.maps.size();
    commands += margins(at, across, up) + axis_commands("x", {"", x, false}) + axis_commands("y", {"", y, false});
    commands += fmt::format("set format x '{}'\nset format y '{}'\nset xtics {:g} offset 0,0.4\nset ytics {:g}\n",
                            one_range && !is_lowest ? "" : "%g", one_range && !grid.is_left(i) ? "" : "%g",
                            tic_step(x, 5), tic_step(y, 5));
    commands +=
        fmt::format("plot {} index {} using 1:2:3 with image notitle\nunset label\nunset colorbox\n", kGnuplotData, i);
  }
  draw_by_gnuplot(file, size, data, commands + "unset multiplot\n");
}

std::vector<double> levels_db(std::span<const float> magnitudes) {
  const float peak = magnitudes.empty() ? 0 : std::ranges::max(magnitudes);
  std::vector<double> levels;
  for (const float magnitude : magnitudes) {
    const double ratio = peak > 0 ? magnitude / peak : 0;
    levels.push_back(ratio > 0 ? std::max(kMapFloorDb, 20 * std::log10(ratio)) : kMapFloorDb);
  }
  return levels;
}

FigureAxis level_axis(const std::string& quantity) {
  return {quantity + " relative to its peak (dB)", AxisRange{kMapFloorDb, 0}, false};
}

std::vector<std::string> radar_print(const RadarSpec& radar) {
  constexpr const char* kPolarisations[] = {"HH", "HV", "VH", "VV"};
  const double length_s = 1e-6 * radar.pri_us * radar.pulses;
  std::string carrier = fmt::format("carrier {:g} GHz", radar.carrier_ghz);
  if (radar.carrier_count > 1) carrier += fmt::format(" + {} x {:g} MHz", radar.carrier_count, radar.hop_step_mhz);
  return {fmt::format("{}, {}", carrier, kPolarisations[static_cast<std::size_t>(radar.polarisation)]),
          fmt::format("{} pulses in {:.3g} {}", radar.pulses, length_s < 1 ? 1e3 * length_s : length_s,
                      length_s < 1 ? "ms" : "s")};
}

std::vector<std::string> small_print(const Scenario& scenario, const RadarSpec& radar, const SampleRecord& record) {
  std::vector<std::string> notes = radar_print(radar);
  notes.push_back(fmt::format("azimuth {:g} deg, elevation {:g} deg", record.azimuth_deg, record.elevation_deg));
  std::string sea = fmt::format("Hs {:g} m", record.significant_wave_height_m);
  if (record.significant_wave_height_m > 0) {
    sea += fmt::format(", Tp {:.3g} s towards {:g} deg", record.peak_period_s, record.propagation_deg);
  }
  notes.push_back(sea);
  notes.push_back(fmt::format("{}, sample {}, seed {}", scenario.name, record.sample, scenario.seed));
  return notes;
}

namespace {

// Interval of an axis around the given one: at least `least` cells, whole ones, inside the axis.
AxisRange whole_cells(AxisRange wanted, const std::vector<double>& cells, double least) {
  const double step = step_of(cells), start = cells.front() - 0.5 * step, end = cells.back() + 0.5 * step;
  const double more = 0.5 * (least * step - (wanted.second - wanted.first));
  if (more > 0) wanted = {wanted.first - more, wanted.second + more};
  wanted.first = start + step * std::floor((wanted.first - start) / step + 1e-9);
  wanted.second = start + step * std::ceil((wanted.second - start) / step - 1e-9);
  return {std::max(wanted.first, start), std::min(wanted.second, end)};
}

}  // namespace

TargetWindow target_window(const Sample& sample, const StoredAxes& axes) {
  constexpr double kBelowPeakDb = -30, kRangeMargin = 0.08, kVelocityMargin = 0.15;
  constexpr double kMarginCells[2] = {4, 2}, kLeastCells[2] = {24, 9};  // range, velocity
  constexpr double kFull = 0.8;                                         // of the map's area
  if (sample.centre_list.empty()) return {{}, "no scattering centre above clutter and noise"};
  float strongest = 0;
  for (const StoredCentre& centre : sample.centre_list) strongest = std::max(strongest, centre[2]);
  AxisRange range{1e300, -1e300}, velocity = range;
  for (const StoredCentre& centre : sample.centre_list) {
    if (centre[2] < strongest * std::pow(10, kBelowPeakDb / 20)) continue;
    range = {std::min<double>(range.first, centre[0]), std::max<double>(range.second, centre[0])};
    velocity = {std::min<double>(velocity.first, centre[1]), std::max<double>(velocity.second, centre[1])};
  }
  const auto with_margin = [&](AxisRange of, const std::vector<double>& cells, double margin, int axis) {
    const double more = std::max(kMarginCells[axis] * step_of(cells), margin * (of.second - of.first));
    return whole_cells({of.first - more, of.second + more}, cells, kLeastCells[axis]);
  };
  const MapWindow window{with_margin(range, axes.range_m, kRangeMargin, 0),
                         with_margin(velocity, axes.velocity_mps, kVelocityMargin, 1)};
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(sample.magnitude) - sample.magnitude.begin());
  const double peak_range = axes.range_m[peak % axes.range_m.size()],
               peak_velocity = axes.velocity_mps[peak / axes.range_m.size()];
  if (peak_range < window.x.first || peak_range > window.x.second || peak_velocity < window.y.first ||
      peak_velocity > window.y.second)
    return {{}, "the strongest cell is none of the target's centres"};
  const double part = (window.x.second - window.x.first) * (window.y.second - window.y.first) /
                      (step_of(axes.range_m) * step_of(axes.velocity_mps) * static_cast<double>(axes.cells()));
  if (part > kFull) return {};
  return {window, {}};
}

MagnitudeMap magnitude_map(const RvMap& map) {
  MagnitudeMap out{{map.range_m, map.velocity_mps}, {}};
  for (const Complex& value : map.values) out.magnitude.push_back(static_cast<float>(std::abs(value)));
  return out;
}

CellMap levels_in(const StoredAxes& axes, std::span<const float> magnitudes, const std::optional<MapWindow>& window) {
  const std::vector<double> levels = levels_db(magnitudes);
  const auto inside = [](double value, const AxisRange& range) { return value > range.first && value < range.second; };
  CellMap part;
  for (std::size_t j = 0; j < axes.velocity_mps.size(); ++j) {
    if (window && !inside(axes.velocity_mps[j], window->y)) continue;
    part.y.push_back(axes.velocity_mps[j]);
    for (std::size_t i = 0; i < axes.range_m.size(); ++i) {
      if (window && !inside(axes.range_m[i], window->x)) continue;
      if (part.y.size() == 1) part.x.push_back(axes.range_m[i]);
      part.values.push_back(levels[j * axes.range_m.size() + i]);
    }
  }
  return part;
}

Heatmap rv_figure(const RvFigureRequest& request) {
  const Sample& sample = request.sample;
  const SampleRecord& record = sample.record;
  Heatmap figure;
  const bool has_target = record.bodies > 0;
  figure.title = fmt::format("{}, azimuth {:g} deg, Hs {:g} m", has_target ? record.target_name : "sea alone",
                             record.azimuth_deg, record.significant_wave_height_m);
  figure.x.label = "range (m)";
  figure.y.label = "velocity (m/s)";
  figure.colour = level_axis("|RV|");
  figure.map = levels_in(request.axes, sample.magnitude, {});
  if (!request.whole && has_target) {
    const TargetWindow target = target_window(sample, request.axes);
    if (target.window) {
      figure.whole = std::move(figure.map);
      figure.map = request.fine ? levels_in(request.fine->axes, request.fine->magnitude, target.window)
                                : levels_in(request.axes, sample.magnitude, target.window);
    }
    if (!target.reason.empty()) figure.notes.push_back("whole map: " + target.reason);
  }
  figure.notes.push_back("positive = farther, receding");
  if (std::isfinite(record.scr_per_pulse_db))
    figure.notes.push_back(fmt::format("SCR {:.3g} dB per pulse", record.scr_per_pulse_db));
  if (!request.centres || sample.centre_list.empty()) return figure;
  double first = 1e300, last = -1e300;
  for (const StoredCentre& centre : sample.centre_list) {
    figure.rings.push_back({centre[0], centre[1]});
    first = std::min<double>(first, centre[0]);
    last = std::max<double>(last, centre[0]);
  }
  figure.ring_name =
      fmt::format("{} scattering centre{}", sample.centre_list.size(), sample.centre_list.size() == 1 ? "" : "s");
  if (sample.centre_list.size() < 3) return figure;
  const auto end = [&](double r) { return std::array{r, request.line.offset + request.line.slope * r}; };
  figure.line = {end(first), end(last)};
  figure.line_name = fmt::format("fitted line, MWR {:.2g} (m/s)^2", record.mwr);
  return figure;
}

}  // namespace seaglint
