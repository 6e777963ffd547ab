// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edge_echoes.h"

#include <algorithm>

namespace seaglint {
namespace {

// In ray spacings.
constexpr double kEdgeWavesFrom = 3, kLongEdge = 20;

// The arrivals cut into chunks of about the same size; one edge's stay together.
std::vector<std::span<const EdgeArrival>> chunks_of(std::span<const EdgeArrival> arrivals) {
  std::vector<std::span<const EdgeArrival>> chunks;
  std::size_t first = 0;
  for (std::size_t c = 1; c <= kEdgeChunks; ++c) {
    std::size_t last = std::max(first, arrivals.size() * c / kEdgeChunks);
    while (last > first && last < arrivals.size() && arrivals[last].edge == arrivals[last - 1].edge) ++last;
    chunks.push_back(arrivals.subspan(first, last - first));
    first = last;
  }
  return chunks;
}

// The arrivals of one antenna, and one chunk of them.
struct Ways {
  std::span<const EdgeArrival> all, chunk;
};

// Edge waves. With one antenna each is the mean of its way and of the same way run backwards, as in single diffraction:
// off Keller's cone the wave that leaves an edge is not the one that would come back by it. With two antennas they are
// the transmitter's, as physical optics and single diffraction are: near grazing all three are large, and only what one
// wave lights cancels. Of either list one chunk, with the whole of the other.
void append_edge_waves(const Scatterer& scatterer, const AntennaPair& antennas, const Ways& incoming,
                       const Ways& outgoing, const EdgeWaveLimits& limits, std::vector<EdgeFootprint>& answer) {
  const std::size_t first = answer.size();
  edge_wave_footprints(scatterer.edges(), scatterer.facets(), scatterer.panels(), antennas, incoming.chunk,
                       outgoing.all, limits, answer);
  corner_wave_footprints(scatterer.edges(), scatterer.facets(), scatterer.panels(), antennas, incoming.all,
                         outgoing.chunk, limits, answer);
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
                 std::span<const double> wavenumbers, const Reached& reached, int threads,
                 const std::function<void(std::size_t, std::span<const EdgeFootprint>)>& visit) {
  if (!settings.edges) return;
  Reached backwards;
  if (!antennas.monostatic) {
    backwards = Illumination(scatterer, monostatic(antennas.receive), settings, threads, wavenumbers)
                    .light_all(threads, [](std::size_t, auto) {});
  }
  const std::span<const EdgeArrival> incoming = reached.arrivals,
                                     outgoing = antennas.monostatic ? incoming : backwards.arrivals;
  const EdgeWaveLimits limits = edge_wave_limits(scatterer, settings, std::ranges::min(wavenumbers));
  const auto chunks = chunks_of(incoming), chunks_out = chunks_of(outgoing);
  const std::span<const EdgeFootprint> beam_ends = reached.beam_ends;
  parallel_for(chunks.size(), threads, [&](std::size_t chunk) {
    std::vector<EdgeFootprint> answer =
        edge_footprints(scatterer.edges(), scatterer.facets(), antennas, chunks[chunk], outgoing, settings.max_bounces);
    append_edge_waves(scatterer, antennas, {incoming, chunks[chunk]}, {outgoing, chunks_out[chunk]}, limits, answer);
    const auto share = [&](std::size_t c) { return beam_ends.begin() + beam_ends.size() * c / chunks.size(); };
    answer.insert(answer.end(), share(chunk), share(chunk + 1));
    std::erase_if(
        answer, [&](const EdgeFootprint& f) { return !settings.filter.keeps_edge(f.part, f.part_beyond, f.bounces); });
    visit(chunk, answer);
  });
}

}  // namespace seaglint
