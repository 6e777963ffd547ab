// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/illuminate.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "sim/core/error.h"
#include "sim/scattering/visible_part.h"

namespace seaglint {
namespace {

constexpr int kRaysPerTileSide =
    16;  // a tile is one packet wide: coherent, and few facets per tile keep the polygon work linear

// One leg of a beam: what travels from the last mirror (or the radar) towards the next facet.
struct Leg {
  Mirror mirrors;  // of the facets passed
  Vec3 direction;  // real, unit
  Vec3 E_h, E_v;   // field for each transmitted polarisation, real space
  int from_facet = kNoFacet;
  ImagePlane from_plane;            // of the last mirror; unused on the first leg
  Vec3 from_normal = Vec3::Zero();  // real, on the side the beam leaves
  int bounce = 1;                   // of the hits at this leg's end
};

// A facet that a leg may light, in the aperture plane.
struct Candidate {
  int facet = kNoFacet;
  ImagePlane plane;
  MovingPolygon image;
  Box box;
  std::vector<MovingPolygon> lit;
  std::vector<Vec2> rays;  // points of the aperture whose rays reach this facet
};

class TileTracer {
 public:
  TileTracer(const Scatterer& scatterer, const RadarBasis& basis, const IlluminationSettings& settings,
             std::vector<Footprint>& out)
      : facets_(scatterer.facets()),
        scene_(scatterer.rays()),
        basis_(basis),
        settings_(settings),
        out_(out),
        height_(1.01 * scatterer.radius()),
        // Single-precision coordinates are off by 6e-8 of their size; leave five times that between a facet and a ray
        // that starts on it.
        lift_(3e-7 * scatterer.radius()),
        min_area_(1e-9 * scatterer.radius() * scatterer.radius()) {}

  std::size_t rays_traced() const { return rays_traced_; }

  void light(const MovingPolygon& tile, std::vector<Vec2> rays) {
    Leg first;
    first.direction = -basis_.r;
    first.E_h = basis_.h;
    first.E_v = basis_.v;
    follow(first, {tile}, std::move(rays));
  }

 private:
  Vec3 aperture_point(const Vec2& p, double z) const { return p.x() * basis_.h + p.y() * basis_.v + z * basis_.r; }

  Ray ray_at(const Leg& leg, const Vec2& p) const {
    if (leg.bounce == 1) return {aperture_point(p, height_), leg.direction};
    const Vec3 start = leg.mirrors.real(aperture_point(p, leg.from_plane.at(p)));
    return {start + lift_ * leg.from_normal, leg.direction};
  }

  int probe(const Leg& leg, const Vec2& p) {
    ++rays_traced_;
    const int facet = scene_.first_hit(ray_at(leg, p));
    return facet == leg.from_facet ? kNoFacet : facet;
  }

  // The facet's image under the leg's mirrors, cut at the last mirror's plane; false when it is edge-on or behind.
  bool project(const Leg& leg, int facet, Candidate& candidate) const {
    const Facet& f = facets_[facet];
    const Vec3 n_image = leg.mirrors.L * f.normal;
    if (std::abs(n_image.dot(basis_.r)) < 1e-6) return false;
    candidate.facet = facet;
    candidate.plane = image_plane(n_image, n_image.dot(leg.mirrors.image(f.corner[0])), basis_);
    candidate.image.clear();
    for (const Vec3& corner : f.corner) {
      const Vec3 image = leg.mirrors.image(corner);
      const double z = image.dot(basis_.r);
      candidate.image.push_back({Vec2(image.dot(basis_.h), image.dot(basis_.v)), Vec2(-z, 0), Vec2(0, -z)});
    }
    candidate.image = counter_clockwise(std::move(candidate.image));
    if (leg.bounce > 1) {
      const MovingLine beyond = depth_between(candidate.plane, leg.from_plane);
      double farthest = 0;
      for (const Corner& corner : candidate.image) farthest = std::max(farthest, beyond.at(corner.p));
      if (farthest < kCoincident) return false;  // it lies in the mirror
      candidate.image = clip(candidate.image, beyond, +1);
    }
    if (candidate.image.empty() || signed_area(candidate.image) < min_area_) return false;
    candidate.box = box_of(candidate.image);
    return true;
  }

  // What of the candidate's image lies in the window.
  std::vector<MovingPolygon> inside(const Candidate& candidate, const std::vector<MovingPolygon>& window) const {
    std::vector<MovingPolygon> pieces;
    for (const MovingPolygon& piece : window) {
      if (!overlap(box_of(piece), candidate.box)) continue;
      MovingPolygon common = intersect(piece, candidate.image);
      if (signed_area(common) > min_area_) pieces.push_back(std::move(common));
    }
    return pieces;
  }

  // Removes from every candidate what nearer candidates hide.
  void hide(std::vector<Candidate>& candidates, const std::vector<MovingPolygon>& window) const {
    for (Candidate& a : candidates) {
      a.lit = inside(a, window);
      for (const Candidate& b : candidates) {
        if (&a == &b || a.lit.empty() || !overlap(a.box, b.box)) continue;
        const MovingPolygon nearer = nearer_part(b.image, b.plane, b.facet, a.plane, a.facet);
        if (nearer.empty()) continue;
        cut(a.lit, nearer, min_area_);
      }
    }
  }

  // Lights what the leg reaches inside the window (convex pieces of the aperture); rays sample the window.
  void follow(const Leg& leg, const std::vector<MovingPolygon>& window, std::vector<Vec2> rays) {
    std::vector<Candidate> candidates;
    std::unordered_map<int, int> index_of;  // facet -> candidate, -1 when its image does not reach the window
    const auto add = [&](int facet) {
      if (facet == kNoFacet || facet == leg.from_facet) return -1;
      const auto [entry, fresh] = index_of.try_emplace(facet, -1);
      if (fresh) {
        Candidate candidate;
        if (project(leg, facet, candidate)) {
          entry->second = static_cast<int>(candidates.size());
          candidates.push_back(std::move(candidate));
        }
      }
      return entry->second;
    };
    const auto record = [&](const Vec2& p, int facet) {
      const int index = add(facet);
      if (index >= 0) candidates[index].rays.push_back(p);
    };

    // Rays find facets.
    std::vector<Ray> packet(rays.size());
    std::vector<int> hits(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) packet[i] = ray_at(leg, rays[i]);
    scene_.first_hits(packet, hits);
    rays_traced_ += rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) record(rays[i], hits[i]);

    // Topology completes them: a lit facet's neighbour that reaches the window is asked for by a ray of its own, so
    // that facets smaller than the ray spacing are not lost.
    std::unordered_set<int> asked;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      for (const int neighbour : facets_[candidates[i].facet].neighbour) {
        if (neighbour < 0 || index_of.contains(neighbour) || !asked.insert(neighbour).second) continue;
        Candidate candidate;
        if (!project(leg, neighbour, candidate)) continue;
        for (const MovingPolygon& piece : inside(candidate, window)) {
          const Vec2 p = centroid(piece);
          record(p, probe(leg, p));
        }
      }
    }

    // Polygons measure; a ray through each piece confirms it, and what it meets instead joins the candidates.
    constexpr int kRounds = 4;
    std::vector<std::vector<Vec2>> confirmed;
    for (int round = 0; round < kRounds; ++round) {
      hide(candidates, window);
      confirmed.assign(candidates.size(), {});
      const std::size_t known = candidates.size();
      for (std::size_t i = 0; i < known; ++i) {
        std::vector<Vec2> points;  // taken first: candidates may grow below
        for (const MovingPolygon& piece : candidates[i].lit) points.push_back(centroid(piece));
        for (const Vec2& p : points) {
          const int met = add(probe(leg, p));
          if (met < 0) continue;
          // Facets that coincide are one surface: whichever the ray names, the piece is there.
          const double apart = std::abs(candidates[met].plane.at(p) - candidates[i].plane.at(p));
          (apart < kCoincident ? confirmed[i] : candidates[met].rays).push_back(p);
        }
      }
      if (candidates.size() == known) break;
    }

    for (std::size_t i = 0; i < candidates.size(); ++i) {
      Candidate& candidate = candidates[i];
      if (candidate.lit.empty()) continue;
      candidate.rays.insert(candidate.rays.end(), confirmed[i].begin(), confirmed[i].end());
      if (candidate.rays.empty()) continue;
      radiate(leg, candidate);
      if (leg.bounce < settings_.max_bounces)
        follow(reflected(leg, candidate), candidate.lit, std::move(candidate.rays));
    }
  }

  // The facet's unit normal on the side the leg comes from.
  Vec3 facing(const Leg& leg, int facet) const {
    const Vec3& n = facets_[facet].normal;
    return n.dot(leg.direction) < 0 ? n : Vec3(-n);
  }

  // Geometrical optics at a perfect conductor: E' = 2 (n.E) n - E.
  Leg reflected(const Leg& leg, const Candidate& candidate) const {
    const Vec3 n = facing(leg, candidate.facet);
    const double offset = n.dot(facets_[candidate.facet].corner[0]);
    Leg next;
    next.mirrors.L = leg.mirrors.L * (Mat3::Identity() - 2 * n * n.transpose());
    next.mirrors.t = leg.mirrors.L * (2 * offset * n) + leg.mirrors.t;
    next.direction = leg.direction - 2 * n.dot(leg.direction) * n;
    next.E_h = 2 * n.dot(leg.E_h) * n - leg.E_h;
    next.E_v = 2 * n.dot(leg.E_v) * n - leg.E_v;
    next.from_facet = candidate.facet;
    next.from_plane = candidate.plane;
    next.from_normal = n;
    next.bounce = leg.bounce + 1;
    return next;
  }

  // Footprints of what is lit and seen from the radar.
  void radiate(const Leg& leg, const Candidate& candidate) {
    const Facet& facet = facets_[candidate.facet];
    const Vec3 n = facing(leg, candidate.facet);
    if (n.dot(basis_.r) <= 1e-9) return;  // its lit side faces away

    Footprint footprint;
    footprint.plane = candidate.plane;
    footprint.mirrors = leg.mirrors;
    footprint.part = facet.part;
    footprint.bounces = static_cast<std::uint8_t>(leg.bounce);
    set_phase(footprint, leg.mirrors.L * facet.normal, basis_);
    const double grazing = std::abs(n.dot(leg.direction));
    const Vec3 J_h = n.cross(leg.direction.cross(leg.E_h)) / grazing;
    const Vec3 J_v = n.cross(leg.direction.cross(leg.E_v)) / grazing;
    footprint.pattern = {basis_.h.dot(J_h), basis_.h.dot(J_v), basis_.v.dot(J_h), basis_.v.dot(J_v)};

    const std::vector<MovingPolygon> seen = leg.bounce == 1 ? candidate.lit : seen_part(candidate, leg, n);
    for (const MovingPolygon& piece : seen) {
      footprint.polygon = piece;
      out_.push_back(footprint);
    }
  }

  // The lit pieces less the shadows that other facets throw on them as seen from the radar.
  std::vector<MovingPolygon> seen_part(const Candidate& candidate, const Leg& leg, const Vec3& n) {
    const auto blocker = [&](const Vec2& p) {
      ++rays_traced_;
      const Vec3 x = leg.mirrors.real(aperture_point(p, candidate.plane.at(p)));
      const int facet = scene_.first_hit({x + lift_ * n, basis_.r});
      return facet == candidate.facet ? kNoFacet : facet;
    };
    std::vector<MovingPolygon> seen = candidate.lit;
    std::unordered_set<int> blockers;
    const auto remove_shadow = [&](int facet) {
      if (facet == kNoFacet || !blockers.insert(facet).second) return false;
      const MovingPolygon shadow =
          shadow_on(facets_[facet].corner, n, n.dot(facets_[candidate.facet].corner[0]), leg.mirrors, basis_);
      if (!shadow.empty()) cut(seen, shadow, min_area_);
      return true;
    };
    for (const Vec2& p : candidate.rays) remove_shadow(blocker(p));
    // A ray from each remaining piece confirms it; a new blocker throws its shadow and everything is asked again.
    constexpr int kRounds = 64;
    for (int round = 0; round < kRounds; ++round) {
      bool changed = false;
      const std::vector<MovingPolygon> pieces = seen;
      for (const MovingPolygon& piece : pieces) changed = remove_shadow(blocker(centroid(piece))) || changed;
      if (!changed) break;
    }
    return seen;
  }

  std::span<const Facet> facets_;
  const RayScene& scene_;
  const RadarBasis& basis_;
  const IlluminationSettings& settings_;
  std::vector<Footprint>& out_;
  double height_, lift_, min_area_;
  std::size_t rays_traced_ = 0;
};

}  // namespace

Scatterer::Scatterer(const TriangleMesh& mesh) : facets_(make_facets(mesh)), rays_(facets_) {
  if (facets_.empty()) throw InputError("the mesh has no triangle with an area: nothing scatters");
  for (const Facet& facet : facets_) {
    for (const Vec3& corner : facet.corner) radius_ = std::max(radius_, corner.norm());
  }
}

double default_ray_spacing(const Scatterer& scatterer) { return 0.01 * scatterer.radius(); }

Illumination::Illumination(const Scatterer& scatterer, const RadarBasis& basis, const IlluminationSettings& settings)
    : scatterer_(scatterer), basis_(basis), settings_(settings) {
  Vec2 upper = Vec2::Zero();
  bool first = true;
  for (const Facet& facet : scatterer.facets()) {
    for (const Vec3& corner : facet.corner) {
      const Vec2 p(corner.dot(basis.h), corner.dot(basis.v));
      lower_ = first ? p : Vec2(lower_.cwiseMin(p));
      upper = first ? p : Vec2(upper.cwiseMax(p));
      first = false;
    }
  }
  const double spacing = settings.ray_spacing_m > 0 ? settings.ray_spacing_m : default_ray_spacing(scatterer);
  const Vec2 extent = (upper - lower_).cwiseMax(1e-9 * scatterer.radius());
  columns_ = std::max(1, static_cast<int>(std::ceil(extent.x() / (kRaysPerTileSide * spacing))));
  rows_ = std::max(1, static_cast<int>(std::ceil(extent.y() / (kRaysPerTileSide * spacing))));
  tile_size_ = Vec2(extent.x() / columns_, extent.y() / rows_);
  // At least 4 rays each way, however coarse the spacing: a target is never stepped over.
  rays_across_ = std::clamp(static_cast<int>(std::ceil(tile_size_.x() / spacing)), 4, kRaysPerTileSide);
  rays_up_ = std::clamp(static_cast<int>(std::ceil(tile_size_.y() / spacing)), 4, kRaysPerTileSide);
}

std::vector<Footprint> Illumination::light(std::size_t tile, std::size_t* rays) const {
  const int column = static_cast<int>(tile % columns_), row = static_cast<int>(tile / columns_);
  const Vec2 corner = lower_ + Vec2(column * tile_size_.x(), row * tile_size_.y());
  const Vec2 opposite = lower_ + Vec2((column + 1) * tile_size_.x(), (row + 1) * tile_size_.y());
  MovingPolygon window(4);
  window[0].p = corner;
  window[1].p = Vec2(opposite.x(), corner.y());
  window[2].p = opposite;
  window[3].p = Vec2(corner.x(), opposite.y());

  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(rays_across_) * rays_up_);
  for (int j = 0; j < rays_up_; ++j) {
    for (int i = 0; i < rays_across_; ++i) {
      points.push_back(corner + Vec2((i + 0.5) / rays_across_ * tile_size_.x(), (j + 0.5) / rays_up_ * tile_size_.y()));
    }
  }
  std::vector<Footprint> footprints;
  TileTracer tracer(scatterer_, basis_, settings_, footprints);
  tracer.light(window, std::move(points));
  if (rays) *rays += tracer.rays_traced();
  return footprints;
}

}  // namespace seaglint
