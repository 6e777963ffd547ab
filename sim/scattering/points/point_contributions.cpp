// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/points/point_contributions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/sinc.h"
#include "sim/scattering/points/curved_integral.h"
#include "sim/scattering/points/phase_integral.h"

namespace seaglint {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// -jk / 2 pi
Complex radiation_factor(double k) { return {0, -k / (2 * kPi)}; }

// Appends points with the amplitude at one wavenumber.
class PointWriter {
 public:
  PointWriter(const Footprint& footprint, std::vector<PointContribution>& out) : out_(out) {
    prototype_.facet = footprint.facet;
    prototype_.part = footprint.part;
    prototype_.bounces = footprint.bounces;
    set_pattern(footprint.pattern);
  }
  void set_pattern(const std::array<Complex, 4>& pattern) {
    for (int i = 0; i < 4; ++i) prototype_.pattern[i] = std::complex<float>(pattern[i]);
  }
  void add(const BandValues& amplitude, double psi, const PathGradient& gradient) {
    PointContribution& c = out_.emplace_back(prototype_);
    c.amplitude = amplitude[0];
    c.psi = psi;
    c.gradient = gradient;
  }

 private:
  PointContribution prototype_;
  std::vector<PointContribution>& out_;
};

// Appends points with the amplitudes at the nodes of a band.
class BandPointWriter {
 public:
  BandPointWriter(const Footprint& footprint, std::vector<BandPoint>& out) : out_(out), pattern_(footprint.pattern) {}
  void set_pattern(const std::array<Complex, 4>& pattern) { pattern_ = pattern; }
  void add(const BandValues& amplitude, double psi, const PathGradient& gradient) {
    out_.push_back({amplitude, psi, gradient, pattern_});
  }

 private:
  std::vector<BandPoint>& out_;
  std::array<Complex, 4> pattern_;
};

// The wavenumber kc determines the form, which is exact at every node of the band.
template <typename Writer>
class Decomposer {
 public:
  Decomposer(const Footprint& footprint, const RadarBasis& basis, const FrequencyBand& band, double kc,
             double aspect_change_rad, Writer writer)
      : footprint_(footprint), basis_(basis), band_(band), kc_(kc), writer_(writer) {
    threshold_ = std::max(aspect_change_rad * footprint.psi_slope_rate / kMaxAmplitudeError, 1e-9);
  }

  void run() {
    if (footprint_.curvature) {
      curved();
      return;
    }
    // End points require a phase of a good part of a cycle. The whole panel determines this, not the polygon: polygons
    // with a common moving boundary must be treated equally, or its two sides do not cancel.
    const double half_phase = kc_ * footprint_.psi_slope * footprint_.panel_size / 2;
    if (footprint_.psi_slope > threshold_ && half_phase > kMaxHalfPhase) {
      edges();
    } else {
      area(footprint_.polygon);
    }
  }

 private:
  // `integral`: phase integral without the phase e^{jk psi} as a function of k.
  template <typename Integral>
  void emit(const Integral& integral, double psi, const PathGradient& gradient) {
    BandValues amplitude;
    for (std::size_t n = 0; n < band_.nodes().size(); ++n) {
      const double k = band_.nodes()[n];
      amplitude[n] = radiation_factor(k) * integral(k);
    }
    writer_.add(amplitude, psi, gradient);
  }

  void curved() {
    std::vector<CurvedContribution> terms;
    curved_contributions(footprint_, band_, threshold_, terms);
    for (CurvedContribution& term : terms) {
      writer_.set_pattern(pattern_at(footprint_, term.p, footprint_.pattern));
      PathGradient gradient = phase_gradient(footprint_, term.p, basis_);
      gradient.transmit_slide = term.slide1 * basis_.h + term.slide2 * basis_.v;
      gradient.transmit += gradient.transmit_slide;
      for (std::size_t n = 0; n < band_.nodes().size(); ++n) term.integral[n] *= radiation_factor(band_.nodes()[n]);
      writer_.add(term.integral, term.psi, gradient);
    }
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
    if (kc_ * slope * longest / 2 > kMaxHalfPhase && longest > 1e-6) {
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
    emit([&](double k) { return flat_phase_integral(footprint_, polygon, k) * std::polar(1.0, -k * psi); }, psi,
         phase_gradient(footprint_, c, basis_));
  }

  // A side of Gordon's contour, which carries cross(w, side)/(jk |w|^2) times the mean of e^{jk psi} along it.
  struct Edge {
    double run = 0;     // psi from its start to its end, m
    double length = 0;  // m
    double flux = 0;    // cross / |w|^2, m^2
    // -flux / run where end points replace the side: k^2 times the term of its end, and minus that of its start
    std::optional<double> end = {};
  };
  Edge edge_of(const MovingVertex& a, const MovingVertex& b) const {
    const Vec2 along = b.p - a.p;
    Edge edge{footprint_.w.dot(along), footprint_.surface_length(along),
              cross(footprint_.w, along) / footprint_.w.squaredNorm()};
    if (std::abs(edge.run) > threshold_ * edge.length && std::abs(kc_ * edge.run) / 2 > kMaxHalfPhase)
      edge.end = -edge.flux / edge.run;
    return edge;
  }

  void edges() {
    constexpr double kMinLength = 1e-12;  // m
    const MovingPolygon& polygon = footprint_.polygon;
    std::optional<double> before =
        edge_of(polygon.size() > 1 ? polygon[polygon.size() - 2] : polygon.back(), polygon.back()).end;
    const MovingVertex* a = &polygon.back();
    for (const MovingVertex& b : polygon) {
      const Edge edge = edge_of(*a, b);
      if (!edge.end && edge.length >= kMinLength) edge_pieces(*a, b, edge);
      if (before || edge.end) {
        const double ends = before.value_or(0) - edge.end.value_or(0);
        emit([&](double k) { return ends / (k * k); }, footprint_.psi(a->p), phase_gradient(footprint_, *a, basis_));
      }
      before = edge.end;
      a = &b;
    }
  }

  void edge_pieces(const MovingVertex& a, const MovingVertex& b, const Edge& edge) {
    const double slope = std::max(std::abs(edge.run), kMaxAmplitudeError * threshold_ * edge.length);
    const int pieces = std::max(1, static_cast<int>(std::ceil(kc_ * slope / 2 / kMaxHalfPhase)));
    const PathGradient ga = phase_gradient(footprint_, a, basis_), gb = phase_gradient(footprint_, b, basis_);
    const double psi_a = footprint_.psi(a.p), run = edge.run / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double s = (i + 0.5) / pieces;
      emit([&](double k) { return Complex(0, -edge.flux / k) * (half_argument_sinc(k * run) / pieces); },
           psi_a + s * edge.run, interpolate(ga, gb, s));
    }
  }

  const Footprint& footprint_;
  const RadarBasis& basis_;
  const FrequencyBand& band_;
  double kc_;
  Writer writer_;
  double threshold_ = 0;  // slope of psi along the surface above which end points are used
};

}  // namespace

void decompose(const Footprint& footprint, const RadarBasis& transmit, const DecompositionSettings& settings,
               std::vector<PointContribution>& out) {
  const FrequencyBand band(settings.kc);
  Decomposer(footprint, transmit, band, settings.kc, settings.aspect_change_rad, PointWriter(footprint, out)).run();
}

void decompose(const Footprint& footprint, const RadarBasis& transmit, const FrequencyBand& band,
               double aspect_change_rad, std::vector<BandPoint>& out) {
  Decomposer(footprint, transmit, band, band.form().centre(), aspect_change_rad, BandPointWriter(footprint, out)).run();
}

void decompose_over_band(const Footprint& footprint, const RadarBasis& transmit, const DecompositionSettings& settings,
                         double half_band, std::vector<PointContribution>& out) {
  decompose(footprint, transmit, settings, out);
  if (footprint.patterns.size() != 3 || half_band <= 0) return;
  std::array<Complex, 4> slope;
  double largest = 0, change = 0;
  for (int i = 0; i < 4; ++i) {
    slope[i] = (footprint.patterns[2][i] - footprint.patterns[0][i]) / (2 * half_band);
    largest = std::max(largest, std::abs(footprint.pattern[i]));
    change = std::max(change, std::abs(slope[i]) * half_band);
  }
  if (change < 1e-4 * largest) return;  // -80 dB
  const double delta = kDerivativePhase / half_band;
  for (const double side : {1.0, -1.0}) {
    Footprint shifted = footprint;
    shifted.psi0 += side * delta;
    const Complex factor = side / Complex(0, 2 * delta) * std::polar(1.0, -side * settings.kc * delta);
    for (int i = 0; i < 4; ++i) shifted.pattern[i] = factor * slope[i];
    decompose(shifted, transmit, settings, out);
  }
}

namespace {

template <typename Point>
void bend(std::span<Point> contributions, const BistaticGeometry& geometry, const RadarRange& radar) {
  for (Point& c : contributions) {
    for (const bool out : {false, true}) {
      const Vec3& r = out ? geometry.receive.r : geometry.transmit.r;
      Vec3& gradient = out ? c.gradient.receive : c.gradient.transmit;
      const Vec3 x = radar.origin + gradient - (out ? c.gradient.receive_slide : c.gradient.transmit_slide);
      const double along = r.dot(x);
      c.psi -= (x - along * r).squaredNorm() / (2 * radar.range_m);
      gradient += along / radar.range_m * x;  // of -|x_perp|^2 / (2 R) with r
    }
  }
}

}  // namespace

void apply_wavefront_curvature(std::span<PointContribution> contributions, const BistaticGeometry& geometry,
                               const RadarRange& radar) {
  bend(contributions, geometry, radar);
}

void apply_wavefront_curvature(std::span<BandPoint> contributions, const BistaticGeometry& geometry,
                               const RadarRange& radar) {
  bend(contributions, geometry, radar);
}

std::array<Complex, 4> direct_sum(std::span<const PointContribution> contributions, double k, const Vec3& turn) {
  std::array<Complex, 4> sum{};
  for (const PointContribution& c : contributions) {
    const Complex term = c.amplitude * std::polar(1.0, k * (c.psi + c.gradient.sum().dot(turn)));
    for (int i = 0; i < 4; ++i) sum[i] += term * Complex(c.pattern[i]);
  }
  return sum;
}

}  // namespace seaglint
