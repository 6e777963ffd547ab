// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/cavity_aperture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/mesh/topology.h"

namespace seaglint {
namespace {

std::string place(const Vec3& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x.x(), x.y(), x.z()); }

// The rims as closed polygons, oriented so that the aperture is on their left seen from inside the cavity: opposite to
// the sense of the wall triangles.
std::vector<std::vector<Vec3>> aperture_rims(const TriangleMesh& walls) {
  const Topology topology = topology_of(walls);
  std::map<std::uint32_t, std::uint32_t> next;  // vertex after each vertex of a rim
  for (const MeshEdge& edge : topology.edges) {
    const Vec3& at = walls.vertices[edge.vertices[0]];
    if (edge.kind == EdgeKind::kInconsistent)
      throw InputError(fmt::format("two triangles of the cavity's walls have opposite orientation at {}", place(at)));
    if (edge.kind == EdgeKind::kNonManifold)
      throw InputError(fmt::format("more than two triangles of the cavity's walls meet at {}", place(at)));
    if (edge.kind != EdgeKind::kBoundary) continue;
    auto [to, from] = edge.vertices;
    if (!topology.uses[edge.first_use].forward) std::swap(to, from);
    if (!next.emplace(from, to).second)
      throw InputError(fmt::format("an edge of the cavity aperture touches itself at {}", place(walls.vertices[from])));
  }
  std::vector<std::vector<Vec3>> rims;
  while (!next.empty()) {
    std::vector<Vec3> rim;
    const std::uint32_t start = next.begin()->first;
    std::uint32_t end = start;
    for (auto at = next.begin(); at != next.end();) {
      rim.push_back(walls.vertices[at->first]);
      end = at->second;
      next.erase(at);
      at = next.find(end);
    }
    if (end != start)
      throw InputError(fmt::format("an edge of the cavity aperture does not close at {}", place(walls.vertices[end])));
    rims.push_back(std::move(rim));
  }
  return rims;
}

// Newell's area vector, valid for any closed polygon, plane or not, convex or not.
Vec3 area_of(const std::vector<Vec3>& ring) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += 0.5 * (ring[i] - ring[0]).cross(ring[(i + 1) % ring.size()] - ring[0]);
  return sum;
}

using Outline = std::vector<Vec2>;

// Part of the outline with side . p >= offset. Non-convex parts may be connected by coincident opposite edges along the
// cut, whose areas cancel.
Outline clipped(const Outline& outline, const Vec2& side, double offset) {
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double ha = side.dot(a) - offset, hb = side.dot(b) - offset;
    if (ha >= 0) kept.push_back(a);
    if ((ha >= 0) != (hb >= 0)) kept.push_back(a + ha / (ha - hb) * (b - a));
  }
  return kept;
}

struct Patch2 {
  double area = 0;
  Vec2 moment = Vec2::Zero();  // of the area about the origin
};

Patch2 measure(const Outline& outline) {
  Patch2 sum;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double twice = a.x() * b.y() - a.y() * b.x();
    sum.area += 0.5 * twice;
    sum.moment += twice / 6 * (a + b);
  }
  return sum;
}

// Coplanar rims of opposite orientation bound one aperture, the largest first; the others are islands in it.
std::vector<std::vector<std::vector<Vec3>>> apertures_of(std::vector<std::vector<Vec3>> rims, double pitch) {
  std::stable_sort(rims.begin(), rims.end(),
                   [](const auto& a, const auto& b) { return area_of(a).norm() > area_of(b).norm(); });
  std::vector<std::vector<std::vector<Vec3>>> openings;
  for (const std::vector<Vec3>& rim : rims) {
    const Vec3 area = area_of(rim);
    if (!(area.norm() > 0)) continue;
    const auto around = std::find_if(openings.begin(), openings.end(), [&](const auto& opening) {
      const Vec3 n = area_of(opening.front()).normalized();
      return n.dot(area.normalized()) < -0.999 && std::abs(n.dot(rim.front() - opening.front().front())) < pitch / 4;
    });
    if (around == openings.end()) {
      openings.push_back({rim});
    } else {
      around->push_back(rim);
    }
  }
  return openings;
}

void add_cells(const std::vector<std::vector<Vec3>>& rims, double pitch, std::vector<ApertureCell>& cells) {
  ApertureCell cell;
  cell.inward = area_of(rims.front()).normalized();
  cell.across = cell.inward.unitOrthogonal();
  cell.up = cell.inward.cross(cell.across);

  Vec3 origin = Vec3::Zero();
  for (const Vec3& x : rims.front()) origin += x / static_cast<double>(rims.front().size());
  std::vector<Outline> outlines;  // islands are clockwise: negative areas
  Vec2 lower = Vec2::Zero(), upper = Vec2::Zero();
  for (const std::vector<Vec3>& rim : rims) {
    outlines.emplace_back();
    for (const Vec3& x : rim) {
      const double uneven = std::abs(cell.inward.dot(x - origin));
      if (uneven > pitch / 4)
        throw InputError(
            fmt::format("an edge of the cavity aperture is not flat: {} lies {:.3g} m off its plane, at most {:.3g} m "
                        "at this wavelength",
                        place(x), uneven, pitch / 4));
      outlines.back().emplace_back(cell.across.dot(x - origin), cell.up.dot(x - origin));
      lower = lower.cwiseMin(outlines.back().back());
      upper = upper.cwiseMax(outlines.back().back());
    }
  }
  const Vec2 size = upper - lower;
  const int columns = static_cast<int>(std::ceil(size.x() / pitch)),
            rows = static_cast<int>(std::ceil(size.y() / pitch));
  for (int i = 0; i < columns; ++i) {
    const double left = lower.x() + size.x() * i / columns, right = lower.x() + size.x() * (i + 1) / columns;
    std::vector<Outline> column;
    for (const Outline& outline : outlines)
      column.push_back(clipped(clipped(outline, Vec2::UnitX(), left), -Vec2::UnitX(), -right));
    for (int j = 0; j < rows; ++j) {
      const double below = lower.y() + size.y() * j / rows, above = lower.y() + size.y() * (j + 1) / rows;
      Patch2 piece;
      for (const Outline& outline : column) {
        const Patch2 part = measure(clipped(clipped(outline, Vec2::UnitY(), below), -Vec2::UnitY(), -above));
        piece.area += part.area;
        piece.moment += part.moment;
      }
      if (piece.area < 1e-6 * pitch * pitch) continue;
      const Vec2 centre = piece.moment / piece.area;
      cell.area = piece.area;
      cell.centre = origin + centre.x() * cell.across + centre.y() * cell.up;
      cells.push_back(cell);
    }
  }
}

}  // namespace

std::vector<ApertureCell> aperture_cells(const TriangleMesh& walls, double pitch) {
  std::vector<ApertureCell> cells;
  for (const auto& rims : apertures_of(aperture_rims(walls), pitch)) add_cells(rims, pitch, cells);
  if (cells.empty())
    throw InputError("cavity walls are closed, or their openings are smaller than one cell at this wavelength");
  // Walls and openings together enclose the cavity; their normals point into it.
  const Vec3 origin = walls.vertices[walls.triangles.front()[0]];
  double volume = enclosed_volume(transformed(walls, Mat3::Identity(), -origin));
  for (const ApertureCell& cell : cells) volume += cell.area * cell.inward.dot(cell.centre - origin) / 3;
  const double area = surface_area(walls);
  if (std::abs(volume) < 1e-6 * area * std::sqrt(area))
    throw InputError(
        "the cavity's walls and openings enclose nothing: a sheet, or triangles whose corners do not meet");
  if (volume > 0) throw InputError("the cavity's walls face away from its inside: turn their triangles");
  return cells;
}

namespace {

constexpr std::size_t kWallsPerTask = 32;  // patches that one thread takes at a time

// Cells of the aperture with an unobstructed path to the antenna.
std::vector<bool> visible_cells(std::span<const ApertureCell> aperture, const Vec3& r_hat, const RayScene& scene,
                                double radius) {
  std::vector<Ray> rays;
  // Rays start off the plane of the aperture, so that they do not hit its rim (Embree is single precision).
  for (const ApertureCell& cell : aperture) {
    const double off = 1e-2 * std::sqrt(cell.area) + 1e-6 * radius;
    rays.push_back({cell.centre + off * (r_hat - cell.inward), r_hat});
  }
  std::vector<int> hit(rays.size());
  scene.first_hits(rays, hit);
  std::vector<bool> visible(aperture.size());
  for (std::size_t i = 0; i < aperture.size(); ++i)
    visible[i] = aperture[i].inward.dot(r_hat) < 0 && hit[i] == kNoFacet;
  return visible;
}

}  // namespace

ApertureFields incident_aperture_fields(std::span<const ApertureCell> aperture, double k,
                                        std::span<const BistaticGeometry> views, RadarBasis BistaticGeometry::*antenna,
                                        const RayScene& scene, double radius) {
  ApertureFields fields(4 * aperture.size(), 2 * views.size());
  for (std::size_t view = 0; view < views.size(); ++view) {
    const RadarBasis& from = views[view].*antenna;
    const std::vector<bool> visible = visible_cells(aperture, from.r, scene, radius);
    for (std::size_t i = 0; i < aperture.size(); ++i) {
      if (!visible[i]) continue;
      const ApertureCell& cell = aperture[i];
      const Complex wave = std::polar(std::sqrt(cell.area), k * from.r.dot(cell.centre));
      for (std::size_t p = 0; p < 2; ++p) {
        const Vec3 E = p == 0 ? from.h : from.v, H = -from.r.cross(E);  // of a wave propagating along -r^
        const Vec3 J = cell.inward.cross(H), M = -cell.inward.cross(E);
        const std::array components{cell.across.dot(J), cell.up.dot(J), cell.across.dot(M), cell.up.dot(M)};
        for (std::size_t c = 0; c < 4; ++c) fields(4 * i + c, 2 * view + p) = wave * components[c];
      }
    }
  }
  return fields;
}

// A current element at a distance R (Harrington, Time-Harmonic Electromagnetic Fields, sec. 2-9), and by duality (3-2)
// a magnetic one, with G = e^{-jkR}/(4 pi R):
//   eta H = grad G x eta J - jk G [a M - b R^ (R^ . M)],   E = -grad G x M - jk G [a eta J - b R^ (R^ . eta J)]
//   grad G = -(1 + jkR) G R^ / R,   a = 1 - j/kR - 1/(kR)^2,   b = 1 - 3j/kR - 3/(kR)^2
WallFields wall_fields(std::span<const ApertureCell> aperture, std::span<const WallPatch> walls, double k,
                       const ApertureFields& fields, int threads, const StopFlag* stop) {
  WallMatrix sources(fields.rows(), fields.columns());
  std::ranges::transform(fields.values(), sources.values().begin(), [](Complex x) { return ComplexFloat(x); });
  WallFields result{WallMatrix(2 * walls.size(), fields.columns()), WallMatrix(2 * walls.size(), fields.columns())};
  const auto fill = [&](std::size_t tile) {
    const std::size_t first = tile * kWallsPerTask, last = std::min(walls.size(), first + kWallsPerTask);
    const RowRange rows{2 * first, 2 * (last - first)};
    // Transposed: one column per patch tangent, with its excitation by every source.
    WallMatrix to_E(sources.rows(), rows.count), to_J(sources.rows(), rows.count);
    for (std::size_t i = first; i < last; ++i) {
      const WallPatch& patch = walls[i];
      for (std::size_t j = 0; j < aperture.size(); ++j) {
        const ApertureCell& cell = aperture[j];
        const Vec3 R = patch.centre - cell.centre;
        const double r = R.norm(), kr = k * r;
        const Vec3 towards = R / r;
        const Complex G = std::sqrt(cell.area) / (4 * kPi * r) * Complex(std::cos(kr), -std::sin(kr));
        const Complex slope = -Complex(1, kr) * G / r;
        const Complex a = Complex(1 - 1 / (kr * kr), -1 / kr), b = Complex(1 - 3 / (kr * kr), -3 / kr),
                      radiated = Complex(0, -k) * G;
        for (std::size_t t = 0; t < 2; ++t) {
          const Vec3& tangent = patch.tangent[t];
          const Vec3 rotated_tangent = tangent.cross(patch.normal);  // tangent . (n x H) = rotated_tangent . H
          const std::size_t column = 2 * (i - first) + t;
          for (std::size_t s = 0; s < 2; ++s) {
            const Vec3& along = s == 0 ? cell.across : cell.up;
            const Vec3 around = towards.cross(along);
            const auto direct = [&](const Vec3& of) {
              return radiated * (a * of.dot(along) - b * of.dot(towards) * towards.dot(along));
            };
            const std::size_t J = 4 * j + s, M = J + 2;
            to_E(J, column) = ComplexFloat(direct(tangent));
            to_E(M, column) = ComplexFloat(-slope * tangent.dot(around));
            to_J(J, column) = ComplexFloat(2.0 * slope * rotated_tangent.dot(around));
            to_J(M, column) = ComplexFloat(2.0 * direct(rotated_tangent));
          }
        }
      }
    }
    const RowRange all{0, sources.rows()};
    add_transposed_product(1, to_E, sources, all, result.incident_electric, rows);
    add_transposed_product(1, to_J, sources, all, result.mfie_excitation, rows);
  };
  parallel_for((walls.size() + kWallsPerTask - 1) / kWallsPerTask, threads, fill, stop);
  return result;
}

}  // namespace seaglint
