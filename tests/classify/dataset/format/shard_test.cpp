// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <ctime>
#include <fstream>
#include <span>

#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/npz.h"
#include "classify/dataset/format/shard.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/file.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

// Arrays of NumPy's archives: values come back as written, in the headers that NumPy writes, and damaged files are
// refused with the name of the array.

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return bytes_of_values(std::span<const T>(values));
}

TEST(Npz, ReadsWhatItWrites) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.npz";
  const std::vector<std::complex<float>> waves{{1, 2}, {3, 4}, {-5, 0.5F}, {0, 7}, {8, 9}, {10, 11}};
  write_npz(file,
            {npz_array("waves", "<c8", {2, 3}, bytes_of(waves)),
             npz_array("code", "<i8", {3}, bytes_of(std::vector<std::int64_t>{7, -1, 1LL << 40})),
             npz_array("one", "<f8", {}, bytes_of(std::vector<double>{0.1})), npz_array("none", "<u2", {0, 4}, "")},
            {{"a.txt", "text"}});
  EXPECT_THAT(npz_members(file), testing::ElementsAre("waves.npy", "code.npy", "one.npy", "none.npy", "a.txt"));
  const NpzValues read = read_npz_array(file, "waves");
  EXPECT_EQ(read.shape_text(), "(2, 3)");
  const auto values = read.complex_numbers();
  ASSERT_EQ(values.size(), waves.size());
  for (std::size_t i = 0; i < waves.size(); ++i) EXPECT_EQ(values[i], std::complex<double>(waves[i]));
  EXPECT_THAT(read_npz_array(file, "code").numbers(), testing::ElementsAre(7, -1, 1099511627776.0));
  EXPECT_THAT(read_npz_array(file, "one").numbers(), testing::ElementsAre(0.1));
  EXPECT_THAT(read_npz_array(file, "none").numbers(), testing::IsEmpty());
  EXPECT_EQ(read_npz_text(file, "a.txt"), "text");
}

// As numpy.lib.format writes them: versions 1 to 3, keys in any order, a type of a single number.
TEST(Npz, ReadsTheHeadersOfNumpy) {
  const auto header = [](char version, const std::string& text) {
    std::string bytes = std::string("\x93NUMPY") + version + '\0' + static_cast<char>(text.size());
    bytes += std::string(version == 1 ? 1 : 3, '\0');
    return bytes + text;
  };
  const std::string usual = "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 40), }     \n";
  for (const char version : {'\x01', '\x02', '\x03'}) {
    const NpyHeader read = read_npy_header(header(version, usual) + "data");
    EXPECT_EQ(read.type, "<f4");
    EXPECT_THAT(read.shape, testing::ElementsAre(3, 40));
    EXPECT_EQ(read.bytes, (version == 1 ? 10 : 12) + usual.size());
  }
  EXPECT_THAT(read_npy_header(header(1, "{\"shape\": (5,), \"fortran_order\": False, \"descr\": \"<i8\"}")).shape,
              testing::ElementsAre(5));
  const auto refused = [&](const std::string& bytes) { return refusal_of([&] { read_npy_header(bytes); }); };
  EXPECT_HAS(refused(header(1, "{'descr': '<f4', 'fortran_order': True, 'shape': (3, 4), }")), "Fortran order");
  for (const char* text :
       {"{'descr': '<f4', 'shape': (3, 4), }", "{'descr': '<f4', 'fortran_order': False, 'shape': (3,",
        "{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (3,), }", "", "{",
        "{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (-3,), }"})
    EXPECT_HAS(refused(header(1, text)), "no header of NumPy's .npy format") << text;
  for (const char* bytes : {"", "\x93NUMPY", "\x93NUMPY\x01", "NUMPY", "\x93NUMPY\x09\x01xx"})
    EXPECT_HAS(refused(bytes), "no header of NumPy's .npy format");
}

TEST(Npz, RefusesWhatIsNoArrayOfItsShape) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.npz";
  const std::string values = bytes_of(std::vector<double>{1, 2, 3, 4, 5, 6});
  // As a text, so that the bytes need not be those of the shape.
  const auto write = [&](const std::string& type, const std::vector<std::uint64_t>& shape) {
    write_npz(file, {}, {{"x.npy", npy_header(type, shape) + values}});
    return refusal_of([&] { read_npz_array(file, "x"); });
  };
  EXPECT_EQ(write("<f8", {6}), "accepted");
  EXPECT_EQ(write("<f8", {2, 3}), "accepted");
  EXPECT_EQ(write("<f8", {5}), file.string() + ": array x: 48 bytes of values for (5,) of <f8");
  EXPECT_HAS(write("<f8", {7}), "48 bytes of values");
  EXPECT_HAS(write("<f8", {0}), "48 bytes of values");
  EXPECT_HAS(write("<f8", {1ULL << 63, 2, 6}), "48 bytes of values");
  EXPECT_HAS(write("|O", {6}), "no array of numbers");
  EXPECT_EQ(write(">f8", {6}), "accepted");
  EXPECT_HAS(refusal_of([&] { read_npz_array(file, "x").numbers(); }), "type >f8: must be <f4");
  EXPECT_HAS(refusal_of([&] { read_npz_array(file, "x").complex_numbers(); }), "must be <c8 or <c16");
  EXPECT_HAS(refusal_of([&] { read_npz_array(file, "y"); }), "array y: is missing");
}

TEST(Npz, RefusesADamagedArchive) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.npz";
  write_npz(file, {npz_array("x", "<f8", {100}, std::string(800, 'a'))});
  const std::string bytes = read_file(file);
  for (std::size_t length = 0; length < bytes.size(); length += 7) {
    write_file(file, bytes.substr(0, length));
    EXPECT_HAS(refusal_of([&] { read_npz_array(file, "x"); }), "no .npz archive of NumPy, or truncated");
    EXPECT_HAS(refusal_of([&] { npz_members(file); }), "truncated");
  }
  std::string changed = bytes;
  changed[changed.find("aaaa") + 400] = 'b';
  write_file(file, changed);
  EXPECT_HAS(refusal_of([&] { read_npz_array(file, "x"); }), "array x: is damaged");
}

namespace fs = std::filesystem;

// A directory of its own for every test, removed afterwards.
class ShardFile : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const fs::path directory_ = folder_.path(), file_ = directory_ / "shard_00000.h5";
};

Shard some_shard(bool complex_values = false, bool echoes = false) {
  Shard shard;
  shard.axes.range_m = {-2, -1, 0, 1, 2};
  shard.axes.velocity_mps = {-1, 0, 1};
  Random random({1, Stream::kTest, 7});
  for (int i = 0; i < 4; ++i) {
    Sample sample;
    sample.record.sample = 40 + i;
    sample.record.label = i % 2;
    sample.record.target_name = i % 2 == 1 ? "ship" : "array";
    sample.record.significant_wave_height_m = 0.1 * i;
    sample.record.centres = i;
    for (std::size_t k = 0; k < shard.axes.cells(); ++k)
      sample.magnitude.push_back(static_cast<float>(random.uniform()));
    for (std::size_t k = 0; complex_values && k < 2 * shard.axes.cells(); ++k)
      sample.complex_values.push_back(static_cast<float>(random.normal()));
    for (int k = 0; echoes && k < 16 * 3 * 2; ++k) sample.echo.push_back(random.normal());
    for (int k = 0; k < 16; ++k) sample.hop_code.push_back(static_cast<std::uint16_t>(random.below(8)));
    for (int k = 0; k < i; ++k) sample.centre_list.push_back({1.0f * static_cast<float>(k), 0.5f, 2.0f});
    shard.samples.push_back(std::move(sample));
  }
  return shard;
}

void expect_equal(const Shard& a, const Shard& b) {
  EXPECT_EQ(a.axes, b.axes);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(a.samples[i].magnitude, b.samples[i].magnitude);
    EXPECT_EQ(a.samples[i].complex_values, b.samples[i].complex_values);
    EXPECT_EQ(a.samples[i].echo, b.samples[i].echo);
    EXPECT_EQ(a.samples[i].hop_code, b.samples[i].hop_code);
    EXPECT_EQ(a.samples[i].centre_list, b.samples[i].centre_list);
    for (const SampleColumn& column : sample_columns()) {
      std::visit(
          [&](auto member) { EXPECT_EQ(a.samples[i].record.*member, b.samples[i].record.*member) << column.name; },
          column.member);
    }
  }
}

std::string message_of(const fs::path& file) {
  return refusal_of([&] { read_shard(file); });
}

TEST_F(ShardFile, IsReadAsItWasWritten) {
  for (const bool complex_values : {false, true}) {
    for (const bool echoes : {false, true}) {
      write_shard(file_, some_shard(complex_values, echoes), 8);
      expect_equal(read_shard(file_), some_shard(complex_values, echoes));
    }
  }
  EXPECT_FALSE(fs::exists(directory_ / "shard_00000.h5.tmp"));
}

TEST_F(ShardFile, HasTheSameBytesWheneverAndWhereverItIsWritten) {
  write_shard(file_, some_shard(), 8);
  const std::string first = sha256_file(file_);
  fs::create_directories(directory_ / "elsewhere");
  write_shard(directory_ / "elsewhere" / "another_name.h5", some_shard(), 8);
  EXPECT_EQ(sha256_file(directory_ / "elsewhere" / "another_name.h5"), first);
  // A time stamp of whole seconds would differ after one second.
  timespec pause{1, 100000000};
  nanosleep(&pause, nullptr);
  write_shard(file_, some_shard(), 8);
  EXPECT_EQ(sha256_file(file_), first);
}

TEST_F(ShardFile, IsReadFromItsOwnBytesWhileAnotherIsOpen) {
  Shard other = some_shard();
  other.samples[0].magnitude[0] = 7;
  write_shard(file_, some_shard(), 8);
  write_shard(directory_ / "other.h5", other, 8);
  const Hdf5Reader first(load_shard(file_).image), second(load_shard(directory_ / "other.h5").image);
  EXPECT_EQ(first.read<float>("/maps", 3).values[0], some_shard().samples[0].magnitude[0]);
  EXPECT_EQ(second.read<float>("/maps", 3).values[0], 7);
}

TEST_F(ShardFile, IsRefusedWithItsNameWhenTruncated) {
  write_shard(file_, some_shard(), 8);
  const std::uintmax_t size = fs::file_size(file_);
  for (const std::uintmax_t kept : {std::uintmax_t{0}, std::uintmax_t{7}, size / 4, size / 2, size - 1}) {
    fs::resize_file(file_, kept);
    EXPECT_HAS(message_of(file_), "shard_00000.h5: ") << kept << " of " << size << " bytes";
  }
}

TEST_F(ShardFile, IsRefusedWhenAnyByteOfAMapIsChanged) {
  write_shard(file_, some_shard(), 8);
  std::string bytes = read_file(file_);
  // The second sample's map as stored in the file.
  const Shard shard = some_shard();
  const std::string map(reinterpret_cast<const char*>(shard.samples[1].magnitude.data()),
                        shard.axes.cells() * sizeof(float));
  const std::size_t place = bytes.find(map);
  ASSERT_NE(place, std::string::npos);
  bytes[place + 13] = static_cast<char>(bytes[place + 13] ^ 1);
  write_file(file_, bytes);
  EXPECT_HAS(message_of(file_), "/maps is damaged");
}

TEST_F(ShardFile, NeverCrashesTheReaderWhateverByteIsChanged) {
  write_shard(file_, some_shard(), 8);
  const std::string bytes = read_file(file_);
  int refused = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random({2, Stream::kTest, static_cast<std::uint64_t>(trial)});
    std::string changed = bytes;
    const std::size_t place = random.bits() % bytes.size();
    changed[place] = static_cast<char>(changed[place] ^ (1 << random.below(8)));
    std::ofstream(file_, std::ios::binary) << changed;
    if (message_of(file_) != "accepted") ++refused;
  }
  // Padding between the objects of the file has no checksum of its own; the manifest's SHA-256 includes it.
  EXPECT_GT(refused, kTrials / 10);
}

TEST_F(ShardFile, NamesMissingContents) {
  EXPECT_HAS(message_of(directory_ / "none.h5"), "none.h5: no such shard");
  write_file(file_, "this is text");
  EXPECT_HAS(message_of(file_), "not a whole HDF5 file");
}

TEST_F(ShardFile, LeavesNoFileWhenWritingFails) {
  EXPECT_THROW(write_shard(directory_ / "absent" / "shard_00000.h5", some_shard(), 8), WorkError);
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST(Checksum, EqualsThePublishedDigest) {
  // FIPS 180-4 example "abc".
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

// Columns of drawn values: units by the key, and what is written is read.

TEST(DrawnColumns, HaveTheUnitOfTheirKey) {
  const std::pair<const char*, const char*> units[] = {
      {"sea.peak_period_s", "s"},
      {"targets.a.motion.yaw_rate_std_deg_s", "deg/s"},
      {"targets.a.motion.speed_mps", "m/s"},
      {"targets.a.layout.line.spacing_m", "m"},
      {"view.azimuth_deg", "deg"},
      {"clutter.scr_db", "dB"},
      {"sea_reflection.salinity_psu", "psu"},
      {"targets.a.sheet_thickness_mm", "mm"},
      {"radar.pri_jitter_us", "us"},
      {"targets.a.layout.line.count", "1"},
      {"sea.spreading.s", "1"},
      {"sea.gamma", "1"},
  };
  for (const auto& [key, unit] : units) EXPECT_EQ(drawn_text(key).units, unit) << key;
}

SampleRecord record_of(double period, const std::string& code) {
  SampleRecord record;
  record.drawn_numbers = {{"sea.peak_period_s", period}, {"targets.a-1.layout.line.count", 3}};
  record.drawn_words = {{"radar.hop_code", code}};
  return record;
}

TEST(DrawnColumns, AreReadAsWritten) {
  const std::vector<SampleRecord> rows{record_of(7.25, "random"), record_of(8.5, "balanced"),
                                       record_of(0.1, "stepped")};
  const TemporaryFolder folder;
  Hdf5Writer file(folder.path() / "a.h5", Hdf5Version::k18);
  const auto write = [&](std::size_t first, std::size_t count) {
    const StoredColumns columns = stored_columns(std::span(rows).subspan(first, count), default_classes());
    if (first == 0) {
      file.group("/samples");
      for (const StoredColumn& column : columns.samples) create_column(file, column, rows.size(), 2);
      create_drawn(file, columns, rows.size(), 2);
    }
    for (const auto* part : {&columns.samples, &columns.drawn})
      for (const StoredColumn& column : *part) write_column(file, column, first);
  };
  write(0, 2);
  write(2, 1);
  file.close();
  const Hdf5Reader reader(folder.path() / "a.h5");
  EXPECT_EQ(read_drawn_keys(reader), drawn_keys(rows[0]));
  const std::vector<SampleRecord> read = read_rows(reader, 1, 2);
  EXPECT_EQ(differing_column(read[0], rows[1]), "");
  EXPECT_EQ(differing_column(read[1], rows[2]), "");
  EXPECT_EQ(differing_column(read[0], rows[2]), "a drawn value");
  EXPECT_THROW(read_rows(reader, 2, 2), WorkError);
}

TEST(DrawnColumns, OfAFileWithoutThemAreNone) {
  const TemporaryFolder folder;
  Hdf5Writer file(folder.path() / "a.h5", Hdf5Version::k18);
  create_drawn(file, stored_columns(std::vector<SampleRecord>(1), default_classes()), 1, 1);
  file.close();
  EXPECT_EQ(read_drawn_keys(Hdf5Reader(folder.path() / "a.h5")), DrawnKeys());
}

TEST(DrawnColumns, WithAPathForAKeyAreRefused) {
  for (const char* key : {"../samples/label", "a/b", ".", "sea.\x01"}) {
    const TemporaryFolder folder;
    Hdf5Writer file(folder.path() / "a.h5", Hdf5Version::k18);
    file.attribute("drawn_numbers", key);
    file.close();
    const Hdf5Reader reader(folder.path() / "a.h5");
    EXPECT_THROW(read_drawn_keys(reader), WorkError) << key;
  }
}

}  // namespace
}  // namespace seaglint
