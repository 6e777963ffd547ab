// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/decoy/make_decoy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/facets.h"

namespace seaglint {

namespace {

constexpr int kSides = 20;              // of masts, tubes and floats
constexpr double kSmoothTurn_deg = 20;  // their sides turn by 18 deg
constexpr double kLineRadius_m = 0.006;
constexpr std::uint64_t kBodyIndex = std::uint64_t{1} << 32;  // of Stream::kDecoy, beyond those of panels

// Written so that a NaN fails.
void require_within(double value, double least, double most, const char* name) {
  if (!(value >= least && value <= most))
    throw InputError(fmt::format("{}: value {:g}: must be within {:g} and {:g}", name, value, least, most));
}

void require_zero_or_within(double value, double least, double most, const char* name) {
  if (!(value == 0 || (value >= least && value <= most)))
    throw InputError(fmt::format("{}: value {:g}: must be 0 or within {:g} and {:g}", name, value, least, most));
}

void refuse_if(bool is_set, const char* name, const char* kinds) {
  if (is_set) throw InputError(fmt::format("{}: not allowed here: applies to {} only", name, kinds));
}

void check_bounds(const DecoySpec& spec) {
  const double leg_mm = 1e3 * spec.leg_m;
  require_within(spec.leg_m, 0.05, 5, "leg_m");
  require_within(spec.cells, 3, 12, "cells");
  require_within(spec.boresight_elevation_deg, -45, 45, "boresight_elevation_deg");
  require_within(spec.cap_half_angle_deg, 20, 90, "cap_half_angle_deg");
  require_within(spec.lens_loss_db, 0, 10, "lens_loss_db");
  require_within(spec.angle_error_deg, 0, 5, "angle_error_deg");
  for (const double error : spec.seam_errors_deg) require_within(error, -10, 10, "seam_errors_deg");
  require_within(spec.surface_error_mm, 0, leg_mm / 50, "surface_error_mm");
  require_zero_or_within(spec.rounding_mm, 0.1, leg_mm / 5, "rounding_mm");
  require_zero_or_within(spec.frame_mm, 0.1, leg_mm / 10, "frame_mm");
  if (const int panels = decoy_panel_count(spec); panels > 0) {
    require_within(spec.missing_panels, 0, panels - 1, "missing_panels");
    require_within(spec.dented_panels, 0, panels - spec.missing_panels, "dented_panels");
  }
  require_within(spec.dent_depth, std::numeric_limits<double>::min(), 0.2, "dent_depth");
  require_zero_or_within(spec.float_m, 0.05, 20, "float_m");
  require_within(spec.mast_m, std::numeric_limits<double>::min(), 50, "mast_m");
  require_within(spec.tether_m, 0, 100, "tether_m");
}

// Values that have no effect on a kind are refused.
void check_contradictions(const DecoySpec& spec) {
  const DecoySpec defaults;
  const auto is = [&](DecoyKind kind) { return spec.kind == kind; };
  refuse_if(spec.panel != defaults.panel && !is(DecoyKind::kOctahedral) && !is(DecoyKind::kTrihedral), "panel",
            "octahedral and trihedral");
  refuse_if(spec.pose != defaults.pose && !is(DecoyKind::kOctahedral), "pose", "octahedral");
  refuse_if(spec.cells != defaults.cells && !is(DecoyKind::kTrihedralCluster), "cells", "trihedral_cluster");
  refuse_if(spec.boresight_elevation_deg != 0 && (is(DecoyKind::kIcosahedral) || is(DecoyKind::kOctahedral)),
            "boresight_elevation_deg", "trihedral_cluster, trihedral, luneburg_lens and dihedral");
  refuse_if(spec.seam_errors_deg != defaults.seam_errors_deg && !is(DecoyKind::kTrihedral), "seam_errors_deg",
            "trihedral");
  const bool is_lens = is(DecoyKind::kLuneburgLens);
  refuse_if(spec.cap_half_angle_deg != defaults.cap_half_angle_deg && !is_lens, "cap_half_angle_deg", "luneburg_lens");
  refuse_if(spec.lens_loss_db > 0 && !is_lens, "lens_loss_db", "luneburg_lens");
  const auto refuse_of_lens = [&](bool is_set, const char* name) {
    refuse_if(is_set && is_lens, name, "corner reflectors");
  };
  refuse_of_lens(spec.angle_error_deg > 0, "angle_error_deg");
  refuse_of_lens(spec.surface_error_mm > 0, "surface_error_mm");
  refuse_of_lens(spec.rounding_mm > 0, "rounding_mm");
  refuse_of_lens(spec.inflatable, "inflatable");
  refuse_of_lens(spec.missing_panels != 0, "missing_panels");
  refuse_of_lens(spec.dented_panels != 0, "dented_panels");
  refuse_of_lens(spec.dent_depth != defaults.dent_depth, "dent_depth");
  refuse_of_lens(spec.frame_mm > 0, "frame_mm");
  if (spec.inflatable && spec.rounding_mm == 0)
    throw InputError("inflatable: needs rounding_mm, the radius of its tubes");
  if (spec.inflatable && spec.frame_mm > 0)
    throw InputError("frame_mm: an inflatable decoy has tubes in place of a frame");
  const bool floats = spec.support == DecoySupport::kFloat || spec.support == DecoySupport::kTow;
  refuse_if(spec.float_shape != defaults.float_shape && !floats, "float_shape", "support float and tow");
  refuse_if(spec.float_m > 0 && spec.support == DecoySupport::kNone, "float_m", "support float, raft and tow");
  refuse_if(spec.tether_m > 0 && spec.support == DecoySupport::kNone, "tether_m", "support float, raft and tow");
  if (spec.support == DecoySupport::kTow && spec.tether_m == 0)
    throw InputError("tether_m: a tow needs the length of its line");
}

// A closed rod along a path, its cross-section a regular polygon with a vertex of the last section at every point of
// the path; capped at its ends, or a ring.
void add_rod(MeshBuilder& builder, const std::vector<Vec3>& path, double radius, int sides, bool is_ring = false) {
  const std::size_t count = path.size();
  Vec3 across;
  std::vector<std::vector<std::uint32_t>> rings;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& before = path[i > 0 ? i - 1 : is_ring ? count - 1 : 0];
    const Vec3& after = path[i + 1 < count ? i + 1 : is_ring ? 0 : i];
    const Vec3 along = (after - before).normalized();
    // The first direction is as upright as possible, the others follow it.
    if (i == 0) across = std::abs(along.z()) > 0.9 ? Vec3::UnitX() : Vec3::UnitZ();
    across = (across - along * along.dot(across)).normalized();
    const Vec3 third = along.cross(across);
    rings.emplace_back();
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * kPi * (k + 0.5) / sides;
      rings.back().push_back(builder.vertex(path[i] + radius * (std::cos(angle) * across + std::sin(angle) * third)));
    }
  }
  const auto n = static_cast<std::size_t>(sides);
  for (std::size_t i = 0; i + (is_ring ? 0 : 1) < count; ++i) {
    const auto &low = rings[i], &high = rings[(i + 1) % count];
    for (std::size_t k = 0; k < n; ++k) builder.quad(low[k], low[(k + 1) % n], high[(k + 1) % n], high[k]);
  }
  if (is_ring) return;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    builder.triangle(rings.front()[0], rings.front()[k + 1], rings.front()[k]);
    builder.triangle(rings.back()[0], rings.back()[k], rings.back()[k + 1]);
  }
}

// A closed solid of revolution about the z axis; r and z of its profile from the lower to the upper pole, whose r is 0.
void add_turned_solid(MeshBuilder& builder, const std::vector<Vec2>& profile, int sides) {
  const std::uint32_t bottom = builder.vertex({0, 0, profile.front().y()}),
                      top = builder.vertex({0, 0, profile.back().y()});
  const std::uint32_t first = top + 1, n = static_cast<std::uint32_t>(sides);
  for (std::size_t i = 1; i + 1 < profile.size(); ++i)
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * kPi * k / sides;
      builder.vertex({profile[i].x() * std::cos(angle), profile[i].x() * std::sin(angle), profile[i].y()});
    }
  const auto rings = static_cast<std::uint32_t>(profile.size() - 2), last = first + (rings - 1) * n;
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    builder.triangle(bottom, first + next, first + k);
    for (std::uint32_t ring = first; ring < last; ring += n)
      builder.quad(ring + k, ring + next, ring + n + next, ring + n + k);
    builder.triangle(top, last + k, last + next);
  }
}

// Bars or tubes along the outer edges.
void add_outer_edges(MeshBuilder& builder, const DecoySpec& spec, const DecoyReflector& reflector) {
  if (!spec.inflatable && spec.frame_mm == 0) return;
  const double radius = spec.inflatable ? 1e-3 * spec.rounding_mm : 0.5e-3 * std::sqrt(2.0) * spec.frame_mm;
  std::vector<Vec3> joints;
  for (std::size_t i = 0; i < reflector.outer_edges.size(); ++i) {
    const std::vector<Vec3>& path = reflector.outer_edges[i];
    builder.begin_part(fmt::format("{}_{:02d}", spec.inflatable ? "tube" : "frame", i + 1));
    add_rod(builder, path, radius, spec.inflatable ? kSides : 4);
    for (const Vec3& end : {path.front(), path.back()})
      if (std::none_of(joints.begin(), joints.end(),
                       [&](const Vec3& joint) { return (joint - end).norm() < 1e-6 * spec.leg_m; }))
        joints.push_back(end);
  }
  if (!spec.inflatable) return;
  builder.begin_part("joints");
  for (const Vec3& joint : joints) add_sphere(builder, joint, radius, 2);
}

// Height at which a mast of this radius that rises along the z axis first touches the reflector, m: at a vertex within
// its cross-section, or where its axis or one of eight lines on its surface crosses a triangle.
double mast_top(const TriangleMesh& reflector, double radius) {
  double top = std::numeric_limits<double>::infinity(), lowest = top;
  for (const Vec3& p : reflector.vertices) {
    lowest = std::min(lowest, p.z());
    if (p.xy().norm() <= radius) top = std::min(top, p.z());
  }
  for (const auto& [a, b, c] : reflector.triangles) {
    const Vec3 &p = reflector.vertices[a], &q = reflector.vertices[b], &r = reflector.vertices[c];
    const double area = cross(q.xy() - p.xy(), r.xy() - p.xy());
    if (area == 0) continue;
    for (int line = 0; line < 9; ++line) {
      const double angle = 2 * kPi * line / 8;
      const Vec2 x = line == 8 ? Vec2::Zero() : radius * Vec2(std::cos(angle), std::sin(angle));
      // Barycentric coordinates in the horizontal projection.
      const double v = cross(x - p.xy(), r.xy() - p.xy()) / area, w = cross(q.xy() - p.xy(), x - p.xy()) / area;
      if (v >= 0 && w >= 0 && v + w <= 1) top = std::min(top, p.z() + v * (q.z() - p.z()) + w * (r.z() - p.z()));
    }
  }
  return std::isfinite(top) ? top : lowest;
}

// Float or raft, and what is fixed to it.
struct Flotation {
  double top = 0;           // below which the mast stands, m
  double clear_of = 0;      // height that the reflector must not reach, m
  Vec3 bow = Vec3::Zero();  // where the line ahead is fixed
};

Flotation add_flotation(MeshBuilder& builder, const DecoySpec& spec, double half_width) {
  const double water = -spec.mast_m;
  if (spec.support == DecoySupport::kRaft) {
    const double half = 0.5 * decoy_float_m(spec), tube = 0.2 * half, ring = half - tube, middle = water + 0.4 * tube,
                 floor = water + 0.3 * tube;
    std::vector<Vec3> path;
    for (int i = 0; i < 2 * kSides; ++i) {
      const double angle = kPi * i / kSides;
      path.push_back({ring * std::cos(angle), ring * std::sin(angle), middle});
    }
    builder.begin_part("raft");
    add_rod(builder, path, tube, kSides, true);
    builder.begin_part("floor");
    add_turned_solid(builder, {{0, floor - 0.1 * tube}, {ring, floor - 0.1 * tube}, {ring, floor}, {0, floor}},
                     2 * kSides);
    return {floor, half_width < ring - tube ? floor : middle + tube, {ring + 0.8 * tube, 0, middle + 0.3 * tube}};
  }
  builder.begin_part("float");
  if (spec.float_shape == DecoyFloat::kSphere) {
    const double radius = 0.5 * decoy_float_m(spec);
    add_sphere(builder, {0, 0, water}, radius, 3);
    return {water + 0.95 * radius, water + radius, {0.9 * radius, 0, water + 0.3 * radius}};
  }
  // Its edges are chamfered.
  const double radius = 0.5 * decoy_float_m(spec), half = 0.3 * radius;
  add_turned_solid(builder,
                   {{0, water - half},
                    {0.85 * radius, water - half},
                    {radius, water - 0.5 * half},
                    {radius, water + 0.5 * half},
                    {0.85 * radius, water + half},
                    {0, water + half}},
                   2 * kSides);
  return {water + 0.9 * half, water + half, {0.97 * radius, 0, water + 0.3 * half}};
}

// From a point above the water to its surface, ahead or astern: a parabola that is level where it ends.
void add_tether(MeshBuilder& builder, const DecoySpec& spec, const Vec3& bow) {
  const double height = bow.z() + spec.mast_m, ahead = spec.support == DecoySupport::kTow ? 1 : -1;
  if (!(spec.tether_m >= 2 * height))
    throw InputError(fmt::format("tether_m: value {}: must be 0 or at least {:.3g}, twice the height of its end",
                                 spec.tether_m, 2 * height));
  // Length of a flat parabola over a level distance x: x + 2 h^2 / (3 x), to the fourth order in h / x.
  const double x = 0.5 * (spec.tether_m + std::sqrt(spec.tether_m * spec.tether_m - 8.0 / 3 * height * height));
  constexpr int kPieces = 12;
  std::vector<Vec3> path;
  for (int i = 0; i <= kPieces; ++i) {
    const double s = static_cast<double>(i) / kPieces;
    path.push_back({ahead * (bow.x() + s * x), 0, height * (1 - s) * (1 - s) - spec.mast_m});
  }
  builder.begin_part("tether");
  add_rod(builder, path, kLineRadius_m, 8);
}

// A mast in the middle; through a ring of trihedra, with an arm to each apex; behind the seam of a dihedral.
void add_mast(MeshBuilder& builder, const DecoySpec& spec, const DecoyReflector& reflector, const TriangleMesh& mesh,
              double foot) {
  const double radius = 0.05 * spec.leg_m;
  const auto add_pole = [&](double x, double top) {
    add_cone(builder, {x, 0, foot}, {x, 0, top}, radius, radius, kSides);
  };
  builder.begin_part("mast");
  if (spec.kind == DecoyKind::kTrihedralCluster) {
    add_pole(0, bounds(mesh).upper.z());
    for (const Trihedron& trihedron : reflector.trihedra)
      add_bar(builder, {0, 0, trihedron.apex.z()}, trihedron.apex, radius);
  } else if (spec.kind == DecoyKind::kDihedral) {
    double seam = 0, top = std::numeric_limits<double>::infinity();
    for (const TrihedronPanel& panel : reflector.panels)
      for (const Vec3& end : {panel.corner, Vec3(panel.corner + panel.legs[0])}) {
        seam = std::min(seam, end.x());
        top = std::min(top, end.z());
      }
    add_pole(seam - 1.5 * radius, top + 0.5 * spec.leg_m);
  } else {
    add_pole(0, mast_top(mesh, radius));
  }
}

void add_support(MeshBuilder& builder, const DecoySpec& spec, const DecoyReflector& reflector,
                 const TriangleMesh& mesh) {
  if (spec.support == DecoySupport::kNone) return;
  double half_width = 0, lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : mesh.vertices) {
    half_width = std::max(half_width, p.xy().norm());
    lowest = std::min(lowest, p.z());
  }
  const Flotation flotation = add_flotation(builder, spec, half_width);
  if (!(lowest > flotation.clear_of))
    throw InputError(fmt::format(
        "the reflector's middle is {:g} m above the water: must be above {:.3g} m, so that it is clear of its {}",
        spec.mast_m, spec.mast_m + flotation.clear_of - lowest,
        spec.support == DecoySupport::kRaft ? "raft" : "float"));
  add_mast(builder, spec, reflector, mesh, flotation.top);
  if (spec.tether_m > 0) add_tether(builder, spec, flotation.bow);
}

bool is_perfect(const DecoySpec& spec) {
  return spec.angle_error_deg == 0 && spec.surface_error_mm == 0 && spec.rounding_mm == 0 && spec.missing_panels == 0 &&
         spec.dented_panels == 0;
}

}  // namespace

DecoySpec without_imperfections(DecoySpec spec) {
  spec.seed = 0;
  spec.angle_error_deg = spec.surface_error_mm = 0;
  spec.missing_panels = spec.dented_panels = 0;
  return spec;
}

DecoySpec decoy_of_body(DecoySpec spec, std::size_t body) {
  DecoySpec perfect = without_imperfections(spec);
  perfect.seed = spec.seed;
  if (body > 0 && spec != perfect) spec.seed = Random({spec.seed, Stream::kDecoy, kBodyIndex + body}).bits();
  return spec;
}

double largest_displacement_m(const DecoySpec& spec) {
  // Ends of both legs at the corner of a square panel; three modes of unit mean square, over sqrt3.
  constexpr double kLargestDeviate = 8.3, kLegs = 2, kLargestMode = 5;
  return kLargestDeviate * (kLegs * std::tan(radians(spec.angle_error_deg)) * spec.leg_m +
                            kLargestMode * 1e-3 * spec.surface_error_mm) +
         (spec.dented_panels > 0 ? spec.dent_depth * spec.leg_m : 0);
}

int decoy_panel_count(const DecoySpec& spec) {
  switch (spec.kind) {
    case DecoyKind::kIcosahedral: return 60;
    case DecoyKind::kOctahedral: return 12;
    case DecoyKind::kTrihedralCluster: return 3 * spec.cells;
    case DecoyKind::kTrihedral: return 3;
    case DecoyKind::kLuneburgLens: return 0;
    case DecoyKind::kDihedral: break;
  }
  return 2;
}

double decoy_float_m(const DecoySpec& spec) {
  if (spec.support == DecoySupport::kNone) return 0;
  if (spec.float_m > 0) return spec.float_m;
  if (spec.support == DecoySupport::kRaft) return 3 * spec.leg_m;
  return (spec.float_shape == DecoyFloat::kSphere ? 1.2 : 2) * spec.leg_m;
}

TriangleMesh make_decoy(const DecoySpec& spec) {
  check_bounds(spec);
  check_contradictions(spec);
  const DecoyReflector reflector = decoy_reflector(spec);
  TriangleMesh mesh = spec.kind == DecoyKind::kIcosahedral && is_perfect(spec)
                          ? make_icosahedral_reflector(spec.leg_m * std::sqrt(2.0))
                          : reflector_mesh(spec, reflector);
  MeshBuilder others;
  add_outer_edges(others, spec, reflector);
  add_support(others, spec, reflector, mesh);
  if (others.triangle_count() > 0) {
    TriangleMesh solids = others.take();
    solids.corner_normals = crease_normals(solids, radians(kSmoothTurn_deg), 0);
    mesh.append(solids);
  }
  fill_normals(mesh);
  return mesh;
}

}  // namespace seaglint
