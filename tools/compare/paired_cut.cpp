// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/paired_cut.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

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

double azimuth_of(const RcsCut& cut, double phi_deg) {
  return std::remainder((phi_deg - cut.phi_offset_deg) / cut.phi_scale, 360);
}

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
constexpr double kFrequencyTolerance = 1e-6;
constexpr double kSameLevel_db = 0.1;  // allowed difference of a direction that a file contains twice

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
    const double f = sweep.frequency_hz[q], k = 2 * kPi * f / kSpeedOfLight;
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
      const Vec3 r = direction_to_radar(radians(az), radians(el));
      const Vec3 path_gradient = k * (sweep.transmitter.value_or(r) + r);
      // For a phase origin at x0 the two-way path is shorter by (r^_t + r^_s).x0 than for the body's origin
      // (CONVENTIONS.md, "Scattering").
      if (sample->amplitude_m)
        cut.amplitude_m.push_back(reference.origin_m.isZero(1e-12)
                                      ? *sample->amplitude_m
                                      : *sample->amplitude_m * std::polar(1.0, path_gradient.dot(reference.origin_m)));
      cut.places.push_back({view, q, f, az, el, path_gradient, sample->line});
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
  const auto element = static_cast<std::size_t>(cut.element);
  const auto along_cut = [&](const RcsSweep::Model& model) {
    PairedCut::Model values{model.name, {}, {}};
    for (const PairedCut::Place& place : cut.places) {
      const std::array<Complex, 4>& matrix = model.matrices[place.view][place.frequency];
      if (cut.total) {
        const Complex h = matrix[static_cast<std::size_t>(element_of(false, transmits_v(cut.element)))],
                      v = matrix[static_cast<std::size_t>(element_of(true, transmits_v(cut.element)))];
        values.level_dbsm.push_back(dbsm_of_area(4 * kPi * (std::norm(h) + std::norm(v))));
        continue;
      }
      values.level_dbsm.push_back(dbsm(matrix[element]));
      values.amplitude_m.push_back(matrix[element]);
    }
    return values;
  };
  cut.models.clear();
  for (const RcsSweep::Model& model : sweep.models) cut.models.push_back(along_cut(model));
  cut.flat.reset();
  if (sweep.flat) cut.flat = along_cut(*sweep.flat);
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
      const double f = sweep.frequency_hz[q], k = 2 * kPi * f / kSpeedOfLight;
      for (std::size_t view = 0; view < sweep.views(); ++view) {
        const double az = sweep.azimuth_of(view), el = sweep.elevation_of(view);
        const FieldValue& value = *values.at({f, az, el});
        Complex amplitude = value.amplitude_m.value_or(amplitude_of_dbsm(value.level_dbsm));
        if (value.amplitude_m && !other.origin_m.isZero(1e-12)) {
          const Vec3 r = direction_to_radar(radians(az), radians(el));
          amplitude *= std::polar(1.0, k * (sweep.transmitter.value_or(r) + r).dot(other.origin_m));
        }
        model.matrices[view][q][static_cast<std::size_t>(other.element)] = amplitude;
      }
    }
    sweep.models.push_back(std::move(model));
  }
  return sweeps;
}

}  // namespace seaglint
