// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/path_points.h"

#include <cmath>
#include <utility>

#include "sim/core/process/parallel.h"

namespace seaglint {

void append_points(const Footprint& footprint, const BistaticGeometry& traced, const PointSelection& selection,
                   std::vector<PointContribution>& out) {
  decompose_over_band(selection.range_m > 0 ? at_any_slope_rate(footprint) : footprint, traced.transmit,
                      selection.split, selection.half_band, out);
}

void append_points(const EdgeContribution& contribution, const BistaticGeometry&, const PointSelection& selection,
                   std::vector<PointContribution>& out) {
  decompose(contribution, selection.split, out);
}

ResponseGrid grid_of_points(std::span<const ChunkPoints> chunks, const LookDirectionPath& path,
                            const WavenumberGrid& wavenumbers, double beside_m, int threads) {
  double fastest = 0;
  for (const ChunkPoints& chunk : chunks) {
    for (const GridPoint& point : chunk.points) fastest = std::max(fastest, std::abs(point.u));
  }
  const GridLimits limits{fastest, path.s_limit, beside_m, path.q_limit};
  std::vector<ResponseGrid> grids(kGrids, ResponseGrid(wavenumbers, limits));
  parallel_for(kGrids, threads, [&](std::size_t g) {
    for (std::size_t chunk = g; chunk < chunks.size(); chunk += kGrids) grids[g].spread(chunks[chunk].points);
  });
  ResponseGrid sum = std::move(grids[0]);
  for (std::size_t g = 1; g < kGrids; ++g) sum.add(grids[g]);
  sum.transform();
  return sum;
}

}  // namespace seaglint
