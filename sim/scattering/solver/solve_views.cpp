// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <deque>

#include "sim/core/process/error.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "sim/scattering/solver/solve.h"
#include "sim/scattering/sums/sweep_sum.h"

namespace seaglint {
namespace {

// Points of one pair, by chunk.
using ChunkPoints = std::vector<std::vector<Point>>;

std::vector<Point> joined(ChunkPoints chunks) {
  std::size_t count = 0;
  for (const std::vector<Point>& chunk : chunks) count += chunk.size();
  std::vector<Point> all;
  all.reserve(count);
  for (std::vector<Point>& chunk : chunks) {
    all.insert(all.end(), chunk.begin(), chunk.end());
    chunk = {};  // millions on a large target
  }
  return all;
}

SolveResult solve_without_sea(const SolveRequest& request, std::span<const BistaticGeometry> pairs,
                              const RadarRange& radar, Reciprocity reciprocity) {
  const Scatterer& scatterer = request.scatterer;
  const SweepPlan plan(scatterer, request.wavenumbers);
  const AspectTrace trace(scatterer, pairs, request.settings, plan.nodes(), reciprocity, request.threads);
  const auto estimated = request.estimates ? std::optional(plan.middle()) : std::nullopt;
  std::vector<Observation> observations;
  std::deque<OrderedSum<SweepSum>> sums;
  std::vector<ChunkPoints> points(pairs.size());
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    observations.push_back(observation_of(scatterer, pairs[pair], radar));
    sums.emplace_back(SweepSum(plan, estimated), trace.chunk_count(pair));
    if (request.points_for_rad) points[pair].resize(trace.chunk_count(pair));
  }
  SolveResult result;
  result.segments = trace.run(
      [&](const PairContributions& from) {
        const Observation observed = from.observed(observations[from.source]);
        sums[from.pair].chunk(from.chunk).add(from.contributions, observed);
        if (!request.points_for_rad) return;
        const PointBand at{FrequencyBand(request.wavenumbers.front()), 0, *request.points_for_rad};
        for (const Contribution& contribution : from.contributions)
          decompose(contribution, observed, at, points[from.pair][from.chunk]);
      },
      [&](std::size_t pair, std::size_t chunk) { sums[pair].complete(chunk); }, request.stop);
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    const SweepSum& sum = sums[pair].sum();
    result.views.push_back({sum.matrices(), sum.estimate(), joined(std::move(points[pair]))});
  }
  return result;
}

// S = sum over the paths of rho_p rho_q S(path) (sea_reflection.h), relative to the phase of the body's origin at
// (0, 0, height): e^{jk (a + b - 2 r).(0, 0, height)}.
ViewResult over_sea(const SolveRequest& request, const BistaticGeometry& view, std::size_t& segments) {
  const SeaReflection& sea = request.sea->reflection;
  const double height_m = request.sea->height_m, sin_grazing = view.receive.r.z();
  const RadarBasis radar = radar_basis(view.receive.r);
  const std::vector<PropagationPath> paths = propagation_paths(&sea);
  std::vector<BistaticGeometry> pairs;
  for (const PropagationPath& path : paths) pairs.push_back(antennas_on(path, radar, image_basis(radar)));
  const SolveResult by_path = solve_without_sea(request, pairs, {request.radar.range_m, {0, 0, height_m}},
                                                request.one_way ? Reciprocity::kNone : Reciprocity::kAllPairs);
  segments += by_path.segments;
  ViewResult view_result;
  view_result.matrices.resize(request.wavenumbers.size());
  if (request.estimates) view_result.estimate.emplace(by_path.views.front().estimate->wavenumber());
  for (std::size_t w = 0; w < paths.size(); ++w) {
    const PropagationPath& path = paths[w];
    const double detour =
        -2 * sin_grazing * height_m * ((path.outbound_via_sea ? 1 : 0) + (path.return_via_sea ? 1 : 0));
    const auto factors = [&](double k) {
      const SeaReflectionCoefficients rho = sea.at(k, sin_grazing);
      ScatteringMatrix factor;
      for (int i = 0; i < 4; ++i) factor[i] = SeaReflection::path_factor(path, rho, i) * std::polar(1.0, k * detour);
      return factor;
    };
    for (std::size_t q = 0; q < request.wavenumbers.size(); ++q) {
      const ScatteringMatrix factor = factors(request.wavenumbers[q]);
      for (int i = 0; i < 4; ++i) view_result.matrices[q][i] += factor[i] * by_path.views[w].matrices[q][i];
    }
    if (!request.estimates) continue;
    // hv and vh of one path that meets the sea once differ; those of both together do not.
    const ScatteringMatrix factor = factors(view_result.estimate->wavenumber());
    const bool is_mixed = path.outbound_via_sea != path.return_via_sea;
    view_result.estimate->add(*by_path.views[w].estimate, {factor[0], factor[3]}, is_mixed ? 0.0 : factor[1]);
  }
  return view_result;
}

}  // namespace

SolveResult solve(const SolveRequest& request) {
  SEAGLINT_CHECK(!request.points_for_rad || (request.wavenumbers.size() == 1 && !request.sea),
                 "points of one wavenumber without the sea");
  if (!request.sea)
    return solve_without_sea(request, request.views, request.radar,
                             request.one_way ? Reciprocity::kNone : Reciprocity::kOneAntenna);
  SolveResult result;
  for (const BistaticGeometry& view : request.views) result.views.push_back(over_sea(request, view, result.segments));
  return result;
}

}  // namespace seaglint
