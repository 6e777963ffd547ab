// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A ship without speed: each degree of freedom is a damped oscillator forced by the waves averaged over the hull.

#include <array>

#include "sim/geometry/triangle_mesh.h"
#include "sim/motion/oscillator.h"
#include "sim/motion/trajectory.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Shape of the hull below the waterline; by default that of model DTMB 5415, a fast displacement hull.
struct HullForm {
  double block = 0.507;       // volume / (L B T)
  double waterplane = 0.778;  // waterplane area / (L B)
  double midship = 0.821;     // area of the midship section / (B T)
};

// Everything the equations of motion need, with the zero fields of the spec filled in (README.md, "Ship").
struct ShipParticulars {
  double length = 0;              // waterline length L, m
  double beam = 0;                // waterline beam B, m
  double draught = 0;             // T, m
  double metacentric_height = 0;  // GM, m
  HullForm form;
  double centre_of_gravity = 0;  // above the waterline, m
  Oscillator roll, pitch, yaw, surge, sway, heave;
};

// Throws InputError when the mesh has no size to derive from, or a derived size contradicts a given one.
ShipParticulars ship_particulars(const MotionSpec& spec, const Bounds& bounds, const HullForm& form = {});

// Accelerations (rad/s^2 or m/s^2) per metre of a long-crested wave eta = Re{e^{j(w t - k.x)}}, phase reference the
// elevation at the ship's origin; deep water, mu the direction of travel in the ship's frame.
struct ShipExcitation {
  Complex roll, pitch, yaw, surge, sway, heave;
};
ShipExcitation ship_excitation(const ShipParticulars& ship, double omega, double mu);

// Response amplitude operators, rad/m and m/m: excitation through each oscillator's linear response.
ShipExcitation ship_rao(const ShipParticulars& ship, double omega, double mu);

// Samples at t = 0, step, ..., at least up to duration_s, of a ship whose origin rests at (x, y).
std::vector<MotionSample> simulate_ship(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                        double x, double y, double duration_s);

}  // namespace seaglint
