// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/map_products.h"

#include <cmath>

#include "radar/echo/echo.h"

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

}  // namespace seaglint
