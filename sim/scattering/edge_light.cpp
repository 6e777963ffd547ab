// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edge_light.h"

#include <algorithm>
#include <cmath>

#include "sim/core/constants.h"
#include "sim/scattering/mirrored_rim.h"
#include "sim/scattering/thick_rim.h"

namespace seaglint {
namespace {

// Corners this near to an edge lie on it: cuts are exact to rounding of the target's size.
constexpr double kOnEdge = 1e-7;  // m

struct Stretch {
  std::array<double, 2> s;
  std::array<Vec2, 2> slip;
};

// Stretches that meet become one.
void join(std::vector<Stretch>& stretches) {
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) { return a.s[0] < b.s[0]; });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < stretches.size(); ++i) {
    Stretch& last = stretches[kept];
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

// Where sides of the lit pieces lie on an edge, given by its image's start and direction.
std::vector<Stretch> lit_stretches(const Vec3& image, const Vec3& along, double length, const WaveOnFacet& wave,
                                   std::span<const MovingPolygon> lit) {
  const RadarBasis& a = wave.antenna;
  const Vec2 start(image.dot(a.h), image.dot(a.v)), run(along.dot(a.h), along.dot(a.v));
  const double shortened = run.norm();  // of a metre of edge in the aperture
  std::vector<Stretch> stretches;
  if (shortened < 1e-6) return stretches;  // seen end-on
  const Vec2 across(-run.y() / shortened, run.x() / shortened);
  const auto place = [&](const Corner& corner) { return run.dot(corner.p - start) / (shortened * shortened); };
  // Beyond what a body-fixed point moves in the aperture (-z d_i), a corner slips along the edge.
  const auto slip = [&](const Corner& corner) -> Vec2 {
    const double z = wave.plane.at(corner.p);
    return Vec2(run.dot(corner.d1 + Vec2(z, 0)), run.dot(corner.d2 + Vec2(0, z))) / (shortened * shortened);
  };
  const auto on_edge = [&](const Corner& corner) { return std::abs(across.dot(corner.p - start)) <= kOnEdge; };
  for (const MovingPolygon& piece : lit) {
    bool here = on_edge(piece.back());
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Corner &p = i == 0 ? piece.back() : piece[i - 1], &q = piece[i];
      const bool before = here;
      here = on_edge(q);
      if (!before || !here) continue;
      Stretch stretch{{place(p), place(q)}, {slip(p), slip(q)}};
      if (stretch.s[0] > stretch.s[1]) {
        std::swap(stretch.s[0], stretch.s[1]);
        std::swap(stretch.slip[0], stretch.slip[1]);
      }
      // A side may run on along the next edge of the same line: this one's own ends stay where they are.
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
  join(stretches);
  return stretches;
}

// hh, hv, vh, vv of what leaves by `out`. The received polarisation, sent backwards, arrives as the outgoing wave.
EdgePattern pattern(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out) {
  const auto received = [&](const auto& J_h, const auto& J_v) -> std::array<Complex, 4> {
    return {out.E_h.dot(J_h), out.E_h.dot(J_v), out.E_v.dot(J_h), out.E_v.dot(J_v)};
  };
  const auto [J_h, J_v] = edge_currents(wedge, in.direction, {in.E_h, in.E_v}, -out.direction);
  EdgePattern pattern{received(J_h, J_v), {}, {}, wedge.thickness_m};
  if (wedge.thickness_m > 0) {
    const auto [T_h, T_v] = thick_rim_currents(wedge, in.direction, {in.E_h, in.E_v}, -out.direction);
    pattern.thick = received(T_h.constant, T_v.constant);
    pattern.thick_log = received(T_h.logarithm, T_v.logarithm);
  }
  return pattern;
}

// A way and the same one run backwards, half of each.
EdgePattern mean(EdgePattern there, const EdgePattern& back) {
  there += transposed(back);
  there *= 0.5;
  return there;
}

EdgePattern mean_of_both(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out) {
  const EdgePattern there = pattern(wedge, in, out);
  return mean(there, &in == &out ? there : pattern(wedge, out, in));
}

// What edge_currents() leaves out is what facets radiate straight to the receiver, of the transmitter's wave: with one antenna single diffraction is reciprocal as the mean of both ways; with two
// antennas only the transmitter's and theirs together are Keller's.
EdgePattern direct(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out, bool monostatic) {
  return monostatic ? mean_of_both(wedge, in, out) : pattern(wedge, in, out);
}

// The same along the beam that a face of the wedge reflects, for mirrors to send on (mirrored_rim.h).
EdgePattern along_the_beam(const WedgeFrame& wedge, const WedgeFace& face, const EdgeArrival& in, const EdgeArrival& out, bool monostatic) {
  const auto way = [&](const EdgeArrival& from, const EdgeArrival& to) {
    EdgePattern answer = pattern(wedge, from, to);
    const std::array<double, 4> ends = ends_of_beam(face, from, to);
    for (int i = 0; i < 4; ++i) answer.sharp[i] += ends[i];
    return answer;
  };
  return monostatic ? mean(way(in, out), way(out, in)) : way(in, out);
}

// In other directions: what facets radiate straight to the receiver is what the transmitter or more mirrors lit. A way with more mirrors on its end is the same way run backwards; ways with as many
// on either side share both.
EdgePattern beside_reflection(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out) {
  if (in.mirrors > out.mirrors) return pattern(wedge, in, out);
  return in.mirrors < out.mirrors ? transposed(pattern(wedge, out, in)) : mean_of_both(wedge, in, out);
}

// By mirrors; nothing where it has faded out ahead of the edge.
std::optional<EdgePattern> by_mirrors(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out, bool monostatic) {
  const Vec3 s = -out.direction;
  const ReflectingFace reflecting = reflecting_face(wedge, in.direction, s);
  const double along = reflecting.share, beside = (1 - reflecting.share) * beside_the_beam(in.direction, s);
  if (along <= 0 && beside <= 0) return std::nullopt;
  EdgePattern answer;
  answer.thickness_m = wedge.thickness_m;
  const auto add = [&](EdgePattern part, double share) {
    part *= share;
    answer += part;
  };
  if (along > 0) add(along_the_beam(wedge, wedge.face[reflecting.face], in, out, monostatic), along);
  if (beside > 0) add(beside_reflection(wedge, in, out), beside);
  return answer;
}

}  // namespace

std::array<Complex, 4> EdgePattern::at(double k) const {
  std::array<Complex, 4> all = sharp;
  if (thickness_m > 0) {
    const double kt = k * thickness_m, logarithm = std::log(kt);
    for (int i = 0; i < 4; ++i) all[i] += kt * (thick[i] + logarithm * thick_log[i]);
  }
  return all;
}

EdgePattern& EdgePattern::operator+=(const EdgePattern& other) {
  for (int i = 0; i < 4; ++i) {
    sharp[i] += other.sharp[i];
    thick[i] += other.thick[i];
    thick_log[i] += other.thick_log[i];
  }
  return *this;
}

EdgePattern& EdgePattern::operator*=(double factor) {
  for (auto* part : {&sharp, &thick, &thick_log}) {
    for (Complex& element : *part) element *= factor;
  }
  return *this;
}

EdgePattern transposed(EdgePattern pattern) {
  for (auto* part : {&pattern.sharp, &pattern.thick, &pattern.thick_log}) std::swap((*part)[1], (*part)[2]);
  return pattern;
}

double fading(double x, const std::array<double, 2>& from_to) {
  const double beyond = std::clamp((x - from_to[0]) / (from_to[1] - from_to[0]), 0.0, 1.0);
  return 1 - beyond * beyond * (3 - 2 * beyond);
}

double beside_the_beam(const Vec3& k_hat, const Vec3& s) { return fading(k_hat.dot(s), {0, std::cos(kPi / 6)}); }

double before_the_beam(const Vec3& k_hat, const Vec3& s) { return fading(k_hat.dot(s), {0.95, 0.999}); }

void find_arrivals(const SharpEdges& edges, int facet, const WaveOnFacet& wave, std::span<const MovingPolygon> lit,
                   std::vector<EdgeArrival>& arrivals) {
  if (lit.empty()) return;
  for (const PanelEdge& side : edges.of_panel(facet)) {
    if (!side.may_speak(wave.direction)) continue;
    const SharpEdge& edge = edges.edges[side.edge];
    const WedgeFrame* wedge = wedge_lit(edge, side.first, wave.direction);
    const bool rim = edge.facet[0] == edge.facet[1];
    if (!wedge || !(rim || speaks(*wedge, side.first, wave.direction))) continue;
    if (wedge->N < 1 && wave.bounce > 1) continue;  // of a corner the reflections are part of its answer
    const Vec3 image = wave.mirrors.image(edge.a), along = wave.mirrors.L * edge.along();
    for (const Stretch& stretch : lit_stretches(image, along, edge.length(), wave, lit)) {
      arrivals.push_back({side.edge, stretch.s, stretch.slip, image, along, wave.direction, wave.E_h, wave.E_v,
                          static_cast<std::uint8_t>(wave.bounce - 1), wave.first_mirror});
    }
  }
}

std::vector<EdgeFootprint> edge_footprints(const SharpEdges& edges, std::span<const Facet> facets,
                                           const AntennaPair& antennas, std::span<const EdgeArrival> incoming,
                                           std::span<const EdgeArrival> outgoing, int max_bounces) {
  std::vector<EdgeFootprint> result;
  const int most_mirrors = std::min(kMostEdgeMirrors, max_bounces - 1);
  // Of one antenna's two ways by the same arrivals only one is followed: run backwards it has the same path and the
  // transposed pattern.
  const auto echo = [&](const EdgeArrival& in, const EdgeArrival& out) {
    const bool both_ways = antennas.monostatic && &in != &out;
    const double first = std::max(in.s[0], out.s[0]), last = std::min(in.s[1], out.s[1]);
    if (last - first <= kOnEdge || in.mirrors + out.mirrors > most_mirrors) return;
    const SharpEdge& edge = edges.edges[in.edge];
    const WedgeFrame* wedge = wedge_towards(edge, in.direction);
    if (!wedge || wedge_towards(edge, out.direction) != wedge) return;

    const std::optional<EdgePattern> answer =
        in.mirrors + out.mirrors > 0 ? by_mirrors(*wedge, in, out, antennas.monostatic) : direct(*wedge, in, out, antennas.monostatic);
    if (!answer) return;

    EdgeFootprint footprint;
    footprint.length = last - first;
    footprint.facet = edge.facet[0];
    footprint.part = facets[edge.facet[0]].part;
    footprint.part_beyond = facets[edge.facet[1]].part;
    footprint.bounces = static_cast<std::uint8_t>(in.mirrors + out.mirrors + 1);
    footprint.pattern = *answer;
    if (both_ways) footprint.pattern += transposed(*answer);

    const RadarBasis &t = antennas.transmit, &r = antennas.receive;
    const double slope = t.r.dot(in.image_along) + r.r.dot(out.image_along);  // of psi along the edge
    for (int end = 0; end < 2; ++end) {
      const double s = end == 0 ? first : last;
      const Vec3 X = in.image + s * in.image_along, Y = out.image + s * out.image_along;
      footprint.psi[end] = t.r.dot(X) + r.r.dot(Y);
      // The end belongs to whichever stretch ends there, and slips with it.
      const bool by_in = end == 0 ? in.s[0] >= out.s[0] : in.s[1] <= out.s[1];
      const Vec2 slip = slope * (by_in ? in.slip[end] : out.slip[end]);
      PathGradient& gradient = footprint.gradient[end];
      if (by_in) {
        gradient.transmit_slip = slip.x() * t.h + slip.y() * t.v;
      } else {
        gradient.receive_slip = slip.x() * r.h + slip.y() * r.v;
      }
      gradient.transmit = X + gradient.transmit_slip;
      gradient.receive = Y + gradient.receive_slip;
    }
    result.push_back(footprint);
  };

  // Both lists edge by edge.
  std::size_t i = 0, o = 0;
  while (i < incoming.size() && o < outgoing.size()) {
    const int edge = std::max(incoming[i].edge, outgoing[o].edge);
    while (i < incoming.size() && incoming[i].edge < edge) ++i;
    while (o < outgoing.size() && outgoing[o].edge < edge) ++o;
    std::size_t i_end = i, o_end = o;
    while (i_end < incoming.size() && incoming[i_end].edge == edge) ++i_end;
    while (o_end < outgoing.size() && outgoing[o_end].edge == edge) ++o_end;
    for (std::size_t a = i; a < i_end; ++a) {
      for (std::size_t b = antennas.monostatic ? o + (a - i) : o; b < o_end; ++b) echo(incoming[a], outgoing[b]);
    }
    i = i_end;
    o = o_end;
  }
  return result;
}

namespace {

// Phase along a stretch between knife edges from which on its ends answer alone, rad, and along each part of a slower one, that is summed.
constexpr double kFast = 60, kPartPhase = 3;

template <typename T>
T at_share(const std::array<T, 2>& ends, double share) {
  return ends[0] + share * (ends[1] - ends[0]);
}

// k (psi_1 - psi_0), kept from 0, where the terms of both ends would be infinite: moves the integral by a part of this at most.
double phase_run(const EdgeFootprint& footprint, double k) {
  constexpr double kLeast = 1e-3;  // rad
  const double run = k * (footprint.psi[1] - footprint.psi[0]);
  return std::abs(run) < kLeast ? std::copysign(kLeast, run) : run;
}

// What the range makes of the pattern at one end of a part of the stretch.
Complex range_at(const EdgeFootprint::EdgeWaveRange& range, double k, double run, double share) {
  constexpr double kLeastLength = 1e-12;  // m: in a corner, where both edges meet, the product with the decay is finite
  constexpr double kFar = 1e15;           // parallel edges
  const double l = std::max(at_share(range.l, share), kLeastLength);
  const double phase = std::clamp(run * l / (range.l[1] - range.l[0]), -kFar, kFar);
  const double x = 2 * k * range.departure * (range.waves == 1 ? l : range.first_m), y = 2 * k * range.arrival * l;
  const Complex boundaries = range.waves == 1 ? transition(x, y, -phase) : transition(x) * transition(y, -phase);
  return boundaries * std::pow(k, -0.5 * range.waves) / std::sqrt(l);
}

// Mean of width e^{j phase (share - middle)} over a part of a stretch: Gauss and Legendre's four points for each three radians, since the width goes with the
// root of the way between rims that meet.
Complex mean_width(const EdgeFootprint::KnifeEdges& knives, double k, double phase, double from, double to) {
  constexpr std::array<double, 4> node{-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053},
      weight{0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454};
  const int parts = 1 + static_cast<int>(std::abs(phase) / kPartPhase);
  Complex sum = 0;
  for (int part = 0; part < parts; ++part) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const double place = (part + 0.5 * (1 + node[i])) / parts;
      sum += 0.5 * weight[i] * knives.width(k, from + place * (to - from)) * std::polar(1.0, (place - 0.5) * phase);
    }
  }
  return sum / static_cast<double>(parts);
}

// What a range or knife edges make of the pattern there.
Complex amplitude_at(const EdgeFootprint& footprint, double k, double run, double share) {
  if (footprint.edge_wave) return range_at(*footprint.edge_wave, k, run, share);
  return footprint.knife_edges ? footprint.knife_edges->width(k, share, run) : 1.0;
}

}  // namespace

double EdgeFootprint::KnifeEdges::fade_by_slope(double k, double distance_m) const { return fading(0.5 * k * distance_m * slope * slope, {0, 1}); }

double EdgeFootprint::KnifeEdges::fade_by_depth(double k, double distance_m) const { return fading(2 * distance_m / (k * depth * depth), {0.3, 1}); }

Complex EdgeFootprint::KnifeEdges::width(double k, double share, double run) const {
  const double d = at_share(distance, share);
  // An end of running phase a along a root: the integral of sqrt(t) e^{jat} from 0 on is (j / a) sqrt(pi j / 4a), that of sqrt(d + t) to first order (j / a) sqrt(d + j / a).
  const Complex reached = d + (distance[1] - distance[0]) * Complex(0, kPi / 4 / run);
  return std::polar(fade_by_slope(k, d) * fade_by_depth(k, d), -kPi / 4) * std::sqrt(k / (2 * kPi) * reached) * (1.0 - transition(k * at_share(excess, share)));
}

Complex end_term(const EdgeFootprint& footprint, double k, double share) {
  const double run = phase_run(footprint, k);
  return footprint.length / Complex(0, run) * amplitude_at(footprint, k, run, share);
}

Complex part_integral(const EdgeFootprint& footprint, double k, double from, double to) {
  const double phase = k * (footprint.psi[1] - footprint.psi[0]) * (to - from);
  if (!footprint.edge_wave && !footprint.knife_edges) return footprint.length * (to - from) * sinc(phase);
  if (footprint.knife_edges && std::abs(phase) < kFast) return footprint.length * (to - from) * mean_width(*footprint.knife_edges, k, phase, from, to);
  const Complex half = std::polar(1.0, 0.5 * (to - from) * phase_run(footprint, k));
  return end_term(footprint, k, to) * half - end_term(footprint, k, from) * std::conj(half);
}

std::array<Complex, 4> scattered(const EdgeFootprint& footprint, double k) {
  const Complex integral = part_integral(footprint, k, 0, 1) * std::polar(1.0, k * 0.5 * (footprint.psi[0] + footprint.psi[1]));
  std::array<Complex, 4> s = footprint.pattern.at(k);
  for (Complex& element : s) element *= integral;
  return s;
}

}  // namespace seaglint
