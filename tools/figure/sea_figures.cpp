// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/sea_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "sim/core/numbers/constants.h"
#include "tools/figure/figure.h"

namespace seaglint {

namespace {

LinePlot elevation_plot(const SeaState& state, const WaveField& field) {
  LinePlot plot{.title = "Elevation of realisation 0",
                .x = {"time (s)", {}},
                .y = {"elevation (m)", {}},
                .series = {},
                .legend_above = true};
  const double step = state.peak_period_s / 80;
  SurfaceSeries surface(field, 0, 0, 0, step, SurfaceQuantities::kElevationAndSlope);
  Series second{.name = "second order", .x = {}, .y = {}, .interval = {}};
  Series linear{.name = "linear part", .x = {}, .y = {}, .interval = {}};
  constexpr int kWaves = 12;
  for (int n = 0; n <= 80 * kWaves; ++n, surface.advance()) {
    const SurfaceState s = surface.state();
    second.x.push_back(step * n);
    second.y.push_back(s.elevation);
    linear.x.push_back(step * n);
    linear.y.push_back(s.elevation_linear);
  }
  plot.series = {second, linear};
  return plot;
}

LinePlot spectrum_plot(const SeaSummary& summary, const SeaEnsemble& ensemble) {
  const double highest = *std::max_element(ensemble.prescribed.begin(), ensemble.prescribed.end());
  const double end = std::min(1.2 * summary.cutoff_rad_s, ensemble.omega.back());
  LinePlot plot{.title = fmt::format("Spectrum, mean of {} realisations", ensemble.realisations),
                .x = {"angular frequency (rad/s)", AxisRange{0, end}},
                .y = {"density (m^2 s/rad)", AxisRange{1e-6 * highest, 3 * highest}, true},
                .series = {},
                .legend_above = true};
  plot.series.push_back({.name = "second order", .x = ensemble.omega, .y = ensemble.realised, .interval = {}});
  plot.series.push_back({.name = "linear part", .x = ensemble.omega, .y = ensemble.realised_linear, .interval = {}});
  plot.series.push_back({.name = "target", .x = ensemble.omega, .y = ensemble.prescribed, .interval = {}});
  return plot;
}

LinePlot crest_plot(const SeaSummary& summary, const SeaEnsemble& ensemble) {
  const double height = summary.significant_wave_height_m;
  const ForristallCrests forristall =
      forristall_crests(height, summary.steepness, summary.ursell, summary.long_crested);
  Series simulated{.name = "simulated", .x = {}, .y = {}, .interval = {}, .style = SeriesStyle::kPoints};
  // Every crest among the highest, a subset of the others.
  const std::size_t count = ensemble.crests.size();
  for (std::size_t rank = 1; rank <= count; rank = std::max(rank + 1, rank + rank * 15 / 100)) {
    simulated.x.push_back(ensemble.crests[count - rank] / height);
    simulated.y.push_back(static_cast<double>(rank) / static_cast<double>(count + 1));
  }
  Series fit{.name = fmt::format("Forristall (2000), {}-crested", summary.long_crested ? "long" : "short"),
             .x = {},
             .y = {},
             .interval = {}};
  Series rayleigh{.name = "Rayleigh", .x = {}, .y = {}, .interval = {}};
  for (int i = 0; i <= 150; ++i) {
    const double x = 0.01 * i;
    fit.x.push_back(x);
    fit.y.push_back(forristall.exceedance(x * height));
    rayleigh.x.push_back(x);
    rayleigh.y.push_back(rayleigh_exceedance(x * height, height));
  }
  const double lowest = 0.3 / static_cast<double>(std::max<std::size_t>(count, 10));
  LinePlot plot{.title = fmt::format("Exceedance of {} crests", count),
                .x = {"crest height / Hs", AxisRange{0, 1.5}},
                .y = {"probability per crest", AxisRange{lowest, 1}, true},
                .series = {},
                .legend_above = true};
  plot.series = {simulated, fit, rayleigh};
  return plot;
}

LinePlot slope_plot(const SeaState& state, const WaveField& field, const SeaSummary& summary) {
  Series target{.name = "spectrum", .x = {}, .y = {}, .interval = {}};
  const double end = 2 * summary.cutoff_rad_s;
  constexpr int kSteps = 400;
  double variance = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double omega = end * (i + 0.5) / kSteps;
    const double k = wavenumber_at(omega, field.depth());
    variance += prescribed_density(state, omega) * k * k * end / kSteps;
    target.x.push_back(end * (i + 1) / kSteps);
    target.y.push_back(std::sqrt(variance));
  }
  Series realised{.name = "components", .x = {}, .y = {}, .interval = {}};
  double sum = 0;
  for (const WaveComponent& c : field.components()) {
    sum += 0.5 * c.amplitude * c.amplitude * c.wavenumber * c.wavenumber;
    realised.x.push_back(c.omega);
    realised.y.push_back(std::sqrt(sum));
  }
  LinePlot plot{.title = fmt::format("Slope up to a cut-off, here {:.3g} rad/s", summary.cutoff_rad_s),
                .x = {"cut-off (rad/s)", AxisRange{0, end}},
                .y = {"RMS slope of the linear waves", {}},
                .series = {},
                .legend_above = true};
  plot.series = {target, realised};
  return plot;
}

// The height that a crest exceeds with this probability.
double exceeded_by(const std::vector<double>& ascending, double probability) {
  const auto rank = static_cast<std::size_t>((1 - probability) * static_cast<double>(ascending.size()));
  return ascending[std::min(rank, ascending.size() - 1)];
}

}  // namespace

std::string spectrum_csv(const SeaEnsemble& ensemble) {
  std::string text = "omega_rad_s,density_m2_s,realised_density_m2_s,realised_linear_density_m2_s\n";
  for (std::size_t i = 0; i < ensemble.omega.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g},{:.9g},{:.9g}\n", ensemble.omega[i], ensemble.prescribed[i],
                   ensemble.realised[i], ensemble.realised_linear[i]);
  }
  return text;
}

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
  for (const double probability : {0.1, 0.01, 0.001}) {
    // At least ten crests are needed for a meaningful height.
    if (probability * static_cast<double>(ensemble.crests.size()) < 10) {
      text += " too few crests,";
      continue;
    }
    const double rayleigh = summary.significant_wave_height_m * std::sqrt(-std::log(probability) / 8);
    fmt::format_to(out, " {:.3g} m (Forristall {:.3g}, Rayleigh {:.3g}),", exceeded_by(ensemble.crests, probability),
                   forristall.height(probability), rayleigh);
  }
  text.back() = '\n';
  return text;
}

void write_sea_figure(const SeaState& state, const WaveField& field, const SeaSummary& summary,
                      const SeaEnsemble& ensemble, const std::string& title, const std::filesystem::path& file) {
  write_figure(
      {
          .plots = {elevation_plot(state, field), spectrum_plot(summary, ensemble), crest_plot(summary, ensemble),
                    slope_plot(state, field, summary)},
          .columns = 2,
          .size = {1300, 940},
          .title = title,
      },
      file);
}

}  // namespace seaglint
