// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/paired_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {
namespace {

constexpr double kAngleStep_deg = 1e-3;  // CST prints three decimals
constexpr long kCircle = 360'000;        // steps in 360 deg
constexpr double kFrequencyTolerance = 1e-6;
constexpr double kSameLevel_db = 0.1;  // allowed difference of a direction that a file contains twice

// Direction in steps, theta in the upper and phi in the lower half.
using DirectionKey = std::int64_t;

DirectionKey key_of(long theta, long phi) {
  phi %= kCircle;
  return static_cast<DirectionKey>(theta) << 32 | (phi < 0 ? phi + kCircle : phi);
}

long steps(double angle_deg) { return std::lround(angle_deg / kAngleStep_deg); }

std::vector<const FieldValue*> by_frequency(const RcsCut& cut) {
  std::vector<const FieldValue*> values;
  values.reserve(cut.values.size());
  for (const FieldValue& value : cut.values) values.push_back(&value);
  const auto lower = [](const FieldValue* a, const FieldValue* b) { return a->frequency_hz < b->frequency_hz; };
  if (!std::is_sorted(values.begin(), values.end(), lower)) std::stable_sort(values.begin(), values.end(), lower);
  return values;
}

// A reference's samples of one frequency by their direction.
class Samples {
 public:
  // `ascending`: the reference's values by frequency.
  Samples(const RcsCut& reference, const std::vector<const FieldValue*>& ascending, double frequency_hz) {
    const auto first = std::lower_bound(ascending.begin(), ascending.end(), (1 - kFrequencyTolerance) * frequency_hz,
                                        [](const FieldValue* value, double f) { return value->frequency_hz < f; });
    for (auto at = first; at != ascending.end() && (*at)->frequency_hz <= (1 + kFrequencyTolerance) * frequency_hz;
         ++at) {
      const FieldValue& sample = **at;
      const auto [place, is_new] =
          by_direction_.try_emplace(key_of(steps(sample.theta_deg), steps(sample.phi_deg)), &sample);
      if (!is_new && std::abs(place->second->level_dbsm - sample.level_dbsm) > kSameLevel_db) {
        throw InputError(fmt::format("{}: theta {} phi {} at {} GHz is a duplicate, with {} and {} dBsm",
                                     reference.name, sample.theta_deg, sample.phi_deg, sample.frequency_hz * 1e-9,
                                     place->second->level_dbsm, sample.level_dbsm));
      }
    }
  }
  // Rounding may give equal angles neighbouring keys.
  const FieldValue* at(double theta_deg, double phi_deg) const {
    for (const long theta : {0L, -1L, 1L}) {
      for (const long phi : {0L, -1L, 1L}) {
        const auto place = by_direction_.find(key_of(steps(theta_deg) + theta, steps(phi_deg) + phi));
        if (place != by_direction_.end()) return place->second;
      }
    }
    return nullptr;
  }

 private:
  std::unordered_map<DirectionKey, const FieldValue*> by_direction_;
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
  const std::vector<const FieldValue*> ascending = by_frequency(reference);
  std::vector<PairedCut> cuts;
  for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
    const double f = sweep.frequency_hz[q], k = 2 * kPi * f / kSpeedOfLight;
    const Samples samples(reference, ascending, f);
    if (cuts.empty() || axis != CutAxis::kFrequency) {
      cuts.emplace_back();
      cuts.back().reference = reference.name;
      cuts.back().element = reference.element;
      cuts.back().total = reference.total;
      cuts.back().origin_m = reference.origin_m;
      cuts.back().axis = axis;
      if (axis != CutAxis::kFrequency) cuts.back().frequency_hz = f;
    }
    PairedCut& cut = cuts.back();
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      const double az = sweep.azimuth_of(view), el = sweep.elevation_of(view);
      const FieldValue* sample = samples.at(90 - el, reference.phi_scale * az + reference.phi_offset_deg);
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

}  // namespace seaglint
