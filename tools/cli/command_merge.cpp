// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>

#include "classify/dataset/directory/merged.h"
#include "seaglint_version.h"
#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"

namespace seaglint {

void add_merge(CommandOptions& program, CommandContext& context) {
  struct Arguments {
    std::string directory;
    std::string file;
  };
  CommandOptions command =
      program.add_command("merge", "One HDF5 file over all shards of a data set, which stay where they are");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("directory", arguments->directory, "Directory of the data set").required();
  command.add_option("-o,--output", arguments->file, "The merged file; DIRECTORY/dataset.h5 unless given");
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

}  // namespace seaglint
