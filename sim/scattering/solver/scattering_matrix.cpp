// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/scattering_matrix.h"

#include <cmath>
#include <deque>

#include "sim/scattering/points/edge_decomposition.h"
#include "sim/scattering/points/finite_range.h"
#include "sim/scattering/scatterer/target_check.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "sim/scattering/sums/reciprocity.h"
#include "sim/scattering/sums/sweep_sum.h"

namespace seaglint {
namespace {

// radar.origin of the body's frame becomes that of the scatterer's coordinates.
RadarRange relative_to_centre(const Scatterer& scatterer, RadarRange radar) {
  radar.origin += scatterer.centre();
  return radar;
}

// The estimate with the phase referred to the body's origin.
ViewEstimate about_origin(const ViewEstimate& estimate, const Scatterer& scatterer, const BistaticGeometry& geometry) {
  const Complex phase = origin_phase(scatterer, geometry, estimate.wavenumber());
  ViewEstimate moved(estimate.wavenumber());
  moved.add(estimate, {phase, phase}, phase);
  return moved;
}

}  // namespace

Complex origin_phase(const Scatterer& scatterer, const BistaticGeometry& geometry, double k) {
  return std::polar(1.0, k * scatterer.centre().dot(geometry.transmit.r + geometry.receive.r));
}

double direction_spread(const Scatterer& scatterer, const RadarRange& radar) {
  const double reach = scatterer.radius() + radar.origin.norm();
  check_wavefront_range(reach, radar.range_m);
  return radar.range_m > 0 ? reach / radar.range_m : 0;
}

std::vector<Matrices> one_way_matrices(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs,
                                       std::span<const double> wavenumbers, const TracingSettings& settings,
                                       int threads, std::size_t* segments, const StopFlag* stop,
                                       const RadarRange& radar, std::vector<ViewEstimate>* estimates) {
  const RadarRange to_centre = relative_to_centre(scatterer, radar);
  const double spread = direction_spread(scatterer, to_centre);
  const SweepPlan plan(scatterer, wavenumbers);
  const AspectTrace trace(scatterer, pairs, settings, plan.nodes(), threads);
  std::deque<OrderedSweepSum> sums;
  const auto estimated = estimates ? std::optional(plan.middle()) : std::nullopt;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    sums.emplace_back(SweepSum(plan, pairs[i], to_centre, spread, estimated), trace.chunk_count(i));
  const auto add = [&](std::size_t pair, std::size_t chunk, const auto& contributions) {
    sums[pair].chunk(chunk).add(contributions);
  };
  const auto complete = [&](std::size_t pair, std::size_t chunk) { sums[pair].complete(chunk); };
  const std::size_t followed = trace.run({add, add, complete}, stop);
  if (segments) *segments += followed;
  std::vector<Matrices> matrices;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Matrices& sum = matrices.emplace_back(sums[i].matrices());
    for (std::size_t q = 0; q < wavenumbers.size(); ++q) {
      for (Complex& s : sum[q]) s *= origin_phase(scatterer, pairs[i], wavenumbers[q]);
    }
    if (estimates) estimates->push_back(about_origin(*sums[i].estimate(), scatterer, pairs[i]));
  }
  return matrices;
}

std::vector<Matrices> scattering_matrices(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs,
                                          std::span<const double> wavenumbers, const TracingSettings& settings,
                                          int threads, std::size_t* segments, const StopFlag* stop,
                                          const RadarRange& radar, std::vector<ViewEstimate>* estimates) {
  std::vector<Matrices> matrices =
      one_way_matrices(scatterer, pairs, wavenumbers, settings, threads, segments, stop, radar, estimates);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!(pairs[i].transmit == pairs[i].receive)) continue;
    for (auto& matrix : matrices[i]) matrix = reciprocal_mean(matrix, matrix);
  }
  return matrices;
}

Matrices scattering_matrices(const Scatterer& scatterer, const BistaticGeometry& geometry,
                             std::span<const double> wavenumbers, const TracingSettings& settings, int threads,
                             std::size_t* segments, const StopFlag* stop, const RadarRange& radar) {
  return scattering_matrices(scatterer, std::span(&geometry, 1), wavenumbers, settings, threads, segments, stop, radar)
      .front();
}

Matrices scattering_matrices_over_sea(const Scatterer& scatterer, const Vec3& r_hat, double height_m,
                                      const SeaReflection& sea, std::span<const double> wavenumbers,
                                      const TracingSettings& settings, int threads, std::size_t* segments,
                                      const StopFlag* stop, double range_m, ViewEstimate* estimate) {
  const RadarBasis radar = radar_basis(r_hat), image = image_basis(radar);
  std::vector<PropagationPath> paths;
  std::vector<BistaticGeometry> pairs;
  for (const PropagationPath& path : kFourPaths) {
    if (!sea.is_enabled(path)) continue;
    const RadarBasis &transmit = path.outbound_via_sea ? image : radar, &receive = path.return_via_sea ? image : radar;
    paths.push_back(path);
    pairs.push_back(path.outbound_via_sea == path.return_via_sea ? monostatic(transmit) : bistatic(transmit, receive));
  }
  std::vector<ViewEstimate> estimates;
  const auto matrices = scattering_matrices(scatterer, pairs, wavenumbers, settings, threads, segments, stop,
                                            {range_m, {0, 0, height_m}}, estimate ? &estimates : nullptr);
  if (estimate) *estimate = ViewEstimate(estimates.front().wavenumber());
  Matrices sum(wavenumbers.size());
  for (std::size_t w = 0; w < paths.size(); ++w) {
    const Matrices& exchanged = matrices[exchanged_pair(pairs, w).value()];
    // Phase relative to the body's origin at (0, 0, height): e^{jk (a + b - 2 r).(0, 0, height)}.
    const double detour =
        -2 * r_hat.z() * height_m * ((paths[w].outbound_via_sea ? 1 : 0) + (paths[w].return_via_sea ? 1 : 0));
    for (std::size_t q = 0; q < wavenumbers.size(); ++q) {
      const SeaReflectionCoefficients rho = sea.at(wavenumbers[q], r_hat.z());
      const Complex phase = std::polar(1.0, wavenumbers[q] * detour);
      const std::array<Complex, 4> matrix = reciprocal_mean(matrices[w][q], exchanged[q]);
      for (int i = 0; i < 4; ++i) sum[q][i] += SeaReflection::path_factor(paths[w], rho, i) * phase * matrix[i];
    }
    if (!estimate) continue;
    const double k = estimate->wavenumber();
    const SeaReflectionCoefficients rho = sea.at(k, r_hat.z());
    const auto factor = [&](int i) {
      return SeaReflection::path_factor(paths[w], rho, i) * std::polar(1.0, k * detour);
    };
    // hv and vh of one path that meets the sea once differ; those of both together do not.
    const bool is_mixed = paths[w].outbound_via_sea != paths[w].return_via_sea;
    estimate->add(estimates[w], {factor(0), factor(3)}, is_mixed ? 0.0 : factor(1));
  }
  return sum;
}

AspectContributions aspect_contributions(const Scatterer& scatterer, const BistaticGeometry& geometry,
                                         const DecompositionSettings& split_settings, const TracingSettings& settings,
                                         int threads, const StopFlag* stop, const RadarRange& radar) {
  const RadarRange to_centre = relative_to_centre(scatterer, radar);
  const double spread = direction_spread(scatterer, to_centre);
  DecompositionSettings edge_settings = split_settings;
  edge_settings.aspect_change_rad += spread;
  const std::array wavenumber{split_settings.kc};
  const SweepPlan plan(scatterer, wavenumber);
  const AspectTrace trace(scatterer, std::span(&geometry, 1), settings, wavenumber, threads);
  OrderedSweepSum sum(SweepSum(plan, geometry, to_centre, spread, plan.middle()), trace.chunk_count(0));
  std::vector<std::vector<PointContribution>> points(trace.chunk_count(0));
  AspectContributions all{{}, {}, 0, ViewEstimate(split_settings.kc)};
  all.segments = trace.run({[&](std::size_t, std::size_t chunk, std::span<const Footprint> footprints) {
                              sum.chunk(chunk).add(footprints);
                              for (const Footprint& footprint : footprints) {
                                if (radar.range_m > 0) {
                                  decompose_at_range(footprint, geometry, split_settings, to_centre, points[chunk]);
                                } else {
                                  decompose(footprint, geometry.transmit, split_settings, points[chunk]);
                                }
                              }
                            },
                            [&](std::size_t, std::size_t chunk, std::span<const EdgeContribution> contributions) {
                              sum.chunk(chunk).add(contributions);
                              std::vector<PointContribution>& of_chunk = points[chunk];
                              const std::size_t first = of_chunk.size();
                              for (const EdgeContribution& contribution : contributions)
                                decompose(contribution, edge_settings, of_chunk);
                              if (radar.range_m > 0)
                                apply_wavefront_curvature(std::span(of_chunk).subspan(first), geometry, to_centre);
                            },
                            [&](std::size_t, std::size_t chunk) { sum.complete(chunk); }},
                           stop);
  all.matrix = sum.matrices().front();
  all.estimate = about_origin(*sum.estimate(), scatterer, geometry);
  std::size_t count = 0;
  for (const std::vector<PointContribution>& of_chunk : points) count += of_chunk.size();
  all.points.reserve(count);
  for (std::vector<PointContribution>& of_chunk : points) {
    all.points.insert(all.points.end(), of_chunk.begin(), of_chunk.end());
    of_chunk = {};  // millions on a large target
  }
  if (geometry.transmit == geometry.receive) {
    all.matrix = reciprocal_mean(all.matrix, all.matrix);
    for (PointContribution& point : all.points) point.pattern = reciprocal_mean(point.pattern, point.pattern);
  }
  const Vec3& centre = scatterer.centre();
  for (Complex& s : all.matrix) s *= origin_phase(scatterer, geometry, split_settings.kc);
  for (PointContribution& point : all.points) {
    point.psi += centre.dot(geometry.transmit.r + geometry.receive.r);
    point.gradient.transmit += centre;
    point.gradient.receive += centre;
  }
  return all;
}

}  // namespace seaglint
