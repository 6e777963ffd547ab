// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include <optional>

#include "classify/model/study.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "tools/cli/command_line.h"
#include "tools/evaluate/classify.h"
#include "tools/evaluate/evaluate.h"
#include "tools/pipeline/train.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

struct TrainArguments {
  std::vector<std::string> data;
  std::string by;
  std::vector<std::string> hold_out;
  std::string model;
  std::vector<std::string> set;
};

// Only keys of learning and split may be overridden: the maps exist already.
std::vector<Override> learning_overrides(const std::vector<std::string>& set) {
  std::vector<Override> overrides = read_overrides(set);
  for (const Override& entry : overrides) {
    if (!entry.key_path.starts_with("learning.") && entry.key_path != "dataset.split") {
      throw InputError(
          fmt::format("--set {}: train takes learning.* and dataset.split only; the data set is made", entry.key_path));
    }
  }
  return overrides;
}

DivisionOptions division_options(const TrainArguments& arguments) {
  DivisionOptions options;
  if (!arguments.by.empty()) options.by = arguments.by;
  for (const std::string& text : arguments.hold_out) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(fmt::format("--hold-out {}: must be COLUMN=VALUE or COLUMN=LOW:HIGH", text));
    const std::string column = text.substr(0, equals);
    auto held = std::ranges::find(options.hold_out, column, &HoldOutSpec::column);
    if (held == options.hold_out.end()) held = options.hold_out.insert(held, {column, {}});
    held->values.push_back(text.substr(equals + 1));
  }
  return options;
}

}  // namespace

void add_train(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("train", "Train network and trees on a data set and evaluate them on unseen maps and seas");
  auto arguments = std::make_shared<TrainArguments>();
  command
      .add_option("DATA", arguments->data,
                  "Data sets made by `seaglint generate` or `seaglint run`; learning, split and seed are those of the "
                  "first one's scenario")
      .required()
      .repeatable("DATA");
  command.add_option("-o,--output", arguments->model, "Directory of the model").required();
  command.add_option("--set", arguments->set, "Replace a value of the data set's scenario (repeatable)")
      .repeatable("learning.KEY=VALUE");
  command.add_option("--by", arguments->by,
                     "Column whose values are on one side of the split each, in place of learning.split.by: any column "
                     "of the samples, sea, or data_set (numbered from 0)");
  command
      .add_option("--hold-out", arguments->hold_out,
                  "Values that are tested only and never trained on, for the classes that have them; LOW:HIGH for an "
                  "interval (repeatable: any of one column's values, all columns); in place of "
                  "learning.split.hold_out")
      .repeatable("COLUMN=VALUE");
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint train build/points -o build/points-model --set learning.epochs=40\n"
      "  seaglint train build/a build/b -o build/model --hold-out data_set=1");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      TrainRequest request{.data_sets = {},
                           .model_directory = arguments->model,
                           .overrides = learning_overrides(arguments->set),
                           .division = division_options(*arguments),
                           .threads = context.threads,
                           .stop = &context.stop};
      for (const std::string& data : arguments->data) request.data_sets.push_back(find_data_set(data));
      const TrainedModel model = train_model(request);
      warn(model.warnings);
      print_out("{}\n{}: network, trees and {}\nNext: `seaglint evaluate {} DATA_SET` on another data set\n",
                accuracy_table(model.study), arguments->model, kMetricsFile, arguments->model);
    };
  });
}

namespace {

struct EvaluateArguments {
  std::string model;
  std::vector<std::string> data;
  std::vector<std::string> by;
  std::string output;
  bool trained_rows = false;
  bool unseen_seas = false;
};

}  // namespace

void add_evaluate(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "evaluate", "Apply a trained model to data sets: accuracy by class, sea, aspect, SCR or any column; calibration");
  auto arguments = std::make_shared<EvaluateArguments>();
  command.add_option("MODEL", arguments->model, "Directory of the model (`seaglint train`, or that of a run)")
      .required();
  command.add_option("DATA", arguments->data, "Data sets of the same map grid and settings of the features")
      .required()
      .repeatable("DATA");
  command
      .add_option(
          "--by", arguments->by,
          "Score by this column of the samples, too; drawn and measured ones in eight bins of equal numbers of maps "
          "(repeatable)")
      .repeatable("COLUMN");
  command.add_flag("--trained-rows", arguments->trained_rows,
                   "Evaluate also the maps that the model was fitted to: no measure of its accuracy on others");
  command.add_flag("--unseen-seas", arguments->unseen_seas,
                   "Evaluate only maps in seas (seed and key) of which the model was fitted to no map");
  command.add_option("-o,--output", arguments->output,
                     "Directory for evaluation.json and probabilities.csv, a line per map");
  command.footer(
      "Example:\n  seaglint evaluate build/points-model build/points --by peak_period_s -o build/evaluation");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      EvaluateRequest request{
          find_model(arguments->model), {}, arguments->by, arguments->output, arguments->trained_rows,
          arguments->unseen_seas};
      for (const std::string& data : arguments->data) request.data_sets.push_back(find_data_set(data));
      const EvaluatedModel evaluated = evaluate_model(request, &context.stop);
      warn(evaluated.warnings);
      print_text(evaluated.text);
    };
  });
}

namespace {

struct ClassifyArguments {
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
  auto arguments = std::make_shared<ClassifyArguments>();
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
      if (arguments->sample != ClassifyArguments::kAllSamples) sample = static_cast<std::size_t>(arguments->sample);
      print_text(classify_samples(
          {find_model(arguments->model), find_data_set(arguments->data), sample, arguments->output}, &context.stop));
    };
  });
}

}  // namespace seaglint
