// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/solve.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scattering/observation/surface_propagation.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "sim/scattering/solver/trace_plan.h"
#include "sim/scattering/sums/response_grid.h"
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
    sums.emplace_back(SweepSum(plan, estimated, request.by_part), trace.chunk_count(pair));
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
    result.views.push_back({sum.matrices(), sum.estimate(), joined(std::move(points[pair])), sum.parts()});
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
    for (const auto& [part, matrices] : by_path.views[w].parts)
      view_result.parts.try_emplace(part, request.wavenumbers.size());
    for (std::size_t q = 0; q < request.wavenumbers.size(); ++q) {
      const ScatteringMatrix factor = factors(request.wavenumbers[q]);
      const auto add = [&](Matrices& to, const Matrices& from) {
        for (int i = 0; i < 4; ++i) to[q][i] += factor[i] * from[q][i];
      };
      add(view_result.matrices, by_path.views[w].matrices);
      for (const auto& [part, matrices] : by_path.views[w].parts) add(view_result.parts.at(part), matrices);
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

namespace {

// Response of the body over the propagation paths of one trace. The motion of the body's centre is not in it.
std::vector<ResponseGrid> trace_to_grids(const IntervalRequest& request, std::span<const PlannedPath> paths,
                                         const WavenumberGrid& wavenumbers, int threads) {
  const Scatterer& scatterer = request.scatterer;
  const double kc = wavenumbers.at(wavenumbers.centre_index());
  // Patterns are evaluated at the centre of the band and at equal distances on either side, the lower end among them.
  const double half_band = kc - wavenumbers.first;
  const std::array band{kc - half_band, kc, kc + half_band};
  const TracingSettings settings = tracing_settings(request.solver);
  const RadarRange radar{request.solver.wavefront_range_m};
  const int channel = static_cast<int>(request.polarisation);
  std::vector<BistaticGeometry> pairs;
  for (const PlannedPath& path : paths) pairs.push_back(path.geometry);
  // The two paths that meet the sea once are reciprocal: the cross-polarised response of each is the mean over both.
  const bool is_cross_polarised =
      request.polarisation == Polarisation::kHv || request.polarisation == Polarisation::kVh;
  const AspectTrace trace(scatterer, pairs, settings, band,
                          is_cross_polarised ? Reciprocity::kAllPairs : Reciprocity::kOneAntenna, threads);
  const IntervalLimits limits = interval_limits(scatterer, min_amplitude(scatterer, settings, kc));
  std::vector<Observation> observations;
  std::vector<IntervalSum> sums;
  for (std::size_t path = 0; path < paths.size(); ++path) {
    const LookDirectionPath& look = paths[path].look_path;
    observations.push_back({pairs[path], radar, direction_spread(scatterer, radar)});
    sums.emplace_back(look, PointBand{FrequencyBand(kc), 1, look.max_change, half_band}, limits, channel,
                      trace.chunk_count(path));
  }
  trace.run(
      [&](const PairContributions& from) {
        sums[from.pair].add(from.chunk, from.contributions, from.observed(observations[from.source]));
      },
      {}, request.stop);
  std::vector<ResponseGrid> grids;
  for (const IntervalSum& sum : sums) grids.push_back(sum.grid(wavenumbers, threads));
  return grids;
}

// Sea reflection coefficients per pulse and frequency of a moving radar, whose elevation changes; per frequency of a
// fixed one.
class SeaReflectionOverPulses {
 public:
  SeaReflectionOverPulses(const SeaReflection& sea, const TracePlan& plan, const IntervalSampling& sampling,
                          const WavenumberGrid& wavenumbers)
      : sampling_(sampling), moves_(!sampling.line_of_sight_rate.isZero(0)) {
    const int rows = moves_ ? static_cast<int>(sampling.pulse_first.size()) : 1;
    for (int n = 0; n < rows; ++n) {
      for (int b = 0; b < (moves_ ? sampling.frequencies_per_pulse : wavenumbers.count); ++b) {
        const double k = wavenumbers.at(moves_ ? sampling.pulse_first[n] + b : b);
        coefficients_.push_back(sea.at(k, plan.sight(n).radar.r.z()));
      }
    }
  }

  const SeaReflectionCoefficients& at(int pulse, int b) const {
    return coefficients_[static_cast<std::size_t>(moves_ ? pulse * sampling_.frequencies_per_pulse + b
                                                         : sampling_.pulse_first[pulse] + b)];
  }

 private:
  const IntervalSampling& sampling_;
  bool moves_;
  std::vector<SeaReflectionCoefficients> coefficients_;
};

// Half of the extent of a body along z about its centre, m.
double half_height(const Scatterer& scatterer) {
  double half = 0;
  for (const Facet& facet : scatterer.facets())
    for (const Vec3& corner : facet.corner) half = std::max(half, std::abs(corner.z()));
  return half;
}

}  // namespace

double default_aspect_change(const Scatterer& scatterer, double wavelength) {
  return std::min(radians(0.15), 3 * wavelength / scatterer.radius());
}

IntervalResult solve(const IntervalRequest& request) {
  const IntervalSampling& sampling = request.sampling;
  const int pulses = static_cast<int>(sampling.pulse_time_s.size());
  SEAGLINT_CHECK(pulses > 0 && sampling.pulse_first.size() == sampling.pulse_time_s.size(),
                 fmt::format("{} pulse times, {} bands", pulses, sampling.pulse_first.size()));
  constexpr double kToWavenumber = 2 * kPi / kSpeedOfLight;
  const WavenumberGrid wavenumbers{kToWavenumber * sampling.first_hz, kToWavenumber * sampling.step_hz, sampling.count};
  const double k_last = wavenumbers.at(wavenumbers.count - 1), kc = wavenumbers.at(wavenumbers.centre_index());
  const double served = request.solver.max_aspect_change_deg > 0
                            ? radians(request.solver.max_aspect_change_deg)
                            : default_aspect_change(request.scatterer, 2 * kPi / kc);
  const IntervalLimits limits = interval_limits(request.scatterer, 0);
  const std::vector<PropagationPath> paths = propagation_paths(request.sea);
  const TracePlan plan(
      {request.trajectory, sampling, request.r_hat, request.solver.wavefront_range_m, request.scatterer.centre()},
      paths, {served, kMaxCrossTrackPhase / (k_last * limits.cross_track_m)});

  // Traces in parallel before facets in parallel, which needs fewer synchronisations.
  const int threads = std::max(1, request.threads);
  const auto traces = plan.traces();
  const int side_by_side = std::min(threads, static_cast<int>(traces.size()));
  std::vector<std::vector<ResponseGrid>> returns(traces.size());  // [trace][propagation path]
  parallel_for(
      traces.size(), side_by_side,
      [&](std::size_t i) {
        returns[i] = trace_to_grids(request, traces[i].paths, wavenumbers, std::max(1, threads / side_by_side));
      },
      request.stop);

  IntervalResult result;
  result.response.pulses = pulses;
  result.response.frequencies_per_pulse = sampling.frequencies_per_pulse;
  result.response.values.assign(static_cast<std::size_t>(pulses) * sampling.frequencies_per_pulse, 0.0);
  std::optional<SeaReflectionOverPulses> reflection;
  if (request.sea != nullptr) reflection.emplace(*request.sea, plan, sampling, wavenumbers);
  std::optional<OneWayAmplitudes> over_waves;
  if (request.sea != nullptr && request.sea->waves() != nullptr) {
    const auto centre = [&](double time_s) {
      const Pose pose = request.trajectory.pose(time_s);
      return pose.p + pose.R * request.scatterer.centre();
    };
    over_waves.emplace(*request.sea,
                       BodyOverWaves{centre, half_height(request.scatterer), request.solver.wavefront_range_m},
                       sampling, request.r_hat, threads, request.stop);
  }
  const int channel = static_cast<int>(request.polarisation);
  std::vector<Complex> values(static_cast<std::size_t>(sampling.frequencies_per_pulse));
  for (std::size_t i = 0; i < traces.size(); ++i) {
    for (std::size_t w = 0; w < traces[i].paths.size(); ++w) {
      const auto& [path, geometry, moves] = traces[i].paths[w];
      ++result.traces;
      for (int n = traces[i].first; n <= traces[i].last; ++n) {
        const auto at = static_cast<std::size_t>(n - traces[i].first);
        returns[i][w].response(sampling.pulse_first[n], moves.s[at], moves.q[at], values);
        // Motion of the body's centre: e^{jk (a + b).p} with the look directions a and b of the two paths, or by the
        // distances to a radar at a finite range; exact for every pulse and frequency.
        const double origin_path = plan.path_advance(path, n);
        for (int b = 0; b < sampling.frequencies_per_pulse; ++b) {
          const int q = sampling.pulse_first[n] + b;
          const Complex by_sea = over_waves            ? SeaReflection::path_factor(path, over_waves->at(n, b), channel)
                                 : path.is_multipath() ? SeaReflection::path_factor(path, reflection->at(n, b), channel)
                                                       : 1.0;
          result.response.at(n, b) +=
              plan.interpolation_weight(i, n) * by_sea * std::polar(1.0, wavenumbers.at(q) * origin_path) * values[b];
        }
      }
    }
  }
  return result;
}

}  // namespace seaglint
