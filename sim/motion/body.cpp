// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/body.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/geometry/placement/hydrostatics.h"
#include "sim/motion/ship/rao_files.h"

namespace seaglint {

namespace {

// Responses of S175 within 0.5 % of those with 100 strips.
constexpr int kStrips = 40;

// Ratios of a fast displacement hull; those of model DTMB 5415 (ITTC, L 142 m, B 19.06 m, T 6.15 m).
constexpr double kWaterlineToOverallLength = 0.985;
constexpr double kWaterlineToOverallBeam = 0.95;
constexpr double kBeamToDraught = 3.1;

bool is_wamit(const std::filesystem::path& file) { return file.extension() == ".4"; }

// Reads a table of responses: speed and reference point come from the file (VERES) or from the spec (WAMIT).
RaoTable read_table_of(const MotionSpec& spec, const std::filesystem::path& file, const Vec3& reference,
                       const BodyShape& shape) {
  const Vec3 size = shape.box.upper - shape.box.lower;
  const double side_m = shape.is_raft ? 0 : std::max({size.x(), size.y(), 0.0});
  if (is_wamit(file)) {
    if (spec.speed_mps > 0) {
      throw InputError(fmt::format("motion.speed_mps: value {}: must be 0 with {}: its responses are without speed",
                                   spec.speed_mps, file.string()));
    }
    const bool per_slope =
        spec.rao_rotations == RaoRotations::kSlope || spec.rao_rotations == RaoRotations::kSlopeDegrees;
    if (per_slope && spec.wamit_ulen_m != 1) {
      throw InputError(fmt::format("motion.wamit_ulen_m: value {}: must be 1 with motion.rao_rotations per slope",
                                   spec.wamit_ulen_m));
    }
    return read_wamit_rao(file, spec, reference, side_m);
  }
  if (spec.rotation_centre_m) {
    throw InputError(fmt::format("motion.rotation_centre_m: not allowed here: {} gives it", file.string()));
  }
  const MotionSpec standard;
  const std::pair<const char*, bool> of_wamit[] = {
      {"wamit_heading", spec.wamit_heading != standard.wamit_heading},
      {"wamit_time_factor", spec.wamit_time_factor != standard.wamit_time_factor},
      {"wamit_body", spec.wamit_body != standard.wamit_body},
      {"wamit_xbody_m", spec.wamit_xbody_m != standard.wamit_xbody_m},
      {"wamit_first_column", spec.wamit_first_column != standard.wamit_first_column}};
  for (const auto& [key, is_given] : of_wamit) {
    if (is_given) throw InputError(fmt::format("motion.{}: not allowed here: {} is of VERES", key, file.string()));
  }
  return read_veres_rao(file, spec.speed_mps, spec, side_m);
}

// Shortest natural period of the oscillating degrees of freedom of a body, s; infinite without any.
double shortest_period(const Body& body) {
  const double yaw = body.spec.yaw_period_s > 0 ? 2 * kPi / body.spec.yaw_period_s : 0;
  double fastest = 0;  // rad/s
  if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) fastest = std::max(ship->roll.omega0, yaw);
  if (const auto* raft = std::get_if<FloatParticulars>(&body.model)) {
    const double heave = body.spec.translations ? raft->heave.omega0 : 0;
    fastest = std::max({raft->roll.omega0, raft->pitch.omega0, heave, yaw});
  }
  return fastest > 0 ? 2 * kPi / fastest : std::numeric_limits<double>::infinity();
}

// Samples are joined by cubic Hermite polynomials, whose relative error is (w h)^4 / 384 for a motion at w: 1e-3 at
// eight samples per period, 1/4 at two.
void check_step(const Body& body) {
  constexpr double kMinSamples = 8, kPrinted = 1e-5;  // the bound is printed with six digits
  const double period = shortest_period(body), longest = period / kMinSamples;
  if (body.spec.step_s > longest * (1 + kPrinted)) {
    throw InputError(fmt::format(
        "motion.step_s: value {}: must be at most {:.6g}, an eighth of the shortest natural period, {:.6g} s",
        body.spec.step_s, longest, period));
  }
}

// Extent in z of nine tenths of the surface: a twentieth of the area is below, a twentieth above. A third of each
// triangle counts at each corner.
double main_height(const TriangleMesh& mesh) {
  constexpr double kBeyond = 0.05;
  std::vector<std::pair<double, double>> area_at;  // z of a corner, area
  double all = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double third = area_vector(mesh, t).norm() / 3;
    for (const std::uint32_t v : mesh.triangles[t]) area_at.emplace_back(mesh.vertices[v].z(), third);
    all += 3 * third;
  }
  std::ranges::sort(area_at);
  double sum = 0, low = 0, high = 0;
  for (const auto& [z, area] : area_at) {
    if (sum <= kBeyond * all) low = z;
    if (sum < (1 - kBeyond) * all) high = z;
    sum += area;
  }
  return high - low;
}

// ship_particulars(), whose errors get the sizes of hull and mesh.
ShipParticulars particulars_of(const MotionSpec& spec, const HullSections& hull, const BodyShape& shape) {
  try {
    return ship_particulars(spec, hull);
  } catch (const InputError& error) {
    const Vec3 size = shape.box.upper - shape.box.lower;
    const std::string of_mesh =
        shape.is_raft ? ""
                      : fmt::format("; the mesh is {:.4g} m long (x), {:.4g} m broad (y) and {:.4g} m high (z)",
                                    size.x(), size.y(), size.z());
    throw InputError(fmt::format("{}; the hull is {:.4g} m long and {:.4g} m broad, with a draught of {:.4g} m{}",
                                 error.what(), hull.length, hull.beam(), hull.draught(), of_mesh));
  }
}

const char* heading_of(const MotionSpec& spec, bool wamit) {
  if (!wamit) return "VERES: its heading + 180";
  return spec.wamit_heading == HeadingConvention::kFrom ? "wamit_heading: its heading, from where they come, + 180"
                                                        : "WAMIT: the direction of propagation";
}

// What the longest waves of a table say about its conventions and units.
std::string long_wave_reading(const RaoTable& table, const MotionSpec& spec) {
  if (!spec.rao_follows_long_waves) return "its long waves are not checked (motion.rao_follows_long_waves: false)";
  const LongWaveLimits limits = long_wave_limits(table);
  const LongWaves sign = long_waves_of(table);
  if (sign == LongWaves::kTooShort && limits.heave && std::abs(*limits.heave - 1.0) > 0.05) {
    return fmt::format("heave in its longest waves, {:.4g} s, is {:.2g} where a free body has 1", limits.period_s,
                       std::abs(*limits.heave));
  }
  if (sign == LongWaves::kTooShort)
    return fmt::format("its longest waves, {:.4g} s, are too short to confirm that", limits.period_s);
  if (sign == LongWaves::kDisagree)
    return fmt::format("its longest waves, {:.4g} s, contradict the sign of pitch", limits.period_s);
  std::vector<const char*> confirmed;
  if (limits.heave) confirmed.push_back("heave");
  confirmed.push_back(limits.pitch ? "pitch" : "the sign of pitch");
  if (limits.roll) confirmed.push_back("roll");
  return fmt::format("its longest waves, {:.4g} s, confirm {}", limits.period_s, fmt::join(confirmed, ", "));
}

std::string reading_of(const RaoTable& table, const MotionSpec& spec) {
  const auto& [headings, omegas] = std::pair(table.headings(), table.omegas());
  return fmt::format(
      "{} headings of waves towards {:.4g} to {:.4g} deg ({}), {} frequencies {:.4g} to {:.4g} rad/s, "
      "speed {:.4g} m/s, time factor e^{{{}iwt}}; {}",
      headings.size(), degrees(headings.front()), degrees(headings.back()), heading_of(spec, is_wamit(table.source())),
      omegas.size(), omegas.front(), omegas.back(), table.speed(),
      spec.wamit_time_factor == TimeFactor::kMinus ? '-' : '+', long_wave_reading(table, spec));
}

}  // namespace

std::string motion_file_reading(const Body& body) {
  if (const auto* series = std::get_if<AttitudeSeries>(&body.model))
    return fmt::format("{}: {}", series->source, series->reading);
  if (const auto* table = std::get_if<RaoTable>(&body.model))
    return fmt::format("{}: {}", table->source(), reading_of(*table, body.spec));
  return "";
}

BodyShape shape_of(const TriangleMesh& mesh, std::optional<double> centre_of_gravity_m) {
  BodyShape shape{.box = bounds(mesh), .hull = sections_of_mesh(mesh, kStrips), .main_height_m = main_height(mesh)};
  if (centre_of_gravity_m)
    shape.metacentric_height_m = hydrostatics_of(mesh).metacentric_height_m(*centre_of_gravity_m);
  return shape;
}

std::string orientation_finding(const BodyShape& shape) {
  const Vec3 size = shape.box.upper - shape.box.lower;
  if (shape.is_raft || !(size.maxCoeff() > 0)) return "";
  // Off-centre by 2 % of the extent counts as symmetric, by 20 % as not.
  constexpr double kSymmetric = 0.02, kSkew = 0.2;
  const Vec3 skew = (shape.box.upper + shape.box.lower).cwiseAbs();
  const bool lies_on_side = skew.z() <= kSymmetric * size.z() && skew.y() >= kSkew * size.y();
  const double length = size.x(), breadth = size.y(), height = shape.main_height_m;
  std::string fault, keys;
  if (breadth > length || height > length) {
    fault = breadth >= height ? "broader than long" : "higher than long";
    keys = breadth >= height ? "orientation.forward: +y (or -y)" : "orientation: {forward: +z, up: +y}";
  } else if (height > breadth || lies_on_side) {
    fault = height > breadth ? "higher than broad" : "symmetric about the plane z = 0 and not about y = 0";
    keys = "orientation.up: +y (or -y)";
  }
  if (fault.empty()) return "";
  return fmt::format(
      "the hull is {:.4g} m long (x), {:.4g} m broad (y) and {:.4g} m high (z): {}; if its bow is not along "
      "x or its masts are not along z, {} turns it",
      length, breadth, size.z(), fault, keys);
}

HullSections ship_sections(const MotionSpec& spec, const BodyShape& shape, const std::filesystem::path& folder,
                           const HullCoefficients& form) {
  if (!spec.sections.empty()) {
    const HullSections given = read_sections(find_file(spec.sections, folder, "motion.sections"), kStrips);
    return scaled_to(given, spec.length_m, spec.beam_m, spec.draught_m);
  }
  if (!shape.hull.sections.empty()) return scaled_to(shape.hull, spec.length_m, spec.beam_m, spec.draught_m);
  const Vec3 size = shape.box.upper - shape.box.lower;
  const double length = given_or(spec.length_m, kWaterlineToOverallLength * size.x());
  const double beam = given_or(spec.beam_m, kWaterlineToOverallBeam * size.y());
  if (!(length > 0) || !(beam > 0)) {
    if (shape.is_raft) {
      throw InputError(
          "motion.length_m, motion.beam_m: the reflectors of a rigid raft give no waterline; write both down, or "
          "motion.sections");
    }
    throw InputError(fmt::format(
        "motion.length_m, motion.beam_m: the mesh is {:.4g} m long (x), {:.4g} m broad (y) and {:.4g} m high "
        "(z), which gives no waterline; write them down",
        size.x(), size.y(), size.z()));
  }
  return sections_of_form(length, beam, given_or(spec.draught_m, beam / kBeamToDraught), form, kStrips);
}

Body make_body(const MotionSpec& spec, const BodyShape& shape, const std::filesystem::path& folder) {
  if (!(spec.step_s > 0)) throw InputError(fmt::format("motion.step_s: value {}: must be > 0", spec.step_s));
  if (!(spec.spin_up_s >= 0)) throw InputError(fmt::format("motion.spin_up_s: value {}: must be >= 0", spec.spin_up_s));
  const bool from_file = spec.model == MotionModel::kSeries || spec.model == MotionModel::kRao;
  if (from_file == spec.file.empty()) {
    throw InputError(fmt::format("motion.file: {}", from_file
                                                        ? "this key is missing: model series and rao need it"
                                                        : "not allowed here: valid only with model: series or rao"));
  }
  if (spec.model != MotionModel::kSeries && spec.heading != MeanRule::kAuto)
    throw InputError("motion.heading: not allowed here: valid only with model: series");
  if (spec.model != MotionModel::kSeries && spec.position != MeanRule::kAuto)
    throw InputError("motion.position: not allowed here: valid only with model: series");
  if (!spec.translations && spec.position != MeanRule::kAuto)
    throw InputError("motion.position: not allowed here: valid only with translations: true");
  Body body{spec, {}, shape, Vec3::Zero()};
  if (spec.model == MotionModel::kShip) {
    MotionSpec ship_spec = spec;
    ship_spec.metacentric_height_m = given_or(spec.metacentric_height_m, shape.metacentric_height_m.value_or(0));
    const ShipParticulars ship = particulars_of(ship_spec, ship_sections(spec, shape, folder), shape);
    body.rotation_centre = ship.rotation_centre;
    body.model = ship;
  } else if (spec.model == MotionModel::kFloat) {
    if (shape.is_raft && spec.diameter_m == 0)
      throw InputError("motion.diameter_m: the reflectors of a rigid raft give no waterplane; write it down");
    body.model = float_particulars(spec, shape.box);
    body.rotation_centre = {0, 0, shape.is_raft ? 0 : -spec.origin_above_waterline_m};
  }
  if (spec.rotation_centre_m) body.rotation_centre = Vec3(*spec.rotation_centre_m);
  if (spec.model == MotionModel::kSeries) {
    body.model = read_attitude_series(find_file(spec.file, folder, "motion.file"),
                                      {spec.translations, spec.heading, spec.position});
  } else if (spec.model == MotionModel::kRao) {
    const RaoTable table =
        read_table_of(spec, find_file(spec.file, folder, "motion.file"), body.rotation_centre, shape);
    body.rotation_centre = table.reference();
    body.model = table;
  }
  check_step(body);
  return body;
}

}  // namespace seaglint
