// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Places, heights, headings and sizes of the bodies of a target's layout. A target without one is one body at the
// origin.

#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scenario/layout/layout_spec.h"

namespace seaglint {

using OptionalLayout = std::optional<LayoutSpec>;

// Number of bodies: 1 without a layout.
std::size_t body_count(const OptionalLayout& layout);

// Bodies that move as one rigid raft.
bool is_raft(const OptionalLayout& layout);

// Centre of the layout on the water, in T.
Vec2 layout_centre(const OptionalLayout& layout);

// The layout moved by this vector in the plane of the water; a target without one gets a line of one body.
void move_layout(OptionalLayout& layout, const Vec2& by);

// Rest positions on the water of the bodies, in T, m; without a layout one body at the origin.
//   line    equally spaced along x about the centre
//   ring    an ellipse with the area's axes, the first body ahead, at equal distances along it
//   grid    rows along x, filled one after the other, of round(sqrt(count length / width)) bodies each, from border to
//           border; the last row, with the rest, is centred
//   random  uniform over the area, one after the other, again where a body comes nearer than min_distance_m to another
// Depends on the layout alone. Throws InputError, without a place, when two bodies are nearer than min_distance_m.
std::vector<Vec2> layout_positions(const OptionalLayout& layout);

// Heights above the waterline's rest_height_m() and headings (rad, about z) of the bodies; zero where none are given.
std::vector<double> body_heights_m(const OptionalLayout& layout);
std::vector<double> body_headings_rad(const OptionalLayout& layout);

// Factors by which the bodies enlarge the mesh of a target: its `scale` times that of each body, 1 where none is given.
std::vector<double> body_scales(const OptionalLayout& layout, double target_scale);

// "line", "ring", "grid", "random"; "single" without a layout.
std::string layout_name(const OptionalLayout& layout);

// ", 4 in line, 40 m apart, on one rigid raft, of 0.5 to 2 times the mesh's size"; empty without a layout.
std::string layout_text(const OptionalLayout& layout);

}  // namespace seaglint
