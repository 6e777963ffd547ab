// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figures of maps: levels over two axes with the target's own window, the whole as an inset, scattering centres, the
// fitted line, a profile above, and small print that names radar, aspect, sea and sample.

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "classify/dataset/format/sample.h"
#include "classify/features/feature_vector.h"
#include "radar/rvmap/rv_map.h"
#include "sim/scenario/scenario.h"
#include "tools/figure/figure.h"

namespace seaglint {

inline constexpr double kMapFloorDb = -40;  // of every map, relative to its strongest cell

// Values of equal cells over two axes.
struct CellMap {
  std::vector<double> x, y;    // centres of the cells, ascending
  std::vector<double> values;  // [y][x]; NaN is drawn white
};

// Part of a map along both axes, edges of cells.
struct MapWindow {
  AxisRange x, y;

  bool operator==(const MapWindow&) const = default;
};

// Axis at the right-hand side: 0 at y = `zero`, one unit per `unit` of y.
struct RightAxis {
  std::string label;
  double zero = 0, unit = 1;
};

// Values above a heat map, along its x axis.
struct ProfileAbove {
  FigureAxis y;
  std::vector<double> values;  // one per cell of x
  std::string colour = kComputedColour;
  struct Peak {
    double x = 0, value = 0;
    std::string name;
  };
  std::vector<Peak> peaks;  // their names are written above
};

struct Heatmap {
  std::string title;
  FigureAxis x, y;
  FigureAxis colour;             // values outside its range are clipped
  bool diverging = false;        // blue below the middle of the colour's range, white there, red above
  CellMap map;                   // shown over the range of its axes, or that of `x` and `y`
  std::optional<CellMap> whole;  // an inset, with a frame around what is shown
  bool upside_down = false;      // y grows downwards
  bool equal_axes = false;       // one metre is one metre in x and y; the figure is as high as that needs
  std::optional<RightAxis> right;
  std::optional<ProfileAbove> profile;
  std::vector<std::array<double, 2>> rings;  // x, y
  std::string ring_name;                     // in the legend
  std::vector<std::array<double, 2>> line;   // x, y of its ends
  std::string line_name;
  std::vector<std::array<double, 2>> outline;  // x, y of thin lines, each ended by NaN
  std::vector<std::string> notes;              // phrases of the small print
};

// Throws as draw_by_gnuplot().
void write_figure(const Heatmap& figure, const std::filesystem::path& file, FigureSize size = {});

// Several heat maps of one quantity in rows, with one colour bar, that of the first: title and small print of each
// stand above it; insets, profiles, rings, lines and right axes are not drawn. Where all show the same ranges, numbers
// stand at the left and the lower edge alone. The height follows from the rows: each map is 0.62 of its width high.
struct HeatmapPanels {
  std::vector<Heatmap> maps;
  int columns = 4;
  FigureStyle style = FigureStyle::kScreen;
  int width = 1300;                     // on a screen, pixels
  std::string title = {};               // above all
  std::vector<std::string> notes = {};  // phrases of the small print below all
};

// Throws as draw_by_gnuplot().
void write_figure(const HeatmapPanels& figure, const std::filesystem::path& file);

// Size of a heat map's figure in a style.
FigureSize map_size(FigureStyle style);

// Magnitudes in dB relative to the largest, at least kMapFloorDb.
std::vector<double> levels_db(std::span<const float> magnitudes);
// The axis of such levels of a quantity, "|RV|".
FigureAxis level_axis(const std::string& quantity);

// Phrases of the small print: carriers and polarisation, pulses and their duration.
std::vector<std::string> radar_print(const RadarSpec& radar);

// Small print of a sample's figure: carrier, polarisation, pulses; aspect; sea; scenario, sample and seed. `radar`:
// with the sample's drawn values.
std::vector<std::string> small_print(const Scenario& scenario, const RadarSpec& radar, const SampleRecord& record);

// The target's own part of a map: all scattering centres within 30 dB of the strongest, with a margin. The centres are
// free of the hop code's pedestal and above clutter and noise, which the cells above a level are not. Absent, with the
// reason: without centres, where the strongest cell is outside them, and where they fill the map (no reason).
struct TargetWindow {
  std::optional<MapWindow> window;
  std::string reason;
};
TargetWindow target_window(const Sample& sample, const StoredAxes& axes);

// The magnitudes of a map and its axes.
struct MagnitudeMap {
  StoredAxes axes;
  std::vector<float> magnitude;  // m, [velocity][range]
};
MagnitudeMap magnitude_map(const RvMap& map);

// The levels of a map within a window, or of the whole.
CellMap levels_in(const StoredAxes& axes, std::span<const float> magnitudes, const std::optional<MapWindow>& window);

struct RvFigureRequest {
  const Sample& sample;
  const StoredAxes& axes;
  VelocityLine line;  // fitted to the centres: drawn from three centres on
  bool whole = false;
  bool centres = true;  // draw rings and line
  // The same map with finer cells, for the target's window; null: the sample's own cells.
  const MagnitudeMap* fine = nullptr;
};
// Range-velocity map of a sample; notes are what concerns the window and the axes.
Heatmap rv_figure(const RvFigureRequest& request);

}  // namespace seaglint
