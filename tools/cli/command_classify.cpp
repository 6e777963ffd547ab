// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <optional>

#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/evaluate/classify.h"

namespace seaglint {

namespace {

struct Arguments {
  std::string model;
  std::string data;
  int sample = kAllSamples;
  std::string output;

  static constexpr int kAllSamples = -1;
};

}  // namespace

void add_classify(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "classify",
      "Classify maps of a data set, or an echo over time, by a trained model; compare their features with the training "
      "range");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("MODEL", arguments->model, "Directory of the model (`seaglint train`, or that of a run)")
      .required();
  command
      .add_option("DATA", arguments->data,
                  "Data set of the same map grid and settings of the features, or an interval as I/Q samples (.npz, "
                  "`seaglint echo`)")
      .required();
  command.add_option("--sample", arguments->sample, "Number of one sample of a data set; all samples unless given")
      .integer_within(0, 1000000000);
  command.add_option("-o,--output", arguments->output,
                     "File, .csv: probabilities, features, and features outside the training range, a line per sample");
  command.footer(
      "Example:\n  seaglint classify build/points-model build/points --sample 3\n"
      "  seaglint classify build/points-model echo.npz");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      std::optional<std::size_t> sample;
      if (arguments->sample != Arguments::kAllSamples) sample = static_cast<std::size_t>(arguments->sample);
      print_text(classify_samples(
          {find_model(arguments->model), find_data_set(arguments->data), sample, arguments->output}, &context.stop));
    };
  });
}

}  // namespace seaglint
