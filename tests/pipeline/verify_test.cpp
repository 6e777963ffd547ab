// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "classify/dataset/format/manifest.h"
#include "tests/pipeline/program.h"
#include "tests/refusal.h"
#include "tests/sanitized.h"

namespace seaglint {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

// `seaglint verify` on data sets that the program generated.

class DataSetVerification : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = folder_.path() / "data";
    completed({"generate", kPoints, "-o", directory_, "--set", "dataset.maps_per_shard=5"});
  }

  TemporaryFolder folder_;
  fs::path directory_;
};

TEST_F(DataSetVerification, AcceptsAValidDataSetAndItsRegeneratedSamples) {
  const ProgramResult result = completed({"verify", directory_, "--regenerate", "4"});
  EXPECT_HAS(result.out, "4 regenerated samples match the stored ones");
  EXPECT_HAS(result.out, "no fault found");
}

TEST_F(DataSetVerification, CrossChecksNoIdealPoints) {
  EXPECT_HAS(completed({"verify", directory_, "--regenerate", "0", "--cross-check", "3"}).out,
             "3 samples of ideal points left out, which have no solver");
  expect_refused({"verify", directory_, "--regenerate", "0", "--cross-check", "3", "--cross-check-db", "-20"},
                 "--cross-check-db: none of 3 samples has a solver");
  EXPECT_HAS(run_program({"verify", directory_, "--cross-check-db", "-20"}).err,
             "--cross-check-db requires --cross-check");
}

// Two samples of a reflector; -300 dB is below any difference of two methods, 20 dB above that of any that agree.
TEST(CrossCheckedDataSet, ReportsDifferencesAndFailsOnlyAboveTheBound) {
  const TemporaryFolder folder;
  const std::string data = folder.path() / "data";
  write_file(folder.path() / "reflector.yaml",
             "seaglint: 1\nradar: {pulses: 16}\nview: {azimuth_deg: [10, 40], elevation_deg: 2}\ntargets:\n"
             "  reflector: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}\n"
             "dataset: {maps_per_case: 1, realisations_per_case: 1}\n");
  completed({"generate", folder.path() / "reflector.yaml", "-o", data});
  const auto verify = [&](Words more) {
    return run_program({"verify", data, "--regenerate", "0", "--cross-check", "9"}, more);
  };
  const ProgramResult reported = completed(verify({}));
  EXPECT_HAS(reported.out, "  reflector  beams   rays ");
  completed(verify({"--cross-check-db", "20"}));
  const ProgramResult failed = verify({"--cross-check-db", "-300"});
  EXPECT_EQ(failed.code, 1);
  EXPECT_HAS(failed.err, "the median relative difference of the response, ");
  EXPECT_EQ(failed.out, reported.out);
}

TEST_F(DataSetVerification, NeitherMergesOverItselfNorAcceptsItAsARun) {
  const std::string shard = read_file(directory_ / "shard_00000.h5"),
                    scenario = read_file(directory_ / "scenario.yaml");
  for (const char* name : {"shard_00000.h5", "scenario.yaml", "manifest.json", "merged.txt"})
    expect_refused({"merge", directory_, "-o", directory_ / name}, name);
  expect_refused({"run", kPoints, "--set", "seed=99", "-o", directory_, "--resume"},
                 "contains something else than a run");
  EXPECT_EQ(read_file(directory_ / "shard_00000.h5"), shard);
  EXPECT_EQ(read_file(directory_ / "scenario.yaml"), scenario);
  completed({"verify", directory_, "--regenerate", "0"});
}

TEST_F(DataSetVerification, RefusesATruncatedShard) {
  const fs::path shard = directory_ / "shard_00003.h5";
  fs::resize_file(shard, fs::file_size(shard) / 2);
  expect_refused({"verify", directory_}, "faults, the first: " + shard.string());
}

TEST_F(DataSetVerification, RefusesAForeignFileAndAMissingManifest) {
  write_file(directory_ / "foo", "");
  const ProgramResult result = run_program({"verify", directory_});
  EXPECT_EQ(result.code, 2);
  EXPECT_HAS(result.out, "fault: foo: is no file of a data set\n");
  fs::remove(directory_ / "foo");
  write_file(directory_ / ".nfs0001", "");  // temporary file of a network file server
  completed({"verify", directory_, "--regenerate", "0"});
  fs::remove(directory_ / "manifest.json");
  expect_refused({"verify", directory_}, "manifest.json");
}

// Uses of a data set: merging, verification, regeneration of a sample, export, reading with NumPy and h5py.

bool has_python() { return fs::exists(kPython) && run_words({kPython, "-c", "import h5py, numpy"}).code == 0; }

#define SKIP_WITHOUT_PYTHON() \
  if (!has_python()) GTEST_SKIP() << "needs the packages python3-h5py and python3-numpy"

// One data set with complex maps for all tests of this file; tests that change it use a copy.
class DataSetUse : public SharedFolder {
 protected:
  static void SetUpTestSuite() {
    data_ = path("data");
    completed(
        {"generate", kPoints, "-o", data_, "--set", "dataset.maps_per_shard=15", "--set", "dataset.complex_maps=true"});
    EXPECT_HAS(completed({"merge", data_}).out, "dataset.h5: 40 samples of 3 shards");
  }
  static fs::path copy() {
    fs::path place = path(testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::copy(data_, place);
    return place;
  }
  // Runs Python code with `data` and `out` as paths; it must print "equal".
  static void expect_equal_in_python(const std::string& code, const fs::path& out) {
    const ProgramResult result = completed(run_words({kPython, "-c",
                                                      "import sys, json, glob, numpy as np, h5py\n"
                                                      "data, out = sys.argv[1:]\n" +
                                                          code + "\nprint('equal')",
                                                      data_, out}));
    EXPECT_EQ(result.out, "equal\n");
  }

  static inline fs::path data_;
};

TEST_F(DataSetUse, VerifiesWithItsMergedFile) { EXPECT_HAS(completed({"verify", data_}).out, "no fault found"); }

TEST_F(DataSetUse, IsNotMergedWithAShardMissing) {
  const fs::path data = copy();
  fs::remove(data / "shard_00001.h5");
  expect_refused({"merge", data, "-o", data / "new.h5"}, "shard_00001.h5: missing");
  EXPECT_FALSE(fs::exists(data / "new.h5"));
}

TEST_F(DataSetUse, RegeneratesASampleBitForBit) {
  const fs::path out = path("sample.npz");
  EXPECT_HAS(completed({"regenerate", data_, "--sample", "17", "-o", out}).out,
             "the regenerated sample matches the stored one, bit for bit");
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
  EXPECT_HAS(result.err, "sample 3 regenerated: its map differs by up to");
  EXPECT_HAS(result.err, "scr_per_pulse_db");
  expect_refused({"regenerate", data, "--sample", "40"}, "--sample 40: the data set has samples 0 to 39");
}

TEST_F(DataSetUse, IsLookedAtFromItsShardsAndItsMergedFile) {
  const fs::path one = path("look.svg"), two = path("merged.svg");
  const ProgramResult result = completed({"look", data_, "--samples", "6", "-o", one});
  EXPECT_HAS(result.out, "look.svg: 6 of 40 maps of ");
  EXPECT_HAS(result.out, "SCR 20 dB");
  completed({"look", data_ / "dataset.h5", "--samples", "6", "-o", two});
  EXPECT_EQ(read_file(one), read_file(two));
  const std::string text = read_file(one);
  for (const char* word : {"carrier 16 GHz", "6 of 40 maps of points, seed", "|RV| relative to its peak (dB)"})
    EXPECT_HAS(text, word);
  completed({"look", data_, "--samples", "100", "--whole", "--style", "paper", "-o", two});
  EXPECT_HAS(read_file(two), "40 of 40 maps");
  EXPECT_HAS(read_file(two), "whole maps");
}

// Every class in the same seas and at the same aspects.
TEST_F(DataSetUse, IsLookedAtInEqualConditions) {
  const fs::path file = path("pairs.svg");
  std::istringstream lines(completed({"look", data_, "--samples", "8", "-o", file}).out);
  std::vector<std::string> conditions;
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t at = line.find("Hs "); at != std::string::npos) conditions.push_back(line.substr(at));
  ASSERT_EQ(conditions.size(), 8u);
  for (std::size_t i = 0; i < 8; i += 2) EXPECT_EQ(conditions[i], conditions[i + 1]);
}

TEST_F(DataSetUse, IsNotLookedAtWhereItIsMissingOrDamaged) {
  const fs::path file = path("none.png"), empty = path("empty"), data = copy();
  fs::create_directory(empty);
  expect_refused({"look", empty, "-o", file}, "no manifest.json: not a data set, or one that is not finished");
  expect_refused({"look", path("nowhere"), "-o", file}, "no such directory");
  expect_refused({"look", data / "shard_00000.h5", "-o", file}, "shard_00000.h5: is no merged file of a data set");
  expect_refused({"look", data, "-o", "look.bmp"}, "look.bmp: a figure's name ends in .png, .svg or .pdf");
  fs::resize_file(data / "shard_00001.h5", 1000);
  expect_refused({"look", data, "--samples", "40", "-o", file}, "shard_00001.h5: truncated or changed");
  fs::create_directory(path("moved"));
  fs::copy(data_ / "dataset.h5", path("moved") + "/dataset.h5");
  expect_refused({"look", path("moved") + "/dataset.h5", "-o", file}, "dataset.h5: its shards are not in");
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(DataSetUse, IsTheSameInNumpy) {
  const fs::path one = path("all.npz"), many = path("npz");
  completed({"export", data_, "-o", one});
  EXPECT_HAS(completed({"export", data_, "-o", many}).out, "40 samples in 3 files");
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
  const fs::path out = path("twice.npz");
  completed({"export", data_, "-o", out});
  const std::string first = read_file(out);
  timespec pause{2, 100000000};  // longer than the two-second resolution of a zip's time stamps
  nanosleep(&pause, nullptr);
  completed({"export", data_, "-o", out});
  EXPECT_EQ(read_file(out), first);
}

// A directory set.mat with .npz files would look like a file that MATLAB reads.
TEST_F(DataSetUse, IsNotExportedUnderTheNameOfAnotherFormat) {
  for (const char* name : {"set.mat", "set.h5", "set.csv", "set.npy", "set.MAT", "set.tar", "set.zip"}) {
    const fs::path out = path(name);
    const ProgramResult result = run_program({"export", data_, "-o", out});
    expect_refused(result, std::string(name) + ": ");
    EXPECT_HAS(result.err, "is no format of this command: it writes one file FILE.npz");
    EXPECT_FALSE(fs::exists(out)) << name;
  }
  completed({"export", data_, "-o", path("set.v2")});
}

// Two data sets in one directory would be read as one.
TEST_F(DataSetUse, IsNotExportedAmongFilesOfAnother) {
  const fs::path other = path("other"), out = path("shards");
  completed({"generate", kPoints, "-o", other, "--set", "dataset.maps_per_case=10"});
  completed({"export", other, "-o", out});
  const auto refused = [](const fs::path& data, const fs::path& place, const std::string& message) {
    expect_refused({"export", data, "-o", place}, message);
  };
  const std::string before = read_file(out / "shard_00000.npz");
  refused(data_, out,
          "shards: the directory contains shard_00000.npz, which is not of this data set's export; choose a new "
          "directory\n");
  EXPECT_EQ(read_file(out / "shard_00000.npz"), before);
  // An interrupted export of the same data set is continued.
  fs::remove(out / "shard_00000.npz");
  write_file(out / "shard_00000.npz.0123456789abcdef.tmp", "half");
  completed({"export", other, "-o", out});
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
  expect_refused({"export", data, "-o", data / "x.npz"}, "shard_00002.h5: truncated or changed");
  const ProgramResult limited = run_words({"/bin/bash", "-c", "trap '' XFSZ; ulimit -f 200; exec \"$@\"", "limited",
                                           kProgram, "export", data_, "-o", data / "x.npz"});
  EXPECT_EQ(limited.code, 1);
  EXPECT_HAS(limited.err, "x.npz: cannot write: ");
  EXPECT_THAT(names_in(data), testing::Each(Not(testing::StartsWith("x.npz"))));
}

// No user can write in /proc, not even root.
TEST_F(DataSetUse, ReportsWhereItCannotBeWritten) {
  for (const Words& words : std::vector<Words>{{"merge", data_, "-o", "/proc/x.h5"},
                                               {"export", data_, "-o", "/proc/x.npz"},
                                               {"export", data_, "-o", "/proc/x"},
                                               {"regenerate", data_, "--sample", "3", "-o", "/proc/x.npz"}}) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 1) << words[0];
    EXPECT_HAS(result.err, "seaglint: /proc/x") << words[0];
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

// HDF5 would pair the labels of one data set with the maps of another, beside the file or in the working directory.
TEST_F(DataSetUse, NamesAMergedFileOfAnotherDataSet) {
  const fs::path other = path("another_set");
  completed({"generate", kPoints, "--set", "seed=7", "--set", "dataset.maps_per_case=2", "--set",
             "dataset.realisations_per_case=1", "-o", other});
  fs::copy(data_ / "dataset.h5", other / "dataset.h5");
  const std::string sentence = (other / "dataset.h5").string() + ": is of another manifest";
  for (const Words& words : {Words{"export", other, "-o", path("another_set.npz")},
                             {"regenerate", other, "--sample", "0"},
                             {"verify", other, "--regenerate", "0"}}) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, words[0] == "verify" ? 2 : 0) << words[0];
    EXPECT_HAS(result.err, "is of another manifest") << words[0];
  }
  SKIP_WITHOUT_PYTHON();
  const std::string example = SEAGLINT_SOURCE_DIR "/tools/python/read_dataset.py";
  EXPECT_HAS(run_words({kPython, example, other / "dataset.h5"}).err, sentence);
  const fs::path alone = path("alone");
  fs::create_directories(alone);
  fs::copy(data_ / "dataset.h5", alone / "dataset.h5");
  EXPECT_HAS(run_words({"/usr/bin/env", "--chdir=" + other.string(), kPython, example, alone / "dataset.h5"}).err,
             "manifest.json: missing");
}

TEST_F(DataSetUse, IsReadByThePythonExample) {
  SKIP_WITHOUT_PYTHON();
  const std::string example = SEAGLINT_SOURCE_DIR "/tools/python/read_dataset.py";
  const ProgramResult merged = completed(run_words({kPython, example, data_ / "dataset.h5"}));
  EXPECT_HAS(merged.out, "20 of 40 maps have label 1");
  EXPECT_HAS(merged.out, "\ntrain    16       4");
  const ProgramResult shards = run_words({kPython, example, data_});
  EXPECT_EQ(shards.out, merged.out) << shards.err;
  const fs::path data = copy();
  fs::remove(data / "shard_00001.h5");
  for (const fs::path& place : {data, data / "dataset.h5"}) {
    const ProgramResult refused = run_words({kPython, example, place});
    EXPECT_NE(refused.code, 0);
    EXPECT_HAS(refused.err, "shard_00001.h5: missing (1 of 3 shards)");
  }
}

// Data sets made to deceive: no other file is read, memory is bounded, and the shard is named.

class HostileDataSet : public testing::Test {
 protected:
  // The program with at most 1.5 GB of address space, three times what it takes to start (without sanitizers).
  static ProgramResult bounded(const Words& arguments) {
    const std::string limit = kSanitized ? "" : "ulimit -v 1500000; ";
    return run_words(with({"/bin/bash", "-c", limit + "exec \"$@\"", "bounded", kProgram}, arguments));
  }

  TemporaryFolder folder_;
  const fs::path base_ = folder_.path() / "base", secret_ = folder_.path() / "secret";
};

TEST_F(HostileDataSet, IsRefusedWithTheShardsName) {
  if (run_words({kPython, "-c", "import h5py, numpy"}).code != 0) GTEST_SKIP() << "no h5py";
  completed({"generate", kPoints, "--set", "dataset.maps_per_case=4", "--set", "dataset.realisations_per_case=2",
             "--set", "dataset.maps_per_shard=4", "-o", base_});
  for (int i = 0; i < 100000; ++i) std::ofstream(secret_, std::ios::app) << "SECRET OF ANOTHER FILE ";
  const fs::path made = folder_.path() / "made";
  const std::string hostile_shards = SEAGLINT_SOURCE_DIR "/tests/pipeline/hostile_shards.py";
  const ProgramResult script = completed(run_words({kPython, hostile_shards, base_, made, secret_}));
  std::istringstream kinds(script.out);
  int count = 0;
  for (std::string kind; std::getline(kinds, kind); ++count) {
    const fs::path exported = folder_.path() / (kind + ".npz");
    for (const Words& words : {Words{"verify", made / kind, "--regenerate", "0"},
                               {"merge", made / kind},
                               {"export", made / kind, "-o", exported}}) {
      const ProgramResult result = bounded(words);
      EXPECT_EQ(result.code, 2) << kind << ", " << words[0] << ": " << result.err;
      EXPECT_HAS(result.err, "shard_00000.h5: ") << kind << ", " << words[0];
      EXPECT_THAT(result.err, Not(HasSubstr("SECRET"))) << kind;
    }
    EXPECT_FALSE(fs::exists(exported)) << kind;
  }
  EXPECT_EQ(count, 13);
}

}  // namespace
}  // namespace seaglint
