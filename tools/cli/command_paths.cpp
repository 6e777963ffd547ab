// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "sim/core/process/data_folder.h"
#include "sim/core/process/standard_output.h"
#include "tools/cli/command.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

// "quick.yaml, points.yaml"; by name.
std::string files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".yaml" || extension == ".glb") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

void print_paths() {
  const fs::path data = data_folder();
  print_out(
      "A relative name of a file is looked for in\n  1. the folder of the scenario that names it\n"
      "  2. the working directory     {}\n  3. the data of the program   {}\n",
      fs::current_path().string(), data.empty() ? "none found: set SEAGLINT_DATA" : data.string());
  if (data.empty()) return;
  print_out("scenarios         {}\nassets            {}\nassets/materials  {}\n", files_in(data / "scenarios"),
            files_in(data / "assets"), files_in(data / "assets/materials"));
}

}  // namespace

void add_paths(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command("paths", "Where files are looked for, and the data of the program");
  command.footer(
      "Scenarios of the program are found by their name alone: seaglint run quick.yaml -o build/quick\n"
      "Example:\n  seaglint paths");
  command.callback([&context] { context.work = print_paths; });
}

}  // namespace seaglint
