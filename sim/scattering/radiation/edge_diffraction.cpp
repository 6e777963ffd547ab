// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/edge_diffraction.h"

#include <algorithm>

#include "sim/core/process/parallel.h"

namespace seaglint {
namespace {

// In sides of the smallest illuminated patch kept.
constexpr double kMinRunForMultiple = 42, kMinRunForHighOrder = 280;

// Multiple diffraction that starts at an edge, and paths that end at it where it is concave. For one antenna it is the
// mean of a path and its reciprocal, as single diffraction is. For two antennas it is that of the transmitter's wave:
// near grazing physical optics, single and multiple diffraction are all large, and only terms of the same wave cancel.
void append_multiple_diffraction(const Scatterer& scatterer, const BistaticGeometry& geometry, int edge,
                                 const IlluminationByEdge& incoming, const IlluminationByEdge& outgoing,
                                 const MultipleDiffractionLimits& limits,
                                 std::vector<EdgeContribution>& contributions) {
  const std::size_t first = contributions.size();
  trace_multiple_diffraction(scatterer.edges(), scatterer.facets(), scatterer.panels(), geometry, incoming.of(edge),
                             outgoing, limits, contributions);
  trace_diffraction_to_concave_edges(scatterer.edges(), scatterer.facets(), scatterer.panels(), geometry, incoming,
                                     outgoing.of(edge), limits, contributions);
  if (!geometry.monostatic) return;
  for (EdgeContribution& c : std::span(contributions).subspan(first)) c.pattern = reciprocal_mean(c.pattern, c.pattern);
}

// Materials of the target at every wavenumber, ascending, for the edges that they bound.
class EdgeMaterials {
 public:
  EdgeMaterials(const Scatterer& scatterer, std::span<const double> wavenumbers)
      : scatterer_(scatterer), wavenumbers_(wavenumbers.begin(), wavenumbers.end()) {
    if (std::ranges::all_of(scatterer.edges().edges, &SharpEdge::conducts)) return;
    std::ranges::sort(wavenumbers_);
    for (const MaterialSpec& material : scatterer.materials()) {
      std::vector<MaterialSurface>& surfaces = surfaces_.emplace_back();
      for (const double k : wavenumbers_) surfaces.emplace_back(material, k);
    }
  }

  // Surfaces of both faces per wavenumber; empty for perfect conductors.
  std::vector<MaterialFaces> of(const SharpEdge& edge) const {
    std::vector<MaterialFaces> faces;
    if (edge.conducts) return faces;
    const auto material = [&](int i) { return scatterer_.facets()[edge.facet[i]].material; };
    const MaterialSpec& first = scatterer_.materials()[material(0)];
    const bool is_sheet = edge.is_free_edge() && first.kind == SurfaceKind::kLayers && first.backing == Backing::kAir;
    for (std::size_t q = 0; q < wavenumbers_.size(); ++q)
      faces.push_back({{&surfaces_[material(0)][q], &surfaces_[material(1)][q]}, wavenumbers_[q], is_sheet});
    return faces;
  }

 private:
  const Scatterer& scatterer_;
  std::vector<double> wavenumbers_;
  std::vector<std::vector<MaterialSurface>> surfaces_;  // [material][wavenumber]
};

}  // namespace

MultipleDiffractionLimits multiple_diffraction_limits(const Scatterer& scatterer, const TracingSettings& settings,
                                                      double lowest) {
  const double patch = min_patch(scatterer, settings);
  return {kMinRunForMultiple * patch, kMinRunForHighOrder * patch, min_amplitude(scatterer, settings, lowest), lowest};
}

void edge_diffraction(const Scatterer& scatterer, const BistaticGeometry& geometry, const TracingSettings& settings,
                      std::span<const double> wavenumbers, const IlluminationByEdge& incoming,
                      const IlluminationByEdge& outgoing, int threads,
                      const std::function<void(std::size_t, std::span<const EdgeContribution>)>& visit) {
  if (!settings.edges) return;
  const MultipleDiffractionLimits limits =
      multiple_diffraction_limits(scatterer, settings, std::ranges::min(wavenumbers));
  const std::vector<SharpEdge>& edges = scatterer.edges().edges;
  const EdgeMaterials materials(scatterer, wavenumbers);
  // Chunks with about equal numbers of edge illuminations.
  const auto chunk_start = [&](std::size_t chunk) {
    return chunk < kEdgeChunks ? incoming.edge_after(incoming.all().size() * chunk / kEdgeChunks)
                               : static_cast<int>(edges.size());
  };
  parallel_for(kEdgeChunks, threads, [&](std::size_t chunk) {
    std::vector<EdgeContribution> contributions;
    for (int edge = chunk_start(chunk); edge < chunk_start(chunk + 1); ++edge) {
      contributions.clear();
      append_single_diffraction(edges[edge], scatterer.facets(), geometry, incoming.of(edge), outgoing.of(edge),
                                settings.max_bounces, materials.of(edges[edge]), contributions);
      if (edges[edge].conducts)
        append_multiple_diffraction(scatterer, geometry, edge, incoming, outgoing, limits, contributions);
      std::erase_if(contributions, [&](const EdgeContribution& f) {
        return !settings.filter.accepts_edge(f.part, f.other_part, f.bounces, f.mechanism);
      });
      if (!contributions.empty()) visit(chunk, contributions);
    }
  });
}

}  // namespace seaglint
