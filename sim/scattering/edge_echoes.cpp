// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edge_echoes.h"

#include <algorithm>

#include "sim/scattering/edge_waves.h"

namespace seaglint {
namespace {

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
  const auto chunks = chunks_of(incoming);
  parallel_for(chunks.size(), threads, [&](std::size_t chunk) {
    std::vector<EdgeFootprint> answer =
        edge_footprints(scatterer.edges(), scatterer.facets(), antennas, chunks[chunk], outgoing, settings.max_bounces);
    edge_wave_footprints(scatterer.edges(), scatterer.facets(), antennas, chunks[chunk], outgoing, answer);
    std::erase_if(answer,
                  [&](const EdgeFootprint& f) { return !settings.filter.keeps_edge(f.part, f.part_beyond, f.bounces); });
    visit(chunk, answer);
  });
}

}  // namespace seaglint
