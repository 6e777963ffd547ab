// SPDX-License-Identifier: BSD-3-Clause
// `export --as webdataset`: read by Python's tarfile, NumPy and h5py; refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/directory_bytes.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// One data set for all tests of this file, of ten samples in each of four shards.
class WebDataset : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    data_ = folder_->path() / "data";
    generate(data_, {"--threads", "1"});
  }
  static void TearDownTestSuite() { delete folder_; }

  static void generate(const fs::path& data, const std::vector<std::string>& more) {
    std::vector<std::string> words{"generate", "scenarios/points.yaml",    "-o", data,
                                   "--set",    "dataset.maps_per_shard=10"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult generated = run_program(words);
    ASSERT_EQ(generated.code, 0) << generated.err;
  }
  static ProgramResult exported(const fs::path& data, const fs::path& output, const std::string& max_mb) {
    return run_program({"export", data, "-o", output, "--as", "webdataset", "--max-tar-mb", max_mb});
  }
  static void expect_read(const fs::path& data, const fs::path& output, const std::string& counts) {
    const ProgramResult result =
        run_words({kPython, SEAGLINT_SOURCE_DIR "/tests/pipeline/webdataset_reader.py", data, output});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out, counts + "\n");
  }
  static void expect_refused(const ProgramResult& result, const std::string& sentence) {
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr(sentence));
  }

  fs::path output_ = folder_->path() / testing::UnitTest::GetInstance()->current_test_info()->name();
  static inline TemporaryFolder* folder_ = nullptr;
  static inline fs::path data_;
};

bool has_python() { return fs::exists(kPython) && run_words({kPython, "-c", "import h5py, numpy"}).code == 0; }

TEST_F(WebDataset, HasTheArraysAndRowsOfTheShards) {
  ASSERT_EQ(exported(data_, output_, "1").code, 0);
  for (const auto& entry : fs::directory_iterator(output_)) {
    if (entry.path().extension() == ".tar") {
      EXPECT_LE(entry.file_size(), 1000000u);
    }
  }
  if (!has_python()) GTEST_SKIP() << "needs the packages python3-h5py and python3-numpy";
  expect_read(data_, output_, "4 40");
}

TEST_F(WebDataset, HasComplexMapsAndNoNumberWhereThereIsNoClutter) {
  const fs::path data = folder_->path() / "complex";
  generate(data, {"--set", "dataset.complex_maps=true", "--set", "clutter.enabled=false", "--set",
                  "dataset.maps_per_case=5"});
  ASSERT_EQ(exported(data, output_, "500").code, 0);
  if (!has_python()) GTEST_SKIP() << "needs the packages python3-h5py and python3-numpy";
  expect_read(data, output_, "1 20");
}

TEST_F(WebDataset, HasTheSameBytesInEveryRunAndForAnyNumberOfThreads) {
  const fs::path two_threads = folder_->path() / "two_threads";
  generate(two_threads, {"--threads", "2"});
  ASSERT_EQ(exported(data_, output_ / "one", "1").code, 0);
  ASSERT_EQ(exported(two_threads, output_ / "two", "1").code, 0);
  EXPECT_TRUE(bytes_of(output_ / "one") == bytes_of(output_ / "two"));
}

TEST_F(WebDataset, IsReplacedByThatOfTheSameDataSetAlone) {
  ASSERT_EQ(exported(data_, output_, "0.2").code, 0);
  ASSERT_EQ(exported(data_, output_, "1").code, 0);
  if (has_python()) expect_read(data_, output_, "4 40");
  const auto before = bytes_of(output_);
  const fs::path other = folder_->path() / "other";
  generate(other, {"--set", "seed=7", "--set", "dataset.maps_per_case=5"});
  expect_refused(exported(other, output_, "1"), "which is not of this data set's export; choose a new directory");
  write_file(output_ / "notes.txt", "mine");
  expect_refused(exported(data_, output_, "1"), "the directory contains notes.txt");
  fs::remove(output_ / "notes.txt");
  EXPECT_TRUE(bytes_of(output_) == before);
}

TEST_F(WebDataset, RefusesBoundsAndPlacesThatCannotBe) {
  ASSERT_EQ(exported(data_, output_, "1").code, 0);
  const auto before = bytes_of(output_);
  expect_refused(exported(data_, output_, "0.05"),
                 "an archive of sample 000000000 alone has 81920 bytes, more than the limit of 50000");
  EXPECT_TRUE(bytes_of(output_) == before);
  expect_refused(exported(data_, output_ / "new", "0"), "--max-tar-mb");
  expect_refused(exported(data_, output_ / "new.npz", "1"), "new.npz: --as webdataset writes a directory");
  expect_refused(exported(data_, data_, "1"), "is the data set itself");
  expect_refused(run_program({"export", data_, "-o", output_ / "new", "--max-tar-mb", "1"}),
                 "--max-tar-mb: only with --as webdataset");
  expect_refused(run_program({"export", data_, "-o", output_ / "new", "--as", "tar"}), "--as");
  EXPECT_FALSE(fs::exists(output_ / "new"));
}

// A damaged shard ends the export; what has its final name is whole, and no index says that the export is complete.
TEST_F(WebDataset, HasNoIndexWhenAShardIsDamaged) {
  const fs::path data = folder_->path() / "damaged";
  fs::copy(data_, data);
  fs::resize_file(data / "shard_00003.h5", fs::file_size(data / "shard_00003.h5") - 10);
  expect_refused(exported(data, output_, "1"), "shard_00003.h5: truncated or changed");
  EXPECT_FALSE(fs::exists(output_ / "index.json"));
  ASSERT_EQ(exported(data_, output_ / "whole", "1").code, 0);
  for (const auto& [name, content] : bytes_of(output_ / "whole")) {
    if (fs::exists(output_ / name)) {
      EXPECT_TRUE(read_file(output_ / name) == content) << name;
    }
  }
  for (const auto& entry : fs::directory_iterator(output_)) EXPECT_NE(entry.path().extension(), ".tmp");
}

}  // namespace
}  // namespace seaglint
