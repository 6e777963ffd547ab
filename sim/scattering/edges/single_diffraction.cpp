// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/single_diffraction.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/diffraction/thick_edge.h"
#include "sim/scattering/edges/reflected_edge.h"

namespace seaglint {
namespace {

// Corners this near to an edge lie on it: cuts are exact to rounding of the target's size.
constexpr double kOnEdge = 1e-7;  // m
// As kShadow, where before_the_beam() fades out what grows near the boundary of shadow.
constexpr double kShadowOfRim = 0.04;  // rad

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
EdgePattern pattern(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out, double shadow = kShadow) {
  const auto received = [&](const auto& J_h, const auto& J_v) -> std::array<Complex, 4> {
    return {out.E_h.dot(J_h), out.E_h.dot(J_v), out.E_v.dot(J_h), out.E_v.dot(J_v)};
  };
  const auto [J_h, J_v] = edge_currents(wedge, in.direction, {in.E_h, in.E_v}, -out.direction, shadow);
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

// What edge_currents() leaves out is what facets radiate straight to the receiver, of the transmitter's wave: with one
// antenna single diffraction is reciprocal as the mean of both ways; with two antennas only the transmitter's and
// theirs together are Keller's.
EdgePattern direct(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out, bool monostatic) {
  return monostatic ? mean_of_both(wedge, in, out) : pattern(wedge, in, out);
}

// By mirrors that the edge's own field reaches beside the beams that its faces reflect to them, each by its share of
// the whole (reflected_edge.h).
EdgePattern by_the_rim(const WedgeFrame& wedge, const std::array<double, 2>& shares, const EdgeArrival& in,
                       const EdgeArrival& out) {
  EdgePattern answer = pattern(wedge, in, out, kShadowOfRim);
  for (int f = 0; f < 2; ++f) {
    if (shares[f] <= 0) continue;
    const std::array<double, 4> ends = ends_of_beam(wedge.face[f], in, out);
    for (int i = 0; i < 4; ++i) answer.sharp[i] += shares[f] * ends[i];
  }
  return answer;
}

// Where that is not told apart from the beam: what facets radiate straight to the receiver is what the transmitter or
// more mirrors lit. A way with more mirrors on its end is the same way run backwards; ways with as many on either side
// share both.
EdgePattern by_the_beam(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out) {
  if (in.mirrors > out.mirrors) return pattern(wedge, in, out);
  return in.mirrors < out.mirrors ? transposed(pattern(wedge, out, in)) : mean_of_both(wedge, in, out);
}

// By mirrors; nothing where it has faded out ahead of the edge. `both_ways`: the way back through the same arrivals as
// well, of which physical optics has other ends where another facet is the last one, so that only with them hv and vh
// are alike.
std::optional<EdgePattern> by_mirrors(const WedgeFrame& wedge, const EdgeArrival& in, const EdgeArrival& out,
                                      bool both_ways) {
  std::array<double, 2> reflecting = reflecting_shares(wedge, in, out);
  const double by_rim = std::ranges::max(reflecting),
               by_beam = (1 - by_rim) * beside_the_beam(in.direction, -out.direction);
  if (by_rim <= 0 && by_beam <= 0) return std::nullopt;
  EdgePattern answer;
  answer.thickness_m = wedge.thickness_m;
  const auto add = [&](EdgePattern part, double share) {
    part *= share;
    answer += part;
  };
  if (by_rim > 0) {
    for (double& share : reflecting) share /= by_rim;
    add(by_the_rim(wedge, reflecting, in, out), by_rim);
    if (both_ways) add(by_the_rim(wedge, reflecting, out, in), by_rim);
  }
  if (by_beam > 0) {
    const EdgePattern beam = by_the_beam(wedge, in, out);
    add(beam, by_beam);
    if (both_ways) add(transposed(beam), by_beam);
  }
  return answer;
}

}  // namespace

double beside_the_beam(const Vec3& k_hat, const Vec3& s) { return fading(k_hat.dot(s), {0, std::cos(kPi / 6)}); }

double before_the_beam(const Vec3& k_hat, const Vec3& s) { return before_the_beam(k_hat.dot(s)); }
double before_the_beam(double cosine) { return fading(cosine, {0.95, 0.999}); }

void find_arrivals(const SharpEdges& edges, int facet, const WaveOnFacet& wave, std::span<const MovingPolygon> lit,
                   std::vector<EdgeArrival>& arrivals) {
  if (lit.empty()) return;
  for (const PanelEdge& side : edges.of_panel(facet)) {
    if (!side.may_speak(wave.direction)) continue;
    const SharpEdge& edge = edges.edges[side.edge];
    const WedgeFrame* wedge = wedge_towards(edge, wave.direction);
    if (!wedge || !speaks(edge, *wedge, side.first, wave.direction)) continue;
    if (wedge->N < 1 && wave.bounce > 1) continue;  // of a corner the reflections are part of its answer
    const Vec3 image = wave.mirrors.image(edge.a), along = wave.mirrors.L * edge.along();
    for (const Stretch& stretch : lit_stretches(image, along, edge.length(), wave, lit)) {
      arrivals.push_back({side.edge, stretch.s, stretch.slip, image, along, wave.direction, wave.E_h, wave.E_v,
                          static_cast<std::uint8_t>(wave.bounce - 1), wave.first_mirror});
    }
  }
}

void edge_footprints(const SharpEdge& edge, std::span<const Facet> facets, const AntennaPair& antennas,
                     EdgeArrivals incoming, EdgeArrivals outgoing, int max_bounces,
                     std::vector<EdgeFootprint>& footprints) {
  const int most_mirrors = std::min(kMostEdgeMirrors, max_bounces - 1);
  // Of one antenna's two ways by the same arrivals only one is followed: run backwards it has the same path.
  const auto echo = [&](const EdgeArrival& in, const EdgeArrival& out) {
    const bool both_ways = antennas.monostatic && &in != &out;
    const double first = std::max(in.s[0], out.s[0]), last = std::min(in.s[1], out.s[1]);
    if (last - first <= kOnEdge || in.mirrors + out.mirrors > most_mirrors) return;
    const WedgeFrame* wedge = wedge_towards(edge, in.direction);
    if (!wedge || wedge_towards(edge, out.direction) != wedge) return;

    std::optional<EdgePattern> answer;
    if (in.mirrors + out.mirrors > 0) {
      answer = by_mirrors(*wedge, in, out, both_ways);
    } else {
      answer = direct(*wedge, in, out, antennas.monostatic);
      if (both_ways) *answer += transposed(*answer);
    }
    if (!answer) return;

    EdgeFootprint footprint;
    footprint.length = last - first;
    footprint.facet = edge.facet[0];
    footprint.part = facets[edge.facet[0]].part;
    footprint.part_beyond = facets[edge.facet[1]].part;
    footprint.bounces = static_cast<std::uint8_t>(in.mirrors + out.mirrors + 1);
    footprint.pattern = *answer;

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
    footprints.push_back(footprint);
  };

  for (std::size_t a = 0; a < incoming.size(); ++a) {
    for (std::size_t b = antennas.monostatic ? a : 0; b < outgoing.size(); ++b) echo(*incoming[a], *outgoing[b]);
  }
}

}  // namespace seaglint
