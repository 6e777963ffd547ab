// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>

#include "classify/dataset/directory/export.h"
#include "sim/core/process/file.h"
#include "sim/core/process/progress.h"
#include "sim/core/process/standard_output.h"
#include "sim/core/process/temporary_file.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

namespace fs = std::filesystem;

void export_dataset(const std::string& directory, const fs::path& output, const StopFlag& stop) {
  const DatasetReader reader(find_data_set(directory));
  warn(data_set_warnings(reader));
  if (output.extension() == ".npz") {
    export_shards(reader, 0, reader.shards(), output, &stop);
    remove_leftovers(output.parent_path(), output.filename().native());
    print_out("{}: {} samples\n", output.string(), reader.size());
    return;
  }
  require_export_directory(reader, output);
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

}  // namespace

void add_export(CommandOptions& program, CommandContext& context) {
  struct Arguments {
    std::string directory;
    std::string output;
  };
  CommandOptions command =
      program.add_command("export", "A data set as NumPy's .npz, in one file or one for each shard");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("directory", arguments->directory, "Directory of the data set").required();
  command
      .add_option("-o,--output", arguments->output,
                  "FILE.npz: everything in one file, for up to some 10,000 maps; else a directory for one file a shard")
      .required();
  command.footer(
      "Example:\n  seaglint export build/points/data -o build/points.npz\n  seaglint export build/paper -o "
      "build/paper_npz");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] { export_dataset(arguments->directory, arguments->output, context.stop); };
  });
}

}  // namespace seaglint
