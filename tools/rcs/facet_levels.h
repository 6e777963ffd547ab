// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Level of each facet's contribution to the echo of one aspect: the hot spots of a target.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

struct FacetLevels {
  std::vector<double> dbsm;  // per facet of the scatterer
  double highest_dbsm = 0;   // dbsm_of_area(0) without any echo
};

// Levels at wavenumber k (rad/m) of an aspect's contributions. Facets of one panel (coplanar, of one part) have the
// level of their coherent sum, which does not depend on how the panel is cut. `element`: of hh, hv, vh, vv; absent: the
// largest of the four.
FacetLevels facet_levels(const Scatterer& scatterer, std::span<const Point> points, double k,
                         std::optional<std::size_t> element = std::nullopt);

// The scatterer's facets as a mesh in the body frame: one triangle per facet in their order, with their parts; no
// materials.
TriangleMesh mesh_of_facets(const Scatterer& scatterer);

}  // namespace seaglint
