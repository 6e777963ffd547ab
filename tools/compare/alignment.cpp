// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/alignment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"
#include "tools/compare/differences.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxFitted = 200'000;  // points of the fit; more are thinned out evenly
constexpr std::size_t kMaxPairs = 20'000;    // per lag
constexpr double kPriorOrigin_m = 0.4;       // how far an origin that nothing is known of may be displaced, each axis
constexpr double kOriginError = 1.0 / 50;    // of the shortest wavelength, largest standard error of a component
constexpr double kClearlyBetter = 0.5;       // 1 - correlation of the other time factor, relative

// A phase that is q.x + const up to noise, with its weight.
struct Phase {
  Vec3 q;
  Complex value;  // weight times e^{j phase}

  double weight() const { return std::sqrt(std::norm(value)); }
};

// Orders in which neighbours differ in one of frequency, azimuth and elevation only.
enum class Along { kFrequency, kAzimuth, kElevation };

auto others(const AlignmentPoint& p, Along along) {
  return std::tuple(p.element, along == Along::kFrequency ? 0 : p.frequency_hz,
                    along == Along::kAzimuth ? 0 : p.azimuth_deg, along == Along::kElevation ? 0 : p.elevation_deg);
}

double running(const AlignmentPoint& p, Along along) {
  return along == Along::kFrequency ? p.frequency_hz : along == Along::kAzimuth ? p.azimuth_deg : p.elevation_deg;
}

std::vector<std::size_t> sorted_along(std::span<const AlignmentPoint> points, Along along) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(others(points[a], along), running(points[a], along), a) <
           std::tuple(others(points[b], along), running(points[b], along), b);
  });
  return order;
}

double spread_of(std::span<const Phase> phases);

// Differences of phase between points that are `lag` apart along one variable.
struct PhasePairs {
  std::vector<Phase> phases;
  double spread = 0;  // rms of q, rad/m
};

// Pairs of all variables and of lags 1, 2, 4, ..., by ascending spread.
std::vector<PhasePairs> phase_pairs(std::span<const AlignmentPoint> points, std::span<const Complex> products) {
  std::vector<PhasePairs> all;
  for (const Along along : {Along::kFrequency, Along::kAzimuth, Along::kElevation}) {
    const std::vector<std::size_t> order = sorted_along(points, along);
    for (std::size_t lag = 1; lag < order.size(); lag *= 2) {
      PhasePairs pairs;
      const std::size_t step = std::max<std::size_t>(1, (order.size() - lag) / kMaxPairs);
      for (std::size_t n = 0; n + lag < order.size(); n += step) {
        const std::size_t a = order[n], b = order[n + lag];
        if (others(points[a], along) != others(points[b], along)) continue;
        pairs.phases.push_back(
            {points[b].path_gradient - points[a].path_gradient, products[b] * std::conj(products[a])});
      }
      pairs.spread = spread_of(pairs.phases);
      if (pairs.spread > 0) all.push_back(std::move(pairs));
    }
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.spread < b.spread; });
  return all;
}

double coherence(std::span<const Phase> phases, const Vec3& x) {
  Complex sum = 0;
  for (const Phase& phase : phases) sum += phase.value * std::polar(1.0, phase.q.dot(x));
  return std::abs(sum);
}

// Normal equations of phases -q.x with weights |value|; with_mean: up to a common constant.
struct Normal {
  Mat3 matrix = Mat3::Zero();  // sum of w (q - mean)(q - mean)^T
  Vec3 right = Vec3::Zero();
  double weight = 0, squares = 0;  // sum of w, and of w residual^2

  static Normal of(std::span<const Phase> phases, const Vec3& x, bool with_mean) {
    Normal normal;
    Vec3 mean = Vec3::Zero();
    Complex constant = 0;
    for (const Phase& phase : phases) {
      const double w = phase.weight();
      normal.weight += w;
      mean += w * phase.q;
      if (with_mean) constant += phase.value * std::polar(1.0, phase.q.dot(x));
    }
    if (normal.weight <= 0) return normal;
    mean = with_mean ? Vec3(mean / normal.weight) : Vec3(Vec3::Zero());
    const Complex turn = with_mean && std::abs(constant) > 0 ? std::conj(constant) / std::abs(constant) : Complex(1, 0);
    for (const Phase& phase : phases) {
      const double w = phase.weight();
      if (w <= 0) continue;
      const Vec3 q = phase.q - mean;
      const double residual = std::arg(phase.value * std::polar(1.0, phase.q.dot(x)) * turn);
      normal.matrix += outer_product(w * q, q);
      normal.right -= w * residual * q;
      normal.squares += w * residual * residual;
    }
    return normal;
  }
  // The step along eigenvectors whose spread of q exceeds `least` rad/m.
  Vec3 step(double least) const {
    if (weight <= 0) return Vec3::Zero();
    const PrincipalAxes eigen = principal_axes(matrix);
    Vec3 result = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const double spread = std::sqrt(std::max(eigen.values[k], 0.0) / weight);
      if (spread <= least) continue;
      const Vec3 v = eigen.axes.col(k);
      result += v * (v.dot(right) / eigen.values[k]);
    }
    return result;
  }
};

// Gauss-Newton's method on the phases.
void refine(std::span<const Phase> phases, Vec3& x, bool with_mean, double least) {
  constexpr int kSteps = 30;
  for (int n = 0; n < kSteps; ++n) {
    const Vec3 step = Normal::of(phases, x, with_mean).step(least);
    x += step;
    if (step.norm() < 1e-9) return;
  }
}

double spread_of(std::span<const Phase> phases) {
  const Normal normal = Normal::of(phases, Vec3::Zero(), false);
  return normal.weight > 0 ? std::sqrt(normal.matrix.trace() / normal.weight) : 0;
}

// The best origin of a lattice within kPriorOrigin_m of 0.
Vec3 first_guess(std::span<const Phase> pairs, double spread) {
  const int half = std::min(6, static_cast<int>(std::ceil(2 * kPriorOrigin_m * spread)));
  const double step = 0.5 / spread;
  Vec3 best = Vec3::Zero();
  double highest = coherence(pairs, best) * (1 + 1e-9);
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      for (int k = -half; k <= half; ++k) {
        const Vec3 x = step * Vec3(i, j, k);
        const double value = coherence(pairs, x);
        if (value <= highest) continue;
        highest = value;
        best = x;
      }
    }
  }
  return best;
}

// Standard errors of the origin along three perpendicular unit vectors.
struct OriginErrors {
  Mat3 axes;
  Vec3 error_m;
};

// What is known of the origin while pairs of ever larger spread are used.
class OriginSearch {
 public:
  const Vec3& origin() const { return x_; }

  // Uses pairs whose phases by the uncertainty of the origin so far are below half a turn.
  void use(const PhasePairs& pairs, double least) {
    if (!resolves(pairs.phases)) return;
    if (information_ == Mat3::Zero()) x_ = first_guess(pairs.phases, pairs.spread);
    refine(pairs.phases, x_, false, least);
    const Normal normal = Normal::of(pairs.phases, x_, false);
    constexpr double kIndependent = 50;  // pairs are not: neighbours share points
    const double count = std::min(kIndependent, static_cast<double>(pairs.phases.size()));
    const double variance = std::max(normal.squares / normal.weight, 1e-4);
    information_ += normal.matrix / normal.weight * count / variance;
  }
  // Whether the phases of these by the uncertainty of the origin are below half a turn.
  bool resolves(std::span<const Phase> phases) const {
    const Mat3 covariance = (information_ + Mat3::Identity() / square(kPriorOrigin_m)).inverse();
    double squares = 0, weight = 0;
    for (const Phase& phase : phases) {
      squares += phase.weight() * phase.q.dot(covariance * phase.q);
      weight += phase.weight();
    }
    return weight > 0 && squares / weight < square(kPi);
  }
  OriginErrors errors() const {
    const PrincipalAxes eigen = principal_axes(information_);
    OriginErrors result{eigen.axes, Vec3::Zero()};
    for (int k = 0; k < 3; ++k) result.error_m[k] = 1 / std::sqrt(std::max(eigen.values[k], 1e-300));
    return result;
  }

 private:
  static double square(double value) { return value * value; }
  Vec3 x_ = Vec3::Zero();
  Mat3 information_ = Mat3::Zero();
};

// By the scatter of the phases about those of the origin and a constant.
OriginErrors errors_of(std::span<const Phase> phases, const Vec3& x) {
  const Normal normal = Normal::of(phases, x, true);
  const PrincipalAxes eigen = principal_axes(normal.matrix);
  OriginErrors errors{eigen.axes, Vec3::Zero()};
  const double scatter = std::sqrt(normal.squares / std::max(normal.weight, 1e-300));
  const double count = std::max<double>(1, static_cast<double>(phases.size()) - 4);
  for (int k = 0; k < 3; ++k) {
    const double spread = std::sqrt(std::max(eigen.values[k], 0.0) / std::max(normal.weight, 1e-300));
    errors.error_m[k] = spread > 0 ? std::max(scatter, 1e-6) / (spread * std::sqrt(count)) : 1e300;
  }
  return errors;
}

std::vector<AlignmentPoint> thinned(std::span<const AlignmentPoint> points) {
  std::vector<AlignmentPoint> kept;
  const std::size_t step = (points.size() + kMaxFitted - 1) / kMaxFitted;
  for (std::size_t i = 0; i < points.size(); i += step) kept.push_back(points[i]);
  return kept;
}

double shortest_wavelength(std::span<const AlignmentPoint> points) {
  double highest = 0;
  for (const AlignmentPoint& p : points) highest = std::max(highest, p.frequency_hz);
  return kSpeedOfLight / highest;
}

// Phases of all points with the elements' own constants removed.
std::vector<Phase> phases_of(std::span<const AlignmentPoint> points, std::span<const Complex> products, const Vec3& x) {
  std::array<Complex, 4> constants{};
  for (std::size_t i = 0; i < points.size(); ++i)
    constants[points[i].element] += products[i] * std::polar(1.0, points[i].path_gradient.dot(x));
  std::vector<Phase> phases;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Complex constant = constants[points[i].element];
    const double size = std::abs(constant);
    phases.push_back({points[i].path_gradient, size > 0 ? products[i] * std::conj(constant) / size : products[i]});
  }
  return phases;
}

// With the weighted mean of q removed.
std::vector<Phase> centred(std::vector<Phase> phases) {
  Vec3 mean = Vec3::Zero();
  double weight = 0;
  for (const Phase& phase : phases) {
    mean += phase.weight() * phase.q;
    weight += phase.weight();
  }
  for (Phase& phase : phases) phase.q -= mean / std::max(weight, 1e-300);
  return phases;
}

// With e^{+jwt}. What has the other time factor had the other sign of its stated origin, too.
Complex reference_of(const AlignmentPoint& p, bool conjugated) {
  if (!conjugated) return p.reference_m;
  if (p.stated_origin_m.isZero(1e-12)) return std::conj(p.reference_m);
  return std::conj(p.reference_m) * std::polar(1.0, 2 * p.path_gradient.dot(p.stated_origin_m));
}

Alignment fit(std::span<const AlignmentPoint> points, bool conjugated) {
  Alignment result;
  result.conjugated = conjugated;
  std::vector<Complex> products;
  for (const AlignmentPoint& p : points) products.push_back(reference_of(p, conjugated) * std::conj(p.computed_m));
  const double wavelength = shortest_wavelength(points), least = 1e-6 / wavelength;

  OriginSearch search;
  for (const PhasePairs& pairs : phase_pairs(points, products)) search.use(pairs, least);
  Vec3& x = result.origin_m;
  x = search.origin();
  std::vector<Phase> phases = phases_of(points, products, x);
  const bool all_used = search.resolves(centred(phases));
  if (all_used) {
    refine(phases, x, true, least);
    phases = phases_of(points, products, x);
  }
  const OriginErrors errors = all_used ? errors_of(phases, x) : search.errors();
  Vec3 determined = Vec3::Zero(), variance = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = errors.axes.col(k);
    if (errors.error_m[k] > kOriginError * wavelength) {
      result.undetermined.push_back(axis);
      continue;
    }
    determined += axis * axis.dot(x);
    const Vec3 error = axis * errors.error_m[k];
    variance += error.cwiseProduct(error);
  }
  x = determined;
  result.origin_error_m = Vec3(std::sqrt(variance.x()), std::sqrt(variance.y()), std::sqrt(variance.z()));
  return result;
}

// Constant phase and signs for the origin that was found, and the correlation after all of it.
void complete(Alignment& alignment, std::span<const AlignmentPoint> points) {
  std::array<Complex, 4> constants{};
  double computed = 0, reference = 0;
  for (const AlignmentPoint& p : points) {
    const Complex other = reference_of(p, alignment.conjugated);
    constants[p.element] += other * std::conj(p.computed_m) * std::polar(1.0, p.path_gradient.dot(alignment.origin_m));
    computed += std::norm(p.computed_m);
    reference += std::norm(p.reference_m);
  }
  const auto first = std::find_if(constants.begin(), constants.end(), [](const Complex& c) { return std::abs(c) > 0; });
  if (first == constants.end()) return;
  Complex sum = 0;
  for (std::size_t e = 0; e < 4; ++e) {
    alignment.sign[e] = std::real(constants[e] * std::conj(*first)) < 0 ? -1 : 1;
    sum += constants[e] * static_cast<double>(alignment.sign[e]);
  }
  alignment.phase_rad = std::arg(sum);
  alignment.correlation = std::abs(sum) / std::sqrt(computed * reference);
  alignment.level_db = 10 * std::log10(reference / computed);
}

}  // namespace

Alignment fit_alignment(std::span<const AlignmentPoint> points, int threads) {
  SEAGLINT_CHECK(!points.empty(), "no points");
  const std::vector<AlignmentPoint> fitted = thinned(points);
  Alignment direct, conjugate;
  parallel_for(2, threads, [&](std::size_t i) {
    Alignment& alignment = i == 0 ? direct : conjugate;
    alignment = fit(fitted, i == 1);
    complete(alignment, points);
    // Phases of targets that differ have maxima of the correlation half a wavelength away from the true origin.
    Alignment in_place = alignment;
    in_place.origin_m = Vec3::Zero();
    complete(in_place, points);
    if (in_place.correlation >= alignment.correlation) alignment = in_place;
  });
  const bool better = 1 - conjugate.correlation < kClearlyBetter * (1 - direct.correlation);
  Alignment& chosen = better ? conjugate : direct;
  chosen.other_correlation = better ? direct.correlation : conjugate.correlation;
  return chosen;
}

Complex aligned(const Alignment& alignment, const AlignmentPoint& point) {
  return static_cast<double>(alignment.sign[point.element]) * reference_of(point, alignment.conjugated) *
         std::polar(1.0, point.path_gradient.dot(alignment.origin_m) - alignment.phase_rad);
}

namespace {

constexpr double kSameUnit_db = 1;          // agreement of an offset with that of a unit
constexpr double kSteady_db = 3;            // largest rms about an offset that is one of a unit
constexpr double kBetterCorrelation = 0.2;  // of levels, by which a mirrored or turned cut is better
constexpr double kGoodCorrelation = 0.7;

// Two series of levels in dB.
struct Levels {
  std::vector<double> reference, compared;
};

Levels levels_of(const PairedCut& cut, double floor_db) {
  const double floor = *std::max_element(cut.level_dbsm.begin(), cut.level_dbsm.end()) - floor_db;
  const std::vector<double>& model = cut.models[0].level_dbsm;
  const double model_floor = *std::max_element(model.begin(), model.end()) - floor_db;
  Levels levels;
  for (std::size_t i = 0; i < cut.level_dbsm.size(); ++i) {
    levels.reference.push_back(std::max(cut.level_dbsm[i], floor));
    levels.compared.push_back(std::max(model[i], model_floor));
  }
  return levels;
}

// Straight line compared = slope reference + offset, and how well it fits.
struct Line {
  double slope = 1, offset_db = 0, correlation = 0, rms_db = 0;  // rms about slope 1
};

Line line_of(const Levels& levels) {
  const double n = static_cast<double>(levels.reference.size());
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < levels.reference.size(); ++i) {
    x += levels.reference[i] / n;
    y += levels.compared[i] / n;
  }
  double rms = 0;
  for (std::size_t i = 0; i < levels.reference.size(); ++i) {
    const double a = levels.reference[i] - x, b = levels.compared[i] - y;
    xx += a * a;
    yy += b * b;
    xy += a * b;
    rms += (a - b) * (a - b) / n;
  }
  if (xx <= 0 || yy <= 0) return {1, y - x, 0, std::sqrt(rms)};
  // The slope of both errors alike (reduced major axis).
  return {std::sqrt(yy / xx), y - x, xy / std::sqrt(xx * yy), std::sqrt(rms)};
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
  return line_of({a, b}).correlation;
}

void suggest_unit(const Line& line, std::vector<std::string>& sentences) {
  constexpr std::array<std::pair<double, const char*>, 8> kOffsets{{
      {60, "an area in mm^2 or a mesh in mm"},
      {40, "an area in cm^2"},
      {30, "dBm for dBsm, or a factor of 1000 in power"},
      {20, "a field in decimetres or a factor of 10 in amplitude"},
      {10.99, "4 pi: |S|^2 taken for the radar cross section"},
      {-10.99, "4 pi: the radar cross section divided by it twice"},
      {-30, "dBm for dBsm, or a factor of 1000 in power"},
      {-60, "an area in mm^2 or a mesh in mm"},
  }};
  if (line.rms_db > kSteady_db) return;
  for (const auto& [offset, what] : kOffsets) {
    if (std::abs(-line.offset_db - offset) > kSameUnit_db) continue;
    sentences.push_back(fmt::format("the export is {:.1f} dB {} throughout: {}?", std::abs(line.offset_db),
                                    line.offset_db < 0 ? "higher" : "lower", what));
  }
}

void suggest_scale(const Line& line, std::vector<std::string>& sentences) {
  constexpr double kTolerance = 0.15;
  if (line.correlation < 0.9) return;
  if (std::abs(line.slope - 0.5) < kTolerance / 2)
    sentences.emplace_back("levels of the export change twice as much in dB: 20 log of an area for 10 log?");
  if (std::abs(line.slope - 2) < 2 * kTolerance)
    sentences.emplace_back("levels of the export change half as much in dB: 10 log of an amplitude for 20 log?");
}

// Levels of a cut along azimuth, by ascending azimuth.
class LevelsByAzimuth {
 public:
  LevelsByAzimuth(const PairedCut& cut, const Levels& levels) : cut_(cut), levels_(levels) {
    for (std::size_t i = 0; i < cut.places.size(); ++i)
      compared_.emplace_back(std::remainder(cut.places[i].azimuth_deg, 360), levels.compared[i]);
    std::sort(compared_.begin(), compared_.end());
  }
  // Correlation of the compared levels at azimuths sense * az + turn_deg with the reference's at az, of about kMost
  // azimuths; 0 below half of them.
  double correlation(double sense, double turn_deg) const {
    constexpr double kNear_deg = 1e-3;
    constexpr std::size_t kMost = 720;
    std::vector<double> a, b;
    const std::size_t step = std::max<std::size_t>(1, cut_.places.size() / kMost);
    for (std::size_t i = 0; i < cut_.places.size(); i += step) {
      const double wanted = std::remainder(sense * cut_.places[i].azimuth_deg + turn_deg, 360);
      const auto place = std::lower_bound(compared_.begin(), compared_.end(), std::pair(wanted - kNear_deg, -1e300));
      if (place == compared_.end() || place->first > wanted + kNear_deg) continue;
      a.push_back(levels_.reference[i]);
      b.push_back(place->second);
    }
    return 2 * step * a.size() < cut_.places.size() || a.size() < 8 ? 0 : correlation_of(a, b);
  }

 private:
  const PairedCut& cut_;
  const Levels& levels_;
  std::vector<std::pair<double, double>> compared_;
};

// The sense and the zero of the azimuth of a cut along azimuth.
void suggest_azimuth(const PairedCut& cut, const Levels& levels, std::vector<std::string>& sentences) {
  if (cut.axis != CutAxis::kAzimuth || cut.places.size() < 8) return;
  const double as_is = correlation_of(levels.reference, levels.compared);
  double best = std::max(as_is + kBetterCorrelation, kGoodCorrelation);
  std::string sentence;
  const auto consider = [&](double correlation, const std::string& text) {
    if (correlation <= best) return;
    best = correlation;
    sentence = text;
  };
  const LevelsByAzimuth by_azimuth(cut, levels);
  const double first = cut.places.front().azimuth_deg;
  constexpr std::size_t kMaxTurns = 720;
  const std::size_t step = std::max<std::size_t>(1, cut.places.size() / kMaxTurns);
  for (std::size_t n = 0; n < cut.places.size(); n += step) {
    const double turn = cut.places[n].azimuth_deg - first;
    for (const double by : {turn, -turn}) {
      consider(by_azimuth.correlation(1, by),
               fmt::format("azimuths turned by {:g} deg fit better: --reference-phi 1,{:g}?", by, -by));
      consider(by_azimuth.correlation(-1, by),
               fmt::format("mirrored azimuths fit better: --reference-phi -1,{:g}?", by));
    }
  }
  if (!sentence.empty()) {
    sentences.push_back(fmt::format("{} (correlation of levels {:.2f}, as it is {:.2f})", sentence, best, as_is));
  }
}

// Profile at ranges r / scale, in dB, linearly interpolated; that of the floor outside.
std::vector<double> stretched(const RangeProfile& profile, double scale, double floor_db) {
  std::vector<double> levels;
  const double first = profile.range_m.front(), step = profile.range_m[1] - first;
  for (const double range : profile.range_m) {
    const double at = (range / scale - first) / step;
    const double whole = std::floor(at);
    const bool inside = whole >= 0 && whole + 1 < static_cast<double>(profile.range_m.size());
    if (!inside) {
      levels.push_back(floor_db);
      continue;
    }
    const auto i = static_cast<std::size_t>(whole);
    const double level = profile.level_dbsm[i] + (at - whole) * (profile.level_dbsm[i + 1] - profile.level_dbsm[i]);
    levels.push_back(std::max(level, floor_db));
  }
  return levels;
}

// A mesh of another size stretches the range profile about the phase origin.
void suggest_size(const PairedCut& cut, std::vector<std::string>& sentences) {
  constexpr double kDynamic_db = 30;
  constexpr int kSteps = 70;  // of 1 % to either side
  if (cut.axis != CutAxis::kFrequency || !cut.has_phases()) return;
  const RangeProfile reference = range_profile(cut.places, cut.amplitude_m),
                     compared = range_profile(cut.places, cut.models[0].amplitude_m);
  if (reference.range_m.size() < 2) return;
  const auto clipped = [&](const RangeProfile& profile, double scale) {
    const double highest = *std::max_element(profile.level_dbsm.begin(), profile.level_dbsm.end());
    return stretched(profile, scale, highest - kDynamic_db);
  };
  const std::vector<double> wanted = clipped(reference, 1);
  const double as_is = correlation_of(wanted, clipped(compared, 1));
  double best = std::max(as_is + kBetterCorrelation, kGoodCorrelation), size = 1;
  for (int n = -kSteps; n <= kSteps; ++n) {
    const double scale = std::pow(1.01, n), correlation = correlation_of(wanted, clipped(compared, scale));
    if (correlation <= best) continue;
    best = correlation;
    size = scale;
  }
  if (size == 1) return;
  sentences.push_back(fmt::format(
      "range profiles fit better if the export's mesh is {:.2f} times as large (correlation {:.2f}, as it is {:.2f})",
      size, best, as_is));
}

// |<conj(reference) compared>| / (|reference| |compared|) of one element; 0 without phases.
double correlation_of(const std::vector<PairedCut>& cuts, Polarisation element) {
  DifferenceSum sum;
  for (const PairedCut& cut : cuts) {
    if (cut.element != element || cut.models[0].amplitude_m.size() != cut.amplitude_m.size()) continue;
    for (std::size_t i = 0; i < cut.amplitude_m.size(); ++i)
      sum.add_phases(cut.models[0].amplitude_m[i], cut.amplitude_m[i]);
  }
  return std::abs(sum.correlation().value_or(0));
}

}  // namespace

std::vector<std::string> fitted_conventions(const Alignment& alignment, const std::vector<PairedCut>& cuts) {
  constexpr double kMeaningful = 0.5;  // least correlation
  std::vector<std::string> sentences;
  if (alignment.correlation < kMeaningful) return sentences;
  if (alignment.conjugated)
    sentences.push_back(
        fmt::format("the export has the other time factor, e^{{-jwt}}: conjugated (correlation {:.3f}, as "
                    "it is {:.3f})",
                    alignment.correlation, alignment.other_correlation));
  for (std::size_t e = 0; e < alignment.sign.size(); ++e) {
    if (alignment.sign[e] < 0 && correlation_of(cuts, static_cast<Polarisation>(e)) > kMeaningful)
      sentences.push_back(fmt::format("{} of the export has the opposite sign", kPolarisationNames[e]));
  }
  double shortest = 1e300;
  for (const PairedCut& cut : cuts) {
    for (const PairedCut::Place& place : cut.places) shortest = std::min(shortest, kSpeedOfLight / place.frequency_hz);
  }
  if (alignment.origin_m.norm() > shortest / 8) {
    sentences.push_back(
        fmt::format("the export's phase origin, or its mesh, is displaced: origin at {:.4f}, {:.4f}, "
                    "{:.4f} m",
                    alignment.origin_m.x(), alignment.origin_m.y(), alignment.origin_m.z()));
  }
  return sentences;
}

std::vector<std::string> suggestions(const std::vector<PairedCut>& cuts, double floor_db) {
  std::vector<std::string> sentences;
  Levels all;
  const PairedCut* longest = nullptr;
  for (const PairedCut& cut : cuts) {
    const Levels levels = levels_of(cut, floor_db);
    all.reference.insert(all.reference.end(), levels.reference.begin(), levels.reference.end());
    all.compared.insert(all.compared.end(), levels.compared.begin(), levels.compared.end());
    if (longest == nullptr || cut.places.size() > longest->places.size()) longest = &cut;
  }
  if (longest == nullptr || all.reference.size() < 2) return sentences;
  const Line line = line_of(all);
  suggest_unit(line, sentences);
  suggest_scale(line, sentences);
  suggest_azimuth(*longest, levels_of(*longest, floor_db), sentences);
  suggest_size(*longest, sentences);
  return sentences;
}

}  // namespace seaglint
