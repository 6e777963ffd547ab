// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Places, heights and headings of the bodies of a target's layout.

#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Number of bodies: 1 without a layout.
std::size_t body_count(const TargetSpec& target);

// Bodies that move as one rigid raft.
bool is_raft(const TargetSpec& target);

// Centre of the layout on the water, in T.
Vec2 layout_centre(const TargetSpec& target);

// The layout moved by this vector in the plane of the water; a target without one gets a line of one body.
void move_layout(TargetSpec& target, const Vec2& by);

// Rest positions on the water of the bodies, in T, m; without a layout one body at the origin.
//   line    equally spaced along x about the centre
//   ring    an ellipse with the area's axes, the first body ahead, at equal distances along it
//   grid    rows along x, filled one after the other, of round(sqrt(count length / width)) bodies each, from border to
//           border; the last row, with the rest, is centred
//   random  uniform over the area, one after the other, again where a body comes nearer than min_distance_m to another
// Depends on the layout alone. Throws InputError, without a place, when two bodies are nearer than min_distance_m.
std::vector<Vec2> layout_positions(const TargetSpec& target);

// Heights above the waterline's rest_height_m() and headings (rad, about z) of the bodies; zero where none are given.
std::vector<double> body_heights_m(const TargetSpec& target);
std::vector<double> body_headings_rad(const TargetSpec& target);

// "line", "ring", "grid", "random"; "single" without a layout.
std::string layout_name(const TargetSpec& target);

// ", 4 in line, 40 m apart, on one rigid raft"; empty without a layout.
std::string layout_text(const TargetSpec& target);

}  // namespace seaglint
