// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A target on a turntable: its image and its range profiles from scattering amplitudes over frequency and azimuth.

#include <cstddef>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Amplitudes of one element of one antenna at one elevation, m, [azimuth][frequency]; phase origin and axes are the
// body's. Both axes ascend in even steps of kFewestOfTurntable values or more.
struct TurntableEcho {
  std::vector<double> frequency_hz, azimuth_deg;
  double elevation_deg = 0;
  std::vector<Complex> amplitude_m;
  std::size_t element = 3;  // of hh, hv, vh, vv
};

inline constexpr std::size_t kFewestOfTurntable = 8;
inline constexpr double kSteepestTurntable_deg = 80;  // elevation: the image plane, z = 0, is seen from the side

// Axes of an image, horizontal distances seen from above with the radar at the left: range along the line of sight at
// the middle azimuth, positive = farther; cross range, positive = to the left seen from the radar. A point x of the
// body is at range -r^.x and cross range -h.x (r^, h: CONVENTIONS.md).
struct TurntableAxes {
  explicit TurntableAxes(double middle_azimuth_deg, double elevation_deg);
  Vec3 range, cross;
};

// What a sweep resolves and where its image repeats itself, m.
struct TurntableSampling {
  double middle_azimuth_deg = 0;
  double wavelength_m = 0;    // of the middle frequency
  double range_cell_m = 0;    // c / 2B, B: frequencies times their step
  double cross_cell_m = 0;    // lambda / (4 sin(sector / 2) cos(elevation)), of small sectors lambda / (2 sector)
  double range_window_m = 0;  // c / (2 step of frequency)
  double cross_window_m = 0;  // lambda / (2 step of azimuth cos(elevation)) at the highest frequency
};
TurntableSampling turntable_sampling(std::span<const double> frequency_hz, std::span<const double> azimuth_deg,
                                     double elevation_deg);

// Interval of a target, m, and the part of it that is shown.
struct Interval {
  double low = 0, high = 0;
  double size() const { return high - low; }
};

// The target along the axes of its image at the middle azimuth; over all azimuths its largest size along range and
// cross range, and its ranges.
struct TurntableExtent {
  Interval range, cross, all_ranges;
  double longest_range_m = 0, longest_cross_m = 0;
};
TurntableExtent turntable_extent(const TriangleMesh& mesh, std::span<const double> azimuth_deg, double elevation_deg);

// Image over equal cells, levels in dBsm, [cross][range].
struct TurntableImage {
  std::vector<double> range_m, cross_m, level_dbsm;
};

// The area of an image: of the target with a margin, at most the windows of the sampling; without a target the windows.
struct TurntableArea {
  Interval range, cross;
};
TurntableArea turntable_area(const TurntableSampling& sampling, const TurntableExtent* extent);

// I(x) = sum over f, a of w_f w_a S(f, a) e^{-j 2k r^(a).x}, x in the plane z = 0: the filtered sum over wavenumber
// vectors, exact for any sector and band (Munson, O'Brien and Jenkins, Proc. IEEE 71 (1983) 917, "A tomographic
// formulation of spotlight-mode synthetic aperture radar"; Mensa, "High Resolution Radar Cross-Section Imaging",
// 1991; S ~ e^{+j 2k r^.x} here). Taylor's weights (-35 dB), times k along frequency for the area of the polar grid,
// with sum 1: a point scatterer has its own cross-section at its place. Summed as back-projection of range profiles
// that are interpolated linearly between values 32 times as dense as resolution cells (error -58 dB at the band's
// ends). Three cells per resolution cell, 240 to 800 along an axis.
TurntableImage turntable_image(const TurntableEcho& echo, const TurntableArea& area, int threads = 0);

// The ranges of profiles, likewise, of all azimuths.
Interval profiles_range(const TurntableSampling& sampling, const TurntableExtent* extent);

// Range profiles of all azimuths with the same weights along frequency, levels in dBsm, [azimuth][range], over a part
// of the unambiguous range, four values or more per resolution cell.
struct TurntableProfiles {
  std::vector<double> range_m, level_dbsm;
};
TurntableProfiles turntable_profiles(const TurntableEcho& echo, const Interval& range);

}  // namespace seaglint
