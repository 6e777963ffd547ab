// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/curved_reflection.h"

namespace seaglint {

BentRays travelled(const Leg& leg, const Candidate& candidate) {
  const Vec2 c = centroid(candidate.lit.polygons().front());
  BentRays rays = leg.rays;
  rays.travel(leg.from_plane.at(c) - candidate.image.plane.at(c));
  return rays;
}

Vec2 projected(const Curving& on, const Leg& leg, const Vec3& x) {
  const Vec3 image = leg.mirrors.image(x);
  return {image.dot(on.transmit.h), image.dot(on.transmit.v)};
}

std::array<Vec2, 3> projected(const Curving& on, const Leg& leg, int facet) {
  const auto& [a, b, c] = on.facets[facet].corner;
  return {projected(on, leg, a), projected(on, leg, b), projected(on, leg, c)};
}

BentRays reflected_rays(const Curving& on, const Leg& leg, const Candidate& candidate) {
  BentRays rays;
  if (leg.bent) rays = travelled(leg, candidate);
  const int facet = candidate.image.facet;
  if (!on.surface.curved(facet)) return rays;
  // Fermat: a mirror that stands higher by s shortens the path by 2 s cos(incidence).
  rays.reflect(bump(Barycentric(projected(on, leg, facet)),
                    over_edges(on, leg, facet, [](double cosine) { return 2 * cosine; })));
  return rays;
}

}  // namespace seaglint
