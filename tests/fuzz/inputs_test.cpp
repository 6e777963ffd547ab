// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "sim/core/process/file.h"
#include "tests/fuzz/readers.h"
#include "tests/pipeline/program.h"
#include "tests/refusal.h"
#include "tests/sanitized.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

// Every reader of users' files over the inputs that fuzzing found: each is read or refused.

const fs::path kFolder = fs::path(SEAGLINT_SOURCE_DIR) / "tests/fuzz";

struct NamedReader {
  std::string name;
  void (*read)(const std::string& bytes);
};

#define READER(name) \
  { #name, fuzz_##name }
const std::vector<NamedReader> kReaders = {
    READER(numbers),    READER(spectrum), READER(hop_code), READER(scatter),  READER(series),     READER(sections),
    READER(veres),      READER(wamit),    READER(rcs_cut),  READER(cst),      READER(own_table),  READER(named_columns),
    READER(cst_curves), READER(ffs),      READER(ffe),      READER(hfss),     READER(pyaedt),     READER(pyaedt_json),
    READER(yaml),       READER(override), READER(material), READER(scenario), READER(obj),        READER(stl),
    READER(ply),        READER(gltf),     READER(glb),      READER(nastran),  READER(unv),        READER(gmsh),
    READER(manifest),   READER(shard),    READER(npz),      READER(inputs),   READER(embeddings), READER(trees),
    READER(model_card), READER(network),  READER(echo)};

// The inputs of all readers, each of which may be given to any.
std::vector<fs::path> inputs() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder / "inputs"))
    if (entry.is_regular_file()) files.push_back(entry.path());
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
  for (std::size_t begin = 0; begin < table.size(); begin = table.find('\n', begin) + 1)
    if (table[begin] != '#') targets.insert(table.substr(begin, table.find(' ', begin) - begin));
  for (const NamedReader& reader : kReaders) readers.insert(reader.name);
  for (const auto& entry : fs::directory_iterator(kFolder / "inputs")) folders.insert(entry.path().filename());
  EXPECT_EQ(targets, readers);
  EXPECT_THAT(readers, testing::IsSupersetOf(folders));
}

// Small files that ask for much memory or time: the program needs at most 200 MB and 30 bytes per byte of the file more
// than for a file of a few bytes, and 1 s and 2 s per MB.

constexpr double kMB = 1e6;

struct Usage {
  ProgramResult result;
  double peak_bytes = 0;  // resident
  double cpu_s = 0;
};

Usage usage_of(std::vector<std::string> words) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "out", err = folder.path() / "err";
  const pid_t process = start_words(std::move(words), out, err);
  Usage usage;
  if (process < 0) return usage;
  int status = 0;
  rusage used{};
  ::wait4(process, &status, 0, &used);
  usage.result = {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(out), read_file(err)};
  usage.peak_bytes = static_cast<double>(used.ru_maxrss) * 1024;
  usage.cpu_s = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  return usage;
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// Gives the bytes as file `name` to a command, and a small file of the same name to compare.
class Bombs : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "sanitizers take more memory and time";
  }

  ProgramResult run(std::vector<std::string> command, const char* name, const std::string& bytes) {
    const std::string file = folder_.path() / name;
    command.insert(command.begin(), kProgram);
    command.push_back(command.back() == "verify" ? folder_.path().string() : file);
    write_file(file, "x");
    const Usage least = usage_of(command);
    write_file(file, bytes);
    const Usage usage = usage_of(command);
    const double size = static_cast<double>(bytes.size());
    EXPECT_LT(usage.peak_bytes - least.peak_bytes, 200 * kMB + 30 * size) << name << " of " << size << " bytes";
    // Three times the promise: processors differ, and tests run beside each other.
    EXPECT_LT(usage.cpu_s - least.cpu_s, 3 * (1 + 2 * size / kMB)) << name << " of " << size << " bytes";
    return usage.result;
  }

  TemporaryFolder folder_;
};

TEST_F(Bombs, OfYamlTakeMemoryAndTimeInProportion) {
  const auto check = [&](const std::string& text) { return run({"check"}, "a.yaml", text); };
  EXPECT_HAS(check(fmt::format("{{{}}}", repeated("a,", 1'900'000))).err, "more than 500000 of the characters");
  EXPECT_HAS(check(fmt::format("{{{}}}", repeated("a,", 490'000))).err, "more than 300000 values");
  EXPECT_HAS(check(repeated("\"x\" ", 240'000)).err, "a.yaml:1:5: a second document");
  EXPECT_HAS(check(repeated("? ", 1'900'000)).err, "a.yaml:1:");
  EXPECT_HAS(check(std::string(5'000'000, '\n')).err, "has 5000000 bytes, more than the limit of 4000000");
}

TEST_F(Bombs, OfGltfTakeMemoryAndTimeInProportion) {
  const auto info = [&](const std::string& lists) {
    return run({"mesh", "info"}, "a.gltf", fmt::format(R"({{"asset":{{"version":"2.0"}},{}}})", lists)).err;
  };
  EXPECT_HAS(info(fmt::format("\"nodes\":[{}{{}}]", repeated("{},", 1'000'000))), "are no mesh");
  EXPECT_HAS(info(fmt::format("\"nodes\":[{}{{}}]", repeated("{},", 90'000))), "a.gltf: ");
  EXPECT_HAS(info(fmt::format("\"extras\":[{}{{}}]", repeated("{},", 1'000'000))), "a.gltf: ");
  // Ten thousand triangles in five thousand places.
  const std::string bytes = repeated("AAAA", 10'000 * 36 / 3);
  const std::string buffers = fmt::format(
      R"("buffers":[{{"byteLength":360000,"uri":"data:application/octet-stream;base64,{}"}}],"bufferViews":[{{"buffer":0,)"
      R"("byteLength":360000}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":30000,"type":"VEC3"}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],)",
      bytes);
  EXPECT_HAS(info(fmt::format(R"({}"nodes":[{}{{"mesh":0}}])", buffers, repeated(R"({"mesh":0},)", 4999))),
             "place more than 745000 triangles");
}

TEST_F(Bombs, OfPlyHeadersTakeMemoryAndTimeInProportion) {
  std::string header = "ply\nformat ascii 1.0\n";
  for (int i = 0; i < 100'000; ++i) header += fmt::format("element e{} 0\n", i);
  EXPECT_HAS(run({"mesh", "info"}, "a.ply", header + "end_header").err, "contains no triangles");
}

TEST_F(Bombs, OfNamesOfGmshTakeMemoryAndTimeInProportion) {
  std::string text = fmt::format("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"{:x>1000000}\"\n", "");
  text += "$EndPhysicalNames\n$Entities\n0 0 100000 0\n";
  for (int i = 1; i <= 100'000; ++i) text += fmt::format("{} 0 0 0 1 1 1 1 1 0\n", i);
  EXPECT_HAS(run({"mesh", "info"}, "a.msh", text + "$EndEntities\n").err, "a name of more than 1000 bytes");
}

TEST_F(Bombs, OfManifestsTakeMemoryAndTimeInProportion) {
  const auto verify = [&](const std::string& json) { return run({"verify"}, "manifest.json", json).err; };
  EXPECT_HAS(verify(fmt::format("{{\"format\": {:[>200000}{:]>200000}}}", "", "")), "nested more than 64 levels");
  std::string keys = "{\"k\":0";
  for (int i = 0; i < 200'000; ++i) keys += fmt::format(",\"k{}\":0", i);
  EXPECT_HAS(verify(keys + "}"), "more than 1000 keys");
  const std::string unknown = verify(fmt::format("{{\"format\": \"{:x>2000000}\"}}", ""));
  EXPECT_HAS(unknown, "manifest.json");
  EXPECT_LT(unknown.size(), 1000u);
}

}  // namespace
}  // namespace seaglint
