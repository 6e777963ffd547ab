// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/points/decomposition.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/radiation/surface_radiation.h"

namespace seaglint {
namespace {

// -jk / 2 pi
Complex radiation_factor(double k) { return {0, -k / (2 * kPi)}; }

// A point of the contribution without its place and amplitude.
Point point_of(const Contribution& contribution, const PointBand& at) {
  const std::size_t nodes = at.band.nodes().size();
  const std::vector<ScatteringMatrix>& at_node = contribution.pattern.at_node;
  Point point;
  point.source = contribution.source;
  if (at_node.empty() || nodes == 1) {
    point.pattern = contribution.pattern.at(at.first_node);
  } else {
    point.at_node = std::span(at_node).subspan(at.first_node, nodes);
  }
  return point;
}

// Appends the points of one contribution.
class PointWriter {
 public:
  PointWriter(const Contribution& contribution, const PointBand& at, std::vector<Point>& out)
      : point_(point_of(contribution, at)), band_(at.band), out_(out) {}

  // amplitude(k): without the phase e^{jk psi}, m.
  template <typename Amplitude>
  void add(const Amplitude& amplitude, double psi, const PathGradient& gradient) {
    Point& point = out_.emplace_back(point_);
    for (std::size_t n = 0; n < band_.nodes().size(); ++n) point.amplitude[n] = amplitude(band_.nodes()[n]);
    point.psi = psi;
    point.gradient = gradient;
  }

 private:
  Point point_;
  const FrequencyBand& band_;
  std::vector<Point>& out_;
};

// The form is that at the wavenumber k; it is exact at every node.
class FlatDecomposer {
 public:
  FlatDecomposer(const Footprint& footprint, const RadarBasis& transmit, const PointBand& at, double k,
                 double threshold, PointWriter& writer)
      : footprint_(footprint),
        transmit_(transmit),
        is_closed_form_(at.is_single()),
        k_(k),
        threshold_(threshold),
        writer_(writer) {}

  void run() {
    // End points require a phase of a good part of a cycle. The whole panel determines this, not the polygon: polygons
    // with a common moving boundary must be treated equally, or its two sides do not cancel.
    const double half_phase = k_ * footprint_.psi_slope * footprint_.panel_size / 2;
    if (!is_closed_form_ && footprint_.psi_slope > threshold_ && half_phase > kMaxHalfPhase) {
      sides();
    } else {
      area(footprint_.polygon);
    }
  }

 private:
  // `integral`: phase integral without the phase e^{jk psi} as a function of k, m^2.
  template <typename Integral>
  void add(const Integral& integral, double psi, const PathGradient& gradient) {
    writer_.add([&](double k) { return radiation_factor(k) * integral(k); }, psi, gradient);
  }

  // Divides the polygon into pieces with a slowly varying integral, each a point at its centroid.
  void area(const MovingPolygon& polygon) {
    const Vec2 c = centroid(polygon);
    // Cut across the longest extent; the phase that counts is that of w and of its change over the aspect change.
    double longest = 0;
    Vec2 along = Vec2::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      for (std::size_t j = i + 1; j < polygon.size(); ++j) {
        const Vec2 d = polygon[j].p - polygon[i].p;
        if (footprint_.surface_length(d) > longest) {
          longest = footprint_.surface_length(d);
          along = d;
        }
      }
    }
    const double slope = std::max(footprint_.psi_slope, kMaxAmplitudeError * threshold_);
    if (!is_closed_form_ && k_ * slope * longest / 2 > kMaxHalfPhase && longest > 1e-6) {
      MovingLine line;  // through the centroid, normal to the longest extent on the panel; at rest
      const Vec2& rise = footprint_.plane.slope;
      line.gradient = (along + rise.dot(along) * rise).normalized();
      line.value = -line.gradient.dot(c);
      const auto [far, near] = split_by_line(polygon, line);
      if (!near.empty() && !far.empty() && near.size() + far.size() > polygon.size()) {
        area(near);
        area(far);
        return;
      }
    }
    const double psi = footprint_.psi(c);
    add([&](double k) { return flat_phase_integral(footprint_, polygon, k) * std::polar(1.0, -k * psi); }, psi,
        phase_gradient(footprint_, c, transmit_));
  }

  // A side of Gordon's contour, which carries cross(w, side)/(jk |w|^2) times the mean of e^{jk psi} along it.
  struct Side {
    double run = 0;     // psi from its start to its end, m
    double length = 0;  // m
    double flux = 0;    // cross / |w|^2, m^2
    // -flux / run where end points replace the side: k^2 times the term of its end, and minus that of its start
    std::optional<double> end = {};
  };
  Side side_of(const MovingVertex& a, const MovingVertex& b) const {
    const Vec2 along = b.p - a.p;
    Side side{footprint_.w.dot(along), footprint_.surface_length(along),
              cross(footprint_.w, along) / footprint_.w.squaredNorm()};
    if (std::abs(side.run) > threshold_ * side.length && std::abs(k_ * side.run) / 2 > kMaxHalfPhase)
      side.end = -side.flux / side.run;
    return side;
  }

  void sides() {
    constexpr double kMinLength = 1e-12;  // m
    const MovingPolygon& polygon = footprint_.polygon;
    std::optional<double> before =
        side_of(polygon.size() > 1 ? polygon[polygon.size() - 2] : polygon.back(), polygon.back()).end;
    const MovingVertex* a = &polygon.back();
    for (const MovingVertex& b : polygon) {
      const Side side = side_of(*a, b);
      if (!side.end && side.length >= kMinLength) pieces_of_side(*a, b, side);
      if (before || side.end) {
        const double ends = before.value_or(0) - side.end.value_or(0);
        add([&](double k) { return ends / (k * k); }, footprint_.psi(a->p), phase_gradient(footprint_, *a, transmit_));
      }
      before = side.end;
      a = &b;
    }
  }

  void pieces_of_side(const MovingVertex& a, const MovingVertex& b, const Side& side) {
    const double slope = std::max(std::abs(side.run), kMaxAmplitudeError * threshold_ * side.length);
    const int pieces = std::max(1, static_cast<int>(std::ceil(k_ * slope / 2 / kMaxHalfPhase)));
    const PathGradient ga = phase_gradient(footprint_, a, transmit_), gb = phase_gradient(footprint_, b, transmit_);
    const double psi_a = footprint_.psi(a.p), run = side.run / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double s = (i + 0.5) / pieces;
      add([&](double k) { return Complex(0, -side.flux / k) * (half_argument_sinc(k * run) / pieces); },
          psi_a + s * side.run, interpolate(ga, gb, s));
    }
  }

  const Footprint& footprint_;
  const RadarBasis& transmit_;
  bool is_closed_form_;
  double k_;          // that determines the form
  double threshold_;  // slope of psi from which on end points replace what they bound
  PointWriter& writer_;
};

// Linear function of the projection plane, m.
struct Tangent {
  double value = 0;
  Vec2 slope = Vec2::Zero();

  double at(const Vec2& p) const { return value + slope.dot(p); }
};

// k determines the form, here and below.
void decompose_surface(const Contribution& contribution, const Footprint& footprint, const RadarBasis& transmit,
                       const PointBand& at, double k, std::vector<Point>& out) {
  const double threshold = std::max(at.aspect_change_rad * footprint.psi_slope_rate / kMaxAmplitudeError, 1e-9);
  if (!footprint.curvature) {
    PointWriter writer(contribution, at, out);
    FlatDecomposer(footprint, transmit, at, k, threshold, writer).run();
    return;
  }
  const Point prototype = point_of(contribution, at);
  for (const CurvedTerm& term : curved_terms(footprint, at.band, at.is_single() ? 0 : threshold)) {
    Point& point = out.emplace_back(prototype);
    if (contribution.pattern.at_node.empty()) point.pattern = smooth_pattern(*footprint.curvature, term.p);
    for (std::size_t n = 0; n < at.band.nodes().size(); ++n)
      point.amplitude[n] = radiation_factor(at.band.nodes()[n]) * term.integral[n];
    point.psi = term.psi;
    point.gradient = phase_gradient(footprint, term.p, transmit);
    point.gradient.transmit_slide = term.slide1 * transmit.h + term.slide2 * transmit.v;
    point.gradient.transmit += point.gradient.transmit_slide;
  }
}

// Phase over half of a band from the middle of a piece to its ends, and between the contributions of an amplitude law:
// their part of the interpolation error (kCellHalfPhase).
constexpr double kPieceHalfPhase = 0.1;  // rad

void decompose_interval(const EdgeInterval& interval, const PointBand& at, double k, PointWriter& writer) {
  const double run = interval.psi[1] - interval.psi[0];
  // An aspect change u changes the slope of psi along the edge by at most 2 u.
  const double threshold = 2 * at.aspect_change_rad / kMaxAmplitudeError * interval.length;
  if (!at.is_single() && std::abs(run) > threshold && std::abs(k * run) / 2 > kMaxHalfPhase &&
      endpoints_suffice(interval, k)) {
    for (const int end : {0, 1}) {
      const double sign = end == 0 ? -1 : 1;
      writer.add([&](double at_k) { return sign * endpoint_term(interval, at_k, end); }, interval.psi[end],
                 interval.gradient[end]);
    }
    return;
  }
  const double slope = std::max(std::abs(run), kMaxAmplitudeError * threshold);
  const bool is_frozen = at.aspect_change_rad > 0 || at.half_band > 0;
  const double lengths = is_frozen ? k * slope / 2 / kMaxHalfPhase : at.band.half_width() * slope / 2 / kPieceHalfPhase;
  const int pieces = std::max(1, static_cast<int>(std::ceil(lengths)));
  for (int i = 0; i < pieces; ++i) {
    const double s = (i + 0.5) / pieces, half = 0.5 / pieces;
    writer.add([&](double at_k) { return interval_integral(interval, at_k, s - half, s + half); },
               interval.psi[0] + s * run, interpolate(interval.gradient[0], interval.gradient[1], s));
  }
}

// Minus the path that the curvature of the wavefront adds at the point p, m: quadratic in p.
double curvature_path(const Footprint& footprint, const Observation& observation, const Vec2& p) {
  const auto& [transmit, receive, is_monostatic] = observation.antennas;
  const PathGradient at = phase_gradient(footprint, p, transmit);
  const auto off_axis = [&](const Vec3& x, const Vec3& r) { return (x - r.dot(x) * r).squaredNorm(); };
  return -(off_axis(observation.radar.origin + at.transmit, transmit.r) +
           off_axis(observation.radar.origin + at.receive, receive.r)) /
         (2 * observation.radar.range_m);
}

// First order of the curvature's path about p; its central differences are exact.
Tangent curvature_tangent(const Footprint& footprint, const Observation& observation, const Vec2& p) {
  constexpr double kStep = 1;  // m
  const auto path = [&](const Vec2& q) { return curvature_path(footprint, observation, q); };
  const auto derivative = [&](const Vec2& axis) {
    return (path(p + kStep * axis) - path(p - kStep * axis)) / (2 * kStep);
  };
  const Vec2 slope(derivative(Vec2::UnitX()), derivative(Vec2::UnitY()));
  return {path(p) - slope.dot(p), slope};
}

// The footprint with a linear function added to psi. Over a curved wavefront the slope of psi changes along a panel
// also where it does not with the look direction, as in a corner that returns the wave as it came.
Footprint tilted(const Footprint& footprint, const Tangent& tangent) {
  Footprint result = footprint;
  result.psi0 += tangent.value;
  result.w += tangent.slope;
  result.psi_slope_rate = 2;
  const Vec2 &w = result.w, &rise = result.plane.slope;
  result.psi_slope = std::sqrt(std::max(0.0, w.squaredNorm() - std::pow(rise.dot(w), 2) / (1 + rise.squaredNorm())));
  if (footprint.curvature) {
    auto curvature = std::make_shared<CurvedFootprint>(*footprint.curvature);
    for (Vec2& at_vertex : curvature->w) at_vertex += tangent.slope;
    for (Vec2& at_vertex : curvature->slope) at_vertex += tangent.slope;
    result.curvature = std::move(curvature);
  }
  return result;
}

void decompose_surface_at_range(const Contribution& contribution, const Footprint& footprint,
                                const Observation& observation, PointBand at, double k, std::vector<Point>& out) {
  const RadarBasis& transmit = observation.antennas.transmit;
  const Vec2 middle = centroid(footprint.polygon);
  double extent = 0;
  for (const MovingVertex& vertex : footprint.polygon)
    extent = std::max(extent, footprint.surface_length(vertex.p - middle));
  const Tangent tangent = curvature_tangent(footprint, observation, middle);
  at.aspect_change_rad += extent / observation.radar.range_m;
  const std::size_t first = out.size();
  decompose_surface(contribution, tilted(footprint, tangent), transmit, at, k, out);
  for (Point& point : std::span(out).subspan(first)) {
    const Vec3 image = point.gradient.transmit - point.gradient.transmit_slide;
    point.psi -= tangent.at({image.dot(transmit.h), image.dot(transmit.v)});
  }
}

// Adds the path of the curved wavefront, and its gradient but for the slide of shadow boundaries.
void curve_wavefront(const Observation& observation, Point& point) {
  const RadarRange& radar = observation.radar;
  for (const bool returns : {false, true}) {
    const Vec3& r = returns ? observation.antennas.receive.r : observation.antennas.transmit.r;
    Vec3& gradient = returns ? point.gradient.receive : point.gradient.transmit;
    const Vec3 x = radar.origin + gradient - (returns ? point.gradient.receive_slide : point.gradient.transmit_slide);
    const double along = r.dot(x);
    point.psi -= (x - along * r).squaredNorm() / (2 * radar.range_m);
    gradient += along / radar.range_m * x;  // of -|x_perp|^2 / (2 R) with r
  }
}

// Appends the first-order change of the pattern over a band about a single node. With P1 = dP/dk and a small delta,
//     (k - k_node) P1 e^{jk psi}  is  sin((k - k_node) delta) / delta P1 e^{jk psi},
// points at psi +- delta; kDerivativePhase = half_band delta bounds the error by kDerivativePhase^2 / 6 of that change.
void append_pattern_change(const Pattern& pattern, const PointBand& at, std::size_t first, std::vector<Point>& out) {
  constexpr double kDerivativePhase = 0.2;  // rad
  constexpr double kNegligible = 1e-4;      // -80 dB
  if (at.half_band <= 0 || pattern.at_node.empty()) return;
  const ScatteringMatrix &below = pattern.at_node[at.first_node - 1], &above = pattern.at_node[at.first_node + 1];
  ScatteringMatrix slope;
  double largest = 0, change = 0;
  for (int i = 0; i < 4; ++i) {
    slope[i] = (above[i] - below[i]) / (2 * at.half_band);
    largest = std::max(largest, std::abs(pattern.at_node[at.first_node][i]));
    change = std::max(change, std::abs(slope[i]) * at.half_band);
  }
  if (change < kNegligible * largest) return;
  const double delta = kDerivativePhase / at.half_band, k = at.band.nodes().front();
  const std::size_t last = out.size();
  for (const double side : {1.0, -1.0}) {
    const Complex factor = side / Complex(0, 2 * delta) * std::polar(1.0, -side * k * delta);
    for (std::size_t i = first; i < last; ++i) {
      Point point = out[i];
      point.psi += side * delta;
      for (int e = 0; e < 4; ++e) point.pattern[e] = factor * slope[e];
      out.push_back(point);
    }
  }
}

// Refers a point to the phase origin and to the sense of the observation.
void refer_to(const Observation& observation, Point& point) {
  const auto& [transmit, receive, is_monostatic] = observation.antennas;
  if (observation.weight != 1) {
    for (Complex& amplitude : point.amplitude) amplitude *= observation.weight;
  }
  point.psi += observation.centre.dot(transmit.r + receive.r);
  point.gradient.transmit += observation.centre;
  point.gradient.receive += observation.centre;
  point.sense = observation.sense;
  if (observation.sense == PathSense::kMean && !(transmit == receive)) point.sense = PathSense::kOneWay;
  if (observation.sense == PathSense::kExchanged) {
    std::swap(point.gradient.transmit, point.gradient.receive);
    std::swap(point.gradient.transmit_slide, point.gradient.receive_slide);
  }
}

}  // namespace

void decompose(const Contribution& contribution, const Observation& observation, const PointBand& at,
               std::vector<Point>& out) {
  const std::size_t first = out.size();
  const bool is_near = observation.radar.range_m > 0;
  const double k = at.form_k();
  if (const Footprint* footprint = contribution.footprint()) {
    if (is_near) {
      decompose_surface_at_range(contribution, *footprint, observation, at, k, out);
    } else {
      decompose_surface(contribution, *footprint, observation.antennas.transmit, at, k, out);
    }
  } else {
    PointBand from_range = at;
    from_range.aspect_change_rad += observation.direction_spread;
    PointWriter writer(contribution, from_range, out);
    decompose_interval(*contribution.interval(), from_range, k, writer);
  }
  for (std::size_t i = first; is_near && i < out.size(); ++i) curve_wavefront(observation, out[i]);
  append_pattern_change(contribution.pattern, at, first, out);
  for (std::size_t i = first; i < out.size(); ++i) refer_to(observation, out[i]);
}

ScatteringMatrix scattered(const Contribution& contribution, const Observation& observation, double k,
                           std::size_t node) {
  std::vector<Point> points;
  decompose(contribution, observation, {FrequencyBand(k), node}, points);
  return direct_sum(points, k);
}

ScatteringMatrix direct_sum(std::span<const Point> points, double k, const Vec3& turn) {
  ScatteringMatrix sum{};
  for (const Point& point : points) {
    const Complex phase = std::polar(1.0, k * (point.psi + point.gradient.sum().dot(turn)));
    const ScatteringMatrix matrix = point.matrix(0);
    for (int i = 0; i < 4; ++i) sum[i] += phase * matrix[i];
  }
  return sum;
}

bool varies_slowly(const Contribution& contribution, const FrequencyBand& band) {
  const EdgeInterval* interval = contribution.interval();
  if (!interval) return true;
  const auto* penumbra = std::get_if<WallPenumbraTerm>(&interval->amplitude);
  return penumbra == nullptr || band.half_width() * penumbra->psi_spread() <= kPieceHalfPhase;
}

}  // namespace seaglint
