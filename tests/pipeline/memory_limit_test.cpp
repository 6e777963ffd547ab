// SPDX-License-Identifier: BSD-3-Clause
// Without memory a command ends with exit code 1 and one line; it neither crashes nor waits for ever.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pipeline/program.h"
#include "tests/sanitized.h"

namespace seaglint {
namespace {

TEST(MemoryLimit, OfTheAddressSpaceEndsARunWithOneLine) {
  if (kSanitized) GTEST_SKIP() << "sanitizers take more address space";
  int refused = 0;
  // MB; the program takes some 90, its network's library 560 more, a whole run 850.
  for (const int limit : {150, 300, 450, 600, 672, 716, 740, 850, 950}) {
    const TemporaryFolder folder;
    const ProgramResult result = run_words(
        {"/bin/bash", "-c", "ulimit -v " + std::to_string(limit * 1024) + "; exec timeout -k 5 60 \"$@\"", "limited",
         kProgram, "run", "scenarios/points.yaml", "-o", folder.path() / "run", "--set", "learning.epochs=2"});
    EXPECT_TRUE(result.code == 0 || result.code == 1)
        << limit << " MB: exit code " << result.code << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), result.code) << limit << " MB: " << result.err;
    refused += result.code;
  }
  EXPECT_GT(refused, 0);
}

// Constructors of libraries' static objects need memory before the program begins.
TEST(MemoryLimit, BelowWhatLibrariesNeedToBeginEndsWithOneLine) {
  if (kSanitized) GTEST_SKIP() << "sanitizers take more address space";
  int refused = 0;
  for (int limit = 60; limit <= 110; limit += 2) {
    const ProgramResult result =
        run_words({"/bin/bash", "-c", "ulimit -v " + std::to_string(limit * 1024) + "; exec \"$@\"", "limited",
                   kProgram, "--version"});
    // 127: the system cannot load the libraries.
    EXPECT_THAT(result.code, testing::AnyOf(0, 1, 127)) << limit << " MB: " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), result.code == 0 ? 0 : 1) << result.err;
    if (result.code == 1) {
      EXPECT_EQ(result.err, "seaglint: out of memory\n") << limit << " MB";
    }
    refused += result.code != 0;
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace seaglint
