// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/facet_levels.h"

#include <algorithm>
#include <array>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/scattering/sums/scattering_centres_3d.h"

namespace seaglint {

FacetLevels facet_levels(const Scatterer& scatterer, std::span<const Point> points, double k,
                         std::optional<std::size_t> element) {
  const std::size_t facets = scatterer.facets().size();
  const auto panel_of = [&](std::size_t facet) {
    return static_cast<std::size_t>(scatterer.panels().representative(static_cast<int>(facet)));
  };
  const std::vector<std::array<Complex, 4>> echoes = facet_contributions(points, k, facets);
  std::vector<std::array<Complex, 4>> panel(facets);
  for (std::size_t f = 0; f < facets; ++f) {
    for (std::size_t i = 0; i < 4; ++i) panel[panel_of(f)][i] += echoes[f][i];
  }
  FacetLevels levels{std::vector<double>(facets), dbsm_of_area(0)};
  for (std::size_t f = 0; f < facets; ++f) {
    double most = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (!element || *element == i) most = std::max(most, std::norm(panel[panel_of(f)][i]));
    levels.dbsm[f] = dbsm_of_area(4 * kPi * most);
    levels.highest_dbsm = std::max(levels.highest_dbsm, levels.dbsm[f]);
  }
  return levels;
}

TriangleMesh mesh_of_facets(const Scatterer& scatterer) {
  TriangleMesh mesh;
  for (const Facet& facet : scatterer.facets()) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : facet.corner) mesh.vertices.push_back(scatterer.centre() + corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangle_part.push_back(facet.part);
  }
  return mesh;
}

}  // namespace seaglint
