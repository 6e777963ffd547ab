// SPDX-License-Identifier: BSD-3-Clause
// Views of a sweep.
#include "tools/rcs/rcs_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/solver/solve.h"
#include "tests/sim/scattering/solve_calls.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class ReflectorSweep : public testing::Test {
 protected:
  ReflectorSweep() : folder_(fs::path(testing::TempDir()) / ("rcs_views_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    request_.target = folder_ / "reflector.glb";
    write_mesh(request_.target, make_icosahedral_reflector());
    request_.elevation_deg = {2};
    target_.emplace(prepare_rcs_target(with({10e9}, {0})));
  }
  ~ReflectorSweep() override { fs::remove_all(folder_); }

  RcsRequest with(std::vector<double> frequency_hz, std::vector<double> azimuth_deg) const {
    RcsRequest request = request_;
    request.frequency_hz = std::move(frequency_hz);
    request.azimuth_deg = std::move(azimuth_deg);
    return request;
  }
  RcsResult result_of(const RcsRequest& request) const { return compute_rcs(request, *target_, 1); }

  // Computes the sweep, compares every view with the same view alone, and returns the number of traces of the sweep
  // from the transmitter.
  std::size_t traces_of(const RcsRequest& request) const {
    const RcsResult sweep = result_of(request);
    std::size_t segments = 0;
    for (std::size_t view = 0; view < request.azimuth_deg.size(); ++view) {
      const RcsResult one = result_of(with(request.frequency_hz, {request.azimuth_deg[view]}));
      EXPECT_EQ(one.sweep.models.back().matrices[0], sweep.sweep.models.back().matrices[view]) << view;
      segments = one.segments;
    }
    EXPECT_EQ(sweep.segments % segments, 0u);
    return sweep.segments / segments;
  }

  fs::path folder_;
  RcsRequest request_;
  std::optional<RcsTarget> target_;
};

std::vector<double> steps(std::size_t count, double first, double step) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(first + step * static_cast<double>(i));
  return values;
}

TEST_F(ReflectorSweep, TracesAFixedTransmitterOnceForManyReceivers) {
  request_.transmitter = FixedTransmitter{20, 2};
  EXPECT_EQ(traces_of(with({10e9}, steps(8, 0, 5))), 1u);  // one of them in the transmitter's direction
  EXPECT_EQ(traces_of(with({10e9}, steps(17, 0, 2))), 3u);
  EXPECT_EQ(traces_of(with(steps(128, 10e9, 10e6), steps(8, 0, 5))), 2u);
}

TEST_F(ReflectorSweep, HasTheViewsOfSingleTracesAtAFiniteRange) {
  request_.transmitter = FixedTransmitter{20, 2};
  request_.range_m = 60;
  EXPECT_EQ(traces_of(with({10e9, 11e9}, steps(5, 10, 5))), 1u);
}

TEST_F(ReflectorSweep, TracesEveryViewOfOneAntenna) {
  const RcsResult sweep = result_of(with({10e9}, {0, 7}));
  EXPECT_EQ(sweep.segments, result_of(with({10e9}, {0})).segments + result_of(with({10e9}, {7})).segments);
}

// The points of an exported view come from the trace that gives its matrix.
TEST_F(ReflectorSweep, TracesAnExportedViewOnce) {
  for (const double range_m : {0.0, 60.0}) {
    request_.range_m = range_m;
    RcsRequest exported = with({10e9}, {7});
    const RcsResult without = result_of(exported);
    EXPECT_TRUE(without.points.empty());
    exported.exports.centres = "centres.csv";
    const RcsResult result = result_of(exported);
    EXPECT_EQ(result.sweep.models.back().matrices, without.sweep.models.back().matrices) << range_m;
    EXPECT_EQ(result.segments, without.segments);

    const double k = 2 * kPi * exported.frequency_hz[0] / kSpeedOfLight;
    const auto sum = direct_sum(result.points, k, Vec3::Zero());
    const std::array<Complex, 4>& matrix = result.sweep.models.back().matrices[0][0];
    // Of the points, edge contributions enter by their end points where the matrix has the integral along the interval:
    // 3e-4 here. At a finite range amplitudes are frozen over radius / R, kMaxAmplitudeError of the strongest end
    // point.
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT(std::abs(sum[i] - matrix[i]), (range_m > 0 ? 0.04 : 1e-3) * std::abs(matrix[3])) << range_m << ' ' << i;
  }
}

}  // namespace
}  // namespace seaglint
