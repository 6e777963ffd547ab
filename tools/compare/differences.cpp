// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/differences.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"

namespace seaglint {

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
  d.correlation = correlation();
  return d;
}

std::optional<Complex> DifferenceSum::correlation() const {
  if (!(computed_power_ > 0 && reference_power_ > 0)) return std::nullopt;
  return product_ / std::sqrt(computed_power_ * reference_power_);
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

namespace {

using PlotColumn = std::vector<const PairedCut*>;

// As many of the columns, evenly spread over each of the strongest quantities, in their order.
std::vector<PlotColumn> spread_columns(const std::vector<PlotColumn>& columns, std::size_t count) {
  std::map<std::size_t, std::pair<double, std::vector<std::size_t>>> of_quantity;  // highest level, columns
  for (std::size_t i = 0; i < columns.size(); ++i) {
    auto& [highest, indices] =
        of_quantity.try_emplace(columns[i][0]->quantity(), -1e300, std::vector<std::size_t>()).first->second;
    highest = std::max(highest, std::ranges::max(columns[i][0]->level_dbsm));
    indices.push_back(i);
  }
  std::vector<std::pair<double, std::vector<std::size_t>>> groups;
  for (auto& [quantity, group] : of_quantity) groups.push_back(std::move(group));
  std::ranges::stable_sort(groups, std::ranges::greater{}, [](const auto& group) { return group.first; });
  groups.resize(std::min(groups.size(), count / 2));
  std::set<std::size_t> kept;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::vector<std::size_t>& indices = groups[g].second;
    const std::size_t here = std::min(indices.size(), count / groups.size());
    for (std::size_t n = 0; n < here; ++n) kept.insert(indices[(2 * n + 1) * indices.size() / (2 * here)]);
  }
  std::vector<PlotColumn> chosen;
  for (const std::size_t i : kept) chosen.push_back(columns[i]);
  return chosen;
}

}  // namespace

PlotPanels comparison_plots(const std::vector<PairedCut>& cuts, double floor_db) {
  if (cuts.empty() || cuts.front().axis == CutAxis::kSeveral || cuts.front().x.size() < 2) return {};
  // Cuts of one frequency and polarisation share a column.
  constexpr std::size_t kMaxColumns = 4;
  constexpr const char* kReferences[] = {kReferenceColour, "#7f7f7f", "#b8b8b8"};
  constexpr const char* kOtherModelColour = "#56b4e9";
  constexpr double kReferenceWidth = 2.4;  // remains visible below a computed curve that is equal
  std::vector<std::vector<const PairedCut*>> columns;
  for (const PairedCut& cut : cuts) {
    const auto place = std::find_if(columns.begin(), columns.end(), [&](const auto& column) {
      return column.front()->quantity() == cut.quantity() && column.front()->frequency_hz == cut.frequency_hz &&
             column.front()->place == cut.place;
    });
    (place == columns.end() ? columns.emplace_back() : *place).push_back(&cut);
  }
  if (columns.size() > kMaxColumns) columns = spread_columns(columns, kMaxColumns);

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
    level.title = (first.total ? fmt::format("total, {} transmitted", transmits_v(first.element) ? "V" : "H")
                               : upper(kPolarisationNames[static_cast<int>(first.element)])) +
                  (first.frequency_hz ? fmt::format(", {:g} GHz", *first.frequency_hz * 1e-9) : std::string()) +
                  (first.place.empty() ? "" : ", " + first.place);
    level.x.label = difference.x.label = axis_label(first.axis);
    level.x.range = difference.x.range =
        AxisRange{*std::min_element(first.x.begin(), first.x.end()), *std::max_element(first.x.begin(), first.x.end())};
    difference.y.label = "computed - reference (dB)";
    double widest = 0.2, lowest = highest;
    std::vector<double> sizes;
    for (const PairedCut* cut : column) {
      const std::string& name = cut->reference;
      lowest = std::min(lowest, *std::min_element(cut->level_dbsm.begin(), cut->level_dbsm.end()));
      level.series.push_back({name,
                              cut->x,
                              clipped(cut->level_dbsm),
                              {},
                              SeriesStyle::kLines,
                              kReferences[std::min(level.series.size(), std::size(kReferences) - 1)],
                              kReferenceWidth});
      for (const PairedCut::Model& model : cut->models) {
        Series series{model.name + " - " + name, cut->x, {}, {}, SeriesStyle::kLines};
        const std::vector<double> computed = clipped(model.level_dbsm), reference = clipped(cut->level_dbsm);
        for (std::size_t i = 0; i < cut->x.size(); ++i) {
          series.y.push_back(computed[i] - reference[i]);
          sizes.push_back(std::abs(series.y.back()));
          widest = std::max(widest, sizes.back());
        }
        if (column.size() == 1 && &model == &cut->models.back()) series.colour = kDifferenceColour;
        difference.series.push_back(std::move(series));
      }
      if (!cut->known) continue;
      Series series{cut->known->name + " - " + name, cut->x, {}, {}, SeriesStyle::kLinesPoints, kKnownColour};
      for (std::size_t i = 0; i < cut->x.size(); ++i)
        series.y.push_back(cut->known->level_dbsm[i] - std::max(cut->level_dbsm[i], floor));
      difference.series.push_back(std::move(series));
    }
    for (const PairedCut::Model& model : first.models)
      level.series.push_back({model.name,
                              first.x,
                              clipped(model.level_dbsm),
                              {},
                              SeriesStyle::kLines,
                              &model == &first.models.back() ? kComputedColour : kOtherModelColour});
    if (first.flat) {
      const std::vector<double> flat = clipped(first.flat->level_dbsm), smooth = level.series.back().y;
      Series band{"to flat facets", first.x, smooth, {}, SeriesStyle::kBand, kOtherModelColour};
      for (std::size_t i = 0; i < flat.size(); ++i)
        band.interval.push_back({std::min(flat[i], smooth[i]), std::max(flat[i], smooth[i])});
      level.series.push_back(std::move(band));
    }
    if (first.known)
      level.series.push_back(
          {first.known->name, first.x, first.known->level_dbsm, {}, SeriesStyle::kLinesPoints, kKnownColour});
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
    std::ranges::sort(sizes);
    widest = std::min(1.05 * widest, std::max(kWidest_db, 1.2 * quantile(sizes, 0.9)));
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

bool are_uniform(const std::vector<double>& values) {
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i] - values.front() - static_cast<double>(i) * step) > 0.02 * step) return false;
  }
  return true;
}

bool is_monostatic(const PairedCut::Place& place) {
  constexpr double kDigits = 1e-6;
  const double twice = 4 * kPi * place.frequency_hz / kSpeedOfLight;
  return std::abs(place.path_gradient.norm() - twice) < kDigits * twice;
}

namespace {

// Levels of one quantity over an angle and frequency, NaN where there is none.
struct LevelGrid {
  std::string angle, place;
  std::vector<double> deg, ghz;
  std::vector<double> reference, compared;  // [ghz][deg]
};

// The grid over azimuth at the elevation of the first cut, or over elevation at its azimuth, of the cuts of the same
// reference and quantity; absent below three values of either, where steps are uneven and where places are missing.
std::optional<LevelGrid> level_grid(const std::vector<PairedCut>& cuts, const PairedCut& first, double floor_dbsm) {
  constexpr std::size_t kLeast = 3;
  for (const bool over_azimuth : {true, false}) {
    const auto angle = over_azimuth ? &PairedCut::Place::azimuth_deg : &PairedCut::Place::elevation_deg;
    const auto fixed = over_azimuth ? &PairedCut::Place::elevation_deg : &PairedCut::Place::azimuth_deg;
    std::map<std::pair<double, double>, std::pair<double, double>> values;  // by frequency and angle
    std::set<double> degrees, frequencies;
    for (const PairedCut& cut : cuts) {
      if (cut.reference != first.reference || cut.quantity() != first.quantity()) continue;
      for (std::size_t i = 0; i < cut.places.size(); ++i) {
        const PairedCut::Place& place = cut.places[i];
        if (place.*fixed != first.places.front().*fixed) continue;
        values[{place.frequency_hz, place.*angle}] = {std::max(cut.level_dbsm[i], floor_dbsm),
                                                      std::max(cut.models.back().level_dbsm[i], floor_dbsm)};
        degrees.insert(place.*angle);
        frequencies.insert(place.frequency_hz);
      }
    }
    if (degrees.size() < kLeast || frequencies.size() < kLeast || values.size() != degrees.size() * frequencies.size())
      continue;
    LevelGrid grid{over_azimuth ? "azimuth (deg)" : "elevation (deg)",
                   fmt::format("{} {:g} deg", over_azimuth ? "elevation" : "azimuth", first.places.front().*fixed),
                   {degrees.begin(), degrees.end()},
                   {},
                   {},
                   {}};
    for (const double hz : frequencies) grid.ghz.push_back(1e-9 * hz);
    for (const auto& [place, levels] : values) {
      grid.reference.push_back(levels.first);
      grid.compared.push_back(levels.second);
    }
    if (are_uniform(grid.deg) && are_uniform(grid.ghz)) return grid;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Heatmap> comparison_images(const std::vector<PairedCut>& cuts, double floor_db) {
  constexpr double kDynamic_db = 50, kWidest_db = 20, kNarrowest_db = 0.2, kShown = 0.98;
  const auto highest_of = [](const PairedCut& cut) { return std::ranges::max(cut.level_dbsm); };
  if (cuts.empty()) return {};
  const PairedCut& strongest = *std::ranges::max_element(cuts, {}, highest_of);
  const double highest = highest_of(strongest);
  const std::optional<LevelGrid> grid = level_grid(cuts, strongest, highest - floor_db);
  if (!grid) return {};
  std::vector<double> difference, sizes;
  for (std::size_t i = 0; i < grid->reference.size(); ++i) {
    difference.push_back(grid->compared[i] - grid->reference[i]);
    sizes.push_back(std::abs(difference.back()));
  }
  std::ranges::sort(sizes);
  const double widest = std::clamp(quantile(sizes, kShown), kNarrowest_db, kWidest_db);
  std::vector<double> levels = grid->reference;
  std::ranges::sort(levels);
  const double lowest = std::max({highest - kDynamic_db, highest - floor_db, quantile(levels, 1 - kShown) - 1});
  Heatmap image;
  image.x.label = grid->angle;
  image.y.label = "frequency (GHz)";
  image.map.x = grid->deg;
  image.map.y = grid->ghz;
  std::vector<Heatmap> images(3, image);
  const std::string place = fmt::format("{}, {}", kQuantityNames[strongest.quantity()], grid->place);
  images[0].title = fmt::format("{}: {}", strongest.reference, place);
  images[1].title = fmt::format("{}: {}", strongest.models.back().name, place);
  images[2].title = "compared - export";
  for (const std::size_t i : {0u, 1u})
    images[i].colour = {"radar cross section (dBsm)", AxisRange{lowest, highest}, false};
  images[2].colour = {"difference (dB)", AxisRange{-widest, widest}, false};
  images[2].diverging = true;
  images[0].map.values = grid->reference;
  images[1].map.values = grid->compared;
  images[2].map.values = std::move(difference);
  return images;
}

namespace {

constexpr double kLeast_db = 3;  // between a lobe and the nulls beside it

// The vertex of the parabola through three points; the middle one where they are on a line.
Extremum vertex(std::span<const double> x, std::span<const double> y, std::size_t i) {
  const double a = x[i - 1] - x[i], b = x[i + 1] - x[i], u = y[i - 1] - y[i], v = y[i + 1] - y[i];
  const double square = (u / a - v / b) / (a - b), slope = u / a - square * a;
  if (square == 0) return {x[i], y[i]};
  const double at = std::clamp(-slope / (2 * square), a, b);
  return {x[i] + at, y[i] + at * (slope + square * at)};
}

// Indices of alternating maxima and minima that differ by at least kLeast_db.
std::vector<std::size_t> turning_points(std::span<const double> y) {
  std::vector<std::size_t> points;
  if (y.size() < 3) return points;
  std::size_t highest = 0, lowest = 0;
  int direction = 0;  // of the last confirmed change
  for (std::size_t i = 1; i < y.size(); ++i) {
    if (y[i] > y[highest]) highest = i;
    if (y[i] < y[lowest]) lowest = i;
    if (direction >= 0 && y[highest] - y[i] >= kLeast_db) {
      points.push_back(highest);
      direction = -1;
      lowest = highest = i;
    } else if (direction <= 0 && y[i] - y[lowest] >= kLeast_db) {
      points.push_back(lowest);
      direction = 1;
      lowest = highest = i;
    }
  }
  return points;
}

std::vector<Extremum> extrema(std::span<const double> x, std::span<const double> y, double lowest_db, double sign) {
  std::vector<Extremum> found;
  for (const std::size_t i : turning_points(y)) {
    if (i == 0 || i + 1 == y.size() || y[i] < lowest_db) continue;
    if (sign * (2 * y[i] - y[i - 1] - y[i + 1]) <= 0) continue;
    found.push_back(vertex(x, y, i));
  }
  return found;
}

std::size_t nearest(std::span<const Extremum> extrema, double x) {
  const auto place = std::min_element(extrema.begin(), extrema.end(), [x](const Extremum& a, const Extremum& b) {
    return std::abs(a.x - x) < std::abs(b.x - x);
  });
  return static_cast<std::size_t>(place - extrema.begin());
}

}  // namespace

std::vector<Extremum> lobes_of(std::span<const double> x, std::span<const double> level_db, double lowest_db) {
  return extrema(x, level_db, lowest_db, 1);
}

std::vector<Extremum> nulls_of(std::span<const double> x, std::span<const double> level_db, double lowest_db) {
  return extrema(x, level_db, lowest_db, -1);
}

ExtremumPairs paired_extrema(std::span<const Extremum> reference, std::span<const Extremum> other) {
  ExtremumPairs pairs;
  pairs.count = reference.size();
  for (std::size_t i = 0; i < reference.size() && !other.empty(); ++i) {
    const Extremum& close = other[nearest(other, reference[i].x)];
    if (nearest(reference, close.x) != i) continue;
    ++pairs.paired;
    pairs.mean_shift += std::abs(close.x - reference[i].x);
    pairs.mean_db += std::abs(close.level_db - reference[i].level_db);
  }
  if (pairs.paired == 0) return pairs;
  pairs.mean_shift /= static_cast<double>(pairs.paired);
  pairs.mean_db /= static_cast<double>(pairs.paired);
  return pairs;
}

RangeProfile range_profile(std::span<const PairedCut::Place> places, std::span<const Complex> amplitude_m) {
  constexpr std::size_t kLeast = 8, kMost = 4096, kPerCell = 4;
  const std::size_t n = places.size();
  RangeProfile profile;
  if (n < kLeast || n > kMost || amplitude_m.size() != n) return profile;
  std::vector<double> q;
  for (const PairedCut::Place& place : places) q.push_back(place.path_gradient.norm());
  const double step = (q.back() - q.front()) / static_cast<double>(n - 1);
  if (step <= 0) return profile;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(q[i] - q.front() - static_cast<double>(i) * step) > 0.01 * step) return profile;
  }
  const double whole = 2 * kPi / step, cell = whole / static_cast<double>(kPerCell * n);
  for (std::size_t m = 0; m <= kPerCell * n; ++m) {
    const double range = -0.5 * whole + static_cast<double>(m) * cell;
    profile.range_m.push_back(range);
    profile.level_dbsm.push_back(level_at_range(places, amplitude_m, range));
  }
  return profile;
}

double level_at_range(std::span<const PairedCut::Place> places, std::span<const Complex> amplitude_m, double range_m) {
  const double n = static_cast<double>(places.size());
  Complex sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double window = 1 - std::cos(2 * kPi * (static_cast<double>(i) + 0.5) / n);
    sum += window * amplitude_m[i] * std::polar(1.0, places[i].path_gradient.norm() * range_m);
  }
  return dbsm(sum / n);
}

namespace {

// Names above the strongest peaks of a profile.
std::vector<LinePlot::Mark> marks_of(const RangeProfile& profile, const PairedCut& cut, const PeakNames& names) {
  constexpr std::size_t kMostNames = 5;
  const PairedCut::Place& place = cut.places[cut.places.size() / 2];
  if (!names || !is_monostatic(place)) return {};
  std::vector<double> magnitude_m;
  for (const double level : profile.level_dbsm) magnitude_m.push_back(amplitude_of_dbsm(level));
  const double cell_m = (profile.range_m.back() - profile.range_m.front()) / static_cast<double>(cut.places.size());
  std::vector<NamedPeak> peaks = strongest_peaks(profile.range_m, magnitude_m, cell_m, kMostNames);
  names(peaks,
        {{place.azimuth_deg, place.elevation_deg, place.frequency_hz}, static_cast<std::size_t>(cut.element), cell_m});
  std::vector<LinePlot::Mark> marks;
  for (NamedPeak& peak : peaks)
    if (!peak.name.empty()) marks.push_back({peak.range_m, dbsm(peak.magnitude_m), std::move(peak.name)});
  return marks;
}

}  // namespace

PlotPanels range_profile_plots(std::span<const PairedCut> cuts, const PeakNames& names) {
  constexpr std::size_t kMostPlots = 4;
  constexpr double kDynamic_db = 60, kNames_db = 22;  // room for the names
  std::vector<LinePlot> plots;
  for (const PairedCut& cut : cuts) {
    if (plots.size() == kMostPlots) break;
    if (cut.axis != CutAxis::kFrequency || !cut.has_phases()) continue;
    const RangeProfile reference = range_profile(cut.places, cut.amplitude_m),
                       compared = range_profile(cut.places, cut.models[0].amplitude_m);
    if (reference.range_m.empty()) continue;
    const double highest = std::max(*std::max_element(reference.level_dbsm.begin(), reference.level_dbsm.end()),
                                    *std::max_element(compared.level_dbsm.begin(), compared.level_dbsm.end()));
    LinePlot plot;
    plot.title = fmt::format("{}, {}", kPolarisationNames[static_cast<int>(cut.element)], cut.place);
    plot.x = {"range from the phase origin, positive = farther (m)",
              AxisRange{reference.range_m.front(), reference.range_m.back()}, false};
    plot.marks = marks_of(compared, cut, names);
    plot.y = {"range profile (dBsm)", AxisRange{highest - kDynamic_db, highest + (plot.marks.empty() ? 3 : kNames_db)},
              false};
    plot.series = {
        {cut.reference, reference.range_m, reference.level_dbsm, {}, SeriesStyle::kLines, kReferenceColour, 2.4},
        {cut.models[0].name, compared.range_m, compared.level_dbsm, {}, SeriesStyle::kLines, kComputedColour}};
    plots.push_back(std::move(plot));
  }
  if (plots.empty()) return {};
  const int columns = plots.size() == 1 ? 1 : 2, rows = (static_cast<int>(plots.size()) + columns - 1) / columns;
  return {std::move(plots), columns, {columns == 1 ? 900 : 1500, 450 * rows}};
}

}  // namespace seaglint
