// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_views.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/response/scattering_matrix.h"
#include "sim/scattering/response/sea_reflection.h"

namespace seaglint {
namespace {

BistaticGeometry antennas_of(const RcsRequest& request, const RadarBasis& swept) {
  if (!request.transmitter) return monostatic(swept);
  return bistatic(basis_at(request.transmitter->azimuth_deg, request.transmitter->elevation_deg), swept);
}

SeaReflection mirror_of(const SeaUnderTarget& sea) {
  SeaReflectionSpec spec;
  spec.surface = sea.surface;
  spec.paths = sea.paths;
  return SeaReflection(spec, sea.wave_height_m);
}

std::size_t compute_sweep(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop,
                          RcsSweep& sweep) {
  const Scatterer& scatterer = *target.prepared.scatterer;
  std::vector<double> wavenumbers;
  for (const double hz : sweep.frequency_hz) wavenumbers.push_back(2 * kPi * hz / kSpeedOfLight);
  std::size_t segments = 0;
  Progress progress("rcs", sweep.views(), "views");
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    const RadarBasis basis = basis_at(sweep.azimuth_of(view), sweep.elevation_of(view));
    try {
      for (RcsSweep::Model& model : sweep.models) {
        const TracingSettings settings = settings_of(request, target, model.edge_diffraction);
        model.matrices[view] =
            request.sea.reflection
                ? scattering_matrices_over_sea(scatterer, basis.r, request.sea.height_m, mirror_of(request.sea),
                                               wavenumbers, settings, threads, &segments, stop, request.range_m)
                : scattering_matrices(scatterer, antennas_of(request, basis), wavenumbers, settings, threads, &segments,
                                      stop, {request.range_m});
      }
    } catch (const Interrupted&) {
      throw WorkError(fmt::format("interrupted after {} of {} views", view, sweep.views()));
    }
    progress.advance();
  }
  return segments;
}

// Adds the scattering matrices of cavities to every model of the sweep.
void add_cavities(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop,
                  RcsSweep& sweep) {
  std::vector<BistaticGeometry> views;
  for (std::size_t view = 0; view < sweep.views(); ++view)
    views.push_back(antennas_of(request, basis_at(sweep.azimuth_of(view), sweep.elevation_of(view))));
  Progress progress("cavity", target.cavities.size() * sweep.frequency_hz.size(), "frequencies");
  for (const NamedCavity& named : target.cavities) {
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      std::vector<std::array<Complex, 4>> echo(sweep.views());
      try {
        if (target.filter.accepts_cavity(named.part))
          echo =
              named.cavity.scattering_matrices(2 * kPi * sweep.frequency_hz[q] / kSpeedOfLight, views, threads, stop);
      } catch (const WorkError& error) {
        throw WorkError(
            fmt::format("cavity {} at {:.6g} GHz: {}", named.name, 1e-9 * sweep.frequency_hz[q], error.what()));
      }
      for (RcsSweep::Model& model : sweep.models) {
        for (std::size_t view = 0; view < sweep.views(); ++view) {
          for (int i = 0; i < 4; ++i) model.matrices[view][q][i] += echo[view][i];
        }
      }
      progress.advance();
    }
  }
}

}  // namespace

RadarBasis basis_at(double azimuth_deg, double elevation_deg) {
  const Vec3 r = direction_to_radar(radians(azimuth_deg), radians(elevation_deg));
  if (std::abs(elevation_deg) != 90) return radar_basis(r);
  const Vec3 h = direction_to_radar(radians(azimuth_deg + 90), 0);
  return {r, h, r.cross(h)};
}

TracingSettings settings_of(const RcsRequest& request, const RcsTarget& target, bool edge_diffraction) {
  return {request.min_patch_m, request.max_bounces, edge_diffraction, target.filter};
}

RcsResult compute_rcs(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop) {
  RcsResult result{requested_sweep(request), 0};
  RcsSweep& sweep = result.sweep;
  const std::vector<std::vector<std::array<Complex, 4>>> empty(sweep.views());
  if (!request.edges || request.physical_optics_too) sweep.models.push_back({"po", false, empty});
  if (request.edges) sweep.models.push_back({"po+diffraction", true, empty});
  const int count = thread_count(threads);
  result.segments = compute_sweep(request, target, count, stop, sweep);
  if (!target.cavities.empty()) add_cavities(request, target, count, stop, sweep);
  return result;
}

}  // namespace seaglint
