// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A computed sweep beside a reference: which values belong together, how far apart they are, and the picture of both.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/rcs/rcs_reference.h"
#include "tools/rcs/rcs_sweep.h"

namespace seaglint {

// What a cut runs along.
enum class CutAxis { kAzimuth, kElevation, kFrequency, kSeveral };

// The values of one reference that the sweep has too, in the sweep's order.
struct PairedCut {
  std::string reference;
  Polarisation element = Polarisation::kHh;
  CutAxis axis = CutAxis::kAzimuth;
  std::optional<double> frequency_hz;  // absent when the cut runs along it
  std::vector<double> x;               // deg or GHz; the running number when several axes vary
  std::vector<double> level_dbsm;
  std::vector<Complex> amplitude_m;  // of the reference about the body's origin; empty without phases
  struct Place {
    std::size_t view = 0, frequency = 0;
  };
  std::vector<Place> places;  // in the sweep
  struct Model {
    std::string name;
    std::vector<double> level_dbsm;
    std::vector<Complex> amplitude_m;
  };
  std::vector<Model> models;
};

// The sweep's directions and frequencies that the reference holds to 0.001 deg and 1e-6 of the frequency; nothing is
// interpolated. One cut for each frequency, or one in all when there is one direction. Throws InputError when nothing
// fits, with what either side holds, and when the reference says that its transmitter stands elsewhere than the
// sweep's.
std::vector<PairedCut> match_reference(const RcsSweep& sweep, const RcsReference& reference);

// Takes the cut's models from the sweep that it was paired with, once its models are computed.
void set_models(PairedCut& cut, const RcsSweep& sweep);

struct Difference {
  std::size_t points = 0;
  double mean_db = 0;  // of |computed - reference|
  double rms_db = 0;
  double largest_db = 0;               // with its sign
  double largest_at = 0;               // x there
  double bias_db = 0;                  // mean of computed - reference
  std::optional<Complex> correlation;  // <conj(reference) computed> / (|reference| |computed|)
};

// Levels of both sides are lifted to floor_db below the reference's maximum first (the Austin suite's error measure
// with 80 dB).
Difference error_statistics(const PairedCut& cut, const PairedCut::Model& model, double floor_db);

// One line for every cut and model.
std::string error_table(const std::vector<PairedCut>& cuts, double floor_db);

// Levels above, differences below; a column for each frequency and polarisation, at most four. False when there is
// nothing to draw a line along.
bool draw_comparison(const std::vector<PairedCut>& cuts, double floor_db, const std::string& title,
                     const std::filesystem::path& file);

}  // namespace seaglint
