// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/body_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "sim/scattering/solver/path_points.h"
#include "sim/scattering/solver/scattering_matrix.h"
#include "sim/scattering/solver/trace_plan.h"
#include "sim/scattering/sums/reciprocity.h"
#include "sim/scattering/sums/response_grid.h"

namespace seaglint {
namespace {

// Points of the contributions of one propagation path, with their rates along its look-direction path.
class PathPoints {
 public:
  PathPoints(const LookDirectionPath& path, const PointSelection& selection, std::size_t slots)
      : path_(path), selection_(selection), chunks_(slots) {}

  // Contributions of one trace to the path, into one slot.
  struct Source {
    std::size_t slot;
    const BistaticGeometry& traced;  // this path's, or that with the antennas exchanged
    bool is_exchanged;
    double weight;
  };
  template <class Contributions>
  void add(const Source& source, const Contributions& contributions) {
    for_each_point(contributions, source.traced, selection_, [&](PointContribution& point) {
      if (source.is_exchanged) exchange_antennas(point);
      const Complex amplitude = source.weight * selection_.amplitude(point, source.traced.monostatic);
      if (selection_.is_faint(amplitude)) return;
      const double cut = selection_.limit(point.gradient);
      chunks_[source.slot].points.push_back({amplitude, point.psi, cut * path_.along_track.path_rate(point.gradient),
                                             cut * path_.cross_track.path_rate(point.gradient)});
    });
  }

  // Their sum over the band and the look directions of the path.
  ResponseGrid grid(const WavenumberGrid& wavenumbers, double beside_m, int threads) const {
    return grid_of_points(chunks_, path_, wavenumbers, beside_m, threads);
  }

 private:
  const LookDirectionPath& path_;
  PointSelection selection_;
  std::vector<ChunkPoints> chunks_;  // by slot
};

// Response of the body over the propagation paths of one trace.
std::vector<ResponseGrid> trace_to_grid(const Scatterer& scatterer, std::span<const PlannedPath> paths,
                                        const WavenumberGrid& wavenumbers, int channel, const SolverSpec& solver,
                                        int threads, const StopFlag* stop) {
  const double kc = wavenumbers.at(wavenumbers.centre_index());
  // Materials are evaluated at the centre of the band and at equal distances on either side, the lower end among them.
  const double half_band = kc - wavenumbers.first;
  const std::array band{kc - half_band, kc, kc + half_band};
  const TracingSettings settings = tracing_settings(solver);
  std::vector<BistaticGeometry> pairs;
  for (const PlannedPath& path : paths) pairs.push_back(path.geometry);
  const AspectTrace trace(scatterer, pairs, settings, band, threads);
  const double faint = min_amplitude(scatterer, settings, kc);
  // The two paths that meet the sea once are reciprocal: the cross-polarised response of each is the mean over both.
  const bool is_cross_polarised =
      channel == static_cast<int>(Polarisation::kHv) || channel == static_cast<int>(Polarisation::kVh);
  std::vector<std::optional<std::size_t>> shared(pairs.size());  // path that shares the contributions of another
  for (std::size_t path = 0; is_cross_polarised && path < pairs.size(); ++path) {
    if (!pairs[path].monostatic) shared[path] = exchanged_pair(pairs, path);
  }
  std::vector<PathPoints> points;
  for (std::size_t path = 0; path < paths.size(); ++path) {
    const std::size_t from_exchanged = shared[path] ? trace.chunk_count(*shared[path]) : 0;
    const LookDirectionPath& look = paths[path].look_path;
    const double range_m = solver.wavefront_range_m;
    points.emplace_back(look,
                        PointSelection{{kc, look.max_change + direction_spread(scatterer, {range_m})},
                                       half_band,
                                       faint,
                                       channel,
                                       range_m,
                                       slide_limit_m(scatterer)},
                        trace.chunk_count(path) + from_exchanged);
  }
  const auto add = [&](std::size_t path, std::size_t chunk, const auto& contributions) {
    const double weight = shared[path] ? 0.5 : 1;
    points[path].add({chunk, pairs[path], false, weight}, contributions);
    if (!shared[path]) return;
    const std::size_t exchanged = *shared[path];
    points[exchanged].add({trace.chunk_count(exchanged) + chunk, pairs[path], true, weight}, contributions);
  };
  trace.run({add, add}, stop);
  std::vector<ResponseGrid> grids;
  for (const PathPoints& of_path : points)
    grids.push_back(of_path.grid(wavenumbers, cross_track_limit_m(scatterer), threads));
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

}  // namespace

double default_aspect_change(const Scatterer& scatterer, double wavelength) {
  return std::min(radians(0.15), 3 * wavelength / scatterer.radius());
}

BodyResponse body_response(const Scatterer& scatterer, const Trajectory& trajectory, const Vec3& r_hat,
                           Polarisation polarisation, const IntervalSampling& sampling, const SolverSpec& solver,
                           int threads, const SeaReflection* sea, const StopFlag* stop, SharedTraces* shared) {
  const int pulses = static_cast<int>(sampling.pulse_time_s.size());
  SEAGLINT_CHECK(pulses > 0 && sampling.pulse_first.size() == sampling.pulse_time_s.size(),
                 fmt::format("{} pulse times, {} bands", pulses, sampling.pulse_first.size()));
  const int channel = static_cast<int>(polarisation);
  constexpr double kToWavenumber = 2 * kPi / kSpeedOfLight;
  const WavenumberGrid wavenumbers{kToWavenumber * sampling.first_hz, kToWavenumber * sampling.step_hz, sampling.count};
  const double k_last = wavenumbers.at(wavenumbers.count - 1), kc = wavenumbers.at(wavenumbers.centre_index());

  std::vector<PropagationPath> paths;
  for (const PropagationPath& path : kFourPaths) {
    if (sea == nullptr ? !path.is_multipath() : sea->is_enabled(path)) paths.push_back(path);
  }
  const double served = solver.max_aspect_change_deg > 0 ? radians(solver.max_aspect_change_deg)
                                                         : default_aspect_change(scatterer, 2 * kPi / kc);
  const TracePlan plan(trajectory, sampling, r_hat, solver.wavefront_range_m, paths,
                       {served, kMaxCrossTrackPhase / (k_last * cross_track_limit_m(scatterer))}, scatterer.centre());

  // Traces in parallel before facets in parallel, which needs fewer synchronisations.
  threads = std::max(1, threads);
  const auto traces = plan.traces();
  const int side_by_side = std::min(threads, static_cast<int>(traces.size()));
  std::vector<std::vector<ResponseGrid>> returns(traces.size());  // [trace][propagation path]
  parallel_for(
      traces.size(), side_by_side,
      [&](std::size_t i) {
        const int inner = std::max(1, threads / side_by_side);
        std::vector<SharedDirection> directions;
        if (solver.shared_traces && traces[i].paths.size() == 1)
          directions = shared_directions(traces[i].paths.front(), served, solver, polarisation);
        if (!directions.empty()) {
          std::vector<WeightedTrace> around;
          for (const SharedDirection& direction : directions) {
            const SharedTraceKey key{direction.at, kc, kc - wavenumbers.first, channel};
            const auto make = [&] {
              return make_shared_trace(scatterer, direction.basis, key, served, solver, inner, stop);
            };
            around.push_back({shared != nullptr ? shared->get(key, make) : std::make_shared<const SharedTrace>(make()),
                              direction.weight});
          }
          returns[i].push_back(
              grid_of_traces(around, traces[i].paths.front(), wavenumbers, cross_track_limit_m(scatterer), inner));
        } else {
          returns[i] = trace_to_grid(scatterer, traces[i].paths, wavenumbers, channel, solver, inner, stop);
        }
      },
      stop);

  BodyResponse result;
  result.response.pulses = pulses;
  result.response.frequencies_per_pulse = sampling.frequencies_per_pulse;
  result.response.values.assign(static_cast<std::size_t>(pulses) * sampling.frequencies_per_pulse, 0.0);
  std::optional<SeaReflectionOverPulses> reflection;
  if (sea != nullptr) reflection.emplace(*sea, plan, sampling, wavenumbers);
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
          const Complex by_sea =
              path.is_multipath() ? SeaReflection::path_factor(path, reflection->at(n, b), channel) : 1.0;
          result.response.at(n, b) +=
              plan.interpolation_weight(i, n) * by_sea * std::polar(1.0, wavenumbers.at(q) * origin_path) * values[b];
        }
      }
    }
  }
  return result;
}

}  // namespace seaglint
