// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Boundary terms of reflected beams: corrections to the sharp shadow boundary that physical optics (PO) gives a beam on
// the last panel, either at the shadow-boundary line of a bounding edge of a reflector or at an edge of the last panel.
//
// Let E(x) be the field of the half-plane formed by the first edge (1 in the lit region x < 0, 0 in the shadow), the
// last panel be illuminated up to its own edge at x = w, psi have the slope `slope` towards the shadow, and d be the
// distance between the edges. The integral over the panel is then, by parts (paraxial half-plane, M. Born and E. Wolf,
// Principles of Optics, section 8.7),
//
//     integral of E(x) e^{jk slope x} dx up to w
//         =  [ e^{jk slope^2 d / 2} (1 - E(w')) + e^{jk slope w} E(w) ] / (jk slope),   w' = w - slope d
//
// The first end-point contribution belongs to the first edge and has the phase of its diffracted path, as long as that
// path meets the panel inside the second edge (w' > 0); the second one belongs to the second edge, weighted by the
// field there. Two corrections follow:
//
// * The end-point contribution at a shadow-boundary line is subtracted there and added at the edge that casts the line,
//   with the phase of the diffracted path, unless the second edge obstructs that path. Both have the amplitude of the
//   last panel, so that their difference stays finite at the reflection shadow boundary, where each of them is
//   infinite. The rest of the exact edge field is computed in reflected_edge.h.
// * Two edges close to each other along the transmit or the receive path are coupled (double knife-edge diffraction):
//   with u, v = (k / 2d)^(1/2) (w, w') and F(x) the transition function (transition.h), the term is
//
//     (j / slope) e^{-j pi/4} / (2 sqrt(pi)) (F(u^2) / u - F(v^2) / v)
//
//   an effective width times k (dimensionless), with the phase of the path over both edges. In the forward direction,
//   where slope -> 0 and u = v, it is sqrt(k d / 2 pi) e^{-j pi/4} (1 - F(u^2)), the loss of the beam at the second
//   edge (G. Millington, R. Hewitt and F. S. Immirzi, Proc. IEE 109C (1962) 419-429). k d, u and v are computed from
//   the path lengths themselves, u^2 = k (sqrt(d^2 + w^2) - d).

#include <optional>
#include <span>
#include <vector>

#include "sim/scattering/radiation/diffracted_paths.h"
#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// Boundary terms of the footprints that one receiver sees; none when edge diffraction is off in the settings. Appends to
// `out`, which must outlive the object, as must the scene with the receiver.
class FootprintBoundary {
 public:
  FootprintBoundary(const TracingContext& scene, const Receiver& receiver, std::vector<Contribution>& out)
      : scene_(scene), geometry_(receiver.geometry), out_(out) {}

  // Once per beam and panel, with its contribution but for the polygon.
  void start(const Interaction& interaction, const Contribution& contribution);
  // Appends the boundary terms of one footprint of that beam and panel. They are tapered to zero outside the validity of
  // half-plane diffraction (README.md, "Shadow boundaries of reflected beams"): where the path from edge to edge leaves
  // the beam, where the edges cross, on panels narrower than the transition region, and as reflected_edge_weight().
  void append_terms(const Contribution& contribution);

 private:
  const TracingContext& scene_;
  const BistaticGeometry& geometry_;
  std::vector<Contribution>& out_;
  // Reflectors of the path and, last, the panel; none where there are no boundary terms.
  std::vector<PathPanel> panels_on_path_;
  std::optional<std::vector<BeamEdge>> edges_on_path_;  // computed for the first footprint that needs them
  std::vector<Vec2> outline_;                           // of the last panel, in the projection plane
};

// Upper bound of the amplitude of a boundary term over wavenumbers from `lowest` to `highest`, m; 0 where its taper is
// zero at all of them.
double boundary_term_bound(const Contribution& contribution, double lowest, double highest);

}  // namespace seaglint
