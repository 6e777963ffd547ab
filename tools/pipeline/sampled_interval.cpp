// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/sampled_interval.h"

#include <fmt/format.h>

#include <cmath>

#include "radar/echo/echo.h"
#include "sim/core/process/error.h"

namespace seaglint {
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
