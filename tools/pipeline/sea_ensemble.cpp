// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/sea_ensemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/realisation.h"

namespace seaglint {

namespace {

// Densities of two series of one length at omega = n 2 pi / duration, n = 1 to count: Hann's window, one-sided.
std::array<std::vector<double>, 2> periodograms(const std::array<std::vector<double>, 2>& series, double step,
                                                std::size_t count) {
  const std::size_t samples = series[0].size();
  FourierBatch transform(samples, series.size(), Fourier::kForward);
  double power = 0;
  for (std::size_t n = 0; n < samples; ++n) {
    const double window = 0.5 - 0.5 * std::cos(2 * kPi * (static_cast<double>(n) + 0.5) / static_cast<double>(samples));
    for (std::size_t i = 0; i < series.size(); ++i) transform.row(i)[n] = window * series[i][n];
    power += window * window;
  }
  transform.execute();
  std::array<std::vector<double>, 2> density;
  for (std::size_t i = 0; i < series.size(); ++i) {
    for (std::size_t k = 1; k <= count; ++k)
      density[i].push_back(std::norm(transform.row(i)[k]) * step / (kPi * power));
  }
  return density;
}

}  // namespace

SeaEnsemble make_ensemble(const SeaState& state, std::size_t state_index, std::uint64_t seed, int count,
                          double duration_s, double step_s, int threads, const StopFlag& stop) {
  // Crests need some twenty samples per wave.
  const double step = std::min(step_s, state.peak_period_s / 20);
  const auto samples = static_cast<std::size_t>(duration_s / step) + 1;
  const double duration = step * static_cast<double>(samples);
  const double resolution = 2 * kPi / duration;
  const double highest = std::min(1.2 * state.cutoff_rad_s, 0.9 * kPi / step);
  const auto lines = static_cast<std::size_t>(highest / resolution);
  if (lines < 2) throw InputError("--duration-s: too short for a spectrum of this sea");

  struct Part {
    std::vector<double> crests;
    std::array<std::vector<double>, 2> density;  // of the elevation and of its linear part
    std::array<double, 4> moments{};             // means of eta, its square, cube and fourth power
  };
  std::vector<Part> parts(static_cast<std::size_t>(count));
  Progress progress("sea", parts.size(), "realisations");
  parallel_for(
      parts.size(), threads,
      [&](std::size_t i) {
        const WaveField field = realize_sea(state, seed, realisation_index(state_index, i));
        std::array<std::vector<double>, 2> elevation;
        SurfaceSeries series(field, 0, 0, 0, step, SurfaceDetail::kShape);
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

  // Bands of some 1/40 of the peak's frequency, of one line at least.
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
    ensemble.target.push_back(target_density(state, omega));
    ensemble.realised.push_back(density);
    ensemble.realised_linear.push_back(linear);
  }
  return ensemble;
}

std::string spectrum_csv(const SeaEnsemble& ensemble) {
  std::string text = "omega_rad_s,density_m2_s,realised_m2_s,realised_linear_m2_s\n";
  for (std::size_t i = 0; i < ensemble.omega.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g},{:.9g},{:.9g}\n", ensemble.omega[i], ensemble.target[i],
                   ensemble.realised[i], ensemble.realised_linear[i]);
  }
  return text;
}

namespace {

// The height that a share of the crests passes.
double exceeded_by(const std::vector<double>& ascending, double share) {
  const auto rank = static_cast<std::size_t>((1 - share) * static_cast<double>(ascending.size()));
  return ascending[std::min(rank, ascending.size() - 1)];
}

}  // namespace

std::string ensemble_text(const SeaEnsemble& ensemble, const SeaSummary& summary) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "{} realisations: 4 sigma {:.4g} m, skewness {:.3f} (expected {:.3f}), kurtosis {:.3f}, Tz {:.3g} s\n",
                 ensemble.realisations, ensemble.significant_wave_height_m, ensemble.skewness, summary.skewness,
                 ensemble.kurtosis, ensemble.zero_crossing_period_s);
  const ForristallCrests forristall =
      forristall_crests(summary.significant_wave_height_m, summary.steepness, summary.ursell, summary.long_crested);
  fmt::format_to(out, "{} crests; height passed by 10 / 1 / 0.1 %:", ensemble.crests.size());
  for (const double share : {0.1, 0.01, 0.001}) {
    // Ten crests at least, or a height is chance.
    if (share * static_cast<double>(ensemble.crests.size()) < 10) {
      text += " too few crests,";
      continue;
    }
    const double rayleigh = summary.significant_wave_height_m * std::sqrt(-std::log(share) / 8);
    fmt::format_to(out, " {:.3g} m (Forristall {:.3g}, Rayleigh {:.3g}),", exceeded_by(ensemble.crests, share),
                   forristall.height(share), rayleigh);
  }
  text.back() = '\n';
  return text;
}

}  // namespace seaglint
