// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "classify/dataset/directory/audit.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/directory/export.h"
#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/npz.h"
#include "classify/dataset/format/shard.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"
#include "sim/core/text/words.h"
#include "tools/cli/command_line.h"
#include "tools/compare/cross_check.h"
#include "tools/figure/map_figure.h"
#include "tools/pipeline/contact_sheet.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/warnings.h"
#include "tools/run/run.h"

namespace seaglint {

// Makes the data set of a scenario, or maps and features again from the stored echoes of one.

namespace {

struct GenerateArguments {
  ScenarioArguments scenario;
  std::string directory;
  std::string part;
  bool resume = false;
};

// "2/5": the second of five parts.
void read_part(const std::string& text, GenerateOptions& options) {
  const std::size_t slash = text.find('/');
  const auto number = [&](std::size_t begin, std::size_t end) {
    const std::int64_t value = parse_integer(std::string_view(text).substr(begin, end - begin)).value_or(0);
    return value >= 0 && value <= 1000000 ? static_cast<int>(value) : 0;
  };
  if (slash != std::string::npos) {
    options.part = number(0, slash);
    options.parts = number(slash + 1, text.size());
  }
  if (slash == std::string::npos || options.part < 1 || options.parts < options.part || options.parts < 1) {
    throw InputError(fmt::format("--part: {}: must be I/N with 1 <= I <= N, for example 1/4", text));
  }
}

// Makes the maps and says how many; `from`: of what, " from ..." or empty.
void make_data_set(const Pipeline& pipeline, const std::string& directory, const GenerateOptions& options,
                   const CommandContext& context, const char* from) {
  const auto begin = std::chrono::steady_clock::now();
  GenerateResult result;
  try {
    result = generate_dataset(pipeline, directory, options, &context.stop);
  } catch (const Interrupted&) {
    throw WorkError(
        fmt::format("interrupted; whole shards are kept, go on by the same command with --resume ({})", directory));
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  print_out("{}: {} maps made{} in {:.1f} s, {} kept\n", directory, result.made, from, seconds, result.kept);
  if (result.missing > 0)
    print_out("{} shards of other parts are still missing or damaged; the last part writes the manifest\n",
              result.missing);
  else
    print_out(
        "Next: `seaglint verify {0}`, `seaglint look {0} -o look.png`, {1}or seaglint.Dataset(\"{0}\") in Python\n",
        directory, is_sea_alone(pipeline.scenario()) ? "" : fmt::format("`seaglint train {} -o MODEL`, ", directory));
}

void generate(const GenerateArguments& arguments, const CommandContext& context) {
  GenerateOptions options;
  options.resume = arguments.resume;
  options.threads = context.threads;
  if (!arguments.part.empty()) read_part(arguments.part, options);
  const Scenario scenario = arguments.scenario.read();
  check_division(scenario, SamplePlan(scenario));
  make_data_set(Pipeline(scenario), arguments.directory, options, context, "");
}

struct FeaturesArguments {
  std::string data;
  std::vector<std::string> set;
  std::string directory;
  bool resume = false;
};

void make_features(const FeaturesArguments& arguments, const CommandContext& context) {
  const DatasetReader reader(find_data_set(arguments.data));
  const std::filesystem::path file = reader.directory() / kScenarioFile;
  const Scenario stored = read_scenario(file);
  const StoredEchoes echoes(reader);
  require_same_inputs(reader.directory(), stored);
  const Pipeline pipeline(read_scenario(file, read_overrides(arguments.set)));
  require_same_echoes(pipeline, stored);
  check_division(pipeline.scenario(), pipeline.plan());
  GenerateOptions options;
  options.resume = arguments.resume;
  options.threads = context.threads;
  options.response = [&](const SampleLook& of, const PulseTrain& train) {
    return std::make_shared<const IntervalResult>(echoes.response(of, train));
  };
  make_data_set(pipeline, arguments.directory, options, context, " from stored echoes");
}

}  // namespace

void add_generate(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "generate", "Make the data set of a scenario: range-velocity maps with labels in HDF5 shards");
  auto arguments = std::make_shared<GenerateArguments>();
  add_scenario_arguments(command, arguments->scenario);
  command.add_option("-o,--output", arguments->directory, "Directory of the data set, new or empty").required();
  command.add_option("--part", arguments->part, "Make the I-th of N parts (whole shards), as I/N");
  command.add_flag("--resume", arguments->resume, "Keep the sound shards that are there; also starts a new directory");
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint generate scenarios/points.yaml -o build/points\n"
      "  seaglint generate scenarios/paper.yaml -o build/paper --part 3/16 --resume");
  command.callback([arguments, &context] { context.work = [arguments, &context] { generate(*arguments, context); }; });
}

void add_features(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "features", "Make the maps and features of a data set again from its stored echoes, with other settings");
  auto arguments = std::make_shared<FeaturesArguments>();
  command.add_option("DATA", arguments->data, "Directory of a data set with dataset.echoes: true").required();
  command.add_option("--set", arguments->set, "Replace a value of clutter, map, features or learning, key.path=value")
      .repeatable("KEY.PATH=VALUE");
  command.add_option("-o,--output", arguments->directory, "Directory of the new data set, new or empty").required();
  command.add_flag("--resume", arguments->resume, "Keep the sound shards that are there; also starts a new directory");
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint features build/points --set clutter.scr_db=10 --set features.max_centres=32 -o "
      "build/points_10\n"
      "of a data set that was made with --set dataset.echoes=true");
  command.callback(
      [arguments, &context] { context.work = [arguments, &context] { make_features(*arguments, context); }; });
}

void add_merge(CommandOptions& program, CommandContext& context) {
  struct MergeArguments {
    std::string directory;
    std::string file;
  };
  CommandOptions command =
      program.add_command("merge", "One HDF5 file over all shards of a data set, which stay where they are");
  auto arguments = std::make_shared<MergeArguments>();
  command.add_option("DATA", arguments->directory, "Directory of the data set").required();
  command.add_option("-o,--output", arguments->file, "The merged file; DATA/dataset.h5 unless given");
  command.footer("Example:\n  seaglint merge build/points/data");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      const std::filesystem::path directory = find_data_set(arguments->directory);
      std::filesystem::path file = arguments->file;
      if (file.empty()) file = directory / kMergedFile;
      const Merged merged = merge_dataset(directory, file, kVersion, &context.stop);
      if (merged.wrote_manifest) print_out("{}: all shards were there; manifest.json written\n", directory.string());
      print_out("{}: {} samples of {} shards\n", file.string(), merged.samples, merged.shards);
    };
  });
}

namespace {

struct VerifyArguments {
  std::string directory;
  int regenerate = 2;
  int cross_check = 0;
  std::optional<double> cross_check_db;  // bound of the median
};

// Regenerates `count` samples, spread evenly over the data set; returns what is not as stored.
std::vector<std::string> regenerate(const std::string& directory, std::size_t count, const Scenario& scenario,
                                    const CommandContext& context) {
  const DatasetReader reader(directory);
  require_same_inputs(directory, scenario);
  const Pipeline pipeline(scenario);
  const std::vector<std::size_t> samples = evenly_spread(count, reader.size());
  std::vector<std::vector<std::string>> faults(count);
  std::mutex reading;  // HDF5 serves one thread at a time
  Progress progress("regenerating samples", count);
  parallel_for(
      count, thread_count(context.threads),
      [&](std::size_t n) {
        const std::size_t number = samples[n];
        const SampleAddress address = pipeline.plan().address(number);
        StoredSample stored;
        {
          const std::lock_guard lock(reading);
          stored = stored_sample(reader, number);
        }
        const Sample again = pipeline.generate_sample(number).stored;
        for (const std::string& what : differences(stored.sample, again, reproduction_tolerance(stored.origin))) {
          faults[n].push_back(fmt::format("sample {} ({}) regenerated: {}", number,
                                          scenario.targets[static_cast<std::size_t>(address.target)].name, what));
        }
        progress.advance();
      },
      &context.stop);
  std::vector<std::string> all;
  for (const auto& some : faults) all.insert(all.end(), some.begin(), some.end());
  return all;
}

// Reports how far samples differ by the other method of the solver.
void cross_check(const VerifyArguments& arguments, const Audit& audited, const CommandContext& context) {
  const std::size_t count = std::min(static_cast<std::size_t>(arguments.cross_check), audited.samples);
  if (count == 0) return;
  require_same_inputs(arguments.directory, audited.scenario);
  const SampleCrossCheck check =
      cross_check_samples(audited.scenario, evenly_spread(count, audited.samples), context.threads, &context.stop);
  print_out("{}", text_of(check));
  if (!arguments.cross_check_db) return;
  if (check.differences.empty())
    throw InputError(fmt::format("{}: --cross-check-db: none of {} samples has a solver", arguments.directory, count));
  if (check.median_response_db() > *arguments.cross_check_db) {
    throw WorkError(fmt::format("{}: the median relative difference of the response, {:.1f} dB, is above {:g} dB",
                                arguments.directory, check.median_response_db(), *arguments.cross_check_db));
  }
}

void verify(const VerifyArguments& given, const CommandContext& context) {
  VerifyArguments arguments = given;
  arguments.directory = find_data_set(given.directory);
  Audit result = audit(arguments.directory, &context.stop);
  print_out("{}: {} sound shards, {} samples in {} groups\n", arguments.directory, result.shards, result.samples,
            result.groups);
  for (std::size_t t = 0; t < result.per_target.size(); ++t) {
    const TargetSpec& target = result.scenario.targets[t];
    if (target.role == TargetRole::kPart) continue;
    print_out("  {:<12} label {}  {} samples\n", target.name, target.label, result.per_target[t]);
  }
  const std::size_t count = std::min(static_cast<std::size_t>(arguments.regenerate), result.samples);
  if (result.faults.empty() && count > 0) {
    result.faults = regenerate(arguments.directory, count, result.scenario, context);
    if (result.faults.empty())
      print_out("{} regenerated samples match the stored ones, SCR and features included\n", count);
  }
  if (result.faults.empty()) {
    print_out("no fault found\n");
    cross_check(arguments, result, context);
    return;
  }
  constexpr std::size_t kMaxShown = 20;
  for (std::size_t i = 0; i < std::min(kMaxShown, result.faults.size()); ++i)
    print_out("fault: {}\n", result.faults[i]);
  if (result.faults.size() > kMaxShown) print_out("... and {} more\n", result.faults.size() - kMaxShown);
  throw InputError(
      fmt::format("{}: {} faults, the first: {}", arguments.directory, result.faults.size(), result.faults.front()));
}

}  // namespace

void add_verify(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "verify", "Audit a data set: missing, repeated, damaged and mislabelled samples; regenerates some of them");
  auto arguments = std::make_shared<VerifyArguments>();
  command.add_option("DATA", arguments->directory, "Directory of the data set, or its merged file").required();
  command
      .add_option("--regenerate", arguments->regenerate,
                  "Samples to regenerate from their rows, spread over the data set")
      .integer_within(0, 1000000)
      .show_default();
  const CommandOption cross_check =
      command
          .add_option("--cross-check", arguments->cross_check,
                      "Samples, spread evenly over the data set, whose response is also computed by the other method "
                      "of the solver: rays for beams, beams for rays (auto: beams and rays); reports the differences")
          .integer_within(0, 1000000)
          .show_default();
  command
      .add_option("--cross-check-db", arguments->cross_check_db,
                  "Exit code 1 when the median relative difference of these responses is above this, dB; without it "
                  "differences are reported only")
      .number_within(-300.0, 300.0)
      .needs(cross_check);
  add_threads_option(command, context);
  command.footer("Example:\n  seaglint verify build/demo/data --regenerate 5");
  command.callback([arguments, &context] { context.work = [arguments, &context] { verify(*arguments, context); }; });
}

// Regenerates one sample of a data set from its scenario and row and compares it with the stored one.

namespace {

struct RegenerateArguments {
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
  const StoredColumns table = stored_columns(std::span(&sample.record, 1), default_classes());
  for (const auto* columns : {&table.samples, &table.drawn})
    for (const StoredColumn& column : *columns) arrays.push_back(npz_column(column, {}));
  return arrays;
}

void regenerate_sample(const RegenerateArguments& arguments) {
  require_npz(arguments.output);
  const DatasetReader reader(find_data_set(arguments.directory));
  warn(data_set_warnings(reader));
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
  print_out("sample {}: {}, label {}, Hs {:g} m, azimuth {:g} deg, elevation {:g} deg, group {}, at {:g} s\n",
            row.sample, row.target_name, row.label, row.significant_wave_height_m, row.azimuth_deg, row.elevation_deg,
            row.group, row.start_s);
  if (!arguments.output.empty()) {
    write_npz(arguments.output, arrays_of(made.stored, stored_axes(made.received.map)));
    print_out("{}: written\n", arguments.output);
  }

  const double tolerance = reproduction_tolerance(stored.origin);
  std::vector<std::string> found = differences(stored.sample, made.stored, tolerance);
  if (stored_axes(made.received.map) != stored.axes) found.push_back("its axes differ");
  if (!found.empty()) {
    throw InputError(
        fmt::format("{}: sample {} regenerated: {}", arguments.directory, arguments.sample, fmt::join(found, "; ")));
  }
  if (tolerance == 0) {
    print_out("the regenerated sample matches the stored one, bit for bit\n");
  } else {
    print_out(
        "the regenerated sample matches the stored one within {:g} of the map's peak and of each column; the stored "
        "one was generated by seaglint {} on "
        "{}\n",
        tolerance, stored.origin.program_version, stored.origin.processor);
  }
}

}  // namespace

void add_regenerate(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("regenerate", "Regenerate one sample of a data set and compare it with the stored one");
  auto arguments = std::make_shared<RegenerateArguments>();
  command.add_option("DATA", arguments->directory, "Directory of the data set, or its merged file").required();
  command.add_option("--sample", arguments->sample, "Number of the sample").required();
  command.add_option("-o,--output", arguments->output,
                     "Map (also complex), axes, hop code, centres and row as NumPy's .npz");
  command.footer("Example:\n  seaglint regenerate build/points/data --sample 7 -o build/sample_7.npz");
  command.callback([arguments, &context] {
    context.uninterruptible = true;
    context.work = [arguments] { regenerate_sample(*arguments); };
  });
}

// A contact sheet of a data set.

namespace {

struct LookArguments {
  std::string data, output, style = "screen";
  int samples = 12;
  bool whole = false;
};

void look(const LookArguments& arguments, const CommandContext& context) {
  require_figure(arguments.output);
  const DatasetReader reader(find_data_set(arguments.data));
  warn(data_set_warnings(reader));
  const ContactSheet sheet = contact_sheet({.reader = reader,
                                            .samples = static_cast<std::size_t>(arguments.samples),
                                            .whole = arguments.whole,
                                            .style = figure_style(arguments.style),
                                            .stop = &context.stop});
  write_figure(sheet.figure, arguments.output);
  print_out("{}: {} of {} maps of {}\n{}", arguments.output, sheet.figure.maps.size(), reader.size(),
            reader.directory().string(), sheet.text);
}

}  // namespace

void add_look(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "look",
      "Draw some of a data set's stored maps side by side: every class in the same seas and at the same aspects");
  auto arguments = std::make_shared<LookArguments>();
  command.add_option("DATA", arguments->data, "Directory of the data set, or its merged file").required();
  command.add_option("-o,--output", arguments->output, "Picture, .png, .svg or .pdf").required();
  command
      .add_option("--samples", arguments->samples,
                  "Number of maps, in equal parts of the classes, spread over sea states, views and realisations")
      .integer_within(1, 100)
      .show_default();
  command.add_flag("--whole", arguments->whole, "Whole maps; else the window of all targets that are shown");
  add_style_option(command, arguments->style);
  command.footer(
      "Example:\n  seaglint look build/points -o look.png\n"
      "  seaglint look build/demo --samples 24 --style paper-wide -o look.pdf");
  command.callback([arguments, &context] { context.work = [arguments, &context] { look(*arguments, context); }; });
}

namespace {

namespace fs = std::filesystem;

// Endings of files that other programs write or read.
constexpr std::array<std::string_view, 24> kOtherFormats{
    ".mat",  ".h5",    ".hdf5",     ".hdf",     ".csv",   ".tsv",     ".txt", ".npy",
    ".json", ".jsonl", ".xlsx",     ".parquet", ".arrow", ".feather", ".pkl", ".pickle",
    ".pt",   ".pth",   ".tfrecord", ".zarr",    ".nc",    ".zip",     ".gz",  ".tar"};

struct ExportArguments {
  std::string directory;
  std::string output;
};

void export_npz(const DatasetReader& reader, const fs::path& output, const StopFlag& stop) {
  if (output.extension() == ".npz") {
    export_shards(reader, 0, reader.shards(), output, &stop);
    remove_leftovers(output.parent_path(), output.filename().native());
    print_out("{}: {} samples\n", output.string(), reader.size());
    return;
  }
  require_npz_directory(reader, output);
  make_directory(output);
  Progress progress("exporting shards", reader.shards());
  for (std::size_t i = 0; i < reader.shards(); ++i) {
    const fs::path name = fs::path(reader.manifest().shards[i].file).replace_extension(".npz");
    export_shards(reader, i, 1, output / name, &stop);
    progress.advance();
  }
  remove_leftovers(output);
  print_out("{}: {} samples in {} files\n", output.string(), reader.size(), reader.shards());
}

// A name that ends as a file of another format would become a directory of that name.
void require_npz_output(const std::string& output) {
  std::string ending = fs::path(output).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::error_code error;
  if (std::ranges::find(kOtherFormats, ending) == kOtherFormats.end() || fs::is_regular_file(output, error)) return;
  throw InputError(
      fmt::format("{}: {} is no format of this command: it writes one file FILE.npz or a directory of them; "
                  "seaglint.Dataset(DIR).to_webdataset() in Python writes .tar archives",
                  output, ending));
}

}  // namespace

void add_export(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command("export", "A data set as NumPy's .npz");
  auto arguments = std::make_shared<ExportArguments>();
  command.add_option("DATA", arguments->directory, "Directory of the data set, or its merged file").required();
  command
      .add_option("-o,--output", arguments->output,
                  "FILE.npz: everything in one file, for up to some 10,000 maps; else a directory for one file a shard")
      .required();
  command.footer(
      "Example:\n  seaglint export build/points/data -o build/points.npz\n  seaglint export build/paper -o "
      "build/paper_npz");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      require_npz_output(arguments->output);
      const DatasetReader reader(find_data_set(arguments->directory));
      warn(data_set_warnings(reader));
      export_npz(reader, arguments->output, context.stop);
    };
  });
}

}  // namespace seaglint
