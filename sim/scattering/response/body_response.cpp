// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/response/body_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scattering/edges/edge_diffraction.h"
#include "sim/scattering/response/response_grid.h"
#include "sim/scattering/response/trace_plan.h"
#include "sim/scattering/surfaces/point_contributions.h"
#include "sim/scattering/target/target_check.h"

namespace seaglint {
namespace {

// The radar stands in directions that differ by this much over the target, rad; 0 in the far field. Throws InputError
// when it is too near.
double spread_of_directions(const Scatterer& scatterer, double range_m, const Vec3& origin = Vec3::Zero()) {
  const double reach = scatterer.radius() + origin.norm();
  check_range(reach, range_m);
  return range_m > 0 ? reach / range_m : 0;
}

// Body-fixed points go no faster than this beside a track, m, its two parts having unit length together. Shadow edges
// that do are faint.
double beside_limit(const Scatterer& scatterer) { return std::numbers::sqrt2 * scatterer.radius(); }

// What one chunk of panels or edges adds, in cache lines of its own: threads fill neighbouring chunks side by side.
struct alignas(64) ChunkPoints {
  std::vector<ReturnPoint> points;
  double fastest = 0;  // largest |u|, m
};

// One trace: what the body answers by one way. At a finite range the wavefront is bent about the body's own origin,
// from which the way sees the radar.
ReturnGrid trace_returns(const Scatterer& scatterer, const PlannedWay& way, const WavenumberGrid& wavenumbers,
                         int channel, const SolverSpec& solver, int threads) {
  const AntennaPair& antennas = way.antennas;
  const DirectionPath& path = way.moves;
  // A shadow edge at grazing runs along its facet much faster than any point of the body moves. Beyond four times the
  // body's size its speed is cut: such ends are faint and run through many velocity cells.
  const double limit = 8 * scatterer.radius();
  const double kc = wavenumbers.at(wavenumbers.centre_index());
  // Materials are met at the band's middle and at as far to either side as its lower end lies.
  const double half_band = kc - wavenumbers.first;
  const std::array band{kc - half_band, kc, kc + half_band};
  const IlluminationSettings settings{solver.ray_spacing_m, solver.max_bounces, solver.edges};
  const Illumination illumination(scatterer, antennas, settings, threads, band);
  const SplitSettings split_settings{kc, path.turn + spread_of_directions(scatterer, solver.radar_range_m)};
  const std::size_t chunks = illumination.chunk_count();
  const std::size_t all_chunks = chunks + kEdgeChunks;  // the last ones are those of the edges
  // Half of all points, ends of currents that fade or run out of phase, are fainter.
  const double faint = faintest_echo(scatterer, settings, kc);
  std::vector<ChunkPoints> points(all_chunks);
  const auto keep = [&](std::size_t chunk, std::span<Contribution> contributions) {
    if (solver.radar_range_m > 0) bend_wavefront(contributions, antennas, Vec3::Zero(), solver.radar_range_m);
    for (const Contribution& c : contributions) {
      const Complex amplitude = c.amplitude * Complex(c.pattern[channel]);
      if (std::norm(amplitude) < faint * faint) continue;
      const double cut = std::min(1.0, limit / c.gradient.sum().norm());
      const double u = cut * path.track.speed(c.gradient), v = cut * path.bend.speed(c.gradient);
      points[chunk].points.push_back({amplitude, c.psi, u, v});
      points[chunk].fastest = std::max(points[chunk].fastest, std::abs(u));
    }
  };
  const auto keep_edges = [&](std::size_t chunk, std::span<const EdgeFootprint> footprints) {
    std::vector<Contribution> contributions;
    for (const EdgeFootprint& footprint : footprints) {
      contributions.clear();
      split(footprint, split_settings, contributions);
      keep(chunk, contributions);
    }
  };
  const Reached reached = illumination.light_all(threads, [&](std::size_t chunk, const PanelEchoes& echoes) {
    std::vector<Contribution> contributions;
    for (const Footprint& footprint : echoes.footprints) {
      contributions.clear();
      split_over_band(footprint, antennas.transmit, split_settings, half_band, contributions);
      keep(chunk, contributions);
    }
    keep_edges(chunk, echoes.beam_ends);
  });
  edge_echoes(
      scatterer, antennas, settings, band, reached.arrivals, threads,
      [&](std::size_t chunk, std::span<const EdgeFootprint> footprints) { keep_edges(chunks + chunk, footprints); });
  double fastest = 0;
  for (const ChunkPoints& chunk : points) fastest = std::max(fastest, chunk.fastest);
  const GridLimits limits{fastest, path.s_limit, beside_limit(scatterer), path.q_limit};
  // Four grids, whatever the number of threads, each for every fourth chunk; their sum is taken in order.
  constexpr std::size_t kGrids = 4;
  std::vector<ReturnGrid> grids(kGrids, ReturnGrid(wavenumbers, limits));
  parallel_for(kGrids, threads, [&](std::size_t g) {
    for (std::size_t chunk = g; chunk < all_chunks; chunk += kGrids) grids[g].spread(points[chunk].points);
  });
  ReturnGrid grid = std::move(grids[0]);
  for (std::size_t g = 1; g < kGrids; ++g) grid.add(grids[g]);
  grid.transform();
  return grid;
}

// The sea's coefficients at every pulse's frequencies: they follow the elevation of a radar that moves; of one that
// stands they are formed once per frequency.
class MirrorOverPulses {
 public:
  MirrorOverPulses(const SeaMirror& sea, const TracePlan& plan, const IntervalSampling& sampling,
                   const WavenumberGrid& wavenumbers)
      : sampling_(sampling), moves_(!sampling.sight_rate.isZero(0)) {
    const int rows = moves_ ? static_cast<int>(sampling.pulse_first.size()) : 1;
    for (int n = 0; n < rows; ++n) {
      for (int b = 0; b < (moves_ ? sampling.per_pulse : wavenumbers.count); ++b) {
        const double k = wavenumbers.at(moves_ ? sampling.pulse_first[n] + b : b);
        coefficients_.push_back(sea.at(k, plan.sight(n).radar.r.z()));
      }
    }
  }

  const SeaCoefficients& at(int pulse, int b) const {
    return coefficients_[static_cast<std::size_t>(moves_ ? pulse * sampling_.per_pulse + b
                                                         : sampling_.pulse_first[pulse] + b)];
  }

 private:
  const IntervalSampling& sampling_;
  bool moves_;
  std::vector<SeaCoefficients> coefficients_;
};

}  // namespace

double default_turn(const Scatterer& scatterer, double wavelength) {
  return std::min(radians(0.15), 3 * wavelength / scatterer.radius());
}

BodyResponse respond(const Scatterer& scatterer, const Trajectory& trajectory, const Vec3& r_hat,
                     Polarisation polarisation, const IntervalSampling& sampling, const SolverSpec& solver, int threads,
                     const SeaMirror* sea) {
  const int pulses = static_cast<int>(sampling.pulse_time_s.size());
  SEAGLINT_CHECK(pulses > 0 && sampling.pulse_first.size() == sampling.pulse_time_s.size(),
                 fmt::format("{} pulse times, {} bands", pulses, sampling.pulse_first.size()));
  const int channel = static_cast<int>(polarisation);
  constexpr double kToWavenumber = 2 * kPi / kSpeedOfLight;
  const WavenumberGrid wavenumbers{kToWavenumber * sampling.first_hz, kToWavenumber * sampling.step_hz, sampling.count};
  const double k_last = wavenumbers.at(wavenumbers.count - 1), kc = wavenumbers.at(wavenumbers.centre_index());

  std::vector<SeaPath> paths;
  for (const SeaPath& path : kSeaPaths) {
    if (sea == nullptr ? !path.multipath() : sea->wanted(path)) paths.push_back(path);
  }
  const double served = solver.max_turn_deg > 0 ? radians(solver.max_turn_deg) : default_turn(scatterer, 2 * kPi / kc);
  const TracePlan plan(trajectory, sampling, r_hat, solver.radar_range_m, paths,
                       {served, kMostBesidePhase / (k_last * beside_limit(scatterer))});

  // Traces side by side before facets side by side: the threads then meet less often.
  threads = std::max(1, threads);
  const auto traces = plan.traces();
  const int side_by_side = std::min(threads, static_cast<int>(traces.size()));
  std::vector<std::vector<ReturnGrid>> returns(traces.size());  // by trace and way
  parallel_for(traces.size(), side_by_side, [&](std::size_t i) {
    for (const PlannedWay& way : traces[i].ways) {
      returns[i].push_back(
          trace_returns(scatterer, way, wavenumbers, channel, solver, std::max(1, threads / side_by_side)));
    }
  });

  BodyResponse result;
  result.response.pulses = pulses;
  result.response.per_pulse = sampling.per_pulse;
  result.response.values.assign(static_cast<std::size_t>(pulses) * sampling.per_pulse, 0.0);
  std::optional<MirrorOverPulses> mirror;
  if (sea != nullptr) mirror.emplace(*sea, plan, sampling, wavenumbers);
  std::vector<Complex> answer(static_cast<std::size_t>(sampling.per_pulse));
  for (std::size_t i = 0; i < traces.size(); ++i) {
    for (std::size_t w = 0; w < traces[i].ways.size(); ++w) {
      const auto& [path, antennas, moves] = traces[i].ways[w];
      ++result.traces;
      for (int n = traces[i].first; n <= traces[i].last; ++n) {
        const auto at = static_cast<std::size_t>(n - traces[i].first);
        returns[i][w].response(sampling.pulse_first[n], moves.s[at], moves.q[at], answer);
        // The body's origin moves too: e^{jk (a + b).p} with the directions a and b of either way, of a radar at a
        // finite range by its distances, exact for every pulse and frequency.
        const double origin_path = plan.gain(path, n);
        for (int b = 0; b < sampling.per_pulse; ++b) {
          const int q = sampling.pulse_first[n] + b;
          const Complex by_sea = path.multipath() ? SeaMirror::weight(path, mirror->at(n, b), channel) : 1.0;
          result.response.at(n, b) +=
              plan.share(i, n) * by_sea * std::polar(1.0, wavenumbers.at(q) * origin_path) * answer[b];
        }
      }
    }
  }
  return result;
}

std::vector<std::array<Complex, 4>> scattering_matrices(const Scatterer& scatterer, const AntennaPair& antennas,
                                                        std::span<const double> wavenumbers,
                                                        const IlluminationSettings& settings, int threads,
                                                        std::size_t* legs, const StopFlag* stop) {
  using Matrices = std::vector<std::array<Complex, 4>>;
  const double spread = spread_of_directions(scatterer, settings.range_m, settings.origin);
  // At a finite range closed forms give way to points, which the wavefront moves one by one.
  const auto bent = [&](std::vector<Contribution>& points, double k) {
    bend_wavefront(points, antennas, settings.origin, settings.range_m);
    return direct_sum(points, k, Vec3::Zero());
  };
  const auto of_facet = [&](Footprint footprint, std::size_t q) {
    if (settings.range_m <= 0) return scattered(footprint, wavenumbers[q], q);
    if (!footprint.patterns.empty()) footprint.pattern = footprint.patterns[q];
    std::vector<Contribution> points;
    split(footprint, antennas.transmit, {wavenumbers[q], spread}, points);
    return bent(points, wavenumbers[q]);
  };
  const auto of_edge = [&](const EdgeFootprint& footprint, double k) {
    if (settings.range_m <= 0) return scattered(footprint, k);
    std::vector<Contribution> points;
    split(footprint, {k, spread}, points);
    return bent(points, k);
  };
  const auto add = [](const std::array<Complex, 4>& s, std::array<Complex, 4>& sum) {
    for (int i = 0; i < 4; ++i) sum[i] += s[i];
  };

  const Illumination illumination(scatterer, antennas, settings, threads, wavenumbers);
  const std::size_t facet_parts = illumination.chunk_count();
  std::vector<Matrices> parts(facet_parts + kEdgeChunks, Matrices(wavenumbers.size()));
  const auto add_edges = [&](std::span<const EdgeFootprint> footprints, Matrices& sum) {
    for (const EdgeFootprint& footprint : footprints) {
      for (std::size_t q = 0; q < wavenumbers.size(); ++q) add(of_edge(footprint, wavenumbers[q]), sum[q]);
    }
  };
  const Reached reached = illumination.light_all(
      threads,
      [&](std::size_t chunk, const PanelEchoes& echoes) {
        for (const Footprint& footprint : echoes.footprints) {
          for (std::size_t q = 0; q < wavenumbers.size(); ++q) add(of_facet(footprint, q), parts[chunk][q]);
        }
        add_edges(echoes.beam_ends, parts[chunk]);
      },
      stop);
  if (legs) *legs += reached.legs;
  edge_echoes(scatterer, antennas, settings, wavenumbers, reached.arrivals, threads,
              [&](std::size_t chunk, std::span<const EdgeFootprint> footprints) {
                add_edges(footprints, parts[facet_parts + chunk]);
              });
  Matrices sum(wavenumbers.size());
  for (const Matrices& part : parts) {
    for (std::size_t q = 0; q < wavenumbers.size(); ++q) add(part[q], sum[q]);
  }
  return sum;
}

std::vector<Contribution> view_contributions(const Scatterer& scatterer, const AntennaPair& antennas,
                                             const SplitSettings& split_settings, const IlluminationSettings& settings,
                                             int threads, const StopFlag* stop) {
  SplitSettings bent = split_settings;
  bent.turn_rad += spread_of_directions(scatterer, settings.range_m, settings.origin);
  const Illumination illumination(scatterer, antennas, settings, threads, std::array{split_settings.kc});
  const std::size_t facet_chunks = illumination.chunk_count();
  std::vector<std::vector<Contribution>> chunks(facet_chunks + kEdgeChunks);
  const Reached reached = illumination.light_all(
      threads,
      [&](std::size_t chunk, const PanelEchoes& echoes) {
        for (const Footprint& footprint : echoes.footprints) split(footprint, antennas.transmit, bent, chunks[chunk]);
        for (const EdgeFootprint& end : echoes.beam_ends) split(end, bent, chunks[chunk]);
      },
      stop);
  edge_echoes(scatterer, antennas, settings, std::array{split_settings.kc}, reached.arrivals, threads,
              [&](std::size_t chunk, std::span<const EdgeFootprint> footprints) {
                for (const EdgeFootprint& footprint : footprints) split(footprint, bent, chunks[facet_chunks + chunk]);
              });
  std::vector<Contribution> all;
  for (const auto& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
  if (settings.range_m > 0) bend_wavefront(all, antennas, settings.origin, settings.range_m);
  return all;
}

}  // namespace seaglint
