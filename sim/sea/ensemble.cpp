// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/ensemble.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/periodogram.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/scenario/sample_plan.h"
#include "sim/sea/realisation.h"

namespace seaglint {

SeaEnsemble make_ensemble(const SeaState& state, std::size_t state_index, std::uint64_t seed, int count,
                          double duration_s, double step_s, int threads, const StopFlag& stop) {
  // Crests need about twenty samples per wave.
  const double step = std::min(step_s, state.peak_period_s / 20);
  const auto samples = static_cast<std::size_t>(duration_s / step) + 1;
  const double duration = step * static_cast<double>(samples);
  const double resolution = 2 * kPi / duration;
  const double highest = std::min(1.2 * state.cutoff_rad_s, 0.9 * kPi / step);
  const auto lines = static_cast<std::size_t>(highest / resolution);
  if (lines < 2) throw InputError("--duration-s: too short for a spectrum of this sea");

  struct Part {
    std::vector<double> crests;
    std::vector<std::vector<double>> density;  // of the elevation and of its linear part
    std::array<double, 4> moments{};           // means of eta, its square, cube and fourth power
  };
  std::vector<Part> parts(static_cast<std::size_t>(count));
  Progress progress("sea", parts.size(), "realisations");
  parallel_for(
      parts.size(), threads,
      [&](std::size_t i) {
        const WaveField field = realise_sea(state, seed, sea_key(state_index, i));
        std::array<std::vector<double>, 2> elevation;
        SurfaceSeries series(field, 0, 0, 0, step, SurfaceQuantities::kElevationAndSlope);
        for (std::size_t n = 0; n < samples; ++n, series.advance()) {
          const SurfaceState surface = series.state();
          elevation[0].push_back(surface.elevation);
          elevation[1].push_back(surface.elevation_linear);
        }
        Part& part = parts[i];
        for (const double eta : elevation[0]) {
          double power = 1;
          for (double& moment : part.moments) moment += (power *= eta) / static_cast<double>(samples);
        }
        part.crests = crest_heights(elevation[0]);
        part.density = periodograms(elevation, step, lines);
        progress.advance();
      },
      &stop);

  SeaEnsemble ensemble;
  ensemble.realisations = count;
  std::array<double, 4> m{};
  for (const Part& part : parts) {
    for (std::size_t i = 0; i < m.size(); ++i) m[i] += part.moments[i] / count;
    ensemble.crests.insert(ensemble.crests.end(), part.crests.begin(), part.crests.end());
  }
  std::sort(ensemble.crests.begin(), ensemble.crests.end());
  const double variance = m[1] - m[0] * m[0];
  ensemble.significant_wave_height_m = 4 * std::sqrt(variance);
  ensemble.skewness = (m[2] - 3 * m[0] * m[1] + 2 * std::pow(m[0], 3)) / std::pow(variance, 1.5);
  ensemble.kurtosis = (m[3] - 4 * m[0] * m[2] + 6 * m[0] * m[0] * m[1] - 3 * std::pow(m[0], 4)) / (variance * variance);
  if (!ensemble.crests.empty()) {
    ensemble.zero_crossing_period_s = duration * count / static_cast<double>(ensemble.crests.size());
  }

  // Bands of about 1/40 of the peak frequency, at least one line.
  const auto band = std::max<std::size_t>(1, static_cast<std::size_t>(2 * kPi / state.peak_period_s / 40 / resolution));
  for (std::size_t first = 0; first + band <= lines; first += band) {
    double density = 0, linear = 0;
    for (const Part& part : parts) {
      for (std::size_t k = first; k < first + band; ++k) {
        density += part.density[0][k] / static_cast<double>(band) / count;
        linear += part.density[1][k] / static_cast<double>(band) / count;
      }
    }
    const double omega = resolution * (static_cast<double>(first) + 0.5 * static_cast<double>(band + 1));
    ensemble.omega.push_back(omega);
    ensemble.prescribed.push_back(prescribed_density(state, omega));
    ensemble.realised.push_back(density);
    ensemble.realised_linear.push_back(linear);
  }
  return ensemble;
}

}  // namespace seaglint
