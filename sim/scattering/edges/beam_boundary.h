// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Where light that mirrors send on ends. Physical optics ends a beam in a line: where a rim of a mirror casts its
// shadow on the last facet, or at that facet's own rim. With E(x) the half-plane's field behind the first rim (1 in the
// light, x < 0; 0 in the shadow), the facet lit to its own rim at x = w, psi sloping by `slope` out of the light, d the
// way between, its integral is in truth
//
//     integral of E(x) e^{jk slope x} dx to w
//         =  [ e^{jk slope^2 d / 2} (1 - E(w')) + e^{jk slope w} E(w) ] / (jk slope),   w' = w - slope d
//
// by parts (the paraxial half-plane, M. Born and E. Wolf, Principles of Optics, section 8.7): the end is the first
// rim's, on the way that its diffracted field takes, as far as that lands within the second one at w' > 0, and the
// second one's as far as it is lit. So
//
// * the end at a shadow line moves to the rim that casts it: one end is taken off there, one with the rim's own phase
//   put on where the second rim does not hide it. Both have the last facet's amplitude, so that near the direction of
//   reflection, where that is infinite, their difference is not; what the rim's exact field has besides is left to
//   reflected_edge.h.
// * two rims that lie near each other, seen either way, share their ends: with u, v = (k / 2d)^(1/2) (w, w') and F as
//   in wedge_diffraction.h,
//
//     (j / slope) e^{-j pi/4} / (2 sqrt(pi)) (F(u^2) / u - F(v^2) / v)
//
//   k times metres wide, at the phase of the way over both rims,
//
//   is what that leaves; along the wave, where slope -> 0 and u = v, it is sqrt(k d / 2 pi) e^{-j pi/4} (1 - F(u^2)): a
//   beam lacks what spreads beyond the second rim (G. Millington, R. Hewitt and F. S. Immirzi, Proc. IEE 109C (1962)
//   419-429). k d, u and v are computed from the lengths of the ways themselves, u^2 = k (sqrt(d^2 + w^2) - d).

#include <optional>
#include <span>
#include <vector>

#include "sim/scattering/edges/diffracted_paths.h"
#include "sim/scattering/edges/edge_contribution.h"

namespace seaglint {

// Of the footprints of one lit facet. `panels_on_path`: its mirrors and, last, itself; they must outlive it, as all
// arguments must.
class BeamBoundary {
 public:
  BeamBoundary(const SharpEdges& edges, const Panels& panels, const BistaticGeometry& geometry,
               std::span<const PathPanel> panels_on_path)
      : edges_(edges), panels_(panels), geometry_(geometry), panels_on_path_(panels_on_path) {}

  // Appends what the footprint lacks of the above. It fades out where half-planes end (README.md, "Where beams end"):
  // where the way from rim to rim leaves the beam, where rims cross, at panels narrower than the light's spread, and
  // where reflected_edge_weight() does.
  void append_boundary_terms(const Footprint& footprint, std::vector<EdgeContribution>& out);

 private:
  const SharpEdges& edges_;
  const Panels& panels_;
  const BistaticGeometry& geometry_;
  std::span<const PathPanel> panels_on_path_;
  std::optional<std::vector<BeamEdge>> edges_on_path_;  // once a footprint asks for them
  std::vector<Vec2> outline_;                           // of the facet's panel, in the aperture
};

// What one returns at most at any of some wavenumbers, m; 0 where it has faded out at all of them.
double boundary_term_bound(const EdgeContribution& contribution, double lowest, double highest);

}  // namespace seaglint
