// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/curved_reflection.h"

namespace seaglint {

ParaxialBundle propagated_to(const BeamSegment& segment, const CandidatePanel& candidate) {
  const Vec2 c = centroid(candidate.illuminated.polygons().front());
  ParaxialBundle bundle = segment.ray_bundle;
  bundle.propagate(segment.source_plane.at(c) - candidate.projection.plane.at(c));
  return bundle;
}

Vec2 projected(const CurvatureContext& on, const BeamSegment& segment, const Vec3& x) {
  const Vec3 image = segment.image_transform.image(x);
  return {image.dot(on.transmit.h), image.dot(on.transmit.v)};
}

std::array<Vec2, 3> projected(const CurvatureContext& on, const BeamSegment& segment, int facet) {
  const auto& [a, b, c] = on.facets[facet].corner;
  return {projected(on, segment, a), projected(on, segment, b), projected(on, segment, c)};
}

ParaxialBundle reflected_bundle(const CurvatureContext& on, const BeamSegment& segment,
                                const CandidatePanel& candidate) {
  ParaxialBundle bundle;
  if (segment.has_curved_reflection) bundle = propagated_to(segment, candidate);
  const int facet = candidate.projection.facet;
  if (!on.surface.curved(facet)) return bundle;
  // Fermat: a reflector higher by s shortens the path by 2 s cos(incidence).
  bundle.reflect(edge_midpoint_quadratic(Barycentric(projected(on, segment, facet)),
                                         edge_sagittas(on, segment, facet, [](double cosine) { return 2 * cosine; })));
  return bundle;
}

}  // namespace seaglint
