// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How values of a reference and compared ones differ: error statistics, positions of lobes and nulls, range profiles,
// figures.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/compare/paired_cut.h"
#include "tools/figure/map_figure.h"
#include "tools/rcs/turntable_figure.h"

namespace seaglint {

// Levels further below the strongest are rounding, as the cross-polar ones of a symmetric body: single precision is 144
// dB.
inline constexpr double kRounding_db = 120;

struct Difference {
  std::size_t points = 0;
  double mean_db = 0;  // of |computed - reference|
  double rms_db = 0;
  double largest_db = 0;               // with its sign
  double largest_at = 0;               // x there
  double bias_db = 0;                  // mean of computed - reference
  std::optional<Complex> correlation;  // <conj(reference) computed> / (|reference| |computed|)
};

// Sums the differences of pairs of values.
class DifferenceSum {
 public:
  // Both levels are raised to at least floor_dbsm; x is where they stand. Returns computed - reference, dB.
  double add(double computed_dbsm, double reference_dbsm, double floor_dbsm, double x);
  void add_phases(const Complex& computed, const Complex& reference);
  Difference difference() const;  // of at least one pair
  std::optional<Complex> correlation() const;

 private:
  Difference sums_;
  Complex product_ = 0;
  double computed_power_ = 0, reference_power_ = 0;
};

// Statistics after levels of both are raised to at least floor_db below the reference maximum (error measure of the
// Austin suite, with 80 dB).
Difference error_statistics(const PairedCut& cut, const PairedCut::Model& model, double floor_db);

// Text table with one line per cut and model.
std::string error_table(const std::vector<PairedCut>& cuts, double floor_db);

// Levels above and differences below, one column per frequency and polarisation, at most four; the area between the
// last model and flat facets is filled. Empty if no cut has an axis to draw along.
PlotPanels comparison_plots(const std::vector<PairedCut>& cuts, double floor_db);

// Levels of the reference and of its last model, and their difference, of the strongest quantity over azimuth and
// frequency, or over elevation and frequency, at the other angle of the cut with the highest level. Empty without three
// even steps of either, and where places are missing.
std::vector<Heatmap> comparison_images(const std::vector<PairedCut>& cuts, double floor_db);

// Lobes, nulls and range profiles of curves.

struct Extremum {
  double x = 0, level_db = 0;  // of the parabola through the three values
};

// Local maxima (lobes) or minima (nulls) of levels over ascending x that differ from the extrema beside them by at
// least 3 dB, above lowest_db. Uneven steps are allowed.
std::vector<Extremum> lobes_of(std::span<const double> x, std::span<const double> level_db, double lowest_db);
std::vector<Extremum> nulls_of(std::span<const double> x, std::span<const double> level_db, double lowest_db);

// Extrema of the reference with the nearest one of the other curve, nearer to it than to any other of the reference.
struct ExtremumPairs {
  std::size_t count = 0;  // of the reference
  std::size_t paired = 0;
  double mean_shift = 0;  // mean of |x - x_reference|, in the unit of x
  double mean_db = 0;     // mean of |level - level_reference|
};
ExtremumPairs paired_extrema(std::span<const Extremum> reference, std::span<const Extremum> other);

// Range profiles of amplitudes over frequency, side by side.

struct RangeProfile {
  std::vector<double> range_m;  // from the phase origin along the bisector of both directions, positive = farther
  std::vector<double> level_dbsm;
};

// |sum_f w_f S_f e^{+j q R}|^2 4 pi with Hann's window of mean 1, q = 2 k cos(beta / 2) the length of the path
// gradient: a point scatterer has its own level. Over the unambiguous range 2 pi / step of q, four values per
// resolution cell. At least 8 uniform steps of frequency (within a hundredth of a step), else empty.
RangeProfile range_profile(std::span<const PairedCut::Place> places, std::span<const Complex> amplitude_m);

// The profile's level at one range (m), of any frequencies.
double level_at_range(std::span<const PairedCut::Place> places, std::span<const Complex> amplitude_m, double range_m);

// Those of export and compared values for the first four cuts over frequency that have phases, of one antenna with
// names at the strongest peaks of the compared values; empty if none does.
PlotPanels range_profile_plots(std::span<const PairedCut> cuts, const PeakNames& names = {});

// True if all steps of ascending values, two or more, are equal within a fiftieth.
bool are_uniform(const std::vector<double>& values);

// True if transmitter and receiver are in one direction.
bool is_monostatic(const PairedCut::Place& place);

}  // namespace seaglint
