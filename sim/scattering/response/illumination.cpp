// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/response/illumination.h"

#include <algorithm>
#include <numeric>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scattering/beams/beam_tracer.h"
#include "sim/scattering/edges/beam_boundary.h"

namespace seaglint {
namespace {

// Side of the smallest lit piece that counts, in radii: 5 mm on the 144 m ship.
constexpr double kSmallestSide = 0.7e-4;
// Side of the smallest beam that goes on to further mirrors, in those of pieces: 18 mm on the ship. Pieces half as
// large and beams twice as large as one size for both err less and cost the same (README.md).
constexpr double kBeamPerPiece = 3.6;
// A large mesh has larger chunks of panels: what is kept per chunk and frequency stays below 100 MB for 640
// frequencies.
constexpr std::size_t kPanelsPerChunk = 64;
constexpr std::size_t kMostChunks = 2048;
// A lattice of rays finds most pieces whose side is a fourteenth of its spacing, with one more ray inside every corner.
constexpr double kSpacingPerSide = 14;

double smallest_area(const Scatterer& scatterer, const IlluminationSettings& settings) {
  const double side = ray_spacing(scatterer, settings) / kSpacingPerSide;
  return side * side;
}

// In a direction that lies in a sheet's plane nothing of it would be found, not even its rims, whose echo has a limit
// there; so have edge waves along any face, and those of an edge square to the direction, which run along the rims
// beside it. Such a direction is turned aside by this much, rad, which moves phases by 0.05 rad at the ends of a 144 m
// ship at 16 GHz.
constexpr double kAside = 1e-6;

RadarBasis looking_aside(const Scatterer& scatterer, const RadarBasis& basis, bool edges) {
  const auto has_a_limit = [&](const Vec3& r) {
    const auto in_its_plane = [&](const Facet& facet) {
      return (facet.open || edges) && std::abs(facet.normal.dot(r)) < kEdgeOnPanel;
    };
    const auto square_to = [&](const SharpEdge& edge) { return edges && std::abs(edge.along().dot(r)) < kEdgeOnPanel; };
    return std::ranges::any_of(scatterer.facets(), in_its_plane) ||
           std::ranges::any_of(scatterer.edges().edges, square_to);
  };
  if (!has_a_limit(basis.r)) return basis;
  // About h - v first, since faces often lie along h or v; a face across the axis stays edge-on and asks for another
  // one.
  RadarBasis aside = basis;
  for (const Vec2& axis : {Vec2(1, -1), Vec2(1, 0.6), Vec2(0.3, 1), Vec2(1, 0.1), Vec2(-0.2, 1)}) {
    const Mat3 turn =
        Eigen::AngleAxisd(kAside, (axis.x() * basis.h + axis.y() * basis.v).normalized()).toRotationMatrix();
    aside = {turn * basis.r, turn * basis.h, turn * basis.v};
    if (!has_a_limit(aside.r)) break;
  }
  return aside;
}

AntennaPair looking_aside(const Scatterer& scatterer, const AntennaPair& antennas, bool edges) {
  return {looking_aside(scatterer, antennas.transmit, edges), looking_aside(scatterer, antennas.receive, edges),
          antennas.monostatic};
}

}  // namespace

double default_ray_spacing(const Scatterer& scatterer) { return kSpacingPerSide * kSmallestSide * scatterer.radius(); }

double ray_spacing(const Scatterer& scatterer, const IlluminationSettings& settings) {
  const double coarsest = default_ray_spacing(scatterer);
  return settings.ray_spacing_m > 0 ? std::min(coarsest, settings.ray_spacing_m) : coarsest;
}

double faintest_echo(const Scatterer& scatterer, const IlluminationSettings& settings, double k) {
  return 0.1 * k * smallest_area(scatterer, settings) / (2 * kPi);
}

Illumination::Illumination(const Scatterer& scatterer, const AntennaPair& antennas,
                           const IlluminationSettings& settings, int threads, std::span<const double> wavenumbers)
    : scatterer_(scatterer),
      antennas_(looking_aside(scatterer, antennas, settings.edges)),
      settings_(settings),
      min_area_(smallest_area(scatterer, settings)),
      lit_(scatterer.facets(), scatterer.panels(), scatterer.tree(), antennas_.transmit, min_area_, threads) {
  if (!antennas.monostatic)
    seen_from_receiver_.emplace(scatterer.facets(), scatterer.panels(), scatterer.tree(), antennas_.receive, min_area_,
                                threads);
  for (int facet = 0; facet < static_cast<int>(scatterer.facets().size()); ++facet) {
    if (!lit_.pieces(facet).empty()) seen_.push_back(facet);
  }
  for (const MaterialSpec& material : scatterer.materials()) {
    std::vector<Surface>& surface = surfaces_.emplace_back();
    if (material.kind == SurfaceKind::kPec && material.roughness_mm == 0) continue;
    SEAGLINT_CHECK(!wavenumbers.empty(), "the material " + material.name + " needs a wavenumber");
    for (const double k : wavenumbers) surface.emplace_back(material, k);
  }
  if (!wavenumbers.empty()) {
    lowest_ = std::ranges::min(wavenumbers);
    highest_ = std::ranges::max(wavenumbers);
  }
}

std::size_t Illumination::panels_per_chunk() const {
  return std::max(kPanelsPerChunk, (seen_.size() + kMostChunks - 1) / kMostChunks);
}

std::size_t Illumination::chunk_count() const { return (seen_.size() + panels_per_chunk() - 1) / panels_per_chunk(); }

Reached Illumination::light_all(int threads, const std::function<void(std::size_t, const PanelEchoes&)>& visit,
                                const StopFlag* stop) const {
  const std::size_t size = panels_per_chunk();
  const EchoFilter& filter = settings_.filter;
  const double faint = lowest_ > 0 ? faintest_echo(scatterer_, settings_, lowest_) : 0.0;
  std::vector<std::vector<EdgeArrival>> arrivals(chunk_count());
  std::vector<std::size_t> legs(chunk_count(), 0);
  parallel_for(
      chunk_count(), threads,
      [&](std::size_t chunk) {
        Lit lit;
        const auto panels = seen().subspan(chunk * size, std::min(size, seen_.size() - chunk * size));
        legs[chunk] = trace_beams(scene(), panels, lit, [&] {
          std::erase_if(lit.footprints, [&](const Footprint& f) {
            return !filter.keeps(f.part, f.bounces, Mechanism::kPhysicalOptics);
          });
          std::erase_if(lit.beam_ends, [&](const EdgeFootprint& end) {
            return !filter.keeps_edge(end.part, end.part_beyond, end.bounces) ||
                   (faint > 0 && bound_of_beam_end(end, lowest_, highest_) < faint);
          });
          visit(chunk, {lit.footprints, lit.beam_ends});
          lit.footprints.clear();
          lit.beam_ends.clear();
        });
        arrivals[chunk] = std::move(lit.arrivals);
      },
      stop);
  return {ArrivalsByEdge(std::move(arrivals), scatterer_.edges().edges.size()),
          std::accumulate(legs.begin(), legs.end(), std::size_t{0})};
}

BeamScene Illumination::scene() const {
  const VisibleSurface& visible = seen_from_receiver_ ? *seen_from_receiver_ : lit_;
  return {scatterer_, antennas_, settings_, lit_,
          visible,    surfaces_, min_area_, kBeamPerPiece * kBeamPerPiece * min_area_};
}

std::size_t Illumination::light(std::span<const int> facets, Lit& lit) const {
  return trace_beams(scene(), facets, lit);
}

}  // namespace seaglint
