// SPDX-License-Identifier: BSD-3-Clause
// Regenerates one sample of a data set from its scenario and row and compares it with the stored one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/directory/input_list.h"
#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/npz.h"
#include "sim/core/process/error.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/regenerate.h"

namespace seaglint {

namespace {

struct Arguments {
  std::string directory;
  std::size_t sample = 0;
  std::string output;
};

std::vector<NpzArray> arrays_of(const Sample& sample, const StoredAxes& axes) {
  const std::uint64_t velocities = axes.velocity_mps.size(), ranges = axes.range_m.size();
  std::vector<NpzArray> arrays;
  arrays.push_back(npz_array("axes/range_m", "<f8", {ranges}, bytes_of_values(std::span(axes.range_m))));
  arrays.push_back(npz_array("axes/velocity_mps", "<f8", {velocities}, bytes_of_values(std::span(axes.velocity_mps))));
  arrays.push_back(npz_array("map", "<f4", {velocities, ranges}, bytes_of_values(std::span(sample.magnitude))));
  arrays.push_back(
      npz_array("map_complex", "<c8", {velocities, ranges}, bytes_of_values(std::span(sample.complex_values))));
  arrays.push_back(npz_array("hop_code", "<u2", {sample.hop_code.size()}, bytes_of_values(std::span(sample.hop_code))));
  arrays.push_back(
      npz_array("centres", "<f4", {sample.centre_list.size(), 3}, bytes_of_values(std::span(sample.centre_list))));
  for (const SampleColumn& column : sample_columns()) {
    std::visit(
        [&](auto member) {
          const auto& value = sample.record.*member;
          using T = std::decay_t<decltype(value)>;
          const std::string name = std::string("samples/") + column.name;
          if constexpr (std::is_same_v<T, std::string>) {
            arrays.push_back(npz_array(name, "|S64", {}, packed_names(std::span(&value, 1))));
          } else {
            arrays.push_back(
                npz_array(name, std::is_same_v<T, double> ? "<f8" : "<i8", {}, bytes_of_values(std::span(&value, 1))));
          }
        },
        column.member);
  }
  return arrays;
}

void regenerate_sample(const Arguments& arguments) {
  require_npz(arguments.output);
  const DatasetReader reader(find_data_set(arguments.directory));
  if (arguments.sample >= reader.size())
    throw InputError(fmt::format("--sample {}: the data set has samples 0 to {}", arguments.sample, reader.size() - 1));
  const StoredSample stored = stored_sample(reader, arguments.sample);
  Scenario scenario = read_scenario(reader.directory() / kScenarioFile);
  require_same_inputs(reader.directory(), scenario);
  scenario.dataset.complex_maps = true;  // for the output; the other results do not depend on it
  const Pipeline pipeline(scenario);
  if (arguments.sample >= pipeline.plan().size()) {
    throw InputError(
        fmt::format("{}: has no sample {}", (reader.directory() / kScenarioFile).string(), arguments.sample));
  }
  const GeneratedSample made = pipeline.generate_sample(arguments.sample);
  const SampleRecord& row = made.stored.record;
  fmt::print("sample {}: {}, label {}, Hs {:g} m, azimuth {:g} deg, elevation {:g} deg, group {}, at {:g} s\n",
             row.sample, row.target_name, row.label, row.significant_wave_height_m, row.azimuth_deg, row.elevation_deg,
             row.group, row.start_s);
  if (!arguments.output.empty()) {
    write_npz(arguments.output, arrays_of(made.stored, stored_axes(made.received.map)));
    fmt::print("{}: written\n", arguments.output);
  }

  const double tolerance = reproduction_tolerance(stored.origin);
  std::vector<std::string> found = differences(stored.sample, made.stored, tolerance);
  if (stored_axes(made.received.map) != stored.axes) found.push_back("its axes differ");
  if (!found.empty()) {
    throw InputError(
        fmt::format("{}: sample {} made again: {}", arguments.directory, arguments.sample, fmt::join(found, "; ")));
  }
  if (tolerance == 0) {
    fmt::print("made again it is as stored, bit for bit\n");
  } else {
    fmt::print(
        "made again it is as stored within {:g} of the map's peak and of each column; it was made by seaglint {} on "
        "{}\n",
        tolerance, stored.origin.program_version, stored.origin.processor);
  }
}

}  // namespace

void add_regenerate(CLI::App& app, CommandContext& shell) {
  CLI::App* command =
      app.add_subcommand("remake", "Make one sample of a data set again and hold it against what is stored");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("directory", arguments->directory, "Directory of the data set")->required();
  command->add_option("--sample", arguments->sample, "Number of the sample")->required();
  command->add_option("-o,--output", arguments->output,
                      "Map (also complex), axes, hop code, centres and row as NumPy's .npz");
  command->footer("Example:\n  seaglint remake build/points/data --sample 7 -o build/sample_7.npz");
  command->callback([arguments, &shell] {
    shell.uninterruptible = true;
    shell.work = [arguments] { regenerate_sample(*arguments); };
  });
}

}  // namespace seaglint
