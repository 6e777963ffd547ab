// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tracks of scattering centres over looks: coherent intervals of one target, some tenths of a second apart. Each look
// has its own centres. A track joins those of one scatterer.

#include <span>
#include <vector>

#include "classify/features/scattering_centres.h"
#include "sim/core/numbers/dense.h"

namespace seaglint {

// Standard errors of a point in one look.

// What a look resolves: cells of c / (2 B) in range and of lambda / (2 T) in velocity. All three are positive.
struct CoherentInterval {
  double bandwidth_hz = 0;  // synthetic bandwidth B
  double duration_s = 0;    // T, from the first pulse to the end of the last pulse period
  double wavelength_m = 0;  // lambda, at the band's centre

  double range_cell_m() const;
  double velocity_cell_mps() const;
};

struct PointErrors {
  double range_m = 0;
  double velocity_mps = 0;
};

// Bound of Cramer and Rao of a point's range and velocity. Uniform weights over a uniformly sampled band and interval
// (Rife and Boorstyn 1974, Table I, for many samples; Kay 1993, eq. 3.41), with the signal-to-noise ratio
// S = (amplitude over floor)^2 of the map's peak:
//   sigma_r = sqrt(6 / S) c / (4 pi B)     sigma_v = sqrt(6 / S) lambda / (4 pi T)
// The maximum of the map reaches the bound from S = 20 (13 dB). A Hann taper raises the error of its axis by 1.25.
// `amplitude_over_floor`: the centre's amplitude over the root of the mean power of noise and clutter per cell; > 0.
PointErrors cramer_rao_errors(double amplitude_over_floor, const CoherentInterval& interval);

// Largest error of CLEAN's centres without noise, cells (CleanCentres.OfKnownPoints*): the pedestals and side lobes of
// other centres.
inline constexpr double kFitErrorCells = 0.013;

struct LookCentre : ScatteringCentre {
  double range_error_m = 0;
  double velocity_error_mps = 0;
};

// The centre with its standard errors. The bound of Cramer and Rao and the error of the fit are independent: their
// squares add. `floor_m`: root of the mean power of noise and clutter per cell, m; > 0.
LookCentre with_errors(const ScatteringCentre& centre, double floor_m, const CoherentInterval& interval,
                       double fit_error_cells = kFitErrorCells);

// Association over looks.

struct Look {
  double time_s = 0;  // centre of the interval
  std::vector<LookCentre> centres;
};

// A centre may continue a track last seen dt seconds before, if
//   |r' - r - dt (v + v')/2| <= range_gate_m             (trapezoidal rule: error |d3r/dt3| dt^3 / 12)
//   |v' - v|                 <= velocity_gate_mps + acceleration_gate_mps2 dt
//   |20 log10(A' / A)|       <= level_gate_db
// The pair costs the sum of the three left sides, each over its scale; the scale of velocity is
// velocity_scale_mps + acceleration_scale_mps2 dt. The gates hold for dt of some tenths of a second up to 1.5 s. Floats
// follow the water: at Hs 2 m, Tp 7 s its accelerations have a standard deviation of 0.4 m/s^2. Identity changes by 0.5
// % for range scales of 0.03 to 0.08 m and acceleration gates from 1.5 m/s^2 (README.md).
struct TrackSettings {
  double range_gate_m = 0.6;
  double velocity_gate_mps = 0.15;
  double acceleration_gate_mps2 = 2;
  double level_gate_db = 15;
  double range_scale_m = 0.05;
  double velocity_scale_mps = 0.1;
  double acceleration_scale_mps2 = 0.6;
  double level_scale_db = 6;
  int missed_looks = 2;        // most looks in a row without a centre
  double seen_fraction = 0.7;  // least part of the looks with a centre; clutter's centres do not last
};

struct TrackPoint {
  int centre = -1;      // index in the look's centres; -1: not seen, and the measured values are 0
  LookCentre measured;  // as the look has it

  bool seen() const { return centre >= 0; }
};

struct Track {
  std::vector<TrackPoint> points;  // one per look

  int looks_seen() const;
};

struct TrackSet {
  std::vector<double> time_s;  // one per look
  std::vector<Track> tracks;   // by first look, then by range in it
};

// Associates look by look. The assignment of centres to open tracks has the most pairs and of those the smallest sum
// of costs. A centre without a track starts one; a track ends after more than `missed_looks` looks without a centre.
// Tracks seen in fewer looks than `seen_fraction` of all are left out. The result does not depend on the order of the
// centres, except for the indices in it and between centres with equal values. Throws InputError unless times increase,
// values are finite, amplitudes and errors positive.
TrackSet associate(std::span<const Look> looks, const TrackSettings& settings = {});

// Exact assignment: each row gets a column of its own or none, so that the sum of costs is smallest; a row without a
// column costs `unassigned`. Shortest augmenting paths (Jonker and Volgenant 1987; Crouse 2016, algorithm 1), of order
// rows^2 (rows + columns). Costs are finite or infinity, which forbids the pair. Returns the column of each row or -1.
std::vector<int> assignment(const Matrix<double>& cost, double unassigned);

}  // namespace seaglint
