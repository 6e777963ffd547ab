// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sim/core/process/error.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {
namespace {

Vec3 direction_to(const FixedTransmitter& transmitter) {
  return direction_to_radar(radians(transmitter.azimuth_deg), radians(transmitter.elevation_deg));
}

// Throws InputError unless every direction has an image in the sea and every frequency is within the model of sea
// water.
void check_sea(const RcsRequest& request) {
  if (!request.sea.reflection) return;
  for (const double elevation : request.elevation_deg) {
    if (elevation <= 0)
      throw InputError(
          fmt::format("--elevation-deg: value {}: must be greater than 0 with --sea-reflection", elevation));
  }
  for (const double frequency : request.frequency_hz) {
    if (request.sea.surface == SeaSurface::kSeaWater && frequency > 90e9) {
      throw InputError(fmt::format("--frequency-ghz: value {}: must be at most 90 with --sea-reflection over sea_water",
                                   1e-9 * frequency));
    }
  }
}

// Throws InputError for settings that the request's method does not have.
void check_method(const RcsRequest& request) {
  if (request.method == SolverMethod::kBeams && request.ray_spacing_m != 0)
    throw InputError(fmt::format("--ray-spacing-m: value {}: valid only with --method rays; beams have --min-patch-m",
                                 request.ray_spacing_m));
  if (request.method == SolverMethod::kRays && !request.cavities.parts.empty())
    throw InputError("--cavity does not support --method rays: only beams end at the walls of cavities");
}

}  // namespace

SolverMethod solver_method_of(std::string_view name) {
  const auto* const found = std::find(std::begin(kSolverMethodNames), std::end(kSolverMethodNames), name);
  if (found == std::end(kSolverMethodNames))
    throw InputError(fmt::format("method: value '{}': must be {}", name, fmt::join(kSolverMethodNames, " or ")));
  return static_cast<SolverMethod>(found - std::begin(kSolverMethodNames));
}

RcsSweep requested_sweep(const RcsRequest& request) {
  RcsSweep sweep{request.frequency_hz, request.azimuth_deg, request.elevation_deg, {}, {}, {}, 0, {}};
  if (request.transmitter) sweep.transmitter = direction_to(*request.transmitter);
  check_method(request);
  check_sea(request);
  if (request.uncertainty && request.crease_deg && *request.crease_deg == 0)
    throw InputError(fmt::format("--uncertainty compares smooth surfaces with flat facets; with {} all are flat",
                                 request.like.empty() ? "--crease-deg 0" : "--like " + request.like));
  if (!request.cavities.parts.empty() && (request.sea.reflection || request.range_m > 0 || request.exports.wanted()))
    throw InputError("--cavity does not support --sea-reflection, --wavefront-range-m and exports of one aspect");
  constexpr std::size_t kMaxRows = 4'000'000;  // 256 MB of matrices
  if (sweep.rows() > kMaxRows) throw InputError(fmt::format("{} rows of output: at most {}", sweep.rows(), kMaxRows));
  if (sweep.rows() == 0) throw InputError("no frequency, azimuth or elevation");
  if (request.exports.wanted() && sweep.rows() != 1)
    throw InputError(fmt::format("exports of one aspect need one frequency, azimuth and elevation; there are {} rows",
                                 sweep.rows()));
  if (request.exports.wanted() && request.sea.reflection)
    throw InputError("exports of one aspect do not support --sea-reflection");
  if (request.transmitter && (request.exports.wanted() || request.sea.reflection)) {
    throw InputError("--transmit-azimuth-deg: exports of one aspect and --sea-reflection are monostatic");
  }
  return sweep;
}

// Behind a target only its sharp edges scatter: the echo of a sphere has a mean error of 0.65 dB between 90 and 120 deg
// from the transmitter.
std::vector<std::string> request_warnings(const RcsRequest& request) {
  if (!request.transmitter) return {};
  constexpr double kFarthestDeg = 120;
  const Vec3 transmitter = direction_to(*request.transmitter);
  double farthest = 0;
  for (const double elevation : request.elevation_deg) {
    for (const double azimuth : request.azimuth_deg) {
      const Vec3 receiver = direction_to_radar(radians(azimuth), radians(elevation));
      farthest = std::max(farthest, degrees(std::acos(std::clamp(transmitter.dot(receiver), -1.0, 1.0))));
    }
  }
  if (farthest <= kFarthestDeg) return {};
  return {
      fmt::format("receivers up to {:.0f} deg from the transmitter: behind the target, beyond {:g} deg, "
                  "only sharp edges scatter, and the forward-scattered field, within 15 "
                  "deg of the incident direction, is not modelled",
                  farthest, kFarthestDeg)};
}

}  // namespace seaglint
