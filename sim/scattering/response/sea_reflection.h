// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The mean sea surface z = 0 as a mirror between radar and target: every echo comes four ways.
//
// With r' = (r_x, r_y, -r_z), the direction to the radar's image, and S(a, b) the echo received along a of a wave sent
// along b, about an origin in the mirror,
//     S = S(r, r) + R S(r', r) + S(r, r') R + R S(r', r') R,    R = diag(rho_h, rho_v).
// rho_h = te and rho_v = tm of the sea (material.h): s = h is common to r and r', and p = s x d is v on the way down
// and v' = r' x h on the way up (both change sign on the way back), so that a perfectly conducting sea, rho_h = -1 and
// rho_v = +1, gives what image theory gives.

#include <array>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scenario/radar_spec.h"
#include "sim/scenario/sea_spec.h"

namespace seaglint {

// Direction to the radar's image in the mean sea surface.
inline Vec3 image_direction(const Vec3& r_hat) { return {r_hat.x(), r_hat.y(), -r_hat.z()}; }

// The image's basis: h mirrored, which a level h does not notice, and v' = r' x h'.
RadarBasis image_basis(const RadarBasis& radar);

// By way of the sea on the way to the target, back, or neither.
struct PropagationPath {
  bool outbound_via_sea = false;
  bool return_via_sea = false;

  bool is_multipath() const { return outbound_via_sea || return_via_sea; }
};
inline constexpr std::array<PropagationPath, 4> kFourPaths{
    {{false, false}, {false, true}, {true, false}, {true, true}}};

struct SeaReflectionCoefficients {
  Complex h = -1, v = 1;
};

class SeaReflection {
 public:
  // RMS elevation = significant_wave_height / 4.
  SeaReflection(const SeaReflectionSpec& spec, double significant_wave_height_m);

  // Coherent reflection at k, sin_grazing = r^_z, 0 < x <= 1.
  SeaReflectionCoefficients at(double k, double sin_grazing) const;
  // Whether the scenario asks for this path's echo.
  bool is_enabled(const PropagationPath& path) const;
  // The path's factor on S_pq of the element 0..3 for hh, hv, vh, vv (received, transmitted).
  static Complex path_factor(const PropagationPath& path, const SeaReflectionCoefficients& rho, int element);

 private:
  SeaReflectionSpec spec_;
  double rms_m_;
};

}  // namespace seaglint
