// SPDX-License-Identifier: BSD-3-Clause
// `card`: files by the rules of their specifications, what only the user knows, refusals; the data set stays sound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pipeline/directory_bytes.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

const Words kPublication{"--licence",      "CC-BY-4.0",
                         "--name",         "Points: \"a\" set # 1",
                         "--creator",      "A. Person",
                         "--creator",      "B. Person",
                         "--url",          "https://example.org/d",
                         "--organisation", "Laboratory",
                         "--date",         "2026-02-28",
                         "--data-version", "1.0.0"};

// Every test has a copy of one data set, whose rows have no clutter and therefore values that are no numbers.
class Card : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const ProgramResult generated = generate({});
    ASSERT_EQ(generated.code, 0) << generated.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  void SetUp() override { fs::copy(folder_->path() / "data", data_); }

  static ProgramResult generate(const Words& more, const fs::path& data = folder_->path() / "data") {
    Words words{"generate", "scenarios/points.yaml",     "-o",    data,
                "--set",    "dataset.maps_per_shard=15", "--set", "clutter.enabled=false"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  ProgramResult card(const Words& more = {}) const {
    Words words{"card", data_};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
  void expect_rules(const Words& more, const std::string& counts) const {
    Words words{kPython, SEAGLINT_SOURCE_DIR "/tests/pipeline/card_rules.py", data_};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_words(words);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out, counts + "\n");
  }
  // Fails with this sentence and changes nothing.
  void expect_refused(const Words& more, const std::string& sentence) const {
    const auto before = bytes_of(data_);
    const ProgramResult result = card(more);
    EXPECT_EQ(result.code, 2) << testing::PrintToString(more);
    EXPECT_THAT(result.err, HasSubstr(sentence));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(bytes_of(data_) == before);
  }
  ProgramResult verified() const { return run_program({"verify", data_, "--regenerate", "0"}); }

  fs::path data_ = folder_->path() / testing::UnitTest::GetInstance()->current_test_info()->name();
  static inline TemporaryFolder* folder_ = nullptr;
};

bool has_python() { return fs::exists(kPython) && run_words({kPython, "-c", "import h5py, yaml"}).code == 0; }

#define SKIP_WITHOUT_PYTHON() \
  if (!has_python()) GTEST_SKIP() << "needs the packages python3-h5py and python3-yaml"

TEST_F(Card, FollowsTheSpecificationsWithAllThatTheUserKnows) {
  const ProgramResult result = card(kPublication);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(read_file(data_ / "README.md"), HasSubstr("license: cc-by-4.0\n"));
  SKIP_WITHOUT_PYTHON();
  expect_rules({"complete"}, "6 49 40");
}

TEST_F(Card, InventsNeitherLicenceNorPersonNorDate) {
  const ProgramResult result = card();
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("Croissant requires license, url, creator, datePublished too"));
  EXPECT_THAT(read_file(data_ / "README.md"), HasSubstr("## Licence\n\nNot given by those who made this data set.\n"));
  SKIP_WITHOUT_PYTHON();
  expect_rules({}, "6 49 40");
}

TEST_F(Card, ListsTheMergedFileThatIsThere) {
  ASSERT_EQ(run_program({"merge", data_}).code, 0);
  ASSERT_EQ(card().code, 0);
  SKIP_WITHOUT_PYTHON();
  expect_rules({}, "7 49 40");
}

TEST_F(Card, HasTheSameBytesInEveryRun) {
  ASSERT_EQ(card(kPublication).code, 0);
  const auto first = bytes_of(data_);
  ASSERT_EQ(card().code, 0);
  EXPECT_FALSE(bytes_of(data_) == first);
  ASSERT_EQ(card(kPublication).code, 0);
  EXPECT_TRUE(bytes_of(data_) == first);
}

TEST_F(Card, LeavesTheDataSetSound) {
  ASSERT_EQ(card(kPublication).code, 0);
  const auto before = bytes_of(data_);
  EXPECT_EQ(verified().code, 0) << verified().out;
  const ProgramResult resumed = generate({"--resume"}, data_);
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.out, HasSubstr("0 maps made"));
  EXPECT_TRUE(bytes_of(data_) == before);
}

TEST_F(Card, WhoseFilesChangedIsAFaultOfTheDataSet) {
  ASSERT_EQ(card().code, 0);
  write_file(data_ / "columns.csv", read_file(data_ / "columns.csv") + "\n");
  const ProgramResult changed = verified();
  EXPECT_EQ(changed.code, 2);
  EXPECT_THAT(changed.out + changed.err, HasSubstr("croissant.json: the SHA-256 of 'columns.csv' is another one; make "
                                                   "the cards again by `seaglint card DIR`"));
  fs::remove(data_ / "columns.csv");
  const ProgramResult missing = verified();
  EXPECT_THAT(missing.out + missing.err, HasSubstr("lists 'columns.csv', which is missing"));
  ASSERT_EQ(card().code, 0);
  EXPECT_EQ(verified().code, 0);
  write_file(data_ / "croissant.json", "{\"distribution\": [");
  const ProgramResult broken = verified();
  EXPECT_THAT(broken.out + broken.err, HasSubstr("croissant.json: no valid JSON from byte"));
}

TEST_F(Card, ReplacesNoFileOfTheUser) {
  const std::string sentence = ": was not written by seaglint, or was changed since; move it away or remove it";
  for (const char* name : {"README.md", "croissant.json", "columns.csv"}) {
    const bool was_there = fs::exists(data_ / name);
    const std::string before = was_there ? read_file(data_ / name) : "";
    write_file(data_ / name, before + "mine\n");
    expect_refused({}, (data_ / name).string() + sentence);
    was_there ? write_file(data_ / name, before) : static_cast<void>(fs::remove(data_ / name));
  }
  // `generate --resume` keeps it too.
  write_file(data_ / "README.md", "mine\n");
  ASSERT_EQ(generate({"--resume"}, data_).code, 0);
  EXPECT_EQ(read_file(data_ / "README.md"), "mine\n");
  fs::remove(data_ / "README.md");
  EXPECT_EQ(card().code, 0);
}

TEST_F(Card, RefusesValuesOfAnotherForm) {
  for (const char* licence : {"CC BY 4.0", "", "-MIT", "free!"})
    expect_refused({"--licence", licence}, "--licence: must be an identifier");
  for (const char* date : {"2026-02-29", "28.2.2026", "2026-2-28", "2026-13-01", "tomorrow"})
    expect_refused({"--date", date}, "--date: must be a date YYYY-MM-DD");
  for (const char* version : {"1.0", "1.0.0.0", "01.0.0", "v1.0.0", "1..0"})
    expect_refused({"--data-version", version}, "--data-version: must be MAJOR.MINOR.PATCH");
  for (const char* url : {"example.org", "ftp://example.org", "https://", "https://a b", "https://a>b"})
    expect_refused({"--url", url}, "--url: must begin with https:// or http://");
  expect_refused({"--name", "two\nlines"}, "--name: must be one line");
  expect_refused({"--creator", "\xff"}, "--creator: must be text in UTF-8");
  expect_refused({"--license-of", "x"}, "--license-of");
}

TEST_F(Card, OfOtherLicencesHasTheFormOfTheHub) {
  const auto front_of = [&](const std::string& licence) {
    EXPECT_EQ(card({"--licence", licence}).code, 0);
    return read_file(data_ / "README.md");
  };
  EXPECT_THAT(front_of("ODbL-1.0"), HasSubstr("\nlicense: odbl\n"));
  EXPECT_THAT(front_of("GPL-3.0-only"), HasSubstr("\nlicense: other\nlicense_name: \"GPL-3.0-only\"\n"));
  EXPECT_THAT(front_of("https://example.org/l"),
              HasSubstr("\nlicense: other\nlicense_link: \"https://example.org/l\"\n"));
  EXPECT_THAT(read_file(data_ / "croissant.json"), HasSubstr("\"license\": \"https://example.org/l\""));
  EXPECT_THAT(front_of("LicenseRef-mine"), HasSubstr("\nlicense_name: \"LicenseRef-mine\"\n"));
  EXPECT_THAT(read_file(data_ / "croissant.json"), Not(HasSubstr("spdx.org")));
}

TEST_F(Card, OfADamagedDataSetIsNotMade) {
  fs::resize_file(data_ / "shard_00001.h5", fs::file_size(data_ / "shard_00001.h5") - 10);
  expect_refused({}, "shard_00001.h5: truncated or changed");
}

// Title, version and author of the citation are those of CITATION.cff.
TEST_F(Card, CitesTheProgramAsCitationCffDoes) {
  SKIP_WITHOUT_PYTHON();
  const std::string citation = SEAGLINT_SOURCE_DIR "/CITATION.cff";
  ASSERT_EQ(card().code, 0);
  const ProgramResult result =
      run_words({kPython, "-c",
                 "import json, sys, yaml\n"
                 "cff = yaml.safe_load(open(sys.argv[1]))\n"
                 "cited = json.load(open(sys.argv[2]))['citeAs']\n"
                 "for value in (cff['title'], cff['version'], '{' + cff['authors'][0]['name'] + '}'):\n"
                 "    assert '= {' + value + '}' in cited, cited\n",
                 citation, data_ / "croissant.json"});
  EXPECT_EQ(result.code, 0) << result.err;
}

}  // namespace
}  // namespace seaglint
