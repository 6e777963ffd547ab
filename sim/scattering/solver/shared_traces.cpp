// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/shared_traces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "sim/scattering/solver/path_points.h"

namespace seaglint {
namespace {

constexpr double kMaxBasisTurn = radians(0.15);

}  // namespace

std::vector<SharedDirection> shared_directions(const PlannedPath& path, double served_rad, const SolverSpec& solver,
                                               Polarisation polarisation) {
  const bool is_copolar = polarisation == Polarisation::kHh || polarisation == Polarisation::kVv;
  if (!is_copolar || !path.geometry.monostatic || path.path.is_multipath() || solver.wavefront_range_m > 0) return {};
  if (path.look_path.max_change > served_rad / 8) return {};
  const RadarBasis& own = path.geometry.transmit;
  const DirectionLattice lattice(kSharedStep * served_rad);
  std::vector<SharedDirection> directions;
  for (const auto& [at, weight] : lattice.around(own.r)) {
    if (weight == 0) continue;
    const RadarBasis basis = radar_basis(lattice.vector(at));
    if (std::abs(std::atan2(own.h.dot(basis.v), own.h.dot(basis.h))) > kMaxBasisTurn) return {};
    directions.push_back({at, basis, weight});
  }
  return directions;
}

ResponseGrid grid_of_traces(std::span<const WeightedTrace> traces, const PlannedPath& path,
                            const WavenumberGrid& wavenumbers, double beside_m, int threads) {
  const LookDirectionPath& look = path.look_path;
  std::vector<ChunkPoints> chunks(kGrids * traces.size());
  parallel_for(chunks.size(), threads, [&](std::size_t chunk) {
    const auto& [trace, weight] = traces[chunk / kGrids];
    const RadarBasis& basis = trace->basis;
    // A gradient along h and v of this basis has the rates (a, b) . (h . w, v . w) along a direction w; for one antenna
    // both tangents of a track are equal.
    const auto rates = [&](const Vec3& w) { return Vec2(basis.h.dot(w), basis.v.dot(w)); };
    const Vec2 turn = rates(path.geometry.transmit.r - basis.r), along = rates(look.along_track.transmit),
               across = rates(look.cross_track.transmit);
    const std::size_t count = trace->points.size(), part = chunk % kGrids;
    std::vector<GridPoint>& points = chunks[chunk].points;
    points.reserve(count / kGrids + 1);
    for (std::size_t i = part * count / kGrids; i < (part + 1) * count / kGrids; ++i) {
      const SharedTrace::Point& point = trace->points[i];
      const Vec2 gradient(point.along_h, point.along_v);
      points.push_back({weight * Complex(point.amplitude), point.psi + gradient.dot(turn), gradient.dot(along),
                        gradient.dot(across)});
    }
  });
  return grid_of_points(chunks, look, wavenumbers, beside_m, threads);
}

SharedTrace make_shared_trace(const Scatterer& scatterer, const RadarBasis& basis, const SharedTraceKey& key,
                              double served_rad, const SolverSpec& solver, int threads, const StopFlag* stop) {
  const std::array pairs{monostatic(basis)};
  const TracingSettings settings = tracing_settings(solver);
  const std::array band{key.kc - key.half_band, key.kc, key.kc + key.half_band};
  const AspectTrace trace(scatterer, pairs, settings, band, threads);
  const PointSelection selection{
      {key.kc, 0.5 * served_rad}, key.half_band, min_amplitude(scatterer, settings, key.kc), key.channel, 0,
      slide_limit_m(scatterer)};
  struct alignas(64) Chunk {
    std::vector<SharedTrace::Point> points;
  };
  std::vector<Chunk> chunks(trace.chunk_count(0));
  const auto add = [&](std::size_t, std::size_t chunk, const auto& contributions) {
    for_each_point(contributions, pairs[0], selection, [&](const PointContribution& point) {
      const Complex amplitude = selection.amplitude(point, true);
      if (selection.is_faint(amplitude)) return;
      const Vec3 gradient = selection.limit(point.gradient) * point.gradient.sum();
      chunks[chunk].points.push_back({std::complex<float>(amplitude), point.psi,
                                      static_cast<float>(gradient.dot(basis.h)),
                                      static_cast<float>(gradient.dot(basis.v))});
    });
  };
  trace.run({add, add}, stop);
  SharedTrace shared{basis, {}};
  for (const Chunk& chunk : chunks) shared.points.insert(shared.points.end(), chunk.points.begin(), chunk.points.end());
  return shared;
}

bool SharedTraces::keep(const SharedTrace& trace) {
  const auto bytes = static_cast<std::int64_t>(sizeof(trace) + trace.points.size() * sizeof(SharedTrace::Point));
  if (memory_->free_bytes.fetch_sub(bytes) < bytes) {
    memory_->free_bytes += bytes;
    return false;
  }
  kept_bytes_ += bytes;
  return true;
}

std::shared_ptr<const SharedTrace> SharedTraces::get(const SharedTraceKey& key,
                                                     const std::function<SharedTrace()>& make) {
  return traces_.get(key, [&] {
    SharedTrace trace = make();
    if (!keep(trace)) traces_.forget(key);
    return trace;
  });
}

}  // namespace seaglint
