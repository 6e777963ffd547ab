// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Over which band and turn a phase integral is split into points, and how fine.

namespace seaglint {

struct SplitSettings {
  double kc = 0;        // wavenumber of the band's centre, rad/m
  double turn_rad = 0;  // largest turn from the lit direction, 0 <= x < 0.1
};

// What is left of a frozen amplitude, per end point: -28 dB of it; the sum over many is far better (tests, README).
inline constexpr double kAmplitudeError = 0.04;
// Phase, from its middle, up to which a piece may be one point.
inline constexpr double kPieceHalfPhase = 0.5;  // rad
inline constexpr double kSlopePhase = 0.2;      // rad

}  // namespace seaglint
