// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/single_diffraction.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/reflection.h"
#include "sim/scattering/coefficients/thick_edge.h"
#include "sim/scattering/geometry/tolerances.h"
#include "sim/scattering/radiation/reflected_edge.h"

namespace seaglint {
namespace {

struct EdgeInterval {
  std::array<double, 2> s;
  std::array<Vec2, 2> slip;
};

// Joins overlapping and adjoining intervals.
void merge_intervals(std::vector<EdgeInterval>& intervals) {
  std::sort(intervals.begin(), intervals.end(),
            [](const EdgeInterval& a, const EdgeInterval& b) { return a.s[0] < b.s[0]; });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < intervals.size(); ++i) {
    EdgeInterval& last = intervals[kept];
    if (intervals[i].s[0] <= last.s[1] + kCoincident) {
      if (intervals[i].s[1] > last.s[1]) {
        last.s[1] = intervals[i].s[1];
        last.slip[1] = intervals[i].slip[1];
      }
    } else {
      intervals[++kept] = intervals[i];
    }
  }
  if (!intervals.empty()) intervals.resize(kept + 1);
}

// Intervals in which sides of the illuminated polygons coincide with an edge, given by its image's start and direction.
std::vector<EdgeInterval> illuminated_intervals(const Vec3& image, const Vec3& along, double length,
                                                const FacetWave& wave, std::span<const MovingPolygon> illuminated) {
  const RadarBasis& a = wave.antenna;
  const Vec2 start(image.dot(a.h), image.dot(a.v)), run(along.dot(a.h), along.dot(a.v));
  const double shortened = run.norm();  // projected length of a metre of edge
  std::vector<EdgeInterval> intervals;
  if (shortened < 1e-6) return intervals;  // parallel to the line of sight
  const Vec2 across(-run.y() / shortened, run.x() / shortened);
  const auto place = [&](const MovingVertex& vertex) { return run.dot(vertex.p - start) / (shortened * shortened); };
  // Slide of a vertex along the edge: its motion beyond that of a body-fixed point, -z d_i.
  const auto slip = [&](const MovingVertex& corner) -> Vec2 {
    const double z = wave.plane.at(corner.p);
    return Vec2(run.dot(corner.d1 + Vec2(z, 0)), run.dot(corner.d2 + Vec2(0, z))) / (shortened * shortened);
  };
  const auto on_edge = [&](const MovingVertex& corner) {
    return std::abs(across.dot(corner.p - start)) <= kCoincident;
  };
  for (const MovingPolygon& piece : illuminated) {
    bool here = on_edge(piece.back());
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const MovingVertex &p = i == 0 ? piece.back() : piece[i - 1], &q = piece[i];
      const bool before = here;
      here = on_edge(q);
      if (!before || !here) continue;
      EdgeInterval interval{{place(p), place(q)}, {slip(p), slip(q)}};
      if (interval.s[0] > interval.s[1]) {
        std::swap(interval.s[0], interval.s[1]);
        std::swap(interval.slip[0], interval.slip[1]);
      }
      // A polygon side may continue along the next collinear edge; the interval then ends at the fixed end of this
      // edge.
      if (interval.s[0] < 0) {
        interval.s[0] = 0;
        interval.slip[0].setZero();
      }
      if (interval.s[1] > length) {
        interval.s[1] = length;
        interval.slip[1].setZero();
      }
      if (interval.s[1] - interval.s[0] > kCoincident) intervals.push_back(interval);
    }
  }
  merge_intervals(intervals);
  return intervals;
}

// hh, hv, vh, vv of an incident and an exit path. The received polarisation is the field of the receiver's wave at the
// edge.
EdgePattern pattern(const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out,
                    double shadow = kShadowBoundaryGuard) {
  const auto received = [&](const auto& J_h, const auto& J_v) -> std::array<Complex, 4> {
    return {out.E_h.dot(J_h), out.E_h.dot(J_v), out.E_v.dot(J_h), out.E_v.dot(J_v)};
  };
  const auto [J_h, J_v] = equivalent_edge_currents(wedge, in.direction, {in.E_h, in.E_v}, -out.direction, shadow);
  EdgePattern pattern{received(J_h, J_v), {}, {}, wedge.thickness_m};
  if (wedge.thickness_m > 0) {
    const auto [T_h, T_v] = thick_edge_currents(wedge, in.direction, {in.E_h, in.E_v}, -out.direction);
    pattern.thickness_linear = received(T_h.constant, T_v.constant);
    pattern.thickness_log = received(T_h.logarithm, T_v.logarithm);
  }
  return pattern;
}

// Diffracted field of the edge via reflectors, in addition to the beams that its faces reflect to them, with the weight
// of each face (reflected_edge.h).
EdgePattern edge_field_pattern(const WedgeFrame& wedge, const std::array<double, 2>& weights,
                               const EdgeIllumination& in, const EdgeIllumination& out) {
  EdgePattern sum = pattern(wedge, in, out, kReflectedBoundaryGuard);
  for (int f = 0; f < 2; ++f) {
    if (weights[f] <= 0) continue;
    const std::array<double, 4> ends = endpoint_correction(wedge.face[f], in, out);
    for (int i = 0; i < 4; ++i) sum.thin[i] += weights[f] * ends[i];
  }
  return sum;
}

// Where that field is not separable from the beam: fringe currents, of the wave that is reflected more often, since the
// facets radiate that one directly to the receiver. A path with more reflections on its exit is replaced by its
// reciprocal; with equal numbers the mean of both is used.
EdgePattern fringe_pattern(const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out) {
  if (in.reflections > out.reflections) return pattern(wedge, in, out);
  if (in.reflections < out.reflections) return transposed(pattern(wedge, out, in));
  return reciprocal_mean(pattern(wedge, in, out), pattern(wedge, out, in));
}

// Pattern of one or two paths transmitter - edge - receiver, in two parts: `beams` belongs together with the facets'
// direct radiation and is reciprocal in truth, `edge` with the boundary terms of the beams on the last reflector, whose
// wave and order of reflections it shares.
struct PathPattern {
  EdgePattern beams, edge;
  bool any = false;
};

// Adds the pattern of a path; nothing where its tapers are zero near the forward direction.
void add_path(const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out, PathPattern& sum) {
  const auto add = [&](EdgePattern part, double weight, EdgePattern& to) {
    part *= weight;
    to += part;
    sum.any = true;
  };
  if (in.reflections + out.reflections == 0) return add(pattern(wedge, in, out), 1, sum.beams);
  std::array<double, 2> reflecting = reflected_face_weights(wedge, in, out);
  const double by_edge = std::ranges::max(reflecting),
               by_beam = (1 - by_edge) * fringe_forward_taper(in.direction, -out.direction);
  if (by_edge > 0) {
    for (double& weight : reflecting) weight /= by_edge;
    add(edge_field_pattern(wedge, reflecting, in, out), by_edge, sum.edge);
  }
  if (by_beam > 0) add(fringe_pattern(wedge, in, out), by_beam, sum.beams);
}

// Pattern of a pair of illuminations; none where it vanishes. Reciprocity: for one antenna a path and its reciprocal
// have the same length and are one contribution; off Keller's cone the part that belongs to the facets is not
// reciprocal and enters by the mean of its matrix and the transposed one. For two antennas only the transmitter's wave
// gives Keller's field together with the facets.
std::optional<EdgePattern> pair_pattern(const WedgeFrame& wedge, const EdgeIllumination& in,
                                        const EdgeIllumination& out, bool monostatic) {
  PathPattern sum;
  sum.beams.thickness_m = sum.edge.thickness_m = wedge.thickness_m;
  add_path(wedge, in, out, sum);
  if (monostatic && &in != &out) add_path(wedge, out, in, sum);
  if (!sum.any) return std::nullopt;
  if (monostatic) sum.beams = reciprocal_mean(sum.beams, sum.beams);
  sum.beams += sum.edge;
  return sum.beams;
}

// Pattern of direct incident and exit paths at an edge with a face that is no perfect conductor.
EdgePattern material_pattern(const WedgeFrame& wedge, std::span<const MaterialFaces> materials,
                             const EdgeIllumination& in, const EdgeIllumination& out, bool monostatic) {
  EdgePattern pattern;
  for (const MaterialFaces& faces : materials) {
    const auto [J_h, J_v] =
        material_edge_currents(wedge, faces, in.direction, {in.E_h, in.E_v}, -out.direction, kShadowBoundaryGuard);
    pattern.by_wavenumber.push_back({faces.k,
                                     {component_along(out.E_h, J_h), component_along(out.E_h, J_v),
                                      component_along(out.E_v, J_h), component_along(out.E_v, J_v)}});
  }
  return monostatic ? reciprocal_mean(pattern, pattern) : pattern;
}

}  // namespace

void find_edge_illumination(const SharpEdges& edges, int facet, const FacetWave& wave,
                            std::span<const MovingPolygon> illuminated, std::vector<EdgeIllumination>& illuminations) {
  if (illuminated.empty()) return;
  for (const PanelEdge& side : edges.edges_of_panel(facet)) {
    if (!side.may_record_edge(wave.direction)) continue;
    const SharpEdge& edge = edges.edges[side.edge];
    const WedgeFrame* wedge = illuminated_wedge(edge, wave.direction);
    if (!wedge || !records_edge(edge, *wedge, side.is_first_face, wave.direction)) continue;
    if (wedge->N < 1 && wave.bounce > 1) continue;  // PO of a concave edge includes its reflections
    // Edges of materials are illuminated directly only; on other panels than smooth conductors no other edge is.
    if (edge.conducts ? !wave.on_conductor : wave.bounce > 1) continue;
    const Vec3 image = wave.image_transform.image(edge.a), along = wave.image_transform.L * edge.along();
    for (const EdgeInterval& interval : illuminated_intervals(image, along, edge.length(), wave, illuminated)) {
      illuminations.push_back({side.edge, interval.s, interval.slip, image, along, wave.direction, wave.E_h, wave.E_v,
                               static_cast<std::uint8_t>(wave.bounce - 1), wave.first_reflector_normal});
    }
  }
}

void append_single_diffraction(const SharpEdge& edge, std::span<const Facet> facets, const BistaticGeometry& geometry,
                               EdgeIlluminations incoming, EdgeIlluminations outgoing, int max_bounces,
                               std::span<const MaterialFaces> materials, std::vector<EdgeContribution>& contributions) {
  const int max_reflections = std::min(kMaxEdgeReflections, max_bounces - 1);
  const auto append = [&](const EdgeIllumination& in, const EdgeIllumination& out) {
    const double first = std::max(in.s[0], out.s[0]), last = std::min(in.s[1], out.s[1]);
    if (last - first <= kCoincident || in.reflections + out.reflections > max_reflections) return;
    const WedgeFrame* wedge = illuminated_wedge(edge, in.direction);
    if (!wedge || illuminated_wedge(edge, out.direction) != wedge) return;

    const std::optional<EdgePattern> pattern = edge.conducts
                                                   ? pair_pattern(*wedge, in, out, geometry.monostatic)
                                                   : material_pattern(*wedge, materials, in, out, geometry.monostatic);
    if (!pattern) return;

    EdgeContribution contribution;
    contribution.length = last - first;
    contribution.facet = edge.facet[0];
    contribution.part = facets[edge.facet[0]].part;
    contribution.other_part = facets[edge.facet[1]].part;
    contribution.bounces = static_cast<std::uint8_t>(in.reflections + out.reflections + 1);
    contribution.pattern = *pattern;
    if (in.reflections + out.reflections > 0) {
      contribution.mechanism = Mechanism::kReflectedEdge;
    } else if (wedge->N < 1) {
      contribution.mechanism = Mechanism::kConcaveEdge;
    }

    const RadarBasis &t = geometry.transmit, &r = geometry.receive;
    const double slope = t.r.dot(in.image_edge_direction) + r.r.dot(out.image_edge_direction);  // of psi along the edge
    for (int end = 0; end < 2; ++end) {
      const double s = end == 0 ? first : last;
      const Vec3 X = in.image_start + s * in.image_edge_direction, Y = out.image_start + s * out.image_edge_direction;
      contribution.psi[end] = t.r.dot(X) + r.r.dot(Y);
      // An end belongs to the path whose interval ends there, and slides with it.
      const bool by_in = end == 0 ? in.s[0] >= out.s[0] : in.s[1] <= out.s[1];
      const Vec2 slide = slope * (by_in ? in.slide[end] : out.slide[end]);
      PathGradient& gradient = contribution.gradient[end];
      if (by_in) {
        gradient.transmit_slide = slide.x() * t.h + slide.y() * t.v;
      } else {
        gradient.receive_slide = slide.x() * r.h + slide.y() * r.v;
      }
      gradient.transmit = X + gradient.transmit_slide;
      gradient.receive = Y + gradient.receive_slide;
    }
    contributions.push_back(contribution);
  };

  for (std::size_t a = 0; a < incoming.size(); ++a) {
    for (std::size_t b = geometry.monostatic ? a : 0; b < outgoing.size(); ++b) append(*incoming[a], *outgoing[b]);
  }
}

}  // namespace seaglint
