// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/single_diffraction.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/diffraction/fade_windows.h"
#include "sim/scattering/diffraction/thick_edge.h"
#include "sim/scattering/edges/reflected_edge.h"

namespace seaglint {
namespace {

// Distance within which a vertex counts as on an edge; clipping is exact to rounding of the target's size.
constexpr double kOnEdge = 1e-7;  // m
// As kShadowBoundaryGuard, where diffraction_forward_taper() removes the growth near the shadow boundary.
constexpr double kReflectedGuard = 0.04;  // rad

struct EdgeInterval {
  std::array<double, 2> s;
  std::array<Vec2, 2> slip;
};

// Joins overlapping and adjoining intervals.
void merge_intervals(std::vector<EdgeInterval>& stretches) {
  std::sort(stretches.begin(), stretches.end(),
            [](const EdgeInterval& a, const EdgeInterval& b) { return a.s[0] < b.s[0]; });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < stretches.size(); ++i) {
    EdgeInterval& last = stretches[kept];
    if (stretches[i].s[0] <= last.s[1] + kOnEdge) {
      if (stretches[i].s[1] > last.s[1]) {
        last.s[1] = stretches[i].s[1];
        last.slip[1] = stretches[i].slip[1];
      }
    } else {
      stretches[++kept] = stretches[i];
    }
  }
  if (!stretches.empty()) stretches.resize(kept + 1);
}

// Intervals in which sides of the illuminated polygons coincide with an edge, given by its image's start and direction.
std::vector<EdgeInterval> illuminated_intervals(const Vec3& image, const Vec3& along, double length,
                                                const FacetWave& wave, std::span<const MovingPolygon> illuminated) {
  const RadarBasis& a = wave.antenna;
  const Vec2 start(image.dot(a.h), image.dot(a.v)), run(along.dot(a.h), along.dot(a.v));
  const double shortened = run.norm();  // projected length of a metre of edge
  std::vector<EdgeInterval> stretches;
  if (shortened < 1e-6) return stretches;  // parallel to the line of sight
  const Vec2 across(-run.y() / shortened, run.x() / shortened);
  const auto place = [&](const MovingVertex& vertex) { return run.dot(vertex.p - start) / (shortened * shortened); };
  // Slide of a vertex along the edge: its motion beyond that of a body-fixed point, -z d_i.
  const auto slip = [&](const MovingVertex& corner) -> Vec2 {
    const double z = wave.plane.at(corner.p);
    return Vec2(run.dot(corner.d1 + Vec2(z, 0)), run.dot(corner.d2 + Vec2(0, z))) / (shortened * shortened);
  };
  const auto on_edge = [&](const MovingVertex& corner) { return std::abs(across.dot(corner.p - start)) <= kOnEdge; };
  for (const MovingPolygon& piece : illuminated) {
    bool here = on_edge(piece.back());
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const MovingVertex &p = i == 0 ? piece.back() : piece[i - 1], &q = piece[i];
      const bool before = here;
      here = on_edge(q);
      if (!before || !here) continue;
      EdgeInterval stretch{{place(p), place(q)}, {slip(p), slip(q)}};
      if (stretch.s[0] > stretch.s[1]) {
        std::swap(stretch.s[0], stretch.s[1]);
        std::swap(stretch.slip[0], stretch.slip[1]);
      }
      // A polygon side may continue along the next collinear edge; the interval then ends at the fixed end of this
      // edge.
      if (stretch.s[0] < 0) {
        stretch.s[0] = 0;
        stretch.slip[0].setZero();
      }
      if (stretch.s[1] > length) {
        stretch.s[1] = length;
        stretch.slip[1].setZero();
      }
      if (stretch.s[1] - stretch.s[0] > kOnEdge) stretches.push_back(stretch);
    }
  }
  merge_intervals(stretches);
  return stretches;
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

// Mean of a path and its reciprocal.
EdgePattern mean(EdgePattern there, const EdgePattern& back) {
  there += transposed(back);
  there *= 0.5;
  return there;
}

EdgePattern reciprocal_mean(const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out) {
  const EdgePattern there = pattern(wedge, in, out);
  return mean(there, &in == &out ? there : pattern(wedge, out, in));
}

// equivalent_edge_currents() subtracts the facets' direct radiation of the transmitter's wave. For one antenna single
// diffraction is the mean of a path and its reciprocal; for two antennas only the transmitter's wave gives Keller's
// field together with the facets.
EdgePattern direct(const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out, bool monostatic) {
  return monostatic ? reciprocal_mean(wedge, in, out) : pattern(wedge, in, out);
}

// Diffracted field of the edge via reflectors, in addition to the beams that its faces reflect to them, with the weight
// of each face (reflected_edge.h).
EdgePattern edge_field_pattern(const WedgeFrame& wedge, const std::array<double, 2>& shares, const EdgeIllumination& in,
                               const EdgeIllumination& out) {
  EdgePattern answer = pattern(wedge, in, out, kReflectedGuard);
  for (int f = 0; f < 2; ++f) {
    if (shares[f] <= 0) continue;
    const std::array<double, 4> ends = endpoint_correction(wedge.face[f], in, out);
    for (int i = 0; i < 4; ++i) answer.thin[i] += shares[f] * ends[i];
  }
  return answer;
}

// Where that field is not separable from the beam: fringe currents, of the wave that is reflected more often, since the
// facets radiate that one directly to the receiver. A path with more reflections on its exit is replaced by its
// reciprocal; with equal numbers the mean of both is used.
EdgePattern fringe_pattern(const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out) {
  if (in.reflections > out.reflections) return pattern(wedge, in, out);
  return in.reflections < out.reflections ? transposed(pattern(wedge, out, in)) : reciprocal_mean(wedge, in, out);
}

// Pattern of a path via reflectors; none where its tapers are zero near the forward direction. `both_paths`: adds the
// reciprocal path, whose last reflector and PO end-point contributions differ, so that S_hv = S_vh.
std::optional<EdgePattern> reflected_pattern(const WedgeFrame& wedge, const EdgeIllumination& in,
                                             const EdgeIllumination& out, bool both_paths) {
  std::array<double, 2> reflecting = reflected_face_weights(wedge, in, out);
  const double by_edge = std::ranges::max(reflecting),
               by_beam = (1 - by_edge) * fringe_forward_taper(in.direction, -out.direction);
  if (by_edge <= 0 && by_beam <= 0) return std::nullopt;
  EdgePattern answer;
  answer.thickness_m = wedge.thickness_m;
  const auto add = [&](EdgePattern part, double share) {
    part *= share;
    answer += part;
  };
  if (by_edge > 0) {
    for (double& share : reflecting) share /= by_edge;
    add(edge_field_pattern(wedge, reflecting, in, out), by_edge);
    if (both_paths) add(edge_field_pattern(wedge, reflecting, out, in), by_edge);
  }
  if (by_beam > 0) {
    const EdgePattern beam = fringe_pattern(wedge, in, out);
    add(beam, by_beam);
    if (both_paths) add(transposed(beam), by_beam);
  }
  return answer;
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
    const Vec3 image = wave.image_transform.image(edge.a), along = wave.image_transform.L * edge.along();
    for (const EdgeInterval& stretch : illuminated_intervals(image, along, edge.length(), wave, illuminated)) {
      illuminations.push_back({side.edge, stretch.s, stretch.slip, image, along, wave.direction, wave.E_h, wave.E_v,
                               static_cast<std::uint8_t>(wave.bounce - 1), wave.first_reflector_normal});
    }
  }
}

void append_single_diffraction(const SharpEdge& edge, std::span<const Facet> facets, const BistaticGeometry& geometry,
                               EdgeIlluminations incoming, EdgeIlluminations outgoing, int max_bounces,
                               std::vector<EdgeContribution>& contributions) {
  const int max_reflections = std::min(kMaxEdgeReflections, max_bounces - 1);
  // For one antenna only one of two reciprocal paths is evaluated: both have the same length.
  const auto echo = [&](const EdgeIllumination& in, const EdgeIllumination& out) {
    const bool both_paths = geometry.monostatic && &in != &out;
    const double first = std::max(in.s[0], out.s[0]), last = std::min(in.s[1], out.s[1]);
    if (last - first <= kOnEdge || in.reflections + out.reflections > max_reflections) return;
    const WedgeFrame* wedge = illuminated_wedge(edge, in.direction);
    if (!wedge || illuminated_wedge(edge, out.direction) != wedge) return;

    std::optional<EdgePattern> answer;
    if (in.reflections + out.reflections > 0) {
      answer = reflected_pattern(*wedge, in, out, both_paths);
    } else {
      answer = direct(*wedge, in, out, geometry.monostatic);
      if (both_paths) *answer += transposed(*answer);
    }
    if (!answer) return;

    EdgeContribution contribution;
    contribution.length = last - first;
    contribution.facet = edge.facet[0];
    contribution.part = facets[edge.facet[0]].part;
    contribution.other_part = facets[edge.facet[1]].part;
    contribution.bounces = static_cast<std::uint8_t>(in.reflections + out.reflections + 1);
    contribution.pattern = *answer;

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
    for (std::size_t b = geometry.monostatic ? a : 0; b < outgoing.size(); ++b) echo(*incoming[a], *outgoing[b]);
  }
}

}  // namespace seaglint
