// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/paired_cut.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {

std::vector<ViewGrid> view_grids(std::span<const ViewPoint> points) {
  using Direction = std::pair<double, double>;  // elevation, azimuth
  std::map<Direction, std::vector<double>> frequencies;
  std::vector<ViewPoint> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const ViewPoint& p : sorted) frequencies[{p.elevation_deg, p.azimuth_deg}].push_back(p.frequency_hz);

  std::map<std::vector<double>, std::map<double, std::vector<double>>> azimuths;  // by frequencies, then elevation
  for (const auto& [direction, list] : frequencies) azimuths[list][direction.first].push_back(direction.second);

  std::vector<ViewGrid> grids;
  for (const auto& [list, rows] : azimuths) {
    std::map<std::vector<double>, std::vector<double>> elevations;  // by azimuths
    for (const auto& [elevation, row] : rows) elevations[row].push_back(elevation);
    for (const auto& [row, column] : elevations) grids.push_back({list, row, column});
  }
  return grids;
}

std::vector<ViewGrid> cuts_of(const ViewGrid& grid) {
  const std::size_t azimuths = grid.azimuth_deg.size(), elevations = grid.elevation_deg.size();
  const bool along_frequency = grid.frequency_hz.size() > std::max(azimuths, elevations);
  std::vector<ViewGrid> cuts;
  const auto add = [&](const std::vector<double>& azimuth_deg, const std::vector<double>& elevation_deg) {
    cuts.push_back({grid.frequency_hz, azimuth_deg, elevation_deg});
  };
  if (along_frequency) {
    for (const double el : grid.elevation_deg) {
      for (const double az : grid.azimuth_deg) add({az}, {el});
    }
  } else if (azimuths >= elevations) {
    for (const double el : grid.elevation_deg) add(grid.azimuth_deg, {el});
  } else {
    for (const double az : grid.azimuth_deg) add({az}, grid.elevation_deg);
  }
  return cuts;
}

namespace {

constexpr double kFrequencyTolerance = 1e-6;  // relative, of equal frequencies

double azimuth_of(const RcsCut& cut, double phi_deg) {
  return std::remainder((phi_deg - cut.phi_offset_deg) / cut.phi_scale, 360);
}

// k (r^_t + r^_s), rad/m; without a transmitter of one antenna.
Vec3 path_gradient(const ViewPoint& p, const std::optional<Vec3>& transmitter) {
  const Vec3 r = direction_to_radar(radians(p.azimuth_deg), radians(p.elevation_deg));
  return 2 * kPi * p.frequency_hz / kSpeedOfLight * (transmitter.value_or(r) + r);
}

}  // namespace

ViewPoint view_point(const RcsCut& cut, const FieldValue& value) {
  return {value.frequency_hz, azimuth_of(cut, value.phi_deg), 90 - value.theta_deg};
}

const DeclaredTransmitter& stated_transmitter(const RcsCut& cut) {
  if (cut.transmitter) return *cut.transmitter;
  throw InputError(fmt::format(
      "{}: neither the file nor its name says where the incident wave comes from: give --incidence monostatic "
      "or --incidence THETA,PHI",
      cut.name));
}

std::optional<FixedTransmitter> fixed_transmitter(const RcsCut& cut) {
  const DeclaredTransmitter& transmitter = stated_transmitter(cut);
  if (transmitter.is_monostatic) return std::nullopt;
  return FixedTransmitter{azimuth_of(cut, transmitter.phi_deg), 90 - transmitter.theta_deg};
}

namespace {

constexpr double kAngleStep_deg = 1e-3;  // CST prints three decimals
constexpr double kSameLevel_db = 0.1;    // allowed difference of a direction that a file contains twice

// The values of a cut by frequency and direction.
class ValuesByPlace {
 public:
  // Throws InputError for a place that has two different levels.
  explicit ValuesByPlace(const RcsCut& cut) : phi_scale_(cut.phi_scale), phi_offset_deg_(cut.phi_offset_deg) {
    for (const FieldValue& value : cut.values) frequency_hz_.push_back(value.frequency_hz);
    std::ranges::sort(frequency_hz_);
    frequency_hz_.erase(std::unique(frequency_hz_.begin(), frequency_hz_.end()), frequency_hz_.end());
    by_place_.reserve(cut.values.size());
    for (const FieldValue& value : cut.values) {
      const auto [first, is_new] = by_place_.try_emplace(
          key(index_of(value.frequency_hz), steps(value.theta_deg), steps(value.phi_deg)), &value);
      if (!is_new && std::abs(first->second->level_dbsm - value.level_dbsm) > kSameLevel_db)
        throw InputError(fmt::format("{}: theta {} phi {} at {} GHz is a duplicate, with {} and {} dBsm", cut.name,
                                     value.theta_deg, value.phi_deg, value.frequency_hz * 1e-9,
                                     first->second->level_dbsm, value.level_dbsm));
    }
  }

  // Null where there is none. Rounding may give equal angles neighbouring keys.
  const FieldValue* at(const ViewPoint& place) const {
    const long at_theta = steps(90 - place.elevation_deg),
               at_phi = steps(phi_scale_ * place.azimuth_deg + phi_offset_deg_);
    for (std::size_t f = index_of((1 - kFrequencyTolerance) * place.frequency_hz);
         f < frequency_hz_.size() && frequency_hz_[f] <= (1 + kFrequencyTolerance) * place.frequency_hz; ++f) {
      for (const long theta : {0L, -1L, 1L}) {
        for (const long phi : {0L, -1L, 1L}) {
          const auto found = by_place_.find(key(f, at_theta + theta, at_phi + phi));
          if (found != by_place_.end()) return found->second;
        }
      }
    }
    return nullptr;
  }

 private:
  static long steps(double angle_deg) { return std::lround(angle_deg / kAngleStep_deg); }
  static std::uint64_t key(std::size_t frequency, long theta, long phi) {
    constexpr long kCircle = 360'000;  // steps in 360 deg
    const auto turn = static_cast<std::uint64_t>((phi % kCircle + kCircle) % kCircle);
    return (static_cast<std::uint64_t>(frequency) << 40) | (turn << 20) | static_cast<std::uint64_t>(theta + kCircle);
  }
  std::size_t index_of(double frequency_hz) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(frequency_hz_, frequency_hz) - frequency_hz_.begin());
  }

  double phi_scale_, phi_offset_deg_;
  std::vector<double> frequency_hz_;  // ascending, each once
  std::unordered_map<std::uint64_t, const FieldValue*> by_place_;
};

std::string span_text(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values.size() == 1 ? fmt::format("{:g}", values[0])
                            : fmt::format("{:g} to {:g} ({} values)", values.front(), values.back(), values.size());
}

[[noreturn]] void fail_pairing(const RcsSweep& sweep, const RcsCut& reference) {
  std::vector<double> f, theta, phi;
  for (const FieldValue& s : reference.values) {
    f.push_back(s.frequency_hz * 1e-9);
    theta.push_back(s.theta_deg);
    phi.push_back(s.phi_deg);
  }
  std::vector<double> sweep_f, sweep_theta, sweep_phi;
  for (const double hz : sweep.frequency_hz) sweep_f.push_back(hz * 1e-9);
  for (const double el : sweep.elevation_deg) sweep_theta.push_back(90 - el);
  for (const double az : sweep.azimuth_deg) sweep_phi.push_back(reference.phi_scale * az + reference.phi_offset_deg);
  throw InputError(fmt::format(
      "{}: no direction in common with the sweep; the file has {} GHz, theta {}, phi {} deg, the sweep {} GHz, theta "
      "{}, phi {} deg "
      "(theta = 90 - elevation, phi by --reference-phi {:g},{:g})",
      reference.name, span_text(f), span_text(theta), span_text(phi), span_text(sweep_f), span_text(sweep_theta),
      span_text(sweep_phi), reference.phi_scale, reference.phi_offset_deg));
}

Vec3 unit_vector(double theta_deg, double phi_deg) {
  const double theta = radians(theta_deg), phi = radians(phi_deg);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Throws InputError if the transmitters differ: monostatic and bistatic echoes are different quantities even at equal
// angles.
void require_same_transmitter(const RcsSweep& sweep, const RcsCut& reference) {
  if (!reference.transmitter) return;
  const DeclaredTransmitter& declared = *reference.transmitter;
  const auto fail = [&](const std::string& of_sweep) {
    throw InputError(fmt::format("{}: {}, {}", reference.name,
                                 declared.is_monostatic
                                     ? std::string("is declared monostatic")
                                     : fmt::format("its transmitter is at azimuth {:g} deg, elevation {:g} deg",
                                                   declared.phi_deg, 90 - declared.theta_deg),
                                 of_sweep));
  };
  if (!sweep.transmitter) {
    if (!declared.is_monostatic)
      fail("the sweep is monostatic: give --transmit-azimuth-deg and --transmit-elevation-deg");
    return;
  }
  const Vec3& t = *sweep.transmitter;
  const double theta_deg = degrees(std::acos(std::clamp(t.z(), -1.0, 1.0)));
  const double phi_deg = reference.phi_scale * degrees(std::atan2(t.y(), t.x())) + reference.phi_offset_deg;
  const std::string of_sweep = fmt::format(
      "the sweep's transmitter is at azimuth {:g} deg, elevation {:g} deg of the same angles", phi_deg, 90 - theta_deg);
  if (declared.is_monostatic ||
      (unit_vector(theta_deg, phi_deg) - unit_vector(declared.theta_deg, declared.phi_deg)).norm() >
          radians(kAngleStep_deg))
    fail(of_sweep);
}

CutAxis axis_of(const RcsSweep& sweep) {
  if (sweep.views() == 1) return CutAxis::kFrequency;
  if (sweep.elevation_deg.size() == 1) return CutAxis::kAzimuth;
  return sweep.azimuth_deg.size() == 1 ? CutAxis::kElevation : CutAxis::kSeveral;
}

}  // namespace

const char* axis_unit(CutAxis axis) {
  switch (axis) {
    case CutAxis::kFrequency: return "GHz";
    case CutAxis::kSeveral: return "th";
    default: return "deg";
  }
}

std::vector<PairedCut> paired_cuts(const RcsSweep& sweep, const RcsCut& reference) {
  require_same_transmitter(sweep, reference);
  const CutAxis axis = axis_of(sweep);
  const ValuesByPlace values(reference);
  std::vector<PairedCut> cuts;
  for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
    const double f = sweep.frequency_hz[q];
    if (cuts.empty() || axis != CutAxis::kFrequency) {
      PairedCut& cut = cuts.emplace_back();
      cut.reference = reference.name;
      cut.element = reference.element;
      cut.total = reference.total;
      cut.origin_m = reference.origin_m;
      cut.axis = axis;
      if (axis != CutAxis::kFrequency) cut.frequency_hz = f;
    }
    PairedCut& cut = cuts.back();
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      const double az = sweep.azimuth_of(view), el = sweep.elevation_of(view);
      const FieldValue* sample = values.at({f, az, el});
      if (!sample) continue;
      cut.x.push_back(axis == CutAxis::kAzimuth     ? az
                      : axis == CutAxis::kElevation ? el
                      : axis == CutAxis::kFrequency ? f * 1e-9
                                                    : static_cast<double>(cut.x.size() + 1));
      cut.level_dbsm.push_back(sample->level_dbsm);
      const Vec3 gradient = path_gradient({f, az, el}, sweep.transmitter);
      // For a phase origin at x0 the two-way path is shorter by (r^_t + r^_s).x0 than for the body's origin
      // (CONVENTIONS.md, "Scattering").
      if (sample->amplitude_m)
        cut.amplitude_m.push_back(reference.origin_m.isZero(1e-12)
                                      ? *sample->amplitude_m
                                      : *sample->amplitude_m * std::polar(1.0, gradient.dot(reference.origin_m)));
      cut.places.push_back({view, q, f, az, el, gradient, sample->line});
    }
  }
  std::erase_if(cuts, [](const PairedCut& cut) { return cut.x.empty(); });
  for (PairedCut& cut : cuts) set_models(cut, sweep);
  return cuts;
}

std::vector<PairedCut> match_reference(const RcsSweep& sweep, const RcsCut& reference) {
  std::vector<PairedCut> cuts = paired_cuts(sweep, reference);
  if (cuts.empty()) fail_pairing(sweep, reference);
  return cuts;
}

void set_models(PairedCut& cut, const RcsSweep& sweep) {
  const auto along_cut = [&](const RcsSweep::Model& model) {
    PairedCut::Model values{model.name, {}, {}};
    for (const PairedCut::Place& place : cut.places) {
      const std::array<Complex, 4>& matrix = model.matrices[place.view][place.frequency];
      values.level_dbsm.push_back(dbsm_of_area(4 * kPi * squared_magnitude(matrix, cut.quantity())));
      if (!cut.total) values.amplitude_m.push_back(matrix[static_cast<std::size_t>(cut.element)]);
    }
    return values;
  };
  cut.models.clear();
  for (const RcsSweep::Model& model : sweep.models) cut.models.push_back(along_cut(model));
  cut.flat.reset();
  if (sweep.flat) cut.flat = along_cut(*sweep.flat);
}

namespace {

bool same_places(const RcsCut& a, const RcsCut& b) {
  return a.values.size() == b.values.size() &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(), [](const FieldValue& x, const FieldValue& y) {
           return x.frequency_hz == y.frequency_hz && x.theta_deg == y.theta_deg && x.phi_deg == y.phi_deg;
         });
}

}  // namespace

std::vector<RcsCut> sums_for(const RcsCut& total, const FieldTable& table) {
  std::vector<RcsCut> sums;
  for (const RcsCut& v : table.cuts) {
    for (const RcsCut& h : table.cuts) {
      if (v.total || h.total || v.element != element_of(true, transmits_v(total.element)) ||
          h.element != element_of(false, transmits_v(total.element)) || v.transmitter != h.transmitter ||
          !same_places(v, h))
        continue;
      RcsCut& sum = sums.emplace_back(v);
      sum.element = total.element;
      sum.total = true;
      for (std::size_t i = 0; i < sum.values.size(); ++i) {
        sum.values[i].amplitude_m.reset();
        sum.values[i].level_dbsm =
            dbsm_of_area(std::pow(10.0, v.values[i].level_dbsm / 10) + std::pow(10.0, h.values[i].level_dbsm / 10));
      }
    }
  }
  return sums;
}

std::vector<RcsSweep> table_sweeps(const RcsCut& cut, const RcsCut& other) {
  const ValuesByPlace values(other);
  std::vector<ViewPoint> points;
  for (const FieldValue& value : cut.values) {
    const ViewPoint p = view_point(cut, value);
    if (values.at(p) != nullptr) points.push_back(p);
  }
  std::vector<RcsSweep> sweeps;
  for (const ViewGrid& grid : view_grids(points)) {
    RcsRequest request;
    request.frequency_hz = grid.frequency_hz;
    request.azimuth_deg = grid.azimuth_deg;
    request.elevation_deg = grid.elevation_deg;
    request.transmitter = fixed_transmitter(cut);
    RcsSweep& sweep = sweeps.emplace_back(requested_sweep(request));
    RcsSweep::Model model{other.name, true, {}};
    model.matrices.assign(sweep.views(), std::vector<std::array<Complex, 4>>(sweep.frequency_hz.size()));
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      for (std::size_t view = 0; view < sweep.views(); ++view) {
        const ViewPoint place{sweep.frequency_hz[q], sweep.azimuth_of(view), sweep.elevation_of(view)};
        const FieldValue& value = *values.at(place);
        Complex amplitude = value.amplitude_m.value_or(amplitude_of_dbsm(value.level_dbsm));
        if (value.amplitude_m && !other.origin_m.isZero(1e-12))
          amplitude *= std::polar(1.0, path_gradient(place, sweep.transmitter).dot(other.origin_m));
        model.matrices[view][q][static_cast<std::size_t>(other.element)] = amplitude;
      }
    }
    sweep.models.push_back(std::move(model));
  }
  return sweeps;
}

namespace {

constexpr std::size_t kMostNeighbours = 48;
constexpr double kReach = 8;           // half-waves pi / radius
constexpr double kSampleError = 1e-4;  // of the mean level

// Correlation of amplitudes for centres equally dense in a sphere, 3 j_1(u) / u.
double centre_correlation(double u) {
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
    if (const std::optional<FixedTransmitter> fixed = fixed_transmitter(cut))
      transmitter_ = direction_to_radar(radians(fixed->azimuth_deg), radians(fixed->elevation_deg));
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
      one[i] = centre_correlation(radius_m_ * (a - q).norm());
      all(i, i) = 1 + kSampleError * kSampleError;
      for (Eigen::Index j = 0; j < i; ++j)
        all(i, j) = centre_correlation(radius_m_ * (a - q_[result.neighbours[static_cast<std::size_t>(j)]]).norm());
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
  Vec3 gradient(const ViewPoint& p) const { return path_gradient(p, transmitter_); }

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
  std::optional<Vec3> transmitter_;
  double radius_m_;
  std::size_t axis_ = 0;                   // along which the gradients extend furthest
  std::vector<Vec3> q_;                    // ascending along it
  std::vector<const FieldValue*> sorted_;  // in their order
};

// The cut's values by frequency, each with those within kFrequencyTolerance of the first.
std::vector<std::pair<double, FrequencySamples>> by_frequency(const RcsCut& cut, double radius_m) {
  std::vector<const FieldValue*> values;
  for (const FieldValue& value : cut.values) values.push_back(&value);
  std::stable_sort(values.begin(), values.end(),
                   [](const FieldValue* a, const FieldValue* b) { return a->frequency_hz < b->frequency_hz; });
  std::vector<std::pair<double, FrequencySamples>> samples;
  for (auto first = values.begin(); first != values.end();) {
    const double frequency = (*first)->frequency_hz;
    const auto end = std::find_if(first, values.end(), [&](const FieldValue* value) {
      return value->frequency_hz > frequency * (1 + kFrequencyTolerance);
    });
    samples.emplace_back(frequency, FrequencySamples(cut, {first, end}, radius_m));
    first = end;
  }
  return samples;
}

const FrequencySamples* at_frequency(const std::vector<std::pair<double, FrequencySamples>>& samples,
                                     double frequency) {
  for (const auto& [f, values] : samples) {
    if (std::abs(f - frequency) <= kFrequencyTolerance * frequency) return &values;
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
