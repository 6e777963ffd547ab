// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bodies of a target: which facets belong together, and their size.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/target/facets.h"
#include "sim/scattering/target/panel_bvh.h"

namespace seaglint {

// A surface is a set of facets connected by common vertices. Surfaces that meet or intersect, to 1e-6 of the target's
// radius, form one body: the parts of a ship. An open surface larger than the body of closed ones that it meets, a
// piece of sea or ground around it, is a body of its own; so are surfaces that meet no other.
struct Bodies {
  std::vector<std::int32_t> of_facet;
  std::vector<double> radius;  // of each body's bounding sphere about its own centre, m
};

// radius: of the target, m. The tree is that of the facets.
Bodies find_bodies(std::span<const Facet> facets, const PanelBvh& tree, double radius);

}  // namespace seaglint
