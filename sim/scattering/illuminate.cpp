// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/illuminate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/error.h"
#include "sim/scattering/reflect.h"

namespace seaglint {
namespace {

// One leg of a beam: what travels from the last mirror towards the next facet.
struct Leg {
  Mirror mirrors;                   // of the facets passed
  Vec3 direction;                   // real, unit
  Vec3 E_h, E_v;                    // field for each transmitted polarisation, real space, all mirrors perfect conductors
  std::vector<BeamField> fields;    // the field per wavenumber once a mirror was of another material
  int from_facet = kNoFacet;
  ImagePlane from_plane;            // of the last mirror
  Vec3 from_normal = Vec3::Zero();  // real, on the side the beam leaves
  int bounce = 1;                   // of the hits at this leg's end
};

// A facet that a leg may light, and what of it is lit as far as is known.
struct Candidate {
  FacetImage image;
  std::vector<MovingPolygon> lit;
  bool asked = false;     // every piece has been confirmed by a ray since it was last cut
  bool extended = false;  // its neighbours have been added
};

class BeamTracer {
 public:
  BeamTracer(const Scatterer& scatterer, const AntennaPair& antennas, const IlluminationSettings& settings, const VisibleSurface& lit,
             const VisibleSurface& visible, std::span<const std::vector<Surface>> surfaces, double min_area, std::vector<Footprint>& out)
      : facets_(scatterer.facets()),
        scene_(scatterer.rays()),
        antennas_(antennas),
        basis_(antennas.transmit),
        lit_(lit),
        visible_(visible),
        surfaces_(surfaces),
        out_(out),
        max_bounces_(settings.max_bounces),
        spacing_(settings.ray_spacing_m > 0 ? settings.ray_spacing_m : default_ray_spacing(scatterer)),
        // Single-precision coordinates are off by 6e-8 of their size; leave five times that between a facet and a ray that starts on it.
        lift_(3e-7 * scatterer.radius()),
        min_area_(min_area) {}

  std::size_t rays_traced() const { return rays_traced_; }

  void light(int facet) {
    if (is_under_water(facet)) return;
    Leg first;
    first.direction = -basis_.r;
    first.E_h = basis_.h;
    first.E_v = basis_.v;
    Candidate candidate;
    candidate.image.facet = facet;
    candidate.image.plane = image_plane(facets_[facet].normal, facets_[facet].offset, basis_);
    candidate.lit.assign(lit_.pieces(facet).begin(), lit_.pieces(facet).end());
    // What the transmitter lights at first, a receiver at the same place sees.
    radiate(first, candidate, antennas_.monostatic ? candidate.lit : seen_part(first, candidate));
    if (max_bounces_ > 1) follow(reflected(first, candidate), candidate.lit);
  }

 private:
  Vec3 aperture_point(const Vec2& p, double z) const { return p.x() * basis_.h + p.y() * basis_.v + z * basis_.r; }

  Ray ray_at(const Leg& leg, const Vec2& p) const {
    const Vec3 start = leg.mirrors.real(aperture_point(p, leg.from_plane.at(p)));
    return {start + lift_ * leg.from_normal, leg.direction};
  }

  // Points that sample a piece of the aperture: a lattice common to all pieces, the centroid, and one point just inside each corner, where what a
  // beam lights only in part begins.
  void sample(const MovingPolygon& piece, std::vector<Vec2>& points) const {
    const Vec2 c = centroid(piece);
    points.push_back(c);
    for (const Corner& corner : piece) points.push_back(corner.p + 0.02 * (c - corner.p));
    const Box box = box_of(piece);
    const auto first = [this](double x) { return std::ceil(x / spacing_) * spacing_; };
    for (double y = first(box.lower.y()); y <= box.upper.y(); y += spacing_) {
      for (double x = first(box.lower.x()); x <= box.upper.x(); x += spacing_) {
        const Vec2 p(x, y);
        const auto right_of = [&](std::size_t i) {
          const Vec2 a = piece[i].p, along = piece[(i + 1) % piece.size()].p - a;
          return along.x() * (y - a.y()) - along.y() * (x - a.x()) < 0;
        };
        bool within = true;
        for (std::size_t i = 0; within && i < piece.size(); ++i) within = !right_of(i);
        if (within) points.push_back(p);
      }
    }
  }

  // The facets that a leg may light inside its window, resolved against each other as they come.
  class Candidates {
   public:
    Candidates(const BeamTracer& tracer, const Leg& leg, std::span<const MovingPolygon> window)
        : tracer_(tracer), leg_(leg), window_(window) {
      met_.push_back(kNoFacet);
      met_.push_back(leg.from_facet);
    }

    std::vector<Candidate>& all() { return all_; }

    void add(int facet) {
      // A beam meets a few tens of facets: looking through them is faster than hashing.
      if (std::find(met_.begin(), met_.end(), facet) != met_.end()) return;
      met_.push_back(facet);
      // The lit side of a closed part faces the beam.
      const Facet& f = tracer_.facets_[facet];
      if (!f.open && f.normal.dot(leg_.direction) >= 0) return;
      auto image = facet_image(tracer_.facets_, facet, leg_.mirrors, tracer_.basis_, tracer_.min_area_);
      if (!image) return;
      const MovingLine beyond = depth_between(image->plane, leg_.from_plane);
      double farthest = 0;
      for (const Corner& corner : image->polygon) farthest = std::max(farthest, beyond.at(corner.p));
      if (farthest < kCoincident) return;  // it lies in the mirror or behind it
      image->polygon = clip(image->polygon, beyond, +1);
      if (image->polygon.empty() || signed_area(image->polygon) < tracer_.min_area_) return;
      image->box = box_of(image->polygon);

      Candidate fresh;
      fresh.image = std::move(*image);
      fresh.lit = inside(fresh.image, window_, tracer_.min_area_);
      if (fresh.lit.empty()) return;
      for (Candidate& other : all_) {
        if (!overlap(other.image.box, fresh.image.box)) continue;
        if (!fresh.lit.empty()) {
          const MovingPolygon hole = nearer_part(other.image, fresh.image);
          if (!hole.empty()) cut(fresh.lit, hole, tracer_.min_area_);
        }
        if (!other.lit.empty()) {
          const MovingPolygon hole = nearer_part(fresh.image, other.image);
          if (!hole.empty() && cut(other.lit, hole, tracer_.min_area_)) other.asked = false;
        }
      }
      all_.push_back(std::move(fresh));
    }

   private:
    const BeamTracer& tracer_;
    const Leg& leg_;
    std::span<const MovingPolygon> window_;
    std::vector<Candidate> all_;
    std::vector<int> met_;
  };

  // Lights what the leg reaches inside the window (convex pieces of the aperture).
  void follow(const Leg& leg, std::span<const MovingPolygon> window) {
    // Rays find facets.
    std::vector<Vec2> points;
    for (const MovingPolygon& piece : window) sample(piece, points);
    std::vector<Ray> rays(points.size());
    std::vector<int> hits(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) rays[i] = ray_at(leg, points[i]);
    scene_.first_hits(rays, hits);
    rays_traced_ += rays.size();
    Candidates candidates(*this, leg, window);
    for (const int facet : hits) candidates.add(facet);

    // Topology completes them: the neighbours of what is lit are candidates too. A ray through each lit piece confirms it; what it meets instead
    // joins. This ends because a facet joins once.
    std::vector<Candidate>& all = candidates.all();
    for (bool grown = true; grown;) {
      const std::size_t known = all.size();
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].lit.empty() || all[i].extended) continue;
        all[i].extended = true;
        for (const int neighbour : facets_[all[i].image.facet].neighbour) candidates.add(neighbour);
      }
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].asked) continue;
        all[i].asked = true;
        std::vector<Vec2> centres;  // taken first: pieces may be cut below
        for (const MovingPolygon& piece : all[i].lit) centres.push_back(centroid(piece));
        for (const Vec2& p : centres) {
          ++rays_traced_;
          candidates.add(scene_.first_hit(ray_at(leg, p)));
        }
      }
      grown = all.size() > known;
    }

    for (const Candidate& candidate : all) {
      if (candidate.lit.empty() || is_under_water(candidate.image.facet)) continue;
      radiate(leg, candidate, seen_part(leg, candidate));
      if (leg.bounce < max_bounces_) follow(reflected(leg, candidate), candidate.lit);
    }
  }

  // What of the lit pieces the radar sees directly.
  std::vector<MovingPolygon> seen_part(const Leg& leg, const Candidate& candidate) const {
    std::vector<MovingPolygon> seen;
    for (const MovingPolygon& piece : candidate.lit) {
      visible_.seen_through(candidate.image.facet, leg.mirrors, candidate.image.plane, piece, basis_, seen);
    }
    return seen;
  }

  // The facet's unit normal on the side the leg comes from.
  Vec3 facing(const Leg& leg, int facet) const {
    const Vec3& n = facets_[facet].normal;
    return n.dot(leg.direction) < 0 ? n : Vec3(-n);
  }

  // What the facet is made of at each wavenumber; none when it is a perfect conductor.
  std::span<const Surface> surface_of(int facet) const {
    return surfaces_.empty() ? std::span<const Surface>() : std::span<const Surface>(surfaces_[facets_[facet].material]);
  }
  bool is_under_water(int facet) const {
    const std::span<const Surface> surface = surface_of(facet);
    return !surface.empty() && surface.front().is_under_water();
  }

  // The leg's field at wavenumber number q.
  static BeamField field_at(const Leg& leg, std::size_t q) {
    return leg.fields.empty() ? BeamField{leg.E_h.cast<Complex>(), leg.E_v.cast<Complex>()} : leg.fields[q];
  }

  // The fields after a mirror, where it or one before it is no perfect conductor.
  std::vector<BeamField> reflected_fields(const Leg& leg, int facet, const Vec3& n) const {
    const std::span<const Surface> surface = surface_of(facet);
    const double cosine = std::abs(n.dot(leg.direction));
    std::vector<BeamField> fields(surface.empty() ? leg.fields.size() : surface.size());
    for (std::size_t q = 0; q < fields.size(); ++q) {
      const SurfaceFields at = surface.empty() ? SurfaceFields{} : surface[q].at(cosine);
      const double coherence = surface.empty() ? 1.0 : surface[q].coherence(cosine, cosine);
      const BeamField before = field_at(leg, q);
      fields[q] = {coherence * reflected_field(at, leg.direction, n, before.h),
                   coherence * reflected_field(at, leg.direction, n, before.v)};
    }
    return fields;
  }

  // The footprint's pattern per wavenumber, where the facet or a mirror before it is no perfect conductor.
  std::vector<std::array<Complex, 4>> patterns(const Leg& leg, int facet, const Vec3& n) const {
    const std::span<const Surface> surface = surface_of(facet);
    const auto& [r, h, v] = antennas_.receive;
    const double cosine = std::abs(n.dot(leg.direction));
    std::vector<std::array<Complex, 4>> patterns(surface.empty() ? leg.fields.size() : surface.size());
    for (std::size_t q = 0; q < patterns.size(); ++q) {
      const SurfaceFields at = surface.empty() ? SurfaceFields{} : surface[q].at(cosine);
      const double coherence = surface.empty() ? 1.0 : surface[q].coherence(cosine, n.dot(r));
      const BeamField field = field_at(leg, q);
      const CVec3 by_h = coherence * radiated_field(at, leg.direction, n, r, field.h),
                  by_v = coherence * radiated_field(at, leg.direction, n, r, field.v);
      patterns[q] = {along(h, by_h), along(h, by_v), along(v, by_h), along(v, by_v)};
    }
    return patterns;
  }

  // Geometrical optics at a perfect conductor: E' = 2 (n.E) n - E.
  Leg reflected(const Leg& leg, const Candidate& candidate) const {
    const int facet = candidate.image.facet;
    const Vec3 n = facing(leg, facet);
    const double offset = n.dot(facets_[facet].corner[0]);
    Leg next;
    next.mirrors.L = leg.mirrors.L * (Mat3::Identity() - 2 * n * n.transpose());
    next.mirrors.t = leg.mirrors.L * (2 * offset * n) + leg.mirrors.t;
    next.direction = leg.direction - 2 * n.dot(leg.direction) * n;
    next.E_h = 2 * n.dot(leg.E_h) * n - leg.E_h;
    next.E_v = 2 * n.dot(leg.E_v) * n - leg.E_v;
    if (!leg.fields.empty() || !surface_of(facet).empty()) next.fields = reflected_fields(leg, facet, n);
    next.from_facet = facet;
    next.from_plane = candidate.image.plane;
    next.from_normal = n;
    next.bounce = leg.bounce + 1;
    return next;
  }

  // Footprints of the pieces that are lit and seen.
  void radiate(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> pieces) {
    const Facet& facet = facets_[candidate.image.facet];
    const Vec3 n = facing(leg, candidate.image.facet);
    if (pieces.empty() || n.dot(antennas_.receive.r) <= 1e-9) return;  // hidden, or its lit side faces away

    Footprint footprint;
    footprint.plane = candidate.image.plane;
    footprint.mirrors = leg.mirrors;
    footprint.facet = candidate.image.facet;
    footprint.part = facet.part;
    footprint.facet_size = facet.size;
    footprint.bounces = static_cast<std::uint8_t>(leg.bounce);
    set_phase(footprint, leg.mirrors.L * facet.normal, antennas_);
    const double grazing = std::abs(n.dot(leg.direction));
    const Vec3 J_h = n.cross(leg.direction.cross(leg.E_h)) / grazing;
    const Vec3 J_v = n.cross(leg.direction.cross(leg.E_v)) / grazing;
    const auto& [r, h, v] = antennas_.receive;
    footprint.pattern = {h.dot(J_h), h.dot(J_v), v.dot(J_h), v.dot(J_v)};
    if (!leg.fields.empty() || !surface_of(footprint.facet).empty()) {
      footprint.patterns = patterns(leg, footprint.facet, n);
      footprint.pattern = footprint.patterns.front();
    }
    for (const MovingPolygon& piece : pieces) {
      footprint.polygon = piece;
      out_.push_back(footprint);
    }
  }

  std::span<const Facet> facets_;
  const RayScene& scene_;
  const AntennaPair& antennas_;
  const RadarBasis& basis_;  // of the aperture: the transmitter's
  const VisibleSurface& lit_;
  const VisibleSurface& visible_;  // to the receiver
  std::span<const std::vector<Surface>> surfaces_;
  std::vector<Footprint>& out_;
  int max_bounces_;
  double spacing_, lift_, min_area_;
  std::size_t rays_traced_ = 0;
};

}  // namespace

Scatterer::Scatterer(const TriangleMesh& mesh, std::vector<MaterialSpec> materials)
    : facets_(make_facets(mesh)), rays_(facets_), materials_(std::move(materials)) {
  for (const Facet& facet : facets_) {
    SEAGLINT_CHECK(materials_.empty() || facet.material < materials_.size(),
                   fmt::format("material {} of {}", facet.material, materials_.size()));
  }
  if (facets_.empty()) throw InputError("the mesh has no triangle with an area: nothing scatters");
  for (const Facet& facet : facets_) {
    for (const Vec3& corner : facet.corner) radius_ = std::max(radius_, corner.norm());
  }
}

double default_ray_spacing(const Scatterer& scatterer) { return std::min(0.1, 0.04 * scatterer.radius()); }

Illumination::Illumination(const Scatterer& scatterer, const AntennaPair& antennas, const IlluminationSettings& settings, int threads,
                           std::span<const double> wavenumbers)
    : scatterer_(scatterer),
      antennas_(antennas),
      settings_(settings),
      min_area_(2e-9 * scatterer.radius() * scatterer.radius()),
      lit_(scatterer.facets(), antennas.transmit, min_area_, threads) {
  if (!antennas.monostatic) seen_from_receiver_.emplace(scatterer.facets(), antennas.receive, min_area_, threads);
  for (int facet = 0; facet < static_cast<int>(scatterer.facets().size()); ++facet) {
    if (!lit_.pieces(facet).empty()) seen_.push_back(facet);
  }
  for (const MaterialSpec& material : scatterer.materials()) {
    std::vector<Surface>& surface = surfaces_.emplace_back();
    if (material.kind == SurfaceKind::kPec && material.roughness_mm == 0) continue;
    SEAGLINT_CHECK(!wavenumbers.empty(), "the material " + material.name + " needs a wavenumber");
    for (const double k : wavenumbers) surface.emplace_back(material, k);
  }
}

std::size_t Illumination::light(int facet, std::vector<Footprint>& footprints) const {
  const VisibleSurface& visible = seen_from_receiver_ ? *seen_from_receiver_ : lit_;
  BeamTracer tracer(scatterer_, antennas_, settings_, lit_, visible, surfaces_, min_area_, footprints);
  tracer.light(facet);
  return tracer.rays_traced();
}

}  // namespace seaglint
