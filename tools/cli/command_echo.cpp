// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>
#include <variant>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/format/npz.h"
#include "classify/features/feature_vector.h"
#include "classify/features/rigidity.h"
#include "classify/features/scattering_centres.h"
#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tools/cli/command_line.h"
#include "tools/figure/map_figure.h"
#include "tools/pipeline/imaging.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

struct SampleArguments : ScenarioArguments {
  std::size_t sample = 0;
  std::string output;
};

void add_sample_arguments(CommandOptions& command, SampleArguments& arguments, const std::string& output) {
  add_scenario_arguments(command, arguments);
  command.add_option("--sample", arguments.sample, "Number of the sample in the scenario's plan").show_default();
  command.add_option("-o,--output", arguments.output, output).required();
}

// Pipeline of the scenario, which has the sample.
Pipeline pipeline_of(const SampleArguments& arguments) {
  const Scenario scenario = arguments.read();
  const SamplePlan plan(scenario);
  if (arguments.sample >= plan.size())
    throw InputError(fmt::format("--sample {}: the scenario has samples 0 to {}", arguments.sample, plan.size() - 1));
  return Pipeline(scenario, plan);
}

}  // namespace

// The echo of one sample as I/Q samples over time.

namespace {

NpzArray doubles(const char* name, const std::vector<double>& values) {
  return npz_array(name, "<f8", {values.size()}, bytes_of_values(std::span<const double>(values)));
}

NpzArray samples_over_time(const char* name, const SampledEcho& sampled) {
  std::vector<std::complex<float>> values(sampled.values.begin(), sampled.values.end());
  return npz_array(name, "<c8", {static_cast<std::uint64_t>(sampled.pulses), sampled.samples()},
                   bytes_of_values(std::span<const std::complex<float>>(values)));
}

// The columns of the sample in a data set of the scenario, by name; null where undefined.
nlohmann::ordered_json columns_json(const SampleRecord& record) {
  nlohmann::ordered_json json;
  for (const SampleColumn& column : sample_columns()) {
    std::visit(
        [&](auto member) {
          if constexpr (std::is_same_v<decltype(member), double SampleRecord::*>) {
            json[column.name] = number_or_null(record.*member);
          } else {
            json[column.name] = record.*member;
          }
        },
        column.member);
  }
  return json;
}

void write_echo(const SampleArguments& arguments) {
  require_npz(arguments.output);
  const Pipeline pipeline = pipeline_of(arguments);
  report_scenario(pipeline, {.bands = true});
  const Scenario& scenario = pipeline.scenario();
  const SampledInterval interval = sampled_interval(pipeline, arguments.sample);
  const std::vector<std::int64_t> code(interval.train.code.begin(), interval.train.code.end());

  std::vector<NpzArray> arrays{samples_over_time("target", interval.target)};
  if (interval.clutter) arrays.push_back(samples_over_time("clutter", *interval.clutter));
  if (interval.noise) arrays.push_back(samples_over_time("noise", *interval.noise));
  arrays.push_back(doubles("time_s", interval.target.time_s));
  arrays.push_back(doubles("pulse_time_s", interval.train.time_s));
  arrays.push_back(doubles("carrier_hz", interval.train.carrier_hz));
  arrays.push_back(npz_array("hop_code", "<i8", {code.size()}, bytes_of_values(std::span<const std::int64_t>(code))));
  arrays.push_back(doubles("frequency_hz", interval.train.baseband_hz));
  const nlohmann::ordered_json description{
      {"program", fmt::format("seaglint {}", kVersion)},
      {"scenario", scenario.name},
      {"seed", scenario.seed},
      {"sample", arguments.sample},
      {"sampling_hz", interval.target.sampling_hz},
      {"target, clutter, noise",
       "m, [pulse][sample], mixed with the pulse's carrier; a point of scattering amplitude a answers with the chirp "
       "times a"},
      {"time_s", "s, of the samples; 0 = the middle of the pulse returns from the reference point"},
      {"pulse_time_s", "s, middle of each pulse from the interval's start"},
      {"carrier_hz", "Hz, of each pulse"},
      {"hop_code", "carrier number of each pulse"},
      {"frequency_hz", "Hz, of the map's frequencies from each pulse's carrier"},
      {"columns", columns_json(interval.record)}};
  write_npz(arguments.output, arrays,
            {{"description.json", description.dump(2) + "\n"}, {"scenario.yaml", effective_yaml(scenario)}});
  print_out("{}: {} pulses of {} samples at {:g} MHz\n", arguments.output, interval.target.pulses,
            interval.target.samples(), interval.target.sampling_hz * 1e-6);
}

}  // namespace

void add_echo(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("echo", "Write the echo of one sample as I/Q samples over time (NumPy .npz)");
  auto arguments = std::make_shared<SampleArguments>();
  add_sample_arguments(command, *arguments, "File, .npz");
  add_threads_option(command, context);
  command.footer("Example:\n  seaglint echo scenarios/points.yaml --sample 0 -o echo.npz");
  command.callback([arguments, &context] {
    context.uninterruptible = true;
    context.work = [arguments] { write_echo(*arguments); };
  });
}

// One range-velocity map of a scenario: its figure, its scattering centres and its features.

namespace {

void print_result(const ReceivedInterval& received, const std::vector<ScatteringCentre>& centres,
                  const FeatureVector& features) {
  print_out("  range_m  velocity_mps  amplitude_m\n");
  for (const ScatteringCentre& c : centres)
    print_out("{:9.3f} {:13.4f} {:12.4g}\n", c.range_m, c.velocity_mps, c.amplitude_m);
  print_out("centres {}{}, MWR {:.4g} (m/s)^2, CCF {:.4g}, sigma_r {:.4g} m, sigma_v {:.4g} m/s\n", features.centres,
            features.degenerate ? " (too few to say much)" : "", features.mwr, features.ccf, features.sigma_r,
            features.sigma_v);
  if (!std::isnan(received.scr.per_pulse_db)) {
    print_out("SCR per pulse {:.2f} dB, peak cell {:.2f} dB, extent {:.2f} dB\n", received.scr.per_pulse_db,
              received.scr.peak_cell_db, received.scr.scr_extent_db);
  }
  if (!std::isnan(received.scr.snr_per_pulse_db)) print_out("SNR per pulse {:.2f} dB\n", received.scr.snr_per_pulse_db);
  if (received.map.unused_carriers > 0) print_out("carriers without a pulse: {}\n", received.map.unused_carriers);
}

// Tracks over the looks of a sample, their mean in the looks in which they are seen, and the test of rigidity.
void print_tracks(const TrackSet& set) {
  print_out("track  looks  range_m  velocity_mps  amplitude_m\n");
  for (std::size_t j = 0; j < set.tracks.size(); ++j) {
    ScatteringCentre sum;
    for (const TrackPoint& point : set.tracks[j].points) {
      sum.range_m += point.measured.range_m;
      sum.velocity_mps += point.measured.velocity_mps;
      sum.amplitude_m += point.measured.amplitude_m;
    }
    const int seen = set.tracks[j].looks_seen();
    print_out("{:5} {:6} {:8.3f} {:13.4f} {:12.4g}\n", j, seen, sum.range_m / seen, sum.velocity_mps / seen,
              sum.amplitude_m / seen);
  }
  const ChiSquare rigid = fit_rigid_body(set).test;
  print_out("tracks {} over {} looks; ", set.tracks.size(), set.time_s.size());
  if (rigid.defined()) {
    print_out("one rigid body: chi-square {:.4g} of {} degrees of freedom, p = {:.2g}\n", rigid.value, rigid.degrees,
              rigid.p_value());
  } else {
    print_out("too few to test whether they are one rigid body\n");
  }
}

struct MapArguments : SampleArguments {
  std::string product = "rv", style = "screen", centres = "on";
  bool whole = false;
  int look = 0;

  SampleLook of() const { return {sample, look}; }
};

std::vector<float> single(const std::vector<double>& values) { return {values.begin(), values.end()}; }

// True where the command line sets a key, which then has precedence over what the target's motion suggests.
bool sets(const MapArguments& arguments, const std::string& key) {
  return std::ranges::any_of(arguments.set, [&](const std::string& word) { return word.starts_with(key + "="); });
}

struct ProductRequest {
  const MapArguments& arguments;
  const Pipeline& pipeline;
  const RadarSpec& radar;      // with the sample's drawn values
  const SampleRecord& record;  // planned
  int threads = 0;

  double start_s() const { return pipeline.plan().start_s(pipeline.address(arguments.of())); }
};

void append(const std::vector<std::string>& more, std::vector<std::string>& notes) {
  notes.insert(notes.end(), more.begin(), more.end());
}

std::string product_title(const std::string& product, const SampleRecord& record) {
  return fmt::format("{}: {}, azimuth {:g} deg, Hs {:g} m", product, record.target_name, record.azimuth_deg,
                     record.significant_wave_height_m);
}

Heatmap isar_figure(const ProductRequest& request) {
  const auto& [arguments, pipeline, radar, record, threads] = request;
  IsarPlan plan = isar_plan(pipeline, arguments.of());
  const MapSpec& own = pipeline.scenario().map;
  MapSpec& map = *plan.sampling.map;
  if (sets(arguments, "radar.pulses")) {
    plan.sampling.pulses = radar.pulses;
    plan.duration_s = 1e-6 * radar.pri_us * radar.pulses;
    plan.cross_range.reset();
  }
  if (sets(arguments, "map.range_span_m")) map.range_span_m = own.range_span_m;
  if (sets(arguments, "map.velocity_span_mps")) map.velocity_span_mps = own.velocity_span_mps;
  if (sets(arguments, "map.range_oversampling")) map.range_oversampling = own.range_oversampling;
  if (sets(arguments, "map.velocity_oversampling")) map.velocity_oversampling = own.velocity_oversampling;
  if (sets(arguments, "map.range_taper")) map.range_taper = own.range_taper;
  if (sets(arguments, "map.velocity_taper")) map.velocity_taper = own.velocity_taper;
  const FullBandInterval band = full_band_interval(pipeline, arguments.of(), plan.sampling);
  const MagnitudeMap image = magnitude_map(band.image);
  const std::optional<MapWindow> window =
      arguments.whole ? std::nullopt : std::optional(MapWindow{plan.range_m, plan.velocity_mps});

  Heatmap figure;
  figure.title = product_title("ISAR", record);
  figure.x.label = "range (m)";
  figure.y.label = "velocity (m/s)";
  figure.colour = level_axis("|RV|");
  figure.map = levels_in(image.axes, image.magnitude, window);
  figure.notes.push_back("target alone, whole band in every pulse");
  figure.notes.push_back(fmt::format("from {:.2f} s on", request.start_s() + plan.sampling.offset_s));
  if (const auto& cross = plan.cross_range) {
    constexpr double kUpright = 0.94;  // within 20 deg of the vertical
    const double sign = cross->up < 0 ? -1 : 1;
    const bool upright = std::abs(cross->up) > kUpright;
    figure.right = {upright ? "height (m)" : "cross range (m)", cross->origin_mps, sign * cross->rate_rad_s};
    figure.upside_down = sign < 0;
    figure.notes.push_back(fmt::format("aspect change {:.2f} deg", degrees(cross->angle_rad)));
    figure.notes.push_back(
        fmt::format("cells {:.2g} m in range, {:.2g} m across", band.train.range_resolution_m(), cross->cell_m));
    if (!upright) {
      figure.notes.push_back(
          fmt::format("image plane {:.0f} deg off the vertical", degrees(std::acos(std::abs(cross->up)))));
    }
  } else {
    figure.notes.push_back("no cross range: " + (plan.no_cross_range.empty() ? "own interval" : plan.no_cross_range));
  }
  RadarSpec shown = radar;
  shown.pulses = plan.sampling.pulses;
  append(small_print(pipeline.scenario(), shown, record), figure.notes);
  return figure;
}

Heatmap hrrp_figure(const ProductRequest& request, std::size_t names) {
  const auto& [arguments, pipeline, radar, record, threads] = request;
  constexpr int kProfiles = 48;
  const Scenario& scenario = pipeline.scenario();
  ProfileTimes times{
      .duration_s = 1e-6 * radar.pri_us * radar.pulses, .count = kProfiles, .map = scenario.map, .threads = threads};
  if (!sets(arguments, "map.range_oversampling")) times.map.range_oversampling = 4;
  const bool recorded = std::ranges::any_of(
      scenario.targets, [](const TargetSpec& target) { return target.motion.model == MotionModel::kSeries; });
  if (record.significant_wave_height_m > 0 && !recorded && !sets(arguments, "radar.pulses"))
    times.duration_s = std::max(times.duration_s, record.peak_period_s);
  const RangeProfiles profiles = profiles_over(pipeline, arguments.of(), times);
  const std::size_t cells = profiles.range_m.size();
  const std::vector<float> magnitudes = single(profiles.magnitude_m);
  const float strongest = std::ranges::max(magnitudes);

  Heatmap figure;
  figure.title = product_title("range profile", record);
  figure.x.label = "range (m)";
  const bool seconds = profiles.time_s.back() >= 1;
  figure.y.label = seconds ? "time (s)" : "time (ms)";
  figure.colour = {"level to peak (dB)", AxisRange{kMapFloorDb, 0}, false};
  const IsarPlan plan = isar_plan(pipeline, arguments.of());
  const std::optional<MapWindow> window =
      arguments.whole ? std::nullopt : std::optional(MapWindow{plan.range_m, {-1e300, 1e300}});
  figure.map = levels_in({profiles.range_m, profiles.time_s}, magnitudes, window);
  for (double& time : figure.map.y) time *= seconds ? 1 : 1e3;
  ProfileAbove& above = figure.profile.emplace();
  above.y = {"RCS (dBsm)", {}, false};
  const auto dbsm = [](double magnitude_m) {
    return 20 * std::log10(std::max(magnitude_m, 1e-9)) + 10 * std::log10(4 * kPi);
  };
  const double top =
      std::ceil(dbsm(*std::max_element(magnitudes.begin(), magnitudes.begin() + static_cast<std::ptrdiff_t>(cells))) /
                5) *
      5;
  above.y.range = AxisRange{top + kMapFloorDb, top};
  for (const double range_m : figure.map.x) {
    const auto at = static_cast<std::size_t>(std::ranges::find(profiles.range_m, range_m) - profiles.range_m.begin());
    above.values.push_back(dbsm(profiles.magnitude_m[at]));
  }
  for (const NamedPeak& peak : named_peaks(pipeline, arguments.of(), profiles, names))
    above.peaks.push_back({peak.range_m, dbsm(peak.magnitude_m), peak.name});
  figure.notes.push_back("target alone, whole band in every pulse");
  figure.notes.push_back(fmt::format("above: at {:.2f} s, named by what scatters most", request.start_s()));
  figure.notes.push_back(fmt::format("0 dB below: {:.1f} dBsm", dbsm(strongest)));
  RadarSpec shown = radar;
  shown.pulses = times.count;
  shown.pri_us = 1e6 * times.duration_s / times.count;
  append(small_print(scenario, shown, record), figure.notes);
  return figure;
}

Heatmap map_figure(const MapArguments& arguments, const Pipeline& pipeline, const RadarSpec& radar,
                   const GeneratedSample& made) {
  constexpr double kDetail = 4;  // cells of the target's window in each cell of the map, along both axes
  const Scenario& scenario = pipeline.scenario();
  std::optional<MagnitudeMap> fine;
  if (!scenario.map.clean) {
    MapSpec finer = scenario.map;
    finer.range_oversampling *= kDetail;
    finer.velocity_oversampling *= kDetail;
    fine = magnitude_map(form_rv_map(made.received.echo, made.train, finer, radar.intra_pulse_motion));
  }
  Heatmap figure = rv_figure({.sample = made.stored,
                              .axes = stored_axes(made.received.map),
                              .line = least_squares_line(made.centres, scenario.features),
                              .whole = arguments.whole,
                              .centres = arguments.centres == "on",
                              .fine = fine ? &*fine : nullptr});
  append(small_print(scenario, radar, made.stored.record), figure.notes);
  return figure;
}

void show_map(const MapArguments& arguments, int threads) {
  require_figure(arguments.output);
  const Pipeline pipeline = pipeline_of(arguments);
  const SamplePlan& plan = pipeline.plan();
  if (arguments.look >= plan.looks())
    throw InputError(fmt::format("--look {}: the sample has looks 0 to {}", arguments.look, plan.looks() - 1));
  const SampleAddress at = pipeline.address(arguments.of());
  const RadarSpec radar = pipeline.scenario_of(at).radar;
  const bool is_map = arguments.product == "rv";
  const FigureStyle style = figure_style(arguments.style);
  report_scenario(pipeline, {.bands = is_map, .coverage = is_map});
  const auto write = [&](Heatmap figure) {
    figure.notes.push_back(fmt::format("seaglint {}", kVersion));
    write_figure(figure, arguments.output, map_size(style));
  };
  if (is_map) {
    const std::vector<GeneratedSample> looks = pipeline.generate_looks(arguments.sample);
    const GeneratedSample& made = looks[static_cast<std::size_t>(arguments.look)];
    write(map_figure(arguments, pipeline, radar, made));
    print_result(made.received, made.centres, made.features);
    if (looks.size() > 1) print_tracks(tracks_of(looks));
    return;
  }
  const SampleRecord record = planned_record(pipeline.scenario(), plan, arguments.sample, at);
  const ProductRequest request{arguments, pipeline, radar, record, threads};
  write(arguments.product == "isar" ? isar_figure(request)
                                    : hrrp_figure(request, style == FigureStyle::kPaper ? 6 : 12));
}

}  // namespace

void add_map(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("map", "Draw one range-velocity map, list its scattering centres and features");
  auto arguments = std::make_shared<MapArguments>();
  add_sample_arguments(command, *arguments, "Picture, .png, .svg or .pdf");
  command.add_option("--look", arguments->look, "Number of the look, of a scenario with looks.count")
      .integer_within(0, 999)
      .show_default();
  command
      .add_option(
          "--product", arguments->product,
          "rv: range-velocity map; isar, hrrp: ISAR image or range profiles of the target alone, full synthetic "
          "bandwidth in every pulse")
      .one_of({"rv", "isar", "hrrp"})
      .show_default();
  add_style_option(command, arguments->style);
  command.add_flag("--whole", arguments->whole, "The whole map; else the target's own window, with the whole as inset");
  command.add_option("--centres", arguments->centres, "Rings at the scattering centres and the line fitted to them")
      .one_of({"on", "off"})
      .show_default();
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint map scenarios/points.yaml --sample 0 -o map.png\n"
      "  seaglint map scenarios/points.yaml --sample 0 --set map.clean=true -o clean.png");
  command.callback([arguments, &context] {
    context.uninterruptible = true;
    context.work = [arguments, &context] { show_map(*arguments, context.threads); };
  });
}

}  // namespace seaglint
