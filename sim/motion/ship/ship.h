// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Ship in waves by strip theory: the coefficients of its equations of motion, derived from hull and scenario; its
// responses, with coupled heave and pitch and coupled sway, roll and yaw; its motion in time, with optional nonlinear
// roll damping.

#include <memory>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/motion/ship/responses.h"
#include "sim/motion/strip_theory/hull_sections.h"
#include "sim/motion/strip_theory/strip_theory.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Coefficients of the equations of motion, zero fields of the spec filled in (sim/motion/ship/README.md). SI, about the
// origin (waterline amidships) unless stated otherwise.
struct ShipParticulars {
  double length = 0;              // of the waterline, m
  double beam = 0;                // m
  double draught = 0;             // m
  double metacentric_height = 0;  // GM, m
  double speed = 0;               // along +x, m/s
  Vec3 centre_of_gravity = Vec3::Zero();
  Vec3 rotation_centre = Vec3::Zero();    // the point whose translations are given
  Vec3 radii_of_gyration = Vec3::Zero();  // radii of the mass about the centre of gravity in roll, pitch, yaw, m

  // Natural frequency and damping with added mass and radiation: roll near its resonance with sway and yaw free; pitch
  // and heave each uncoupled.
  Oscillator roll, pitch, heave;

  std::shared_ptr<const StripTheory> strips;
  Mat3 lateral_mass, lateral_damping, lateral_stiffness;  // sway, roll, yaw
  Mat2 vertical_mass, vertical_stiffness;                 // heave, pitch
  double pitch_damping = 0;                               // in addition to radiation (negative: less), N m s
};

// Throws InputError for a hull and a spec that are inconsistent.
ShipParticulars ship_particulars(const MotionSpec& spec, const HullSections& hull);

// Responses to one wave.
MotionRao ship_rao(const ShipParticulars& ship, const ShipWave& wave);

// Samples at t = 0, step, ..., at least up to duration_s, of a ship whose origin is at (x, y) at t = 0 and moves on at
// its speed, relative to that mean motion.
std::vector<MotionSample> simulate_ship(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                        double x, double y, double duration_s);

}  // namespace seaglint
