// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "classify/dataset/directory/export.h"
#include "classify/dataset/directory/webdataset.h"
#include "sim/core/process/error.h"
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

// Endings of files that other programs write or read.
constexpr std::array<std::string_view, 23> kOtherFormats{
    ".mat",  ".h5",    ".hdf5",     ".hdf",     ".csv",   ".tsv",     ".txt", ".npy",
    ".json", ".jsonl", ".xlsx",     ".parquet", ".arrow", ".feather", ".pkl", ".pickle",
    ".pt",   ".pth",   ".tfrecord", ".zarr",    ".nc",    ".zip",     ".gz"};

constexpr double kMegabyte = 1e6;  // bytes
constexpr double kDefaultTar_mb = 500;

struct ExportArguments {
  std::string directory;
  std::string output;
  std::string format = "npz";
  std::optional<double> max_tar_mb;
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
void require_format(const ExportArguments& arguments) {
  std::string ending = fs::path(arguments.output).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool is_other = std::ranges::find(kOtherFormats, ending) != kOtherFormats.end();
  const bool is_archive = ending == ".tar" || (ending == ".npz" && arguments.format == "webdataset");
  if (arguments.format == "webdataset" && is_archive)
    throw InputError(fmt::format("{}: --as webdataset writes a directory", arguments.output));
  std::error_code error;
  if ((!is_other && !is_archive) || fs::is_regular_file(arguments.output, error)) return;  // that is no directory
  throw InputError(
      fmt::format("{}: {} is no format of --as: npz writes one file FILE.npz or a directory of them, "
                  "webdataset a directory of .tar archives",
                  arguments.output, ending));
}

void export_dataset(const ExportArguments& arguments, const StopFlag& stop) {
  const bool webdataset = arguments.format == "webdataset";
  if (!webdataset && arguments.max_tar_mb) throw InputError("--max-tar-mb: only with --as webdataset");
  const fs::path output = arguments.output;
  require_format(arguments);
  const DatasetReader reader(find_data_set(arguments.directory));
  warn(data_set_warnings(reader));
  if (!webdataset) return export_npz(reader, output, stop);
  const auto max_bytes = static_cast<std::uint64_t>(arguments.max_tar_mb.value_or(kDefaultTar_mb) * kMegabyte);
  const std::size_t archives = export_webdataset(reader, output, max_bytes, &stop);
  print_out("{}: {} samples in {} archives\n", output.string(), reader.size(), archives);
}

}  // namespace

void add_export(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command("export", "A data set as NumPy's .npz or in the WebDataset layout");
  auto arguments = std::make_shared<ExportArguments>();
  command.add_option("directory", arguments->directory, "Directory of the data set").required();
  command
      .add_option("-o,--output", arguments->output,
                  "FILE.npz: everything in one file, for up to some 10,000 maps; else a directory for one file a shard")
      .required();
  command
      .add_option("--as", arguments->format,
                  "npz: NumPy's archives; webdataset: tar archives with map, row and label of each sample in turn")
      .one_of({"npz", "webdataset"})
      .show_default();
  command
      .add_option("--max-tar-mb", arguments->max_tar_mb,
                  fmt::format("Largest tar archive, MB (10^6 bytes), {:g} unless given", kDefaultTar_mb))
      .number_within(0.01, 1e6);
  command.footer(
      "Example:\n  seaglint export build/points/data -o build/points.npz\n  seaglint export build/paper -o "
      "build/paper_npz\n  seaglint export build/paper -o build/paper_tar --as webdataset --max-tar-mb 1000");
  command.callback(
      [arguments, &context] { context.work = [arguments, &context] { export_dataset(*arguments, context.stop); }; });
}

}  // namespace seaglint
