// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edge_waves.h"

#include <algorithm>
#include <cmath>

#include "sim/core/constants.h"

namespace seaglint {
namespace {

// Mirrors on both ways together: edge waves are weak, by mirrors they are weaker than what physical optics itself is uncertain by there.
constexpr int kMostMirrors = 0;
// Facets that turn by less than this are one flat face: an edge wave leaves a curved one.
constexpr double kFlat = 1e-6;
constexpr double kShortest = 1e-7;  // m
// A grazing wave is sent down on its face by this angle, so that rounding does not put it on the other side.
constexpr double kLift = 1e-7;

// A strip of parallel rays on a face: u across them, w along.
struct Strip {
  Vec3 u, w;
  double from, to;  // in u
};

class EdgeWaves {
 public:
  EdgeWaves(const SharpEdges& edges, std::span<const Facet> facets, const AntennaPair& antennas, std::span<const EdgeArrival> outgoing,
            std::vector<EdgeFootprint>& out)
      : edges_(edges), facets_(facets), antennas_(antennas), outgoing_(outgoing), out_(out), first_(edges.edges.size() + 1, 0) {
    for (const EdgeArrival& arrival : outgoing) ++first_[arrival.edge + 1];
    for (std::size_t e = 1; e < first_.size(); ++e) first_[e] += first_[e - 1];
  }

  void send(const EdgeArrival& in) {
    const SharpEdge& edge = edges_.edges[in.edge];
    const WedgeFrame* wedge = wedge_towards(edge, in.direction);
    if (!wedge) return;
    in_ = &in;
    start_ = edge.a;
    for (int i = 0; i < 2; ++i) {
      face_ = &wedge->face[i];
      const EdgeWave h = edge_wave(*wedge, i, in.direction, in.E_h), v = edge_wave(*wedge, i, in.direction, in.E_v);
      amplitude_h_ = h.amplitude;
      amplitude_v_ = v.amplitude;
      if (std::abs(amplitude_h_) + std::abs(amplitude_v_) < 1e-9) continue;
      Strip strip{h.direction.cross(face_->n), h.direction, 0, 0};
      along_ = (edge.b - edge.a).normalized();
      if (std::abs(strip.u.dot(along_)) < 1e-6) continue;  // it runs along the edge itself
      const double a = strip.u.dot(start_ + in.s[0] * along_), b = strip.u.dot(start_ + in.s[1] * along_);
      strip.from = std::min(a, b);
      strip.to = std::max(a, b);
      const int facet = edge.facet[i];
      int side = 0;
      while (side < 2 && edges_.of_facet[facet][side] != in.edge) ++side;
      cross(facet, side, strip, 0);
    }
  }

 private:
  // What an edge makes of a grazing wave of unit incident field along w: its fringe current, and the end of the current that the first edge alone
  // would send on along w beyond it: J = 2 n x H = 2 w / eta there, integrated along w.
  CVec3 diffracted(const WedgeFrame& wedge, const Vec3& along, const Vec3& w, const Vec3& s) const {
    const Vec3 grazing = (w - kLift * face_->n).normalized();
    const double opening = std::max(1 - s.dot(w), 1e-9);
    return edge_current(wedge, grazing, face_->n, s) + Complex(w.cross(along).norm() / (2 * kPi * opening)) * w;
  }

  // Follows the strip that enters a facet by one of its sides.
  void cross(int number, int entered, const Strip& strip, int depth) {
    constexpr int kDeepest = 1000;  // facets of one face in a row
    if (strip.to - strip.from < kShortest || depth > kDeepest) return;
    const Facet& facet = facets_[number];
    const double split = strip.u.dot(facet.corner[(entered + 2) % 3]);
    for (const int side : {(entered + 1) % 3, (entered + 2) % 3}) {
      // What of the strip leaves by this side, which runs between the third corner and one of the side it came in by.
      const double other = strip.u.dot(facet.corner[side == (entered + 1) % 3 ? side : entered]);
      Strip part = strip;
      part.from = std::max(strip.from, std::min(split, other));
      part.to = std::min(strip.to, std::max(split, other));
      if (part.to - part.from < kShortest) continue;
      const int edge = edges_.of_facet[number][side];
      if (edge != kNoEdge) {
        diffract(edge, part);
      } else if (const int next = facet.neighbour[side]; next >= 0) {
        const Facet& neighbour = facets_[next];
        if (std::abs(neighbour.normal.dot(facet.normal)) < 1 - kFlat) continue;
        const Vec3& p = facet.corner[side];
        int k = 0;
        while (k < 3 && neighbour.corner[k] != p) ++k;
        if (k == 3) continue;
        // The common side runs from p or to p in the neighbour.
        const Vec3& q = facet.corner[(side + 1) % 3];
        const int common = neighbour.corner[(k + 1) % 3] == q ? k : (k + 2) % 3;
        cross(next, common, part, depth + 1);
      }
    }
  }

  void diffract(int number, const Strip& strip) {
    const SharpEdge& edge = edges_.edges[number];
    const Vec3 along = (edge.b - edge.a).normalized();
    const double across = strip.u.dot(along);
    if (std::abs(across) < 1e-6) return;
    const WedgeFrame* wedge = wedge_towards(edge, strip.w - kLift * face_->n);
    if (!wedge) return;
    for (std::size_t o = first_[number]; o < first_[number + 1]; ++o) {
      const EdgeArrival& departure = outgoing_[o];
      if (in_->mirrors + departure.mirrors > kMostMirrors || wedge_towards(edge, departure.direction) != wedge) continue;
      // The stretch of the second edge that the strip and the departure share.
      const auto place = [&](double u) { return (u - strip.u.dot(edge.a)) / across; };
      const double first = std::max(std::min(place(strip.from), place(strip.to)), departure.s[0]);
      const double last = std::min(std::max(place(strip.from), place(strip.to)), departure.s[1]);
      if (last - first < kShortest) continue;

      EdgeFootprint footprint;
      footprint.length = last - first;
      footprint.facet = edge.facet[0];
      footprint.part = facets_[edge.facet[0]].part;
      footprint.bounces = static_cast<std::uint8_t>(in_->mirrors + departure.mirrors + 2);
      double root_sum = 0;
      for (int end = 0; end < 2; ++end) {
        const Vec3 Q2 = edge.a + (end == 0 ? first : last) * along;
        const double s1 = (strip.u.dot(Q2 - start_)) / strip.u.dot(along_);
        const Vec3 Q1 = start_ + s1 * along_;
        const double l = std::max(strip.w.dot(Q2 - Q1), 0.0);
        root_sum += std::sqrt(l);
        const Vec3 X = in_->image + s1 * in_->image_along;
        const Vec3 Y = departure.image + (end == 0 ? first : last) * departure.image_along;
        footprint.psi[end] = antennas_.transmit.r.dot(X) - l + antennas_.receive.r.dot(Y);
        footprint.gradient[end] = {X, Y};
      }
      if (root_sum < 1e-4) continue;
      const double l = 0.25 * root_sum * root_sum;
      footprint.edge_wave = {l * shadow_distance(along_, strip.w, in_->direction), l * shadow_distance(along, strip.w, -departure.direction)};
      // l is linear along the stretch: the mean of 1/sqrt(l) is 2 / (sqrt(l_0) + sqrt(l_1)). Half of the wave is incident.
      const double spread = 0.5 * 2 / root_sum;
      const CVec3 J = diffracted(*wedge, along, strip.w, -departure.direction);
      const auto received = [&](const Vec3& E) { return E.cast<Complex>().cwiseProduct(J).sum() * spread; };
      const Complex h = received(departure.E_h), v = received(departure.E_v);
      footprint.pattern = {h * amplitude_h_, h * amplitude_v_, v * amplitude_h_, v * amplitude_v_};
      out_.push_back(footprint);
    }
  }

  const SharpEdges& edges_;
  std::span<const Facet> facets_;
  const AntennaPair& antennas_;
  std::span<const EdgeArrival> outgoing_;
  std::vector<EdgeFootprint>& out_;
  std::vector<std::size_t> first_;  // departure of each edge
  const EdgeArrival* in_ = nullptr;
  const WedgeFace* face_ = nullptr;
  Vec3 start_, along_;  // of the first edge
  Complex amplitude_h_, amplitude_v_;
};

}  // namespace

std::vector<EdgeFootprint> edge_wave_footprints(const SharpEdges& edges, std::span<const Facet> facets, const AntennaPair& antennas,
                                                std::span<const EdgeArrival> incoming, std::span<const EdgeArrival> outgoing) {
  std::vector<EdgeFootprint> result;
  EdgeWaves waves(edges, facets, antennas, outgoing, result);
  for (const EdgeArrival& in : incoming) {
    if (in.mirrors <= kMostMirrors) waves.send(in);
  }
  return result;
}

}  // namespace seaglint
