// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/residual_echo.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// Largest phase at the chirp's edge, rad, for which moments up to the third suffice (error 0.2^4/24 = 7e-5); a fit that
// moves further recomputes them at its new position.
constexpr double kMomentReach = 0.2;
constexpr int kMaxPasses = 4;
// Ratio of the curvatures of ln |RV| along the two axes below which the echo has no resolution along the flatter one.
constexpr double kFlat = 1e-9;

// Phase factors e^{j phase(b)} of one pulse, phase = 4 pi [f v (t + f_b/mu) + (f - f_c) r] / c, quadratic in b: each
// factor is the previous one times a ratio, and the ratio changes by a constant factor (1 without motion during the
// pulse).
struct PulsePhasor {
  Complex value, ratio, ratio_step;
  bool is_quadratic;

  PulsePhasor(const PulseTrain& train, std::size_t pulse, double range_m, double velocity_mps,
              bool intra_pulse_motion) {
    const double slope = intra_pulse_motion ? velocity_mps / train.chirp_rate_hz_s : 0;  // metres per hertz
    const double lowest = train.baseband_hz.front(), step = train.baseband_step_hz;
    const auto phase = [&](double b) {
      const double baseband = lowest + b * step;
      const double f = train.carrier_hz[pulse] + baseband;
      return 4 * kPi / kSpeedOfLight *
             (f * (velocity_mps * train.time_s[pulse] + slope * baseband) + (f - train.band_centre_hz()) * range_m);
    };
    value = std::polar(1.0, phase(0));
    ratio = std::polar(1.0, phase(1) - phase(0));
    is_quadratic = intra_pulse_motion;
    ratio_step = std::polar(1.0, 8 * kPi / kSpeedOfLight * slope * step * step);
  }

  void next() {
    value *= ratio;
    if (is_quadratic) ratio *= ratio_step;
  }
};

// Value and derivatives of RV at an offset from the position of the moments.
struct Taylor {
  Complex rv, r, v, rr, rv_mixed, vv;
};

}  // namespace

ResidualEcho::ResidualEcho(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec,
                           bool intra_pulse_motion)
    : train_(train),
      spec_(spec),
      intra_pulse_motion_(intra_pulse_motion),
      echo_(echo.begin(), echo.end()),
      weight_(echo.size()) {
  const MapWeights weights = map_weights(train, spec);
  const std::vector<Complex> filter = compression_filter(train, spec.compression);
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      const std::size_t k = static_cast<std::size_t>(train.code[n]) * train.bins_per_hop + b;
      weight_[n * train.frequencies() + b] = weights.pulse[n] * weights.bin[k] * filter[b];
    }
  }
}

RvMap ResidualEcho::map(const StopFlag* stop) const {
  return form_rv_map(echo_, train_, spec_, intra_pulse_motion_, stop);
}

Complex ResidualEcho::value(double range_m, double velocity_mps) const {
  Complex sum;
  for (const PulseMoments& m : moments(range_m, velocity_mps)) sum += m.m0;
  return sum;
}

std::vector<ResidualEcho::PulseMoments> ResidualEcho::moments(double range_m, double velocity_mps) const {
  const std::size_t frequencies = train_.frequencies();
  std::vector<PulseMoments> all(train_.pulses());
  for (std::size_t n = 0; n < all.size(); ++n) {
    PulsePhasor phasor(train_, n, range_m, velocity_mps, intra_pulse_motion_);
    PulseMoments m;
    for (std::size_t b = 0; b < frequencies; ++b, phasor.next()) {
      const std::size_t i = n * frequencies + b;
      const double wavenumber = 4 * kPi / kSpeedOfLight * train_.baseband_hz[b];
      const Complex x = weight_[i] * echo_[i] * phasor.value;
      const Complex kx = wavenumber * x, kkx = wavenumber * kx;
      m.m0 += x;
      m.m1 += kx;
      m.m2 += kkx;
      m.m3 += wavenumber * kkx;
    }
    all[n] = m;
  }
  return all;
}

CleanComponent ResidualEcho::fit(double range_m, double velocity_mps, double reach_r, double reach_v) const {
  CleanComponent point{range_m, velocity_mps, {}};
  const double edge = 4 * kPi / kSpeedOfLight * std::abs(train_.baseband_hz.front());
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const std::vector<PulseMoments> all = moments(point.range_m, point.velocity_mps);
    const auto expand = [&](double dr, double dv) {
      Taylor s;
      for (std::size_t n = 0; n < all.size(); ++n) {
        const double t = train_.time_s[n], f = train_.carrier_hz[n];
        const double kr = 4 * kPi / kSpeedOfLight * (f - train_.band_centre_hz()), kv = 4 * kPi / kSpeedOfLight * f * t;
        const Complex phasor = std::polar(1.0, kr * dr + kv * dv);
        const double y = dr + dv * t;
        const Complex z2 = phasor * (all[n].m2 + Complex(0, y) * all[n].m3);
        const Complex z1 = phasor * (all[n].m1 + Complex(0, y) * all[n].m2 - 0.5 * y * y * all[n].m3);
        const Complex z0 = phasor * (all[n].m0 + Complex(0, y) * all[n].m1 - 0.5 * y * y * all[n].m2 -
                                     Complex(0, y * y * y / 6) * all[n].m3);
        // d/dr gives a factor j (kr + k_b), d/dv a factor j (kv + k_b t), k_b the baseband wavenumber of the moments.
        s.rv += z0;
        s.r += kr * z0 + z1;
        s.v += kv * z0 + t * z1;
        s.rr += kr * kr * z0 + 2 * kr * z1 + z2;
        s.rv_mixed += kr * kv * z0 + (kv + kr * t) * z1 + t * z2;
        s.vv += kv * kv * z0 + 2 * kv * t * z1 + t * t * z2;
      }
      const Complex j(0, 1);
      return Taylor{s.rv, j * s.r, j * s.v, -s.rr, -s.rv_mixed, -s.vv};
    };

    // Newton's method on ln |RV|, which is concave in the main lobe; steps that do not increase it are halved.
    double dr = 0, dv = 0;
    Taylor here = expand(0, 0);
    for (int i = 0; i < 8 && std::abs(here.rv) > 0; ++i) {
      const double gr = std::real(here.r / here.rv), gv = std::real(here.v / here.rv);
      const double hrr = std::real(here.rr / here.rv - here.r * here.r / (here.rv * here.rv));
      const double hvv = std::real(here.vv / here.rv - here.v * here.v / (here.rv * here.rv));
      const double hrv = std::real(here.rv_mixed / here.rv - here.r * here.v / (here.rv * here.rv));
      // One pulse has no velocity resolution, one frequency no range resolution: then only the other is fitted.
      const double bend_r = -hrr * reach_r * reach_r, bend_v = -hvv * reach_v * reach_v;
      double step_r = 0, step_v = 0;
      if (bend_r > 0 && std::abs(bend_v) < kFlat * bend_r) {
        step_r = -gr / hrr;
      } else if (bend_v > 0 && std::abs(bend_r) < kFlat * bend_v) {
        step_v = -gv / hvv;
      } else {
        const double determinant = hrr * hvv - hrv * hrv;
        if (!(hrr < 0 && determinant > 0)) break;
        step_r = -(hvv * gr - hrv * gv) / determinant;
        step_v = -(hrr * gv - hrv * gr) / determinant;
      }
      // The iteration ends with a step below a hundredth of the reach: the remaining error of Newton's method is its
      // square.
      const bool last = std::abs(step_r) < 1e-2 * reach_r && std::abs(step_v) < 1e-2 * reach_v;
      bool climbed = false;
      for (int half = 0; half < (last ? 1 : 4) && !climbed; ++half, step_r *= 0.5, step_v *= 0.5) {
        const double to_r =
            std::clamp(point.range_m + dr + step_r, range_m - reach_r, range_m + reach_r) - point.range_m;
        const double to_v =
            std::clamp(point.velocity_mps + dv + step_v, velocity_mps - reach_v, velocity_mps + reach_v) -
            point.velocity_mps;
        const Taylor there = expand(to_r, to_v);
        if (std::abs(there.rv) <= std::abs(here.rv)) continue;
        climbed = true;
        dr = to_r;
        dv = to_v;
        here = there;
      }
      if (last || !climbed) break;
    }
    point = {point.range_m + dr, point.velocity_mps + dv, here.rv};
    if (edge * (std::abs(dr) + std::abs(dv) * train_.time_s.back()) < kMomentReach) break;
  }
  return point;
}

void ResidualEcho::subtract(const CleanComponent& point) {
  const std::size_t frequencies = train_.frequencies();
  std::vector<Complex> scaled(frequencies);
  for (std::size_t b = 0; b < frequencies; ++b) scaled[b] = point.amplitude_m * train_.chirp_spectrum[b];
  for (std::size_t n = 0; n < train_.pulses(); ++n) {
    PulsePhasor phasor(train_, n, point.range_m, point.velocity_mps, intra_pulse_motion_);
    for (std::size_t b = 0; b < frequencies; ++b, phasor.next()) {
      echo_[n * frequencies + b] -= scaled[b] * std::conj(phasor.value);
    }
  }
}

namespace {

// A target may occupy three quarters of a row (144 m of 192 m), a column rarely to a half.
constexpr double kRowQuantile = 0.2;
constexpr double kColumnQuantile = 0.5;
constexpr double kMapQuantile = 0.5;
constexpr double kFalseMaps = 0.01;
// A maximum is the highest of all positions inside its cell: four times as many independent trials.
constexpr double kPositionsPerCell = 4;

// Mean of an exponential distribution from its quantile.
double mean_from_quantile(std::vector<double> powers, double quantile) {
  const auto at = powers.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(powers.size()));
  std::nth_element(powers.begin(), at, powers.end());
  return *at / -std::log(1 - quantile);
}

}  // namespace

std::vector<double> residual_floor(const RvMap& residual) {
  const std::size_t rows = residual.velocity_mps.size(), columns = residual.columns();
  std::vector<double> powers(rows * columns);
  for (std::size_t i = 0; i < powers.size(); ++i) powers[i] = std::norm(residual.values[i]);

  const double all = mean_from_quantile(powers, kMapQuantile);
  std::vector<double> row(rows, 0), column(columns, 0), line;
  for (std::size_t v = 0; v < rows && columns >= kMinCells; ++v) {
    line.assign(&powers[v * columns], &powers[v * columns] + columns);
    row[v] = mean_from_quantile(line, kRowQuantile);
  }
  for (std::size_t r = 0; r < columns && rows >= kMinCells; ++r) {
    line.clear();
    for (std::size_t v = 0; v < rows; ++v) line.push_back(powers[v * columns + r]);
    column[r] = mean_from_quantile(line, kColumnQuantile);
  }
  std::vector<double> floor(powers.size());
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t r = 0; r < columns; ++r) {
      floor[v * columns + r] = std::max({all, column[r], row[v], column[r] + row[v] - all});
    }
  }
  return floor;
}

double threshold_factor(double cells) { return std::log(std::max(1.0, cells) * kPositionsPerCell / kFalseMaps); }

namespace {

// Half widths of the surroundings, in resolution cells: along velocity the change of a ridge's velocity over these
// ranges in waves of 4 m, along range the correlation length of texture. The optimum is flat between 4 and 7 velocities
// and 5 and 9 ranges; with 3 velocities seven of 100 maps of these waves contain a false centre instead of one.
constexpr double kHalfVelocities = 5;
constexpr double kHalfRanges = 5;
// Points whose power is this many times the rest explain their surroundings; the strongest is excluded, since it would
// protect clutter around it. With 2, twelve of 100 maps of shape 0.5 contain a false centre instead of one; with 4,
// ships lose 1.2 times as many centres 20 dB above clutter, without this rule five times as many.
constexpr double kPointsOverRest = 3;
// Quantiles over the ranges of the swath. With 20 and 50 %, ships that fill half of the ranges or more lose 1.4 times
// as many centres 20 dB above clutter.
constexpr double kLowQuantile = 0.1;
constexpr double kQuantile = 0.3;
// Exponent that extrapolates the two quantiles to 90 % of a log-normal distribution, (z90 - z30) / (z30 - z10) with
// standard normal deviates z. To 80 %, seven of 100 maps of shape 0.5 contain a false centre instead of one; to 95 %,
// ships lose 1.1 times as many centres 20 dB above clutter, without the swath's level three times near broadside.
constexpr double kExtrapolation = (1.2816 + 0.5244) / (1.2816 - 0.5244);
// Texture shape of sea clutter at a resolution of metres (the default of `texture: independent`).
constexpr double kTextureShape = 2;

struct Cell {
  long v, r;
};

Cell cell_of(const CleanComponent& point, const RvMap& map, const CellSizes& cells) {
  const auto index = [](const std::vector<double>& axis, double value, double step) {
    return std::clamp(std::lround((value - axis.front()) / step), 0L, static_cast<long>(axis.size()) - 1);
  };
  return {index(map.velocity_mps, point.velocity_mps, cells.velocity_mps / cells.velocity_oversampling),
          index(map.range_m, point.range_m, cells.range_m / cells.range_oversampling)};
}

// Rectangle of cells around one, limited to the map; the ends are excluded.
struct Window {
  std::size_t first_v, end_v, first_r, end_r;
};

Window window(const RvMap& map, Cell at, const CellSizes& cells) {
  const long reach_v = std::lround(kHalfVelocities * cells.velocity_oversampling),
             reach_r = std::lround(kHalfRanges * cells.range_oversampling);
  const auto first = [](long centre, long reach) { return static_cast<std::size_t>(std::max(0L, centre - reach)); };
  const auto end = [](long centre, long reach, std::size_t count) {
    return std::min(static_cast<std::size_t>(centre + reach + 1), count);
  };
  return {first(at.v, reach_v), end(at.v, reach_v, map.velocity_mps.size()), first(at.r, reach_r),
          end(at.r, reach_r, map.columns())};
}

// Mean of the largest of n exponentially distributed values of mean 1: 1 + 1/2 + ... + 1/n.
double mean_of_largest(long n) {
  double sum = 0;
  for (long k = 1; k <= n; ++k) sum += 1 / static_cast<double>(k);
  return sum;
}

// Mean power of the ridge that passes through a window: the largest power over velocity at each range, averaged over
// range, relative to its expectation in exponential clutter. The mean of the window itself would include the cells
// beside a narrow or sloping ridge.
double ridge_level(const std::vector<double>& power, std::size_t columns, const Window& in, const CellSizes& cells) {
  double sum = 0;
  for (std::size_t r = in.first_r; r < in.end_r; ++r) {
    double largest = 0;
    for (std::size_t v = in.first_v; v < in.end_v; ++v) largest = std::max(largest, power[v * columns + r]);
    sum += largest;
  }
  const double velocities = static_cast<double>(in.end_v - in.first_v) / cells.velocity_oversampling;
  return sum / static_cast<double>(in.end_r - in.first_r) / mean_of_largest(std::max(1L, std::lround(velocities)));
}

double total_power(const std::vector<double>& power, std::size_t columns, const Window& in) {
  double sum = 0;
  for (std::size_t v = in.first_v; v < in.end_v; ++v) {
    for (std::size_t r = in.first_r; r < in.end_r; ++r) sum += power[v * columns + r];
  }
  return sum;
}

// Level that the ridge exceeds at one range in ten, whatever its velocity there: extrapolated from the 10 % and 30 %
// quantiles over range as of a log-normal distribution, so that a target's own ranges count little. Infinite when
// they are zero.
double swath_level(const std::vector<double>& power, const RvMap& map, const CellSizes& cells) {
  const std::size_t columns = map.columns(), rows = map.velocity_mps.size();
  std::vector<double> largest(columns, 0);
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t r = 0; r < columns; ++r) largest[r] = std::max(largest[r], power[v * columns + r]);
  }
  const long reach = std::lround(kHalfRanges * cells.range_oversampling);
  std::vector<double> levels;
  for (long r = 0; r < static_cast<long>(columns); ++r) {
    const auto first = static_cast<std::size_t>(std::max(0L, r - reach)),
               end = std::min(static_cast<std::size_t>(r + reach + 1), columns);
    double sum = 0;
    for (std::size_t i = first; i < end; ++i) sum += largest[i];
    levels.push_back(sum / static_cast<double>(end - first) / mean_of_largest(2 * std::lround(kHalfVelocities) + 1));
  }
  std::sort(levels.begin(), levels.end());
  const auto quantile = [&](double q) { return levels[static_cast<std::size_t>(q * static_cast<double>(columns))]; };
  const double low = quantile(kLowQuantile), middle = quantile(kQuantile);
  if (!(low > 0)) return std::numeric_limits<double>::infinity();
  return middle * std::pow(middle / low, kExtrapolation);
}

bool near(const CleanComponent& a, const CleanComponent& b, const CellSizes& cells) {
  return std::abs(a.velocity_mps - b.velocity_mps) < (kHalfVelocities + 0.5) * cells.velocity_mps &&
         std::abs(a.range_m - b.range_m) < (kHalfRanges + 0.5) * cells.range_m;
}

// ln of the probability that an intensity of mean 1 exceeds x, K-distributed with this shape: the mean of e^{-x/t} over
// a gamma distributed texture t (Ward, Tough and Watts, "Sea Clutter", 2nd ed. 2013, section 4.6),
// integral of nu^nu t^{nu-1} e^{-nu t - x/t} / Gamma(nu) dt; t = e^s, by the trapezoidal rule, whose error falls
// exponentially here.
double log_exceedance(double x, double shape) {
  constexpr double kStep = 0.1;
  double sum = 0;
  for (int i = -60; i <= 50; ++i) {
    const double s = kStep * i;
    sum += std::exp(shape * s - shape * std::exp(s) - x * std::exp(-s));
  }
  int sign = 1;  // std::lgamma would write it to a global, from several threads
  return shape * std::log(shape) - ::lgamma_r(shape, &sign) + std::log(kStep * sum);
}

}  // namespace

double texture_threshold_margin(double shape, double factor) {
  double below = factor, above = 30 * factor;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (below + above);
    (log_exceedance(middle, shape) > -factor ? below : above) = middle;
  }
  return below / factor;
}

// Censored averaging: accepted targets are excluded from the local level of the others, rejected ones are included
// (Barkat, Himonas and Varshney, "CFAR detection for multiple target situations", IEE Proc. F 136 (1989) 193, who
// censor cells in the order of their power; here points in the order of theirs). The smaller of a near and a far level
// is that of Trunk, "Range resolution of targets using automatic detectors", IEEE Trans. Aerosp. Electron. Syst. 14
// (1978) 750, the far one an ordered statistic (Rohling, the same journal 19 (1983) 608).
std::vector<bool> exceeds_local_level(std::span<const CleanComponent> points, const RvMap& residual,
                                      const std::vector<double>& floor, double factor, double min_power,
                                      const CellSizes& cells) {
  const double margin = texture_threshold_margin(kTextureShape, factor);
  const std::size_t columns = residual.columns();
  const bool has_surroundings = residual.velocity_mps.size() >= kMinCells && columns >= kMinCells;
  std::vector<double> power(residual.values.size());
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = std::norm(residual.values[i]);

  // A point's power along range, and in all cells of the map.
  const double along_range = cells.lobe_ranges * cells.range_oversampling;
  const double lobe = along_range * cells.lobe_velocities * cells.velocity_oversampling;
  std::vector<double> squared, unexplained;
  std::vector<std::size_t> cell;
  std::vector<Window> around;
  for (const CleanComponent& point : points) {
    const Cell at = cell_of(point, residual, cells);
    squared.push_back(std::norm(point.amplitude_m));
    cell.push_back(static_cast<std::size_t>(at.v) * columns + static_cast<std::size_t>(at.r));
    around.push_back(window(residual, at, cells));
    unexplained.push_back(total_power(power, columns, around.back()));
  }
  double swath = std::numeric_limits<double>::infinity();
  if (has_surroundings) {
    std::vector<double> with_points = power;
    for (std::size_t i = 0; i < points.size(); ++i) with_points[cell[i]] += along_range * squared[i];
    swath = swath_level(with_points, residual, cells);
  }

  std::vector<bool> stays(points.size(), true);
  const auto level = [&](std::size_t i) {
    const double global = floor[cell[i]];
    if (!has_surroundings || squared[i] >= factor * margin * swath) return global;
    double explained = 0, strongest = 0, rest = unexplained[i];
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!near(points[k], points[i], cells)) continue;
      (stays[k] ? explained : rest) += lobe * squared[k];
      if (stays[k]) strongest = std::max(strongest, lobe * squared[k]);
    }
    if (explained - strongest > kPointsOverRest * rest) return global;
    return std::max(global, margin * ridge_level(power, columns, around[i], cells));
  };

  // Weakest first, since its rejection raises the local level of its neighbours; until all remaining points are
  // accepted.
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return squared[a] < squared[b]; });
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::size_t i : order) {
      if (!stays[i] || (squared[i] >= min_power && squared[i] >= factor * level(i))) continue;
      stays[i] = false;
      power[cell[i]] += along_range * squared[i];
      changed = true;
    }
  }
  return stays;
}

}  // namespace seaglint
