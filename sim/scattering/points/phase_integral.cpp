// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/points/phase_integral.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/coefficients/fade_windows.h"

namespace seaglint {
namespace {

// Largest change of psi per metre of surface, that of both paths. Where facets seen almost edge-on have normals beyond
// the shadow boundary, or rays reach them far from the flat bundle, the quadratic exceeds it and means nothing.
constexpr double kMaxSlope = 2;

// Facets whose taper is below this at all vertices are omitted.
constexpr double kNegligibleTaper = 2e-3;

// Two lengths whose ratio is less are equal but for rounding: the first is taken, so that a moved target is cut alike.
constexpr double kUnlikeRounding = 1 + 1e-6;

// Largest error of linear interpolation of a function with second derivative 1 between the vertices of a triangle and
// between the ends of a side, of unit length (circle of radius 1 / sqrt(3)).
constexpr double kTriangleError = 1.0 / 6, kSideError = 1.0 / 8;

// Integral of e^{jk w.(p - c)} over the polygon about its centroid c, by a series in k w: for k |w| size below 0.1 the
// truncation error is below 1e-6 of the area.
Complex small_phase_integral(const MovingPolygon& polygon, const Vec2& c, const Vec2& kw) {
  // Moments of the phase over a triangle with vertex phases x, y, z from complete homogeneous sums.
  Complex sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[0].p - c, b = polygon[i].p - c, d = polygon[i + 1].p - c;
    const double area = 0.5 * cross(b - a, d - a);
    const double x = kw.dot(a), y = kw.dot(b), z = kw.dot(d);
    // Complete homogeneous sums: h_m(x, y, z) = x h_{m-1}(x, y, z) + h_m(y, z), and h_m(y, z) = y h_{m-1}(y, z) + z^m.
    const double b1 = y + z, b2 = y * b1 + z * z, b3 = y * b2 + z * z * z, b4 = y * b3 + z * z * z * z;
    const double h1 = x + b1, h2 = x * h1 + b2, h3 = x * h2 + b3, h4 = x * h3 + b4;
    // Mean of phase^m over a triangle is 2 m! h_m / (m + 2)!; the exponential divides by m!.
    sum += area * Complex(1 - 2 * h2 / 24 + 2 * h4 / 720, 2 * h1 / 6 - 2 * h3 / 120);
  }
  return sum;
}

double shadow_taper(double distance, double k) {
  const double t = std::clamp(distance * std::cbrt(k) / kTransitionZoneWidth, 0.0, 1.0);
  return t * t * t * (10 - 15 * t + 6 * t * t);
}

class CurvedDecomposer {
 public:
  CurvedDecomposer(const Footprint& footprint, const FrequencyBand& band, double min_slope,
                   std::vector<CurvedTerm>& out)
      : footprint_(footprint), c_(*footprint.curvature), band_(band), min_slope_(min_slope), out_(out) {
    for (int i = 0; i < 3; ++i) {
      const double distance = std::min(c_.incident_shadow_distance[i], c_.receiver_shadow_distance[i]);
      fade_[i] = shadow_taper(distance, band.form().centre());
    }
    // Maps a slope in the projection plane to one along the surface: divided by 1/cos along the steepest direction.
    const Vec2 steepest = footprint.plane.slope;
    const double area_ratio = std::sqrt(1 + steepest.squaredNorm());
    along_surface_ = Mat2::Identity();
    if (steepest.squaredNorm() > 0) {
      along_surface_ -= outer_product((1 - 1 / area_ratio) / steepest.squaredNorm() * steepest, steepest);
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const Vec2 along = c_.corner[j] - c_.corner[i];
      const double max = 0.25 * std::abs(along.dot(c_.phase.hessian * along));
      if (c_.flat_panel) continue;
      skew_[i] = std::clamp(0.5 * (c_.w[i] + c_.w[j]).dot(along) - (psi(c_.corner[j]) - psi(c_.corner[i])), -max, max);
    }
    Mat2 change = c_.flat_panel ? c_.phase.hessian : Mat2::Zero();
    for (int i = 0; i < 3; ++i) {
      slope_[i] = along_surface_ * c_.slope[i];
      if (!c_.flat_panel) change += outer_product(c_.slope[i], c_.lambda.gradient[i]);
    }
    curvature_ = (along_surface_ * change * along_surface_).norm();
    if (c_.has_bundle)
      slope_change_ = 3 * c_.rays.path_slope.norm() * c_.rays.bundle.direction_map.matrix.squaredNorm();
  }

  void run() {
    if (std::max({fade_[0], fade_[1], fade_[2]}) <= kNegligibleTaper) return;
    Cell triangle;
    for (const Vec2& corner : c_.corner) triangle.add(corner_at(corner));
    part(footprint_.polygon, triangle);
  }

 private:
  // Barycentric coordinates of a point in the facet; their sum is 1.
  using BarycentricWeights = std::array<double, 3>;
  BarycentricWeights barycentric(const Vec2& p) const {
    return {c_.lambda.at(0, p), c_.lambda.at(1, p), c_.lambda.at(2, p)};
  }

  // The quadratic, and along each side the cubic x (1 - x) (1 - 2 x) that gives it the slopes of the smooth surface at
  // both ends.
  double psi(const Vec2& p, const BarycentricWeights& of_p) const {
    double sum = footprint_.psi(p) + c_.phase.at(p);
    if (c_.has_bundle) sum += c_.rays.further_phase(p);
    if (c_.flat_panel) return sum;
    for (int i = 0; i < 3; ++i) {
      const double a = of_p[i], b = of_p[(i + 1) % 3];
      sum += skew_[i] * a * b * (a - b);
    }
    return sum;
  }
  double psi(const Vec2& p) const { return psi(p, barycentric(p)); }
  Vec2 psi_slope(const Vec2& p) const {
    const BarycentricWeights of_p = barycentric(p);
    Vec2 sum = footprint_.w + c_.phase.slope(p);
    if (c_.has_bundle) sum += c_.rays.further_phase_slope(p);
    if (c_.flat_panel) return sum;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double a = of_p[i], b = of_p[j];
      sum += skew_[i] * ((2 * a * b - b * b) * c_.lambda.gradient[i] + (a * a - 2 * a * b) * c_.lambda.gradient[j]);
    }
    return sum;
  }

  template <typename T>
  static T between(const std::array<T, 3>& corner, const BarycentricWeights& of_p) {
    return of_p[0] * corner[0] + of_p[1] * corner[1] + of_p[2] * corner[2];
  }

  // Gradient of psi with the smooth normals, continuous between facets.
  Vec2 smooth_slope(const Vec2& p, const BarycentricWeights& of_p) const {
    return c_.flat_panel ? psi_slope(p) : between(c_.w, of_p);
  }

  struct Corner {
    Vec2 p, w;   // m; gradient of psi
    Vec2 slope;  // of psi along the surface
  };
  Corner corner_at(const Vec2& p) const {
    const Vec2 w = psi_slope(p);
    return {p, w, c_.flat_panel ? Vec2(along_surface_ * w) : between(slope_, barycentric(p))};
  }
  Corner middle_of(const Corner& a, const Corner& b) const { return corner_at(0.5 * (a.p + b.p)); }

  // The triangle of the facet, or a part of the rectangle around it.
  struct Cell {
    std::array<Corner, 4> corner;
    std::size_t corners = 0;

    void add(const Corner& c) { corner[corners++] = c; }
    const Corner& at(std::size_t i) const { return corner[i % corners]; }
  };

  // Largest change of psi between two corners, by the slopes at both or by the change of slope while the terms hold,
  // per the change that a piece may have.
  double path_change(const Corner& a, const Corner& b) const {
    const Vec2 along = b.p - a.p;
    const double length = footprint_.surface_length(along);
    const double steepest = std::max(std::abs(a.w.dot(along)), std::abs(b.w.dot(along)));
    return 0.5 * band_.form().centre() *
           std::max(std::min(steepest, kMaxSlope * length) / kMaxCurvedHalfPhase,
                    kMaxAmplitudeError * min_slope_ * length / kMaxHalfPhase);
  }

  // Decomposes the illuminated polygon inside a cell of the facet; the cell determines the form.
  void part(const MovingPolygon& polygon, const Cell& cell) {
    double size = 0, largest = 0, difference = 0;
    Vec2 mean = Vec2::Zero();
    for (std::size_t i = 0; i < cell.corners; ++i) {
      mean += cell.at(i).slope / static_cast<double>(cell.corners);
      for (std::size_t j = 0; j < i; ++j) {
        size = std::max(size, footprint_.surface_length(cell.at(i).p - cell.at(j).p));
        largest = std::max(largest, path_change(cell.at(i), cell.at(j)));
      }
    }
    // The slope is linear over the cell, but for the further path: at least the mean less the largest difference from
    // it and less the error of linear interpolation.
    for (std::size_t i = 0; i < cell.corners; ++i)
      difference = std::max(difference, (cell.at(i).slope - mean).squaredNorm());
    const double min = mean.norm() - std::sqrt(difference) - kTriangleError * slope_change_ * size * size;
    const double k = band_.form().centre();
    if (min > min_slope_ && k * min * size / 2 > kMaxHalfPhase && k * min * min > kContourRatio * curvature_) {
      contour(polygon);
      return;
    }
    if (largest <= 1 || size < 1e-6) {
      point(polygon);
      return;
    }
    const std::array<Cell, 2> halves = halved(cell.corners == 3 ? rectangle_around(cell) : cell);
    const Corner &from = halves[0].at(0), &inside = halves[0].at(1), &to = halves[1].at(0);
    // The cut is fixed in the body, whose points at height z move by -z d_i when the look direction changes by d_i: at
    // rest in the projection plane it would slide on the facet.
    const Vec2 along = to.p - from.p;
    MovingLine line;
    line.gradient = Vec2(-along.y(), along.x()).normalized();
    line.value = -line.gradient.dot(from.p);
    const DepthPlane& plane = footprint_.plane;
    line.value_d1 = line.gradient.x() * plane.z0;
    line.value_d2 = line.gradient.y() * plane.z0;
    line.gradient_d1 = line.gradient.x() * plane.slope;
    line.gradient_d2 = line.gradient.y() * plane.slope;
    auto [first, second] = split_by_line(polygon, line);
    if (line.at(inside.p) <= 0) std::swap(first, second);
    if (!first.empty()) part(first, halves[0]);
    if (!second.empty()) part(second, halves[1]);
  }

  // Rectangle on the surface around a triangle, along its longest side. Halves of a rectangle keep their width while
  // they are cut to length; those of a triangle become narrow with it, and a triangle n times longer than wide would
  // have n^1.6 pieces.
  Cell rectangle_around(const Cell& triangle) const {
    const auto length = [&](std::size_t i) {
      return footprint_.surface_length(triangle.at(i + 1).p - triangle.at(i).p);
    };
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (length(i) > kUnlikeRounding * length(longest)) longest = i;
    const Vec2 a = triangle.at(longest).p, b = triangle.at(longest + 1).p, side = b - a;
    const Vec2 to_third = triangle.at(longest + 2).p - a;
    const Vec2 up = to_third - footprint_.surface_dot(to_third, side) / footprint_.surface_dot(side, side) * side;
    Cell rectangle;
    for (const Vec2& p : {a, b, Vec2(b + up), Vec2(a + up)}) rectangle.add(corner_at(p));
    return rectangle;
  }

  // Halves of a rectangle, whose two sides over which psi changes most are cut in the middle. The cut goes from the
  // first corner of the first half to the first one of the second half.
  std::array<Cell, 2> halved(const Cell& cell) const {
    const auto change = [&](std::size_t i) {
      return std::max(path_change(cell.at(i), cell.at(i + 1)), path_change(cell.at(i + 2), cell.at(i + 3)));
    };
    const std::size_t cut = change(1) > kUnlikeRounding * change(0) ? 1 : 0;
    const Corner from = middle_of(cell.at(cut), cell.at(cut + 1)), to = middle_of(cell.at(cut + 2), cell.at(cut + 3));
    return {Cell{{from, cell.at(cut + 1), cell.at(cut + 2), to}, 4},
            Cell{{to, cell.at(cut + 3), cell.at(cut), from}, 4}};
  }

  // Integral over a small polygon as one term at its centroid, by the seven-point rule of degree 5 on its triangles (A.
  // H. Stroud, Approximate Calculation of Multiple Integrals, T2: 5-1), as a power series of e^{jkd} in the path d from
  // the centroid: within a triangle |kd| is below 4/3, its first omitted term below 3e-4. The path is limited to that
  // of a piece from end to end, so that one that rounding leaves outside its cell, seen almost edge-on, contributes no
  // more than its area. Where it is more than twice that the slope of psi exceeds kMaxSlope and the phase varies within
  // the piece: it is omitted, since its area with one phase would be the more, the larger the piece (turned random
  // bodies change by 0.097 of their echo with such pieces, by 0.042 without; MeshInvariance).
  void point(const MovingPolygon& polygon) {
    const Vec2 c = centroid(polygon);
    const double psi_c = psi(c), max_path = 2 * kMaxCurvedHalfPhase / band_.form().highest;
    constexpr double kNear = 0.10128650732345634, kFar = 0.47014206410511509;
    constexpr double kWeightNear = 0.12593918054482715, kWeightFar = 0.13239415278850618, kWeightMiddle = 0.225;
    std::array<double, 8> moment{};  // of d^n / n!, with the taper
    double longest_path = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const Vec2 &a = polygon[0].p, &b = polygon[i].p, &d = polygon[i + 1].p;
      const double area = 0.5 * cross(b - a, d - a);
      const auto add = [&](double weight, const Vec2& p) {
        const BarycentricWeights of_p = barycentric(p);
        const double whole_path = psi(p, of_p) - psi_c, path = std::clamp(whole_path, -max_path, max_path);
        longest_path = std::max(longest_path, std::abs(whole_path));
        double term = area * weight * between(fade_, of_p);
        for (std::size_t n = 0; n < moment.size(); ++n) {
          moment[n] += term;
          term *= path / static_cast<double>(n + 1);
        }
      };
      add(kWeightMiddle, (a + b + d) / 3);
      for (const auto& [x, y, z] : {std::array{a, b, d}, {b, d, a}, {d, a, b}}) {
        add(kWeightNear, (1 - 2 * kNear) * x + kNear * (y + z));
        add(kWeightFar, (1 - 2 * kFar) * x + kFar * (y + z));
      }
    }
    if (longest_path > 2 * max_path) return;
    const Complex spreading = c_.divergence_factor(c);
    out_.push_back({at_nodes([&](double k) {
                      const double x = k * k;
                      return spreading * Complex(moment[0] - x * (moment[2] - x * (moment[4] - x * moment[6])),
                                                 k * (moment[1] - x * (moment[3] - x * (moment[5] - x * moment[7]))));
                    }),
                    psi_c, c, 0, 0});
  }

  // Leading contour term of the area: each side carries taper cross(G w, side)/(jk w . G w) e^{jk psi} with the local
  // slope w, by the divergence theorem with F = G w e^{jk psi} / (jk w . G w). G = 1 - rise rise^T / (1 + |rise|^2): G
  // w is the slope along the surface, seen in the projection plane, and kContourRatio bounds the omitted term of F at
  // any incidence.
  void contour(const MovingPolygon& polygon) {
    const std::size_t n = polygon.size();
    const double k_form = band_.form().centre();
    std::vector<std::optional<Complex>> end(n);  // times k^2
    // Times k.
    const auto flux = [&](const Vec2& p, const Vec2& along) -> Complex {
      const BarycentricWeights of_p = barycentric(p);
      const Vec2 w = smooth_slope(p, of_p), rise = between(c_.rise, of_p);
      const Vec2 along_surface = w - rise.dot(w) / (1 + rise.squaredNorm()) * rise;
      return between(fade_, of_p) * cross(along_surface, along) / (Complex(0, 1) * w.dot(along_surface));
    };
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      const MovingVertex &a = polygon[i], &b = polygon[j];
      const Vec2 along = b.p - a.p;
      const double length = footprint_.surface_length(along);
      if (length < 1e-12) continue;
      const auto at = [&](double x) {
        return MovingVertex{a.p + x * along, a.d1 + x * (b.d1 - a.d1), a.d2 + x * (b.d2 - a.d2)};
      };
      const auto run = [&](double x) { return psi_slope(a.p + x * along).dot(along); };  // d psi / dx
      // Where psi varies fast enough a part of the side is replaced by its end points; those inside the side cancel.
      const auto part_of_edge = [&](const auto& self, double from, double to, double run_from, double run_to) -> void {
        const double step = to - from;
        const double dip = kSideError * slope_change_ * length * std::pow(length * step, 2);
        const double min = run_from * run_to > 0 ? std::min(std::abs(run_from), std::abs(run_to)) - dip : 0;
        if (min > min_slope_ * length && k_form * min * step / 2 > kMaxHalfPhase &&
            k_form * min * min * step > kContourRatio * std::abs(run_to - run_from)) {
          const Complex first = -flux(a.p + from * along, along) / Complex(0, run_from);
          const Complex last = flux(a.p + to * along, along) / Complex(0, run_to);
          if (from == 0)
            end[i] = end[i].value_or(0.0) + first;
          else
            slide_end(first, at(from));
          if (to == 1)
            end[j] = end[j].value_or(0.0) + last;
          else
            slide_end(last, at(to));
          return;
        }
        const double largest =
            std::max({std::abs(run_from), std::abs(run_to), kMaxAmplitudeError * min_slope_ * length});
        const double middle = 0.5 * (from + to);
        if (k_form * largest * step / 2 <= kMaxHalfPhase) {
          const Complex whole = flux(a.p + middle * along, along) * step;
          const double run_of_part = run(middle) * step;
          slide(at_nodes([&](double k) { return whole * (half_argument_sinc(k * run_of_part) / k); }), at(middle));
          return;
        }
        const double run_middle = run(middle);
        self(self, from, middle, run_from, run_middle);
        self(self, middle, to, run_middle, run_to);
      };
      part_of_edge(part_of_edge, 0, 1, run(0), run(1));
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (end[i]) slide_end(*end[i], polygon[i]);
    }
  }

  // Values of a function of k at the nodes of the band.
  template <typename Amplitude>
  BandValues at_nodes(const Amplitude& amplitude) const {
    BandValues values{};
    for (std::size_t n = 0; n < band_.nodes().size(); ++n) values[n] = amplitude(band_.nodes()[n]);
    return values;
  }

  // The term of an end point, k^2 times which is given.
  void slide_end(const Complex& integral, const MovingVertex& vertex) {
    slide(at_nodes([&](double k) { return integral / (k * k); }), vertex);
  }

  // A term at a point that slides with a vertex.
  void slide(const BandValues& integral, const MovingVertex& vertex) {
    const BarycentricWeights of_p = barycentric(vertex.p);
    const Vec2 w = smooth_slope(vertex.p, of_p);
    const double z = footprint_.plane.at(vertex.p);
    out_.push_back(
        {integral, psi(vertex.p, of_p), vertex.p, w.dot(vertex.d1 + Vec2(z, 0)), w.dot(vertex.d2 + Vec2(0, z))});
    const Complex spreading = c_.divergence_factor(vertex.p);
    for (Complex& value : out_.back().integral) value *= spreading;
  }

  const Footprint& footprint_;
  const CurvedFootprint& c_;
  const FrequencyBand& band_;
  double min_slope_;
  std::array<double, 3> skew_{};
  std::vector<CurvedTerm>& out_;
  std::array<double, 3> fade_;
  Mat2 along_surface_;
  double slope_change_ = 0;    // bound of the second derivative of the slope of psi, by the further path, 1/m^2
  double curvature_ = 0;       // change of the slope of psi along the surface, 1/m
  std::array<Vec2, 3> slope_;  // of psi along the surface, at the vertices of the facet
};

}  // namespace

Complex flat_phase_integral(const Footprint& footprint, const MovingPolygon& polygon, double k) {
  const Vec2 c = centroid(polygon);
  const Complex phase_c = std::polar(1.0, k * footprint.psi(c));
  const Vec2 kw = k * footprint.w;
  double largest = 0;
  for (const MovingVertex& vertex : polygon) largest = std::max(largest, std::abs(kw.dot(vertex.p - c)));
  if (largest < 0.1) return phase_c * small_phase_integral(polygon, c, kw);

  Complex sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i].p - c, along = polygon[(i + 1) % polygon.size()].p - polygon[i].p;
    sum += cross(kw, along) * half_argument_sinc(kw.dot(along)) * std::polar(1.0, kw.dot(a + 0.5 * along));
  }
  return phase_c * sum / (Complex(0, 1) * kw.squaredNorm());
}

std::vector<CurvedTerm> curved_terms(const Footprint& footprint, const FrequencyBand& band, double min_slope) {
  constexpr std::size_t kAsUsual = 16;
  std::vector<CurvedTerm> terms;
  terms.reserve(kAsUsual);
  CurvedDecomposer(footprint, band, min_slope, terms).run();
  return terms;
}

}  // namespace seaglint
