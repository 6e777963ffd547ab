// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/known_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sim/canonical/canonical_body.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "tools/compare/differences.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

// Look directions of a place: that of the transmitter follows from the path gradient k (r^_t + r^_r).
BistaticGeometry geometry_of(const PairedCut::Place& place) {
  constexpr double kSame = 1e-9;
  const RadarBasis receive = basis_at(place.azimuth_deg, place.elevation_deg);
  const double k = 2 * kPi * place.frequency_hz / kSpeedOfLight;
  const Vec3 transmit = Vec3(place.path_gradient / k - receive.r).normalized();
  if ((transmit - receive.r).norm() < kSame) return monostatic(receive);
  return bistatic(basis_at(degrees(std::atan2(transmit.y(), transmit.x())),
                           degrees(std::asin(std::clamp(transmit.z(), -1.0, 1.0)))),
                  receive);
}

// Solutions of one body by frequency.
class Solutions {
 public:
  explicit Solutions(const CanonicalBody& body) : body_(body) {}

  std::optional<CanonicalEcho> at(const PairedCut::Place& place) {
    auto solution = solutions_.find(place.frequency_hz);
    if (solution == solutions_.end())
      solution = solutions_.emplace(place.frequency_hz, CanonicalSolution(body_, place.frequency_hz)).first;
    return solution->second.at(geometry_of(place));
  }

 private:
  CanonicalBody body_;
  std::map<double, CanonicalSolution> solutions_;
};

std::string name_of(const CanonicalBody& body) {
  return body.shape == CanonicalShape::kSphere ? "exact (Mie series)" : "closed form";
}

// Level of an element of a scattering matrix, or of the sum over both received polarisations.
template <class Matrix>
double level_dbsm(const Matrix& matrix_m, const PairedCut& cut) {
  if (!cut.total) return dbsm(matrix_m[static_cast<std::size_t>(cut.element)]);
  double power = 0;
  for (const bool v : {false, true})
    power += std::norm(matrix_m[static_cast<std::size_t>(element_of(v, transmits_v(cut.element)))]);
  return dbsm(Complex(std::sqrt(power)));
}

// Known levels of all cuts; the largest error of them, dB.
double set_known_levels(std::vector<PairedCut>& cuts, const CanonicalBody& body) {
  Solutions solutions(body);
  double error = 0;
  for (PairedCut& cut : cuts) {
    cut.known = PairedCut::Model{name_of(body), {}, {}};
    for (const PairedCut::Place& place : cut.places) {
      const std::optional<CanonicalEcho> echo = solutions.at(place);
      if (!echo) {
        cut.known->level_dbsm.push_back(std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      cut.known->level_dbsm.push_back(level_dbsm(echo->matrix_m, cut));
      error = std::max(error, echo->relative_error);
    }
  }
  return 20 * std::log10(1 + error);
}

double highest_known(const std::vector<PairedCut>& cuts, std::optional<std::size_t> quantity = std::nullopt) {
  double highest = -1e300;
  for (const PairedCut& cut : cuts) {
    if (!cut.known || (quantity && cut.quantity() != *quantity)) continue;
    for (const double level : cut.known->level_dbsm) {
      if (!std::isnan(level)) highest = std::max(highest, level);
    }
  }
  return highest;
}

// Absent where nothing is known.
std::optional<KnownStatistics> known_statistics(const std::vector<PairedCut>& cuts, std::size_t quantity,
                                                double floor) {
  DifferenceSum reference, compared;
  bool any = false;
  for (const PairedCut& cut : cuts) {
    for (std::size_t i = 0; cut.quantity() == quantity && i < cut.places.size(); ++i) {
      const double known = cut.known->level_dbsm[i];
      if (std::isnan(known)) continue;
      any = true;
      reference.add(cut.level_dbsm[i], known, floor, cut.x[i]);
      compared.add(cut.models[0].level_dbsm[i], known, floor, cut.x[i]);
    }
  }
  if (!any) return std::nullopt;
  return KnownStatistics{quantity, reference.difference(), compared.difference(), 0};
}

KnownValues of_one(std::vector<PairedCut>& cuts, const CanonicalBody& body, double floor_db) {
  constexpr double kNothing_db = 60;
  KnownValues known{text_of(body), name_of(body), {}, {}};
  const double error_db = set_known_levels(cuts, body), highest = highest_known(cuts);
  for (std::size_t quantity = 0; quantity < kQuantities; ++quantity) {
    if (highest_known(cuts, quantity) < highest - kNothing_db) continue;
    std::optional<KnownStatistics> statistics = known_statistics(cuts, quantity, highest - floor_db);
    if (!statistics) continue;
    statistics->error_db = error_db;
    known.statistics.push_back(*statistics);
  }
  for (PairedCut& cut : cuts) {
    if (highest_known(cuts, cut.quantity()) < highest - kNothing_db ||
        std::ranges::all_of(cut.known->level_dbsm, [](double level) { return std::isnan(level); }))
      cut.known.reset();
  }
  return known;
}

// Range of the specular point of a sphere, and whether another one may shadow it or overlaps its range cells.
struct SphereRange {
  const CanonicalBody* body;
  double range_m = 0;
  bool isolated = true;
};

std::vector<SphereRange> sphere_ranges(std::span<const CanonicalBody> bodies, const BistaticGeometry& geometry,
                                       double cell_m) {
  constexpr double kCells = 4;
  const Vec3 bisector = (geometry.transmit.r + geometry.receive.r).normalized();
  std::vector<SphereRange> ranges;
  for (const CanonicalBody& body : bodies) ranges.push_back({&body, -(bisector.dot(body.centre_m) + body.a_m), true});
  for (SphereRange& a : ranges) {
    for (const SphereRange& b : ranges) {
      if (a.body == b.body) continue;
      if (std::abs(a.range_m - b.range_m) < kCells * cell_m) a.isolated = false;
      for (const Vec3& r : {geometry.transmit.r, geometry.receive.r}) {
        const Vec3 apart = b.body->centre_m - a.body->centre_m;
        const bool nearer = apart.dot(r) > 0;
        if (nearer && (apart - apart.dot(r) * r).norm() < a.body->a_m + b.body->a_m) a.isolated = false;
      }
    }
  }
  return ranges;
}

// Rounded to 1 mm; 0 has no sign.
double to_millimetres(double metres) { return std::round(1e3 * metres) / 1e3 + 0.0; }

void add_levels(const PairedCut& cut, std::span<const CanonicalBody> bodies, KnownValues& known) {
  if (cut.axis != CutAxis::kFrequency || cut.amplitude_m.empty() || cut.models[0].amplitude_m.empty()) return;
  if (range_profile(cut.places, cut.amplitude_m).range_m.empty()) return;  // frequencies are not uniform
  const double cell_m = 2 * kPi / (cut.places.back().path_gradient.norm() - cut.places.front().path_gradient.norm());
  for (const SphereRange& sphere : sphere_ranges(bodies, geometry_of(cut.places.front()), cell_m)) {
    if (!sphere.isolated) continue;
    Solutions solutions(*sphere.body);
    std::vector<Complex> exact;
    for (const PairedCut::Place& place : cut.places)
      exact.push_back(solutions.at(place)->matrix_m[static_cast<std::size_t>(cut.element)]);
    const auto level = [&](const std::vector<Complex>& amplitude_m) {
      return level_at_range(cut.places, amplitude_m, sphere.range_m);
    };
    known.levels.push_back(
        {fmt::format("{} at {:g}, {:g}, {:g} m", text_of(*sphere.body), to_millimetres(sphere.body->centre_m.x()),
                     to_millimetres(sphere.body->centre_m.y()), to_millimetres(sphere.body->centre_m.z())),
         cut.place, cut.quantity(), sphere.range_m, level(exact), level(cut.amplitude_m),
         level(cut.models[0].amplitude_m)});
  }
}

}  // namespace

std::optional<KnownValues> known_values(std::vector<PairedCut>& cuts, std::span<const CanonicalBody> bodies,
                                        double floor_db) {
  if (bodies.empty()) return std::nullopt;
  KnownValues known;
  if (bodies.size() == 1) {
    known = of_one(cuts, bodies[0], floor_db);
  } else {
    known = {fmt::format("{} spheres", bodies.size()), name_of(bodies[0]), {}, {}};
    for (const PairedCut& cut : cuts) {
      if (!is_cross(cut.element)) add_levels(cut, bodies, known);
    }
  }
  if (known.statistics.empty() && known.levels.empty()) return std::nullopt;
  return known;
}

std::string closer_text(double reference_db, double compared_db, double error_db, const std::string& compared) {
  constexpr double kEqual_db = 0.05;
  if (std::abs(reference_db - compared_db) < kEqual_db) return "both are equally close";
  if (std::max(reference_db, compared_db) < error_db)
    return fmt::format("both are within its own error of about {:.2f} dB", error_db);
  if (std::min(reference_db, compared_db) < error_db && std::max(reference_db, compared_db) < 2 * error_db)
    return fmt::format("their difference is within its own error of about {:.2f} dB", error_db);
  return compared_db < reference_db ? compared + " is closer" : "the export is closer";
}

std::vector<std::string> known_lines(const KnownValues& known, const std::string& compared) {
  std::vector<std::string> lines;
  for (const KnownStatistics& s : known.statistics) {
    lines.push_back(
        fmt::format("{}: {} of a {}, {} places: export bias {:+.2f}, rms {:.2f} dB; {} bias {:+.2f}, rms {:.2f} dB: {}",
                    kQuantityNames[s.quantity], known.name, known.body, s.reference.points, s.reference.bias_db,
                    s.reference.rms_db, compared, s.compared.bias_db, s.compared.rms_db,
                    closer_text(s.reference.rms_db, s.compared.rms_db, s.error_db, compared)));
  }
  constexpr std::size_t kMostLines = 12;
  for (std::size_t i = 0; i < std::min(kMostLines, known.levels.size()); ++i) {
    const KnownLevel& l = known.levels[i];
    lines.push_back(fmt::format(
        "{}: {} of a {} in its range profile ({}): {:.2f} dBsm, export {:.2f}, {} {:.2f}: {}",
        kQuantityNames[l.quantity], known.name, l.body, l.place, l.known_dbsm, l.reference_dbsm, compared,
        l.compared_dbsm,
        closer_text(std::abs(l.reference_dbsm - l.known_dbsm), std::abs(l.compared_dbsm - l.known_dbsm), 0, compared)));
  }
  if (known.levels.size() > kMostLines)
    lines.push_back(fmt::format("{} further levels of spheres are in compare.json", known.levels.size() - kMostLines));
  return lines;
}

}  // namespace seaglint
