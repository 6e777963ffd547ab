// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `targets` section of a scenario: a mesh (one body, or several in a layout) with its motion, or ideal points.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/layout/layout.h"

namespace seaglint {

enum class MotionModel { kFixed, kShip, kFloat, kSeries, kRao };
inline constexpr const char* kMotionModelNames[] = {"fixed", "ship", "float", "series", "rao"};
enum class WaveSharing { kSameField, kIndependent };
enum class TargetRole { kClass, kPart };
enum class HeadingConvention { kTowards, kFrom };  // of waves
enum class TimeFactor { kPlus, kMinus };           // e^{+iwt}, e^{-iwt}
enum class MeanRule { kAuto, kKeep, kRemove };     // of a recorded quantity (sim/motion/recorded/README.md)
// Rotations of a table of responses: rad or deg per metre of amplitude, or per slope k a of the wave.
enum class RaoRotations { kRadians, kDegrees, kSlope, kSlopeDegrees };
enum class WamitFirstColumn { kPeriod, kOmega };

// Mean velocity of a float over the water's mean position: leeway times the wind, plus the current, plus a normal
// deviation of each body.
struct DriftSpec {
  double wind_mps = 0;             // 0 <= x <= 60
  double wind_towards_deg = 0;     // -360 <= x <= 360, target frame
  double leeway = 0.03;            // drift over wind speed, 0 <= x <= 0.2
  double current_mps = 0;          // 0 <= x <= 5
  double current_towards_deg = 0;  // -360 <= x <= 360, target frame
  double spread_mps = 0;           // standard deviation in x and in y, 0 <= x <= 2

  bool operator==(const DriftSpec&) const = default;
};

// Zeros of periods, dampings and sizes are derived from the mesh (sim/motion/ship/README.md,
// sim/motion/float/README.md).
struct MotionSpec {
  MotionModel model = MotionModel::kFixed;
  bool translations = false;
  std::optional<std::array<double, 3>> rotation_centre_m = {};
  double roll_period_s = 0;
  double pitch_period_s = 0;
  double yaw_period_s = 0;
  double roll_damping = 0;
  double roll_quadratic_damping = 0;
  double pitch_damping = 0;
  double yaw_damping = 0.1;
  double yaw_rate_std_deg_s = 0;
  double length_m = 0;
  double beam_m = 0;
  double draught_m = 0;
  double heave_period_s = 0;
  double heave_damping = 0;
  double effective_slope = 1;
  double metacentric_height_m = 0;
  double roll_gyradius_m = 0;
  double pitch_gyradius_m = 0;
  double yaw_gyradius_m = 0;
  double speed_mps = 0;  // of a float: that of the host that tows it
  std::optional<DriftSpec> drift = {};
  std::string file = {};
  double series_start_s = 0;
  MeanRule heading = MeanRule::kAuto;
  MeanRule position = MeanRule::kAuto;
  double rao_scale = 1;
  double rao_phase_deg = 0;
  RaoRotations rao_rotations = RaoRotations::kRadians;
  bool rao_follows_long_waves = true;
  double wamit_ulen_m = 1;
  int wamit_body = 0;
  std::array<double, 3> wamit_xbody_m{0, 0, 0};
  WamitFirstColumn wamit_first_column = WamitFirstColumn::kPeriod;
  HeadingConvention wamit_heading = HeadingConvention::kTowards;
  TimeFactor wamit_time_factor = TimeFactor::kPlus;
  std::string sections = {};
  double diameter_m = 0;
  double origin_above_waterline_m = 0.75;
  WaveSharing waves = WaveSharing::kSameField;
  double step_s = 0.02;
  double spin_up_s = 120;

  bool operator==(const MotionSpec&) const = default;
};

// Another target in the same sea and the same maps; its label, if any, is ignored there.
struct CompanionSpec {
  std::string target;
  double x_m = 0;
  double y_m = 0;
  bool towed = false;  // moves with the target that it accompanies

  bool operator==(const CompanionSpec&) const = default;
};

struct PointSpec {
  std::array<double, 3> position_m{0, 0, 0};
  double amplitude_m = 1;
  std::array<double, 3> velocity_mps{0, 0, 0};

  bool operator==(const PointSpec&) const = default;
};

// Default and maximum number of bounces. On the ship the error of 8 bounces is up to -11 dB, of 40 below -39 dB
// (tests/accuracy.md, "High-order bounces").
inline constexpr int kDefaultBounces = 40, kMaxBounces = 200;

// How the reflectors of every path are found: by beams, or by shooting and bouncing rays (sim/scattering/tracing).
enum class SolverMethod : std::uint8_t { kBeams, kRays };
inline constexpr const char* kSolverMethodNames[] = {"beams", "rays"};

// Zeros are derived from the size of the mesh (sim/scattering/README.md).
struct SolverSpec {
  SolverMethod method = SolverMethod::kBeams;
  double ray_spacing_m = 0;
  double min_patch_m = 0;
  int max_bounces = kDefaultBounces;
  double max_aspect_change_deg = 0;
  std::optional<double> crease_deg = {};
  bool edges = true;
  double wavefront_range_m = 0;

  bool operator==(const SolverSpec&) const = default;
};

// Material of a part of the mesh.
struct PartMaterialSpec {
  std::string part;
  std::string material;

  bool operator==(const PartMaterialSpec&) const = default;
};

// How a mesh file becomes the mesh of a body in metres: p = scale R unit q + offset, q a point of the file
// (sim/geometry/placement/target_mesh.h).
struct MeshPlacement {
  std::string unit = "m";
  std::string forward = "+x", up = "+z";
  double scale = 1;
  std::array<double, 3> offset_m = {0, 0, 0};

  bool operator==(const MeshPlacement&) const = default;
};
inline constexpr const char* kMeshAxes[] = {"+x", "-x", "+y", "-y", "+z", "-z"};

// Kinds of ships whose meshes are generated (sim/geometry/ship/README.md).
enum class ShipKind : std::uint8_t {
  kFrigate,
  kCorvette,
  kPatrolBoat,
  kContainerShip,
  kTanker,
  kBulkCarrier,
  kFishingVessel,
  kFerry,
  kTug,
  kInflatableBoat
};
inline constexpr const char* kShipKindNames[] = {"frigate", "corvette",       "patrol_boat",    "container_ship",
                                                 "tanker",  "bulk_carrier",   "fishing_vessel", "ferry",
                                                 "tug",     "inflatable_boat"};

enum class ShipDetail : std::uint8_t {
  kHull,      // hull and houses
  kFittings,  // and masts, cranes, cargo gear, boats, deck fittings
  kRails,     // and rails, ladders, nets
};
inline constexpr const char* kShipDetailNames[] = {"hull", "fittings", "rails"};

// Lengths overall of each kind, m.
struct ShipLengths {
  double lowest = 0, highest = 0, reference = 0;  // the last: of seed 0
};
inline constexpr ShipLengths kShipLengths_m[] = {{90, 200, 144}, {55, 95, 75},   {18, 55, 34}, {110, 400, 230},
                                                 {90, 340, 183}, {90, 300, 190}, {12, 75, 28}, {70, 230, 160},
                                                 {20, 45, 30},   {5, 13, 7.5}};

// A generated ship: the individual of a seed. Seed 0 is the reference ship of its kind, laden.
struct ShipSpec {
  ShipKind kind = ShipKind::kFrigate;
  double length_m = 0;                 // overall; 0: of the reference ship, else drawn by the seed
  std::optional<double> loading = {};  // 0 lightest to 1 laden; default: laden for seed 0, else drawn by the seed
  ShipDetail detail = ShipDetail::kRails;
  std::uint64_t seed = 0;

  bool operator==(const ShipSpec&) const = default;
};

// Throws InputError, "length_m: value ...", for a length that its kind does not have, with the kinds that have it, and
// for a loading outside of 0 to 1.
void check_ship(const ShipSpec& ship);

// A passive decoy as it is built (sim/geometry/decoy/make_decoy.h).
enum class DecoyKind { kIcosahedral, kOctahedral, kTrihedralCluster, kTrihedral, kDihedral, kLuneburgLens };
enum class DecoyPanel { kTriangular, kSquare, kCircular };
enum class DecoyPose { kRainCatcher, kPointUp };  // of an octahedral one: a cell or a corner upwards
enum class DecoySupport { kNone, kFloat, kRaft, kTow };
enum class DecoyFloat { kDisc, kSphere };
inline constexpr const char* kDecoyKindNames[] = {"icosahedral", "octahedral", "trihedral_cluster",
                                                  "trihedral",   "dihedral",   "luneburg_lens"};
inline constexpr const char* kDecoyPanelNames[] = {"triangular", "square", "circular"};
inline constexpr const char* kDecoyPoseNames[] = {"rain_catcher", "point_up"};
inline constexpr const char* kDecoySupportNames[] = {"none", "float", "raft", "tow"};
inline constexpr const char* kDecoyFloatNames[] = {"disc", "sphere"};

struct DecoySpec {
  DecoyKind kind = DecoyKind::kIcosahedral;
  double leg_m = 0.372;                        // of a trihedron; side of a dihedral; radius of a lens, 0.05 <= x <= 5
  DecoyPanel panel = DecoyPanel::kTriangular;  // octahedral, trihedral
  DecoyPose pose = DecoyPose::kRainCatcher;    // octahedral
  int cells = 5;                               // trihedral_cluster, 3 <= x <= 12
  double boresight_elevation_deg = 0;          // all but icosahedral, octahedral, -45 <= x <= 45
  double cap_half_angle_deg = 70;              // luneburg_lens: of its cap, seen from its centre, 20 <= x <= 90
  double lens_loss_db = 0;                     // luneburg_lens: both ways, 0 <= x <= 10
  std::uint64_t seed = 0;                      // of all imperfections
  double angle_error_deg = 0;                  // standard deviation of every right angle, 0 <= x <= 5
  std::array<double, 3> seam_errors_deg{0, 0, 0};  // trihedral: of the right angle at each seam, -10 <= x <= 10
  double surface_error_mm = 0;                     // rms of a panel's displacement, 0 <= x <= leg / 50
  double rounding_mm = 0;                          // radius of seams, of tubes if inflatable, 0 or 0.1 <= x <= leg / 5
  bool inflatable = false;                         // tubes along the outer edges
  int missing_panels = 0;                          // 0 <= x < panels
  int dented_panels = 0;                           // 0 <= x <= panels that are left
  double dent_depth = 0.05;                        // of a dent, over the leg, 0 < x <= 0.2
  double frame_mm = 0;                             // width of bars along the outer edges, 0 or 0.1 <= x <= leg / 10
  DecoySupport support = DecoySupport::kNone;
  DecoyFloat float_shape = DecoyFloat::kDisc;  // float, tow
  double float_m = 0;                          // diameter of float or raft, 0 or 0.05 <= x <= 20; 0: by the leg
  double mast_m = 0.75;                        // height of the reflector's middle above the water, 0 < x <= 50
  double tether_m = 0;                         // length of the line above the water, 0 <= x <= 100

  bool operator==(const DecoySpec&) const = default;
};

struct TargetSpec : MeshPlacement {
  std::string name;
  TargetRole role = TargetRole::kClass;
  int label = 0;
  std::string mesh;  // file; empty with a generated mesh, or points
  std::optional<ShipSpec> ship;
  std::optional<DecoySpec> decoy;
  std::string material = "pec";
  std::vector<PartMaterialSpec> part_materials;
  double sheet_thickness_mm = 0;
  std::optional<LayoutSpec> layout;
  MotionSpec motion;
  SolverSpec solver;
  std::vector<PointSpec> points;
  std::vector<CompanionSpec> companions;

  bool operator==(const TargetSpec&) const = default;
};

// A ship or a decoy that the program makes.
inline bool is_generated(const TargetSpec& target) { return target.ship || target.decoy; }

// Key of what its bodies are made of.
inline const char* source_key_of(const TargetSpec& target) {
  return target.ship ? "ship" : target.decoy ? "decoy" : "mesh";
}

// The target of a scenario with `targets: {}`: no bodies and no points, thus no echo; name and class are "sea".
inline constexpr const char* kSeaAlone = "sea";
inline bool is_sea_alone(const TargetSpec& target) {
  return target.mesh.empty() && !is_generated(target) && target.points.empty();
}
// Bodies with a mesh, from a file or generated.
inline bool has_mesh(const TargetSpec& target) { return !target.mesh.empty() || is_generated(target); }

}  // namespace seaglint
