// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Smooth surfaces that a mesh samples: sides across which the target is smooth, vertex normals between creases, height
// above the facets, curvature; the same with no more facets than the curvature requires, so that the cost of a view
// does not follow the fineness of the mesh.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/geometry/surface/facets.h"

namespace seaglint {

// Facet that continues a facet smoothly across each of its sides; -1 where the side is a knuckle, an edge or free.
using SmoothSides = std::vector<std::array<std::int32_t, 3>>;

// Sides where exactly two facets of one orientation meet and their normals differ by less than the crease angle,
// 0 <= crease <= pi rad; none for 0.
SmoothSides smooth_sides_by_angle(std::span<const Facet> facets, double crease);

// The same sides, but those only where the facets are samples of one curved surface: on a line square to the side the
// turn goes on at the distance of the facets' own size, on one side at least, and most sides nearby do so (README.md,
// "Smooth surface").
SmoothSides smooth_sides_by_shape(std::span<const Facet> facets, double crease);

// Sides of the same kind where the corner normals of both facets are given and agree.
SmoothSides smooth_sides_by_normals(std::span<const Facet> facets);

// True where the corner normals of a mesh describe a smooth surface: some are off their triangles' own, so that they do
// not repeat the facets, and none by more than kMaxNormalDeviation but for a hundredth of the area, so that they are
// not the shading of a box.
inline constexpr double kMaxNormalDeviation = 0.53;  // rad: 30 deg, a cylinder of six sides, and the digits of normals
bool normals_describe_surface(const TriangleMesh& mesh);

// Default crease angle. On fairings and hulls adjacent facets turn by less than 15 deg, on the sides of modelled pipes
// and masts (16 sides and fewer), knuckles and box edges by 22 deg and more.
inline constexpr double kDefaultCreaseDeg = 20;

// Vertex of one smooth fan of facets; a vertex on a sharp edge occurs once for each side.
struct SmoothVertex {
  Vec3 normal = Vec3::UnitZ();
  Mat3 curvature = Mat3::Zero();      // second fundamental form, 1/m: t . curvature t is the normal curvature along the
                                      // unit tangent t, convex > 0
  std::int32_t first = 0, count = 0;  // its facets in fan_
};

// Facet of a curved surface.
struct CurvedFacet {
  std::array<std::int32_t, 3> vertex{};
  std::array<double, 3> sagitta{};  // height of the surface over the midpoint of side corner[i] -> corner[i+1], along
                                    // the mean of its two vertex normals, m
};

class SmoothSurface {
 public:
  // Facets over which the surface rises by less than `negligible` (m) stay flat. The facets must outlive the surface.
  SmoothSurface(std::span<const Facet> facets, const SmoothSides& smooth, double negligible);

  // Null for a flat facet.
  const CurvedFacet* curved(int facet) const {
    return index_[facet] < 0 ? nullptr : &curved_[static_cast<std::size_t>(index_[facet])];
  }
  const SmoothVertex& vertex(int i) const { return vertices_[static_cast<std::size_t>(i)]; }
  std::size_t curved_count() const { return curved_.size(); }

  // Distance of a vertex from the shadow boundary of a wave from `direction` (unit, towards its source) on the
  // illuminated side: sin(elevation over the surface) / kappa^(1/3), m^(1/3), kappa the normal curvature along the ray.
  // Zero where a facet of the vertex's fan faces away, infinite where the surface does not curve away. side: +1, or -1
  // for the back of a sheet.
  double shadow_boundary_distance(int vertex, const Vec3& direction, double side) const;

 private:
  std::vector<std::int32_t> index_;  // index into curved_; -1: flat
  std::vector<CurvedFacet> curved_;
  std::vector<SmoothVertex> vertices_;
  std::vector<std::int32_t> fan_;  // facets by vertex
  std::span<const Facet> facets_;
};

// Vertices of the smooth surfaces that a mesh samples. A vertex belongs to one smooth fan of facets; one on a sharp
// edge occurs once for each side.
struct SmoothVertices {
  std::vector<std::array<std::int32_t, 3>> of_facet;  // vertices at the corners
  std::vector<Vec3> normal;                           // unit
  std::vector<std::int32_t> first, fan;               // facets of vertex i: fan[first[i] .. first[i + 1])
  // Of every facet, m: width of its planar face, sqrt(12 times the least second moment of its area / area), the smaller
  // side of a rectangle; of a facet of no known face, its height over the longest side.
  std::vector<double> facet_width;
};

// The normal is that of the file where one is given, else the mean over the fan by corner_weight(): with the weights
// for similar widths where the largest width is at most twice the smallest, with the others from three times on, with a
// smooth transition between.
SmoothVertices smooth_vertices(std::span<const Facet> facets, const SmoothSides& smooth);

// Weight of a facet at one of its corners, corner_weight().
double facet_weight(const Facet& facet, int corner, double width, bool alike);

struct MergedFacets {
  std::vector<Facet> facets;
  SmoothSides smooth;
};

// Angle between a merged facet and the normals of the surface at its corners, at most: a circle keeps 120 sides. It
// limits the error of paths that go on from a curved reflector to another panel: an ellipsoid over a plate changes by
// -34 dB of the echo, with 0.0524 by -17 dB; its own echo by less than -50 dB with either.
inline constexpr double kMaxFacetTilt = 0.0262;  // rad, 1.5 deg

// The same surface without vertices inside smooth surfaces that larger curved facets (SmoothSurface) replace: every
// removed vertex lies within `tolerance` (m) of the facet that replaces it, measured from the height of the surface
// over it, and no merged facet is tilted by more than kMaxFacetTilt. Vertices on sides that are not smooth stay. Merged
// facets carry the normals of the fine mesh at their corners. Half-edge collapse with its link condition (H. Hoppe et
// al., Proc. SIGGRAPH 1993, 19-26).
MergedFacets merge_smooth_facets(std::vector<Facet> facets, SmoothSides smooth, double tolerance);

}  // namespace seaglint
