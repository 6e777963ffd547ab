// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `targets` section of a scenario: a mesh (one body, or several in a layout) with its motion, or ideal points.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/layout/layout_spec.h"

namespace seaglint {

enum class MotionModel { kFixed, kShip, kFloat, kSeries, kRao };
enum class WaveSharing { kSameField, kIndependent };
enum class TargetRole { kClass, kPart };
enum class HeadingConvention { kTowards, kFrom };  // of waves
enum class TimeFactor { kPlus, kMinus };           // e^{+iwt}, e^{-iwt}
enum class MeanRule { kAuto, kKeep, kRemove };     // of a recorded quantity (sim/motion/recorded/README.md)
// Rotations of a table of responses: rad or deg per metre of amplitude, or per slope k a of the wave.
enum class RaoRotations { kRadians, kDegrees, kSlope, kSlopeDegrees };
enum class WamitFirstColumn { kPeriod, kOmega };

// (auto): zero means derived from the size of the mesh (sim/motion/ship/README.md, sim/motion/float/README.md).
struct MotionSpec {
  MotionModel model = MotionModel::kFixed;
  bool translations = false;  // surge, sway and heave too
  // body frame, of a rigid raft that of its origin on the water (sim/motion/target_motion.h); default: centre of
  // gravity of a ship, centre of flotation of a float
  std::optional<std::array<double, 3>> rotation_centre_m = {};
  double roll_period_s = 0;            // (auto) 0 or 0.2 <= x <= 60
  double pitch_period_s = 0;           // (auto) 0 or 0.2 <= x <= 60
  double yaw_period_s = 0;             // course-keeping or mooring spring; 0 = free; 0 or 0.2 <= x <= 1000
  double roll_damping = 0;             // (auto) ratio to critical, 0 <= x <= 2
  double roll_quadratic_damping = 0;   // b of b |x'| x', 1/rad, 0 <= x <= 100
  double pitch_damping = 0;            // (auto) ratio to critical, 0 <= x <= 2
  double yaw_damping = 0.1;            // ratio to critical at yaw_period_s, 0 <= x <= 2
  double yaw_rate_std_deg_s = 0;       // standard deviation of the slow random yaw rate of a float, 0 <= x <= 180
  double length_m = 0;                 // (auto) waterline length, 0 <= x <= 1000
  double beam_m = 0;                   // (auto) waterline beam, 0 <= x <= 200
  double draught_m = 0;                // (auto) of a ship; of a float, 0 = negligible; 0 <= x <= 50
  double heave_period_s = 0;           // (auto) of a float, 0 or 0.2 <= x <= 60
  double heave_damping = 0;            // (auto) of a float, ratio to critical, 0 <= x <= 2
  double metacentric_height_m = 1.95;  // 0.01 <= x <= 20
  // of gyration of the mass about the centre of gravity; 0: derived from roll_period_s, 0 <= x <= 100
  double roll_gyradius_m = 0;
  double pitch_gyradius_m = 0;          // (auto) 0 <= x <= 500
  double yaw_gyradius_m = 0;            // (auto) 0 <= x <= 500
  double speed_mps = 0;                 // of model ship, rao or series, forward, 0 <= x <= 40
  std::string file = {};                // of model series (attitude over time) or rao (response operators)
  double series_start_s = 0;            // time in the series that is t = 0, -1e10 <= x <= 1e10
  MeanRule heading = MeanRule::kAuto;   // of model series: its mean yaw
  MeanRule position = MeanRule::kAuto;  // of model series: its mean surge, sway and heave
  double rao_scale = 1;                 // factor of all responses of model rao, 0 < x <= 1e6
  double rao_phase_deg = 0;             // added to all their phases, time factor e^{+iwt}, -360 <= x <= 360
  RaoRotations rao_rotations = RaoRotations::kRadians;
  bool rao_follows_long_waves = true;  // else the body is restrained: its limits in long waves are not checked
  double wamit_ulen_m = 1;             // ULEN of a WAMIT table, 0 < x <= 1000
  int wamit_body = 0;                  // body of a run of several, modes 6 b - 5 to 6 b; 0: the only one; 0 <= x <= 100
  std::array<double, 3> wamit_xbody_m{0, 0, 0};  // its origin where the waves' phase is 0 at (0, 0, 0), |x| <= 1e5
  WamitFirstColumn wamit_first_column = WamitFirstColumn::kPeriod;
  // Of a table in the format of WAMIT, which does not state them; WAMIT's own are the defaults.
  HeadingConvention wamit_heading = HeadingConvention::kTowards;
  TimeFactor wamit_time_factor = TimeFactor::kPlus;
  // file of a ship's sections below the waterline; default: those of the mesh, else a parametric form
  std::string sections = {};
  double diameter_m = 0;  // (auto) of a float's waterplane, 0 <= x <= 50
  // height of a float's mesh origin above its centre of flotation, of a moving raft's reflectors above its waterline,
  // -10 <= x <= 50
  double origin_above_waterline_m = 0.75;
  WaveSharing waves = WaveSharing::kSameField;
  // between samples and of integration, 0.001 <= x <= 0.1, at most an eighth of the shortest natural period
  double step_s = 0.02;
  double spin_up_s = 120;  // simulated before t = 0, 0 <= x <= 3600
};

// Another target in the same sea and the same maps; its label, if any, is ignored there.
struct CompanionSpec {
  std::string target;  // its name
  double x_m = 0;      // position of its reference point, target frame, |x| <= 1e5
  double y_m = 0;
};

struct PointSpec {
  std::array<double, 3> position_m{0, 0, 0};    // target frame
  double amplitude_m = 1;                       // |S|, > 0
  std::array<double, 3> velocity_mps{0, 0, 0};  // target frame
};

// Default and maximum number of bounces. On the ship the error of 8 bounces is up to -11 dB, of 40 below -39 dB
// (tests/README.md, "High-order bounces").
inline constexpr int kDefaultBounces = 40, kMaxBounces = 200;

// How the reflectors of every path are found: by beams, or by shooting and bouncing rays (sim/scattering/tracing).
enum class SolverMethod : std::uint8_t { kBeams, kRays };
inline constexpr const char* kSolverMethodNames[] = {"beams", "rays"};

// (auto): zero means derived from the size of the mesh (sim/scattering/README.md).
struct SolverSpec {
  SolverMethod method = SolverMethod::kBeams;
  double ray_spacing_m = 0;           // (auto) distance between rays, 0 or 1e-5 <= x <= 1
  double min_patch_m = 0;             // (auto) side of the smallest illuminated patch kept, 0 or 5e-5 <= x <= 1
  int max_bounces = kDefaultBounces;  // 1 <= x <= kMaxBounces
  double max_aspect_change_deg = 0;   // (auto) aspect change covered by one aspect trace, 0 or 0.001 <= x <= 5
  // Which facets form a smooth surface: those whose normals differ by less than this crease angle, 0 <= x <= 60, 0 =
  // none; absent: as the mesh's normals or its shape say (sim/scattering/scatterer).
  std::optional<double> crease_deg = {};
  bool edges = true;             // edge diffraction
  double wavefront_range_m = 0;  // for the curvature of the wavefront, 0 or 100 <= x <= 1e7; 0 = far field at any range
};

// Material of a part of the mesh.
struct PartMaterialSpec {
  std::string part;      // its name; a trailing * selects all parts with that prefix
  std::string material;  // as TargetSpec::material
};

// How a mesh file becomes the mesh of a body in metres: p = scale R unit q + offset, q a point of the file
// (sim/geometry/placement/target_mesh.h).
struct MeshPlacement {
  std::string unit = "m";  // of the mesh file: m, cm, mm, km, in, ft
  // Which axis of the file is forward and which is up: +x, -x, +y, -y, +z or -z, perpendicular to each other. Of glTF,
  // an axis of its body frame (sim/geometry/files/README.md).
  std::string forward = "+x", up = "+z";
  double scale = 1;  // factor by which the mesh is enlarged about its origin, 1e-3 <= x <= 1e3
  std::array<double, 3> offset_m = {0, 0, 0};  // translation, body frame, |x| <= 1e4
};
inline constexpr const char* kMeshAxes[] = {"+x", "-x", "+y", "-y", "+z", "-z"};

struct TargetSpec : MeshPlacement {
  std::string name;
  TargetRole role = TargetRole::kClass;  // a part has no samples of its own: it is a companion of other targets
  int label = 0;                         // of a class: index into dataset.classes
  std::string mesh;              // path relative to the scenario's folder or the working directory; empty for points
  std::string material = "pec";  // pec, a name of assets/materials, or a file
  std::vector<PartMaterialSpec> part_materials;  // later entries take precedence
  double sheet_thickness_mm = 0;                 // of open surfaces, 0 <= x <= 1000
  std::optional<LayoutSpec> layout;              // without: one body at the origin
  MotionSpec motion;
  SolverSpec solver;
  std::vector<PointSpec> points;
  std::vector<CompanionSpec> companions;  // their echoes are added; no shadowing or multiple scattering between targets
};

}  // namespace seaglint
