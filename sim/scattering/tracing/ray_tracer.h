// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shooting and bouncing rays: rays find the reflectors and obstacles of every tile of a lattice, and tubes of rays with
// equal sequences illuminate them (H. Ling, R.-C. Chou and S.-W. Lee, IEEE Trans. AP-37, 1989, 194-205).

#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "sim/scattering/tracing/beam_tracer.h"
#include "sim/scattering/tracing/interaction.h"
#include "sim/scattering/tracing/ray_paths.h"

namespace seaglint {

// Adaptive rays of a tile: cells of the lattice are halved where their rays differ from those around, as long as that
// finds reflectors or obstacles not met there before.
class RayRefinement {
 public:
  // Both must outlive the object.
  RayRefinement(const RayLattice& lattice, RayPaths& paths) : lattice_(lattice), paths_(paths) {}

  // Traces all rays of the tile into the paths.
  void trace(std::size_t tile);

 private:
  // A cell with its ray and the signatures met in it and next to it, a range of known_.
  struct Cell {
    LatticeCell at;
    Vec2 ray;
    std::uint64_t signature = 0;
    std::size_t first_known = 0, last_known = 0;
  };

  void trace_coarse(std::size_t tile);
  void halve(const std::vector<Cell>& cells, std::vector<Cell>& next);
  void trace_rays();

  const RayLattice& lattice_;
  RayPaths& paths_;
  std::vector<Cell> cells_, quarters_;
  std::vector<std::uint64_t> known_, next_known_;
  std::vector<Vec2> rays_;
  std::vector<std::uint64_t> signatures_;
};

// The panels that rays found, and their neighbours on the mesh, whose illuminated part may be too narrow for a ray, as
// the search of the beam tracer. Scene and paths must outlive it.
class RaySearch : public PanelSearch {
 public:
  RaySearch(const TracingContext& scene, const RayPaths& paths)
      : scene_(scene), paths_(paths), found_by_(scene.scatterer.facets().size(), 0) {}

  void find(const BeamSegment& segment, const PolygonSet& cross_section, std::vector<FoundPanel>& found) const override;
  void find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                    std::vector<MovingPolygon>& visible) const override;
  bool may_be_seen(int) const override { return true; }

 private:
  const BvhPanel* panel(int facet) const;

  const TracingContext& scene_;
  const RayPaths& paths_;
  // Work memory: panels by their first facet, and the last search that found them.
  mutable std::unordered_map<int, BvhPanel> panels_;
  mutable std::vector<std::uint64_t> found_by_;
  mutable std::uint64_t searches_ = 0;
};

// Traces the tiles first <= i < last of the lattice, whose projection plane is that of the scene's transmitter, and
// returns the number of segments of tubes. Calls after_each() when the tubes of one tile are complete.
std::size_t trace_rays(
    const TracingContext& scene, const RayLattice& lattice, std::size_t first, std::size_t last,
    InteractionVisitor& visitor, const std::function<void()>& after_each = [] {});

}  // namespace seaglint
