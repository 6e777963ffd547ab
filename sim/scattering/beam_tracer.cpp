// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beam_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "sim/scattering/beam_ends.h"
#include "sim/scattering/beam_leg.h"
#include "sim/scattering/beam_window.h"
#include "sim/scattering/bent_beam.h"
#include "sim/scattering/grazed_mirror.h"
#include "sim/scattering/mirrored_rim.h"
#include "sim/scattering/reflect.h"

namespace seaglint {
namespace {

class BeamTracer {
 public:
  BeamTracer(const BeamScene& scene, Lit& out)
      : facets_(scene.scatterer.facets()),
        curving_{facets_, scene.scatterer.surface(), scene.antennas},
        panels_(scene.scatterer.panels()),
        edges_(scene.settings.edges ? &scene.scatterer.edges() : nullptr),
        tree_(scene.scatterer.tree()),
        antennas_(scene.antennas),
        basis_(scene.antennas.transmit),
        lit_(scene.lit),
        visible_(scene.visible),
        surfaces_(scene.surfaces),
        filter_(scene.settings.filter),
        out_(out),
        max_bounces_(scene.settings.max_bounces),
        min_area_(scene.min_area),
        min_beam_area_(scene.min_beam_area),
        radius_(scene.scatterer.radius()),
        scratch_(static_cast<std::size_t>(scene.settings.max_bounces) + 1) {}

  std::size_t legs() const { return legs_; }

  void light(int facet) {
    if (is_under_water(facet)) return;
    Leg first;
    first.direction = -basis_.r;
    first.E_h = basis_.h;
    first.E_v = basis_.v;
    Candidate candidate;
    candidate.image.facet = facet;
    candidate.image.plane = image_plane(facets_[facet].normal, facets_[facet].offset, basis_);
    candidate.lit.assign(lit_.pieces(facet));
    // What the transmitter lights at first, a receiver at the same place sees.
    std::vector<MovingPolygon> seen;
    if (!antennas_.monostatic) seen_part(first, candidate, seen);
    radiate(first, candidate, antennas_.monostatic ? candidate.lit.polygons() : seen);
    if (reaches_edges(first)) reach_edges(first, candidate);
    if (goes_on(first, candidate)) follow(reflected(first, candidate), candidate.lit);
  }

 private:
  // Memory of one leg, kept for the next of its bounce.
  struct Scratch {
    std::vector<int> found;
    std::vector<Candidate> met;  // as many as any leg needed so far
    std::vector<Extent> extent;  // of what the window shows of each that was met
    std::vector<std::uint32_t> order;
    std::vector<MovingPolygon> seen;
  };

  // A facet as the leg meets it; false when it misses the window.
  bool meet(const Leg& leg, const Pieces& window, int facet, Candidate& candidate) const {
    FacetImage& image = candidate.image;
    if (!set_image(image, facets_, panels_, facet, leg.mirrors, basis_, min_area_)) return false;
    double farthest = 0, nearest = 0;  // beyond the mirror
    for (const Corner& corner : image.polygon) {
      const double beyond = leg.from_plane.at(corner.p) - image.plane.at(corner.p);
      farthest = std::max(farthest, beyond);
      nearest = std::min(nearest, beyond);
    }
    if (farthest < kCoincident) return false;  // it lies in the mirror or behind it
    if (nearest < 0) {
      image.polygon = clip(image.polygon, depth_between(image.plane, leg.from_plane), +1);
      if (image.polygon.empty() || signed_area(image.polygon) < min_area_) return false;
    }
    const Box box = box_of(image.polygon);
    candidate.lit.clear();
    for (std::size_t i = 0; i < window.size(); ++i) {
      if (!overlap(window.boxes()[i], box)) continue;
      MovingPolygon common = intersect(window.polygons()[i], image.polygon);
      if (!common.empty() && signed_area(common) > min_area_) candidate.lit.push_back(std::move(common));
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
    bool any_seen = false;
    tree_.walk(prism, [&](const TreePanel& panel) {
      if (panel.facet == leg.from_facet) return covered;
      const Meeting met = meeting(leg, prism, panel);
      if (met.may) {
        scratch.found.push_back(panel.facet);
        any_seen = any_seen || !visible_.pieces(panel.facet).empty();
      }
      return covered = std::min(covered, met.covered);
    });
    // Of the last leg only what the radar sees, or an edge, can answer.
    if (leg.bounce == max_bounces_ && !any_seen && !reaches_edges(leg)) return;

    std::vector<Candidate>& met = scratch.met;
    std::vector<Extent>& extent = scratch.extent;
    extent.clear();
    for (const int facet : scratch.found) {
      if (met.size() == extent.size()) met.emplace_back();
      Candidate& next = met[extent.size()];
      if (meet(leg, window, facet, next)) extent.push_back(extent_of(next.lit.polygons(), next.image.plane));
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
      hide(met[behind].image, extent[behind], met[front].image, extent[front], min_area_, met[behind].lit);
      if (met[behind].lit.empty()) extent[behind] = nowhere();
    };
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) hides(order[j], order[i]);
      for (std::size_t j = 0; j < i; ++j) hides(order[i], order[j]);
    }

    for (const std::uint32_t i : order) {
      const Candidate& candidate = met[i];
      if (candidate.lit.empty() || is_under_water(candidate.image.facet)) continue;
      scratch.seen.clear();
      seen_part(leg, candidate, scratch.seen);
      radiate(leg, candidate, scratch.seen);
      radiate_back(leg, candidate, scratch.seen);
      if (reaches_edges(leg)) reach_edges(leg, candidate);
      if (goes_on(leg, candidate)) follow(reflected(leg, candidate), candidate.lit);
    }
  }

  // What of the lit pieces the radar sees directly.
  void seen_part(const Leg& leg, const Candidate& candidate, std::vector<MovingPolygon>& seen) const {
    if (facing(leg, facets_[candidate.image.facet]).dot(antennas_.receive.r) <= kEdgeOn)
      return;  // its lit side faces away
    visible_.seen_through(candidate.image.facet, leg.mirrors, candidate.lit.polygons(), basis_, seen);
  }

  // What the facet is made of at each wavenumber; none when it is a perfect conductor.
  std::span<const Surface> surface_of(int facet) const {
    return surfaces_.empty() ? std::span<const Surface>()
                             : std::span<const Surface>(surfaces_[facets_[facet].material]);
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
    const Vec3 n = facing(leg, facets_[facet]);
    const double offset = n.dot(facets_[facet].corner[0]);
    Leg next;
    next.mirrors = leg.mirrors * plane_mirror(n, offset);
    next.direction = mirrored(leg.direction, n);
    next.E_h = 2 * n.dot(leg.E_h) * n - leg.E_h;
    next.E_v = 2 * n.dot(leg.E_v) * n - leg.E_v;
    if (!leg.fields.empty() || !surface_of(facet).empty()) next.fields = reflected_fields(leg, facet, n);
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
    if (leg.bounce >= max_bounces_ || filter_.is_cavity(facets_[candidate.image.facet].part)) return false;
    return candidate.lit.area() >= min_beam_area_;
  }

  // With more mirrors before it an edge is not followed.
  bool reaches_edges(const Leg& leg) const { return edges_ && leg.bounce <= kMostEdgeMirrors + 1; }

  // Wedges are perfect conductors, and so is what the wave met before.
  void reach_edges(const Leg& leg, const Candidate& candidate) {
    if (!leg.fields.empty() || !surface_of(candidate.image.facet).empty()) return;
    const WaveOnFacet wave{basis_,  leg.mirrors, candidate.image.plane, leg.direction, leg.E_h,
                           leg.E_v, leg.bounce,  leg.first_mirror};
    find_arrivals(*edges_, candidate.image.facet, wave, candidate.lit.polygons(), out_.arrivals);
  }

  // Perfect conductors, as wedges are, and flat.
  bool has_beam_ends(const Leg& leg, const Footprint& footprint) const {
    return edges_ && leg.bounce > 1 && leg.bounce <= kMostMoved + 1 && !leg.bent && !footprint.curvature &&
           footprint.patterns.empty();
  }

  // The leg's mirrors and the candidate, as the beam meets them.
  using Screens = std::array<Screen, kMostMoved + 1>;
  static Screens screens_of(const Leg& leg, const Candidate& candidate) {
    Screens screens;
    auto place = static_cast<std::size_t>(leg.bounce) - 1;
    screens[place] = {candidate.image.facet, &leg.mirrors, &candidate.image.plane, leg.direction};
    for (const Leg* after = &leg; place > 0; after = after->before)
      screens[--place] = {after->from_facet, &after->mirrors, &after->from_plane, after->before->direction};
    return screens;
  }

  // Footprints of the pieces that are lit and seen.
  void radiate(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> pieces) {
    const Facet& facet = facets_[candidate.image.facet];
    const Vec3 n = facing(leg, facets_[candidate.image.facet]);
    if (pieces.empty() || n.dot(antennas_.receive.r) <= kEdgeOn) return;

    Footprint footprint;
    footprint.plane = candidate.image.plane;
    footprint.mirrors = leg.mirrors;
    footprint.facet = candidate.image.facet;
    footprint.part = facet.part;
    footprint.facet_size = panels_.size(candidate.image.facet);
    footprint.bounces = static_cast<std::uint8_t>(leg.bounce);
    set_phase(footprint, leg.mirrors.L * facet.normal, antennas_);
    footprint.pattern = conductor_pattern(leg, n, std::abs(n.dot(leg.direction)), antennas_.receive);
    if (!leg.fields.empty() || !surface_of(footprint.facet).empty()) {
      footprint.patterns = patterns(leg, footprint.facet, n);
      footprint.pattern = footprint.patterns[footprint.patterns.size() / 2];
    }
    footprint.curvature = curvature_of(curving_, leg, candidate, footprint);
    Screens screens;
    std::optional<BeamEnds> ends;
    if (has_beam_ends(leg, footprint)) {
      screens = screens_of(leg, candidate);
      ends.emplace(*edges_, panels_, antennas_,
                   std::span<const Screen>(screens.data(), static_cast<std::size_t>(leg.bounce)));
    }
    const double share = leaves_grazing(leg, footprint.facet) ? share_of_way(leg, footprint.facet) : 1.0;
    // with the ends of its beams; where less is left they have faded out as much (rim_share)
    if (share > 1) give_share(share, footprint);
    for (const MovingPolygon& piece : pieces) {
      footprint.polygon = piece;
      limit_slip(footprint, 2 * radius_);
      if (ends) ends->find(footprint, out_.beam_ends);
      if (share <= 0) continue;
      out_.footprints.push_back(footprint);
      if (share < 1) give_share(share, out_.footprints.back());
    }
  }

  GrazedMirror mirror_of(int facet) const { return {facets_[facet].normal, panels_.outline(facet)}; }

  double share_of_way(const Leg& leg, int last) const {
    if (leg.bounce == 1) return 1;
    const GrazedMirror first = mirror_of(leg.first_facet);
    return leg.bounce > 2 ? share_of_more(basis_.r, first, mirror_of(leg.from_facet), mirror_of(last))
                          : share_of_two(basis_.r, first, mirror_of(last));
  }

  // Whether mirrors that are grazed leave their echo to other ways; without edges the last one has all of it, as usual.
  // Flat perfect conductors, and none that are followed by other means.
  bool leaves_grazing(const Leg& leg, int facet) const {
    return edges_ && antennas_.monostatic && !leg.bent && !curving_.surface.curved(facet) && leg.fields.empty() &&
           surface_of(facet).empty() && !filter_.is_cavity(facets_[facet].part);
  }

  // Footprints of what leaves by the mirror that it came by first, where that is grazed: of the facet's image in it,
  // lit and seen directly. `seen`: pieces of the facet that the radar sees.
  void radiate_back(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> seen) {
    const int facet = candidate.image.facet;
    if (leg.bounce < 2 || leg.bounce >= max_bounces_ || !leaves_grazing(leg, facet)) return;
    const double share = share_by_image(basis_.r, mirror_of(leg.first_facet), mirror_of(facet));
    if (share <= 0) return;
    const Facet& mirror = facets_[leg.first_facet];
    const Mirror by = plane_mirror(mirror.normal, mirror.offset);
    const Vec3 lit_side = facing(leg, facets_[facet]), n = by.L * lit_side;
    if (n.dot(basis_.r) <= kEdgeOn) return;
    // A perfect conductor's image has the field along it turned round.
    Leg image;
    image.direction = by.L * leg.direction;
    image.E_h = -by.L * leg.E_h;
    image.E_v = -by.L * leg.E_v;
    Footprint footprint;
    footprint.plane = candidate.image.plane;
    footprint.mirrors = leg.mirrors * by;
    footprint.facet = facet;
    footprint.part = facets_[facet].part;
    footprint.facet_size = panels_.size(facet);
    footprint.bounces = static_cast<std::uint8_t>(leg.bounce + 1);
    set_phase(footprint, leg.mirrors.L * lit_side, antennas_);
    footprint.pattern = conductor_pattern(image, n, std::abs(n.dot(image.direction)), basis_);
    give_share(share, footprint);
    // What the mirror lights at first, a receiver at the same place sees by it.
    std::vector<MovingPolygon> by_mirror;
    if (leg.bounce > 2) visible_.seen_by(leg.first_facet, facet, footprint.mirrors, seen, basis_, by_mirror);
    for (const MovingPolygon& piece :
         leg.bounce > 2 ? std::span<const MovingPolygon>(by_mirror) : candidate.lit.polygons()) {
      footprint.polygon = piece;
      limit_slip(footprint, 2 * radius_);
      out_.footprints.push_back(footprint);
    }
  }

  std::span<const Facet> facets_;
  Curving curving_;
  const Panels& panels_;
  const SharpEdges* edges_;  // null when nobody asks for edges
  const FacetTree& tree_;
  const AntennaPair& antennas_;
  const RadarBasis& basis_;  // of the aperture: the transmitter's
  const VisibleSurface& lit_;
  const VisibleSurface& visible_;  // to the receiver
  std::span<const std::vector<Surface>> surfaces_;
  const EchoFilter& filter_;
  Lit& out_;
  int max_bounces_;
  double min_area_, min_beam_area_;
  double radius_;                 // of the whole body
  std::vector<Scratch> scratch_;  // by the bounce a leg ends in
  std::size_t legs_ = 0;
};

}  // namespace

std::size_t trace_beams(const BeamScene& scene, std::span<const int> facets, Lit& out,
                        const std::function<void()>& after_each) {
  BeamTracer tracer(scene, out);
  for (const int facet : facets) {
    tracer.light(facet);
    after_each();
  }
  return tracer.legs();
}

}  // namespace seaglint
