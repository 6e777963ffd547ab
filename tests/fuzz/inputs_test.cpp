// SPDX-License-Identifier: BSD-3-Clause
// Every reader of users' files over the inputs that fuzzing found: each is read or refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "sim/core/process/file.h"
#include "tests/fuzz/readers.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(SEAGLINT_SOURCE_DIR) / "tests/fuzz";

struct NamedReader {
  std::string name;
  void (*read)(const std::string& bytes);
};

const std::vector<NamedReader> kReaders = {{"numbers", fuzz_numbers},
                                           {"spectrum", fuzz_spectrum},
                                           {"hop_code", fuzz_hop_code},
                                           {"scatter", fuzz_scatter},
                                           {"series", fuzz_series},
                                           {"sections", fuzz_sections},
                                           {"veres", fuzz_veres},
                                           {"wamit", fuzz_wamit},
                                           {"rcs_cut", fuzz_rcs_cut},
                                           {"cst", fuzz_cst},
                                           {"own_table", fuzz_own_table},
                                           {"named_columns", fuzz_named_columns},
                                           {"cst_curves", fuzz_cst_curves},
                                           {"ffs", fuzz_ffs},
                                           {"ffe", fuzz_ffe},
                                           {"hfss", fuzz_hfss},
                                           {"pyaedt", fuzz_pyaedt},
                                           {"pyaedt_json", fuzz_pyaedt_json},
                                           {"yaml", fuzz_yaml},
                                           {"override", fuzz_override},
                                           {"material", fuzz_material},
                                           {"scenario", fuzz_scenario},
                                           {"obj", fuzz_obj},
                                           {"stl", fuzz_stl},
                                           {"ply", fuzz_ply},
                                           {"gltf", fuzz_gltf},
                                           {"glb", fuzz_glb},
                                           {"nastran", fuzz_nastran},
                                           {"unv", fuzz_unv},
                                           {"gmsh", fuzz_gmsh},
                                           {"manifest", fuzz_manifest},
                                           {"shard", fuzz_shard},
                                           {"npz", fuzz_npz},
                                           {"inputs", fuzz_inputs},
                                           {"croissant", fuzz_croissant},
                                           {"embeddings", fuzz_embeddings},
                                           {"trees", fuzz_trees},
                                           {"model_card", fuzz_model_card},
                                           {"network", fuzz_network},
                                           {"echo", fuzz_echo}};

// The inputs of all readers, each of which may be given to any.
std::vector<fs::path> inputs() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder / "inputs")) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(FuzzInputs, AreReadOrRefusedByEveryReader) {
  const std::vector<fs::path> files = inputs();
  EXPECT_GT(files.size(), 10u);
  for (const fs::path& file : files) {
    const std::string bytes = read_file(file);
    for (const NamedReader& reader : kReaders) {
      SCOPED_TRACE(reader.name + ": " + file.string());
      EXPECT_NO_THROW(reader.read(bytes));
    }
  }
}

TEST(FuzzInputs, AreInAFolderPerTargetAndEveryReaderIsATarget) {
  std::set<std::string> targets, readers, folders;
  const std::string table = read_file(kFolder / "targets.txt");
  for (std::size_t begin = 0; begin < table.size(); begin = table.find('\n', begin) + 1) {
    if (table[begin] != '#') targets.insert(table.substr(begin, table.find(' ', begin) - begin));
  }
  for (const NamedReader& reader : kReaders) readers.insert(reader.name);
  for (const auto& entry : fs::directory_iterator(kFolder / "inputs")) folders.insert(entry.path().filename());
  EXPECT_EQ(targets, readers);
  EXPECT_THAT(readers, testing::IsSupersetOf(folders));
}

}  // namespace
}  // namespace seaglint
