// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/beam_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/geometry/look_basis.h"
#include "sim/scattering/radiation/edge_diffraction.h"

namespace seaglint {

namespace {

constexpr double kShallow = 1e-4;  // m, of a panel in edge-on view

Vec3 normal_of(const DepthPlane& plane, const RadarBasis& basis) {
  return (basis.r - plane.slope.x() * basis.h - plane.slope.y() * basis.v).normalized();
}

// Maps real points to the projection plane.
struct ProjectionMap {
  Vec3 h, v;
  Vec2 shift;

  ProjectionMap(const RadarBasis& transmit, const ImageTransform& image_transform)
      : h(image_transform.L.transpose() * transmit.h),
        v(image_transform.L.transpose() * transmit.v),
        shift(image_transform.t.dot(transmit.h), image_transform.t.dot(transmit.v)) {}
  Vec2 operator()(const Vec3& x) const { return Vec2(h.dot(x), v.dot(x)) + shift; }
};

}  // namespace

std::vector<Vec2> projected_outline(const Panels& panels, const RadarBasis& transmit, const PathPanel& panel) {
  const ProjectionMap into(transmit, *panel.image_transform);
  const std::span<const Vec3> real = panels.outline(panel.facet);
  std::vector<Vec2> outline(real.size());
  std::ranges::transform(real, outline.begin(), into);
  return outline;
}

std::vector<BeamEdge> beam_edges(const SharpEdges& edges, const Panels& panels, const RadarBasis& transmit,
                                 std::span<const PathPanel> panels_on_path) {
  std::vector<BeamEdge> found;
  found.reserve(4 * panels_on_path.size());
  for (std::size_t i = 0; i < panels_on_path.size(); ++i) {
    const PathPanel& panel = panels_on_path[i];
    const ProjectionMap into(transmit, *panel.image_transform);
    const Vec3 n = panel.image_transform->L.transpose() * normal_of(*panel.plane, transmit);
    std::vector<Vec2> outline;
    for (const PanelEdge& side : edges.edges_of_panel(panel.facet)) {
      const SharpEdge& edge = edges.edges[side.edge];
      if (!edge.conducts) continue;
      const WedgeFrame* wedge = wedge_on_illuminated_face(edge, side.is_first_face, panel.direction);
      if (!wedge || wedge->N <= 1) continue;
      if (outline.empty()) outline = projected_outline(panels, transmit, panel);
      const Vec2 a = into(edge.a), b = into(edge.b), along = (b - a).normalized();
      Vec2 middle = Vec2::Zero();
      double depth = 0;
      for (const Vec2& p : outline) {
        middle += p / static_cast<double>(outline.size());
        depth = std::max(depth, std::abs(along.x() * (p - a).y() - along.y() * (p - a).x()));
      }
      if (depth > kShallow) found.push_back({i, a, b, middle, into(edge.a + n.cross(edge.along())) - a, depth});
    }
  }
  return found;
}

SideFrame::SideFrame(const MovingVertex& start, const MovingVertex& end)
    : from(start),
      to(end),
      length((end.p - start.p).norm()),
      along((end.p - start.p) / length),
      across(-along.y(), along.x()) {}

bool SideFrame::lies_on(const BeamEdge& edge) const {
  return std::abs(x(edge.a)) <= kCoincident && std::abs(x(edge.b)) <= kCoincident && x(edge.interior_point) > 0;
}

DiffractedPaths::DiffractedPaths(const BistaticGeometry& geometry, std::span<const PathPanel> panels_on_path,
                                 const Footprint& footprint)
    : geometry_(geometry),
      basis_(geometry.transmit),
      panels_on_path_(panels_on_path),
      footprint_(footprint),
      normal_(normal_of(footprint.plane, basis_)),
      before_(reflect_direction(footprint.image_transform.L * geometry.receive.r, normal_)) {}

DiffractedPaths::DiffractedPath DiffractedPaths::diffracted_path(std::size_t panel_index, const Vec2& p) const {
  const Vec3 X = at(panel_index, p), beyond = X - 2 * normal_.dot(X - footprint_.plane.z0 * basis_.r) * normal_;
  const Vec3 Y = footprint_.image_transform.real(beyond);
  return {X, Y, basis_.r.dot(X) + geometry_.receive.r.dot(Y)};
}

Vec2 DiffractedPaths::landing_point(std::size_t panel_index, const Vec2& p) const {
  const Vec3 X = at(panel_index, p),
             landed = X - normal_.dot(X - footprint_.plane.z0 * basis_.r) / normal_.dot(before_) * before_;
  return {landed.dot(basis_.h), landed.dot(basis_.v)};
}

Vec2 DiffractedPaths::exit_in_plane(const Vec2& direction) const {
  return Vec2(-before_.dot(basis_.r), before_.dot(direction.x() * basis_.h + direction.y() * basis_.v)).normalized();
}

DiffractedPaths::EdgeWeight DiffractedPaths::edge_weight(const BeamEdge& edge, double slope) const {
  const PathPanel& reflector = panels_on_path_[edge.panel_index];
  // In real space at the edge: exit direction, normals of its face and of the last panel, and the direction of the
  // edge.
  const Mat3 real = reflector.image_transform->L.transpose();
  const Vec3 s = real * before_, last = real * normal_;
  Vec3 n = real * normal_of(*reflector.plane, basis_);
  if (n.dot(reflector.direction) > 0) n = -n;
  const Vec2 run = (edge.b - edge.a).normalized();
  const Vec3 along =
      real * (run.x() * basis_.h + run.y() * basis_.v + reflector.plane->slope.dot(run) * basis_.r).normalized();
  const double moved = reflected_edge_weight(n, along, reflector.direction, s, last) *
                       beam_incidence_taper(reflect_direction(reflector.direction, n), s, last) *
                       (1 - smooth_taper(std::abs(slope), kSlopeWindow));
  return {moved, n.dot(s) > 0};
}

namespace {

constexpr double kMinLength = 1e-4;  // m

// The common interval of two edges along a polygon side that the inner one bounds.
class EdgePair {
 public:
  EdgePair(const SideFrame& side, const BeamEdge& inner, const BeamEdge& outer,
           std::span<const PathPanel> panels_on_path)
      : side_(side),
        outer_(outer),
        first_(panels_on_path[std::min(inner.panel_index, outer.panel_index)]),
        second_(panels_on_path[std::max(inner.panel_index, outer.panel_index)]),
        outer_is_first_(outer.panel_index < inner.panel_index),
        end_{of_vertex(side.from), of_vertex(side.to)} {
    for (const BeamEdge* edge : {&inner, &outer}) {
      End a = of_edge(*edge, edge->a, panels_on_path), b = of_edge(*edge, edge->b, panels_on_path);
      if (a.t > b.t) std::swap(a, b);
      if (a.t > end_[0].t) end_[0] = a;
      if (b.t < end_[1].t) end_[1] = b;
    }
  }

  double length() const { return end_[1].t - end_[0].t; }

  // Points on the first and on the second edge in the projection plane, their distance across the side and along the
  // beam, m.
  struct EdgePoints {
    Vec2 first, second;
    double apart, distance;
    Vec2 moves;  // rate of their t with the look direction, per d1 and d2
  };
  EdgePoints at(std::size_t end) const {
    const auto& [t, moves] = end_[end];
    const double fraction = (t - side_.t(outer_.a)) / (side_.t(outer_.b) - side_.t(outer_.a));
    const Vec2 on_side = side_.from.p + t * side_.along, on_outer = outer_.a + fraction * (outer_.b - outer_.a);
    const Vec2 &first = outer_is_first_ ? on_outer : on_side, &second = outer_is_first_ ? on_side : on_outer;
    return {first, second, -side_.x(on_outer), first_.plane->at(first) - second_.plane->at(second), moves};
  }

 private:
  struct End {
    double t;
    Vec2 moves;
  };
  End of_vertex(const MovingVertex& vertex) const {
    return {side_.t(vertex.p), {side_.along.dot(vertex.d1), side_.along.dot(vertex.d2)}};
  }
  // An end of an edge is fixed in the body and moves by -z d_i in the projection plane.
  End of_edge(const BeamEdge& edge, const Vec2& p, std::span<const PathPanel> panels_on_path) const {
    return {side_.t(p), -panels_on_path[edge.panel_index].plane->at(p) * side_.along};
  }

  const SideFrame& side_;
  const BeamEdge& outer_;
  const PathPanel &first_, &second_;
  bool outer_is_first_;
  std::array<End, 2> end_;
};

// Boundary terms of one footprint along one of its sides; `outline`: of its panel, in the projection plane.
class SideBoundaryTerms {
 public:
  SideBoundaryTerms(const Contribution& contribution, const SideFrame& side, const DiffractedPaths& paths,
                    std::span<const Vec2> outline, std::vector<Contribution>& out)
      : contribution_(contribution),
        footprint_(paths.footprint()),
        side_(side),
        panels_on_path_(paths.panels_on_path()),
        paths_(paths),
        transmit_(paths.aperture()),
        out_(out),
        slope_(-footprint_.w.dot(side.across)),
        depth_(depth_across(side, outline)) {}

  // Subtracts the end-point contribution at the shadow-boundary line of an edge on this side, and adds it at the edge
  // unless the path from there is obstructed.
  void move_endpoint_to_edge(const BeamEdge& edge, bool hidden) {
    const auto [weight, visible] = paths_.edge_weight(edge, slope_);
    if (weight <= 0) return;
    const double a = side_.t(edge.a), b = side_.t(edge.b), length = side_.length;
    const std::array<double, 2> t{std::max(0.0, std::min(a, b)), std::min(length, std::max(a, b))};
    if (t[1] - t[0] < kMinLength) return;
    EdgeInterval on_line = interval_of(t[1] - t[0]);
    const DepthPlane& plane = *panels_on_path_[edge.panel_index].plane;
    const Vec2 middle = side_.from.p + 0.5 * (t[0] + t[1]) * side_.along;
    set_fresnel_limit(plane.at(middle) - footprint_.plane.at(middle), edge.depth, on_line);
    std::array<Vec2, 2> places, moves;
    for (std::size_t end = 0; end < 2; ++end) {
      const double s = t[end] / length;
      const MovingVertex vertex{side_.from.p + s * (side_.to.p - side_.from.p),
                                side_.from.d1 + s * (side_.to.d1 - side_.from.d1),
                                side_.from.d2 + s * (side_.to.d2 - side_.from.d2)};
      on_line.psi[end] = footprint_.psi(vertex.p);
      on_line.gradient[end] = phase_gradient(footprint_, vertex, transmit_);
      places[end] = vertex.p;
      moves[end] = {side_.along.dot(vertex.d1), side_.along.dot(vertex.d2)};
    }
    append(endpoint_factor(weight, edge), on_line);
    if (visible && !hidden) add_at_edge(edge, places, moves, weight, on_line);
  }

  // Adds the coupling of two edges, of which `inner` bounds this side. True when the outer edge obstructs the path over
  // the inner one to the receiver.
  bool couple_edges(const BeamEdge& inner, const BeamEdge& outer) {
    if (inner.panel_index == outer.panel_index ||
        side_.x(outer.interior_point) <= 0.5 * (side_.x(outer.a) + side_.x(outer.b)))
      return false;
    const Vec2 run = (outer.b - outer.a).normalized();
    const double askew = smooth_taper(std::abs(side_.across.dot(run)), kSkewWindow),
                 parallel = std::abs(side_.along.dot(run));
    if (askew <= 0) return false;
    if (side_.lies_on(outer) && outer.panel_index < inner.panel_index) return false;  // found as (outer, inner)
    const EdgePair both(side_, inner, outer, panels_on_path_);
    if (both.length() < kMinLength) return false;
    // Lengths are those along the first edge, distances those from its line.
    const BeamEdge &first = inner.panel_index < outer.panel_index ? inner : outer,
                   &second = inner.panel_index < outer.panel_index ? outer : inner;
    const double turned = &first == &outer ? parallel : 1.0;
    const std::array<EdgePair::EdgePoints, 2> ends{both.at(0), both.at(1)};
    const double distance_sum = ends[0].distance + ends[1].distance;
    if (distance_sum < kMinLength) return false;
    // Edges of neighbouring panels meet.
    for (const EdgePair::EdgePoints& end : ends) {
      if (end.apart < -kCoincident || end.distance < -kCoincident) return false;
    }

    EdgeInterval lacking = interval_of(turned * both.length());
    DoubleKnifeEdge knives;
    knives.psi_slope = slope_;
    set_fresnel_limit(0.5 * distance_sum, first.depth, lacking);
    knives.second_in_shadow = &first == &inner;
    // Between edges of two reflectors the last panel does not determine which of them obstructs the path.
    const DiffractedPaths::EdgeWeight moved = second.panel_index + 1 == panels_on_path_.size()
                                                  ? paths_.edge_weight(first, slope_)
                                                  : DiffractedPaths::EdgeWeight{};
    knives.off_axis_weight = moved.weight;
    knives.axial_weight = 1 - moved.weight;
    const Vec2 exit_direction = paths_.exit_in_plane(side_.across);
    std::array<double, 2> within{};  // distance from the second edge to the landing point of the first one's path, m
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& [on_first, on_second, apart, distance, moves] = ends[end];
      knives.separation[end] = std::max(distance, 0.0);
      knives.excess_path[end] = std::hypot(distance, turned * apart) - std::abs(distance);
      lacking.psi[end] = footprint_.psi(on_second) - knives.excess_path[end];
      const DiffractedPaths::DiffractedPath over_first = paths_.diffracted_path(first.panel_index, on_first);
      within[end] = side_.x(paths_.landing_point(first.panel_index, on_first)) - side_.x(on_second);
      const Vec2 step(distance, turned * side_.across.dot(on_second - on_first));
      knives.exit_excess[end] = std::max(step.norm() - step.dot(exit_direction), 0.0);
      // The path is stationary at the first edge, not at the panel: the slide of its point on the panel contributes.
      const Vec2 slide = footprint_.w.dot(side_.along) * slide_along_side(moves, footprint_.plane.at(on_second));
      PathGradient& gradient = lacking.gradient[end];
      gradient.transmit_slide = slide.x() * transmit_.h + slide.y() * transmit_.v;
      gradient.transmit = over_first.transmit + gradient.transmit_slide;
      gradient.receive = phase_gradient(footprint_, on_second, transmit_).receive;
    }
    // Where the edges meet, the sign is that of the rest of the interval.
    const double landed = within[0] + within[1];
    for (std::size_t end = 0; end < 2; ++end)
      knives.exit_excess[end] =
          std::copysign(knives.exit_excess[end], std::abs(within[end]) < kCoincident ? landed : within[end]);
    if (!knives.second_in_shadow && moved.face_visible && landed > 0)
      add_at_edge(first, {ends[0].first, ends[1].first}, {ends[0].moves, ends[1].moves}, askew * moved.weight, lacking);
    const double weight =
        askew * smooth_taper(turned * (ends[0].apart + ends[1].apart) / distance_sum, kParaxialWindow);
    if (weight > 0 && knives.off_axis_weight + knives.axial_weight > 0) {
      lacking.amplitude = knives;
      append(Complex(0, weight / (2 * kPi)), lacking);
    }
    return knives.second_in_shadow && moved.weight > 0 && landed < 0;
  }

 private:
  static EdgeInterval interval_of(double length) {
    EdgeInterval interval;
    interval.length = length;
    return interval;
  }

  // Appends the contribution of an interval whose pattern is that of the footprint times a factor.
  void append(const Complex& factor, const EdgeInterval& interval) {
    if (factor == 0.0) return;
    ContributionSource source = contribution_.source;
    source.mechanism = Mechanism::kShadowBoundary;
    Pattern pattern;
    for (int i = 0; i < 4; ++i) pattern.value[i] = factor * contribution_.pattern.value[i];
    out_.emplace_back(pattern, source, interval);
  }

  void set_fresnel_limit(double distance, double reflector_depth, EdgeInterval& end) const {
    const double depth = std::min(reflector_depth, depth_);
    end.fresnel_wavenumber = 2 * distance / (depth * depth);
  }

  // Factor of the footprint's pattern in the PO end-point contribution along this side, with the sign that subtracts
  // `weight` of it: by the divergence theorem with F = e e^{jk w.p} / (jk w.e), e the inward direction on the edge's
  // face. Every point of the edge then has the end-point contribution of the strip that it bounds, as in
  // endpoint_correction(), and the phase may vary along the side. Gordon's e = w (phase_integral.h) would include
  // end-point contributions of other sides.
  double endpoint_factor(double weight, const BeamEdge& edge) const {
    const Vec2& e = edge.inward;
    const double across = e.x() * side_.along.y() - e.y() * side_.along.x(), slope = footprint_.w.dot(e) / across;
    if (!(std::abs(slope) > kSlopeWindow[0])) return 0;  // infinite or, for a face observed along its edge, undefined
    return weight * (1 - smooth_taper(std::abs(slope), kSlopeWindow)) / (2 * kPi * slope);
  }

  // Slide of a point along the side in the body, whose points at this height move by -z d_i in the projection plane.
  Vec2 slide_along_side(const Vec2& moves, double height) const { return moves + height * side_.along; }

  // Adds the end-point contribution at the edge of a reflector; `moves`: rates of its points along the side. Length and
  // fresnel_wavenumber are those of `other`.
  void add_at_edge(const BeamEdge& edge, const std::array<Vec2, 2>& places, const std::array<Vec2, 2>& moves,
                   double weight, const EdgeInterval& other) {
    if (weight <= 0) return;
    EdgeInterval on_edge = interval_of(other.length);
    on_edge.fresnel_wavenumber = other.fresnel_wavenumber;
    std::array<DiffractedPaths::DiffractedPath, 2> path{paths_.diffracted_path(edge.panel_index, places[0]),
                                                        paths_.diffracted_path(edge.panel_index, places[1])};
    const double run = (path[1].psi - path[0].psi) / on_edge.length;
    for (std::size_t end = 0; end < 2; ++end) {
      const Vec2 slide = run * slide_along_side(moves[end], panels_on_path_[edge.panel_index].plane->at(places[end]));
      PathGradient& gradient = on_edge.gradient[end];
      on_edge.psi[end] = path[end].psi;
      gradient.transmit_slide = slide.x() * transmit_.h + slide.y() * transmit_.v;
      gradient.transmit = path[end].transmit + gradient.transmit_slide;
      gradient.receive = path[end].receive;
    }
    append(endpoint_factor(-weight, edge), on_edge);
  }

  // Depth of the panel across the side, m.
  static double depth_across(const SideFrame& side, std::span<const Vec2> outline) {
    const auto across = [&](const Vec2& p) { return side.x(p); };
    const auto [min, max] = std::ranges::minmax_element(outline, {}, across);
    return across(*max) - across(*min);
  }

  const Contribution& contribution_;
  const Footprint& footprint_;
  const SideFrame& side_;
  std::span<const PathPanel> panels_on_path_;
  const DiffractedPaths& paths_;
  const RadarBasis& transmit_;
  std::vector<Contribution>& out_;
  double slope_;  // of psi, towards the outside
  double depth_;  // of the last panel across the side, m
};

}  // namespace

void FootprintBoundary::start(const Interaction& interaction, const Contribution& contribution) {
  const auto& [segment, candidate] = interaction;
  panels_on_path_.clear();
  edges_on_path_.reset();
  // Flat perfect conductors on the whole path, after one to kMaxCorrectedReflections reflections.
  if (!scene_.settings.edges || segment.bounce <= 1 || segment.bounce > kMaxCorrectedReflections + 1 ||
      segment.has_curved_reflection || contribution.footprint()->curvature || !contribution.pattern.at_node.empty())
    return;
  panels_on_path_.resize(static_cast<std::size_t>(segment.bounce));
  panels_on_path_.back() = {candidate.projection.facet, &segment.image_transform, &candidate.projection.plane,
                            segment.direction};
  const BeamSegment* after = &segment;
  for (std::size_t place = panels_on_path_.size() - 1; place > 0; after = after->previous)
    panels_on_path_[--place] = {after->source_facet, &after->image_transform, &after->source_plane,
                                after->previous->direction};
}

void FootprintBoundary::append_terms(const Contribution& contribution) {
  if (panels_on_path_.empty()) return;
  const Panels& panels = scene_.scatterer.panels();
  if (!edges_on_path_) {
    edges_on_path_ = beam_edges(scene_.scatterer.edges(), panels, geometry_.transmit, panels_on_path_);
    outline_ = projected_outline(panels, geometry_.transmit, panels_on_path_.back());
  }
  std::optional<DiffractedPaths> paths;
  const MovingPolygon& piece = contribution.footprint()->polygon;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const MovingVertex &from = piece[i], &to = piece[i + 1 == piece.size() ? 0 : i + 1];
    if ((to.p - from.p).norm() < kMinLength) continue;
    const SideFrame side(from, to);
    for (const BeamEdge& inner : *edges_on_path_) {
      if (!side.lies_on(inner)) continue;
      if (!paths) paths.emplace(geometry_, panels_on_path_, *contribution.footprint());
      SideBoundaryTerms ends(contribution, side, *paths, outline_, out_);
      bool hidden = false;
      for (const BeamEdge& outer : *edges_on_path_) hidden |= ends.couple_edges(inner, outer);
      if (inner.panel_index + 1 < panels_on_path_.size()) ends.move_endpoint_to_edge(inner, hidden);
    }
  }
}

double boundary_term_bound(const Contribution& contribution, double lowest, double highest) {
  const EdgeInterval& interval = *contribution.interval();
  double pattern = 0;
  for (const Complex& element : contribution.pattern.value) pattern = std::max(pattern, std::abs(element));
  // With a varying phase an interval radiates from its ends.
  const double run = lowest * std::abs(interval.psi[1] - interval.psi[0]);
  const auto* knives = std::get_if<DoubleKnifeEdge>(&interval.amplitude);  // else uniform
  return pattern * interval.length * std::min(1.0, 2 / run) * (knives ? knives->upper_bound(lowest) : 1.0) *
         interval.fresnel_taper(highest);
}

}  // namespace seaglint
