// SPDX-License-Identifier: BSD-3-Clause
// A map of a point 30 m behind the reference point that recedes at 2 m/s, by the installed libraries: its peak.
#include <algorithm>
#include <cstdio>

#include "sim/scenario/scenario.h"
#include "tools/pipeline/pipeline.h"

int main() {
  const seaglint::Scenario scenario = seaglint::parse_scenario(
      "seaglint: 1\n"
      "view: {azimuth_deg: 0, elevation_deg: 0}\n"
      "targets: {point: {label: 1, points: [{position_m: [-30, 0, 0], amplitude_m: 3, velocity_mps: [-2, 0, 0]}]}}\n",
      "point.yaml");
  const seaglint::GeneratedSample sample = seaglint::Pipeline(scenario).generate_sample(0);
  const seaglint::ScatteringCentre strongest =
      *std::max_element(sample.centres.begin(), sample.centres.end(),
                        [](const auto& a, const auto& b) { return a.amplitude_m < b.amplitude_m; });
  std::printf("%.2f m, %.2f m/s, %.2f m\n", strongest.range_m, strongest.velocity_mps, strongest.amplitude_m);
}
