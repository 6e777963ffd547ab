// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Size of the body to which each facet belongs.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/facets.h"
#include "sim/scattering/scatterer/panel_bvh.h"

namespace seaglint {

// A surface is a set of facets connected by common vertices. Where a surface at least as large comes nearer to
// the centre of its bounding sphere than twice its radius, both belong to one body, whose size is that of its largest
// surface: the parts of a ship, their fittings and rails. Open surfaces belong to a body of closed ones only where they
// are no larger: a piece of sea or ground about a closed body is a body of its own. Sizes turn and move with a target.
struct BodySizes {
  std::vector<std::int32_t> surface_of;  // by facet
  std::vector<double> radius;            // of the bounding sphere of its body's largest surface, m, by surface

  double at(int facet) const { return radius[static_cast<std::size_t>(surface_of[static_cast<std::size_t>(facet)])]; }
};

// The tree is that of the facets.
BodySizes body_sizes(std::span<const Facet> facets, const PanelBvh& tree);

}  // namespace seaglint
