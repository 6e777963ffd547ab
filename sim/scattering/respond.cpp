// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/respond.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/scattering/contributions.h"
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

// One trace: what the body answers while its directions move along `track`, the transmitter's (a unit vector across it)
// by at most `reach`. `origin`: where the body stands from the point that the radar's range is counted from, body
// frame.
ReturnGrid trace_returns(const Scatterer& scatterer, const AntennaPair& antennas, const Track& track, double reach,
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
  const SplitSettings split_settings{kc, reach + spread_of_directions(scatterer, solver.radar_range_m)};
  const std::size_t chunks = illumination.chunk_count();
  const std::size_t all_chunks = chunks + kEdgeChunks;  // the last ones are those of the edges
  std::vector<std::vector<ReturnPoint>> points(all_chunks);
  std::vector<double> fastest(all_chunks, 0);
  const auto keep = [&](std::size_t chunk, std::span<Contribution> contributions) {
    if (solver.radar_range_m > 0) bend_wavefront(contributions, antennas, origin, solver.radar_range_m);
    for (const Contribution& c : contributions) {
      const Complex amplitude = c.amplitude * Complex(c.pattern[channel]);
      if (amplitude == 0.0) continue;
      const double u = track.speed(c.gradient) * std::min(1.0, limit / c.gradient.sum().norm());
      points[chunk].push_back({amplitude, c.psi, u});
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
  const double u_limit = *std::max_element(fastest.begin(), fastest.end());
  // Four grids, whatever the number of threads, each for every fourth chunk; their sum is taken in order.
  constexpr std::size_t kGrids = 4;
  std::vector<ReturnGrid> grids(kGrids, ReturnGrid(wavenumbers, u_limit, reach));
  parallel_for(kGrids, threads, [&](std::size_t g) {
    for (std::size_t chunk = g; chunk < all_chunks; chunk += kGrids) grids[g].spread(points[chunk]);
  });
  ReturnGrid grid = std::move(grids[0]);
  for (std::size_t g = 1; g < kGrids; ++g) grid.add(grids[g]);
  grid.transform();
  return grid;
}

// Any unit vector across r, for a body at rest.
Vec3 across(const Vec3& r) {
  return (std::abs(r.z()) < 0.9 ? Vec3(Vec3::UnitZ().cross(r)) : Vec3(Vec3::UnitX().cross(r))).normalized();
}

// The common way of two directions from pulse `first` to `last`, of unit length in both together.
Track track_of(std::span<const Vec3> transmit, std::span<const Vec3> receive, int first, int last,
               const Vec3& transmit_at) {
  const Vec3 t = transmit[last] - transmit[first], r = receive[last] - receive[first];
  const double length = std::sqrt(t.squaredNorm() + r.squaredNorm());
  if (length < 1e-12) return {across(transmit_at), Vec3::Zero()};
  return {t / length, r / length};
}

}  // namespace

double default_turn(const Scatterer& scatterer, double wavelength) {
  return std::min(radians(0.15), 1.2 * wavelength / scatterer.radius());
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
  double turn = 0;  // length of the direction's path over the interval
  for (int n = 1; n < pulses; ++n) turn += (directions[n] - directions[n - 1]).norm();

  if (sea != nullptr) {
    double image_turn = 0;
    for (int n = 1; n < pulses; ++n) image_turn += (image_directions[n] - image_directions[n - 1]).norm();
    turn = std::max(turn, image_turn);
  }
  std::vector<SeaCoefficients> mirror;  // per frequency
  for (int q = 0; sea != nullptr && q < wavenumbers.count; ++q) mirror.push_back(sea->at(wavenumbers.at(q), r_hat.z()));

  BodyResponse result;
  result.response.pulses = pulses;
  result.response.per_pulse = sampling.per_pulse;
  result.response.values.assign(static_cast<std::size_t>(pulses) * sampling.per_pulse, 0.0);
  std::vector<Complex> scratch(sampling.per_pulse);
  const auto band = [&](int n) {
    return std::span<Complex>(&result.response.values[static_cast<std::size_t>(n) * sampling.per_pulse],
                              sampling.per_pulse);
  };
  // Traces the body at the middles of equal spans of the interval; between two instants their answers are blended
  // linearly, before the first and after the last one that one's stands alone.
  const double start = sampling.pulse_time_s.front(), length = sampling.pulse_time_s.back() - start;
  const double wavelength = 2 * kPi / wavenumbers.at(wavenumbers.centre_index());
  const double served = solver.max_turn_deg > 0 ? radians(solver.max_turn_deg) : default_turn(scatterer, wavelength);
  const int spans = std::max(1, static_cast<int>(std::ceil(turn / served)));
  const auto weight = [&](int span, int n) {
    const double position = length > 0 ? (sampling.pulse_time_s[n] - start) / length * spans - 0.5 : 0.0;
    return std::max(0.0, 1 - std::abs(std::clamp(position, 0.0, spans - 1.0) - span));
  };
  // What comes one way: both directions move along `track`, and s measures how far.
  struct Way {
    Vec3 transmit = Vec3::Zero(), receive = Vec3::Zero();  // where the trace was made
    Track track;
    std::optional<ReturnGrid> returns;
  };
  struct Trace {
    int first = 0, last = -1;  // pulses it has a weight in
    RadarBasis basis;
    Vec3 track;
    std::optional<ReturnGrid> returns;
    std::array<Way, kSeaPaths.size()> by_sea;
  };
  const auto displacement = [&](const Way& way, const SeaPath& path, int n) {
    const Vec3 &transmit = path.there ? image_directions[n] : directions[n],
               &receive = path.back ? image_directions[n] : directions[n];
    return (transmit - way.transmit).dot(way.track.transmit) + (receive - way.receive).dot(way.track.receive);
  };
  const bool direct = sea == nullptr || sea->wanted(SeaPath{});
  std::vector<Trace> traces(spans);
  // Traces side by side before facets side by side: the threads then meet less often.
  const int side_by_side = std::min(threads, spans);
  parallel_for(traces.size(), side_by_side, [&](std::size_t i) {
    Trace& trace = traces[i];
    trace.first = pulses;
    for (int n = 0; n < pulses; ++n) {
      if (weight(static_cast<int>(i), n) <= 0) continue;
      trace.first = std::min(trace.first, n);
      trace.last = n;
    }
    if (trace.first > trace.last) return;
    const double middle = start + length * (static_cast<double>(i) + 0.5) / spans;
    const Pose pose = seen_pose(trajectory, sampling, r_hat, middle);
    trace.basis = body_basis(world, pose);
    const Vec3 chord = directions[trace.last] - directions[trace.first];
    const Vec3 level = chord - trace.basis.r * trace.basis.r.dot(chord);
    trace.track = level.norm() > 1e-12 ? Vec3(level.normalized()) : across(trace.basis.r);
    double reach = 0;
    for (int n = trace.first; n <= trace.last; ++n) {
      reach = std::max(reach, std::abs((directions[n] - trace.basis.r).dot(trace.track)));
    }
    const int threads_each = std::max(1, threads / side_by_side);
    const Vec3 origin = pose.R_TB.transpose() * pose.p_TB;
    if (direct) {
      trace.returns = trace_returns(scatterer, monostatic(trace.basis), {trace.track, trace.track}, reach, origin,
                                    wavenumbers, channel, solver, threads_each);
    }
    if (sea == nullptr) return;
    const RadarBasis image_basis = body_basis(image, pose);
    for (std::size_t p = 0; p < kSeaPaths.size(); ++p) {
      const SeaPath& path = kSeaPaths[p];
      if (!path.multipath() || !sea->wanted(path)) continue;
      Way& way = trace.by_sea[p];
      const RadarBasis &transmit = path.there ? image_basis : trace.basis,
                       &receive = path.back ? image_basis : trace.basis;
      way.transmit = transmit.r;
      way.receive = receive.r;
      way.track = track_of(path.there ? image_directions : directions, path.back ? image_directions : directions,
                           trace.first, trace.last, transmit.r);
      double way_reach = 0;
      for (int n = trace.first; n <= trace.last; ++n)
        way_reach = std::max(way_reach, std::abs(displacement(way, path, n)));
      const AntennaPair antennas = path.there == path.back ? monostatic(transmit) : bistatic(transmit, receive);
      way.returns =
          trace_returns(scatterer, antennas, way.track, way_reach, origin, wavenumbers, channel, solver, threads_each);
    }
  });
  for (int i = 0; i < spans; ++i) {
    const Trace& trace = traces[i];
    if (trace.first > trace.last) continue;
    for (int n = trace.first; n <= trace.last; ++n) {
      if (!trace.returns) break;
      trace.returns->response(sampling.pulse_first[n], (directions[n] - trace.basis.r).dot(trace.track), scratch);
      const std::span<Complex> out = band(n);
      for (std::size_t b = 0; b < out.size(); ++b) out[b] += weight(i, n) * scratch[b];
    }
    result.traces += trace.returns ? 1 : 0;
    for (std::size_t p = 0; p < kSeaPaths.size(); ++p) {
      const SeaPath& path = kSeaPaths[p];
      const Way& way = trace.by_sea[p];
      if (!way.returns) continue;
      for (int n = trace.first; n <= trace.last; ++n) {
        way.returns->response(sampling.pulse_first[n], displacement(way, path, n), scratch);
        // Beyond the direct path to the body's origin, which all ways share below: e^{jk (a + b - 2 r^).p}.
        const double detour =
            ((path.there ? image_r : r_hat) + (path.back ? image_r : r_hat) - 2 * r_hat).dot(poses[n].p_TB);
        const std::span<Complex> out = band(n);
        for (std::size_t b = 0; b < out.size(); ++b) {
          const int q = sampling.pulse_first[n] + static_cast<int>(b);
          out[b] += weight(i, n) * SeaMirror::weight(path, mirror[q], channel) *
                    std::polar(1.0, wavenumbers.at(q) * detour) * scratch[b];
        }
      }
      ++result.traces;
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
