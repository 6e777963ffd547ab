// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/response/scattering_matrix.h"

#include <cmath>

#include "sim/scattering/edges/edge_decomposition.h"
#include "sim/scattering/response/aspect_trace.h"
#include "sim/scattering/surfaces/phase_integral.h"
#include "sim/scattering/target/target_check.h"

namespace seaglint {
namespace {

using Matrices = std::vector<std::array<Complex, 4>>;  // of each wavenumber

// Sums contributions of one pair in closed form; at a finite range these give way to points, which the wavefront moves
// one by one.
class MatrixSum {
 public:
  MatrixSum(const AntennaPair& antennas, std::span<const double> wavenumbers, const IlluminationSettings& settings,
            double spread)
      : antennas_(antennas), wavenumbers_(wavenumbers), settings_(settings), spread_(spread) {}

  void add(std::span<const Footprint> footprints, Matrices& sum) const {
    for (const Footprint& footprint : footprints) {
      for (std::size_t q = 0; q < wavenumbers_.size(); ++q) add(of_facet(footprint, q), sum[q]);
    }
  }
  void add(std::span<const EdgeFootprint> footprints, Matrices& sum) const {
    for (const EdgeFootprint& footprint : footprints) {
      for (std::size_t q = 0; q < wavenumbers_.size(); ++q) add(of_edge(footprint, wavenumbers_[q]), sum[q]);
    }
  }
  static void add(const std::array<Complex, 4>& s, std::array<Complex, 4>& sum) {
    for (int i = 0; i < 4; ++i) sum[i] += s[i];
  }

 private:
  std::array<Complex, 4> bent(std::vector<Contribution>& points, double k) const {
    bend_wavefront(points, antennas_, settings_.origin, settings_.range_m);
    return direct_sum(points, k, Vec3::Zero());
  }
  std::array<Complex, 4> of_facet(Footprint footprint, std::size_t q) const {
    if (settings_.range_m <= 0) return scattered(footprint, wavenumbers_[q], q);
    if (!footprint.patterns.empty()) footprint.pattern = footprint.patterns[q];
    std::vector<Contribution> points;
    split(footprint, antennas_.transmit, {wavenumbers_[q], spread_}, points);
    return bent(points, wavenumbers_[q]);
  }
  std::array<Complex, 4> of_edge(const EdgeFootprint& footprint, double k) const {
    if (settings_.range_m <= 0) return scattered(footprint, k);
    std::vector<Contribution> points;
    split(footprint, {k, spread_}, points);
    return bent(points, k);
  }

  const AntennaPair& antennas_;
  std::span<const double> wavenumbers_;
  const IlluminationSettings& settings_;
  double spread_;
};

}  // namespace

double spread_of_directions(const Scatterer& scatterer, double range_m, const Vec3& origin) {
  const double reach = scatterer.radius() + origin.norm();
  check_range(reach, range_m);
  return range_m > 0 ? reach / range_m : 0;
}

std::vector<Matrices> scattering_matrices(const Scatterer& scatterer, std::span<const AntennaPair> pairs,
                                          std::span<const double> wavenumbers, const IlluminationSettings& settings,
                                          int threads, std::size_t* legs, const StopFlag* stop) {
  const double spread = spread_of_directions(scatterer, settings.range_m, settings.origin);
  const AspectTrace trace(scatterer, pairs, settings, wavenumbers, threads);
  std::vector<std::vector<Matrices>> parts(pairs.size());  // by pair and chunk
  for (std::size_t i = 0; i < pairs.size(); ++i) parts[i].assign(trace.chunk_count(i), Matrices(wavenumbers.size()));
  const auto add = [&](std::size_t pair, std::size_t chunk, const auto& footprints) {
    MatrixSum(pairs[pair], wavenumbers, settings, spread).add(footprints, parts[pair][chunk]);
  };
  const std::size_t followed = trace.run({add, add}, stop);
  if (legs) *legs += followed;
  std::vector<Matrices> sums;
  for (const std::vector<Matrices>& chunks : parts) {
    Matrices& sum = sums.emplace_back(wavenumbers.size());
    for (const Matrices& part : chunks) {
      for (std::size_t q = 0; q < wavenumbers.size(); ++q) MatrixSum::add(part[q], sum[q]);
    }
  }
  return sums;
}

Matrices scattering_matrices(const Scatterer& scatterer, const AntennaPair& antennas,
                             std::span<const double> wavenumbers, const IlluminationSettings& settings, int threads,
                             std::size_t* legs, const StopFlag* stop) {
  return scattering_matrices(scatterer, std::span(&antennas, 1), wavenumbers, settings, threads, legs, stop).front();
}

Matrices scattering_matrices_over_sea(const Scatterer& scatterer, const Vec3& r_hat, double height_m,
                                      const SeaMirror& sea, std::span<const double> wavenumbers,
                                      const IlluminationSettings& settings, int threads, std::size_t* legs,
                                      const StopFlag* stop) {
  const RadarBasis radar = radar_basis(r_hat), image = image_basis(radar);
  IlluminationSettings raised = settings;
  raised.origin = {0, 0, height_m};
  std::vector<SeaPath> paths;
  std::vector<AntennaPair> pairs;
  for (const SeaPath& path : kSeaPaths) {
    if (!sea.wanted(path)) continue;
    const RadarBasis &transmit = path.there ? image : radar, &receive = path.back ? image : radar;
    paths.push_back(path);
    pairs.push_back(path.there == path.back ? monostatic(transmit) : bistatic(transmit, receive));
  }
  const auto matrices = scattering_matrices(scatterer, pairs, wavenumbers, raised, threads, legs, stop);
  Matrices sum(wavenumbers.size());
  for (std::size_t w = 0; w < paths.size(); ++w) {
    // About the body's origin at (0, 0, height): e^{jk (a + b - 2 r).(0, 0, height)}.
    const double detour = -2 * r_hat.z() * height_m * ((paths[w].there ? 1 : 0) + (paths[w].back ? 1 : 0));
    for (std::size_t q = 0; q < wavenumbers.size(); ++q) {
      const SeaCoefficients rho = sea.at(wavenumbers[q], r_hat.z());
      const Complex phase = std::polar(1.0, wavenumbers[q] * detour);
      for (int i = 0; i < 4; ++i) sum[q][i] += SeaMirror::weight(paths[w], rho, i) * phase * matrices[w][q][i];
    }
  }
  return sum;
}

std::vector<Contribution> view_contributions(const Scatterer& scatterer, const AntennaPair& antennas,
                                             const SplitSettings& split_settings, const IlluminationSettings& settings,
                                             int threads, const StopFlag* stop) {
  SplitSettings bent = split_settings;
  bent.turn_rad += spread_of_directions(scatterer, settings.range_m, settings.origin);
  const std::array wavenumber{split_settings.kc};
  const AspectTrace trace(scatterer, std::span(&antennas, 1), settings, wavenumber, threads);
  std::vector<std::vector<Contribution>> chunks(trace.chunk_count(0));
  trace.run({[&](std::size_t, std::size_t chunk, std::span<const Footprint> footprints) {
               for (const Footprint& footprint : footprints) split(footprint, antennas.transmit, bent, chunks[chunk]);
             },
             [&](std::size_t, std::size_t chunk, std::span<const EdgeFootprint> footprints) {
               for (const EdgeFootprint& footprint : footprints) split(footprint, bent, chunks[chunk]);
             }},
            stop);
  std::vector<Contribution> all;
  for (const auto& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
  if (settings.range_m > 0) bend_wavefront(all, antennas, settings.origin, settings.range_m);
  return all;
}

}  // namespace seaglint
