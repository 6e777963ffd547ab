// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/view_trace.h"

#include <span>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/edges/edge_decomposition.h"
#include "sim/scattering/response/aspect_trace.h"
#include "sim/scattering/response/body_response.h"
#include "sim/scattering/response/scattering_matrix.h"
#include "sim/scattering/surfaces/phase_integral.h"

namespace seaglint {
namespace {

// Sum and points of the contributions of one chunk of the trace.
class ChunkContributions {
 public:
  // Adds footprints or edge contributions. At a finite range the sum is that of points, since the correction of the
  // wavefront differs from point to point.
  template <class Contribution>
  void add(const Contribution& contribution, const BistaticGeometry& geometry, double k,
           const TracingSettings& settings, double spread, double aspect_change) {
    std::array<Complex, 4> echo;
    if (settings.range_m > 0) {
      std::vector<PointContribution> sum_points;
      split(contribution, geometry, {k, spread}, sum_points);
      apply_wavefront_curvature(sum_points, geometry, settings.origin, settings.range_m);
      echo = direct_sum(sum_points, k, Vec3::Zero());
    } else {
      echo = scattered(contribution, k);
    }
    for (std::size_t i = 0; i < 4; ++i) matrix[i] += echo[i];
    split(contribution, geometry, {k, aspect_change + spread}, points);
  }

  std::array<Complex, 4> matrix{};
  std::vector<PointContribution> points;

 private:
  static void split(const Footprint& footprint, const BistaticGeometry& geometry, const DecompositionSettings& settings,
                    std::vector<PointContribution>& out) {
    decompose(footprint, geometry.transmit, settings, out);
  }
  static void split(const EdgeContribution& contribution, const BistaticGeometry&,
                    const DecompositionSettings& settings, std::vector<PointContribution>& out) {
    decompose(contribution, settings, out);
  }
};

}  // namespace

TracedView trace_view(const Scatterer& scatterer, const BistaticGeometry& geometry, double k,
                      const TracingSettings& settings, int threads, const StopFlag* stop) {
  const double spread = direction_spread(scatterer, settings.range_m, settings.origin),
               aspect_change = default_aspect_change(scatterer, 2 * kPi / k);
  const AspectTrace trace(scatterer, std::span(&geometry, 1), settings, std::span(&k, 1), threads);
  std::vector<ChunkContributions> chunks(trace.chunk_count(0));
  const auto add = [&](std::size_t, std::size_t chunk, const auto& contributions) {
    for (const auto& contribution : contributions)
      chunks[chunk].add(contribution, geometry, k, settings, spread, aspect_change);
  };
  TracedView view;
  view.segments = trace.run({add, add}, stop);
  for (const ChunkContributions& chunk : chunks) {
    for (std::size_t i = 0; i < 4; ++i) view.matrix[i] += chunk.matrix[i];
    view.contributions.insert(view.contributions.end(), chunk.points.begin(), chunk.points.end());
  }
  if (settings.range_m > 0) apply_wavefront_curvature(view.contributions, geometry, settings.origin, settings.range_m);
  return view;
}

}  // namespace seaglint
