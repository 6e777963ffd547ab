// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cli/command_line.h"

#include <fmt/format.h>
#include <signal.h>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <set>
#include <string>
#include <system_error>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/directory/export.h"
#include "classify/model/study.h"
#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"

namespace seaglint {

namespace {

// Signal handlers can access static storage only.
StopFlag* stop_flag = nullptr;

void request_stop(int) { *stop_flag = true; }

// A write beyond the file size limit then fails with an error, as on a full disk, instead of ending the process.
void survive_file_size_limit() { signal(SIGXFSZ, SIG_IGN); }

// The first Ctrl-C sets the stop flag and removes the handler, so that the second one ends the process.
void handle_signals(CommandContext& context) {
  stop_flag = &context.stop;
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

// In the order of the data flow.
void add_commands(CommandOptions& program, CommandContext& context) {
  add_check(program, context);
  add_keys(program, context);
  add_init(program, context);
  add_paths(program, context);
  add_mesh(program, context);
  add_sea(program, context);
  add_motion(program, context);
  add_rcs(program, context);
  add_compare(program, context);
  add_echo(program, context);
  add_map(program, context);
  add_generate(program, context);
  add_merge(program, context);
  add_verify(program, context);
  add_regenerate(program, context);
  add_look(program, context);
  add_features(program, context);
  add_export(program, context);
  add_train(program, context);
  add_evaluate(program, context);
  add_classify(program, context);
  add_run(program, context);
  add_benchmark(program, context);
  add_report(program, context);
}

int fail(int code, const std::string& message) {
  std::fflush(stdout);
  print_error(fmt::format("seaglint: {}\n", on_one_line(message)));
  return code;
}

// 0, or 1 if a write to standard output failed.
int end_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
  return fail(1, fmt::format("standard output: cannot write: {}", std::strerror(errno)));
}

int run(CommandContext& context) {
  try {
    context.work();
    return end_output();
  } catch (const InputError& error) {
    for (const std::string& message : messages_of(error)) fail(2, message);
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(1, fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::bad_alloc&) {
    return fail(1, "out of memory");
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
}

int parse_and_run(int argc, char** argv) {
  CommandContext context;
  ProgramOptions program(
      "seaglint",
      "Ships and corner-reflector decoys at sea as a frequency-agile radar sees them: from a scenario to classified "
      "maps");
  program.set_version(fmt::format("seaglint {}", kVersion));
  program.require_command();
  program.footer("Example:\n  seaglint check scenarios/quick.yaml\n\nEvery command has --help with an example.");
  add_commands(program, context);
  const ParsedCommandLine parsed = program.parse(argc, argv);
  if (parsed.error) return fail(2, *parsed.error);
  if (parsed.information) {
    print_text(*parsed.information);
    return end_output();
  }
  survive_file_size_limit();
  if (!context.uninterruptible) handle_signals(context);
  return run(context);
}

}  // namespace

int run_command_line(int argc, char** argv) {
  reserve_standard_streams();
  try {
    return parse_and_run(argc, argv);
  } catch (const std::bad_alloc&) {
    return fail(1, "out of memory");
  }
}

std::filesystem::path find_data_set(const std::filesystem::path& directory) {
  if (directory.extension() == ".h5" && is_regular_file(directory)) return data_set_of_merged(directory);
  const bool below = !exists(directory / kManifestFile) && exists(directory / "data" / kScenarioFile);
  return below ? directory / "data" : directory;
}

std::filesystem::path find_model(const std::filesystem::path& directory) {
  const bool below = !exists(directory / kModelFile) && exists(directory / "model" / kModelFile);
  return below ? directory / "model" : directory;
}

void add_threads_option(CommandOptions& command, CommandContext& context) {
  command.add_option("--threads", context.threads, "Number of threads; 0 = all processors").integer_within(0, 1024);
}

void add_scenario_arguments(CommandOptions& command, ScenarioArguments& arguments) {
  command.add_option("SCENARIO", arguments.file, "Scenario file (YAML)").required();
  command.add_option("--set", arguments.set, "Replace a value of the scenario, e.g. --set radar.pulses=64 (repeatable)")
      .repeatable("KEY.PATH=VALUE");
}

std::vector<Override> read_overrides(const std::vector<std::string>& set) {
  std::vector<Override> overrides;
  for (const std::string& text : set) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw InputError(fmt::format("--set {}: must be key.path=value", text));
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

Scenario ScenarioArguments::read() const { return read_scenario(find_input(file, "scenarios"), read_overrides(set)); }

void require_outputs(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs) {
  const auto place = [](const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path found = std::filesystem::weakly_canonical(file, error);
    return error ? file : found;
  };
  std::set<std::filesystem::path> read, written;
  for (const std::filesystem::path& file : inputs) read.insert(place(file));
  for (const std::string& file : outputs) {
    if (file.empty()) continue;
    if (read.contains(place(file))) throw InputError(fmt::format("{}: is read here, and would be written over", file));
    if (!written.insert(place(file)).second) throw InputError(fmt::format("{}: would be written twice", file));
    require_writable(file);
  }
}

std::vector<std::filesystem::path> files_of(const Scenario& scenario) {
  std::vector<std::filesystem::path> files;
  for (const InputFile& named : input_files(scenario)) files.push_back(named.path);
  return files;
}

}  // namespace seaglint
