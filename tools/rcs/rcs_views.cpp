// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/scattering/response/body_response.h"
#include "sim/scattering/response/scattering_matrix.h"
#include "sim/scattering/response/sea_reflection.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {
namespace {

// At the zenith and below the keel h is that of the azimuth's lower elevations, phi^ of a spherical table.
RadarBasis basis_at(double azimuth_deg, double elevation_deg) {
  const Vec3 r = direction_at(azimuth_deg, elevation_deg);
  if (std::abs(elevation_deg) != 90) return radar_basis(r);
  const Vec3 h = direction_at(azimuth_deg + 90, 0);
  return {r, h, r.cross(h)};
}

AntennaPair antennas_of(const RcsArguments& arguments, const RadarBasis& swept) {
  if (!arguments.transmit_azimuth_deg) return monostatic(swept);
  return bistatic(basis_at(*arguments.transmit_azimuth_deg, arguments.transmit_elevation_deg.value_or(0)), swept);
}

}  // namespace

RadarBasis basis_of(const RcsSweep& sweep, std::size_t view) {
  return basis_at(sweep.azimuth_deg[view % sweep.azimuth_deg.size()],
                  sweep.elevation_deg[view / sweep.azimuth_deg.size()]);
}

std::size_t trace_views(const RcsArguments& arguments, const Scatterer& scatterer, const EchoFilter& filter,
                        const Shell& shell, RcsSweep& sweep) {
  std::vector<double> wavenumbers;
  for (const double hz : sweep.frequency_hz) wavenumbers.push_back(2 * kPi * hz / kSpeedOfLight);
  // What is written comes last; a reference is shown beside physical optics alone too.
  const std::vector<std::vector<std::array<Complex, 4>>> empty(sweep.views());
  const bool edges = arguments.edges == "on";
  if (!edges || !arguments.reference.files.empty()) sweep.models.push_back({"po", empty});
  if (edges) sweep.models.push_back({"edges", empty});
  std::size_t legs = 0;
  Progress progress("rcs", sweep.views(), "views");
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    const RadarBasis basis = basis_of(sweep, view);
    try {
      for (auto& model : sweep.models) {
        const IlluminationSettings settings{arguments.ray_spacing_m, arguments.max_bounces, model.name == "edges",
                                            filter, arguments.range_m};
        const int threads = thread_count(shell.threads);
        model.matrices[view] =
            arguments.sea.reflection
                ? scattering_matrices_over_sea(scatterer, basis.r, arguments.sea.height_m, arguments.sea.mirror(),
                                               wavenumbers, settings, threads, &legs, &shell.stop)
                : scattering_matrices(scatterer, antennas_of(arguments, basis), wavenumbers, settings, threads, &legs,
                                      &shell.stop);
      }
    } catch (const Interrupted&) {
      throw WorkError(
          fmt::format("interrupted after {} of {} views; {} is not written", view, sweep.views(), arguments.output));
    }
    progress.advance();
  }
  return legs;
}

void add_cavities(const RcsArguments& arguments, const std::vector<NamedCavity>& cavities, const EchoFilter& filter,
                  const Shell& shell, RcsSweep& sweep) {
  std::vector<AntennaPair> views;
  for (std::size_t view = 0; view < sweep.views(); ++view)
    views.push_back(antennas_of(arguments, basis_of(sweep, view)));
  Progress progress("cavity", cavities.size() * sweep.frequency_hz.size(), "frequencies");
  for (const NamedCavity& named : cavities) {
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      const auto failed = [&](const char* why) {
        return WorkError(fmt::format("cavity {} at {:.6g} GHz: {}; {} is not written", named.name,
                                     1e-9 * sweep.frequency_hz[q], why, arguments.output));
      };
      std::vector<std::array<Complex, 4>> echo(sweep.views());
      try {
        if (filter.keeps_cavity(named.part))
          echo = named.cavity.scattering_matrices(2 * kPi * sweep.frequency_hz[q] / kSpeedOfLight, views,
                                                  thread_count(shell.threads), &shell.stop);
      } catch (const WorkError& error) {
        throw failed(error.what());
      }
      for (auto& model : sweep.models) {
        for (std::size_t view = 0; view < sweep.views(); ++view) {
          for (int i = 0; i < 4; ++i) model.matrices[view][q][i] += echo[view][i];
        }
      }
      progress.advance();
    }
  }
}

// Behind a target only its sharp edges scatter: a sphere's echo errs by 0.65 dB in the mean between 90 and 120 deg from
// the transmitter.
void warn_of_receivers_behind(const RcsSweep& sweep) {
  constexpr double kFarthestDeg = 120;
  double farthest = 0;
  for (std::size_t view = 0; sweep.transmitter && view < sweep.views(); ++view)
    farthest =
        std::max(farthest, degrees(std::acos(std::clamp(sweep.transmitter->dot(basis_of(sweep, view).r), -1.0, 1.0))));
  if (farthest <= kFarthestDeg) return;
  warn(
      std::vector{fmt::format("receivers up to {:.0f} deg from the transmitter: behind the target, beyond {:g} deg, "
                              "only sharp edges scatter, and the shadow's own field, within 15 deg of "
                              "the wave's way on, is not modelled",
                              farthest, kFarthestDeg)});
}

}  // namespace seaglint
