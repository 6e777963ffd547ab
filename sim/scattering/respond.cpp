// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/respond.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/scattering/contributions.h"
#include "sim/scattering/direction_path.h"
#include "sim/scattering/edge_echoes.h"
#include "sim/scattering/passing_radar.h"
#include "sim/scattering/return_grid.h"
#include "sim/scattering/target_check.h"

namespace seaglint {
namespace {

// The radar stands in directions that differ by this much over the target, rad; 0 in the far field. Throws InputError
// when it is too near.
double spread_of_directions(const Scatterer& scatterer, double range_m) {
  check_range(scatterer.radius(), range_m);
  return range_m > 0 ? scatterer.radius() / range_m : 0;
}

// The world's polarisation basis as the turned body sees it.
RadarBasis body_basis(const RadarBasis& world, const Pose& pose) {
  const Mat3 R_BT = pose.R_TB.transpose();
  return {R_BT * world.r, R_BT * world.h, R_BT * world.v};
}

// Body-fixed points go no faster than this beside a track, m: shadow edges that do are faint.
double beside_limit(const Scatterer& scatterer) { return 2 * scatterer.radius(); }

// One trace: what the body answers while its directions move by `path`. `origin`: where the body stands from the point
// that the radar's range is counted from, body frame.
ReturnGrid trace_returns(const Scatterer& scatterer, const AntennaPair& antennas, const DirectionPath& path,
                         const Vec3& origin, const WavenumberGrid& wavenumbers, int channel, const SolverSpec& solver,
                         int threads) {
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
  std::vector<std::vector<ReturnPoint>> points(all_chunks);
  std::vector<double> fastest(all_chunks, 0);
  const auto keep = [&](std::size_t chunk, std::span<Contribution> contributions) {
    if (solver.radar_range_m > 0) bend_wavefront(contributions, antennas, origin, solver.radar_range_m);
    for (const Contribution& c : contributions) {
      const Complex amplitude = c.amplitude * Complex(c.pattern[channel]);
      if (amplitude == 0.0) continue;
      const double cut = std::min(1.0, limit / c.gradient.sum().norm());
      const double u = cut * path.track.speed(c.gradient), v = cut * path.bend.speed(c.gradient);
      points[chunk].push_back({amplitude, c.psi, u, v});
      fastest[chunk] = std::max(fastest[chunk], std::abs(u));
    }
  };
  const Reached reached =
      illumination.light_all(threads, [&](std::size_t chunk, std::span<const Footprint> footprints) {
        std::vector<Contribution> contributions;
        for (const Footprint& footprint : footprints) {
          contributions.clear();
          split_over_band(footprint, antennas.transmit, split_settings, half_band, contributions);
          keep(chunk, contributions);
        }
      });
  edge_echoes(scatterer, antennas, settings, band, reached.arrivals, threads,
              [&](std::size_t chunk, std::span<const EdgeFootprint> footprints) {
                std::vector<Contribution> contributions;
                for (const EdgeFootprint& footprint : footprints) {
                  contributions.clear();
                  split(footprint, split_settings, contributions);
                  keep(chunks + chunk, contributions);
                }
              });
  const GridLimits limits{*std::max_element(fastest.begin(), fastest.end()), path.s_limit,
                          beside_limit(scatterer), path.q_limit};
  // Four grids, whatever the number of threads, each for every fourth chunk; their sum is taken in order.
  constexpr std::size_t kGrids = 4;
  std::vector<ReturnGrid> grids(kGrids, ReturnGrid(wavenumbers, limits));
  parallel_for(kGrids, threads, [&](std::size_t g) {
    for (std::size_t chunk = g; chunk < all_chunks; chunk += kGrids) grids[g].spread(points[chunk]);
  });
  ReturnGrid grid = std::move(grids[0]);
  for (std::size_t g = 1; g < kGrids; ++g) grid.add(grids[g]);
  grid.transform();
  return grid;
}

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
  threads = std::max(1, threads);
  const RadarBasis world = radar_basis(r_hat);
  const Vec3 image_r = image_direction(r_hat);
  const RadarBasis image{image_r, world.h, image_r.cross(world.h)};
  const int channel = static_cast<int>(polarisation);
  constexpr double kToWavenumber = 2 * kPi / kSpeedOfLight;
  const WavenumberGrid wavenumbers{kToWavenumber * sampling.first_hz, kToWavenumber * sampling.step_hz, sampling.count};

  std::vector<Pose> poses(pulses);
  std::vector<Vec3> directions(pulses), image_directions(pulses);
  for (int n = 0; n < pulses; ++n) {
    poses[n] = seen_pose(trajectory, sampling, r_hat, sampling.pulse_time_s[n]);
    directions[n] = poses[n].R_TB.transpose() * r_hat;
    image_directions[n] = poses[n].R_TB.transpose() * image_r;
  }
  const auto path_length = [](std::span<const Vec3> way) {
    double length = 0;
    for (std::size_t n = 1; n < way.size(); ++n) length += (way[n] - way[n - 1]).norm();
    return length;
  };
  const double turn = std::max(path_length(directions), sea != nullptr ? path_length(image_directions) : 0.0);
  std::vector<SeaCoefficients> mirror;  // per frequency
  for (int q = 0; sea != nullptr && q < wavenumbers.count; ++q) mirror.push_back(sea->at(wavenumbers.at(q), r_hat.z()));

  BodyResponse result;
  result.response.pulses = pulses;
  result.response.per_pulse = sampling.per_pulse;
  result.response.values.assign(static_cast<std::size_t>(pulses) * sampling.per_pulse, 0.0);
  // Traces the body at the middles of equal spans of the interval; between two instants their answers are blended
  // linearly, before the first and after the last one that one's stands alone.
  const double start = sampling.pulse_time_s.front(), length = sampling.pulse_time_s.back() - start;
  const double k_last = wavenumbers.at(wavenumbers.count - 1), kc = wavenumbers.at(wavenumbers.centre_index());
  const double served = solver.max_turn_deg > 0 ? radians(solver.max_turn_deg) : default_turn(scatterer, 2 * kPi / kc);
  // What comes one way, directly or by the sea.
  struct Way {
    SeaPath path;
    AntennaPair antennas;
    DirectionPath moves;
    std::optional<ReturnGrid> returns;
  };
  struct Trace {
    int first = 0, last = -1;  // pulses it has a weight in
    Vec3 origin;
    std::vector<Way> ways;
  };
  int spans = std::max(1, static_cast<int>(std::ceil(turn / served)));
  const auto weight = [&](int span, int n) {
    const double position = length > 0 ? (sampling.pulse_time_s[n] - start) / length * spans - 0.5 : 0.0;
    return std::max(0.0, 1 - std::abs(std::clamp(position, 0.0, spans - 1.0) - span));
  };
  const auto planned = [&](int span) {
    Trace trace;
    trace.first = pulses;
    for (int n = 0; n < pulses; ++n) {
      if (weight(span, n) <= 0) continue;
      trace.first = std::min(trace.first, n);
      trace.last = n;
    }
    if (trace.first > trace.last) return trace;
    const Pose pose = seen_pose(trajectory, sampling, r_hat, start + length * (span + 0.5) / spans);
    trace.origin = pose.R_TB.transpose() * pose.p_TB;
    const RadarBasis direct = body_basis(world, pose), mirrored = body_basis(image, pose);
    for (const SeaPath& path : kSeaPaths) {
      if (sea == nullptr ? path.multipath() : !sea->wanted(path)) continue;
      const RadarBasis &transmit = path.there ? mirrored : direct, &receive = path.back ? mirrored : direct;
      const auto served_part = [&](const std::vector<Vec3>& all) {
        return std::span<const Vec3>(all).subspan(static_cast<std::size_t>(trace.first),
                                                  static_cast<std::size_t>(trace.last - trace.first + 1));
      };
      trace.ways.push_back({path, path.there == path.back ? monostatic(transmit) : bistatic(transmit, receive),
                            direction_path(served_part(path.there ? image_directions : directions),
                                           served_part(path.back ? image_directions : directions), transmit.r, receive.r),
                            {}});
    }
    return trace;
  };
  // Spans get shorter until no path bends by more than a grid takes.
  std::vector<Trace> traces;
  for (;; spans += (spans + 1) / 2) {
    traces.clear();
    double most_beside = 0;
    for (int span = 0; span < spans; ++span) {
      traces.push_back(planned(span));
      for (const Way& way : traces.back().ways) most_beside = std::max(most_beside, way.moves.q_limit);
    }
    if (k_last * beside_limit(scatterer) * most_beside <= kMostBesidePhase || spans >= pulses) break;
  }
  // Traces side by side before facets side by side: the threads then meet less often.
  const int side_by_side = std::min(threads, spans), threads_each = std::max(1, threads / side_by_side);
  parallel_for(traces.size(), side_by_side, [&](std::size_t i) {
    for (Way& way : traces[i].ways) {
      way.returns = trace_returns(scatterer, way.antennas, way.moves, traces[i].origin, wavenumbers, channel, solver,
                                  threads_each);
    }
  });
  std::vector<Complex> answer(static_cast<std::size_t>(sampling.per_pulse));
  for (int i = 0; i < spans; ++i) {
    const Trace& trace = traces[static_cast<std::size_t>(i)];
    for (const Way& way : trace.ways) {
      ++result.traces;
      for (int n = trace.first; n <= trace.last; ++n) {
        const auto at = static_cast<std::size_t>(n - trace.first);
        way.returns->response(sampling.pulse_first[n], way.moves.s[at], way.moves.q[at], answer);
        // By the sea: beyond the direct path to the body's origin, which all ways share below: e^{jk (a + b - 2 r^).p}.
        const double detour =
            ((way.path.there ? image_r : r_hat) + (way.path.back ? image_r : r_hat) - 2 * r_hat).dot(poses[n].p_TB);
        for (int b = 0; b < sampling.per_pulse; ++b) {
          const int q = sampling.pulse_first[n] + b;
          const Complex by_sea = way.path.multipath() ? SeaMirror::weight(way.path, mirror[q], channel) *
                                                            std::polar(1.0, wavenumbers.at(q) * detour)
                                                      : 1.0;
          result.response.at(n, b) += weight(i, n) * by_sea * answer[b];
        }
      }
    }
  }

  // The body's origin moves too: e^{+j 2k r^.p}, exact for every pulse and frequency.
  for (int n = 0; n < pulses; ++n) {
    const double path = 2 * r_hat.dot(poses[n].p_TB);
    for (int b = 0; b < sampling.per_pulse; ++b) {
      result.response.at(n, b) *= std::polar(1.0, wavenumbers.at(sampling.pulse_first[n] + b) * path);
    }
  }
  return result;
}

std::vector<std::array<Complex, 4>> scattering_matrices(const Scatterer& scatterer, const AntennaPair& antennas,
                                                        std::span<const double> wavenumbers,
                                                        const IlluminationSettings& settings, int threads,
                                                        std::size_t* legs, const StopFlag* stop) {
  using Matrices = std::vector<std::array<Complex, 4>>;
  const double spread = spread_of_directions(scatterer, settings.range_m);
  // At a finite range closed forms give way to points, which the wavefront moves one by one.
  const auto bent = [&](std::vector<Contribution>& points, double k) {
    bend_wavefront(points, antennas, Vec3::Zero(), settings.range_m);
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
  std::vector<Matrices> parts(illumination.chunk_count(), Matrices(wavenumbers.size()));
  const Reached reached = illumination.light_all(
      threads,
      [&](std::size_t chunk, std::span<const Footprint> footprints) {
        for (const Footprint& footprint : footprints) {
          if (!settings.filter.keeps(footprint.part, footprint.bounces, Mechanism::kPhysicalOptics)) continue;
          for (std::size_t q = 0; q < wavenumbers.size(); ++q) add(of_facet(footprint, q), parts[chunk][q]);
        }
      },
      stop);
  if (legs) *legs += reached.legs;
  const std::size_t facet_parts = parts.size();
  parts.resize(facet_parts + kEdgeChunks, Matrices(wavenumbers.size()));
  edge_echoes(scatterer, antennas, settings, wavenumbers, reached.arrivals, threads,
              [&](std::size_t chunk, std::span<const EdgeFootprint> footprints) {
                for (const EdgeFootprint& footprint : footprints) {
                  for (std::size_t q = 0; q < wavenumbers.size(); ++q)
                    add(of_edge(footprint, wavenumbers[q]), parts[facet_parts + chunk][q]);
                }
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
  bent.turn_rad += spread_of_directions(scatterer, settings.range_m);
  const Illumination illumination(scatterer, antennas, settings, threads, std::array{split_settings.kc});
  std::vector<std::vector<Contribution>> chunks(illumination.chunk_count());
  const Reached reached = illumination.light_all(
      threads,
      [&](std::size_t chunk, std::span<const Footprint> footprints) {
        for (const Footprint& footprint : footprints) {
          if (!settings.filter.keeps(footprint.part, footprint.bounces, Mechanism::kPhysicalOptics)) continue;
          split(footprint, antennas.transmit, bent, chunks[chunk]);
        }
      },
      stop);
  const std::size_t facet_chunks = chunks.size();
  chunks.resize(facet_chunks + kEdgeChunks);
  edge_echoes(scatterer, antennas, settings, std::array{split_settings.kc}, reached.arrivals, threads,
              [&](std::size_t chunk, std::span<const EdgeFootprint> footprints) {
                for (const EdgeFootprint& footprint : footprints) split(footprint, bent, chunks[facet_chunks + chunk]);
              });
  std::vector<Contribution> all;
  for (const auto& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
  if (settings.range_m > 0) bend_wavefront(all, antennas, Vec3::Zero(), settings.range_m);
  return all;
}

}  // namespace seaglint
