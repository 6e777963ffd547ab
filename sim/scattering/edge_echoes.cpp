// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edge_echoes.h"

#include <algorithm>
#include <utility>

#include "sim/scattering/edge_waves.h"

namespace seaglint {
namespace {

// Edges from this length on, in radii, have a fourth diffraction: 1.5 m on the 144 m ship. Those of its fittings would make a trace a tenth longer.
constexpr double kLongEdge = 2e-2;

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

// The same path run from the receiver to the transmitter (reciprocity).
EdgeFootprint reversed(const EdgeFootprint& footprint) {
  EdgeFootprint result = footprint;
  result.pattern = transposed(footprint.pattern);
  for (PathGradient& g : result.gradient) g = {g.receive, g.transmit, g.receive_slip, g.transmit_slip};
  return result;
}

// Edge waves, each the mean of its way and of the same way run backwards, as in single diffraction: off Keller's cone
// the wave that leaves an edge is not the one that would come back by it. One antenna's backward ways are its forward
// ones.
void append_edge_waves(const Scatterer& scatterer, const AntennaPair& antennas,
                       std::span<const EdgeArrival> incoming_chunk, std::span<const EdgeArrival> incoming,
                       std::span<const EdgeArrival> outgoing_chunk, std::span<const EdgeArrival> outgoing,
                       const EdgeWaveLimits& limits, std::vector<EdgeFootprint>& answer) {
  const std::size_t first = answer.size();
  edge_wave_footprints(scatterer.edges(), scatterer.facets(), antennas, incoming_chunk, outgoing, limits, answer);
  const std::span there(answer.begin() + first, answer.end());
  if (antennas.monostatic) {
    for (EdgeFootprint& f : there) {
      f.pattern += transposed(f.pattern);
      f.pattern *= 0.5;
    }
    return;
  }
  std::vector<EdgeFootprint> back;
  edge_wave_footprints(scatterer.edges(), scatterer.facets(), {antennas.receive, antennas.transmit, false},
                       outgoing_chunk, incoming, limits, back);
  for (const EdgeFootprint& f : back) answer.push_back(reversed(f));
  for (std::size_t i = first; i < answer.size(); ++i) answer[i].pattern *= 0.5;
}

}  // namespace

void edge_echoes(const Scatterer& scatterer, const AntennaPair& antennas, const IlluminationSettings& settings,
                 std::span<const double> wavenumbers, std::span<const EdgeArrival> incoming, int threads,
                 const std::function<void(std::size_t, std::span<const EdgeFootprint>)>& visit) {
  if (!settings.edges) return;
  Reached backwards;
  if (!antennas.monostatic) {
    backwards = Illumination(scatterer, monostatic(antennas.receive), settings, threads, wavenumbers)
                    .light_all(threads, [](std::size_t, auto) {});
  }
  const std::span<const EdgeArrival> outgoing = antennas.monostatic ? incoming : backwards.arrivals;
  const double lowest = *std::ranges::min_element(wavenumbers);
  const EdgeWaveLimits limits{kLongEdge * scatterer.radius(), faintest_echo(scatterer, settings, lowest), lowest};
  const auto chunks = chunks_of(incoming), chunks_back = chunks_of(outgoing);
  parallel_for(chunks.size(), threads, [&](std::size_t chunk) {
    std::vector<EdgeFootprint> answer =
        edge_footprints(scatterer.edges(), scatterer.facets(), antennas, chunks[chunk], outgoing, settings.max_bounces);
    append_edge_waves(scatterer, antennas, chunks[chunk], incoming, chunks_back[chunk], outgoing, limits, answer);
    std::erase_if(answer,
                  [&](const EdgeFootprint& f) { return !settings.filter.keeps_edge(f.part, f.part_beyond, f.bounces); });
    visit(chunk, answer);
  });
}

}  // namespace seaglint
