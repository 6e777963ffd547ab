// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/out_of_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "sim/core/process/error.h"
#include "tests/sanitized.h"

namespace seaglint {
namespace {

TEST(AddressSpace, ThatIsMissingIsAnError) {
  EXPECT_NO_THROW(require_address_space(std::size_t{64} << 20, "the work"));
  if (kSanitized) GTEST_SKIP() << "sanitizers map memory of their own";
  rlimit before{};
  ::getrlimit(RLIMIT_AS, &before);
  const rlimit little{std::size_t{1} << 20, before.rlim_max};
  ::setrlimit(RLIMIT_AS, &little);
  std::string message;
  try {
    require_address_space(std::size_t{64} << 20, "the work");
  } catch (const WorkError& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_AS, &before);
  EXPECT_THAT(message, testing::StartsWith("out of memory: the work needs 64 MB more"));
}

}  // namespace
}  // namespace seaglint
