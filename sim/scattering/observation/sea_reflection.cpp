// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/sea_reflection.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/process/error.h"
#include "sim/scattering/coefficients/material.h"

namespace seaglint {

RadarBasis image_basis(const RadarBasis& radar) {
  const Vec3 r = image_direction(radar.r), h = image_direction(radar.h);
  return {r, h, r.cross(h)};
}

SeaReflection::SeaReflection(const SeaReflectionSpec& spec, double significant_wave_height_m,
                             std::optional<WavesBelow> waves)
    : spec_(spec), rms_m_(significant_wave_height_m / 4), waves_(waves) {}

SeaReflectionCoefficients SeaReflection::at(double k, double sin_grazing) const {
  SEAGLINT_CHECK(sin_grazing > 0 && sin_grazing <= 1 + 1e-12, fmt::format("sine of grazing angle {}", sin_grazing));
  MaterialSpec water;
  water.kind = spec_.surface == SeaSurface::kConductor ? SurfaceKind::kPec : SurfaceKind::kSeaWater;
  water.temperature_c = spec_.temperature_c;
  water.salinity_psu = spec_.salinity_psu;
  const InterfaceCoefficients fields = MaterialSurface(water, k).at(sin_grazing);
  double loss = 1;
  if (spec_.roughness == SeaRoughness::kAment) loss = ament_factor(k, rms_m_, sin_grazing);
  if (spec_.roughness == SeaRoughness::kMillerBrownVegh) loss = miller_brown_vegh_factor(k, rms_m_, sin_grazing);
  return {loss * fields.te, loss * fields.tm};
}

bool SeaReflection::is_enabled(const PropagationPath& path) const {
  return spec_.paths == SeaPaths::kAll || (spec_.paths == SeaPaths::kMultipath) == path.is_multipath();
}

Complex SeaReflection::path_factor(const PropagationPath& path, const SeaReflectionCoefficients& rho, int element) {
  return path_factor(path, OneWayPaths{{1, 1}, rho}, element);
}

Complex SeaReflection::path_factor(const PropagationPath& path, const OneWayPaths& amplitudes, int element) {
  const SeaReflectionCoefficients &received = path.return_via_sea ? amplitudes.image : amplitudes.direct,
                                  &transmitted = path.outbound_via_sea ? amplitudes.image : amplitudes.direct;
  return (element < 2 ? received.h : received.v) * (element % 2 == 0 ? transmitted.h : transmitted.v);
}

BistaticGeometry antennas_on(const PropagationPath& path, const RadarBasis& radar, const RadarBasis& image) {
  const RadarBasis &transmit = path.outbound_via_sea ? image : radar, &receive = path.return_via_sea ? image : radar;
  return path.outbound_via_sea == path.return_via_sea ? monostatic(transmit) : bistatic(transmit, receive);
}

std::vector<PropagationPath> propagation_paths(const SeaReflection* sea) {
  std::vector<PropagationPath> paths;
  for (const PropagationPath& path : kFourPaths) {
    if (sea ? sea->is_enabled(path) : !path.is_multipath()) paths.push_back(path);
  }
  return paths;
}

}  // namespace seaglint
