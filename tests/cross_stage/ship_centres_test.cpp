// SPDX-License-Identifier: BSD-3-Clause
// The map of the ship has many scattering centres along its length within a dynamic range of 30 dB.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "radar/rvmap/rv_map.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/scattering/observation/observation.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"

namespace seaglint {
namespace {

// Cells that exceed their eight neighbours and lie within 30 dB of the strongest.
int local_maxima(const RvMap& map) {
  const auto level = [&](std::size_t v, std::size_t r) { return std::abs(map.at(v, r)); };
  double peak = 0;
  for (const Complex& value : map.values) peak = std::max(peak, std::abs(value));
  int count = 0;
  for (std::size_t v = 1; v + 1 < map.velocity_mps.size(); ++v) {
    for (std::size_t r = 1; r + 1 < map.range_m.size(); ++r) {
      bool highest = level(v, r) > peak * std::pow(10, -30.0 / 20);
      for (int dv = -1; highest && dv <= 1; ++dv) {
        for (int dr = -1; highest && dr <= 1; ++dr)
          highest = (dv == 0 && dr == 0) || level(v, r) > level(v + dv, r + dr);
      }
      count += highest;
    }
  }
  return count;
}

// Stepped code (each carrier's pulses as regular as possible), no clutter, Hann taper along both axes; the ship rolls,
// pitches and yaws as at Hs 2 m, Tp 8 s.
TEST(ShipCentres, HoldsAtLeastTwentyScatteringCentresWithin30DbAtObliqueAspects) {
  const Scatterer ship(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"));
  RadarSpec radar;
  radar.hop_code = HopCode::kStepped;
  const PulseTrain train = make_pulse_train(radar, 200, 1, 1);
  MapSpec spec;
  spec.range_taper = spec.velocity_taper = Taper::kHann;
  // With the stepped code every point recurs one range cell further each 4.7 m/s: the window contains each once.
  spec.velocity_span_mps = 4;
  std::vector<MotionSample> samples(101);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].angle_rates = Vec3(0.012, 0.009, 0.004);
    samples[i].angles = 0.01 * static_cast<double>(i) * samples[i].angle_rates;
  }
  const Trajectory trajectory(0, 0.01, samples, Vec3::Zero(), Vec3(0, 0, 1.7));
  std::vector<int> counts;
  for (const double azimuth : {20.0, 40.0, 60.0, 120.0, 140.0, 160.0}) {
    const Vec3 r = direction_to_radar(radians(azimuth), radians(2));
    const FrequencyResponse response =
        interval_response(ship, trajectory, r, Polarisation::kVv, interval_sampling(train, 0.5), {}, 2).response;
    std::vector<Complex> echo(response.values.size());
    const std::size_t bins = train.chirp_spectrum.size();
    for (std::size_t i = 0; i < echo.size(); ++i) echo[i] = train.chirp_spectrum[i % bins] * response.values[i];
    counts.push_back(local_maxima(form_rv_map(echo, train, spec, false)));
    std::printf("azimuth %g deg: %d centres\n", azimuth, counts.back());
  }
  std::sort(counts.begin(), counts.end());
  const double median = 0.5 * (counts[2] + counts[3]);
  record_figure(median, 0, "ship_centres_median");
  EXPECT_GE(median, 20);
}

}  // namespace
}  // namespace seaglint
