// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// In which directions a body is traced over an interval, and what share every trace has of every pulse.

#include <span>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"
#include "sim/scattering/response/frequency_response.h"
#include "sim/scattering/response/illumination.h"
#include "sim/scattering/response/line_of_sight.h"
#include "sim/scattering/response/look_direction_path.h"

namespace seaglint {

// One way that a trace's waves take, directly or by the sea.
struct PlannedPath {
  PropagationPath path;
  BistaticGeometry geometry;    // where the trace is made, body frame
  LookDirectionPath look_path;  // of the trace's pulses
};

struct PlannedTrace {
  int first = 0, last = -1;  // pulses that it has a share of; none when the last comes before the first
  std::vector<PlannedPath> paths;
};

// How far directions may move under one trace, rad.
struct TraceLimits {
  double aspect_change = 0;  // the length of their path
  double cross_track = 0;    // off a straight track
};

// Equal spans of the interval, each traced at its middle. Between two instants their answers are blended linearly;
// before the first and after the last one that one's stands alone.
class TracePlan {
 public:
  // The trajectory must cover the interval of one or more pulses; r_hat in the target frame, from whose origin the
  // radar stands at range_m, 0 = far field.
  TracePlan(const Trajectory& trajectory, const IntervalSampling& sampling, const Vec3& r_hat, double range_m,
            std::span<const PropagationPath> paths, const TraceLimits& limits);

  std::span<const PlannedTrace> traces() const { return traces_; }
  // A trace's share of a pulse; those of all traces sum to one.
  double interpolation_weight(std::size_t trace, int pulse) const;
  // The body at a pulse, and from where the origin of the target frame is seen.
  const Pose& pose(int pulse) const { return poses_[static_cast<std::size_t>(pulse)]; }
  const LineOfSight& sight(int pulse) const { return sights_[static_cast<std::size_t>(pulse)]; }
  // Both ways of a path to the body's origin, m: shorter by this than to that of the target frame.
  double path_advance(const PropagationPath& path, int pulse) const {
    return sight(pulse).path_advance(path, pose(pulse).p, range_m_);
  }

 private:
  struct Directions;
  // A span's trace, made where the body then stands and sees the radar.
  PlannedTrace planned(std::size_t trace, const Pose& pose, const LineOfSight& line_of_sight, const Directions& seen,
                       std::span<const PropagationPath> paths) const;

  double range_m_;
  std::vector<double> time_;  // of each pulse, 0 at the first and 1 at the last; all 0 of one pulse
  std::vector<Pose> poses_;
  std::vector<LineOfSight> sights_;
  std::size_t spans_ = 1;
  std::vector<PlannedTrace> traces_;
};

}  // namespace seaglint
