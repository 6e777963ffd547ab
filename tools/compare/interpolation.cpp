// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/interpolation.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/scattering/observation/observation.h"
#include "tools/compare/paired_cut.h"

namespace seaglint {
namespace {

constexpr std::size_t kMostNeighbours = 48;
constexpr double kReach = 8;           // half-waves pi / radius
constexpr double kSampleError = 1e-4;  // of the mean level
constexpr double kEqualFrequency = 1e-6;

// Correlation of amplitudes for centres equally dense in a sphere, 3 j_1(u) / u.
double correlation(double u) {
  if (u < 1e-2) return 1 - u * u / 10;  // next term u^4 / 280
  return 3 * (std::sin(u) - u * std::cos(u)) / (u * u * u);
}

// Equally distributed unit vectors (Fibonacci's spiral: Swinbank & Purser 2006).
std::vector<Vec3> sphere_points(int count) {
  const double golden = kPi * (3 - std::sqrt(5.0));
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, rho = std::sqrt(1 - z * z);
    points.emplace_back(rho * std::cos(golden * i), rho * std::sin(golden * i), z);
  }
  return points;
}

// The values of one frequency by their path gradients.
class FrequencySamples {
 public:
  FrequencySamples(const RcsCut& cut, const std::vector<const FieldValue*>& values, double radius_m)
      : cut_(cut), radius_m_(cut.has_phase() ? radius_m : 2 * radius_m) {
    std::vector<Vec3> gradients;
    for (const FieldValue* value : values) gradients.push_back(gradient(view_point(cut, *value)));
    Vec3 low = gradients.front(), high = low;
    for (const Vec3& q : gradients) low = low.cwiseMin(q), high = high.cwiseMax(q);
    axis_ = (high - low).longest_axis();
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return gradients[a][axis_] < gradients[b][axis_]; });
    for (const std::size_t i : order) {
      q_.push_back(gradients[i]);
      sorted_.push_back(values[i]);
    }
  }

  struct Estimate {
    std::vector<std::size_t> neighbours;
    Eigen::VectorXd weights;
    double standard_error = 1;
  };

  Estimate estimate(const ViewPoint& place) const {
    const Vec3 q = gradient(place);
    Estimate result;
    result.neighbours = nearest(q);
    const auto count = static_cast<Eigen::Index>(result.neighbours.size());
    if (count == 0) return result;
    Eigen::MatrixXd all(count, count);
    Eigen::VectorXd one(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vec3& a = q_[result.neighbours[static_cast<std::size_t>(i)]];
      one[i] = correlation(radius_m_ * (a - q).norm());
      all(i, i) = 1 + kSampleError * kSampleError;
      for (Eigen::Index j = 0; j < i; ++j)
        all(i, j) = correlation(radius_m_ * (a - q_[result.neighbours[static_cast<std::size_t>(j)]]).norm());
    }
    result.weights = all.selfadjointView<Eigen::Lower>().llt().solve(one);
    result.standard_error = std::sqrt(std::max(0.0, 1 - one.dot(result.weights)));
    return result;
  }

  FieldValue value(const ViewPoint& place, const Estimate& estimate) const {
    FieldValue value{place.frequency_hz,
                     90 - place.elevation_deg,
                     std::fmod(place.azimuth_deg * cut_.phi_scale + cut_.phi_offset_deg, 360),
                     kMinLevel_dbsm,
                     {},
                     0};
    if (value.phi_deg < 0) value.phi_deg += 360;
    Complex amplitude = 0;
    double area = 0;
    for (std::size_t i = 0; i < estimate.neighbours.size(); ++i) {
      const FieldValue& sample = *sorted_[estimate.neighbours[i]];
      const double weight = estimate.weights[static_cast<Eigen::Index>(i)];
      if (sample.amplitude_m) amplitude += weight * *sample.amplitude_m;
      if (!sample.amplitude_m) area += weight * std::pow(10.0, sample.level_dbsm / 10);
    }
    if (cut_.has_phase()) value.amplitude_m = amplitude;
    value.level_dbsm = std::max(kMinLevel_dbsm, cut_.has_phase() ? dbsm(amplitude) : dbsm_of_area(std::max(area, 0.0)));
    return value;
  }

  // |e^{j q.x} - sum w_i e^{j q_i.x}| of the worst centre x of these on the sphere.
  double largest_error(const ViewPoint& place, const Estimate& estimate, std::span<const Vec3> directions) const {
    const Vec3 q = gradient(place);
    double largest = 0;
    for (const Vec3& direction : directions) {
      Complex error = 1;
      for (std::size_t i = 0; i < estimate.neighbours.size(); ++i)
        error -= std::polar(1.0, radius_m_ * (q_[estimate.neighbours[i]] - q).dot(direction)) *
                 estimate.weights[static_cast<Eigen::Index>(i)];
      largest = std::max(largest, std::abs(error));
    }
    return largest;
  }

 private:
  Vec3 gradient(const ViewPoint& p) const {
    const Vec3 r = direction_to_radar(radians(p.azimuth_deg), radians(p.elevation_deg));
    const std::optional<FixedTransmitter> fixed = fixed_transmitter(cut_);
    const Vec3 t = fixed ? direction_to_radar(radians(fixed->azimuth_deg), radians(fixed->elevation_deg)) : r;
    return 2 * kPi * p.frequency_hz / kSpeedOfLight * (t + r);
  }

  // The nearest samples within kReach half-waves, at most kMostNeighbours, nearest first.
  std::vector<std::size_t> nearest(const Vec3& q) const {
    const double reach = kReach * kPi / radius_m_;
    const auto below = [&](const Vec3& a, double x) { return a[axis_] < x; };
    std::vector<std::pair<double, std::size_t>> found;
    for (auto i = std::lower_bound(q_.begin(), q_.end(), q[axis_] - reach, below);
         i != q_.end() && (*i)[axis_] <= q[axis_] + reach; ++i) {
      const double distance = (*i - q).norm();
      if (distance <= reach) found.emplace_back(distance, static_cast<std::size_t>(i - q_.begin()));
    }
    const std::size_t count = std::min(kMostNeighbours, found.size());
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), found.end());
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < count; ++i) indices.push_back(found[i].second);
    return indices;
  }

  const RcsCut& cut_;
  double radius_m_;
  std::size_t axis_ = 0;                   // along which the gradients extend furthest
  std::vector<Vec3> q_;                    // ascending along it
  std::vector<const FieldValue*> sorted_;  // in their order
};

// The cut's values by frequency, each with those within kEqualFrequency of the first.
std::vector<std::pair<double, FrequencySamples>> by_frequency(const RcsCut& cut, double radius_m) {
  std::vector<const FieldValue*> values;
  for (const FieldValue& value : cut.values) values.push_back(&value);
  std::stable_sort(values.begin(), values.end(),
                   [](const FieldValue* a, const FieldValue* b) { return a->frequency_hz < b->frequency_hz; });
  std::vector<std::pair<double, FrequencySamples>> samples;
  for (auto first = values.begin(); first != values.end();) {
    const double frequency = (*first)->frequency_hz;
    const auto end = std::find_if(first, values.end(), [&](const FieldValue* value) {
      return value->frequency_hz > frequency * (1 + kEqualFrequency);
    });
    samples.emplace_back(frequency, FrequencySamples(cut, {first, end}, radius_m));
    first = end;
  }
  return samples;
}

const FrequencySamples* at_frequency(const std::vector<std::pair<double, FrequencySamples>>& samples,
                                     double frequency) {
  for (const auto& [f, values] : samples) {
    if (std::abs(f - frequency) <= kEqualFrequency * frequency) return &values;
  }
  return nullptr;
}

[[noreturn]] void throw_too_coarse(const RcsCut& cut, std::span<const ViewPoint> places, double radius_m) {
  double highest = 0;
  for (const ViewPoint& place : places) highest = std::max(highest, place.frequency_hz);
  const double half_waves = (fixed_transmitter(cut) ? 2 : 4) * (cut.has_phase() ? 1 : 2);
  throw InputError(fmt::format(
      "{}: its directions are too far apart to be interpolated, or none is near those of the export: a target that "
      "reaches {:g} m from the phase origin needs steps below {:.3g} deg at {:g} GHz (wavelength / {:g} radii)",
      cut.name, radius_m, degrees(kSpeedOfLight / highest / (half_waves * radius_m)), 1e-9 * highest, half_waves));
}

}  // namespace

InterpolationQuality combined(const InterpolationQuality& a, const InterpolationQuality& b) {
  const auto n = static_cast<double>(a.interpolated), m = static_cast<double>(b.interpolated);
  return {a.radius_m, a.interpolated + b.interpolated, a.omitted + b.omitted,
          std::sqrt((n * a.standard_error * a.standard_error + m * b.standard_error * b.standard_error) / (n + m)),
          std::max(a.largest_error, b.largest_error)};
}

std::string text_of(const InterpolationQuality& quality) {
  const auto decibels = [](double error) { return 20 * std::log10(std::max(error, kSampleError)); };
  return fmt::format(
      "interpolated at {} places, {} omitted, for a target within {:g} m of its phase origin: standard error {:.0f} "
      "dB, at most {:.0f} dB of a scattering centre",
      quality.interpolated, quality.omitted, quality.radius_m, decibels(quality.standard_error),
      decibels(quality.largest_error));
}

InterpolatedCut interpolated_cut(const RcsCut& cut, std::span<const ViewPoint> places, double radius_m, int threads) {
  constexpr std::size_t kExamined = 100;  // places of the largest standard errors
  constexpr int kCentres = 500;
  const auto samples = by_frequency(cut, radius_m);
  struct Result {
    std::optional<FieldValue> value;
    double standard_error = 1;
  };
  std::vector<Result> results(places.size());
  parallel_for(places.size(), threads, [&](std::size_t i) {
    const FrequencySamples* values = at_frequency(samples, places[i].frequency_hz);
    if (values == nullptr) return;
    const FrequencySamples::Estimate estimate = values->estimate(places[i]);
    results[i].standard_error = estimate.standard_error;
    if (estimate.standard_error <= kLargestInterpolationError) results[i].value = values->value(places[i], estimate);
  });
  InterpolatedCut interpolated{cut, {radius_m, 0, 0, 0, 0}};
  interpolated.cut.values.clear();
  InterpolationQuality& quality = interpolated.quality;
  std::vector<std::size_t> order;
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!results[i].value) continue;
    interpolated.cut.values.push_back(*results[i].value);
    sum += results[i].standard_error * results[i].standard_error;
    order.push_back(i);
  }
  quality.interpolated = order.size();
  quality.omitted = places.size() - order.size();
  if (order.empty()) throw_too_coarse(cut, places, radius_m);
  quality.standard_error = std::sqrt(sum / static_cast<double>(order.size()));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return results[a].standard_error > results[b].standard_error; });
  order.resize(std::min(kExamined, order.size()));
  const std::vector<Vec3> centres = sphere_points(kCentres);
  for (const std::size_t i : order) {
    const FrequencySamples& values = *at_frequency(samples, places[i].frequency_hz);
    quality.largest_error =
        std::max(quality.largest_error, values.largest_error(places[i], values.estimate(places[i]), centres));
  }
  return interpolated;
}

}  // namespace seaglint
