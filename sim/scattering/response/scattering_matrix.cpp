// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/response/scattering_matrix.h"

#include <cmath>

#include "sim/scattering/edges/edge_decomposition.h"
#include "sim/scattering/response/aspect_trace.h"
#include "sim/scattering/surfaces/phase_integral.h"
#include "sim/scattering/target/target_check.h"

namespace seaglint {
namespace {

using Matrices = std::vector<std::array<Complex, 4>>;  // per wavenumber

// Sums the contributions of one pair in closed form, or as points at a finite range, for which the wavefront correction
// differs from point to point.
class MatrixSum {
 public:
  MatrixSum(const BistaticGeometry& geometry, std::span<const double> wavenumbers, const RadarRange& radar,
            double spread)
      : geometry_(geometry), wavenumbers_(wavenumbers), radar_(radar), spread_(spread) {}

  void add(std::span<const Footprint> footprints, Matrices& sum) const {
    for (const Footprint& footprint : footprints) {
      for (std::size_t q = 0; q < wavenumbers_.size(); ++q) add(of_facet(footprint, q), sum[q]);
    }
  }
  void add(std::span<const EdgeContribution> contributions, Matrices& sum) const {
    for (const EdgeContribution& contribution : contributions) {
      for (std::size_t q = 0; q < wavenumbers_.size(); ++q) add(of_edge(contribution, wavenumbers_[q]), sum[q]);
    }
  }
  static void add(const std::array<Complex, 4>& s, std::array<Complex, 4>& sum) {
    for (int i = 0; i < 4; ++i) sum[i] += s[i];
  }

 private:
  std::array<Complex, 4> bent(std::vector<PointContribution>& points, double k) const {
    apply_wavefront_curvature(points, geometry_, radar_);
    return direct_sum(points, k, Vec3::Zero());
  }
  std::array<Complex, 4> of_facet(Footprint footprint, std::size_t q) const {
    if (radar_.range_m <= 0) return scattered(footprint, wavenumbers_[q], q);
    if (!footprint.patterns.empty()) footprint.pattern = footprint.patterns[q];
    std::vector<PointContribution> points;
    decompose(footprint, geometry_.transmit, {wavenumbers_[q], spread_}, points);
    return bent(points, wavenumbers_[q]);
  }
  std::array<Complex, 4> of_edge(const EdgeContribution& contribution, double k) const {
    if (radar_.range_m <= 0) return scattered(contribution, k);
    std::vector<PointContribution> points;
    decompose(contribution, {k, spread_}, points);
    return bent(points, k);
  }

  const BistaticGeometry& geometry_;
  std::span<const double> wavenumbers_;
  const RadarRange& radar_;
  double spread_;
};

// radar.origin of the body's frame becomes that of the scatterer's coordinates.
RadarRange relative_to_centre(const Scatterer& scatterer, RadarRange radar) {
  radar.origin += scatterer.centre();
  return radar;
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

std::vector<Matrices> scattering_matrices(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs,
                                          std::span<const double> wavenumbers, const TracingSettings& settings,
                                          int threads, std::size_t* segments, const StopFlag* stop,
                                          const RadarRange& radar) {
  const RadarRange to_centre = relative_to_centre(scatterer, radar);
  const double spread = direction_spread(scatterer, to_centre);
  const AspectTrace trace(scatterer, pairs, settings, wavenumbers, threads);
  std::vector<std::vector<Matrices>> parts(pairs.size());  // [pair][chunk]
  for (std::size_t i = 0; i < pairs.size(); ++i) parts[i].assign(trace.chunk_count(i), Matrices(wavenumbers.size()));
  const auto add = [&](std::size_t pair, std::size_t chunk, const auto& footprints) {
    MatrixSum(pairs[pair], wavenumbers, to_centre, spread).add(footprints, parts[pair][chunk]);
  };
  const std::size_t followed = trace.run({add, add}, stop);
  if (segments) *segments += followed;
  std::vector<Matrices> sums;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Matrices& sum = sums.emplace_back(wavenumbers.size());
    for (const Matrices& part : parts[i]) {
      for (std::size_t q = 0; q < wavenumbers.size(); ++q) MatrixSum::add(part[q], sum[q]);
    }
    for (std::size_t q = 0; q < wavenumbers.size(); ++q) {
      for (Complex& s : sum[q]) s *= origin_phase(scatterer, pairs[i], wavenumbers[q]);
    }
  }
  return sums;
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
                                      const StopFlag* stop, double range_m) {
  const RadarBasis radar = radar_basis(r_hat), image = image_basis(radar);
  std::vector<PropagationPath> paths;
  std::vector<BistaticGeometry> pairs;
  for (const PropagationPath& path : kFourPaths) {
    if (!sea.is_enabled(path)) continue;
    const RadarBasis &transmit = path.outbound_via_sea ? image : radar, &receive = path.return_via_sea ? image : radar;
    paths.push_back(path);
    pairs.push_back(path.outbound_via_sea == path.return_via_sea ? monostatic(transmit) : bistatic(transmit, receive));
  }
  const auto matrices = scattering_matrices(scatterer, pairs, wavenumbers, settings, threads, segments, stop,
                                            {range_m, {0, 0, height_m}});
  Matrices sum(wavenumbers.size());
  for (std::size_t w = 0; w < paths.size(); ++w) {
    // Phase relative to the body's origin at (0, 0, height): e^{jk (a + b - 2 r).(0, 0, height)}.
    const double detour =
        -2 * r_hat.z() * height_m * ((paths[w].outbound_via_sea ? 1 : 0) + (paths[w].return_via_sea ? 1 : 0));
    for (std::size_t q = 0; q < wavenumbers.size(); ++q) {
      const SeaReflectionCoefficients rho = sea.at(wavenumbers[q], r_hat.z());
      const Complex phase = std::polar(1.0, wavenumbers[q] * detour);
      for (int i = 0; i < 4; ++i) sum[q][i] += SeaReflection::path_factor(paths[w], rho, i) * phase * matrices[w][q][i];
    }
  }
  return sum;
}

AspectContributions aspect_contributions(const Scatterer& scatterer, const BistaticGeometry& geometry,
                                         const DecompositionSettings& split_settings, const TracingSettings& settings,
                                         int threads, const StopFlag* stop, const RadarRange& radar) {
  const RadarRange to_centre = relative_to_centre(scatterer, radar);
  const double spread = direction_spread(scatterer, to_centre);
  DecompositionSettings bent = split_settings;
  bent.aspect_change_rad += spread;
  const std::array wavenumber{split_settings.kc};
  const MatrixSum sum(geometry, wavenumber, to_centre, spread);
  const AspectTrace trace(scatterer, std::span(&geometry, 1), settings, wavenumber, threads);
  std::vector<std::vector<PointContribution>> points(trace.chunk_count(0));
  std::vector<Matrices> parts(trace.chunk_count(0), Matrices(1));
  AspectContributions all;
  all.segments = trace.run({[&](std::size_t, std::size_t chunk, std::span<const Footprint> footprints) {
                              sum.add(footprints, parts[chunk]);
                              for (const Footprint& footprint : footprints)
                                decompose(footprint, geometry.transmit, bent, points[chunk]);
                            },
                            [&](std::size_t, std::size_t chunk, std::span<const EdgeContribution> contributions) {
                              sum.add(contributions, parts[chunk]);
                              for (const EdgeContribution& contribution : contributions)
                                decompose(contribution, bent, points[chunk]);
                            }},
                           stop);
  for (std::size_t chunk = 0; chunk < points.size(); ++chunk) {
    MatrixSum::add(parts[chunk][0], all.matrix);
    all.points.insert(all.points.end(), points[chunk].begin(), points[chunk].end());
  }
  if (radar.range_m > 0) apply_wavefront_curvature(all.points, geometry, to_centre);
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
