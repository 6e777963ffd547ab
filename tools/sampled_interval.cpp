// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sampled_interval.h"

#include <cmath>

#include "radar/echo/echo.h"

namespace seaglint {
namespace {

// Mean power at the map's frequencies.
double power_of_map(const SampledEcho& sampled, const PulseTrain& train) {
  return mean_power(spectrum_of(sampled, train));
}

void scale(SampledEcho& sampled, double power_gain) {
  for (Complex& value : sampled.values) value *= std::sqrt(power_gain);
}

}  // namespace

SampledInterval sampled_interval(const Pipeline& pipeline, std::size_t sample) {
  const Scenario& scenario = pipeline.scenario();
  const MadeSample made = pipeline.make(sample);
  const PulseTrain fine = train_for_samples(made.train, scenario.radar);
  const double sampling_hz = scenario.radar.sampling_mhz * 1e6;
  const auto moving = pipeline.scene(made.address.sea_state, made.address.realisation);
  const Echo echo = synthesize_echo(fine, pipeline.response(sample, fine).response, scenario.clutter, scenario.seed,
                                    sample, pipeline.clutter_scene(made.address, *moving));

  SampledInterval interval;
  interval.train = made.train;
  interval.target = sample_echo(echo.target, fine, sampling_hz);
  const double target_power = power_of_map(interval.target, made.train);
  const auto with_level = [&](const std::vector<Complex>& part, double ratio_db, double more) {
    SampledEcho sampled = sample_echo(part, fine, sampling_hz);
    scale(sampled, more * target_power / power_of_map(sampled, made.train) * std::pow(10, -ratio_db / 10));
    return sampled;
  };
  if (!echo.clutter.empty()) interval.clutter = with_level(echo.clutter, made.received.scr.per_pulse_db, 1);
  if (!echo.noise.empty())
    interval.noise = with_level(echo.noise, made.received.scr.snr_per_pulse_db, fine.refinement);
  return interval;
}

}  // namespace seaglint
