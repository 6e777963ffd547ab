// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Plan of an interval: the directions in which a body is traced, and the weight of every trace at every pulse.

#include <span>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/observation/look_directions.h"

namespace seaglint {

// One propagation path of a trace, direct or via the sea.
struct PlannedPath {
  PropagationPath path;
  BistaticGeometry geometry;    // traced directions, body frame
  LookDirectionPath look_path;  // over the pulses of the trace
};

struct PlannedTrace {
  int first = 0, last = -1;  // pulses with a weight > 0; none when last < first
  std::vector<PlannedPath> paths;
};

// A moving body and a radar over an interval of one or more pulses.
struct ObservedMotion {
  const Trajectory& trajectory;  // covers the interval
  const IntervalSampling& sampling;
  Vec3 r_hat;                  // look direction, target frame
  double range_m = 0;          // of the radar from the origin of the target frame; 0: far field
  Vec3 centre = Vec3::Zero();  // the point of the body, body frame, about which it is traced
};

// Limits of the motion of a look direction under one trace, rad.
struct TraceLimits {
  double aspect_change = 0;  // length of its path
  double cross_track = 0;    // departure from a straight track
};

// Divides the interval into equal spans, each traced at its middle. Between two of these instants the responses are
// interpolated linearly; before the first and after the last one the nearest response is used. Of pulses so far apart
// that there would be no fewer spans, each has a trace of its own.
class TracePlan {
 public:
  TracePlan(const ObservedMotion& motion, std::span<const PropagationPath> paths, const TraceLimits& limits);

  std::span<const PlannedTrace> traces() const { return traces_; }
  // Weight of a trace at a pulse; the weights of all traces sum to one.
  double interpolation_weight(std::size_t trace, int pulse) const;
  // Pose of the body about its centre at a pulse, and the look directions from the origin of the target frame.
  const Pose& pose(int pulse) const { return poses_[static_cast<std::size_t>(pulse)]; }
  const LineOfSight& sight(int pulse) const { return sights_[static_cast<std::size_t>(pulse)]; }
  // Two-way path to the body's centre relative to that to the origin of the target frame, m, positive when shorter.
  double path_advance(const PropagationPath& path, int pulse) const {
    return sight(pulse).path_advance(path, pose(pulse).p, range_m_);
  }

 private:
  struct Directions;
  // Trace of one span, at the pose and look directions of its middle, or of one pulse.
  PlannedTrace planned(std::size_t trace, const Pose& pose, const LineOfSight& line_of_sight, const Directions& seen,
                       std::span<const PropagationPath> paths) const;

  double range_m_;
  std::vector<double> time_;  // per pulse, 0 at the first and 1 at the last; 0 for a single pulse
  std::vector<Pose> poses_;
  std::vector<LineOfSight> sights_;
  std::size_t spans_ = 1;
  std::vector<PlannedTrace> traces_;
};

}  // namespace seaglint
