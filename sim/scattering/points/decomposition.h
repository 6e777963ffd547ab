// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Settings of the decomposition of a phase integral into points: band, aspect change and tolerances.

namespace seaglint {

struct DecompositionSettings {
  double kc = 0;                 // wavenumber of the band's centre, rad/m
  double aspect_change_rad = 0;  // largest change of the look direction from the traced one, 0 <= x < 0.1
};

// Relative error of a frozen amplitude per end point, -28 dB; the error of a sum over many is far smaller (README.md of
// response).
inline constexpr double kMaxAmplitudeError = 0.04;
// Phase from its middle up to which a piece may be one point.
inline constexpr double kMaxHalfPhase = 0.5;     // rad
inline constexpr double kDerivativePhase = 0.2;  // rad

}  // namespace seaglint
