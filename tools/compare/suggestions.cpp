// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/suggestions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "tools/compare/differences.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

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
  if (cut.axis != CutAxis::kFrequency || cut.amplitude_m.empty() || cut.models[0].amplitude_m.empty()) return;
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

void suggest_conventions(const Alignment& alignment, const std::vector<PairedCut>& cuts,
                         std::vector<std::string>& sentences) {
  constexpr double kMeaningful = 0.5;  // least correlation
  if (alignment.correlation < kMeaningful) return;
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
}

}  // namespace

std::vector<std::string> suggestions(const std::vector<PairedCut>& cuts, const std::optional<Alignment>& alignment,
                                     double floor_db) {
  std::vector<std::string> sentences;
  if (alignment) suggest_conventions(*alignment, cuts, sentences);
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

namespace {

constexpr std::size_t kViews = 8;
constexpr double kPoor_db = 1.5, kOtherUnit_db = 8, kDynamic_db = 40;
constexpr double kCrossRounding_db = 120;  // a symmetric body has no cross-polar echo but rounding

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
      if (cut.level_dbsm[i] < highest - kDynamic_db || cut.models[0].level_dbsm[i] < highest - kCrossRounding_db)
        continue;
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

// The best of the units whose change of level fits the median difference; absent if none helps.
std::optional<Trial> best_unit(const TrialRequest& request, Trials& trials) {
  constexpr double kLeast = 8, kMost = 50;  // dB per decade of size: from an edge's or less to a flat plate's and more
  constexpr double kQuarter = 0.25, kLeastGain_db = 6;
  std::optional<Trial> best;
  for (const MeshUnit& unit : kUnits) {
    const double decades = std::log10(unit.metres / metres_of(request.request.unit));
    if (decades == 0) continue;
    const double slope = -trials.median() / decades;
    if (slope < kLeast || slope > kMost) continue;
    std::optional<Trial> trial = trials.with(in_unit(request.request, unit));
    if (!trial || trial->after_db > kQuarter * trial->before_db || trial->after_db > trial->before_db - kLeastGain_db)
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
