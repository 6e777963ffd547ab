// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion of a scenario's bodies in waves as statistics, spectra and figures.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/ship/rao_files.h"
#include "sim/motion/ship/ship.h"
#include "sim/sea/wave_field.h"

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

// Figure of roll, pitch and yaw of up to six bodies over the first 100 s.
void write_motion_figure(const std::vector<NamedTrajectory>& bodies, double duration_s, const std::string& title,
                         const std::filesystem::path& file);

// Five snapshots over one wave period of the first and the last body with the water surface around them, seen from
// starboard; x is relative to the mean motion of each body.
void write_motion_frames(const std::vector<NamedTrajectory>& bodies, const WaveField& sea, double period_s,
                         const std::string& title, const std::filesystem::path& file);

// Table of VERES or WAMIT to draw with a ship's response amplitude operators.
struct RaoReference {
  std::filesystem::path file;  // empty: none
  MotionSpec conventions{};    // its keys rao_ and wamit_
};

// Figure of the moduli of a ship's response amplitude operators over frequency, in waves towards mu (rad) in water of
// the given depth (m).
void write_rao_figure(const ShipParticulars& ship, double mu, double depth, const RaoReference& reference,
                      const std::string& title, const std::filesystem::path& file);

}  // namespace seaglint
