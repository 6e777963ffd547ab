// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "classify/dataset/format/npz.h"
#include "classify/features/feature_vector.h"
#include "classify/features/scattering_centres.h"
#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tools/cli/command_line.h"
#include "tools/figure/figure.h"
#include "tools/pipeline/pipeline.h"
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

struct MapArguments : SampleArguments {
  std::string product = "rv";
};

// Profiles of single pulses as a heat map over time, dB against the largest value.
Heatmap profile_figure(const RangeProfiles& profiles, const std::string& title) {
  const double peak = *std::max_element(profiles.magnitude_m.begin(), profiles.magnitude_m.end());
  Heatmap figure;
  figure.title = title;
  figure.x.label = "range against the reference point (m), positive = farther";
  figure.y.label = "time in the interval (ms)";
  figure.colour = {"|HRRP| against the peak (dB)", AxisRange{-40, 0}, false};
  figure.x_cells = profiles.range_m;
  for (const double t : profiles.time_s) figure.y_cells.push_back(1e3 * t);
  for (const double m : profiles.magnitude_m) figure.values.push_back(std::max(-40.0, 20 * std::log10(m / peak)));
  return figure;
}

void show_map(const MapArguments& arguments) {
  require_figure(arguments.output);
  const Pipeline pipeline = pipeline_of(arguments);
  const Scenario& scenario = pipeline.scenario();
  const SamplePlan& plan = pipeline.plan();
  const std::size_t sample = arguments.sample;
  const bool is_map = arguments.product == "rv";
  report_scenario(pipeline, {.bands = is_map, .coverage = is_map});
  const SampleAddress address = plan.address(sample);
  const TargetSpec& target = scenario.targets[static_cast<std::size_t>(address.target)];
  const View view = plan.view(address);
  const std::string title =
      fmt::format("{}: sample {}, {}, Hs {:g} m, azimuth {:g} deg, elevation {:g} deg", scenario.name, sample,
                  target.name, plan.sea_state(address).significant_wave_height_m, view.azimuth_deg, view.elevation_deg);
  if (!is_map) {
    const FullBandInterval band = full_band_interval(pipeline, sample);
    if (arguments.product == "isar") {
      write_figure(rv_figure(band.image, {}, title + ", whole band every pulse"), arguments.output);
    } else {
      write_figure(profile_figure(range_profiles(band, scenario.map), title), arguments.output);
    }
    return;
  }
  const GeneratedSample made = pipeline.generate_sample(sample);
  write_figure(rv_figure(made.received.map, made.centres, title), arguments.output);
  print_result(made.received, made.centres, made.features);
}

}  // namespace

void add_map(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("map", "Draw one range-velocity map, list its scattering centres and features");
  auto arguments = std::make_shared<MapArguments>();
  add_sample_arguments(command, *arguments, "Picture, .png or .svg");
  command
      .add_option(
          "--product", arguments->product,
          "rv: range-velocity map; isar, hrrp: ISAR image or range profiles of the target alone, full synthetic "
          "bandwidth in every pulse")
      .one_of({"rv", "isar", "hrrp"})
      .show_default();
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint map scenarios/points.yaml --sample 0 -o map.png\n"
      "  seaglint map scenarios/points.yaml --sample 0 --set map.clean=true -o clean.png");
  command.callback([arguments, &context] {
    context.uninterruptible = true;
    context.work = [arguments] { show_map(*arguments); };
  });
}

}  // namespace seaglint
