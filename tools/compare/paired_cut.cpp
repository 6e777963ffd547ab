// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/paired_cut.h"

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
#include "tools/figure/figure.h"

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

namespace {

const char* axis_label(CutAxis axis) {
  switch (axis) {
    case CutAxis::kAzimuth: return "azimuth (deg)";
    case CutAxis::kElevation: return "elevation (deg)";
    case CutAxis::kFrequency: return "frequency (GHz)";
    default: return "";
  }
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

double DifferenceSum::add(double computed_dbsm, double reference_dbsm, double floor_dbsm, double x) {
  const double difference = std::max(computed_dbsm, floor_dbsm) - std::max(reference_dbsm, floor_dbsm);
  ++sums_.points;
  sums_.mean_db += std::abs(difference);
  sums_.bias_db += difference;
  sums_.rms_db += difference * difference;
  if (std::abs(difference) > std::abs(sums_.largest_db)) {
    sums_.largest_db = difference;
    sums_.largest_at = x;
  }
  return difference;
}

void DifferenceSum::add_phases(const Complex& computed, const Complex& reference) {
  product_ += std::conj(reference) * computed;
  computed_power_ += std::norm(computed);
  reference_power_ += std::norm(reference);
}

Difference DifferenceSum::difference() const {
  Difference d = sums_;
  const double n = static_cast<double>(d.points);
  d.mean_db /= n;
  d.bias_db /= n;
  d.rms_db = std::sqrt(d.rms_db / n);
  if (computed_power_ > 0 && reference_power_ > 0)
    d.correlation = product_ / std::sqrt(computed_power_ * reference_power_);
  return d;
}

Difference error_statistics(const PairedCut& cut, const PairedCut::Model& model, double floor_db) {
  const double floor = *std::max_element(cut.level_dbsm.begin(), cut.level_dbsm.end()) - floor_db;
  DifferenceSum sum;
  for (std::size_t i = 0; i < cut.x.size(); ++i) sum.add(model.level_dbsm[i], cut.level_dbsm[i], floor, cut.x[i]);
  for (std::size_t i = 0; i < cut.amplitude_m.size(); ++i) sum.add_phases(model.amplitude_m[i], cut.amplitude_m[i]);
  return sum.difference();
}

namespace {

// Another reference at the same directions and frequencies, in the role of a computed model.
std::optional<PairedCut::Model> as_model(const PairedCut& other, const PairedCut& cut) {
  if (other.quantity() != cut.quantity() || other.frequency_hz != cut.frequency_hz || other.x != cut.x)
    return std::nullopt;
  PairedCut::Model model{other.reference, other.level_dbsm, other.amplitude_m};
  if (model.amplitude_m.empty()) model.amplitude_m.assign(other.x.size(), 0.0);
  return model;
}

}  // namespace

std::string error_table(const std::vector<PairedCut>& cuts, double floor_db) {
  struct Row {
    const PairedCut* cut;
    std::string model;
    Difference difference;
  };
  std::vector<Row> rows;
  for (const PairedCut& cut : cuts) {
    for (const PairedCut::Model& model : cut.models)
      rows.push_back({&cut, model.name, error_statistics(cut, model, floor_db)});
  }
  // Differences between references.
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    for (std::size_t j = i + 1; j < cuts.size(); ++j) {
      if (const auto model = as_model(cuts[i], cuts[j]))
        rows.push_back({&cuts[j], model->name, error_statistics(cuts[j], *model, floor_db)});
    }
  }
  std::size_t width = 9, model_width = 5, pol_width = 3;
  for (const Row& row : rows) {
    width = std::max(width, row.cut->reference.size());
    pol_width = std::max(pol_width, std::string_view(kQuantityNames[row.cut->quantity()]).size());
    model_width = std::max(model_width, row.model.size());
  }
  std::string text = fmt::format(
      "Differences, compared - reference, both clipped at {:g} dB below the reference's maximum:\n{:<{}}  {:<{}}  "
      "{:>9}  "
      "{:<{}} {:>6} {:>8} {:>7} {:>7} {:>8}  {:<13} {}\n",
      floor_db, "reference", width, "pol", pol_width, "f_ghz", "compared", std::max(model_width, std::size_t{8}),
      "points", "mean_db", "rms_db", "bias_db", "largest", "at", "correlation");
  for (const Row& row : rows) {
    const Difference& d = row.difference;
    const std::string f = row.cut->frequency_hz ? fmt::format("{:g}", *row.cut->frequency_hz * 1e-9) : "sweep";
    text += fmt::format(
        "{:<{}}  {:<{}}  {:>9}  {:<{}} {:>6} {:>8.3f} {:>7.3f} {:>7.3f} {:>8.3f}  {:<13} {}\n", row.cut->reference,
        width, kQuantityNames[row.cut->quantity()], pol_width, f, row.model, std::max(model_width, std::size_t{8}),
        d.points, d.mean_db, d.rms_db, d.bias_db, d.largest_db,
        fmt::format("{:.6g} {}", d.largest_at, axis_unit(row.cut->axis)),
        d.correlation ? fmt::format("{:.4f} at {:.1f} deg", std::abs(*d.correlation), degrees(std::arg(*d.correlation)))
                      : "-");
  }
  return text;
}

PlotPanels comparison_plots(const std::vector<PairedCut>& cuts, double floor_db) {
  if (cuts.empty() || cuts.front().axis == CutAxis::kSeveral || cuts.front().x.size() < 2) return {};
  // Cuts of one frequency and polarisation share a column.
  constexpr std::size_t kMaxColumns = 4;
  std::vector<std::vector<const PairedCut*>> columns;
  for (const PairedCut& cut : cuts) {
    const auto place = std::find_if(columns.begin(), columns.end(), [&](const auto& column) {
      return column.front()->quantity() == cut.quantity() && column.front()->frequency_hz == cut.frequency_hz &&
             column.front()->place == cut.place;
    });
    if (place != columns.end()) {
      place->push_back(&cut);
    } else if (columns.size() < kMaxColumns) {
      columns.push_back({&cut});
    }
  }

  std::vector<LinePlot> levels, differences;
  for (const auto& column : columns) {
    const PairedCut& first = *column.front();
    double highest = -1e300;
    for (const PairedCut* cut : column)
      highest = std::max(highest, *std::max_element(cut->level_dbsm.begin(), cut->level_dbsm.end()));
    const double floor = highest - floor_db;
    const auto clipped = [&](std::vector<double> values) {
      for (double& v : values) v = std::max(v, floor);
      return values;
    };
    LinePlot level, difference;
    level.legend_above = difference.legend_above = true;
    level.title = (first.total ? fmt::format("total, {} transmitted", transmits_v(first.element) ? "V" : "H")
                               : upper(kPolarisationNames[static_cast<int>(first.element)])) +
                  (first.frequency_hz ? fmt::format(", {:g} GHz", *first.frequency_hz * 1e-9) : std::string()) +
                  (first.place.empty() ? "" : ", " + first.place);
    level.x.label = difference.x.label = axis_label(first.axis);
    level.x.range = difference.x.range =
        AxisRange{*std::min_element(first.x.begin(), first.x.end()), *std::max_element(first.x.begin(), first.x.end())};
    difference.y.label = "computed - reference (dB)";
    double widest = 0.2, lowest = highest;
    for (const PairedCut* cut : column) {
      const std::string& name = cut->reference;
      lowest = std::min(lowest, *std::min_element(cut->level_dbsm.begin(), cut->level_dbsm.end()));
      level.series.push_back({name, cut->x, clipped(cut->level_dbsm), {}, SeriesStyle::kLines});
      for (const PairedCut::Model& model : cut->models) {
        Series series{model.name + " - " + name, cut->x, {}, {}, SeriesStyle::kLines};
        const std::vector<double> computed = clipped(model.level_dbsm), reference = clipped(cut->level_dbsm);
        for (std::size_t i = 0; i < cut->x.size(); ++i) {
          series.y.push_back(computed[i] - reference[i]);
          widest = std::max(widest, std::abs(series.y.back()));
        }
        difference.series.push_back(std::move(series));
      }
      if (!cut->known) continue;
      Series series{cut->known->name + " - " + name, cut->x, {}, {}, SeriesStyle::kLinesPoints};
      for (std::size_t i = 0; i < cut->x.size(); ++i)
        series.y.push_back(cut->known->level_dbsm[i] - std::max(cut->level_dbsm[i], floor));
      difference.series.push_back(std::move(series));
    }
    for (const PairedCut::Model& model : first.models)
      level.series.push_back({model.name, first.x, clipped(model.level_dbsm), {}, SeriesStyle::kLines});
    if (first.flat) {
      const std::vector<double> flat = clipped(first.flat->level_dbsm), smooth = level.series.back().y;
      Series band{"to flat facets", first.x, smooth, {}, SeriesStyle::kBand};
      for (std::size_t i = 0; i < flat.size(); ++i)
        band.interval.push_back({std::min(flat[i], smooth[i]), std::max(flat[i], smooth[i])});
      level.series.push_back(std::move(band));
    }
    if (first.known)
      level.series.push_back({first.known->name, first.x, first.known->level_dbsm, {}, SeriesStyle::kLinesPoints});
    for (std::size_t i = 0; i + 1 < column.size(); ++i) {
      const auto other = as_model(*column[i], *column[i + 1]);
      if (!other) continue;
      Series series{other->name + " - " + column[i + 1]->reference, column[i]->x, {}, {}, SeriesStyle::kLines};
      const std::vector<double> upper = clipped(other->level_dbsm), lower = clipped(column[i + 1]->level_dbsm);
      for (std::size_t n = 0; n < upper.size(); ++n) series.y.push_back(upper[n] - lower[n]);
      difference.series.push_back(std::move(series));
    }
    // The axis is limited: nulls of only one curve would compress the rest.
    constexpr double kMargin_db = 3, kBelowReference_db = 12, kWidest_db = 20;
    level.y = {"radar cross section (dBsm)",
               AxisRange{std::max(floor, lowest - kBelowReference_db), highest + kMargin_db}, false};
    widest = std::min(1.05 * widest, kWidest_db);
    difference.y.range = AxisRange{-widest, widest};
    levels.push_back(std::move(level));
    differences.push_back(std::move(difference));
  }
  // Two columns per row (all, if their number is odd): levels above differences, then the next two.
  const std::size_t count = columns.size(), abreast = count % 2 == 0 ? 2 : count;
  std::vector<LinePlot> plots;
  for (std::size_t first = 0; first < count; first += abreast) {
    for (auto* row : {&levels, &differences}) {
      for (std::size_t c = first; c < std::min(first + abreast, count); ++c) plots.push_back(std::move((*row)[c]));
    }
  }
  const int blocks = static_cast<int>((count + abreast - 1) / abreast);
  return {std::move(plots),
          static_cast<int>(abreast),
          {abreast == 1 ? 900 : static_cast<int>(750 * abreast), 860 * blocks}};
}

bool draw_comparison(const std::vector<PairedCut>& cuts, double floor_db, const std::string& title,
                     const std::filesystem::path& file) {
  const PlotPanels panels = comparison_plots(cuts, floor_db);
  if (panels.plots.empty()) return false;
  write_figure(title, panels, file);
  return true;
}

}  // namespace seaglint
