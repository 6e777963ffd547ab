// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/response/illumination.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scattering/beams/beam_tracer.h"
#include "sim/scattering/edges/beam_boundary.h"
#include "sim/scattering/edges/beam_edges.h"
#include "sim/scattering/surfaces/beam_contributions.h"

namespace seaglint {
namespace {

// Side of the smallest beam that goes on to further mirrors, in those of pieces: 18 mm on the ship. Pieces half as
// large and beams twice as large as one size for both err less and cost the same (README.md).
constexpr double kBeamPerPiece = 3.6;
// A large mesh has larger chunks of panels: what is kept per chunk and frequency stays below 100 MB for 640
// frequencies.
constexpr std::size_t kPanelsPerChunk = 64;
constexpr std::size_t kMostChunks = 2048;

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

// Writes down what the legs of one illumination light and what its receivers see.
class LitRecorder : public BeamVisitor {
 public:
  LitRecorder(const BeamScene& scene, Lit& out) : scene_(scene), out_(out) {
    out.seen.resize(scene.receivers.size());
    ends_.reserve(out.seen.size());  // echoes refer to them
    for (std::size_t i = 0; i < out.seen.size(); ++i) {
      const Receiver& receiver = scene.receivers[i];
      echoes_.emplace_back(scene, receiver, out.seen[i].footprints,
                           &ends_.emplace_back(scene, receiver, out.seen[i].beam_ends));
    }
  }

  bool wants(const Leg& leg) const override { return reaches_edges(scene_, leg); }
  void lit(const Leg& leg, const Candidate& candidate) override {
    if (reaches_edges(scene_, leg)) reach_edges(scene_, leg, candidate, out_.arrivals);
  }
  void seen(const Leg& leg, const Candidate& candidate, std::size_t receiver,
            std::span<const MovingPolygon> pieces) override {
    echoes_[receiver].radiate(leg, candidate, pieces);
    echoes_[receiver].radiate_back(leg, candidate, pieces);
  }

 private:
  const BeamScene& scene_;
  Lit& out_;
  std::vector<FootprintEnds> ends_;
  std::vector<BeamEcho> echoes_;
};

Aspects aspects_of(const Scatterer& scatterer, const AntennaPair& antennas, const IlluminationSettings& settings,
                   int threads) {
  const auto seen_along = [&](const RadarBasis& direction) {
    return std::make_shared<const Aspect>(scatterer, direction, settings, threads);
  };
  return {seen_along(antennas.transmit), {antennas.monostatic ? nullptr : seen_along(antennas.receive)}};
}

}  // namespace

Aspect::Aspect(const Scatterer& scatterer, const RadarBasis& direction, const IlluminationSettings& settings,
               int threads)
    : basis(looking_aside(scatterer, direction, settings.edges)),
      visible(scatterer.facets(), scatterer.panels(), scatterer.tree(), basis, smallest_area(scatterer, settings),
              threads) {}

Illumination::Illumination(const Scatterer& scatterer, Aspects aspects, const IlluminationSettings& settings,
                           std::span<const double> wavenumbers)
    : scatterer_(scatterer), settings_(settings), aspects_(std::move(aspects)) {
  const Aspect& transmitter = *aspects_.transmitter;
  for (const auto& receiver : aspects_.receivers) {
    if (receiver) {
      receivers_.push_back({bistatic(transmitter.basis, receiver->basis), &receiver->visible});
    } else {
      receivers_.push_back({monostatic(transmitter.basis), &transmitter.visible});
    }
  }
  for (int facet = 0; facet < static_cast<int>(scatterer.facets().size()); ++facet) {
    if (!transmitter.visible.pieces(facet).empty()) seen_.push_back(facet);
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

Illumination::Illumination(const Scatterer& scatterer, const AntennaPair& antennas,
                           const IlluminationSettings& settings, int threads, std::span<const double> wavenumbers)
    : Illumination(scatterer, aspects_of(scatterer, antennas, settings, threads), settings, wavenumbers) {}

std::size_t Illumination::panels_per_chunk() const {
  return std::max(kPanelsPerChunk, (seen_.size() + kMostChunks - 1) / kMostChunks);
}

std::size_t Illumination::chunk_count() const { return (seen_.size() + panels_per_chunk() - 1) / panels_per_chunk(); }

Reached Illumination::light_all(int threads, const Visit& visit, const StopFlag* stop) const {
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
        const BeamScene of_chunk = scene();
        LitRecorder recorder(of_chunk, lit);
        legs[chunk] = trace_beams(of_chunk, panels, recorder, [&] {
          for (std::size_t receiver = 0; receiver < lit.seen.size(); ++receiver) {
            auto& [footprints, beam_ends] = lit.seen[receiver];
            std::erase_if(footprints, [&](const Footprint& f) {
              return !filter.keeps(f.part, f.bounces, Mechanism::kPhysicalOptics);
            });
            std::erase_if(beam_ends, [&](const EdgeFootprint& end) {
              return !filter.keeps_edge(end.part, end.part_beyond, end.bounces) ||
                     (faint > 0 && bound_of_beam_end(end, lowest_, highest_) < faint);
            });
            visit(chunk, receiver, {footprints, beam_ends});
            footprints.clear();
            beam_ends.clear();
          }
        });
        arrivals[chunk] = std::move(lit.arrivals);
      },
      stop);
  return {ArrivalsByEdge(std::move(arrivals), scatterer_.edges().edges.size()),
          std::accumulate(legs.begin(), legs.end(), std::size_t{0})};
}

BeamScene Illumination::scene() const {
  const double min_area = smallest_area(scatterer_, settings_);
  const auto& [basis, visible] = *aspects_.transmitter;
  return {scatterer_, basis,     receivers_, settings_,
          visible,    surfaces_, min_area,   kBeamPerPiece * kBeamPerPiece * min_area};
}

std::size_t Illumination::light(std::span<const int> facets, Lit& lit) const {
  const BeamScene of_facets = scene();
  LitRecorder recorder(of_facets, lit);
  return trace_beams(of_facets, facets, recorder);
}

}  // namespace seaglint
