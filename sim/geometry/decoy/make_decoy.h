// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Passive decoys as they are built: trihedra of flat panels with their imperfections, and Luneburg lenses, on a float,
// a raft or a mast.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Mesh of a decoy, m. Frame: z up, origin in the middle of the reflector, the water at z = -mast_m. Equal specs give
// equal meshes. Throws InputError for a value out of its bounds and for contradictions.
//
// Reflectors, with one trihedron (of a dihedral: the bisector) towards +x:
// * icosahedral: make_icosahedral_reflector(leg sqrt2), parts cell_01..cell_20, 60 triangular panels.
// * octahedral: three plates square to each other, cut at their seams into panel_01..panel_12, eight trihedra.
//   rain_catcher: one trihedron upwards; point_up: one corner upwards.
// * trihedral_cluster: cell_01.. in a ring about the mast, apexes inwards, boresights at one elevation.
// * trihedral: panel_01..panel_03, panel k opposite to seam k; seams 1 and 2 are the lower ones to starboard and to
//   port, seam 3 is the upper one. Origin midway between the apex and the plane through the ends of the seams.
// * dihedral: panel_01, panel_02, two squares with an upright seam. Origin midway between seam and opening.
// * luneburg_lens: a sphere of radius leg_m in the parts lens and cap, the cap behind; its axis is the boresight. The
//   material of the lens has the name lens_material_name() (sim/scattering/radiation/lens_reflection.h).
// Panels are sheets. The icosahedral reflector without missing panels is closed. Fillets are in the part of their cell,
// else in `seams`.
//
// Imperfections, all keyed by (seed, Stream::kDecoy):
// * angle_error_deg: every right angle between two panels of a trihedron has this standard deviation, to first order in
//   it. Panels stay flat and seams stay closed, since only the common points of panels are displaced. Icosahedral: the
//   apex of each cell, so that each panel turns about its outer edge; the three angles of a cell are independent.
//   Others: the outer ends of the seams, each in both directions across its seam, so that each panel turns about its
//   two seams. The three angles of a trihedron are independent; the four about one seam of an octahedral reflector add
//   to 360 deg.
// * seam_errors_deg: added to the right angle at seams 1..3 of a trihedral reflector. One alone is exact.
// * surface_error_mm: displacement of each panel along its normal, the sum of the three lowest modes of a membrane with
//   normal amplitudes; rms over panels and seeds. It vanishes at seams and outer edges, which are held straight by
//   their neighbours, frame or tubes, so that it adds nothing to angle_error_deg. Panels are subdivided, with normals.
// * rounding_mm: radius of the fillets that join the panels of a trihedron; inflatable: also of tubes tube_01.. along
//   the outer edges, with joints.
// * missing_panels: removed at random; their fillets, frame and tubes stay.
// * dented_panels: at random of those left, one dent over the panel, dent_depth leg deep in its middle, to either side.
//
// Supports are closed solids in the parts float, raft, floor, mast, tether, frame_01..; float and raft are half
// submerged. The mast ends where it first touches the reflector; it passes through a ring of trihedra, with arms to
// their apexes, and stands behind the seam of a dihedral. The tether leads from the float to the water, ahead of a tow
// and astern of others.
TriangleMesh make_decoy(const DecoySpec& spec);

// The decoy of a body of a layout, counted from 0: an individual of its own where imperfections are random, keyed by
// (seed, Stream::kDecoy, body); body 0 has the seed itself.
DecoySpec decoy_of_body(DecoySpec spec, std::size_t body);

// The spec without its random imperfections, and the largest displacement of a point by them, m: a normal deviate of
// 52 bits is below 8.3.
DecoySpec without_imperfections(DecoySpec spec);
double largest_displacement_m(const DecoySpec& spec);

// Panels of the whole reflector, without those missing subtracted; 0 of a lens.
int decoy_panel_count(const DecoySpec& spec);

// Diameter of the float or raft, m; 0 without.
double decoy_float_m(const DecoySpec& spec);

// Its reflector: trihedra and panels by the points that they have in common.

// Three seams from an apex, right-handed, free space between them.
struct Trihedron {
  Vec3 apex = Vec3::Zero();
  std::array<Vec3, 3> legs{};  // the seams, from the apex to their outer ends
  std::string part;            // of its fillets
};

// Points corner + p legs[0] + q legs[1]: p, q >= 0, p + q <= 1 of a triangular panel, p, q <= 1 of a square one,
// p^2 + q^2 <= 1 of a quarter of a circle. Normal along legs[0] x legs[1].
struct TrihedronPanel {
  Vec3 corner = Vec3::Zero();
  std::array<Vec3, 2> legs{};
  std::string part;
};

struct DecoyReflector {
  DecoyPanel shape = DecoyPanel::kTriangular;
  bool has_caps = false;                 // the ends of the seams are closed between their fillets
  std::vector<Trihedron> trihedra = {};  // none of a dihedral, whose seam is legs[0] of both panels
  std::vector<TrihedronPanel> panels = {};
  std::vector<std::vector<Vec3>> outer_edges = {};  // each once, of two or more points
};

// Of a spec within its bounds, with the errors of its right angles.
DecoyReflector decoy_reflector(const DecoySpec& spec);

// Panels with their displacements, and fillets; a lens with its cap.
TriangleMesh reflector_mesh(const DecoySpec& spec, const DecoyReflector& reflector);

}  // namespace seaglint
