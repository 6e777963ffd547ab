// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/response/sea_reflection.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/process/error.h"
#include "sim/scattering/material/material.h"
#include "sim/scattering/material/sea_water.h"
#include "sim/scattering/response/body_response.h"

namespace seaglint {

RadarBasis image_basis(const RadarBasis& radar) {
  const Vec3 r = image_direction(radar.r), h = image_direction(radar.h);
  return {r, h, r.cross(h)};
}

SeaMirror::SeaMirror(const SeaReflectionSpec& spec, double significant_wave_height_m)
    : spec_(spec), rms_m_(significant_wave_height_m / 4) {}

SeaCoefficients SeaMirror::at(double k, double sin_grazing) const {
  SEAGLINT_CHECK(sin_grazing > 0 && sin_grazing <= 1 + 1e-12, fmt::format("sine of grazing angle {}", sin_grazing));
  MaterialSpec water;
  water.kind = spec_.surface == SeaSurface::kConductor ? SurfaceKind::kPec : SurfaceKind::kSeaWater;
  water.temperature_c = spec_.temperature_c;
  water.salinity_psu = spec_.salinity_psu;
  const SurfaceFields fields = Surface(water, k).at(sin_grazing);
  double loss = 1;
  if (spec_.roughness == SeaRoughness::kAment) loss = ament_loss(k, rms_m_, sin_grazing);
  if (spec_.roughness == SeaRoughness::kMillerBrownVegh) loss = miller_brown_vegh_loss(k, rms_m_, sin_grazing);
  return {loss * fields.te, loss * fields.tm};
}

bool SeaMirror::wanted(const SeaPath& path) const {
  return spec_.paths == SeaPaths::kAll || (spec_.paths == SeaPaths::kMultipath) == path.multipath();
}

Complex SeaMirror::weight(const SeaPath& path, const SeaCoefficients& rho, int element) {
  const Complex received = element < 2 ? rho.h : rho.v, transmitted = element % 2 == 0 ? rho.h : rho.v;
  return (path.back ? received : 1.0) * (path.there ? transmitted : 1.0);
}

std::vector<std::array<Complex, 4>> scattering_matrices_over_sea(const Scatterer& scatterer, const Vec3& r_hat,
                                                                 double height_m, const SeaMirror& sea,
                                                                 std::span<const double> wavenumbers,
                                                                 const IlluminationSettings& settings, int threads,
                                                                 std::size_t* legs, const StopFlag* stop) {
  const RadarBasis radar = radar_basis(r_hat), image = image_basis(radar);
  IlluminationSettings raised = settings;
  raised.origin = {0, 0, height_m};
  std::vector<std::array<Complex, 4>> sum(wavenumbers.size());
  for (const SeaPath& path : kSeaPaths) {
    if (!sea.wanted(path)) continue;
    const RadarBasis &transmit = path.there ? image : radar, &receive = path.back ? image : radar;
    const AntennaPair antennas = path.there == path.back ? monostatic(transmit) : bistatic(transmit, receive);
    const auto matrices = scattering_matrices(scatterer, antennas, wavenumbers, raised, threads, legs, stop);
    // About the body's origin at (0, 0, height): e^{jk (a + b - 2 r).(0, 0, height)}.
    const double detour = -2 * r_hat.z() * height_m * ((path.there ? 1 : 0) + (path.back ? 1 : 0));
    for (std::size_t q = 0; q < wavenumbers.size(); ++q) {
      const SeaCoefficients rho = sea.at(wavenumbers[q], r_hat.z());
      const Complex phase = std::polar(1.0, wavenumbers[q] * detour);
      for (int i = 0; i < 4; ++i) sum[q][i] += SeaMirror::weight(path, rho, i) * phase * matrices[q][i];
    }
  }
  return sum;
}

}  // namespace seaglint
