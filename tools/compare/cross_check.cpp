// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/cross_check.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"
#include "tools/pipeline/pipeline.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_table.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

GroupSums group_sums(std::span<const Point> points, double k) {
  GroupSums sums;
  for (const Point& point : points) {
    ScatteringMatrix& sum = sums[{point.source.part, point.source.bounces, point.source.mechanism}];
    const Complex phase = std::polar(1.0, k * point.psi);
    const ScatteringMatrix matrix = point.matrix(0);
    for (std::size_t i = 0; i < 4; ++i) sum[i] += phase * matrix[i];
  }
  return sums;
}

std::string text_of(const ContributionGroup& group, const std::vector<std::string>& part_names) {
  return fmt::format("part {}, {} bounce{}, {}", part_names[group.part], group.bounces, group.bounces == 1 ? "" : "s",
                     kMechanismNames[static_cast<std::size_t>(group.mechanism)]);
}

namespace {

using ViewMatrices = std::vector<std::vector<std::array<Complex, 4>>>;  // [view][frequency]

CrossCheckRow row_of(const std::vector<std::array<Complex, 4>>& beams, const std::vector<std::array<Complex, 4>>& rays,
                     std::size_t element) {
  EchoChange change;
  for (std::size_t q = 0; q < beams.size(); ++q) change.add(beams[q][kCoPolar[element]], rays[q][kCoPolar[element]]);
  const double frequencies = static_cast<double>(beams.size());
  CrossCheckRow row;
  row.element = element;
  row.beams_dbsm = dbsm_of_area(4 * kPi * change.reference_m2 / frequencies, kMinPrinted_m2);
  row.rays_dbsm = dbsm_of_area(4 * kPi * change.other_m2 / frequencies, kMinPrinted_m2);
  row.relative_db = change.relative_db();
  return row;
}

// Fills in the groups of a view's rows, hh and vv.
void set_groups(GroupSums beams, const GroupSums& rays, CrossCheckRow* rows) {
  for (const auto& [group, sum] : rays) {
    for (std::size_t i = 0; i < 4; ++i) beams[group][i] -= sum[i];
  }
  for (std::size_t element = 0; element < kCoPolar.size(); ++element) {
    double all = 0, most = 0;
    for (const auto& [group, difference] : beams) {
      const double size = std::abs(difference[kCoPolar[element]]);
      all += size;
      if (size <= most) continue;
      most = size;
      rows[element].group = group;
    }
    if (all > 0) rows[element].fraction = most / all;
  }
}

double middle_frequency(const std::vector<double>& frequency_hz) {
  const auto [lowest, highest] = std::ranges::minmax(frequency_hz);
  return std::ranges::min(frequency_hz, {},
                          [middle = (lowest + highest) / 2](double hz) { return std::abs(hz - middle); });
}

ViewMatrices solved(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop) {
  return std::move(compute_rcs(request, target, threads, stop).sweep.models.back().matrices);
}

void require_comparable(const RcsRequest& request) {
  if (!request.cavities.parts.empty())
    throw InputError("--cross-check compares beams with rays; a --cavity is solved by neither");
  if (request.uncertainty || request.exports.wanted())
    throw InputError("--cross-check does not support --uncertainty and exports of one aspect");
}

}  // namespace

CrossCheck compare_solutions(const RcsRequest& beams, const RcsRequest& rays, const RcsTarget& target, int threads,
                             const StopFlag* stop) {
  require_comparable(beams);
  const RcsSweep sweep = requested_sweep(beams);
  CrossCheck check{std::vector<CrossCheckRow>(2 * sweep.views()), middle_frequency(beams.frequency_hz)};
  {
    const ViewMatrices by_beams = solved(beams, target, threads, stop), by_rays = solved(rays, target, threads, stop);
    for (std::size_t i = 0; i < check.rows.size(); ++i) {
      check.rows[i] = row_of(by_beams[i / 2], by_rays[i / 2], i % 2);
      check.rows[i].azimuth_deg = sweep.azimuth_of(i / 2);
      check.rows[i].elevation_deg = sweep.elevation_of(i / 2);
    }
  }
  if (beams.sea.reflection) return check;
  const double k = 2 * kPi * check.grouped_hz / kSpeedOfLight;
  std::atomic<std::size_t> done{0};
  Progress progress("contributions", sweep.views(), "views");
  try {
    parallel_for(
        sweep.views(), std::min(thread_count(threads), 8),  // each needs the memory of a trace
        [&](std::size_t i) {
          const RcsView view{sweep.azimuth_of(i), sweep.elevation_of(i), check.grouped_hz};
          // One after the other: a view of a large target has millions of contributions.
          const GroupSums of_beams = group_sums(view_contributions(beams, target, view, 1, stop).views[0].points, k);
          set_groups(of_beams, group_sums(view_contributions(rays, target, view, 1, stop).views[0].points, k),
                     &check.rows[2 * i]);
          ++done;
          progress.advance();
        },
        stop);
  } catch (const Interrupted&) {
    throw WorkError(fmt::format("interrupted after the contributions of {} of {} views", done.load(), sweep.views()));
  }
  return check;
}

CrossCheck cross_check_rcs(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop) {
  RcsRequest beams = request, rays = request;
  beams.physical_optics_too = rays.physical_optics_too = false;
  beams.method = SolverMethod::kBeams;
  beams.ray_spacing_m = 0;
  rays.method = SolverMethod::kRays;
  return compare_solutions(beams, rays, target, threads, stop);
}

CrossCheckSummary summary_of(const CrossCheck& check) {
  constexpr std::size_t kWorst = 5;
  std::vector<double> relative, levels;
  for (const CrossCheckRow& row : check.rows) {
    relative.push_back(row.relative_db);
    levels.push_back(row.level_dbsm());
  }
  std::ranges::sort(relative);
  std::ranges::sort(levels);
  CrossCheckSummary summary{quantile(relative, 0.5), quantile(relative, 0.9), {}, {}};
  const double median_level = quantile(levels, 0.5);
  for (std::size_t i = 0; i < check.rows.size(); ++i) {
    if (check.rows[i].level_dbsm() < median_level) continue;
    summary.worst.push_back(i);
    if (std::abs(check.rows[i].difference_db()) > kLargeDifferenceDb) summary.large.push_back(i);
  }
  std::ranges::stable_sort(summary.worst, std::ranges::greater{},
                           [&](std::size_t i) { return check.rows[i].relative_db; });
  if (summary.worst.size() > kWorst) summary.worst.resize(kWorst);
  return summary;
}

namespace {

std::string group_text(const CrossCheckRow& row, const RcsTarget& target) {
  if (!row.group) return "-";
  return fmt::format("{}: {:.2f} of the difference", text_of(*row.group, target.prepared.mesh.part_names),
                     row.fraction);
}

std::string line_of(const CrossCheckRow& row, const RcsTarget& target) {
  return fmt::format("{:>11.6g} {:>13.6g}  {:<7} {:>10.2f} {:>9.2f} {:>13.2f} {:>11.1f}  {}\n", row.azimuth_deg,
                     row.elevation_deg, kCoPolarNames[row.element], row.beams_dbsm, row.rays_dbsm, row.difference_db(),
                     row.relative_db, group_text(row, target));
}

std::string heading() {
  return fmt::format("{:>11} {:>13}  {:<7} {:>10} {:>9} {:>13} {:>11}  {}\n", "azimuth_deg", "elevation_deg", "element",
                     "beams_dbsm", "rays_dbsm", "difference_db", "relative_db", "largest difference");
}

std::string lines_of(const CrossCheck& check, const RcsTarget& target, const std::vector<std::size_t>& rows) {
  constexpr std::size_t kMaxShown = 40;
  std::string lines = heading();
  for (std::size_t i = 0; i < std::min(kMaxShown, rows.size()); ++i) lines += line_of(check.rows[rows[i]], target);
  if (rows.size() > kMaxShown) lines += fmt::format("... and {} more\n", rows.size() - kMaxShown);
  return lines;
}

}  // namespace

std::string cross_check_table(const RcsRequest& request, const RcsTarget& target, const CrossCheck& check,
                              std::span<const std::string> warnings) {
  const auto [lowest, highest] = std::ranges::minmax(request.frequency_hz);
  RcsRequest beams = request, rays = request;
  beams.method = SolverMethod::kBeams;
  rays.method = SolverMethod::kRays;
  const Scatterer& scatterer = *target.prepared.scatterer;
  std::string csv = rcs_heading(beams, scatterer, "rcs --cross-check", warnings) +
                    fmt::format(
                        "# rays: ray_spacing_m {:.6g}\n# {} frequencies from {:.9g} to {:.9g} Hz; levels of the mean "
                        "cross-section over them; "
                        "difference: rays less beams; relative: |S_rays - S_beams| / |S_beams|, both root sums of "
                        "squares over the frequencies, dB\n"
                        "# part, bounces, mechanism: the contributions whose sums differ most at {:.9g} Hz; fraction: "
                        "of the sum of the magnitudes of the differences of all such sums\n"
                        "azimuth_deg,elevation_deg,element,beams_dbsm,rays_dbsm,difference_db,relative_db,part,bounces,"
                        "mechanism,fraction\n",
                        ray_spacing(scatterer, settings_of(rays, target, rays.edges)), request.frequency_hz.size(),
                        lowest, highest, check.grouped_hz);
  for (const CrossCheckRow& row : check.rows) {
    csv += fmt::format("{:.9g},{:.9g},{},{:.4f},{:.4f},{:.4f},{:.3f}", row.azimuth_deg, row.elevation_deg,
                       kCoPolarNames[row.element], row.beams_dbsm, row.rays_dbsm, row.difference_db(), row.relative_db);
    if (row.group) {
      csv += fmt::format(",{},{},{},{:.4f}\n", csv_cell(target.prepared.mesh.part_names[row.group->part]),
                         row.group->bounces, kMechanismNames[static_cast<std::size_t>(row.group->mechanism)],
                         row.fraction);
    } else {
      csv += ",,,,\n";
    }
  }
  return csv;
}

std::string cross_check_text(const CrossCheck& check, const RcsTarget& target) {
  std::string text = heading();
  for (const CrossCheckRow& row : check.rows) text += line_of(row, target);
  const CrossCheckSummary summary = summary_of(check);
  text += fmt::format("Relative difference of {} rows: median {:.1f} dB, 90th percentile {:.1f} dB\n",
                      check.rows.size(), summary.median_relative_db, summary.p90_relative_db);
  if (summary.p90_relative_db > -kMostRelativeDb || !summary.large.empty()) {
    text += "Largest relative differences, of rows whose level is at least the median of all:\n" +
            lines_of(check, target, summary.worst);
  }
  text += fmt::format("Rows of these levels that differ by more than {:g} dB: {}\n", kLargeDifferenceDb,
                      summary.large.empty() ? "none" : std::to_string(summary.large.size()));
  if (!summary.large.empty()) text += lines_of(check, target, summary.large);
  return text;
}

namespace {

FigureAxis axis_of(std::string label, const std::vector<double>& values, double margin, double longest) {
  const auto [low, high] = std::ranges::minmax(values);
  return {std::move(label), AxisRange{std::max(low, high - longest) - margin, high + margin}, false};
}

}  // namespace

PlotPanels cross_check_plots(const CrossCheck& check) {
  const auto varies = [&](double CrossCheckRow::*angle) {
    return std::ranges::any_of(check.rows,
                               [&](const CrossCheckRow& row) { return row.*angle != check.rows.front().*angle; });
  };
  const bool azimuth = varies(&CrossCheckRow::azimuth_deg), elevation = varies(&CrossCheckRow::elevation_deg);
  if (azimuth == elevation) return {};
  constexpr double kMargin_db = 3, kLongest_db = 60;
  PlotPanels panels{.plots = {}, .columns = 2, .size = {1500, 800}};
  for (const bool levels : {true, false}) {
    for (std::size_t element = 0; element < kCoPolarNames.size(); ++element) {
      Series beams{"beams", {}, {}, {}, SeriesStyle::kLines}, rays{"rays", {}, {}, {}, SeriesStyle::kLines},
          difference{"", {}, {}, {}, SeriesStyle::kLines};
      std::vector<double> both;
      for (const CrossCheckRow& row : check.rows) {
        if (row.element != element) continue;
        beams.x.push_back(azimuth ? row.azimuth_deg : row.elevation_deg);
        beams.y.push_back(row.beams_dbsm);
        rays.y.push_back(row.rays_dbsm);
        difference.y.push_back(row.relative_db);
        both.insert(both.end(), {row.beams_dbsm, row.rays_dbsm});
      }
      rays.x = difference.x = beams.x;
      LinePlot plot;
      plot.x = axis_of(azimuth ? "azimuth (deg)" : "elevation (deg)", beams.x, 0, 1e9);
      if (levels) {
        plot.title = kCoPolarNames[element];
        plot.y = axis_of("radar cross section (dBsm)", both, kMargin_db, kLongest_db);
        plot.series = {std::move(beams), std::move(rays)};
      } else {
        plot.y = axis_of("relative difference (dB)", difference.y, kMargin_db, kLongest_db);
        plot.series = {std::move(difference)};
      }
      panels.plots.push_back(std::move(plot));
    }
  }
  return panels;
}

namespace {

SolverMethod other_than(SolverMethod method) {
  return method == SolverMethod::kBeams ? SolverMethod::kRays : SolverMethod::kBeams;
}

Scenario by_the_other_method(Scenario scenario) {
  for (TargetSpec& target : scenario.targets) target.solver.method = other_than(target.solver.method);
  return scenario;
}

bool has_solver(const Pipeline& pipeline, std::size_t target) {
  const auto is_mesh = [&](std::size_t t) { return !pipeline.targets()[t].models.empty(); };
  return is_mesh(target) || std::ranges::any_of(pipeline.targets()[target].companions, is_mesh);
}

SampleDifference difference_of(const Pipeline& pipeline, const Pipeline& other, std::size_t sample,
                               const StopFlag* stop) {
  const SampleAddress at = pipeline.plan().address(sample);
  const TargetSpec& target = pipeline.scenario().targets[static_cast<std::size_t>(at.target)];
  const PulseTrain train = pipeline.pulse_train(sample);
  const IntervalResult response = pipeline.response(at, train, stop), by_other = other.response(at, train, stop);
  const std::vector<float> map = pipeline.received_sample(sample, train, response).stored.magnitude,
                           other_map = other.received_sample(sample, train, by_other).stored.magnitude;
  const std::size_t cell = static_cast<std::size_t>(std::ranges::max_element(map) - map.begin());
  return {
      sample,
      target.name,
      target.solver.method,
      other_than(target.solver.method),
      relative_difference_db(response.response, by_other.response),
      std::clamp(20 * std::log10(static_cast<double>(other_map[cell]) / map[cell]), -kMostRelativeDb, kMostRelativeDb)};
}

const SampleDifference& largest_by(const std::vector<SampleDifference>& all, auto size) {
  return *std::ranges::max_element(all, {}, size);
}

}  // namespace

double SampleCrossCheck::median_response_db() const {
  std::vector<double> values;
  for (const SampleDifference& one : differences) values.push_back(one.response_db);
  return quartiles(std::move(values)).median;
}

std::vector<std::size_t> evenly_spread(std::size_t count, std::size_t size) {
  std::vector<std::size_t> samples(count);
  for (std::size_t n = 0; n < count; ++n) samples[n] = (2 * n + 1) * size / (2 * count);
  return samples;
}

SampleCrossCheck cross_check_samples(const Scenario& scenario, std::span<const std::size_t> samples, int threads,
                                     const StopFlag* stop) {
  const Pipeline pipeline(scenario), other(by_the_other_method(pipeline.scenario()));
  std::vector<std::optional<SampleDifference>> found(samples.size());
  Progress progress("cross-check", samples.size(), "samples");
  parallel_for(
      samples.size(), thread_count(threads),
      [&](std::size_t n) {
        if (has_solver(pipeline, static_cast<std::size_t>(pipeline.plan().address(samples[n]).target)))
          found[n] = difference_of(pipeline, other, samples[n], stop);
        progress.advance();
      },
      stop);
  SampleCrossCheck check;
  check.is_sea_alone = is_sea_alone(scenario);
  for (const auto& one : found) {
    if (one) {
      check.differences.push_back(*one);
    } else {
      ++check.points;
    }
  }
  return check;
}

double relative_difference_db(const FrequencyResponse& reference, const FrequencyResponse& other) {
  EchoChange change;
  for (std::size_t i = 0; i < reference.values.size(); ++i) change.add(reference.values[i], other.values[i]);
  return change.relative_db();
}

std::string text_of(const SampleCrossCheck& check) {
  const std::vector<SampleDifference>& all = check.differences;
  std::string left_out = check.points > 0 ? fmt::format("{} sample{} of {} left out, which have no solver\n",
                                                        check.points, check.points == 1 ? "" : "s",
                                                        check.is_sea_alone ? "the sea alone" : "ideal points")
                                          : "";
  if (all.empty()) return left_out;
  std::size_t width = std::string_view("target").size();
  for (const SampleDifference& one : all) width = std::max(width, one.target.size());
  std::string text = fmt::format("{:>8}  {:<{}}  {:<6}  {:<5}  {:>11}  {:>17}\n", "sample", "target", width, "method",
                                 "other", "response_db", "strongest_cell_db");
  std::vector<double> cells;
  for (const SampleDifference& one : all) {
    text +=
        fmt::format("{:>8}  {:<{}}  {:<6}  {:<5}  {:>11.1f}  {:>+17.3f}\n", one.sample, one.target, width,
                    kSolverMethodNames[static_cast<std::size_t>(one.method)],
                    kSolverMethodNames[static_cast<std::size_t>(one.other)], one.response_db, one.strongest_cell_db);
    cells.push_back(std::abs(one.strongest_cell_db));
  }
  const SampleDifference& response = largest_by(all, [](const auto& one) { return one.response_db; });
  const SampleDifference& cell = largest_by(all, [](const auto& one) { return std::abs(one.strongest_cell_db); });
  return text +
         fmt::format(
             "relative difference of the response by the other method: median {:.1f} dB, largest {:.1f} dB (sample "
             "{})\n"
             "change of the strongest cell of the map: median of its magnitude {:.3f} dB, largest {:+.3f} dB (sample "
             "{})\n",
             check.median_response_db(), response.response_db, response.sample, quartiles(cells).median,
             cell.strongest_cell_db, cell.sample) +
         left_out;
}

}  // namespace seaglint
