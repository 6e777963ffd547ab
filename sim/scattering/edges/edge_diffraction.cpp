// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/edge_diffraction.h"

#include <algorithm>

#include "sim/core/process/parallel.h"

namespace seaglint {
namespace {

// In ray spacings.
constexpr double kEdgeWavesFrom = 3, kLongEdge = 20;

// Edge waves that start at an edge, and ways that end in it where it is a corner. With one antenna each is the mean of
// its way and of the same way run backwards, as in single diffraction: off Keller's cone the wave that leaves an edge
// is not the one that would come back by it. With two antennas they are the transmitter's, as physical optics and
// single diffraction are: near grazing all three are large, and only what one wave lights cancels.
void append_edge_waves(const Scatterer& scatterer, const AntennaPair& antennas, int edge,
                       const ArrivalsByEdge& incoming, const ArrivalsByEdge& outgoing, const EdgeWaveLimits& limits,
                       std::vector<EdgeFootprint>& answer) {
  const std::size_t first = answer.size();
  edge_wave_footprints(scatterer.edges(), scatterer.facets(), scatterer.panels(), antennas, incoming.of(edge), outgoing,
                       limits, answer);
  corner_wave_footprints(scatterer.edges(), scatterer.facets(), scatterer.panels(), antennas, incoming,
                         outgoing.of(edge), limits, answer);
  if (!antennas.monostatic) return;
  for (EdgeFootprint& f : std::span(answer).subspan(first)) {
    f.pattern += transposed(f.pattern);
    f.pattern *= 0.5;
  }
}

}  // namespace

EdgeWaveLimits edge_wave_limits(const Scatterer& scatterer, const IlluminationSettings& settings, double lowest) {
  const double spacing = ray_spacing(scatterer, settings);
  return {kEdgeWavesFrom * spacing, kLongEdge * spacing, faintest_echo(scatterer, settings, lowest), lowest};
}

void edge_echoes(const Scatterer& scatterer, const AntennaPair& antennas, const IlluminationSettings& settings,
                 std::span<const double> wavenumbers, const ArrivalsByEdge& incoming, const ArrivalsByEdge& outgoing,
                 int threads, const std::function<void(std::size_t, std::span<const EdgeFootprint>)>& visit) {
  if (!settings.edges) return;
  const EdgeWaveLimits limits = edge_wave_limits(scatterer, settings, std::ranges::min(wavenumbers));
  const std::vector<SharpEdge>& edges = scatterer.edges().edges;
  // Chunks of about as many arrivals.
  const auto chunk_start = [&](std::size_t chunk) {
    return chunk < kEdgeChunks ? incoming.edge_after(incoming.all().size() * chunk / kEdgeChunks)
                               : static_cast<int>(edges.size());
  };
  parallel_for(kEdgeChunks, threads, [&](std::size_t chunk) {
    std::vector<EdgeFootprint> answer;
    for (int edge = chunk_start(chunk); edge < chunk_start(chunk + 1); ++edge) {
      answer.clear();
      edge_footprints(edges[edge], scatterer.facets(), antennas, incoming.of(edge), outgoing.of(edge),
                      settings.max_bounces, answer);
      append_edge_waves(scatterer, antennas, edge, incoming, outgoing, limits, answer);
      std::erase_if(answer, [&](const EdgeFootprint& f) {
        return !settings.filter.keeps_edge(f.part, f.part_beyond, f.bounces);
      });
      if (!answer.empty()) visit(chunk, answer);
    }
  });
}

}  // namespace seaglint
