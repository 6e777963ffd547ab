// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// ISAR image and range profiles of a sample's target alone, as a radar forms them that transmits the whole synthetic
// bandwidth with every pulse; the interval and the axes that the target's own motion suggests; names at the peaks of
// range profiles.

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/solver/solve.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

// Pulses of an image and its map. By default those of the sample's map.
struct FullBandSampling {
  double offset_s = 0;         // of the first pulse from the start of the sample's interval
  int pulses = 0;              // 0: radar.pulses
  std::optional<MapSpec> map;  // absent: the scenario's
};

// Echo and map of the target alone, without clutter and noise, for a radar that transmits the whole synthetic bandwidth
// with every pulse: an ISAR image (range, velocity). Band and motion, including the radar's own, are those of the
// sample's map.
struct FullBandInterval {
  PulseTrain train;           // of one carrier, in the middle of the band
  std::vector<Complex> echo;  // [pulse][frequency]
  RvMap image;
};
FullBandInterval full_band_interval(const Pipeline& pipeline, const SampleLook& of,
                                    const FullBandSampling& sampling = {});

// High-resolution range profiles |HRRP| of its single pulses, metres, [pulse][range].
struct RangeProfiles {
  std::vector<double> time_s, range_m;
  std::vector<double> magnitude_m;
};
RangeProfiles range_profiles(const FullBandInterval& band, const MapSpec& spec);

// Range profiles of `count` single pulses over a time from the start of a sample's interval, each with aspect traces of
// its own: the target may turn by any angle between them.
struct ProfileTimes {
  double duration_s = 0;
  int count = 1;
  MapSpec map;
  int threads = 0;  // 0: all processors
};
RangeProfiles profiles_over(const Pipeline& pipeline, const SampleLook& of, const ProfileTimes& times);

// The interval and the map of an ISAR image. The interval begins within a peak period of the waves (4 s without) after
// the sample's; it is that in which the look direction changes most in body axes while no point of the target departs
// from uniform range rate by more than an eighth of a wavelength (90 deg of two-way phase), and ends where the
// cross-range cell lambda / (2 angle) equals the range cell. Several bodies that move independently, and points, have
// the longest interval with that bound from the start of the sample's on, at most a second.
struct IsarPlan {
  FullBandSampling sampling;          // Hamming tapers, spans of the target, cells divided by four
  std::pair<double, double> range_m;  // of the target's bounding boxes at the middle, with a margin
  std::pair<double, double> velocity_mps;
  double duration_s = 0;
  // Of one rigid body that turns by enough for eight cross-range cells along its extent: velocity = v_origin + rate x.u
  // of a point x relative to the body's origin, u a unit vector across the line of sight.
  struct CrossRange {
    double angle_rad = 0;  // aspect change during the interval
    double rate_rad_s = 0;
    double origin_mps = 0;  // velocity of the body's origin
    double up = 0;          // vertical component of u, -1 to 1
    double cell_m = 0;      // lambda / (2 angle)
  };
  std::optional<CrossRange> cross_range;
  std::string no_cross_range;  // why it is absent
};
IsarPlan isar_plan(const Pipeline& pipeline, const SampleLook& of);

// A peak of a range profile with what scatters most there.
struct NamedPeak {
  double range_m = 0, magnitude_m = 0;
  std::string name;
};

// Of peaks at least two range cells apart and within 25 dB of the strongest at most `most`, strongest first, without
// names.
std::vector<NamedPeak> strongest_peaks(std::span<const double> range_m, std::span<const double> magnitude_m,
                                       double range_cell_m, std::size_t most);

// Contribution to an echo by something of this name, m.
struct RangeContribution {
  double range_m = 0;
  std::string name;
  Complex amplitude_m;
};

// Names each peak after the largest sum of contributions of one name within half a range cell of it.
void name_peaks(std::vector<NamedPeak>& peaks, std::span<const RangeContribution> contributions, double range_cell_m);

// Contributions of an aspect's points, at range -psi / 2 from origin_m on, by the names of the mesh's parts, or all by
// one name; k: wavenumber, rad/m; element of hh, hv, vh, vv.
struct PointContributions {
  std::span<const Point> points;
  const TriangleMesh& mesh;
  double k = 0, origin_m = 0;
  std::size_t element = 0;
  std::string name = {};  // empty: parts
};
void append_contributions(const PointContributions& of, std::vector<RangeContribution>& contributions);

// Strongest peaks of a sample's range profile at the start of its interval, named after a part of the mesh, a body of
// several or a point.
std::vector<NamedPeak> named_peaks(const Pipeline& pipeline, const SampleLook& of, const RangeProfiles& profiles,
                                   std::size_t most);

}  // namespace seaglint
