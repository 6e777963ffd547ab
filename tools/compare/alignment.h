// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What brings two sets of values into agreement: constant phase, phase origin, conjugation and signs of amplitudes;
// what levels that differ may have different.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "tools/compare/paired_cut.h"

namespace seaglint {

// Amplitudes of both at one frequency and direction.
struct AlignmentPoint {
  std::size_t element = 0;  // index of the element of the scattering matrix, 0 to 3
  double frequency_hz = 0, azimuth_deg = 0, elevation_deg = 0;
  Vec3 path_gradient = Vec3::Zero();  // k (r^_t + r^_s), rad/m
  Complex computed_m, reference_m;
  Vec3 stated_origin_m = Vec3::Zero();  // of the reference: e^{+j q.stated_origin} is in reference_m already
};

// reference = sign_e e^{j phase} e^{-j q.origin} computed, or the conjugate of that: the reference is about `origin`
// where the computed one is about 0.
struct Alignment {
  double phase_rad = 0;                 // of the first element with values
  Vec3 origin_m = Vec3::Zero();         // beside the stated one; components that are not determined are 0
  std::vector<Vec3> undetermined;       // unit vectors along which the data fix no origin
  Vec3 origin_error_m = Vec3::Zero();   // standard error along x, y, z of the determined components
  bool conjugated = false;              // the reference has the other time factor
  std::array<int, 4> sign{1, 1, 1, 1};  // by element, relative to the first element with values
  double correlation = 0;               // |<conj(reference) computed>| / (|reference| |computed|) after it
  double other_correlation = 0;         // of the best fit with the other time factor
  double level_db = 0;                  // of the reference over the computed, mean power
};

// Fits all of it, by the phases of reference times conj(computed), weighted by their magnitudes: of pairs of points
// that differ in one variable (pulse pairs: Kay 1989), of ever more different paths as long as the uncertainty of the
// origin so far turns their phases by less than half a turn, then of all points. A displacement of the origin by up to
// 0.4 m is assumed before. An origin along which the phases leave a standard error above a fiftieth of the wavelength
// stays 0. At least one point; values of zero do not matter.
Alignment fit_alignment(std::span<const AlignmentPoint> points, int threads);

// The reference value in the phase of the computed one: with sign, conjugation, phase and origin removed.
Complex aligned(const Alignment& alignment, const AlignmentPoint& point);

// A sentence for each convention of the reference that was found to be another one: time factor, signs, origin. None of
// amplitudes that do not resemble each other. Cuts with one model each, as in suggestions().
std::vector<std::string> fitted_conventions(const Alignment& alignment, const std::vector<PairedCut>& cuts);

// A sentence for each of unit, scale of the levels, sense and zero of the azimuth and size of the mesh that fits
// clearly better changed. Levels are clipped at floor_db below each reference's maximum.
std::vector<std::string> suggestions(const std::vector<PairedCut>& cuts, double floor_db);

}  // namespace seaglint
