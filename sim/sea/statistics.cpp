// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/scenario/sample_plan.h"
#include "sim/sea/realisation.h"
#include "sim/sea/spectrum.h"

namespace seaglint {

namespace {

double slope_variance_between(const Spectrum& spectrum, double lower, double upper, double depth) {
  return integrate(lower, upper, 0.02 * lower, [&](double omega) {
    const double k = wavenumber_at(omega, depth);
    return spectrum.density(omega) * k * k;
  });
}

}  // namespace

SeaSummary summarise(const SeaState& state, const WaveField& field) {
  SeaSummary summary;
  summary.cutoff_rad_s = linear_cutoff(state);
  summary.second_order_cutoff_rad_s = second_order_cutoff(state);
  summary.long_crested = field.long_crested();
  double m0 = 0, m1 = 0;
  Vec2 direction = Vec2::Zero();
  for (const WaveComponent& c : field.components()) {
    const double e = 0.5 * c.amplitude * c.amplitude;
    m0 += e;
    m1 += e * c.omega;
    direction += e * c.direction;
    summary.slope_variance += e * c.wavenumber * c.wavenumber;
  }
  summary.significant_wave_height_m = 4 * std::sqrt(m0);
  if (m0 == 0) return summary;

  if (const auto wind_sea = wind_sea_spectrum(state)) {
    const double cutoff = summary.cutoff_rad_s;
    summary.energy_fraction_above_cutoff = wind_sea->energy_above(cutoff) / wind_sea->total_energy();
    summary.slope_variance_next_octave = slope_variance_between(*wind_sea, cutoff, 2 * cutoff, field.depth());
  }
  summary.mean_period_s = 2 * kPi * m0 / m1;
  summary.direction_r1 = direction.norm() / m0;
  summary.skewness = field.third_cumulant() / std::pow(m0, 1.5);
  const double omega1 = m1 / m0;
  summary.steepness = summary.significant_wave_height_m * omega1 * omega1 / (2 * kPi * kGravity);
  if (field.depth() != kDeepWater) {
    const double k1 = wavenumber_at(omega1, field.depth());
    summary.ursell = summary.significant_wave_height_m / (k1 * k1 * std::pow(field.depth(), 3));
  }
  return summary;
}

double prescribed_density(const SeaState& state, double omega) {
  const auto wind_sea = wind_sea_spectrum(state);
  const auto swell = swell_spectrum(state);
  return (wind_sea ? wind_sea->density(omega) : 0) + (swell ? swell->density(omega) : 0);
}

std::vector<double> crest_heights(std::span<const double> elevation) {
  std::vector<double> crests;
  bool in_wave = false;  // after an up-crossing
  std::size_t highest = 0;
  for (std::size_t i = 1; i < elevation.size(); ++i) {
    if (elevation[i - 1] <= 0 && elevation[i] > 0) {
      in_wave = true;
      highest = i;
    } else if (in_wave && elevation[i] <= 0) {
      // The parabola through three samples peaks (a - c)^2 / (8 (2 b - a - c)) above the middle one.
      const double a = elevation[highest - 1], b = elevation[highest], c = elevation[highest + 1];
      const double curvature = 2 * b - a - c;
      crests.push_back(b + (curvature > 0 ? (a - c) * (a - c) / (8 * curvature) : 0));
      in_wave = false;
    } else if (in_wave && elevation[i] > elevation[highest]) {
      highest = i;
    }
  }
  return crests;
}

double rayleigh_exceedance(double height, double significant_wave_height) {
  const double ratio = height / significant_wave_height;
  return height > 0 ? std::exp(-8 * ratio * ratio) : 1;
}

ForristallCrests forristall_crests(double significant_wave_height, double steepness, double ursell, bool long_crested) {
  const double alpha =
      long_crested ? 0.3536 + 0.2892 * steepness + 0.1060 * ursell : 0.3536 + 0.2568 * steepness + 0.0800 * ursell;
  const double beta = long_crested ? 2 - 2.1597 * steepness + 0.0968 * ursell * ursell
                                   : 2 - 1.7912 * steepness - 0.5302 * ursell + 0.2824 * ursell * ursell;
  return {alpha * significant_wave_height, beta};
}

double ForristallCrests::exceedance(double height) const {
  return height > 0 ? std::exp(-std::pow(height / scale, beta)) : 1;
}

double ForristallCrests::height(double probability) const { return scale * std::pow(-std::log(probability), 1 / beta); }

SeaEnsemble make_ensemble(const EnsembleRequest& request) {
  const SeaState& state = request.state;
  // Crests need about twenty samples per wave.
  const double step = std::min(request.step_s, state.peak_period_s / 20);
  const auto samples = static_cast<std::size_t>(request.duration_s / step) + 1;
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
  std::vector<Part> parts(static_cast<std::size_t>(request.realisations));
  Progress progress("sea", parts.size(), "realisations");
  parallel_for(
      parts.size(), request.threads,
      [&](std::size_t i) {
        const WaveField field = realise_sea(state, request.seed, sea_key(request.state_index, i));
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
      request.stop);

  SeaEnsemble ensemble;
  const int count = ensemble.realisations = request.realisations;
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
