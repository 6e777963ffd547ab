// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Specular reflection of the mean sea surface z = 0 between radar and target (four-path multipath).
//
// With r' = (r_x, r_y, -r_z) the direction to the radar's image and S(a, b) the scattering matrix received along a and
// transmitted along b, about an origin on the surface,
//     S = S(r, r) + R S(r', r) + S(r, r') R + R S(r', r') R,    R = diag(rho_h, rho_v).
// rho_h = te and rho_v = tm of the sea (material.h): s = h is common to r and r'; p = s x d is v on the downward path
// and v' = r' x h on the upward path (both change sign on the return path). A perfectly conducting sea, rho_h = -1 and
// rho_v = +1, is equivalent to image theory. Over the waves themselves, one-way amplitudes of both waves are in the
// place of 1 and rho (surface_propagation.h).

#include <array>
#include <optional>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scenario/radar_spec.h"
#include "sim/scenario/sea_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Look direction of the radar's image in the mean sea surface.
inline Vec3 image_direction(const Vec3& r_hat) { return {r_hat.x(), r_hat.y(), -r_hat.z()}; }

// Basis of the image: h is mirrored (unchanged when horizontal), v' = r' x h'.
RadarBasis image_basis(const RadarBasis& radar);

// Propagation path: via the sea surface on the way to the target, on the return, on both or on neither.
struct PropagationPath {
  bool outbound_via_sea = false;
  bool return_via_sea = false;

  bool is_multipath() const { return outbound_via_sea || return_via_sea; }
};
inline constexpr std::array<PropagationPath, 4> kFourPaths{
    {{false, false}, {false, true}, {true, false}, {true, true}}};

// Antennas of a path: the radar, or its image on a leg via the sea.
BistaticGeometry antennas_on(const PropagationPath& path, const RadarBasis& radar, const RadarBasis& image);

struct SeaReflectionCoefficients {
  Complex h = -1, v = 1;
};

// One-way amplitudes of the direct wave and of the wave from the radar's image: 1 and rho over the mean plane.
struct OneWayPaths {
  SeaReflectionCoefficients direct{1, 1}, image;
};

// Waves below a body, of `surface_profile: waves`. The point x of the target frame is at x + origin + t velocity of the
// wave field.
struct WavesBelow {
  const WaveField* field = nullptr;  // must outlive the reflection
  Vec3 origin_m = Vec3::Zero();
  Vec3 velocity_mps = Vec3::Zero();
  double rms_above_cutoff_m = 0;  // of the waves shorter than those of the field
};

class SeaReflection {
 public:
  // Standard deviation of the surface elevation: significant_wave_height / 4.
  SeaReflection(const SeaReflectionSpec& spec, double significant_wave_height_m,
                std::optional<WavesBelow> waves = std::nullopt);

  // Coherent reflection coefficients at wavenumber k; sin_grazing = r^_z, 0 < x <= 1.
  SeaReflectionCoefficients at(double k, double sin_grazing) const;
  // True when the scenario includes this propagation path.
  bool is_enabled(const PropagationPath& path) const;
  // Factor of the path on element 0..3, hh, hv, vh, vv (received, transmitted).
  static Complex path_factor(const PropagationPath& path, const SeaReflectionCoefficients& rho, int element);
  // The same with one-way amplitudes of both waves.
  static Complex path_factor(const PropagationPath& path, const OneWayPaths& amplitudes, int element);

  // The waves over which the field propagates (surface_propagation.h); null: the mean plane alone.
  const WavesBelow* waves() const { return waves_ ? &*waves_ : nullptr; }
  double significant_wave_height_m() const { return 4 * rms_m_; }
  // The same surface with another roughness.
  SeaReflection with_rms_height(double rms_m) const { return {spec_, 4 * rms_m}; }

 private:
  SeaReflectionSpec spec_;
  double rms_m_;
  std::optional<WavesBelow> waves_;
};

// The paths that the sea enables; without a sea the direct one.
std::vector<PropagationPath> propagation_paths(const SeaReflection* sea);

}  // namespace seaglint
