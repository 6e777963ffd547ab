// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/sea_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/scenario/cases.h"

namespace seaglint {

namespace {

constexpr double kThin = 0.8;  // of lines that several states have in common

Series curve(std::string name, std::string colour = {}, double width = 1.6) {
  return {.name = std::move(name), .x = {}, .y = {}, .interval = {}, .colour = std::move(colour), .width = width};
}

// The states of a figure: of several each has a colour, of one each quantity.
struct Cases {
  std::span<const SeaCase> all;
  std::vector<std::string> names;

  bool single() const { return all.size() == 1; }
};

LinePlot elevation_plot(const Cases& cases) {
  LinePlot plot{.title = "Elevation of realisation 0", .x = {"time (s)", {}}, .y = {"elevation (m)", {}}, .series = {}};
  double longest = 0;
  for (const SeaCase& one : cases.all) longest = std::max(longest, one.state.peak_period_s);
  const double duration = longest * (cases.single() ? 12 : 5);
  for (std::size_t i = 0; i < cases.all.size(); ++i) {
    const SeaCase& one = cases.all[i];
    const double step = one.state.peak_period_s / 80;
    SurfaceSeries surface(one.field, 0, 0, 0, step, SurfaceQuantities::kElevationAndSlope);
    Series whole = curve(cases.single() ? "second order" : cases.names[i]), linear = curve("linear part", {}, kThin);
    if (one.field.order() == 1 && cases.single()) whole.name = "linear";
    for (int n = 0; step * n <= duration * (1 + 1e-9); ++n, surface.advance()) {
      const SurfaceState s = surface.state();
      whole.x.push_back(step * n);
      whole.y.push_back(s.elevation);
      linear.x.push_back(step * n);
      linear.y.push_back(s.elevation_linear);
    }
    plot.series.push_back(std::move(whole));
    if (cases.single() && one.field.order() > 1) plot.series.push_back(std::move(linear));
  }
  return plot;
}

LinePlot spectrum_plot(const Cases& cases) {
  double highest = 0, end = 0;
  LinePlot plot{.title = fmt::format("Spectrum, mean of {} realisations", cases.all.front().ensemble.realisations),
                .x = {"angular frequency (rad/s)", {}},
                .y = {"density (m^2 s/rad)", {}, true},
                .series = {}};
  for (std::size_t i = 0; i < cases.all.size(); ++i) {
    const auto& [state, field, summary, ensemble] = cases.all[i];
    highest = std::max(highest, *std::ranges::max_element(ensemble.prescribed));
    end = std::max(end, std::min(1.2 * summary.cutoff_rad_s, ensemble.omega.back()));
    const auto of_density = [&](Series series, const std::vector<double>& density) {
      series.x = ensemble.omega;
      series.y = density;
      plot.series.push_back(std::move(series));
    };
    if (cases.single()) {
      of_density(curve(field.order() > 1 ? "second order" : "realised"), ensemble.realised);
      if (field.order() > 1) of_density(curve("linear part"), ensemble.realised_linear);
      of_density(curve("prescribed", series_colour(2)), ensemble.prescribed);
    } else {
      of_density(curve(cases.names[i], series_colour(i)), ensemble.realised);
      of_density(curve(i == 0 ? "prescribed" : "", kReferenceColour, kThin), ensemble.prescribed);
    }
  }
  plot.x.range = AxisRange{0, end};
  plot.y.range = AxisRange{1e-6 * highest, 3 * highest};
  return plot;
}

LinePlot crest_plot(const Cases& cases) {
  std::size_t most = 10, count = 0;
  LinePlot plot{.title = {}, .x = {"crest height / Hs", AxisRange{0, 1.5}}, .y = {}, .series = {}};
  Series rayleigh = curve("Rayleigh", cases.single() ? series_colour(2) : kReferenceColour);
  std::vector<Series> fits;
  for (std::size_t i = 0; i < cases.all.size(); ++i) {
    const auto& [state, field, summary, ensemble] = cases.all[i];
    const double height = summary.significant_wave_height_m;
    const ForristallCrests forristall =
        forristall_crests(height, summary.steepness, summary.ursell, summary.long_crested);
    Series simulated = curve(cases.single() ? "simulated" : cases.names[i], series_colour(i));
    simulated.style = SeriesStyle::kPoints;
    // Every crest among the highest, a subset of the others.
    const std::size_t crests = ensemble.crests.size();
    for (std::size_t rank = 1; rank <= crests; rank = std::max(rank + 1, rank + rank * 15 / 100)) {
      simulated.x.push_back(ensemble.crests[crests - rank] / height);
      simulated.y.push_back(static_cast<double>(rank) / static_cast<double>(crests + 1));
    }
    count += crests;
    most = std::max(most, crests);
    plot.series.push_back(std::move(simulated));
    Series fit = curve(
        cases.single() ? fmt::format("Forristall (2000), {}-crested", summary.long_crested ? "long" : "short") : "",
        series_colour(cases.single() ? 1 : i), cases.single() ? 1.6 : kThin);
    for (int k = 0; k <= 150; ++k) {
      const double x = 0.01 * k;
      fit.x.push_back(x);
      fit.y.push_back(forristall.exceedance(x * height));
      if (i > 0) continue;
      rayleigh.x.push_back(x);
      rayleigh.y.push_back(rayleigh_exceedance(x * height, height));
    }
    fits.push_back(std::move(fit));
  }
  plot.series.insert(plot.series.end(), fits.begin(), fits.end());
  plot.series.push_back(std::move(rayleigh));
  plot.title = fmt::format("Exceedance of {} crests{}", count, cases.single() ? "" : ", thin: Forristall (2000)");
  plot.y = {"probability per crest", AxisRange{0.3 / static_cast<double>(most), 1}, true};
  return plot;
}

LinePlot slope_plot(const Cases& cases) {
  LinePlot plot{.title = "Slope up to a cut-off",
                .x = {"cut-off (rad/s)", {}},
                .y = {"RMS slope of linear waves", {}},
                .series = {}};
  double longest = 0;
  for (std::size_t i = 0; i < cases.all.size(); ++i) {
    const auto& [state, field, summary, ensemble] = cases.all[i];
    Series prescribed = cases.single() ? curve("spectrum") : curve(i == 0 ? "spectrum" : "", kReferenceColour, kThin);
    const double end = 2 * summary.cutoff_rad_s;
    longest = std::max(longest, end);
    constexpr int kSteps = 400;
    double variance = 0;
    for (int n = 0; n < kSteps; ++n) {
      const double omega = end * (n + 0.5) / kSteps;
      const double k = wavenumber_at(omega, field.depth());
      variance += prescribed_density(state, omega) * k * k * end / kSteps;
      prescribed.x.push_back(end * (n + 1) / kSteps);
      prescribed.y.push_back(std::sqrt(variance));
    }
    Series realised = curve(cases.single() ? "components" : cases.names[i], series_colour(cases.single() ? 1 : i));
    double sum = 0;
    for (const WaveComponent& c : field.components()) {
      sum += 0.5 * c.amplitude * c.amplitude * c.wavenumber * c.wavenumber;
      realised.x.push_back(c.omega);
      realised.y.push_back(std::sqrt(sum));
    }
    plot.series.push_back(std::move(prescribed));
    plot.series.push_back(std::move(realised));
  }
  if (cases.single()) plot.title += fmt::format(", here {:.3g} rad/s", cases.all.front().summary.cutoff_rad_s);
  plot.x.range = AxisRange{0, longest};
  return plot;
}

// The quantities of a state, in the order of their weight.
std::vector<std::string> quantities(const SeaState& state) {
  std::vector<std::string> texts{fmt::format("Hs {:.3g} m", total_wave_height(state)),
                                 fmt::format("Tp {:.3g} s", state.peak_period_s),
                                 fmt::format("towards {:.4g} deg", degrees(state.propagation_rad)),
                                 state.table ? "spectrum of a table" : fmt::format("gamma {:.3g}", state.gamma), ""};
  const WaveSystemState& swell = state.swell;
  if (swell.significant_wave_height_m > 0) {
    texts.back() = fmt::format("of it swell {:.3g} m, {:.3g} s towards {:.4g} deg", swell.significant_wave_height_m,
                               swell.peak_period_s, degrees(swell.propagation_rad));
  }
  return texts;
}

// The i-th quantity is the same in all states.
bool is_common(std::span<const SeaState> states, std::size_t i) {
  return std::ranges::all_of(states,
                             [&](const SeaState& s) { return quantities(s)[i] == quantities(states.front())[i]; });
}

// The height that a crest exceeds with this probability.
double exceeded_by(const std::vector<double>& ascending, double probability) {
  const auto rank = static_cast<std::size_t>((1 - probability) * static_cast<double>(ascending.size()));
  return ascending[std::min(rank, ascending.size() - 1)];
}

}  // namespace

std::vector<std::string> with_left_out(std::vector<std::string> notes, std::size_t all, std::size_t drawn,
                                       const char* what) {
  if (drawn < all)
    notes.push_back(fmt::format("{} more {}{} not drawn", all - drawn, what, all - drawn == 1 ? "" : "s"));
  return notes;
}

std::vector<std::string> state_names(std::span<const SeaState> states) {
  std::vector<std::string> names(states.size());
  if (states.size() < 2) return names;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const std::vector<std::string> texts = quantities(states[s]);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (is_common(states, i) || texts[i].empty()) continue;
      names[s] += (names[s].empty() ? "" : ", ") + texts[i];
    }
    if (names[s].empty()) names[s] = fmt::format("state {}", s);
  }
  return names;
}

CommonOfStates common_of(std::span<const SeaState> states) {
  const double depth = states.front().depth_m;
  CommonOfStates common{{}, depth == kDeepWater ? "deep water" : fmt::format("depth {:.4g} m", depth)};
  const std::vector<std::string> texts = quantities(states.front());
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (is_common(states, i) && !texts[i].empty()) common.quantities.push_back(texts[i]);
  return common;
}

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

void write_sea_figure(std::span<const SeaCase> cases, const FigureText& text, const std::filesystem::path& file) {
  std::vector<SeaState> states;
  for (const SeaCase& one : cases) states.push_back(one.state);
  const Cases drawn{cases.first(std::min(cases.size(), kMostStates)), state_names(states)};
  write_figure(
      {
          .plots = {elevation_plot(drawn), spectrum_plot(drawn), crest_plot(drawn), slope_plot(drawn)},
          .columns = 2,
          .size = {1300, 980, text.style},
          .title = text.title,
          .notes = with_left_out(text.notes, cases.size(), drawn.all.size()),
      },
      file);
}

}  // namespace seaglint
