// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the equations of motion of a ship need, derived from its hull and the scenario.

#include <Eigen/Core>
#include <memory>

#include "sim/core/numbers/linear.h"
#include "sim/motion/kinematics/oscillator.h"
#include "sim/motion/strip_theory/hull_sections.h"
#include "sim/motion/strip_theory/strip_theory.h"
#include "sim/scenario/target_spec.h"

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
  Vec3 rotation_centre = Vec3::Zero();    // whose translations are told
  Vec3 radii_of_gyration = Vec3::Zero();  // radii of the mass about the centre of gravity in roll, pitch, yaw, m

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

}  // namespace seaglint
