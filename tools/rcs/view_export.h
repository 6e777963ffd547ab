// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Levels of the contributions of every facet, and the scattering centres and facets of a view as a file.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// Level of each facet's contribution to the echo of one aspect: the hot spots of a target.

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

// Exports of the contributions at one aspect and frequency: scattering centres, hot spots on the mesh.

// Writes the exports of a request with one aspect from the contributions at that aspect (rcs_views.h); returns one line
// per file.
std::string export_view(const RcsRequest& request, const RcsTarget& target, std::span<const Point> points);

}  // namespace seaglint
