// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion of a scenario's bodies in waves as statistics, spectra and figures.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/core/numbers/dispersion.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/ship/rao_files.h"
#include "sim/motion/ship/ship.h"
#include "sim/sea/wave_field.h"
#include "tools/figure/figure.h"

namespace seaglint {

struct NamedTrajectory {
  std::string body;
  Trajectory trajectory;
  TriangleMesh mesh;  // in the body's frame
  double speed = 0;   // along x, of the frame that the trajectory is relative to, m/s
};

// One line per body: root mean square, largest modulus and mean period between zero crossings (2 pi rms/rms of the
// rate) of roll, pitch and yaw over [0, duration_s].
std::string motion_statistics(const std::vector<NamedTrajectory>& bodies, double duration_s);

// `omega_rad_s,body,roll_deg2s,pitch_deg2s,yaw_deg2s`: one-sided spectra by the mean over half-overlapping Hann windows
// of 120 s (or the whole duration, when shorter), every half of their resolution up to 8 rad/s.
std::string spectrum_csv(const std::vector<NamedTrajectory>& bodies, double duration_s);

// The bodies in a realisation of one sea state.
struct MotionCase {
  std::string name;  // of the state among others, state_names()
  std::vector<NamedTrajectory> bodies;
  WaveField sea;
  double peak_period_s = 0;
};

// Figure of roll, pitch and yaw of up to six bodies over the first 100 s, at most to duration_s. Several states stand
// side by side on common axes: the first kMostStates, three in a column of a journal.
void write_motion_figure(std::span<const MotionCase> cases, double duration_s, const FigureText& text,
                         const std::filesystem::path& file);

// Five snapshots, three in a column of a journal, over one wave period (at most duration_s) of the first and the last
// body with the water surface around them, seen from starboard; x is relative to the mean motion of each body. Of
// several states the first kMostStates.
void write_motion_frames(std::span<const MotionCase> cases, double duration_s, const FigureText& text,
                         const std::filesystem::path& file);

// Table of VERES or WAMIT to draw with a ship's response amplitude operators.
struct RaoReference {
  std::filesystem::path file;  // empty: none
  MotionSpec conventions{};    // its keys rao_ and wamit_
};

// A ship in regular waves of every direction that is asked for, in which they travel, rad, in water of one depth, m.
struct RaoRequest {
  const ShipParticulars& ship;
  std::vector<double> directions;
  double depth = kDeepWater;
  RaoReference reference = {};
};

// Figure of the moduli of the response amplitude operators over frequency, of kMostStates directions at most.
void write_rao_figure(const RaoRequest& request, const FigureText& text, const std::filesystem::path& file);

}  // namespace seaglint
