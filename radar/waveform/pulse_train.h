// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Frequency-agile LFM pulse train of one coherent interval, with its resolution, ambiguity and pedestal.

#include <cstdint>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct PulseTrain {
  std::vector<int> code;            // C_n in 0..M-1, one per pulse
  std::vector<double> carrier_hz;   // f_n = f_0 + C_n df
  std::vector<double> time_s;       // t_n = n T_r + jitter, the middle of pulse n, from the interval's start; ascending
  int carriers = 1;                 // M
  double first_carrier_hz = 0;      // f_0
  double hop_step_hz = 0;           // df
  double bandwidth_hz = 0;          // B
  double chirp_rate_hz_s = 0;       // mu = B / T_p
  double pri_s = 0;                 // T_r
  bool intra_pulse_motion = false;  // echo model: baseband frequency f is reflected at t_n + f/mu
  std::vector<double> baseband_hz;  // uniform grid inside |f| <= B/2, symmetric about 0, cell centres; step divides df
  double baseband_step_hz = 0;
  int bins_per_hop = 1;  // df / step, exact
  // odd: steps of this grid per step of the map's grid (radar/echo/echo.h)
  int grid_refinement = 1;
  std::vector<Complex> chirp_spectrum;  // P(f) on baseband_hz: the transmit waveform, |P| about 1

  std::size_t pulses() const { return code.size(); }
  std::size_t frequencies() const { return baseband_hz.size(); }  // of one pulse
  int band_bins() const;                    // of the synthesised band, (M - 1) bins_per_hop + frequencies()
  double band_centre_hz() const;            // of the synthesised band
  double synthetic_bandwidth_hz() const;    // B_s = band_bins() step; M df when B = df
  double unambiguous_range_m() const;       // c / (2 step)
  double range_resolution_m() const;        // c / (2 B_s)
  double velocity_resolution_mps() const;   // lambda / (2 N T_r), lambda at the band centre
  double unambiguous_velocity_mps() const;  // lambda / (4 T_r): the span is +- this
};

// Hop codes C_n of one interval, stream kHopCode of (seed, index): random = independent and uniform, balanced = each
// carrier floor(N/M) or ceil(N/M) times in random order, stepped = n mod M.
std::vector<int> hop_code(HopCode kind, int pulses, int carriers, std::uint64_t seed, std::uint64_t index);

// Hop code of a scenario; codes of a file are used in blocks of spec.pulses, block `index` modulo their number.
std::vector<int> hop_code(const RadarSpec& spec, std::uint64_t seed, std::uint64_t index);

// t_n = n T_r + jitter, s; the jitter of all pulses but the first is uniform within +-pri_jitter_us, stream kPriJitter
// of (seed, index).
std::vector<double> pulse_times(const RadarSpec& spec, std::uint64_t seed, std::uint64_t index);

// range_window_m: extent of the response plus margin; baseband step df / ceil(df 2 window / c), smaller when B is below
// that. Throws InputError for more than 2^26 samples per interval, 2^24 per pulse, or 4e9 samples times frequencies of
// its spectrum.
PulseTrain make_pulse_train(const RadarSpec& spec, double range_window_m, std::uint64_t seed, std::uint64_t index);

// P(f) = sqrt(mu)/fs sum_k e^{j pi mu t_k^2} e^{-j 2 pi f t_k}, t_k = (k + 1/2)/fs - T_p/2 (README.md, "Transmit
// waveform"); the factor sqrt(mu) makes |P| about 1 in band (stationary phase).
std::vector<Complex> chirp_spectrum(double bandwidth_hz, double pulse_width_s, double sampling_hz,
                                    const std::vector<double>& frequency_hz);

// Times and frequencies at which the pulse train samples the target response in an interval that starts at start_s.
IntervalSampling interval_sampling(const PulseTrain& train, double start_s);

// Mean power of the point response at (range_offset_m, velocity_offset_mps) from its peak of 1, averaged over all codes
// with the times and pulses per carrier of this train: coherent sidelobes plus random-hop pedestal, for one frequency
// per pulse and no taper. Closed form of radar/waveform/README.md.
double expected_response_power(const PulseTrain& train, double range_offset_m, double velocity_offset_mps);

// Warning about gaps between the bands of the carriers and the resulting sidelobes; empty without gaps.
std::string band_gap_warning(const PulseTrain& train);

// Resolutions, ambiguities, blind range and expected pedestal, one line each, for `seaglint check`.
std::string figures_of_merit_text(const PulseTrain& train, const RadarSpec& spec);

}  // namespace seaglint
