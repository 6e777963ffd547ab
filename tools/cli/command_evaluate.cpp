// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/evaluate/evaluate.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

struct Arguments {
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
  auto arguments = std::make_shared<Arguments>();
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

}  // namespace seaglint
