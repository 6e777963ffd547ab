// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A ship in waves: heave with pitch, and sway with roll and yaw, by strip theory; roll damping may be nonlinear.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sim/motion/oscillator.h"
#include "sim/motion/strip_theory/hull_sections.h"
#include "sim/motion/strip_theory/strip_theory.h"
#include "sim/motion/trajectory.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Everything the equations of motion need, with the zero fields of the spec filled in (README.md, "Ship"). SI, about
// the origin (waterline amidships) where not said otherwise.
struct ShipParticulars {
  double length = 0;              // of the waterline, m
  double beam = 0;                // m
  double draught = 0;             // m
  double metacentric_height = 0;  // GM, m
  double speed = 0;               // along +x, m/s
  Vec3 centre_of_gravity = Vec3::Zero();
  Vec3 rotation_centre = Vec3::Zero();  // whose translations are told
  Vec3 gyration = Vec3::Zero();         // radii of the mass about the centre of gravity in roll, pitch, yaw, m

  // Roll as it is near its resonance, sway and yaw following freely: natural frequency and damping with added mass and
  // radiation. Pitch and heave likewise, each alone.
  Oscillator roll, pitch, heave;

  std::shared_ptr<const StripTheory> strips;
  Eigen::Matrix3d lateral_mass, lateral_damping, lateral_stiffness;  // sway, roll, yaw
  Eigen::Matrix2d vertical_mass, vertical_stiffness;                 // heave, pitch
  double pitch_damping = 0;                                          // beyond radiation (below: less than), N m s
};

// Throws InputError when the hull and the spec contradict each other.
ShipParticulars ship_particulars(const MotionSpec& spec, const HullSections& hull);

// Response amplitude operators, rad/m and m/m, in the time factor e^{j w_e t} of the encounter frequency; translations
// of the rotation centre. The phase reference is the elevation at the ship's origin.
struct ShipResponse {
  Complex surge, sway, heave, roll, pitch, yaw;
};
ShipResponse ship_rao(const ShipParticulars& ship, const ShipWave& wave);

// Samples at t = 0, step, ..., at least up to duration_s, of a ship whose origin rests at (x, y) at t = 0 and goes on
// with its speed; the samples are relative to that mean way.
std::vector<MotionSample> simulate_ship(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                        double x, double y, double duration_s);

}  // namespace seaglint
