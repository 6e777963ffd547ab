// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/target_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "sim/canonical/canonical_body.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "tools/rcs/rcs_request.h"
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
      cut.known->level_dbsm.push_back(dbsm_of_area(4 * kPi * squared_magnitude(echo->matrix_m, cut.quantity())));
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
  if (cut.axis != CutAxis::kFrequency || !cut.has_phases()) return;
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

namespace {

constexpr std::size_t kViews = 8;
constexpr double kPoor_db = 1.5, kOtherUnit_db = 8, kDynamic_db = 40;

double median_of(std::vector<double> values) { return quartiles(std::move(values)).median; }

// Transmitter, frequency and direction of a value in the file's angles.
using ViewKey = std::tuple<bool, double, double, double, double, double>;

ViewKey key_of(const RcsCut& cut, const FieldValue& value) {
  const DeclaredTransmitter transmitter = cut.transmitter.value_or(DeclaredTransmitter{});
  const bool fixed = !transmitter.is_monostatic;
  return {fixed,
          fixed ? transmitter.theta_deg : 0,
          fixed ? transmitter.phi_deg : 0,
          value.frequency_hz,
          value.theta_deg,
          value.phi_deg};
}

// The table's values at kViews of its views, spread evenly over those that are not weak.
FieldTable few_views(const FieldTable& table) {
  double highest = -1e300;
  for (const RcsCut& cut : table.cuts) {
    for (const FieldValue& value : cut.values) highest = std::max(highest, value.level_dbsm);
  }
  const auto strong = [&](const FieldValue& value) { return value.level_dbsm >= highest - kDynamic_db; };
  std::set<ViewKey> all;
  for (const RcsCut& cut : table.cuts) {
    for (const FieldValue& value : cut.values) {
      if (strong(value)) all.insert(key_of(cut, value));
    }
  }
  const std::vector<ViewKey> keys(all.begin(), all.end());
  std::set<ViewKey> chosen;
  for (std::size_t i = 0; i < kViews && !keys.empty(); ++i)
    chosen.insert(keys[(2 * i + 1) * keys.size() / (2 * kViews)]);
  FieldTable few = table;
  for (RcsCut& cut : few.cuts)
    std::erase_if(cut.values,
                  [&](const FieldValue& value) { return !strong(value) || !chosen.contains(key_of(cut, value)); });
  std::erase_if(few.cuts, [](const RcsCut& cut) { return cut.values.empty(); });
  return few;
}

// compared - export by quantity, frequency and path gradient, of levels that are not weak.
using PlaceKey = std::tuple<std::size_t, double, double, double, double>;

std::map<PlaceKey, double> differences_of(const std::vector<PairedCut>& cuts) {
  double highest = -1e300;
  for (const PairedCut& cut : cuts) {
    for (const double level : cut.level_dbsm) highest = std::max(highest, level);
  }
  std::map<PlaceKey, double> differences;
  for (const PairedCut& cut : cuts) {
    for (std::size_t i = 0; i < cut.places.size(); ++i) {
      if (cut.level_dbsm[i] < highest - kDynamic_db || cut.models[0].level_dbsm[i] < highest - kRounding_db) continue;
      const PairedCut::Place& p = cut.places[i];
      differences[{cut.quantity(), p.frequency_hz, p.path_gradient.x(), p.path_gradient.y(), p.path_gradient.z()}] =
          cut.models[0].level_dbsm[i] - cut.level_dbsm[i];
    }
  }
  return differences;
}

std::vector<double> values_of(const std::map<PlaceKey, double>& differences, bool absolute) {
  std::vector<double> values;
  for (const auto& [key, value] : differences) values.push_back(absolute ? std::abs(value) : value);
  return values;
}

// Solutions of few views, next to those of the whole table.
class Trials {
 public:
  explicit Trials(const TrialRequest& request)
      : request_(request), few_(few_views(request.table)), whole_(differences_of(request.cuts)) {}

  // The trial with another request; absent where the mesh is none for the solver, as of another size.
  std::optional<Trial> with(RcsRequest other) {
    other.uncertainty = false;
    std::map<PlaceKey, double> after;
    try {
      after = differences_of(request_.solve(few_, other));
    } catch (const InputError&) {
      return std::nullopt;
    }
    std::vector<double> before;
    for (const auto& [key, difference] : after) {
      const auto there = whole_.find(key);
      if (there != whole_.end()) before.push_back(std::abs(there->second));
    }
    if (before.empty()) return std::nullopt;
    std::set<std::tuple<double, double, double, double>> views;
    for (const auto& [key, difference] : after)
      views.insert({std::get<1>(key), std::get<2>(key), std::get<3>(key), std::get<4>(key)});
    return Trial{"", "", views.size(), median_of(before), median_of(values_of(after, true)), false};
  }
  double median_abs() const { return median_of(values_of(whole_, true)); }
  double median() const { return median_of(values_of(whole_, false)); }

 private:
  const TrialRequest& request_;
  FieldTable few_;
  std::map<PlaceKey, double> whole_;
};

struct MeshUnit {
  const char* name;
  double metres;
};
constexpr MeshUnit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};

double metres_of(const std::string& name) {
  for (const MeshUnit& unit : kUnits) {
    if (name == unit.name) return unit.metres;
  }
  return name == "km" ? 1000 : 1;
}

// The request with its mesh in another unit: the file read anew, or the given mesh scaled.
RcsRequest in_unit(RcsRequest request, const MeshUnit& unit) {
  if (request.mesh) {
    request.mesh = std::make_shared<const TriangleMesh>(enlarged(*request.mesh, unit.metres / metres_of(request.unit)));
  } else {
    request.unit = unit.name;
  }
  return request;
}

// The best of the units whose change of level fits the median difference; absent if none leaves an agreement.
std::optional<Trial> best_unit(const TrialRequest& request, Trials& trials) {
  constexpr double kLeast = 8, kMost = 50;  // dB per decade of size: from an edge's or less to a flat plate's and more
  constexpr double kQuarter = 0.25, kLeastGain_db = 6, kMostLeft_db = 3;
  std::optional<Trial> best;
  for (const MeshUnit& unit : kUnits) {
    const double decades = std::log10(unit.metres / metres_of(request.request.unit));
    if (decades == 0) continue;
    const double slope = -trials.median() / decades;
    if (slope < kLeast || slope > kMost) continue;
    std::optional<Trial> trial = trials.with(in_unit(request.request, unit));
    if (!trial || trial->after_db > std::min(kQuarter * trial->before_db, kMostLeft_db) ||
        trial->after_db > trial->before_db - kLeastGain_db)
      continue;
    trial->option = fmt::format("--unit {}", unit.name);
    trial->meaning = fmt::format("the mesh is in {}, not in {}", unit.name, request.request.unit);
    trial->helps = true;
    if (!best || trial->after_db < best->after_db) best = trial;
  }
  return best;
}

bool same_settings(const RcsRequest& a, const RcsRequest& b) {
  return a.crease_deg == b.crease_deg && a.edges == b.edges && a.max_bounces == b.max_bounces;
}

void add_programs(const TrialRequest& request, Trials& trials, std::vector<Trial>& all) {
  constexpr double kClearly = 0.7, kLeastGain_db = 0.3;
  const LikeProgram* const writer = like_program_of_reader(request.table.reader);
  std::vector<RcsRequest> tried{request.request};
  for (const LikeProgram& program : kLikePrograms) {
    if (writer != nullptr && writer != &program) continue;
    const RcsRequest other = solved_like(request.request, program);
    if (std::ranges::any_of(tried, [&](const RcsRequest& one) { return same_settings(one, other); })) continue;
    tried.push_back(other);
    std::optional<Trial> trial = trials.with(other);
    if (!trial) continue;
    trial->option = fmt::format("--like {}", program.name);
    trial->meaning = program.described;
    trial->helps = trial->after_db < kClearly * trial->before_db && trial->after_db < trial->before_db - kLeastGain_db;
    all.push_back(*trial);
  }
}

}  // namespace

std::vector<Trial> trial_solutions(const TrialRequest& request) {
  if (request.cuts.empty() || !request.request.cavities.parts.empty()) return {};
  Trials trials(request);
  if (!(trials.median_abs() > kPoor_db)) return {};
  request.say(fmt::format("{}: the median difference is {:.1f} dB: {} views with other settings", request.table.name,
                          trials.median_abs(), kViews));
  constexpr double kBeyondDoubt = 0.1;  // of the median difference before
  std::optional<Trial> unit;
  if (std::abs(trials.median()) > kOtherUnit_db) unit = best_unit(request, trials);
  if (unit && unit->after_db < kBeyondDoubt * unit->before_db) return {*unit};
  std::vector<Trial> all;
  if (request.request.like.empty()) add_programs(request, trials, all);
  const auto better = [&](const Trial& trial) { return trial.helps && trial.after_db <= unit->after_db; };
  if (unit && std::ranges::none_of(all, better)) return {*unit};
  return all;
}

bool is_unit(const Trial& trial) { return trial.helps && trial.option.starts_with("--unit"); }

std::vector<std::string> trial_sentences(const std::vector<Trial>& trials) {
  if (trials.empty()) return {};
  const Trial* best = nullptr;
  std::vector<std::string> all;
  for (const Trial& trial : trials) {
    all.push_back(fmt::format("{} ({:.1f} dB)", trial.option, trial.after_db));
    if (trial.helps && (best == nullptr || trial.after_db < best->after_db)) best = &trial;
  }
  if (best == nullptr)
    return {fmt::format("the median difference of {} views is {:.1f} dB, not less with {}", trials[0].views,
                        trials[0].before_db, fmt::join(all, ", "))};
  return {fmt::format("with {} the median difference of {} views falls from {:.1f} to {:.1f} dB: {}", best->option,
                      best->views, best->before_db, best->after_db, best->meaning)};
}

}  // namespace seaglint
