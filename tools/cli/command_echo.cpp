// SPDX-License-Identifier: BSD-3-Clause
// The echo of one sample as I/Q samples over time.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "classify/dataset/format/npz.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "sim/core/text/json_number.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/writer.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/sampled_interval.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {
namespace {

struct Arguments : ScenarioArguments {
  std::size_t sample = 0;
  std::string output;
};

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

void write_echo(const Arguments& arguments) {
  require_npz(arguments.output);
  const Scenario scenario = arguments.read();
  const SamplePlan plan(scenario);
  if (arguments.sample >= plan.size())
    throw InputError(fmt::format("--sample {}: the scenario has samples 0 to {}", arguments.sample, plan.size() - 1));
  const Pipeline pipeline(scenario, plan);
  report_motion_files(pipeline);
  report_spectrum_table(scenario);
  warn(mesh_warnings(pipeline));
  warn(motion_warnings(pipeline));
  warn(sea_warnings(scenario, plan.sea_states()));
  warn(band_warnings(pipeline));
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
  auto arguments = std::make_shared<Arguments>();
  add_scenario_arguments(command, *arguments);
  command.add_option("--sample", arguments->sample, "Number of the sample in the scenario's plan").show_default();
  command.add_option("-o,--output", arguments->output, "File, .npz").required();
  add_threads_option(command, context);
  command.footer("Example:\n  seaglint echo scenarios/points.yaml --sample 0 -o echo.npz");
  command.callback([arguments, &context] {
    context.uninterruptible = true;
    context.work = [arguments] { write_echo(*arguments); };
  });
}

}  // namespace seaglint
