// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/decoy/make_decoy.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {

namespace {

// Indices of RandomKey; the surface of panel i has kSurfaceIndex + i.
enum DecoyIndex : std::uint64_t { kAngleIndex, kChoiceIndex, kSurfaceIndex };

// Of the side of a curved panel, five per period of the shortest mode. On the axis of a trihedron whose heights cost
// 0.9 dB, 16 change the echo by 0.04 dB.
constexpr int kDivisions = 8;
constexpr int kArcSides = 16;  // of a quarter of a circle, whose polygon has 0.16 % less area
constexpr int kFilletSides = 6;

// Points at the same place are one vertex, to a billionth of `size` (m).
class WeldedVertices {
 public:
  WeldedVertices(MeshBuilder& builder, double size) : builder_(builder), step_(1e-6 * size), tolerance_(1e-9 * size) {}

  std::uint32_t operator()(const Vec3& p) {
    const Place low = place(p - Vec3::Constant(tolerance_)), high = place(p + Vec3::Constant(tolerance_));
    for (const std::int64_t x : {low[0], high[0]})
      for (const std::int64_t y : {low[1], high[1]})
        for (const std::int64_t z : {low[2], high[2]})
          if (const auto found = index_.find({x, y, z}); found != index_.end()) return found->second;
    return index_[place(p)] = builder_.vertex(p);
  }

 private:
  using Place = std::array<std::int64_t, 3>;
  Place place(const Vec3& p) const {
    const auto along = [&](double x) { return static_cast<std::int64_t>(std::floor(x / step_)); };
    return {along(p.x()), along(p.y()), along(p.z())};
  }

  MeshBuilder& builder_;
  double step_, tolerance_;
  std::map<Place, std::uint32_t> index_;
};

// Legs of length `leg` along the columns of `axes`, leg i tilted by tilts(i, j) times leg j.
std::array<Vec3, 3> tilted_legs(const Mat3& axes, const Mat3& tilts, double leg) {
  std::array<Vec3, 3> legs;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 direction = axes.col(i);
    for (std::size_t j = 0; j < 3; ++j)
      if (j != i) direction += tilts(i, j) * axes.col(j);
    legs[i] = leg * direction.normalized();
  }
  return legs;
}

// The corner angle of legs i and j changes by -(t_ij + t_ji), and so does the angle between the panels at the third
// leg: cos A = (cos a - cos b cos c) / (sin b sin c) of a spherical triangle with b = c = 90 deg. Tilts of this
// standard deviation give angles of angle_error_deg.
double tilt_spread(const DecoySpec& spec) { return std::tan(radians(spec.angle_error_deg)) / std::sqrt(2.0); }

Mat3 random_tilts(double spread, Random& random) {
  Mat3 tilts = Mat3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (i != j) tilts(i, j) = spread * random.normal();
  return tilts;
}

// Boresight (1, 1, 1) / sqrt3 to azimuth 0 and an elevation (rad), leg 3 upwards.
Mat3 facing_forward(double elevation) {
  const Vec3 facing = Vec3(1, 1, 1).normalized(), up = Vec3(-1, -1, 2).normalized();
  return axis_rotation(-elevation, Vec3::UnitY()) * Mat3(Mat3(facing, up.cross(facing), up).transpose());
}

std::vector<Vec3> outer_edge(DecoyPanel shape, const Vec3& corner, const Vec3& a, const Vec3& b) {
  if (shape == DecoyPanel::kTriangular) return {corner + a, corner + b};
  if (shape == DecoyPanel::kSquare) return {corner + a, corner + (a + b), corner + b};
  std::vector<Vec3> arc;
  for (int i = 0; i <= kArcSides; ++i) {
    const double angle = 0.5 * kPi * i / kArcSides;
    arc.push_back(corner + (std::cos(angle) * a + std::sin(angle) * b));
  }
  return arc;
}

void add_panel(DecoyReflector& reflector, const TrihedronPanel& panel) {
  const std::vector<Vec3> edge = outer_edge(reflector.shape, panel.corner, panel.legs[0], panel.legs[1]);
  if (reflector.shape == DecoyPanel::kSquare) {
    reflector.outer_edges.push_back({edge[0], edge[1]});
    reflector.outer_edges.push_back({edge[1], edge[2]});
  } else {
    reflector.outer_edges.push_back(edge);
  }
  reflector.panels.push_back(panel);
}

DecoyReflector icosahedral(const DecoySpec& spec) {
  const TriangleMesh perfect = make_icosahedral_reflector(spec.leg_m * std::sqrt(2.0));
  Random random({spec.seed, Stream::kDecoy, kAngleIndex});
  DecoyReflector reflector{.has_caps = true};
  std::set<std::pair<std::uint32_t, std::uint32_t>> rims;
  for (std::size_t cell = 0; cell < perfect.part_names.size(); ++cell) {
    // Triangles a b apex, b c apex, c a apex.
    const auto& [a, b, bottom] = perfect.triangles[3 * cell];
    const std::array<std::uint32_t, 3> tips{a, b, perfect.triangles[3 * cell + 1][1]};
    Vec3 apex = perfect.vertices[bottom];

    // An apex displaced by d opens the right angle at leg k by (d_i + d_j) / leg, i and j the other legs.
    const double spread = radians(spec.angle_error_deg) * spec.leg_m;
    const Vec3 opening(spread * random.normal(), spread * random.normal(), spread * random.normal());
    Vec3 shift = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      shift += (0.5 * opening.sum() - opening[k]) * (perfect.vertices[tips[k]] - apex).normalized();
    apex += shift;

    Trihedron trihedron{.apex = apex, .part = perfect.part_names[cell]};
    for (std::size_t k = 0; k < 3; ++k) trihedron.legs[k] = perfect.vertices[tips[k]] - apex;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      reflector.panels.push_back({apex, {trihedron.legs[k], trihedron.legs[next]}, trihedron.part});
      if (rims.insert(std::minmax(tips[k], tips[next])).second)
        reflector.outer_edges.push_back({perfect.vertices[tips[k]], perfect.vertices[tips[next]]});
    }
    reflector.trihedra.push_back(trihedron);
  }
  return reflector;
}

DecoyReflector octahedral(const DecoySpec& spec) {
  // Cell (1, 1, -1) of the rain catcher and cell (1, 1, 1) of the other pose are towards +x.
  const Vec3 up = Vec3(1, 1, 1).normalized(), ahead = Vec3(1, 1, -2).normalized();
  const Mat3 rain_catcher = Mat3(ahead, up.cross(ahead), up).transpose();
  const Mat3 axes = spec.pose == DecoyPose::kPointUp ? axis_rotation(-0.25 * kPi, Vec3::UnitZ()) : rain_catcher;
  Random random({spec.seed, Stream::kDecoy, kAngleIndex});
  const double spread = tilt_spread(spec);
  std::array<std::array<Vec3, 3>, 2> half;  // the half axes to either side
  for (const std::size_t side : {0u, 1u})
    half[side] = tilted_legs(side == 0 ? axes : -axes, random_tilts(spread, random), spec.leg_m);

  DecoyReflector reflector{.shape = spec.panel, .has_caps = true};
  for (std::size_t k = 0; k < 3; ++k)
    for (const std::size_t first : {0u, 1u})
      for (const std::size_t second : {0u, 1u})
        add_panel(reflector, {Vec3::Zero(),
                              {half[first][k], half[second][(k + 1) % 3]},
                              fmt::format("panel_{:02d}", reflector.panels.size() + 1)});
  for (std::size_t octant = 0; octant < 8; ++octant) {
    const std::size_t x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
    Trihedron trihedron{.legs = {half[x][0], half[y][1], half[z][2]}, .part = "seams"};
    if ((x + y + z) % 2 == 1) std::swap(trihedron.legs[0], trihedron.legs[1]);
    reflector.trihedra.push_back(trihedron);
  }
  return reflector;
}

// Panel k is opposite to leg k; part: of all panels, or empty for one part each.
void add_trihedron(DecoyReflector& reflector, const Vec3& apex, const std::array<Vec3, 3>& legs,
                   const std::string& part) {
  for (std::size_t k = 0; k < 3; ++k)
    add_panel(reflector,
              {apex, {legs[(k + 1) % 3], legs[(k + 2) % 3]}, part.empty() ? fmt::format("panel_{:02d}", k + 1) : part});
  reflector.trihedra.push_back({apex, legs, part.empty() ? "seams" : part});
}

DecoyReflector trihedral(const DecoySpec& spec) {
  const Mat3 axes = facing_forward(radians(spec.boresight_elevation_deg));
  Random random({spec.seed, Stream::kDecoy, kAngleIndex});
  Mat3 tilts = random_tilts(tilt_spread(spec), random);
  for (std::size_t k = 0; k < 3; ++k) {
    const double half_error = std::tan(0.5 * radians(spec.seam_errors_deg[k]));
    tilts((k + 1) % 3, (k + 2) % 3) -= half_error;
    tilts((k + 2) % 3, (k + 1) % 3) -= half_error;
  }
  const Vec3 apex = -0.5 * spec.leg_m / std::sqrt(3.0) * (axes * Vec3(1, 1, 1).normalized());
  DecoyReflector reflector{.shape = spec.panel};
  add_trihedron(reflector, apex, tilted_legs(axes, tilts, spec.leg_m), "");
  return reflector;
}

DecoyReflector trihedral_cluster(const DecoySpec& spec) {
  const Mat3 axes = facing_forward(radians(spec.boresight_elevation_deg));
  // Each trihedron stays within its sector of the ring and clear of the mast.
  const double clearance = 0.1 * spec.leg_m, sector = std::tan(kPi / spec.cells);
  double radius = clearance, lowest = 0, highest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 end = spec.leg_m * axes.col(k);
    radius = std::max({radius, clearance - end.x(), (0.5 * clearance + std::abs(end.y())) / sector - end.x()});
    lowest = std::min(lowest, end.z());
    highest = std::max(highest, end.z());
  }
  Random random({spec.seed, Stream::kDecoy, kAngleIndex});
  DecoyReflector reflector;
  for (int cell = 0; cell < spec.cells; ++cell) {
    const Mat3 turn = axis_rotation(2 * kPi * cell / spec.cells, Vec3::UnitZ());
    add_trihedron(reflector, turn * Vec3(radius, 0, -0.5 * (lowest + highest)),
                  tilted_legs(turn * axes, random_tilts(tilt_spread(spec), random), spec.leg_m),
                  fmt::format("cell_{:02d}", cell + 1));
  }
  return reflector;
}

DecoyReflector dihedral(const DecoySpec& spec) {
  Random random({spec.seed, Stream::kDecoy, kAngleIndex});
  const double half_opening = 0.25 * kPi + 0.5 * radians(spec.angle_error_deg) * random.normal(), leg = spec.leg_m;
  const Mat3 tilt = axis_rotation(-radians(spec.boresight_elevation_deg), Vec3::UnitY());
  const Vec3 corner(-0.5 * leg * std::cos(half_opening), 0, -0.5 * leg), up(0, 0, leg);
  DecoyReflector reflector{.shape = DecoyPanel::kSquare};
  for (const double side : {1.0, -1.0}) {
    // Normals point into the opening.
    const Vec3 face(leg * std::cos(half_opening), side * leg * std::sin(half_opening), 0);
    const Vec3 low = tilt * corner, seam = tilt * up, out = tilt * face;
    reflector.panels.push_back({side > 0 ? low + seam : low,
                                {side > 0 ? -seam : seam, out},
                                fmt::format("panel_{:02d}", reflector.panels.size() + 1)});
    reflector.outer_edges.push_back({low, low + out});
    reflector.outer_edges.push_back({low + out, low + seam + out});
    reflector.outer_edges.push_back({low + seam + out, low + seam});
  }
  return reflector;
}

// The three lowest modes of a membrane of the unit panel that is held at all sides, orthogonal and of mean square 1. A
// right isosceles triangle and a square: sums of products of sines (M. G. Lame, Lecons sur la theorie mathematique de
// l'elasticite des corps solides, 1852). A quarter of a circle: polynomials of the same symmetry.
Vec3 panel_modes(DecoyPanel shape, double u, double v) {
  const auto product = [&](int m, int n) { return std::sin(m * kPi * u) * std::sin(n * kPi * v); };
  if (shape == DecoyPanel::kTriangular) {
    const auto mode = [&](int m, int n) {
      return std::sqrt(2.0) * (product(m, n) - ((m + n) % 2 == 0 ? 1 : -1) * product(n, m));
    };
    return {mode(1, 2), mode(1, 3), mode(2, 3)};
  }
  if (shape == DecoyPanel::kSquare) return {2 * product(1, 1), 2 * product(1, 2), 2 * product(2, 1)};
  // r^2 sin 2t and r^4 sin 4t, t the polar angle.
  const double r2 = u * u + v * v, second = 2 * u * v, fourth = 2 * second * (u * u - v * v);
  return {std::sqrt(60.0) * second * (1 - r2), std::sqrt(210.0) * fourth * (1 - r2),
          std::sqrt(1680.0) * second * (1 - r2) * (r2 - 0.5)};
}

// A dent of depth 1 in the middle of the unit panel, flat at its sides.
double dent(DecoyPanel shape, double u, double v) {
  const double bubble = shape == DecoyPanel::kTriangular ? 27 * u * v * (1 - u - v)
                        : shape == DecoyPanel::kSquare   ? 16 * u * (1 - u) * v * (1 - v)
                                                         : 8 * u * v * (1 - u * u - v * v);
  return bubble * bubble;
}

// A panel between its fillets, displaced along its normal.
class PanelSurface {
 public:
  DecoyPanel shape = DecoyPanel::kTriangular;
  Vec3 corner, a, b, normal;
  double first_p = 0, first_q = 0;  // where the fillets end
  Vec3 amplitudes = Vec3::Zero();   // of panel_modes(), m
  double dent_m = 0;

  // u, v of the unit panel.
  Vec3 at(double u, double v) const {
    double p = first_p + (1 - first_p) * u, q = first_q + (1 - first_q) * v;
    if (shape == DecoyPanel::kTriangular) {
      p = first_p + (1 - 2 * first_p) * u;
      q = first_q + (1 - 2 * first_q) * v;
    } else if (const double t = std::hypot(u, v); shape == DecoyPanel::kCircular && t > 0) {
      // Along the line from (first, first) in the direction of (u, v) to the circle of radius 1.
      const double sum = first_p * (u + v) / t, reach = std::sqrt(sum * sum + 1 - 2 * first_p * first_p) - sum;
      p = first_p + reach * u;
      q = first_q + reach * v;
    }
    const double height = amplitudes.dot(panel_modes(shape, u, v)) + dent_m * dent(shape, u, v);
    return corner + (p * a + q * b) + height * normal;
  }

  // By central differences, whose error is the square of the step.
  Vec3 normal_at(double u, double v) const {
    constexpr double kStep = 1e-5;
    return (at(u + kStep, v) - at(u - kStep, v)).cross(at(u, v + kStep) - at(u, v - kStep)).normalized();
  }
};

// The unit panel cut into triangles.
struct PanelGrid {
  std::vector<Vec2> nodes;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

PanelGrid panel_grid(DecoyPanel shape, std::uint32_t divisions) {
  PanelGrid grid;
  const std::uint32_t n = divisions, sides = shape == DecoyPanel::kCircular ? kArcSides : n;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { grid.triangles.push_back({a, b, c}); };
  if (shape == DecoyPanel::kTriangular) {
    const auto node = [&](std::uint32_t i, std::uint32_t j) { return j * (n + 1) - j * (j - 1) / 2 + i; };
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i + j <= n; ++i) grid.nodes.push_back({double(i) / n, double(j) / n});
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i + j < n; ++i) {
        add(node(i, j), node(i + 1, j), node(i, j + 1));
        if (i + j + 2 <= n) add(node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
      }
    return grid;
  }
  // Rows i of a square, circles i about the corner.
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= sides; ++j) {
      const double t = double(i) / n, s = double(j) / sides, angle = 0.5 * kPi * s;
      grid.nodes.push_back(shape == DecoyPanel::kSquare ? Vec2(t, s)
                           : j == 0                     ? Vec2(t, 0)
                           : j == sides                 ? Vec2(0, t)
                                                        : Vec2(t * std::cos(angle), t * std::sin(angle)));
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < sides; ++j) {
      const std::uint32_t here = i * (sides + 1) + j, out = here + sides + 1;
      add(here, out, out + 1);
      if (i > 0 || shape == DecoyPanel::kSquare) add(here, out + 1, here + 1);
    }
  return grid;
}

// Fillets of radius `rho`, over the leg, between the panels of a trihedron; coordinates are along its legs, over them.
class FilletMesh {
 public:
  FilletMesh(MeshBuilder& builder, WeldedVertices& vertex, double rho, std::uint32_t divisions)
      : builder_(builder), vertex_(vertex), rho_(rho), divisions_(divisions) {}

  // Frame of a seam: along it and across it, right-handed.
  void set_frame(const Vec3& origin, const Vec3& along, const Vec3& first, const Vec3& second) {
    frame_ = {origin, Mat3(along, first, second)};
    to_normal_ = Mat3(frame_.R.inverse().transpose());
  }

  // The seam between two panels, from `start` to `end` along it, shorter by the fillet's height where the ends of the
  // seams bound a plane.
  void add_seam(double start, double end, bool slanted_end) {
    const auto point = [&](std::uint32_t i, int k) {
      const double angle = 0.5 * kPi * k / kFilletSides, y = rho_ * (1 - std::sin(angle)),
                   z = rho_ * (1 - std::cos(angle)), last = slanted_end ? end - y - z : end;
      return Vec3(start + (last - start) * i / divisions_, k == kFilletSides ? 0 : y, k == 0 ? 0 : z);
    };
    const auto normal = [&](int k) {
      const double angle = 0.5 * kPi * k / kFilletSides;
      return Vec3(0, std::sin(angle), std::cos(angle));
    };
    for (std::uint32_t i = 0; i < divisions_; ++i)
      for (int k = 0; k < kFilletSides; ++k) {
        add({point(i, k), point(i, k + 1), point(i + 1, k + 1)}, {normal(k), normal(k + 1), normal(k + 1)});
        add({point(i, k), point(i + 1, k + 1), point(i + 1, k)}, {normal(k), normal(k + 1), normal(k)});
      }
    end_.clear();
    for (int k = 0; k <= kFilletSides; ++k) end_.push_back(point(divisions_, k));
  }

  // The plane between the end of the last fillet and the end of its seam.
  void add_cap(double end) {
    for (std::size_t k = 0; k + 1 < end_.size(); ++k)
      builder_.triangle(vertex_(frame_ * Vec3(end, 0, 0)), vertex_(frame_ * end_[k]), vertex_(frame_ * end_[k + 1]));
  }

  // An eighth of a sphere at the apex, seen from inside.
  void add_apex() {
    constexpr int n = kFilletSides;
    const auto normal = [&](int i, int j) {
      const auto sine = [&](int k) { return std::sin(0.5 * kPi * k / n); };
      return Vec3(sine(i), sine(j), sine(n - i - j)).normalized();
    };
    const auto point = [&](int i, int j) {
      const Vec3 d = Vec3::Constant(1) - normal(i, j);
      return rho_ * Vec3(i == n ? 0 : d.x(), j == n ? 0 : d.y(), i + j == 0 ? 0 : d.z());
    };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        add({point(i, j), point(i + 1, j), point(i, j + 1)}, {normal(i, j), normal(i + 1, j), normal(i, j + 1)});
        if (i + j + 2 <= n)
          add({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)},
              {normal(i + 1, j), normal(i + 1, j + 1), normal(i, j + 1)});
      }
  }

 private:
  void add(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) {
    builder_.triangle(vertex_(frame_ * corners[0]), vertex_(frame_ * corners[1]), vertex_(frame_ * corners[2]),
                      {to_normal_ * normals[0], to_normal_ * normals[1], to_normal_ * normals[2]});
  }

  MeshBuilder& builder_;
  WeldedVertices& vertex_;
  double rho_;
  std::uint32_t divisions_;
  Pose frame_;
  Mat3 to_normal_;
  std::vector<Vec3> end_;
};

// Sides of a lens along its circumference. The polygon of a projection has 0.2 to 0.3 % less area than the disc.
constexpr int kLensSides = 64;

// A sphere with its vertices at leg_m from its centre: rings about its axis, from the front of the lens to the middle
// of the cap, with one ring along the rim. Outside the cap it has the material of a lens.
TriangleMesh lens_mesh(const DecoySpec& spec) {
  const Mat3 axes = axis_rotation(-radians(spec.boresight_elevation_deg), Vec3::UnitY());
  const double rim = kPi - radians(spec.cap_half_angle_deg), step = 2 * kPi / kLensSides;
  std::vector<double> angles{0};  // of the rings from the axis
  std::size_t rim_ring = 0;
  for (const double end : {rim, kPi}) {
    const double start = angles.back();
    const int rings = static_cast<int>(std::ceil((end - start) / step));
    if (end == kPi) rim_ring = angles.size() - 1;
    for (int i = 1; i <= rings; ++i) angles.push_back(start + (end - start) * i / rings);
  }
  MeshBuilder builder;
  std::vector<Vec3> normals;
  const auto point = [&](double angle, int k) {
    const double turn = step * k;
    const Vec3 normal =
        axes * Vec3(std::cos(angle), std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn));
    normals.push_back(normal);
    return builder.vertex(spec.leg_m * normal);
  };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) builder.triangle(a, b, c, {normals[a], normals[b], normals[c]});
  };
  const auto ring_at = [&](std::size_t i) {
    const bool is_pole = i == 0 || i + 1 == angles.size();
    std::vector<std::uint32_t> ring{point(angles[i], 0)};
    for (int k = 1; k < kLensSides; ++k) ring.push_back(is_pole ? ring.front() : point(angles[i], k));
    return ring;
  };
  builder.begin_part("lens");
  builder.begin_material(lens_material_name(spec.lens_loss_db));
  std::vector<std::uint32_t> ring = ring_at(0);
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    if (i == rim_ring) {
      builder.begin_part("cap");
      builder.begin_material(Material{}.name);
    }
    const std::vector<std::uint32_t> next = ring_at(i + 1);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t beside = (k + 1) % ring.size();
      add(ring[k], next[k], next[beside]);
      add(ring[k], next[beside], ring[beside]);
    }
    ring = next;
  }
  return builder.take();
}

}  // namespace

DecoyReflector decoy_reflector(const DecoySpec& spec) {
  switch (spec.kind) {
    case DecoyKind::kIcosahedral: return icosahedral(spec);
    case DecoyKind::kOctahedral: return octahedral(spec);
    case DecoyKind::kTrihedralCluster: return trihedral_cluster(spec);
    case DecoyKind::kTrihedral: return trihedral(spec);
    case DecoyKind::kLuneburgLens: return {};
    case DecoyKind::kDihedral: break;
  }
  return dihedral(spec);
}

TriangleMesh reflector_mesh(const DecoySpec& spec, const DecoyReflector& reflector) {
  if (spec.kind == DecoyKind::kLuneburgLens) return lens_mesh(spec);
  const bool is_curved = spec.surface_error_mm > 0 || spec.dented_panels > 0, is_dihedral = reflector.trihedra.empty();
  const std::uint32_t divisions = is_curved ? kDivisions : 1;
  const double rho = 1e-3 * spec.rounding_mm / spec.leg_m;
  MeshBuilder builder;
  WeldedVertices vertex(builder, spec.leg_m);

  // The first panels of a random order are missing, the next ones dented.
  std::vector<std::size_t> order(reflector.panels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random choice({spec.seed, Stream::kDecoy, kChoiceIndex});
  shuffle(order, choice);
  std::vector<int> rank(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<int>(i);

  const PanelGrid grid = panel_grid(reflector.shape, divisions);
  for (std::size_t i = 0; i < reflector.panels.size(); ++i) {
    const TrihedronPanel& panel = reflector.panels[i];
    builder.begin_part(panel.part);
    Random random({spec.seed, Stream::kDecoy, kSurfaceIndex + i});
    PanelSurface surface{.shape = reflector.shape,
                         .corner = panel.corner,
                         .a = panel.legs[0],
                         .b = panel.legs[1],
                         .normal = panel.legs[0].cross(panel.legs[1]).normalized(),
                         .first_p = is_dihedral ? 0 : rho,
                         .first_q = rho};
    for (std::size_t m = 0; m < 3; ++m)
      surface.amplitudes[m] = 1e-3 * spec.surface_error_mm / std::sqrt(3.0) * random.normal();
    const double side = random.uniform() < 0.5 ? 1 : -1;
    if (rank[i] < spec.missing_panels) continue;
    if (rank[i] < spec.missing_panels + spec.dented_panels) surface.dent_m = side * spec.dent_depth * spec.leg_m;

    std::vector<std::uint32_t> index;
    std::vector<Vec3> normals;
    for (const Vec2& node : grid.nodes) {
      index.push_back(vertex(surface.at(node.x(), node.y())));
      normals.push_back(is_curved ? surface.normal_at(node.x(), node.y()) : surface.normal);
    }
    for (const auto& [a, b, c] : grid.triangles) {
      if (is_curved || rho > 0)
        builder.triangle(index[a], index[b], index[c], {normals[a], normals[b], normals[c]});
      else
        builder.triangle(index[a], index[b], index[c]);
    }
  }
  if (rho == 0) return builder.take();

  FilletMesh fillets(builder, vertex, rho, divisions);
  if (is_dihedral) {
    builder.begin_part("seams");
    const TrihedronPanel& starboard = reflector.panels[1];
    fillets.set_frame(starboard.corner, starboard.legs[0], starboard.legs[1], reflector.panels[0].legs[1]);
    fillets.add_seam(0, 1, false);
  }
  const double end = reflector.shape == DecoyPanel::kCircular ? std::sqrt(1 - rho * rho) : 1;
  for (const auto& [apex, legs, part] : reflector.trihedra) {
    builder.begin_part(part);
    for (std::size_t k = 0; k < 3; ++k) {
      fillets.set_frame(apex, legs[k], legs[(k + 1) % 3], legs[(k + 2) % 3]);
      fillets.add_seam(rho, end, reflector.shape == DecoyPanel::kTriangular);
      if (reflector.has_caps) fillets.add_cap(end);
      if (k == 0) fillets.add_apex();
    }
  }
  return builder.take();
}

}  // namespace seaglint
