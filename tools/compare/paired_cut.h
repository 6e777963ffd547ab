// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Values of a reference beside those of a sweep at the same directions and frequencies, and the statistics of their
// differences.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/figure/figure.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

// Variable that changes along a cut.
enum class CutAxis { kAzimuth, kElevation, kFrequency, kSeveral };

const char* axis_unit(CutAxis axis);  // "deg", "GHz"

// Values of one reference at directions and frequencies of the sweep, in the sweep's order.
struct PairedCut {
  std::string reference;
  Polarisation element = Polarisation::kHh;
  bool total = false;  // levels of |S|^2 summed over both received polarisations, no phases (RcsCut)
  CutAxis axis = CutAxis::kAzimuth;
  std::optional<double> frequency_hz;  // absent if it varies along the cut
  std::string place;                   // in titles: what else is fixed along the cut; may be empty
  std::vector<double> x;               // deg or GHz; the running number when several axes vary
  std::vector<double> level_dbsm;
  std::vector<Complex> amplitude_m;  // of the reference, phase origin at the body's origin; empty without phases
  Vec3 origin_m = Vec3::Zero();      // its own, which was removed as of e^{+jwt}
  struct Place {
    std::size_t view = 0, frequency = 0;  // in the sweep
    double frequency_hz = 0, azimuth_deg = 0, elevation_deg = 0;
    Vec3 path_gradient = Vec3::Zero();  // k (r^_t + r^_s), rad/m
    int line = 0;                       // of the reference's file
  };
  std::vector<Place> places;
  struct Model {
    std::string name;
    std::vector<double> level_dbsm;
    std::vector<Complex> amplitude_m;
  };
  std::vector<Model> models;
  std::optional<Model> flat;  // the last model with flat facets, where the sweep has it
  // Exact or closed-form levels of a recognised body, NaN at places to which none applies; without amplitudes.
  std::optional<Model> known = {};

  std::size_t quantity() const { return quantity_of(element, total); }
};

// Matches directions within 0.001 deg and frequencies within a relative 1e-6; nothing is interpolated. One cut per
// frequency, or a single cut if there is one direction; none without a match. Throws InputError if the reference
// declares another transmitter direction than the sweep's.
std::vector<PairedCut> paired_cuts(const RcsSweep& sweep, const RcsCut& reference);

// The same; throws InputError if nothing matches, naming the content of both.
std::vector<PairedCut> match_reference(const RcsSweep& sweep, const RcsCut& reference);

// Fills the cut's models from the sweep that it was matched with, once that is computed.
void set_models(PairedCut& cut, const RcsSweep& sweep);

// Differences of a computed sweep from a reference: error statistics, figure.

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

// Draws them; false if there are none.
bool draw_comparison(const std::vector<PairedCut>& cuts, double floor_db, const std::string& title,
                     const std::filesystem::path& file);

}  // namespace seaglint
