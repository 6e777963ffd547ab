// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "sim/core/numbers/dbsm.h"
#include "tools/figure/figure.h"

namespace seaglint {
namespace {

constexpr double kLargeDifference_db = 1;
constexpr double kLargeShare = 0.25;  // of the echo: 2 dB
constexpr double kNegligible_db = 30;
constexpr double kLargestPrinted_db = 60, kLargestPrintedShare = 1000;
constexpr std::array<std::size_t, 2> kElement{0, 3};  // of a matrix: hh, vv
constexpr std::array<const char*, 2> kName{"hh", "vv"};

double largest(const std::array<double, 2>& values) { return std::max(values[0], values[1]); }

Complex echo(const RcsSweep& sweep, std::size_t view, std::size_t element) {
  return sweep.models.back().matrices[view][sweep.estimated][kElement[element]];
}

double ratio_db(const Complex& flat, const Complex& smooth) {
  if (flat == smooth) return 0;
  const double ratio = std::abs(flat) / std::max(std::abs(smooth), 1e-300);
  return std::clamp(20 * std::log10(std::max(ratio, 1e-300)), -kLargestPrinted_db, kLargestPrinted_db);
}

double share(double part, const Complex& whole) {
  return part > 0 && std::abs(whole) > 0 ? std::min(part / std::abs(whole), kLargestPrintedShare) : 0;
}

// The views in which the magnitude of a quantity exceeds a limit in hh or vv, and the place of its largest magnitude.
struct Exceeded {
  std::size_t views = 0, worst_view = 0, worst_element = 0;
  double worst = 0;
};

Exceeded exceeding(const RcsSweep& sweep, double limit, const std::function<double(std::size_t, std::size_t)>& value) {
  std::array<double, 2> floor{};
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    for (const std::size_t e : {0u, 1u})
      floor[e] = std::max(floor[e], std::abs(echo(sweep, view, e)) * std::pow(10.0, -kNegligible_db / 20));
  }
  Exceeded found;
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    bool exceeds = false;
    for (const std::size_t e : {0u, 1u}) {
      const double size = std::abs(echo(sweep, view, e));
      if (size == 0 || size < floor[e]) continue;
      const double of_view = value(view, e);
      exceeds = exceeds || std::abs(of_view) > limit;
      if (std::abs(of_view) > std::abs(found.worst)) found = {found.views, view, e, of_view};
    }
    if (exceeds) ++found.views;
  }
  return found;
}

std::string place_of(const RcsSweep& sweep, const Exceeded& found) {
  return fmt::format("azimuth {:.6g}, elevation {:.6g} deg, {}", sweep.azimuth_of(found.worst_view),
                     sweep.elevation_of(found.worst_view), kName[found.worst_element]);
}

std::string count_of(const RcsSweep& sweep, const Exceeded& found) {
  return fmt::format("{} of {} view{}", found.views, sweep.views(), sweep.views() == 1 ? "" : "s");
}

}  // namespace

ViewUncertainty summary_of(const ViewEstimate& estimate) {
  using Sums = ViewEstimate::Sums;
  const auto in_cavity = [](const Sums& sums) {
    return std::max(std::abs(sums.in_cavity[0]), std::abs(sums.in_cavity[1]));
  };
  ViewUncertainty view;
  const std::size_t cavity = estimate.largest_part(in_cavity);
  view.cavity_part = static_cast<std::uint16_t>(cavity);
  view.flat_part =
      static_cast<std::uint16_t>(estimate.largest_part([](const Sums& sums) { return largest(sums.flat_change); }));
  view.displaced_part =
      static_cast<std::uint16_t>(estimate.largest_part([](const Sums& sums) { return largest(sums.displaced_power); }));
  view.non_reciprocal_part =
      static_cast<std::uint16_t>(estimate.largest_part([](const Sums& sums) { return sums.non_reciprocal_size; }));
  const Sums all = estimate.all();
  view.non_reciprocal = static_cast<float>(std::abs(all.non_reciprocal));
  for (const std::size_t e : {0u, 1u}) {
    view.flat_less_smooth[e] = std::complex<float>(all.flat_less_smooth[e]);
    view.displaced[e] = static_cast<float>(std::sqrt(all.displaced_power[e]));
    if (cavity < estimate.parts().size())
      view.in_cavity[e] = std::complex<float>(estimate.parts()[cavity].in_cavity[e]);
  }
  return view;
}

double flat_over_smooth_db(const RcsSweep& sweep, std::size_t view, std::size_t element) {
  const Complex smooth = echo(sweep, view, element);
  return ratio_db(smooth + Complex(sweep.uncertainty[view].flat_less_smooth[element]), smooth);
}

double vertex_change(const RcsSweep& sweep, std::size_t view, std::size_t element) {
  return share(sweep.uncertainty[view].displaced[element], echo(sweep, view, element));
}

std::vector<std::string> uncertainty_warnings(const RcsSweep& sweep, std::span<const std::string> part_names) {
  std::vector<std::string> found;
  if (sweep.uncertainty.empty()) return found;
  const double ghz = 1e-9 * sweep.frequency_hz[sweep.estimated];
  const Exceeded flat = exceeding(sweep, kLargeDifference_db,
                                  [&](std::size_t view, std::size_t e) { return flat_over_smooth_db(sweep, view, e); });
  if (flat.views > 0) {
    found.push_back(fmt::format(
        "part '{}': with flat facets in place of smooth surfaces {} would differ by more than {:g} dB at {:.6g} GHz, "
        "most by {:+.1f} dB at {}{}",
        part_names[sweep.uncertainty[flat.worst_view].flat_part], count_of(sweep, flat), kLargeDifference_db, ghz,
        flat.worst, place_of(sweep, flat), sweep.flat ? "" : "; --uncertainty computes both"));
  }
  const Exceeded moved =
      exceeding(sweep, kLargeShare, [&](std::size_t view, std::size_t e) { return vertex_change(sweep, view, e); });
  if (moved.views > 0) {
    found.push_back(fmt::format(
        "part '{}': facets narrower than a Fresnel zone reflect to others far away, so that vertices displaced by "
        "{:.2g} mm would change {} by more than {:g} of the echo at {:.6g} GHz, most by {:.2g} at {}",
        part_names[sweep.uncertainty[moved.worst_view].displaced_part],
        1e3 * kVertexNoise * kSpeedOfLight / (1e9 * ghz), count_of(sweep, moved), kLargeShare, ghz, moved.worst,
        place_of(sweep, moved)));
  }
  const Exceeded cavity = exceeding(sweep, kLargeShare, [&](std::size_t view, std::size_t e) {
    return share(std::abs(sweep.uncertainty[view].in_cavity[e]), echo(sweep, view, e));
  });
  if (cavity.views > 0) {
    const std::string& name = part_names[sweep.uncertainty[cavity.worst_view].cavity_part];
    found.push_back(fmt::format(
        "part '{0}': {1} or more reflections by its own walls, within {2:g} wavelengths of each other, carry more than "
        "{3:g} of the echo of {4} at {5:.6g} GHz, most {6:.2g} at {7}: rays are doubtful in cavities; --cavity PART "
        "solves an open one that is a part of its own",
        name, kCavityReflections, kCavityWavelengths, kLargeShare, count_of(sweep, cavity), ghz, cavity.worst,
        place_of(sweep, cavity)));
  }
  if (sweep.transmitter) return found;
  const Exceeded reciprocal = exceeding(sweep, kLargeShare, [&](std::size_t view, std::size_t e) {
    return share(sweep.uncertainty[view].non_reciprocal, echo(sweep, view, e));
  });
  if (reciprocal.views > 0) {
    found.push_back(
        fmt::format("part '{}': hv and vh of {} differ by the order of the reflections; half of the difference is more "
                    "than {:g} of "
                    "hh or vv at {:.6g} GHz, most {:.2g} at {}: their mean is given",
                    part_names[sweep.uncertainty[reciprocal.worst_view].non_reciprocal_part],
                    count_of(sweep, reciprocal), kLargeShare, ghz, reciprocal.worst, place_of(sweep, reciprocal)));
  }
  return found;
}

std::string uncertainty_header() {
  return ",hh_flat_over_smooth_db,vv_flat_over_smooth_db,hh_vertex_change,vv_vertex_change";
}

std::string uncertainty_cells(const RcsSweep& sweep, std::size_t view, std::size_t frequency) {
  const auto& flat = sweep.flat->matrices[view][frequency];
  const auto& smooth = sweep.models.back().matrices[view][frequency];
  return fmt::format(",{:.4f},{:.4f},{:.4f},{:.4f}", ratio_db(flat[0], smooth[0]), ratio_db(flat[3], smooth[3]),
                     vertex_change(sweep, view, 0), vertex_change(sweep, view, 1));
}

namespace {

// Values of the sweep along its only axis with several values: views and frequencies, and x.
struct Cut {
  std::string label;
  std::vector<double> x;
  std::vector<std::pair<std::size_t, std::size_t>> places;  // view, frequency
};

std::optional<Cut> cut_of(const RcsSweep& sweep) {
  Cut cut;
  if (sweep.views() == 1) {
    cut.label = "frequency (GHz)";
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      cut.x.push_back(1e-9 * sweep.frequency_hz[q]);
      cut.places.emplace_back(0, q);
    }
  } else if (sweep.elevation_deg.size() == 1 || sweep.azimuth_deg.size() == 1) {
    const bool azimuth = sweep.elevation_deg.size() == 1;
    cut.label = azimuth ? "azimuth (deg)" : "elevation (deg)";
    cut.x = azimuth ? sweep.azimuth_deg : sweep.elevation_deg;
    for (std::size_t view = 0; view < sweep.views(); ++view) cut.places.emplace_back(view, sweep.estimated);
  }
  return cut.x.size() > 1 ? std::optional(cut) : std::nullopt;
}

LinePlot plot_of(const RcsSweep& sweep, const Cut& cut, std::size_t element) {
  Series line{sweep.models.back().name, cut.x, {}, {}, SeriesStyle::kLines}, band = line;
  band.name = "to flat facets";
  band.style = SeriesStyle::kBand;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& [view, q] : cut.places) {
    const double smooth = dbsm(sweep.models.back().matrices[view][q][kElement[element]]),
                 flat = dbsm(sweep.flat->matrices[view][q][kElement[element]]);
    line.y.push_back(smooth);
    band.interval.push_back({std::min(smooth, flat), std::max(smooth, flat)});
    low = std::min(low, band.interval.back()[0]);
    high = std::max(high, band.interval.back()[1]);
  }
  band.y = line.y;
  constexpr double kMargin_db = 3, kHighest_db = 60;
  LinePlot plot;
  plot.title = kName[element];
  if (sweep.views() > 1) plot.title += fmt::format(", {:g} GHz", 1e-9 * sweep.frequency_hz[sweep.estimated]);
  const auto [first, last] = std::ranges::minmax(cut.x);
  plot.x = {cut.label, AxisRange{first, last}, false};
  plot.y = {"radar cross section (dBsm)", AxisRange{std::max(low, high - kHighest_db) - kMargin_db, high + kMargin_db},
            false};
  plot.legend_above = true;
  plot.series = {std::move(line), std::move(band)};
  return plot;
}

}  // namespace

bool draw_uncertainty(const RcsSweep& sweep, const std::string& title, const std::filesystem::path& file) {
  const std::optional<Cut> cut = cut_of(sweep);
  if (!cut) return false;
  write_figure(title, std::array{plot_of(sweep, *cut, 0), plot_of(sweep, *cut, 1)}, 2, file, {1500, 480});
  return true;
}

}  // namespace seaglint
