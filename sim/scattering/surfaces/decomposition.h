// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Over which band and turn a phase integral is split into points, and how fine.

namespace seaglint {

struct DecompositionSettings {
  double kc = 0;                 // wavenumber of the band's centre, rad/m
  double aspect_change_rad = 0;  // largest turn from the lit direction, 0 <= x < 0.1
};

// What is left of a frozen amplitude, per end point: -28 dB of it; the sum over many is far better (tests, README).
inline constexpr double kMaxAmplitudeError = 0.04;
// Phase, from its middle, up to which a piece may be one point.
inline constexpr double kMaxHalfPhase = 0.5;     // rad
inline constexpr double kDerivativePhase = 0.2;  // rad

}  // namespace seaglint
