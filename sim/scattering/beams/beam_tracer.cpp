// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/beam_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/scattering/beams/beam_culling.h"
#include "sim/scattering/beams/curved_reflection.h"
#include "sim/scattering/diffraction/wedge.h"
#include "sim/scattering/material/reflection.h"

namespace seaglint {
namespace {

class BeamTracer {
 public:
  BeamTracer(const BeamScene& scene, BeamVisitor& visitor)
      : scene_(scene),
        facets_(scene.scatterer.facets()),
        curving_{facets_, scene.scatterer.surface(), scene.transmit},
        tree_(scene.scatterer.tree()),
        basis_(scene.transmit),
        visitor_(visitor),
        scratch_(static_cast<std::size_t>(scene.settings.max_bounces) + 1) {}

  std::size_t legs() const { return legs_; }

  void light(int facet) {
    if (scene_.is_under_water(facet)) return;
    Leg first;
    first.direction = -basis_.r;
    first.E_h = basis_.h;
    first.E_v = basis_.v;
    Candidate candidate;
    candidate.image.facet = facet;
    candidate.image.plane = image_plane(facets_[facet].normal, facets_[facet].offset, basis_);
    candidate.lit.assign(scene_.lit.pieces(facet));
    hand_on(first, candidate, scratch_[0].seen);
    if (goes_on(first, candidate)) follow(reflected(first, candidate), candidate.lit);
  }

 private:
  // Memory of one leg, kept for the next of its bounce.
  struct Scratch {
    std::vector<const TreePanel*> found;
    std::vector<Candidate> met;  // as many as any leg needed so far
    std::vector<Extent> extent;  // of what the window shows of each that was met
    std::vector<std::uint32_t> order;
    std::vector<MovingPolygon> seen;
  };

  // What of the candidate is lit, and what every receiver sees of it; `seen` is memory for that.
  void hand_on(const Leg& leg, const Candidate& candidate, std::vector<MovingPolygon>& seen) {
    visitor_.lit(leg, candidate);
    const Vec3 lit_side = facing(leg, facets_[candidate.image.facet]);
    for (std::size_t i = 0; i < scene_.receivers.size(); ++i) {
      const auto& [antennas, visible] = scene_.receivers[i];
      // What the transmitter lights at first, a receiver at the same place sees.
      if (leg.bounce == 1 && antennas.monostatic) {
        visitor_.seen(leg, candidate, i, candidate.lit.polygons());
        continue;
      }
      seen.clear();
      if (lit_side.dot(antennas.receive.r) > kEdgeOn)
        visible->seen_through(candidate.image.facet, leg.mirrors, candidate.lit.polygons(), basis_, seen);
      visitor_.seen(leg, candidate, i, seen);
    }
  }

  // A panel as the leg meets it; false when it misses the window.
  bool meet(const Leg& leg, const Pieces& window, const TreePanel& panel, Candidate& candidate) const {
    FacetImage& image = candidate.image;
    if (!set_image(image, panel, leg.mirrors, basis_, scene_.min_area)) return false;
    double farthest = 0, nearest = 0;  // beyond the mirror
    for (const Corner& corner : image.polygon) {
      const double beyond = leg.from_plane.at(corner.p) - image.plane.at(corner.p);
      farthest = std::max(farthest, beyond);
      nearest = std::min(nearest, beyond);
    }
    if (farthest < kCoincident) return false;  // it lies in the mirror or behind it
    if (nearest < 0) {
      image.polygon = clip(image.polygon, depth_between(image.plane, leg.from_plane), +1);
      if (image.polygon.empty() || signed_area(image.polygon) < scene_.min_area) return false;
    }
    const Box box = box_of(image.polygon);
    candidate.lit.clear();
    for (std::size_t i = 0; i < window.size(); ++i) {
      if (!overlap(window.boxes()[i], box)) continue;
      MovingPolygon common = intersect(window.polygons()[i], window.boxes()[i], image.polygon);
      if (!common.empty() && signed_area(common) > scene_.min_area) candidate.lit.push_back(std::move(common));
    }
    return !candidate.lit.empty();
  }

  // Lights what the leg reaches inside the window (convex pieces of the aperture).
  void follow(const Leg& leg, const Pieces& window) {
    ++legs_;
    Scratch& scratch = scratch_[leg.bounce];
    const Prism prism = prism_around(window.polygons(), leg, basis_, facets_);
    scratch.found.clear();
    double covered = std::numeric_limits<double>::infinity();
    tree_.walk(prism, [&](const TreePanel& panel) {
      if (panel.facet == leg.from_facet) return covered;
      const Meeting met = meeting(leg, prism, panel);
      if (met.may) scratch.found.push_back(&panel);
      return covered = std::min(covered, met.covered);
    });
    // Of the last leg only what a receiver sees, or an edge, can answer.
    const auto seen = [&](const TreePanel* panel) {
      return std::ranges::any_of(
          scene_.receivers, [&](const Receiver& receiver) { return !receiver.visible->pieces(panel->facet).empty(); });
    };
    if (leg.bounce == scene_.settings.max_bounces && !visitor_.wants(leg) && std::ranges::none_of(scratch.found, seen))
      return;

    std::vector<Candidate>& met = scratch.met;
    std::vector<Extent>& extent = scratch.extent;
    extent.clear();
    for (const TreePanel* panel : scratch.found) {
      if (met.size() == extent.size()) met.emplace_back();
      Candidate& next = met[extent.size()];
      if (meet(leg, window, *panel, next)) extent.push_back(extent_of(next.lit.polygons(), next.image.plane));
    }
    std::vector<std::uint32_t>& order = scratch.order;
    order.resize(extent.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return extent[a].nearest != extent[b].nearest ? extent[a].nearest > extent[b].nearest
                                                    : met[a].image.facet < met[b].image.facet;
    });

    // From the nearest on, each hides from the others what lies behind it. What is hidden in whole hides nothing that
    // its own hiders do not.
    const auto hides = [&](std::uint32_t front, std::uint32_t behind) {
      if (!may_hide(extent[behind], extent[front])) return;
      hide(met[behind].image, extent[behind], met[front].image, extent[front], scene_.min_area, met[behind].lit);
      if (met[behind].lit.empty()) extent[behind] = nowhere();
    };
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) hides(order[j], order[i]);
      for (std::size_t j = 0; j < i; ++j) hides(order[i], order[j]);
    }

    for (const std::uint32_t i : order) {
      const Candidate& candidate = met[i];
      if (candidate.lit.empty() || scene_.is_under_water(candidate.image.facet)) continue;
      hand_on(leg, candidate, scratch.seen);
      if (goes_on(leg, candidate)) follow(reflected(leg, candidate), candidate.lit);
    }
  }

  // The fields after a mirror, where it or one before it is no perfect conductor.
  std::vector<BeamField> reflected_fields(const Leg& leg, int facet, const Vec3& n) const {
    const std::span<const Surface> surface = scene_.surface_of(facet);
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

  // Geometrical optics at a perfect conductor: E' = 2 (n.E) n - E.
  Leg reflected(const Leg& leg, const Candidate& candidate) const {
    const int facet = candidate.image.facet;
    const Vec3 n = facing(leg, facets_[facet]);
    const double offset = n.dot(facets_[facet].corner[0]);
    Leg next;
    next.mirrors = leg.mirrors * plane_mirror(n, offset);
    next.direction = mirrored(leg.direction, n);
    next.E_h = 2 * n.dot(leg.E_h) * n - leg.E_h;
    next.E_v = 2 * n.dot(leg.E_v) * n - leg.E_v;
    if (!leg.fields.empty() || !scene_.surface_of(facet).empty()) next.fields = reflected_fields(leg, facet, n);
    next.from_facet = facet;
    next.from_plane = candidate.image.plane;
    next.from_normal = n;
    next.bounce = leg.bounce + 1;
    next.first_mirror = leg.bounce == 1 ? n : mirrored(leg.first_mirror, n);
    next.before = &leg;
    next.first_facet = leg.bounce == 1 ? facet : leg.first_facet;
    next.bent = leg.bent || curving_.surface.curved(facet);
    next.rays = reflected_rays(curving_, leg, candidate);
    return next;
  }

  // Whether what the candidate reflects is worth following.
  bool goes_on(const Leg& leg, const Candidate& candidate) const {
    if (leg.bounce >= scene_.settings.max_bounces ||
        scene_.settings.filter.is_cavity(facets_[candidate.image.facet].part))
      return false;
    return candidate.lit.area() >= scene_.min_beam_area;
  }

  const BeamScene& scene_;
  std::span<const Facet> facets_;
  Curving curving_;
  const FacetTree& tree_;
  const RadarBasis& basis_;  // of the aperture: the transmitter's
  BeamVisitor& visitor_;
  std::vector<Scratch> scratch_;  // by the bounce a leg ends in
  std::size_t legs_ = 0;
};

}  // namespace

std::size_t trace_beams(const BeamScene& scene, std::span<const int> facets, BeamVisitor& visitor,
                        const std::function<void()>& after_each) {
  BeamTracer tracer(scene, visitor);
  for (const int facet : facets) {
    tracer.light(facet);
    after_each();
  }
  return tracer.legs();
}

}  // namespace seaglint
