// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What stands on a ship's decks and walls: deckhouses, masts, cranes, cargo, boats, rails and small fittings. Each
// solid is closed and faces outwards; bodies that stand on others overlap them slightly, so that no two faces
// coincide. Lengths in m, slopes and headings in degrees, body frame.

#include <string>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/ship/hull.h"

namespace seaglint {

// Uniform between two bounds.
double between(Random& random, double low, double high);

// A deckhouse: a frustum on an octagon, its walls inclined inwards. Heights above the waterline; wall slopes from the
// vertical in degrees.
struct Deckhouse {
  std::string name;
  double aft = 0, fore = 0;   // at the foot
  double half_width = 0;      // at the foot
  double foot = 0, roof = 0;  // m above the waterline
  double side_slope = 8, fore_slope = 12, aft_slope = 6;
  double fore_chamfer = 2.5, aft_chamfer = 0.8;  // chamfer of the vertical edges

  double half_width_at(double z) const;
  double fore_at(double z) const;
  double aft_at(double z) const;
  // The outline at a height: the eight vertices of octagon().
  std::vector<Vec3> ring(double z) const;

  // Pose on the side wall at x and height z: +x is the outward normal, +z points up along the wall. side = +1 port, -1
  // starboard.
  Pose on_side(double side, double x, double z) const;
};

// The eight vertices of a horizontal rectangle with chamfered corners, counter-clockwise from the starboard quarter.
std::vector<Vec3> octagon(double aft, double fore, double half_width, double aft_chamfer, double fore_chamfer,
                          double z);

// The polygon moved by a vector.
std::vector<Vec3> shifted(std::vector<Vec3> polygon, const Vec3& by);

// The pose moved along its own axes.
Pose moved(const Pose& pose, double x, double y, double z);

// The house as a part of its own.
void add_house(MeshBuilder& builder, const Deckhouse& house);

// A row of panes 3 cm in front of the bridge's front and front corners, in the current part and material; the same as
// part "windows" of window_glass.
void add_windows(MeshBuilder& builder, const Deckhouse& bridge);
void add_glass_windows(MeshBuilder& builder, const Deckhouse& bridge);

// On a house's side walls, at x and height z.
void add_cabinets(MeshBuilder& builder, const Deckhouse& house, double from, double to, double spacing, double height);
void add_doors(MeshBuilder& builder, const Deckhouse& house, double height, const std::vector<double>& places);
// Canisters in racks on the edge of the roof at height z, single ones on narrow roofs small.
void add_liferafts(MeshBuilder& builder, const Deckhouse& house, double z, const std::vector<double>& places,
                   int per_rack = 3);
void add_brackets(MeshBuilder& builder, const Deckhouse& house, double z, const std::vector<double>& places);

void add_bitts(MeshBuilder& builder, const Pose& pose);                     // a pair of bollards
void add_fairlead(MeshBuilder& builder, const Pose& pose);                  // rollers in a frame open to the side
void add_locker(MeshBuilder& builder, const Pose& pose, const Vec3& size);  // a box with a lid
// A trunk with a hood open to +x; size: of its hood, 1 = 0.95 m.
void add_ventilator(MeshBuilder& builder, const Pose& pose, double height, double size = 1);
// Two upright plates at right angles on a bed plate: screens, splinter shields, stowages.
void add_shield(MeshBuilder& builder, const Pose& pose, double leg, double height);

// Posts and three bars along a line of points on a deck.
void add_rail(MeshBuilder& builder, const std::vector<Vec3>& line, double width);
// Upright or leaning ladder between two points, its rungs along `across`.
void add_ladder(MeshBuilder& builder, const Vec3& foot, const Vec3& head, const Vec3& across, double width);
// Square platform round a mast, with gussets below and a coaming.
void add_platform(MeshBuilder& builder, const Vec3& centre, double half, double core, double yaw);
// A yard across a mast with its brackets and dipoles.
void add_yard(MeshBuilder& builder, const Vec3& centre, double half_span, double width);

// Frustum between two convex polygons of equal vertex count whose walls are plates of about `plate` m, each corner
// displaced by up to `dent` m.
struct Plating {
  double plate = 2, dent = 0.003;
};
void add_plated_frustum(MeshBuilder& builder, const std::vector<Vec3>& lower, const std::vector<Vec3>& upper,
                        const Plating& plating, Random& random);
// The house as a part of its own, its walls plated.
void add_plated_house(MeshBuilder& builder, const Deckhouse& house, const Plating& plating, Random& random);

// Navigation radar: a drive with a slotted array of this length across, turned by yaw (rad).
void add_radar_scanner(MeshBuilder& builder, const Vec3& foot, double length, double yaw);
// A mast of one tapered tube with platform, yard, scanners and lights, smaller on masts below 5 m. Height above the
// foot, m.
void add_pole_mast(MeshBuilder& builder, const Vec3& foot, double height, int scanners, Random& random);
// Radome of a satellite antenna on its pedestal.
void add_dome(MeshBuilder& builder, const Vec3& foot, double radius);
void add_whip(MeshBuilder& builder, const Vec3& foot, double height);

// Slewing crane: pedestal, cab and a jib of two chords with struts, at this heading and elevation (rad).
struct Crane {
  Vec3 foot;
  double pedestal = 8, radius = 1.1;
  double jib = 20, heading = 0, elevation = 0;
};
void add_crane(MeshBuilder& builder, const Crane& crane);

// Hatch: coaming with stays, and a cover of folding panels that differ by centimetres in height. size: length, width
// and height of the coaming.
void add_hatch(MeshBuilder& builder, const Vec3& centre, const Vec3& size, int panels, Random& random);

// Boats, with +x forward of the pose, their keel at its origin.
void add_rescue_boat(MeshBuilder& builder, const Pose& base);              // rigid inflatable of 6.5 m
void add_lifeboat(MeshBuilder& builder, const Pose& base, double length);  // totally enclosed
// Two arms that hold a boat from inboard. `outboard`: unit vector; `spread`: distance of the arms.
void add_davit(MeshBuilder& builder, const Vec3& foot, const Vec3& outboard, double spread, double height);

// Along the edge of the deck from x = from to x = to.
void add_deck_rail(MeshBuilder& builder, const HullSurface& hull, double side, double from, double to, double width);
// The same on both sides, as part "rails"; nothing for width 0.
void add_side_rails(MeshBuilder& builder, const HullSurface& hull, double width, double from, double to);
// Bitts and fairleads on both sides at these x, and a pair of windlasses at x = windlass.
void add_mooring_gear(MeshBuilder& builder, const HullSurface& hull, const std::vector<double>& places, double height);
void add_windlasses(MeshBuilder& builder, const Vec3& middle, double spacing, double size);

// A deck block that follows the deck's edge from x = from to x = to (at most the stem), `height` above the deck:
// forecastles, poops, superstructure over the full breadth. inset: of its sides from the deck's edge.
struct DeckBlock {
  std::string name;
  double from = 0, to = 0, height = 2.5, inset = 0.02;
  double lean = 0;  // inset of the top over that of the foot
};
void add_deck_block(MeshBuilder& builder, const HullSurface& hull, const DeckBlock& block, const Plating& plating,
                    Random& random);

// Tiers of accommodation under a wheelhouse with bridge wings, windows, doors, stairs and rails.
struct Accommodation {
  double aft = 0, fore = 0;  // of the lowest tier
  double half_width = 0;
  double foot = 0;                          // z of the deck
  int tiers = 4;                            // below the wheelhouse
  double tier = 2.8;                        // height of each
  double step = 0.25;                       // by which the front of each tier is behind that of the tier below
  double wing = 0;                          // half-span of the bridge wings; 0: none
  double fore_slope = 1, side_slope = 0.5;  // deg
  Plating plating;
  double rail_width = 0;  // 0: no rails
};
// Returns the wheelhouse, on whose roof masts stand.
Deckhouse add_accommodation(MeshBuilder& builder, const Accommodation& block, Random& random);

}  // namespace seaglint
