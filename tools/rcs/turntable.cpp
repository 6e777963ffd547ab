// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/turntable.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "radar/rvmap/rv_map.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {

namespace {

double even_step(std::span<const double> values) {
  return (values.back() - values.front()) / static_cast<double>(values.size() - 1);
}

// Taylor's weights times a factor of each, with sum 1.
std::vector<double> weights_of(std::span<const double> factors) {
  std::vector<double> weights = taper_samples(Taper::kTaylor, factors.size());
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] *= factors[i];
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Range profiles about a wavenumber k of the band: P(R) e^{-j 2k R} = sum over f of w_f S(f) e^{+j 2 (k_f - k) R}, with
// the period c / (2 step); value m of a row is at R = m period / length.
class BasebandProfiles {
 public:
  BasebandProfiles(const TurntableEcho& echo, std::size_t per_cell, std::size_t most_rows)
      : echo_(echo),
        weights_(weights_of(echo.frequency_hz)),
        rows_(std::bit_ceil(per_cell * echo.frequency_hz.size()), most_rows, Fourier::kInverse),
        middle_(echo.frequency_hz.size() / 2),
        period_m_(kSpeedOfLight / (2 * even_step(echo.frequency_hz))),
        wavenumber_(2 * kPi *
                    (echo.frequency_hz.front() + static_cast<double>(middle_) * even_step(echo.frequency_hz)) /
                    kSpeedOfLight) {}

  // Rows 0 to count - 1 become the profiles of the azimuths from `first` on.
  void compress(std::size_t first, std::size_t count) {
    const std::size_t n = echo_.frequency_hz.size(), length = rows_.length();
    for (std::size_t row = 0; row < count; ++row) {
      Complex* values = rows_.row(row);
      std::fill(values, values + length, Complex(0));
      // Frequencies below the middle are negative ones, at the end of the row.
      for (std::size_t i = 0; i < n; ++i)
        values[(i + length - middle_) % length] = weights_[i] * echo_.amplitude_m[(first + row) * n + i];
    }
    rows_.execute();
  }

  const Complex* row(std::size_t i) const { return rows_.row(i); }
  std::size_t length() const { return rows_.length(); }
  double period_m() const { return period_m_; }
  double wavenumber() const { return wavenumber_; }

 private:
  const TurntableEcho& echo_;
  std::vector<double> weights_;
  FourierBatch rows_;
  std::size_t middle_;
  double period_m_, wavenumber_;
};

std::vector<double> cell_centres(const Interval& span, double resolution_m) {
  constexpr double kPerCell = 3, kMost = 800, kLeast = 240;
  const double count = std::clamp(std::ceil(span.size() / resolution_m * kPerCell), kLeast, kMost);
  std::vector<double> centres;
  for (double i = 0.5; i < count; ++i) centres.push_back(span.low + span.size() * i / count);
  return centres;
}

void require_turntable(const TurntableEcho& echo) {
  const std::size_t frequencies = echo.frequency_hz.size(), azimuths = echo.azimuth_deg.size();
  SEAGLINT_CHECK(
      frequencies >= kFewestOfTurntable && azimuths >= kFewestOfTurntable &&
          echo.amplitude_m.size() == frequencies * azimuths,
      fmt::format("{} amplitudes of {} frequencies and {} azimuths", echo.amplitude_m.size(), frequencies, azimuths));
}

}  // namespace

TurntableAxes::TurntableAxes(double middle_azimuth_deg, double elevation_deg) {
  const RadarBasis basis = radar_basis(direction_to_radar(radians(middle_azimuth_deg), radians(elevation_deg)));
  range = -basis.r;
  cross = -basis.h;
}

TurntableSampling turntable_sampling(std::span<const double> frequency_hz, std::span<const double> azimuth_deg,
                                     double elevation_deg) {
  const double step_hz = even_step(frequency_hz), step_rad = radians(even_step(azimuth_deg)),
               sector_rad = step_rad * static_cast<double>(azimuth_deg.size()),
               flattened = std::cos(radians(elevation_deg));
  TurntableSampling sampling;
  sampling.middle_azimuth_deg = 0.5 * (azimuth_deg.front() + azimuth_deg.back());
  sampling.wavelength_m = 2 * kSpeedOfLight / (frequency_hz.front() + frequency_hz.back());
  sampling.range_window_m = kSpeedOfLight / (2 * step_hz);
  sampling.range_cell_m = sampling.range_window_m / static_cast<double>(frequency_hz.size());
  sampling.cross_window_m = kSpeedOfLight / (2 * frequency_hz.back() * step_rad * flattened);
  sampling.cross_cell_m = sampling.wavelength_m / (4 * std::sin(0.5 * std::min(sector_rad, kPi)) * flattened);
  return sampling;
}

TurntableExtent turntable_extent(const TriangleMesh& mesh, std::span<const double> azimuth_deg, double elevation_deg) {
  constexpr std::size_t kDirections = 33;
  const auto span_along = [&](const Vec3& axis) {
    Interval span{1e300, -1e300};
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t v : triangle) {
        const double at = axis.dot(mesh.vertices[v]);
        span = {std::min(span.low, at), std::max(span.high, at)};
      }
    }
    return span;
  };
  const TurntableAxes middle(0.5 * (azimuth_deg.front() + azimuth_deg.back()), elevation_deg);
  TurntableExtent extent{span_along(middle.range), span_along(middle.cross), {1e300, -1e300}};
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double fraction = static_cast<double>(i) / (kDirections - 1);
    const TurntableAxes axes(azimuth_deg.front() + fraction * (azimuth_deg.back() - azimuth_deg.front()),
                             elevation_deg);
    const Interval ranges = span_along(axes.range);
    extent.all_ranges = {std::min(extent.all_ranges.low, ranges.low), std::max(extent.all_ranges.high, ranges.high)};
    extent.longest_range_m = std::max(extent.longest_range_m, ranges.size());
    extent.longest_cross_m = std::max(extent.longest_cross_m, span_along(axes.cross).size());
  }
  return extent;
}

namespace {

Interval about(double middle, double size) { return {middle - 0.5 * size, middle + 0.5 * size}; }

// Size with a margin.
double widened(const Interval& span, double cell_m) {
  constexpr double kMargin = 0.06, kMarginCells = 4;
  return span.size() + 2 * std::max(kMarginCells * cell_m, kMargin * span.size());
}

}  // namespace

Interval profiles_range(const TurntableSampling& sampling, const TurntableExtent* extent) {
  if (extent == nullptr) return about(0, sampling.range_window_m);
  const Interval& all = extent->all_ranges;
  return about(0.5 * (all.low + all.high), std::min(widened(all, sampling.range_cell_m), sampling.range_window_m));
}

TurntableArea turntable_area(const TurntableSampling& sampling, const TurntableExtent* extent) {
  constexpr double kNarrowest = 0.35;  // of the longer side: a thin target has some of its surroundings
  if (extent == nullptr) return {about(0, sampling.range_window_m), about(0, sampling.cross_window_m)};
  const double range = widened(extent->range, sampling.range_cell_m),
               cross = widened(extent->cross, sampling.cross_cell_m), least = kNarrowest * std::max(range, cross);
  const auto part = [&](const Interval& span, double size, double window) {
    return about(0.5 * (span.low + span.high), std::min(std::max(size, least), window));
  };
  return {part(extent->range, range, sampling.range_window_m), part(extent->cross, cross, sampling.cross_window_m)};
}

TurntableImage turntable_image(const TurntableEcho& echo, const TurntableArea& area, int threads) {
  constexpr std::size_t kPerCell = 32, kAtOnce = 64;
  require_turntable(echo);
  const TurntableSampling sampling = turntable_sampling(echo.frequency_hz, echo.azimuth_deg, echo.elevation_deg);
  const std::size_t azimuths = echo.azimuth_deg.size();
  const std::vector<double> weights = weights_of(std::vector<double>(azimuths, 1.0));
  TurntableImage image{
      cell_centres(area.range, sampling.range_cell_m), cell_centres(area.cross, sampling.cross_cell_m), {}};
  const std::size_t columns = image.range_m.size(), rows = image.cross_m.size();
  std::vector<Complex> sums(columns * rows);
  BasebandProfiles profiles(echo, kPerCell, std::min(kAtOnce, azimuths));
  const std::size_t length = profiles.length();
  const double per_m = static_cast<double>(length) / profiles.period_m(),
               flattened = std::cos(radians(echo.elevation_deg));

  for (std::size_t first = 0; first < azimuths; first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, azimuths - first);
    profiles.compress(first, count);
    parallel_for(rows, thread_count(threads), [&](std::size_t j) {
      for (std::size_t a = 0; a < count; ++a) {
        const double delta = radians(echo.azimuth_deg[first + a] - sampling.middle_azimuth_deg);
        const Complex* profile = profiles.row(a);
        // Range of the row's points at this azimuth: equal steps.
        const double start_m = std::cos(delta) * image.range_m[0] + std::sin(delta) * flattened * image.cross_m[j],
                     step_m = std::cos(delta) * (image.range_m[1] - image.range_m[0]);
        Complex phase = std::polar(weights[first + a], 2 * profiles.wavenumber() * start_m);
        const Complex turn = std::polar(1.0, 2 * profiles.wavenumber() * step_m);
        for (std::size_t i = 0; i < columns; ++i) {
          const double at = per_m * (start_m + static_cast<double>(i) * step_m), below = std::floor(at);
          const std::size_t m = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(below)) & (length - 1);
          const Complex value = profile[m] + (at - below) * (profile[(m + 1) & (length - 1)] - profile[m]);
          sums[j * columns + i] += value * phase;
          phase *= turn;
        }
      }
    });
  }
  for (const Complex& sum : sums) image.level_dbsm.push_back(dbsm(sum));
  return image;
}

TurntableProfiles turntable_profiles(const TurntableEcho& echo, const Interval& range) {
  constexpr std::size_t kLeast = 4, kMost = 16, kWanted = 512;  // values per resolution cell; in all
  require_turntable(echo);
  BasebandProfiles profiles(echo, std::clamp(kWanted / echo.frequency_hz.size(), kLeast, kMost), 1);
  const double cell_m = profiles.period_m() / static_cast<double>(profiles.length());
  const auto first = static_cast<std::ptrdiff_t>(std::ceil(range.low / cell_m)),
             last = static_cast<std::ptrdiff_t>(std::floor(range.high / cell_m));
  TurntableProfiles made;
  for (std::ptrdiff_t m = first; m <= last; ++m) made.range_m.push_back(cell_m * static_cast<double>(m));
  for (std::size_t a = 0; a < echo.azimuth_deg.size(); ++a) {
    profiles.compress(a, 1);
    for (std::ptrdiff_t m = first; m <= last; ++m)
      made.level_dbsm.push_back(dbsm(profiles.row(0)[static_cast<std::size_t>(m) & (profiles.length() - 1)]));
  }
  return made;
}

}  // namespace seaglint
