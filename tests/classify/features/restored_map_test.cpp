// SPDX-License-Identifier: BSD-3-Clause
// CLEAN's restored map against the map of a radar without frequency hopping, which has no pedestal.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "classify/features/scattering_centres.h"
#include "radar/echo/echo.h"
#include "sim/canonical/point_response.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

const std::vector<PointSpec> kPoints{
    {{-30.1, 0, 0}, 1, {1.3, 0, 0}}, {{2.7, 0, 0}, 0.5, {-0.8, 0, 0}}, {{41, 0, 0}, 0.7, {0.2, 0, 0}}};

std::vector<Complex> echo_of(const PulseTrain& train) {
  ClutterSpec none;
  none.enabled = false;
  return synthesise_echo(train, point_response(kPoints, Vec3(1, 0, 0), interval_sampling(train, 0)), none, 1, 1).target;
}

// Maximum difference of magnitudes relative to the maximum of `b`, and the same outside the neighbourhood of the lobes.
double largest_difference_db(const RvMap& a, const RvMap& b) {
  double difference = 0, peak = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    difference = std::max(difference, std::abs(std::abs(a.values[i]) - std::abs(b.values[i])));
    peak = std::max(peak, std::abs(b.values[i]));
  }
  return 20 * std::log10(difference / peak);
}

TEST(RestoredMap, EqualsTheMapWithoutFrequencyHopping) {
  const PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  RadarSpec whole;
  whole.carrier_count = 1;
  whole.carrier_ghz = 16.0875;  // the middle of eight bands
  whole.bandwidth_mhz = whole.hop_step_mhz = 200;
  whole.sampling_mhz = 400;
  const PulseTrain plain = make_pulse_train(whole, 239.8, 1, 2);
  ASSERT_EQ(plain.band_bins(), train.band_bins());
  FeatureSpec spec;
  spec.dynamic_range_db = 60;
  const CleanedMap cleaned = clean_map(echo_of(train), train, {}, false, spec);
  const RvMap raw = form_rv_map(echo_of(train), train, {}, false),
              reference = form_rv_map(echo_of(plain), plain, {}, false);
  ASSERT_EQ(raw.values.size(), reference.values.size());
  const double before = largest_difference_db(raw, reference),
               after = largest_difference_db(restored_map(cleaned, train, {}), reference);
  std::printf("against a radar that does not hop: map %.1f dB, restored %.1f dB of the peak\n", before, after);
  record_figure(before, 0, "unrestored_map_db");
  record_figure(after, 0, "restored_map_db");
  // The residual is range migration within a point's velocity sidelobes, 0.06 m of 0.75 m for 1 m/s off the peak, which
  // the map contains.
  EXPECT_GT(before, -25);
  EXPECT_LT(after, -45);
}

}  // namespace
}  // namespace seaglint
