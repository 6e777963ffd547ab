// SPDX-License-Identifier: BSD-3-Clause
// Stages that run concurrently in one process use the same libraries safely.
#include <gtest/gtest.h>

#include "sim/core/numbers/fourier.h"
#include "sim/core/process/parallel.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

TEST(Threads, SolverAndRadarPlanTheirTransformsConcurrently) {
  const Scatterer plate(make_plate(0.2, 0.2));
  IntervalSampling sampling;
  sampling.first_hz = 16e9;
  sampling.step_hz = 1e6;
  sampling.count = 20;
  sampling.frequencies_per_pulse = 10;
  for (int pulse = 0; pulse < 8; ++pulse) {
    sampling.pulse_first.push_back(pulse % 2 * 10);
    sampling.pulse_time_s.push_back(250e-6 * pulse);
  }
  const Trajectory rest = Trajectory::at_rest(Vec3::Zero());
  const auto plan_both = [&](std::size_t i) {
    if (i % 2 == 0) {
      interval_response(plate, rest, Vec3::UnitX(), Polarisation::kVv, sampling, SolverSpec{.min_patch_m = 0.0035});
    } else {
      for (std::size_t length = 8; length < 300; ++length) FourierBatch(length + i % 7, 1, Fourier::kForward).execute();
    }
  };
  // FFTW's planner, used by two stages without a common lock, corrupted the heap within some hundreds of plans.
  parallel_for(400, 4, plan_both);
}

}  // namespace
}  // namespace seaglint
