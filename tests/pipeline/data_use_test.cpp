// SPDX-License-Identifier: BSD-3-Clause
// Uses of a data set: merging, verification, regeneration of a sample, export, reading with NumPy and h5py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "classify/dataset/format/manifest.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

bool has_python() { return fs::exists(kPython) && run_words({kPython, "-c", "import h5py, numpy"}).code == 0; }

#define SKIP_WITHOUT_PYTHON() \
  if (!has_python()) GTEST_SKIP() << "needs the packages python3-h5py and python3-numpy"

// One data set with complex maps for all tests of this file; tests that change it use a copy.
class DataSetUse : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    data_ = folder_->path() / "data";
    const ProgramResult generated = run_program({"generate", "scenarios/points.yaml", "-o", data_, "--set",
                                                 "dataset.maps_per_shard=15", "--set", "dataset.complex_maps=true"});
    ASSERT_EQ(generated.code, 0) << generated.err;
    const ProgramResult merged = run_program({"merge", data_});
    ASSERT_EQ(merged.code, 0) << merged.err;
    EXPECT_THAT(merged.out, HasSubstr("dataset.h5: 40 samples of 3 shards"));
  }
  static void TearDownTestSuite() { delete folder_; }

  static fs::path copy() {
    fs::path place = folder_->path() / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::copy(data_, place);
    return place;
  }
  // Runs Python code with `data` and `out` as paths; it must print "equal".
  static void expect_equal_in_python(const std::string& code, const fs::path& out) {
    const ProgramResult result = run_words({kPython, "-c",
                                            "import sys, json, glob, numpy as np, h5py\n"
                                            "data, out = sys.argv[1:]\n" +
                                                code + "\nprint('equal')",
                                            data_, out});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out, "equal\n");
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline fs::path data_;
};

TEST_F(DataSetUse, VerifiesWithItsMergedFile) {
  const ProgramResult result = run_program({"verify", data_});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("no fault found"));
}

TEST_F(DataSetUse, IsNotMergedWithAShardMissing) {
  const fs::path data = copy();
  fs::remove(data / "shard_00001.h5");
  const ProgramResult result = run_program({"merge", data, "-o", data / "new.h5"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("shard_00001.h5: missing"));
  EXPECT_FALSE(fs::exists(data / "new.h5"));
}

TEST_F(DataSetUse, RegeneratesASampleBitForBit) {
  const fs::path out = folder_->path() / "sample.npz";
  const ProgramResult result = run_program({"regenerate", data_, "--sample", "17", "-o", out});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the regenerated sample matches the stored one, bit for bit"));
  SKIP_WITHOUT_PYTHON();
  expect_equal_in_python(
      "a, h = np.load(out), h5py.File(data + '/dataset.h5')\n"
      "assert a['map_complex'].dtype == np.complex64\n"
      "assert (a['map'] == h['maps'][17]).all()\n"
      "assert (a['map_complex'] == h['maps_complex'][17].view(np.complex64)[..., 0]).all()\n"
      "assert (a['hop_code'] == h['hop_code'][17]).all()\n"
      "assert (a['centres'] == h['centres'][17][:len(a['centres'])]).all() and len(a['centres']) == "
      "a['samples/centres']\n"
      "for name in h['axes']: assert (a['axes/' + name] == h['axes'][name][:]).all()\n"
      "for name in h['samples']: assert a['samples/' + name] == h['samples'][name][17], name",
      out);
}

TEST_F(DataSetUse, ReportsDifferencesOfARegeneratedSample) {
  const fs::path data = copy();
  std::string yaml = read_file(data / "scenario.yaml");
  yaml.replace(yaml.find("scr_db: 20"), 10, "scr_db: 15");
  write_file(data / "scenario.yaml", yaml);
  // As if the maps had been generated with the changed scenario.
  std::string manifest = read_file(data / "manifest.json");
  const std::string original = sha256_file(data_ / "scenario.yaml");
  ASSERT_NE(manifest.find(original), std::string::npos);
  manifest.replace(manifest.find(original), original.size(), sha256(yaml));
  write_file(data / "manifest.json", manifest);
  const ProgramResult result = run_program({"regenerate", data, "--sample", "3"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("sample 3 regenerated: its map differs by up to"));
  EXPECT_THAT(result.err, HasSubstr("scr_per_pulse_db"));
  const ProgramResult beyond = run_program({"regenerate", data, "--sample", "40"});
  EXPECT_EQ(beyond.code, 2);
  EXPECT_THAT(beyond.err, HasSubstr("--sample 40: the data set has samples 0 to 39"));
}

TEST_F(DataSetUse, IsTheSameInNumpy) {
  const fs::path one = folder_->path() / "all.npz", many = folder_->path() / "npz";
  ASSERT_EQ(run_program({"export", data_, "-o", one}).code, 0);
  const ProgramResult result = run_program({"export", data_, "-o", many});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("40 samples in 3 files"));
  SKIP_WITHOUT_PYTHON();
  const std::string compare =
      "def equal(a, h):\n"
      "  names = []\n"
      "  h.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)\n"
      "  assert sorted(names + ['description.json']) == sorted(a.files), (names, a.files)\n"
      "  declared = json.loads(a['description.json'])['arrays']\n"
      "  for name in names:\n"
      "    there, here = h[name][:], a[name]\n"
      "    if name == 'maps_complex': there = there.view(np.complex64)[..., 0]\n"
      "    assert here.dtype == there.dtype and here.shape == there.shape, name\n"
      "    assert (here == there).all(), name\n"
      "    assert declared[name]['units'] == h[name].attrs['units'].decode(), name\n";
  expect_equal_in_python(compare + "equal(np.load(out), h5py.File(data + '/dataset.h5'))", one);
  expect_equal_in_python(compare +
                             "for shard in sorted(glob.glob(data + '/shard_*.h5')):\n"
                             "  equal(np.load(shard.replace(data, out).replace('.h5', '.npz')), h5py.File(shard))",
                         many);
}

TEST_F(DataSetUse, IsExportedInTheSameBytesAtAnyTime) {
  const fs::path out = folder_->path() / "twice.npz";
  ASSERT_EQ(run_program({"export", data_, "-o", out}).code, 0);
  const std::string first = read_file(out);
  timespec pause{2, 100000000};  // longer than the two-second resolution of a zip's time stamps
  nanosleep(&pause, nullptr);
  ASSERT_EQ(run_program({"export", data_, "-o", out}).code, 0);
  EXPECT_EQ(read_file(out), first);
}

// A directory set.mat with .npz files would look like a file that MATLAB reads.
TEST_F(DataSetUse, IsNotExportedUnderTheNameOfAnotherFormat) {
  for (const char* name : {"set.mat", "set.h5", "set.csv", "set.npy", "set.MAT", "set.tar", "set.zip"}) {
    const fs::path out = folder_->path() / name;
    const ProgramResult result = run_program({"export", data_, "-o", out});
    EXPECT_EQ(result.code, 2) << name;
    EXPECT_THAT(result.err, AllOf(HasSubstr(std::string(name) + ": "), HasSubstr("is no format of --as: npz writes"),
                                  HasSubstr("webdataset")));
    EXPECT_FALSE(fs::exists(out)) << name;
    if (name == std::string("set.tar")) continue;
    EXPECT_EQ(run_program({"export", data_, "-o", out, "--as", "webdataset"}).code, 2) << name;
  }
  EXPECT_EQ(run_program({"export", data_, "-o", folder_->path() / "set.v2"}).code, 0);
}

// Two data sets in one directory would be read as one.
TEST_F(DataSetUse, IsNotExportedAmongFilesOfAnother) {
  const fs::path other = folder_->path() / "other", out = folder_->path() / "shards";
  ASSERT_EQ(run_program({"generate", "scenarios/points.yaml", "-o", other, "--set", "dataset.maps_per_case=10"}).code,
            0);
  ASSERT_EQ(run_program({"export", other, "-o", out}).code, 0);
  const auto refused = [](const fs::path& data, const fs::path& place, const std::string& message) {
    const ProgramResult result = run_program({"export", data, "-o", place});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr(message));
  };
  const std::string before = read_file(out / "shard_00000.npz");
  refused(data_, out,
          "shards: the directory contains shard_00000.npz, which is not of this data set's export; choose a new "
          "directory\n");
  EXPECT_EQ(read_file(out / "shard_00000.npz"), before);
  // An interrupted export of the same data set is continued.
  fs::remove(out / "shard_00000.npz");
  write_file(out / "shard_00000.npz.0123456789abcdef.tmp", "half");
  EXPECT_EQ(run_program({"export", other, "-o", out}).code, 0);
  EXPECT_EQ(read_file(out / "shard_00000.npz"), before);
  write_file(out / "notes.txt", "mine");
  refused(other, out, "shards: the directory contains notes.txt");
  refused(other, out / "notes.txt", "notes.txt: is a file, not a directory");
  refused(other, other, "other: is the data set itself; export it into another directory\n");
  EXPECT_FALSE(fs::exists(other / "shard_00000.npz"));
}

TEST_F(DataSetUse, IsNotExportedWithAShardDamagedNorOntoAFullDisk) {
  const fs::path data = copy();
  fs::resize_file(data / "shard_00002.h5", fs::file_size(data / "shard_00002.h5") / 2);
  const ProgramResult damaged = run_program({"export", data, "-o", data / "x.npz"});
  EXPECT_EQ(damaged.code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("shard_00002.h5: truncated or changed"));
  const ProgramResult limited = run_words({"/bin/bash", "-c", "trap '' XFSZ; ulimit -f 200; exec \"$@\"", "limited",
                                           kProgram, "export", data_, "-o", data / "x.npz"});
  EXPECT_EQ(limited.code, 1);
  EXPECT_THAT(limited.err, HasSubstr("x.npz: cannot write: "));
  for (const auto& entry : fs::directory_iterator(data)) {
    EXPECT_THAT(entry.path().filename().string(), testing::Not(testing::StartsWith("x.npz")));
  }
}

// No user can write in /proc, not even root.
TEST_F(DataSetUse, ReportsWhereItCannotBeWritten) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"merge", data_, "-o", "/proc/x.h5"},
                                             {"export", data_, "-o", "/proc/x.npz"},
                                             {"export", data_, "-o", "/proc/x"},
                                             {"regenerate", data_, "--sample", "3", "-o", "/proc/x.npz"}}) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 1) << words[0];
    EXPECT_THAT(result.err, HasSubstr("seaglint: /proc/x")) << words[0];
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

// HDF5 would pair the labels of one data set with the maps of another, beside the file or in the working directory.
TEST_F(DataSetUse, NamesAMergedFileOfAnotherDataSet) {
  const fs::path other = folder_->path() / "another_set";
  ASSERT_EQ(run_program({"generate", "scenarios/points.yaml", "--set", "seed=7", "--set", "dataset.maps_per_case=2",
                         "--set", "dataset.realisations_per_case=1", "-o", other})
                .code,
            0);
  fs::copy(data_ / "dataset.h5", other / "dataset.h5");
  const std::string sentence = (other / "dataset.h5").string() + ": is of another manifest";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"export", other, "-o", folder_->path() / "another_set.npz"},
        {"regenerate", other, "--sample", "0"},
        {"verify", other, "--regenerate", "0"}}) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, words[0] == "verify" ? 2 : 0) << words[0];
    EXPECT_THAT(result.err, HasSubstr("is of another manifest")) << words[0];
  }
  SKIP_WITHOUT_PYTHON();
  const std::string example = SEAGLINT_SOURCE_DIR "/tools/python/read_dataset.py";
  EXPECT_THAT(run_words({kPython, example, other / "dataset.h5"}).err, HasSubstr(sentence));
  const fs::path alone = folder_->path() / "alone";
  fs::create_directories(alone);
  fs::copy(data_ / "dataset.h5", alone / "dataset.h5");
  EXPECT_THAT(run_words({"/usr/bin/env", "--chdir=" + other.string(), kPython, example, alone / "dataset.h5"}).err,
              HasSubstr("manifest.json: missing"));
}

TEST_F(DataSetUse, IsReadByThePythonExample) {
  SKIP_WITHOUT_PYTHON();
  const std::string example = SEAGLINT_SOURCE_DIR "/tools/python/read_dataset.py";
  const ProgramResult merged = run_words({kPython, example, data_ / "dataset.h5"});
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_THAT(merged.out, HasSubstr("20 of 40 maps have label 1"));
  EXPECT_THAT(merged.out, HasSubstr("\ntrain    16       4"));
  const ProgramResult shards = run_words({kPython, example, data_});
  EXPECT_EQ(shards.out, merged.out) << shards.err;
  const fs::path data = copy();
  fs::remove(data / "shard_00001.h5");
  for (const fs::path& place : {data, data / "dataset.h5"}) {
    const ProgramResult refused = run_words({kPython, example, place});
    EXPECT_NE(refused.code, 0);
    EXPECT_THAT(refused.err, HasSubstr("shard_00001.h5: missing (1 of 3 shards)"));
  }
}

}  // namespace
}  // namespace seaglint
