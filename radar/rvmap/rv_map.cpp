// SPDX-License-Identifier: BSD-3-Clause
#include "radar/rvmap/rv_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"

namespace seaglint {
namespace {

constexpr int kTaylorTerms = 4;  // nbar
constexpr double kTaylorSidelobeDb = 35;

// Taylor, "Design of line-source antennas for narrow beamwidth and low side lobes", IRE Trans. AP-3 (1955) 16;
// coefficients as in Carrara, Goodman and Majewski, "Spotlight Synthetic Aperture Radar" (1995), appendix D.2.
double taylor(double u) {
  const double a = std::acosh(std::pow(10, kTaylorSidelobeDb / 20)) / kPi;
  const double s2 = kTaylorTerms * kTaylorTerms / (a * a + (kTaylorTerms - 0.5) * (kTaylorTerms - 0.5));
  const auto value = [&](double x) {
    double sum = 1;
    for (int m = 1; m < kTaylorTerms; ++m) {
      double numerator = 1, denominator = 1;
      for (int i = 1; i < kTaylorTerms; ++i) {
        numerator *= 1 - m * m / (s2 * (a * a + (i - 0.5) * (i - 0.5)));
        if (i != m) denominator *= 1 - static_cast<double>(m * m) / (i * i);
      }
      const double coefficient = (m % 2 == 1 ? 1 : -1) * numerator / (2 * denominator);
      sum += 2 * coefficient * std::cos(2 * kPi * m * x);
    }
    return sum;
  };
  return value(u) / value(0);
}

// Weight at u in (-1/2, 1/2). Hann and Hamming: Harris, "On the use of windows", Proc. IEEE 66 (1978), eq. 26b and 30b.
double taper_at(Taper taper, double u) {
  switch (taper) {
    case Taper::kNone: return 1;
    case Taper::kHann: return 0.5 + 0.5 * std::cos(2 * kPi * u);
    case Taper::kHamming: return 0.54 + 0.46 * std::cos(2 * kPi * u);
    case Taper::kTaylor: return taylor(u);
  }
  return 1;
}

}  // namespace

std::vector<double> taper_samples(Taper taper, std::size_t count) {
  std::vector<double> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples[i] = taper_at(taper, (static_cast<double>(i) + 0.5) / static_cast<double>(count) - 0.5);
  }
  return samples;
}

MapWeights map_weights(const PulseTrain& train, const MapSpec& spec) {
  MapWeights weights;
  weights.pulse = taper_samples(spec.velocity_taper, train.pulses());
  std::vector<double> sum(train.carriers);
  for (std::size_t n = 0; n < train.pulses(); ++n) sum[train.code[n]] += weights.pulse[n];
  for (std::size_t n = 0; n < train.pulses(); ++n) weights.pulse[n] /= sum[train.code[n]];

  std::vector<int> covering(train.band_bins());
  for (int i = 0; i < train.carriers; ++i) {
    if (sum[i] == 0) {
      ++weights.unused_carriers;
      continue;
    }
    for (std::size_t b = 0; b < train.frequencies(); ++b) ++covering[i * train.bins_per_hop + b];
  }
  weights.bin = taper_samples(spec.range_taper, covering.size());
  for (std::size_t k = 0; k < covering.size(); ++k) weights.bin[k] *= covering[k] > 0 ? 1.0 / covering[k] : 0;
  // Response of a point of amplitude 1: |P|^2 / mean |P|^2 after a matched filter, 1 after an inverse filter.
  const std::vector<Complex> filter = compression_filter(train, spec.compression);
  double total = 0;
  for (int i = 0; i < train.carriers; ++i) {
    if (sum[i] == 0) continue;
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      total += weights.bin[i * train.bins_per_hop + b] * std::real(filter[b] * train.chirp_spectrum[b]);
    }
  }
  for (double& weight : weights.bin) weight /= total;
  return weights;
}

std::vector<Complex> compression_filter(const PulseTrain& train, Compression compression) {
  double mean = 0;
  for (const Complex& p : train.chirp_spectrum) mean += std::norm(p) / static_cast<double>(train.frequencies());
  std::vector<Complex> filter(train.frequencies());
  for (std::size_t b = 0; b < filter.size(); ++b) {
    const Complex p = train.chirp_spectrum[b];
    if (compression == Compression::kMatched) {
      filter[b] = std::conj(p) / mean;
    } else if (std::norm(p) > 1e-9 * mean) {
      filter[b] = std::conj(p) / std::norm(p);
    }
  }
  return filter;
}

std::vector<Complex> compress_pulses(std::span<const Complex> echo, const PulseTrain& train, Compression compression) {
  const std::size_t frequencies = train.frequencies();
  SEAGLINT_CHECK(
      echo.size() == train.pulses() * frequencies,
      fmt::format("echo of {} values for {} pulses x {} frequencies", echo.size(), train.pulses(), frequencies));
  const std::vector<Complex> filter = compression_filter(train, compression);
  std::vector<Complex> compressed(echo.size());
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t b = 0; b < frequencies; ++b) {
      compressed[n * frequencies + b] = filter[b] * echo[n * frequencies + b];
    }
  }
  return compressed;
}

namespace {

constexpr double kMaxCells = 1 << 26;

// Velocities summed together, so that their phase factors and the sums of one carrier fit into the first-level cache.
// Run time is flat from 16 to 64.
constexpr std::size_t kBlock = 32;

// Complex numbers of one block of velocities, real and imaginary parts separate for vectorisation.
struct Block {
  alignas(64) std::array<double, kBlock> re{};
  alignas(64) std::array<double, kBlock> im{};

  void rotate(const Block& factor) {
    for (std::size_t l = 0; l < kBlock; ++l) {
      const double real = re[l] * factor.re[l] - im[l] * factor.im[l];
      im[l] = re[l] * factor.im[l] + im[l] * factor.re[l];
      re[l] = real;
    }
  }
};

// e^{j (phase + l step)}, l = 0..kBlock-1
Block phase_ramp(double phase, double step) {
  Block block;
  Complex value = std::polar(1.0, phase);
  const Complex ratio = std::polar(1.0, step);
  for (std::size_t l = 0; l < kBlock; ++l) {
    block.re[l] = value.real();
    block.im[l] = value.imag();
    value *= ratio;
  }
  return block;
}

// (i - floor(cells/2)) step, i = 0..cells-1; a whole number of cells
std::vector<double> centred_axis(double cells, double step) {
  std::vector<double> axis(static_cast<std::size_t>(cells));
  for (std::size_t i = 0; i < axis.size(); ++i) axis[i] = (static_cast<double>(i) - std::floor(cells / 2)) * step;
  return axis;
}

// S += x e^{j ...} of one pulse over all its frequencies: `factor` is the compensation at the first frequency, `step`
// its change from one frequency to the next (f_b v t_n couples frequency and velocity: range migration).
SEAGLINT_FUNCTION_VERSIONS("arch=x86-64-v4", "arch=x86-64-v3", "default")
void add_pulse(const Complex* x, std::size_t frequencies, Block factor, const Block& step, Block* sums) {
  for (std::size_t b = 0; b < frequencies; ++b) {
    Block& sum = sums[b];
    const double xr = x[b].real(), xi = x[b].imag();
    for (std::size_t l = 0; l < kBlock; ++l) {
      const double er = factor.re[l], ei = factor.im[l];
      sum.re[l] += er * xr - ei * xi;
      sum.im[l] += er * xi + ei * xr;
      factor.re[l] = er * step.re[l] - ei * step.im[l];
      factor.im[l] = er * step.im[l] + ei * step.re[l];
    }
  }
}

}  // namespace

MapGrid map_grid(const PulseTrain& train, const MapSpec& spec) {
  const double window_cells = std::max(1.0, std::round(train.band_bins() * spec.range_oversampling));
  const double range_step = train.unambiguous_range_m() / window_cells;
  const double velocity_step = train.velocity_resolution_mps() / spec.velocity_oversampling;
  const double ranges = std::clamp(std::round(spec.range_span_m / range_step), 1.0, window_cells);
  const double velocities =
      std::clamp(std::round(spec.velocity_span_mps / velocity_step), 1.0,
                 std::max(1.0, std::round(static_cast<double>(train.pulses()) * spec.velocity_oversampling)));
  if (!(velocities * window_cells <= kMaxCells)) {
    throw InputError(
        fmt::format("map: {:.0f} velocities x {:.0f} range cells of the window are too many; at most {:.0f}: reduce "
                    "velocity_span_mps, velocity_oversampling or range_oversampling",
                    velocities, window_cells, kMaxCells));
  }
  MapGrid grid;
  grid.window_cells = static_cast<std::size_t>(window_cells);
  grid.range_m = centred_axis(ranges, range_step);
  grid.velocity_mps = centred_axis(velocities, velocity_step);
  return grid;
}

RvMap form_rv_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec, bool intra_pulse_motion,
                  const StopFlag* stop) {
  const std::vector<Complex> compressed = compress_pulses(echo, train, spec.compression);
  const MapWeights weights = map_weights(train, spec);
  const MapGrid grid = map_grid(train, spec);
  RvMap map;
  map.range_m = grid.range_m;
  map.velocity_mps = grid.velocity_mps;
  map.unused_carriers = weights.unused_carriers;
  map.values.resize(grid.range_m.size() * grid.velocity_mps.size());

  const std::size_t frequencies = train.frequencies();
  const std::size_t length = grid.window_cells;
  const auto bins = static_cast<std::size_t>(train.band_bins());
  const double velocity_step = train.velocity_resolution_mps() / spec.velocity_oversampling;
  const double per_hz = 4 * kPi / kSpeedOfLight;

  // Relative to the band centre, bin k has the phase 2 pi (k - (bins - 1)/2) r_i / (window): the inverse FFT runs over
  // k, and the constant is removed per range cell.
  const auto first_range = static_cast<long>(grid.range_m.size() / 2);
  std::vector<Complex> centre_phase(grid.range_m.size());
  std::vector<std::size_t> cell(grid.range_m.size());
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const long offset = static_cast<long>(i) - first_range;
    cell[i] = static_cast<std::size_t>((offset + static_cast<long>(length)) % static_cast<long>(length));
    centre_phase[i] = std::polar(
        1.0, -kPi * (static_cast<double>(bins) - 1) * static_cast<double>(offset) / static_cast<double>(length));
  }

  std::vector<Block> sums(frequencies);
  std::vector<Complex> weighted(frequencies);
  const std::size_t max_rows = std::min(kBlock, grid.velocity_mps.size());
  FourierBatch profile(length, max_rows, Fourier::kInverse);
  for (std::size_t first = 0; first < grid.velocity_mps.size(); first += kBlock) {
    if (stop != nullptr && *stop) throw Interrupted();
    const std::size_t rows = std::min(kBlock, grid.velocity_mps.size() - first);
    const double velocity = grid.velocity_mps[first];
    std::fill(profile.row(0), profile.row(0) + max_rows * length, Complex{});
    for (int i = 0; i < train.carriers; ++i) {
      const double lowest_hz = train.first_carrier_hz + i * train.hop_step_hz + train.baseband_hz.front();
      std::fill(sums.begin(), sums.end(), Block{});
      for (std::size_t n = 0; n < train.pulses(); ++n) {
        if (train.code[n] != i) continue;
        for (std::size_t b = 0; b < frequencies; ++b) weighted[b] = compressed[n * frequencies + b] * weights.pulse[n];
        const double metres = per_hz * train.time_s[n];
        add_pulse(
            weighted.data(), frequencies, phase_ramp(lowest_hz * metres * velocity, lowest_hz * metres * velocity_step),
            phase_ramp(train.baseband_step_hz * metres * velocity, train.baseband_step_hz * metres * velocity_step),
            sums.data());
      }
      for (std::size_t b = 0; b < frequencies; ++b) {
        // The time f_b / mu within the pulse is common to all pulses of the carrier.
        if (intra_pulse_motion) {
          const double metres = per_hz * (lowest_hz + static_cast<double>(b) * train.baseband_step_hz) *
                                train.baseband_hz[b] / train.chirp_rate_hz_s;
          sums[b].rotate(phase_ramp(metres * velocity, metres * velocity_step));
        }
      }
      // One row of the transform at a time.
      const std::size_t first_bin = static_cast<std::size_t>(i) * train.bins_per_hop;
      for (std::size_t l = 0; l < rows; ++l) {
        Complex* row = profile.row(l);
        for (std::size_t b = 0, k = first_bin % length; b < frequencies; ++b, k = k + 1 == length ? 0 : k + 1)
          row[k] += weights.bin[first_bin + b] * Complex(sums[b].re[l], sums[b].im[l]);
      }
    }
    profile.execute();
    for (std::size_t l = 0; l < rows; ++l) {
      Complex* row = &map.values[(first + l) * grid.range_m.size()];
      for (std::size_t r = 0; r < grid.range_m.size(); ++r) row[r] = profile.row(l)[cell[r]] * centre_phase[r];
    }
  }
  return map;
}

namespace {

constexpr double kBoxDepthDb =
    10;  // dB: above the random-hop pedestal (-15 dB and below), below the stronger centres of a ship

double largest_power(const RvMap& map) {
  double largest = 0;
  for (const Complex& value : map.values) largest = std::max(largest, std::norm(value));
  return largest;
}

double box_power(const RvMap& map, const MapExtent& box) {
  double sum = 0;
  for (std::size_t v = box.velocity_first; v <= box.velocity_last; ++v) {
    for (std::size_t r = box.range_first; r <= box.range_last; ++r) sum += std::norm(map.at(v, r));
  }
  return sum /
         static_cast<double>((box.velocity_last - box.velocity_first + 1) * (box.range_last - box.range_first + 1));
}

double decibel(double ratio) { return 10 * std::log10(ratio); }

}  // namespace

MapExtent target_extent(const RvMap& target) {
  const double threshold = largest_power(target) * std::pow(10, -kBoxDepthDb / 10);
  MapExtent box{target.columns(), 0, target.velocity_mps.size(), 0};
  for (std::size_t v = 0; v < target.velocity_mps.size(); ++v) {
    for (std::size_t r = 0; r < target.columns(); ++r) {
      if (std::norm(target.at(v, r)) < threshold) continue;
      box.range_first = std::min(box.range_first, r);
      box.range_last = std::max(box.range_last, r);
      box.velocity_first = std::min(box.velocity_first, v);
      box.velocity_last = std::max(box.velocity_last, v);
    }
  }
  return box;
}

ReceivedInterval form_received_interval(const Echo& echo, const PulseTrain& train, const ClutterSpec& clutter,
                                        const MapSpec& spec, bool intra_pulse_motion, const StopFlag* stop) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  ReceivedInterval received;
  received.echo = echo.target;
  received.map = form_rv_map(echo.target, train, spec, intra_pulse_motion, stop);
  received.scr = {kNone, kNone, kNone, kNone};
  const auto add = [&](const std::vector<Complex>& part, const RvMap& map, double gain) {
    for (std::size_t i = 0; i < part.size(); ++i) received.echo[i] += gain * part[i];
    for (std::size_t i = 0; i < map.values.size(); ++i) received.map.values[i] += gain * map.values[i];
  };

  double gain_db = 0;
  const double target_power = mean_power(echo.target);
  const bool has_target = target_power > 0;
  if (!echo.clutter.empty()) {
    const RvMap clutter_map = form_rv_map(echo.clutter, train, spec, intra_pulse_motion, stop);
    const double clutter_cell = mean_power(clutter_map.values);
    const double target_peak = largest_power(received.map);
    if (!((target_peak > 0 || !has_target) && clutter_cell > 0)) {
      throw InputError(
          fmt::format("map: no power in the map's window (target {} m^2, clutter {} m^2)", target_peak, clutter_cell));
    }
    MeasuredRatios& scr = received.scr;
    if (has_target) {
      scr.per_pulse_db = decibel(target_power / mean_power(echo.clutter));
      scr.peak_cell_db = decibel(target_peak / clutter_cell);
      scr.scr_extent_db = decibel(box_power(received.map, target_extent(received.map)) / clutter_cell);
      const double measured = clutter.scr_definition == ScrDefinition::kPerPulse   ? scr.per_pulse_db
                              : clutter.scr_definition == ScrDefinition::kPeakCell ? scr.peak_cell_db
                                                                                   : scr.scr_extent_db;
      if (clutter.level == ClutterLevel::kScr) gain_db = measured - clutter.scr_db;
      for (double* ratio : {&scr.per_pulse_db, &scr.peak_cell_db, &scr.scr_extent_db}) *ratio -= gain_db;
    }
    received.clutter_power_m2 = mean_power(echo.clutter) * std::pow(10, gain_db / 10);
    add(echo.clutter, clutter_map, std::pow(10, gain_db / 20));
  }
  if (!echo.noise.empty()) {
    const double noise_db = clutter.noise_level == NoiseLevel::kCnr ? gain_db : 0;
    if (has_target) received.scr.snr_per_pulse_db = decibel(target_power / mean_power(echo.noise)) - noise_db;
    received.noise_power_m2 = mean_power(echo.noise) * std::pow(10, noise_db / 10);
    add(echo.noise, form_rv_map(echo.noise, train, spec, intra_pulse_motion, stop), std::pow(10, noise_db / 20));
  }
  return received;
}

}  // namespace seaglint
