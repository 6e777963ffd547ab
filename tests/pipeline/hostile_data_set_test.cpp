// SPDX-License-Identifier: BSD-3-Clause
// Data sets made to deceive: no other file is read, memory is bounded, and the shard is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/pipeline/program.h"
#include "tests/sanitized.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class HostileDataSet : public testing::Test {
 protected:
  // The program with at most 1.5 GB of address space, three times what it takes to start (without sanitizers).
  static ProgramResult bounded(const std::vector<std::string>& arguments) {
    const std::string limit = kSanitized ? "" : "ulimit -v 1500000; ";
    std::vector<std::string> words{"/bin/bash", "-c", limit + "exec \"$@\"", "bounded", kProgram};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_words(words);
  }

  TemporaryFolder folder_;
  const fs::path base_ = folder_.path() / "base", secret_ = folder_.path() / "secret";
};

TEST_F(HostileDataSet, IsRefusedWithTheShardsName) {
  if (run_words({kPython, "-c", "import h5py, numpy"}).code != 0) GTEST_SKIP() << "no h5py";
  ASSERT_EQ(run_program({"generate", "scenarios/points.yaml", "--set", "dataset.maps_per_case=4", "--set",
                         "dataset.realisations_per_case=2", "--set", "dataset.maps_per_shard=4", "-o", base_})
                .code,
            0);
  for (int i = 0; i < 100000; ++i) std::ofstream(secret_, std::ios::app) << "SECRET OF ANOTHER FILE ";
  const fs::path made = folder_.path() / "made";
  const std::string hostile_shards = SEAGLINT_SOURCE_DIR "/tests/pipeline/hostile_shards.py";
  const ProgramResult script = run_words({kPython, hostile_shards, base_, made, secret_});
  ASSERT_EQ(script.code, 0) << script.err;
  std::istringstream kinds(script.out);
  int count = 0;
  for (std::string kind; std::getline(kinds, kind); ++count) {
    const fs::path exported = folder_.path() / (kind + ".npz");
    for (const std::vector<std::string>& words : {std::vector<std::string>{"verify", made / kind, "--regenerate", "0"},
                                                  {"merge", made / kind},
                                                  {"export", made / kind, "-o", exported}}) {
      const ProgramResult result = bounded(words);
      EXPECT_EQ(result.code, 2) << kind << ", " << words[0] << ": " << result.err;
      EXPECT_THAT(result.err, HasSubstr("shard_00000.h5: ")) << kind << ", " << words[0];
      EXPECT_THAT(result.err, Not(HasSubstr("SECRET"))) << kind;
    }
    EXPECT_FALSE(fs::exists(exported)) << kind;
  }
  EXPECT_EQ(count, 13);
}

}  // namespace
}  // namespace seaglint
