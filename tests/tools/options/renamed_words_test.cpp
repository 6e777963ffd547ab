// SPDX-License-Identifier: BSD-3-Clause
// Every option, option value and command of earlier versions is refused with its new name.
#include "tools/options/renamed_words.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tools/cli/command_line.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Refusal {
  int code = -1;
  std::string message;
};

Refusal run(std::vector<std::string> words) {
  words.insert(words.begin(), "seaglint");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  testing::internal::CaptureStderr();
  const int code = run_command_line(static_cast<int>(argv.size()), argv.data());
  return {code, testing::internal::GetCapturedStderr()};
}

std::vector<std::string> words_of(std::string_view command) {
  std::istringstream text{std::string(command)};
  return {std::istream_iterator<std::string>(text), {}};
}

TEST(RenamedWords, AreRefusedByTheirNewNames) {
  for (const RenamedWord& old : renamed_words()) {
    const bool is_option = old.word.starts_with('-');
    std::vector<std::string> words = words_of(old.command);
    words.emplace_back(old.word);
    words.emplace_back("1");
    const Refusal refused = run(words);
    EXPECT_EQ(refused.code, 2) << old.word;
    EXPECT_THAT(refused.message, HasSubstr(fmt::format("unknown {} '{}': renamed to {} (see seaglint",
                                                       is_option ? "option" : "command", old.word, old.now)));
    words[words.size() - 2] = std::string(old.now);
    EXPECT_THAT(run(words).message, Not(testing::AnyOf(HasSubstr("unknown"), HasSubstr("renamed")))) << old.now;
  }
}

TEST(RenamedWords, AreRefusedWithTheirValueBehindAnEqualsSign) {
  const Refusal refused = run({"rcs", "--wave-height-m=2"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.message,
            "seaglint: unknown option '--wave-height-m': renamed to --significant-wave-height-m (see seaglint rcs "
            "--help)\n");
}

// A word is renamed only for its own command.
TEST(RenamedWords, AreThoseOfTheirOwnCommandOnly) {
  EXPECT_THAT(run({"echo", "--range-m", "1"}).message, Not(HasSubstr("renamed")));
  EXPECT_THAT(run({"mesh", "remake"}).message, Not(HasSubstr("renamed")));
}

TEST(RenamedOptionValues, AreRefusedByTheirNewNames) {
  for (const RenamedOptionValue& old : renamed_option_values()) {
    const auto with = [&](std::string_view value) {
      return run({"rcs", "--target", "absent.glb", "--frequency-ghz", "10", "--azimuth-deg", "0", "-o", "unused.csv",
                  "--sea-reflection", std::string(old.option), std::string(value)});
    };
    const Refusal refused = with(old.value);
    EXPECT_EQ(refused.code, 2) << old.value;
    EXPECT_THAT(refused.message,
                HasSubstr(fmt::format("{}: value '{}': renamed to '{}'", old.option, old.value, old.now)));
    EXPECT_THAT(with(old.now).message, Not(HasSubstr(std::string(old.option)))) << old.now;
  }
}

}  // namespace
}  // namespace seaglint
