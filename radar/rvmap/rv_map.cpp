// SPDX-License-Identifier: BSD-3-Clause
#include "radar/rvmap/rv_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "radar/rvmap/map_weights.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/process/error.h"
#include "sim/core/process/function_versions.h"

namespace seaglint {
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

RvMap form_rv_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec,
                  bool intra_pulse_motion) {
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

}  // namespace seaglint
