// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/multiple_diffraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/coefficients/amplitude_laws.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"
#include "sim/scattering/geometry/look_basis.h"
#include "sim/scattering/scatterer/panels.h"

namespace seaglint {
namespace {

// k l s^2 below which all terms form one amplitude with its derivative; above, where they are small, each has its own
// phase.
constexpr double kMergedLimit = 9;
// Phase of the derivative term per unit of sine: 0.1 rad for an aspect change of 1e-3 rad.
constexpr double kChangePhase = 100;
// hh, hv, vh, vv
using ElementPattern = std::array<double, 4>;

// Response of a wall per area and -jk / 2 pi to a wave along k_hat with fields E_h, E_v.
ElementPattern wall_pattern(const Vec3& n, const RadarBasis& antenna, const Vec3& k_hat, const Vec3& E_h,
                            const Vec3& E_v) {
  const Vec3 J_h = n.cross(k_hat.cross(E_h)), J_v = n.cross(k_hat.cross(E_v));
  return {antenna.h.dot(J_h), antenna.h.dot(J_v), antenna.v.dot(J_h), antenna.v.dot(J_v)};
}

}  // namespace

void append_wall_penumbra(const WallBehindEdge& wall, const RadarBasis& antenna, const ContributionSource& source,
                          const MultipleDiffractionLimits& limits, std::vector<Contribution>& contributions) {
  const double k = limits.k;
  const Vec3 &along = wall.edge_direction, &n = wall.face_normal;
  const std::array<Vec3, 2>& foot = wall.foot;
  const double height = wall.height;
  const Vec3& r = antenna.r;
  const double s = n.dot(r), c = std::sqrt(1 - s * s);
  const Vec3 back = (r - s * n).normalized();  // on the face, from the wall to the edge
  const double weight = smooth_taper(std::abs(s), kPenumbraAngleWindow), length = (foot[1] - foot[0]).norm();
  const double across = back.cross(along).dot(n);
  if (weight <= 0 || wall.wall_normal.dot(back) <= 0 || across == 0) return;
  std::array<double, 2> l;
  for (int end = 0; end < 2; ++end) {
    const double distance = (wall.edge_point - foot[end]).cross(along).dot(n) / across;
    if (distance < -kCoincident) return;
    l[end] = std::max(distance, 0.0);  // edge and foot may meet
  }
  const double mean_distance = 0.5 * (l[0] + l[1]);
  // Slide of an end along the interval as the look direction rotates about the face's normal, m/rad, and the change of
  // the distance to the edge.
  const Vec3 run = (foot[1] - foot[0]) / length, turn = n.cross(back) / c;
  const double slides = -1 / turn.dot(c * run), lengthens = back.dot(along) / across;

  // For the direct wave and its image in the face: soft and hard are half of their difference and of their sum.
  const auto image = [&](const Vec3& x) { return reflect_direction(x, n); };
  const ElementPattern direct = wall_pattern(wall.wall_normal, antenna, -r, antenna.h, antenna.v),
                       by_face =
                           wall_pattern(wall.wall_normal, antenna, image(-r), -image(antenna.h), -image(antenna.v));
  ElementPattern soft, hard;
  for (int i = 0; i < 4; ++i) {
    soft[i] = 0.5 * (direct[i] - by_face[i]);
    hard[i] = 0.5 * (direct[i] + by_face[i]);
  }

  // `rise`: d psi / d sine of the grazing angle, m; a phase delay grows with the distance l.
  const auto append = [&](const ElementPattern& pattern, const WallPenumbraTerm& range, double rise, double slope,
                          double max_amplitude) {
    EdgeInterval interval;
    interval.length = length;
    interval.fresnel_wavenumber = 2 * mean_distance / (height * height);
    interval.amplitude = range;
    ScatteringMatrix value;
    for (int i = 0; i < 4; ++i) value[i] = pattern[i];
    for (int end = 0; end < 2; ++end) {
      interval.psi[end] = 2 * r.dot(foot[end]) - range.psi_decrement * l[end];
      interval.gradient[end] = {};
      interval.gradient[end].transmit = interval.gradient[end].receive =
          foot[end] + 0.5 * (rise - l[end] * slope) * n - 0.5 * l[end] * range.psi_decrement * lengthens * turn;
    }
    const double rate = (interval.psi[1] - interval.psi[0]) / length;
    for (int end = 0; end < 2; ++end) {
      if (!wall.ends_follow_edge[end]) continue;
      interval.gradient[end].transmit_slide = rate * slides * l[end] * turn;
      interval.gradient[end].transmit += interval.gradient[end].transmit_slide;
    }
    const double max = std::abs(*std::ranges::max_element(pattern, {}, [](double x) { return std::abs(x); }));
    const double extent = length / std::max(0.5 * k * std::abs(interval.psi[1] - interval.psi[0]), 1.0);
    if (max * max_amplitude * extent >= limits.min_amplitude_m)
      contributions.emplace_back(Pattern{value}, source, interval);
  };

  const PenumbraWeights weights = penumbra_weights(s);
  const double ahead = weights.edge_path;
  // Already radiated by the wall's image, which ends at the line.
  const double by_image = wall.image_weight;
  const double at_end = 1 / (4 * kPi * std::abs(s)),
               by_path = std::min(at_end, std::sqrt(k * std::max(l[0], l[1]) / kPi) / (2 * kPi));
  const double at_foot = s > 0 ? weight * (weights.foot + by_image) : 0, at_line = s > 0 ? -weight * by_image : weight;
  WallPenumbraTerm range;
  range.l = l;
  range.sine = s;
  if (k * std::max(l[0], l[1]) * s * s < kMergedLimit) {
    range.derivative_scale_m = kChangePhase / k;
    for (const bool is_soft : {false, true}) {
      range.soft = is_soft;
      range.foot_weight = at_foot;
      range.shadow_line_weight = at_line;
      range.edge_path_weight = weight * (is_soft ? 1 : ahead);
      range.part = WallPenumbraTerm::Part::kValue;
      append(is_soft ? soft : hard, range, 0, 0, 4 * by_path);
      range.part = WallPenumbraTerm::Part::kDerivative;
      append(is_soft ? soft : hard, range, range.derivative_scale_m, 0, 4 * by_path);
    }
    return;
  }
  range.edge_path_weight = 0;
  range.foot_weight = at_foot;
  range.shadow_line_weight = 0;
  append(direct, range, 0, 0, at_end);
  range.foot_weight = 0;
  range.shadow_line_weight = at_line;
  range.psi_decrement = 2 * s * s / c;
  append(direct, range, 0, (4 * s + 2 * s * s * s / (c * c)) / c, at_end);
  range.shadow_line_weight = 0;
  range.psi_decrement = 2 * (1 - c);
  for (const bool is_soft : {false, true}) {
    range.soft = is_soft;
    range.edge_path_weight = weight * (is_soft ? 1 : ahead);
    append(is_soft ? soft : hard, range, 0, 2 * s / c, by_path);
  }
}

namespace {

// Relative first-order change of a grazing wave by the thickness of the sheets whose edges it met: the sum over these
// edges.
struct ThicknessChange {
  FirstOrderThickness<Complex> change;
  double thickness_m = 0;  // 0: no sheet has a thickness
};

ThicknessChange with_edge(ThicknessChange thickness, const WedgeFrame& wedge, const Vec3& towards) {
  if (wedge.thickness_m <= 0) return thickness;
  const FirstOrderThickness<Complex> more = thick_edge_wave_change(wedge, towards);
  return {{thickness.change.constant + more.constant, thickness.change.logarithm + more.logarithm}, wedge.thickness_m};
}

// A wave incident on an interval of an edge. psi and its gradient are linear along the interval.
struct EdgeIncidentWave {
  int edge = kNoEdge;
  std::array<double, 2> s{};    // m from the edge's start
  std::array<double, 2> psi{};  // minus the path so far, m
  std::array<Vec3, 2> X;        // gradient of psi with the transmit direction, m
  Vec3 direction;
  std::array<Vec3, 2> E;                                // for transmitted h and v
  std::array<Complex, 2> factor{1.0, 1.0};              // of E
  std::array<double, 2> l{};                            // length of this grazing wave at the ends of the interval, m
  double departure = 0;                                 // transition_parameter() where it starts
  std::array<double, kMaxGrazingWaves - 1> detour_m{};  // GrazingWaveAmplitude::detour_m
  ThicknessChange thickness{};                          // of the edges met before
  int grazing_waves = 0;                                // along the face, before
  int wall_reflections = 0;                             // of this grazing wave at perpendicular walls
  // maps directions behind those walls, or behind the other wall of a concave edge, to image space
  Mat3 unfolding = Mat3::Identity();
  Vec3 previous_direction = Vec3::Zero();  // of the wave at the previous edge
  bool met_concave_edge = false;           // among the edges before
};

// A strip of parallel rays on a face: u transverse, w along the rays, both unit vectors in the face.
struct RayStrip {
  Vec3 u, w;
  double from, to;  // in u, m
};

// Mean of 1/sqrt(l) for l linear between its ends.
double mean_inverse_sqrt_length(const std::array<double, 2>& l) { return 2 / (std::sqrt(l[0]) + std::sqrt(l[1])); }

// The wave on a part of its interval, fractions `from` to `to`.
EdgeIncidentWave sub_interval(const EdgeIncidentWave& in, double from, double to) {
  EdgeIncidentWave part = in;
  part.s = {interpolate(in.s, from), interpolate(in.s, to)};
  part.psi = {interpolate(in.psi, from), interpolate(in.psi, to)};
  part.X = {interpolate(in.X, from), interpolate(in.X, to)};
  part.l = {interpolate(in.l, from), interpolate(in.l, to)};
  return part;
}

// A grazing wave where it leaves an edge along a face; after a perpendicular wall it leaves the edge's image.
struct GrazingSource {
  const EdgeIncidentWave& in;
  const WedgeFace& face;
  Vec3 start, along;  // of the edge
  std::array<Complex, 2> amplitude;
  double departure = 0;            // transition_parameter() at the edge
  ThicknessChange thickness = {};  // including the edge's own
  int wall_reflections = 0;
  Mat3 unfolding = Mat3::Identity();
  bool met_concave_edge = false;  // including the edge it leaves
};

// Reflection of directions in a plane with unit normal n.
Mat3 householder(const Vec3& n) { return Mat3::Identity() - outer_product(2 * n, n); }

constexpr double kNarrowest = 1e-9;  // m
// Sine of the angle between a grazing wave and an edge below which they do not meet. Look directions that would make
// them parallel are perturbed by more (transmitted_wave.cpp).
constexpr double kParallelSine = 1e-9;
// Sine of the angle between an edge and the wave it launches along a face: for an incident wave from outside, and for a
// grazing wave.
constexpr double kMinLaunchSine = 1e-6, kMinRelaunchSine = 1e-5;

// A grazing wave that is relaunched enters by its mean amplitude over parts of its interval along which its length
// grows by at most kMaxGrowth. Lengths below kShortestShare of the longest count as that.
constexpr double kMaxGrowth = 4, kShortestShare = 0.01;

// Bound of |second_edge_current| in direction s, times 1 - s.w; the maximum on the ship is 0.37.
constexpr double kMaxCurrent = 0.5;
constexpr double kNoField = 1e-9;  // relative to the incident field

// Perpendicular walls between two edges, as in a right-angled corner reflector. A wave via walls is not relaunched:
// near grazing, where the third order matters, contributions via walls are tapered to zero.
constexpr int kMaxWallReflections = 2;

// Multiple diffraction with reflections on the incident or exit path is omitted: it is weaker than the uncertainty of
// PO there.
bool is_reflected(const EdgeIllumination& illumination) { return illumination.reflections > 0; }

// Direction of a grazing wave along w, tilted towards the face.
Vec3 grazing(const WedgeFace& face, const Vec3& w) { return (w - kInPlaneAngle * face.n).normalized(); }

// 1 - s.w, kept positive.
double one_minus_cosine(const Vec3& w, const Vec3& s) { return std::max(0.5 * (s - w).squaredNorm(), 1e-15); }

class MultipleDiffractionTracer {
 public:
  MultipleDiffractionTracer(const GrazingWaves& scene, std::vector<Contribution>& out)
      : edges_(scene.scatterer.edges()),
        facets_(scene.scatterer.facets()),
        panels_(scene.scatterer.panels()),
        geometry_(scene.geometry),
        wavenumbers_(scene.wavenumbers),
        outgoing_(scene.outgoing),
        limits_(scene.limits),
        out_(out) {
    for (std::size_t waves = 1; waves < spread_.size(); ++waves)
      spread_[waves] = spread_[waves - 1] / std::sqrt(limits_.k);
  }

  void launch(const EdgeIllumination& illumination) {
    EdgeIncidentWave in{
        illumination.edge, illumination.s, {}, {}, illumination.direction, {illumination.E_h, illumination.E_v}};
    for (int end = 0; end < 2; ++end) {
      in.X[end] = illumination.image_start + illumination.s[end] * illumination.image_edge_direction;
      in.psi[end] = geometry_.transmit.r.dot(in.X[end]);
    }
    launch(in);
  }

 private:
  // Relaunches a grazing wave, part by part of its interval.
  void relaunch(const EdgeIncidentWave& in) {
    const auto [shortest, longest] = std::minmax(in.l[0], in.l[1]);
    const double first = std::max(shortest, kShortestShare * longest), growth = longest / first;
    const int parts = std::max(1, static_cast<int>(std::ceil(std::log(growth) / std::log(kMaxGrowth))));
    double before = 0;  // fraction of the interval, from the end where l is shortest
    for (int n = 1; n <= parts; ++n) {
      const double here =
          n < parts ? (first * std::pow(growth, static_cast<double>(n) / parts) - shortest) / (longest - shortest)
                    : 1.0;
      launch(in.l[0] < in.l[1] ? sub_interval(in, before, here) : sub_interval(in, 1 - here, 1 - before));
      before = here;
    }
  }

  void launch(const EdgeIncidentWave& in) {
    const SharpEdge& edge = edges_.edges[in.edge];
    if (edge.collinear_length_m < limits_.min_run_m) return;
    const WedgeFrame* wedge = illuminated_wedge(edge, in.direction);
    if (!wedge) return;
    const ThicknessChange thickness = with_edge(in.thickness, *wedge, -in.direction);
    const double decay = in.grazing_waves > 0 ? mean_inverse_sqrt_length(in.l) : 1.0;
    for (int i = 0; i < 2; ++i) {
      const GrazingDiffractedWave wave = grazing_diffracted_wave(*wedge, i, in.direction, in.E);
      const GrazingSource source{
          in,
          wedge->face[i],
          edge.a,
          edge.along(),
          {wave.amplitude[0] * decay * in.factor[0], wave.amplitude[1] * decay * in.factor[1]},
          wave.launch_parameter,
          thickness,
          0,
          wedge->N < 1 && in.grazing_waves == 0 ? householder(wedge->face[1 - i].n) : in.unfolding,
          in.met_concave_edge || wedge->N < 1};
      if (!is_significant(source)) continue;
      // Below a right angle a concave edge also radiates the field of the grazing wave (E along the normal) back along
      // the same face as a ray, without which the diffracted field is incomplete: both are omitted.
      if (wedge->N < 0.5 && in.grazing_waves > 0 && source.face.n.dot(in.E[0]) > 1 - kFlat) continue;
      RayStrip strip{wave.direction.cross(source.face.n), wave.direction, 0, 0};
      // Parallel to the edge: a grazing wave that meets an edge nearly so is the wave that continues beside it; as a
      // ray from that edge it would have the pole without the zero.
      if (std::abs(strip.u.dot(source.along)) < (in.grazing_waves > 0 ? kMinRelaunchSine : kMinLaunchSine)) continue;
      const double a = strip.u.dot(edge.a + in.s[0] * source.along), b = strip.u.dot(edge.a + in.s[1] * source.along);
      strip.from = std::min(a, b);
      strip.to = std::max(a, b);
      const int facet = edge.facet[i];
      int side = 0;
      while (side < 2 && edges_.edges_of_facet[facet][side] != in.edge) ++side;
      traverse_facet(source, facet, side, strip, 0);
    }
  }

  // Equivalent current of an edge for a grazing wave of unit incident field along w: its fringe current, and the end of
  // the first edge's current beyond it, J = 2 n x H = 2 w / eta, integrated along w.
  static Vec3 second_edge_current(const WedgeFrame& wedge, const WedgeFace& face, const Vec3& along, const Vec3& w,
                                  const Vec3& s) {
    return fringe_current(wedge, grazing(face, w), face.n, s) +
           w.cross(along).norm() / (2 * kPi * one_minus_cosine(w, s)) * w;
  }

  // Follows a strip that enters a facet through one of its sides.
  void traverse_facet(const GrazingSource& source, int number, int entered, const RayStrip& strip, int depth) {
    constexpr int kDeepest = 1000;  // facets of one face
    if (strip.to - strip.from < kNarrowest || depth > kDeepest) return;
    const Facet& facet = facets_[number];
    const double split = strip.u.dot(facet.corner[(entered + 2) % 3]);
    for (const int side : {(entered + 1) % 3, (entered + 2) % 3}) {
      // Part of the strip that leaves through this side, between the third vertex and one of the side of entry.
      const double other = strip.u.dot(facet.corner[side == (entered + 1) % 3 ? side : entered]);
      RayStrip part = strip;
      part.from = std::max(strip.from, std::min(split, other));
      part.to = std::min(strip.to, std::max(split, other));
      if (part.to - part.from < kNarrowest) continue;
      const int edge = edges_.edges_of_facet[number][side];
      if (edge != kNoEdge && !edges_.edges[edge].conducts) continue;
      if (edge != kNoEdge && is_perpendicular_wall(edges_.edges[edge], source.face.n)) {
        reflect(source, number, side, edges_.edges[edge], part, depth);
      } else if (edge != kNoEdge) {
        diffract(source, edge, part);
      } else if (const int next = facet.neighbour[side]; next >= 0) {
        const Facet& neighbour = facets_[next];
        if (std::abs(neighbour.normal.dot(facet.normal)) < 1 - kFlat) continue;
        const Vec3& p = facet.corner[side];
        int k = 0;
        while (k < 3 && neighbour.corner[k] != p) ++k;
        if (k == 3) continue;
        // The common side starts or ends at p in the neighbour.
        const Vec3& q = facet.corner[(side + 1) % 3];
        const int common = neighbour.corner[(k + 1) % 3] == q ? k : (k + 2) % 3;
        traverse_facet(source, next, common, part, depth + 1);
      }
    }
  }

  // True for the foot of a wall perpendicular to the face with normal n, on its side.
  static bool is_perpendicular_wall(const SharpEdge& edge, const Vec3& n) {
    const auto faces = [&](const WedgeFrame& wedge) {
      return wedge.face[0].n.dot(n) > 0.5 || wedge.face[1].n.dot(n) > 0.5;
    };
    const auto right = [](const WedgeFrame& wedge) { return std::abs(wedge.N - 0.5) < kFlat; };
    return faces(edge.front_wedge) ? right(edge.front_wedge)
                                   : edge.two_sided && faces(edge.back_wedge) && right(edge.back_wedge);
  }

  // Reflects the strip at a perpendicular wall back over the facet. The electric field is normal to the face,
  // tangential to the wall, and changes sign.
  void reflect(const GrazingSource& source, int facet, int side, const SharpEdge& foot, const RayStrip& strip,
               int depth) {
    if (source.wall_reflections >= kMaxWallReflections || source.in.grazing_waves > 0) return;
    const Vec3 n = source.face.n.cross(foot.along());  // of the wall
    if (source.wall_reflections == 0 && geometry_.monostatic) add_wall_penumbra(source, facet, foot, n, strip);
    const Mat3 reflection = householder(n);
    const Vec3 shift = 2 * n.dot(foot.a) * n;
    const GrazingSource image{source.in,
                              source.face,
                              reflection * source.start + shift,
                              reflection * source.along,
                              {-source.amplitude[0], -source.amplitude[1]},
                              source.departure,
                              source.thickness,
                              source.wall_reflections + 1,
                              source.unfolding * reflection,
                              source.met_concave_edge};
    const Vec3 u = reflection * strip.u;
    traverse_facet(image, facet, side, {u, reflection * strip.w, strip.from + u.dot(shift), strip.to + u.dot(shift)},
                   depth + 1);
  }

  // Adds the penumbra terms of the wall; `floor`: a facet of the edge's face at the foot of the wall.
  void add_wall_penumbra(const GrazingSource& source, int floor, const SharpEdge& foot, const Vec3& n,
                         const RayStrip& strip) {
    WallBehindEdge wall{source.start, source.along, source.face.n, n.dot(strip.w) < 0 ? n : Vec3(-n), 0, 0, {}};
    for (int end = 0; end < 2; ++end) {
      const double u = end == 0 ? strip.from : strip.to;
      wall.foot[end] = foot.a + (u - strip.u.dot(foot.a)) / strip.u.dot(foot.along()) * foot.along();
      const double s = (u - strip.u.dot(source.start)) / strip.u.dot(source.along);
      wall.ends_follow_edge[end] = s - source.in.s[0] < kCoincident || source.in.s[1] - s < kCoincident;
    }
    const auto panel_of = [&](int facet) {
      return ReflectorPanel{facets_[facet].normal, panels_.outline(panels_.representative(facet))};
    };
    for (const int facet : foot.facet) {
      if (std::abs(facets_[facet].normal.dot(n)) < 1 - kFlat) continue;
      wall.image_weight = image_weight(geometry_.transmit.r, panel_of(floor), panel_of(facet));
      for (const Vec3& x : panels_.outline(panels_.representative(facet)))
        wall.height = std::max(wall.height, source.face.n.dot(x - foot.a));
    }
    if (wall.height < kCoincident) return;
    const ContributionSource source_of_foot{foot.facet[0], facets_[foot.facet[0]].part, facets_[foot.facet[1]].part, 2,
                                            Mechanism::kWallPenumbra};
    append_wall_penumbra(wall, geometry_.transmit, source_of_foot, limits_, out_);
  }

  void diffract(const GrazingSource& source, int number, const RayStrip& strip) {
    const EdgeIncidentWave& in = source.in;
    const SharpEdge& edge = edges_.edges[number];
    const Vec3& along = edge.along();
    const double across = strip.u.dot(along);
    if (edge.collinear_length_m < limits_.min_run_m || std::abs(across) < kParallelSine) return;
    const WedgeFrame* wedge = illuminated_wedge(edge, grazing(source.face, strip.w));
    if (!wedge) return;
    // Interval of this edge that the strip meets, and the wave on it; the rays come from the first edge without
    // crossing.
    const auto place = [&](double u) { return (u - strip.u.dot(edge.a)) / across; };
    EdgeIncidentWave next = in;
    next.edge = number;
    next.s = {std::min(place(strip.from), place(strip.to)), std::max(place(strip.from), place(strip.to))};
    next.direction = grazing(source.face, strip.w);
    next.E = {source.face.n, source.face.n};
    ++next.grazing_waves;
    next.wall_reflections = source.wall_reflections;
    next.unfolding = source.unfolding;
    next.previous_direction = in.direction;
    next.thickness = source.thickness;
    for (int end = 0; end < 2; ++end) {
      const Vec3 Q2 = edge.a + next.s[end] * along;
      const double s1 = strip.u.dot(Q2 - source.start) / strip.u.dot(source.along);
      const double fraction = (s1 - in.s[0]) / (in.s[1] - in.s[0]);
      next.l[end] = std::max(0.0, strip.w.dot(Q2 - source.start - s1 * source.along));
      next.psi[end] = interpolate(in.psi, fraction) - next.l[end];
      next.X[end] = interpolate(in.X, fraction);
    }
    if (mean_inverse_sqrt_length(next.l) > 2e4) return;
    next.met_concave_edge = source.met_concave_edge;
    next.departure = source.departure;
    if (in.grazing_waves > 0)
      next.detour_m[in.grazing_waves - 1] = 2 * in.departure / std::pow(mean_inverse_sqrt_length(in.l), 2);
    for (int q = 0; q < 2; ++q) next.factor[q] = 0.5 * source.amplitude[q];  // half of the total field is incident
    // A path that ends at a concave edge is the reciprocal of one that starts there.
    if (wedge->N > 1) {
      for (const EdgeIllumination* departure : outgoing_.of(number))
        radiate_towards(next, *wedge, source.face, strip.w, *departure);
    }
    if (next.grazing_waves < kMaxGrazingWaves && edge.collinear_length_m >= limits_.min_run_high_order_m &&
        next.wall_reflections == 0)
      relaunch(next);
  }

  // True when the wave launched along a face can reach min_amplitude_m: evaluated for a next edge with constant phase
  // and a diffraction coefficient of one. The omitted waves of the ship sum to -89 dB.
  bool is_significant(const GrazingSource& source) const {
    const EdgeIncidentWave& in = source.in;
    const double fields = std::abs(source.amplitude[0]) + std::abs(source.amplitude[1]);
    if (in.grazing_waves == 0) return fields > kNoField;
    return fields * spread_[in.grazing_waves + 1] * std::sqrt(in.s[1] - in.s[0]) > limits_.min_amplitude_m;
  }

  // True when a contribution can reach min_amplitude_m, for a phase rate `rate` along an interval of that length:
  // transition functions are at most 1 and at most sqrt(pi x).
  bool is_significant(const EdgeIncidentWave& in, const Vec3& w, const Vec3& s, double arrival, double rate,
                      double length) const {
    const double fields = std::abs(in.factor[0]) + std::abs(in.factor[1]);
    const double shadow = std::min(in.departure, arrival);
    const double decay = std::min(1 / std::sqrt(std::min(in.l[0], in.l[1])), std::sqrt(2 * kPi * limits_.k * shadow));
    const double extent = length / std::max(limits_.k * std::abs(rate) * length, 1.0);
    return fields * kMaxCurrent / one_minus_cosine(w, s) * spread_[in.grazing_waves] * decay * extent >=
           limits_.min_amplitude_m;
  }

  // Appends the contribution of a grazing wave that leaves by an exit path of the same edge.
  void radiate_towards(const EdgeIncidentWave& in, const WedgeFrame& wedge, const WedgeFace& face, const Vec3& w,
                       const EdgeIllumination& departure) {
    const SharpEdge& edge = edges_.edges[in.edge];
    if (is_reflected(departure) || illuminated_wedge(edge, departure.direction) != &wedge) return;
    const std::array<double, 2> s{std::max(in.s[0], departure.s[0]), std::min(in.s[1], departure.s[1])};
    if (s[1] - s[0] < kCoincident) return;
    const double tapered = grazing_wave_weight(in.previous_direction, in.unfolding * -departure.direction);
    double weight = in.wall_reflections > 0 ? tapered : 1.0;
    // For one antenna a wave that starts at a concave edge includes its reciprocal, which ends there.
    if (in.met_concave_edge && in.grazing_waves == 1 && geometry_.monostatic) weight += tapered;
    if (weight <= 0) return;
    const Vec3& along = edge.along();
    const Vec3 out = -departure.direction;
    const double arrival = transition_parameter(w, out);
    const double rate =
        (in.psi[1] - in.psi[0]) / (in.s[1] - in.s[0]) + geometry_.receive.r.dot(departure.image_edge_direction);
    if (!is_significant(in, w, out, arrival, rate, s[1] - s[0])) return;
    EdgeInterval interval;
    interval.length = s[1] - s[0];
    GrazingWaveAmplitude range;
    for (int end = 0; end < 2; ++end) {
      const double fraction = (s[end] - in.s[0]) / (in.s[1] - in.s[0]);
      const Vec3 Y = departure.image_start + s[end] * departure.image_edge_direction;
      interval.psi[end] = interpolate(in.psi, fraction) + geometry_.receive.r.dot(Y);
      interval.gradient[end].transmit = interpolate(in.X, fraction);
      interval.gradient[end].receive = Y;
      range.l[end] = interpolate(in.l, fraction);
    }
    range.launch_parameter = in.departure;
    range.exit_parameter = arrival;
    range.detour_m = in.detour_m;
    range.grazing_waves = in.grazing_waves;
    interval.amplitude = range;
    const Vec3 J = weight * second_edge_current(wedge, face, along, w, out);
    const double h = departure.E_h.dot(J), v = departure.E_v.dot(J);
    Pattern pattern{{h * in.factor[0], h * in.factor[1], v * in.factor[0], v * in.factor[1]}};
    const ThicknessChange thickness = with_edge(in.thickness, wedge, out);
    for (const double k : thickness.thickness_m > 0 ? wavenumbers_ : std::span<const double>()) {
      const double kt = k * thickness.thickness_m;
      const Complex change = 1.0 + kt * (thickness.change.constant + std::log(kt) * thickness.change.logarithm);
      ScatteringMatrix& thick = pattern.at_node.emplace_back(pattern.value);
      for (Complex& element : thick) element *= change;
    }
    const ContributionSource source{edge.facet[0], facets_[edge.facet[0]].part, facets_[edge.facet[1]].part,
                                    static_cast<std::uint8_t>(in.wall_reflections + in.grazing_waves + 1),
                                    in.met_concave_edge ? Mechanism::kConcaveEdge : Mechanism::kMultipleDiffraction};
    out_.emplace_back(std::move(pattern), source, interval);
  }

  const SharpEdges& edges_;
  std::span<const Facet> facets_;
  const Panels& panels_;
  const BistaticGeometry& geometry_;
  std::span<const double> wavenumbers_;
  const IlluminationByEdge& outgoing_;
  MultipleDiffractionLimits limits_;
  std::vector<Contribution>& out_;
  std::array<double, kMaxGrazingWaves + 1> spread_{1.0};  // k^(-waves / 2), m^(waves / 2)
};

}  // namespace

void trace_multiple_diffraction(const GrazingWaves& scene, EdgeIlluminations incoming,
                                std::vector<Contribution>& contributions) {
  MultipleDiffractionTracer waves(scene, contributions);
  for (const EdgeIllumination* in : incoming) {
    if (!is_reflected(*in)) waves.launch(*in);
  }
}

}  // namespace seaglint
