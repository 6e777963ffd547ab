// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/interval_products.h"

#include <fmt/format.h>
#include <cmath>

#include "radar/echo/echo.h"
#include "sim/core/process/error.h"

namespace seaglint {

FullBandInterval full_band_interval(const Pipeline& pipeline, std::size_t sample) {
  const Scenario scenario = pipeline.scenario_of(pipeline.plan().address(sample));
  // One carrier with the bandwidth of all; the hop step is the whole band, so that the unambiguous range window is
  // unchanged.
  RadarSpec radar = scenario.radar;
  const double lowest_mhz = 1e3 * radar.carrier_ghz - 0.5 * radar.bandwidth_mhz;
  radar.bandwidth_mhz += (radar.carrier_count - 1) * radar.hop_step_mhz;
  radar.hop_step_mhz = radar.bandwidth_mhz;
  radar.carrier_count = 1;
  radar.hop_code = HopCode::kStepped;
  radar.carrier_ghz = 1e-3 * (lowest_mhz + 0.5 * radar.bandwidth_mhz);
  radar.sampling_mhz = std::max(radar.sampling_mhz, 2 * radar.bandwidth_mhz);

  FullBandInterval band;
  band.train = make_pulse_train(radar, pipeline.window_m(), scenario.seed, pipeline.plan().first_of_interval(sample));
  ClutterSpec none;
  none.enabled = false;
  const SampleAddress at = pipeline.plan().address(sample);
  const auto scene = pipeline.scene(at.sea_state, at.realisation);
  band.echo = synthesise_echo(band.train, pipeline.response(at, band.train).response, none, scenario.seed, sample,
                              pipeline.clutter_scene(at, *scene))
                  .target;
  band.image = form_rv_map(band.echo, band.train, scenario.map, radar.intra_pulse_motion);
  return band;
}

RangeProfiles range_profiles(const FullBandInterval& band, const MapSpec& spec) {
  RangeProfiles profiles;
  const std::size_t frequencies = band.train.frequencies();
  MapSpec row = spec;
  row.velocity_span_mps = 1e-6;  // one velocity, 0
  for (std::size_t n = 0; n < band.train.pulses(); ++n) {
    PulseTrain pulse = band.train;
    pulse.code = {band.train.code[n]};
    pulse.carrier_hz = {band.train.carrier_hz[n]};
    pulse.time_s = {0};
    const RvMap map = form_rv_map({&band.echo[n * frequencies], frequencies}, pulse, row, pulse.intra_pulse_motion);
    profiles.time_s.push_back(band.train.time_s[n]);
    profiles.range_m = map.range_m;
    for (const Complex& value : map.values) profiles.magnitude_m.push_back(std::abs(value));
  }
  return profiles;
}

namespace {

// Mean power at the map's frequencies.
double power_of_map(const SampledEcho& sampled, const PulseTrain& train) {
  return mean_power(spectrum_of(sampled, train));
}

// Samples of all pulses: 2 GB for each of target, clutter and noise.
constexpr double kMaxSamples = 134217728;

void check_size(const Scenario& scenario, const PulseTrain& fine, double sampling_hz) {
  const double per_pulse = samples_per_pulse(fine, sampling_hz);
  const auto pulses = static_cast<double>(fine.pulses());
  if (pulses * per_pulse <= kMaxSamples) return;
  throw InputError(fmt::format("{}: value {}: with {:.0f} samples of each pulse at most {:.0f} pulses make an echo",
                               place_of(scenario, "radar.pulses"), pulses, per_pulse,
                               std::floor(kMaxSamples / per_pulse)));
}

void scale(SampledEcho& sampled, double power_gain) {
  for (Complex& value : sampled.values) value *= std::sqrt(power_gain);
}

}  // namespace

SampledInterval sampled_interval(const Pipeline& pipeline, std::size_t sample) {
  const Scenario scenario = pipeline.scenario_of(pipeline.plan().address(sample));
  const double sampling_hz = scenario.radar.sampling_mhz * 1e6;
  // The pulses of the map, without generating it.
  const PulseTrain train =
      make_pulse_train(scenario.radar, pipeline.window_m(), scenario.seed, pipeline.plan().first_of_interval(sample));
  const PulseTrain fine = train_for_samples(train, scenario.radar);
  check_size(scenario, fine, sampling_hz);
  const GeneratedSample made = pipeline.generate_sample(sample);
  const auto moving = pipeline.scene(made.address.sea_state, made.address.realisation);
  const Echo echo = synthesise_echo(fine, pipeline.response(made.address, fine).response, scenario.clutter,
                                    scenario.seed, sample, pipeline.clutter_scene(made.address, *moving));

  SampledInterval interval;
  interval.train = train;
  interval.record = made.stored.record;
  interval.target = sample_echo(echo.target, fine, sampling_hz);
  const double target_power = power_of_map(interval.target, train);
  const auto with_level = [&](const std::vector<Complex>& part, double ratio_db, double more) {
    SampledEcho sampled = sample_echo(part, fine, sampling_hz);
    scale(sampled, more * target_power / power_of_map(sampled, train) * std::pow(10, -ratio_db / 10));
    return sampled;
  };
  if (!echo.clutter.empty()) interval.clutter = with_level(echo.clutter, made.received.scr.per_pulse_db, 1);
  if (!echo.noise.empty())
    interval.noise = with_level(echo.noise, made.received.scr.snr_per_pulse_db, fine.grid_refinement);
  return interval;
}

}  // namespace seaglint
