// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/ray_tracer.h"

#include <algorithm>
#include <span>
#include <utility>

namespace seaglint {

namespace {

// Coarse rays are traced in squares of this side, so that packets of 16 are compact.
constexpr std::int64_t kPacketSide = 4;

}  // namespace

void RayRefinement::trace_rays() {
  signatures_.resize(rays_.size());
  paths_.trace(rays_, signatures_);
}

void RayRefinement::trace(std::size_t tile) {
  paths_.start();
  const std::span<const Vec2> aimed = lattice_.aimed(tile);
  rays_.assign(aimed.begin(), aimed.end());
  trace_rays();
  trace_coarse(tile);
  for (int level = 0; level < RayLattice::kHalvings && !cells_.empty(); ++level) {
    halve(cells_, quarters_);
    cells_.swap(quarters_);
    known_.swap(next_known_);
  }
  paths_.finish();
}

// Traces the ray of every coarse cell, and leaves in cells_ those that differ from one of their eight neighbours.
void RayRefinement::trace_coarse(std::size_t tile) {
  constexpr std::int64_t side = RayLattice::kTileSide;
  rays_.clear();
  std::vector<std::uint64_t> of_cell(side * side);
  std::vector<std::size_t> place;
  for (std::int64_t j = 0; j < side; j += kPacketSide) {
    for (std::int64_t i = 0; i < side; i += kPacketSide) {
      for (std::int64_t n = 0; n < kPacketSide * kPacketSide; ++n) {
        const std::int64_t column = i + n % kPacketSide, row = j + n / kPacketSide;
        rays_.push_back(lattice_.ray(lattice_.cell(tile, column, row)));
        place.push_back(static_cast<std::size_t>(row * side + column));
      }
    }
  }
  trace_rays();
  for (std::size_t n = 0; n < place.size(); ++n) of_cell[place[n]] = signatures_[n];
  cells_.clear();
  known_.clear();
  for (std::size_t n = 0; n < place.size(); ++n) {
    const auto row = static_cast<std::int64_t>(place[n]) / side, column = static_cast<std::int64_t>(place[n]) % side;
    const std::size_t first = known_.size();
    for (std::int64_t j = std::max<std::int64_t>(row - 1, 0); j <= std::min(row + 1, side - 1); ++j) {
      for (std::int64_t i = std::max<std::int64_t>(column - 1, 0); i <= std::min(column + 1, side - 1); ++i) {
        const std::uint64_t signature = of_cell[static_cast<std::size_t>(j * side + i)];
        if (std::find(known_.begin() + static_cast<std::ptrdiff_t>(first), known_.end(), signature) == known_.end())
          known_.push_back(signature);
      }
    }
    if (known_.size() - first == 1) {
      known_.pop_back();
    } else {
      cells_.push_back({lattice_.cell(tile, column, row), rays_[n], signatures_[n], first, known_.size()});
    }
  }
}

// Traces the rays of the quarters of all cells, one of which has that of the whole cell, and leaves in `next` the
// quarters of those cells in which a signature was new.
void RayRefinement::halve(const std::vector<Cell>& cells, std::vector<Cell>& next) {
  rays_.clear();
  next.clear();
  for (const Cell& cell : cells) {
    const LatticeCell own = lattice_.quarter(cell.at, cell.ray);
    for (const std::int64_t j : {0, 1}) {
      for (const std::int64_t i : {0, 1}) {
        const LatticeCell quarter{cell.at.level + 1, 2 * cell.at.column + i, 2 * cell.at.row + j};
        const bool has_ray = quarter.column == own.column && quarter.row == own.row;
        next.push_back({quarter, has_ray ? cell.ray : lattice_.ray(quarter), cell.signature, 0, 0});
        if (!has_ray) rays_.push_back(next.back().ray);
      }
    }
  }
  trace_rays();
  next_known_.clear();
  std::size_t ray = 0, kept = 0;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const Cell& cell = cells[n];
    const std::size_t first = next_known_.size();
    next_known_.insert(next_known_.end(), known_.begin() + static_cast<std::ptrdiff_t>(cell.first_known),
                       known_.begin() + static_cast<std::ptrdiff_t>(cell.last_known));
    const std::size_t before = next_known_.size();
    for (std::size_t q = 4 * n; q < 4 * n + 4; ++q) {
      if (next[q].ray == cell.ray) continue;
      next[q].signature = signatures_[ray++];
      if (std::find(next_known_.begin() + static_cast<std::ptrdiff_t>(first), next_known_.end(), next[q].signature) ==
          next_known_.end())
        next_known_.push_back(next[q].signature);
    }
    if (next_known_.size() == before) {
      next_known_.resize(first);
      continue;
    }
    for (std::size_t q = 4 * n; q < 4 * n + 4; ++q) {
      next[q].first_known = first;
      next[q].last_known = next_known_.size();
      next[kept++] = next[q];
    }
  }
  next.resize(kept);
}

const BvhPanel* RaySearch::panel(int facet) const {
  const auto [place, is_new] = panels_.try_emplace(facet);
  if (is_new) place->second = bvh_panel(scene_.scatterer.facets(), scene_.scatterer.panels(), facet);
  return &place->second;
}

void RaySearch::find(const BeamSegment& segment, const PolygonSet&, std::vector<FoundPanel>& found) const {
  if (segment.path < 0) return;
  const std::uint64_t search = ++searches_;
  const auto mark = [&](int facet) {
    return std::exchange(found_by_[static_cast<std::size_t>(facet)], search) != search;
  };
  if (segment.source_facet != kNoFacet) mark(segment.source_facet);
  const std::size_t first = found.size();
  for (int child = paths_.path(segment.path).first_child; child >= 0; child = paths_.path(child).next_sibling) {
    mark(paths_.path(child).facet);
    found.push_back({panel(paths_.path(child).facet), child});
  }
  const Panels& panels = scene_.scatterer.panels();
  for (std::size_t met = first, end = found.size(); met < end; ++met) {
    for (const int member : panels.members(found[met].panel->facet)) {
      for (const std::int32_t across : scene_.scatterer.facets()[member].neighbour) {
        if (across < 0) continue;
        const int neighbour = panels.representative(across);
        if (paths_.is_lit(neighbour, segment.direction) && mark(neighbour)) found.push_back({panel(neighbour), -1});
      }
    }
  }
}

void RaySearch::find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                             std::vector<MovingPolygon>& visible) const {
  const std::span<const MovingPolygon> illuminated = candidate.illuminated.polygons();
  const std::span<const Obstacle> obstacles = paths_.obstacles(candidate.path, receiver);
  if (obstacles.empty()) {
    visible.insert(visible.end(), illuminated.begin(), illuminated.end());
    return;
  }
  const Scatterer& target = scene_.scatterer;
  const RadarBasis& receive = scene_.receivers[receiver].geometry.receive;
  const Facet& facet = target.facets()[candidate.projection.facet];
  const double min_area = scene_.min_area.on(candidate.projection.facet);
  ProjectedPanel own, obstacle;
  own.facet = candidate.projection.facet;
  own.plane = depth_plane(facet.normal, facet.offset, receive);
  const PanelMap map(own.plane, receive, segment.image_transform, scene_.transmit);
  PolygonSet left;
  left.assign(illuminated);
  for (const Obstacle& found : obstacles) {
    if (found.facet == own.facet ||
        !project_panel(obstacle, bvh_panel(target.facets(), target.panels(), found.facet), {}, receive, min_area))
      continue;
    const MovingPolygon nearer = nearer_part(obstacle, own);
    if (nearer.empty()) continue;
    const MovingPolygon shadow = map.mapped(nearer);
    left.subtract_hole(shadow, box_of(shadow), min_area);
  }
  visible.insert(visible.end(), left.polygons().begin(), left.polygons().end());
}

std::size_t trace_rays(const TracingContext& scene, const RayLattice& lattice, std::size_t first, std::size_t last,
                       InteractionVisitor& visitor, const std::function<void()>& after_each) {
  std::size_t segments = 0;
  RayPaths paths(scene);
  const RaySearch search(scene, paths);
  RayRefinement refinement(lattice, paths);
  for (std::size_t tile = first; tile < last; ++tile) {
    refinement.trace(tile);
    segments += trace_window(scene, search, lattice.window(tile), 0, visitor);
    after_each();
  }
  return segments;
}

}  // namespace seaglint
