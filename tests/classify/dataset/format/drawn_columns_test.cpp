// SPDX-License-Identifier: BSD-3-Clause
// Columns of drawn values: units by the key, and what is written is read.
#include "classify/dataset/format/layout.h"

#include <gtest/gtest.h>

#include "sim/core/process/error.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

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
  const SampleRecord a = record_of(7.25, "random"), b = record_of(8.5, "balanced"), c = record_of(0.1, "stepped");
  const TemporaryFolder folder;
  Hdf5Writer file(folder.path() / "a.h5", Hdf5Version::k18);
  create_drawn(file, drawn_keys(a), 3, 2);
  write_drawn(file, 0, {&a, &b});
  write_drawn(file, 2, {&c});
  file.close();
  const Hdf5Reader reader(folder.path() / "a.h5");
  EXPECT_EQ(read_drawn_keys(reader), drawn_keys(a));
  SampleRecord first, second;
  read_drawn(reader, 1, {&first, &second});
  EXPECT_TRUE(same_drawn(first, b));
  EXPECT_TRUE(same_drawn(second, c));
  EXPECT_FALSE(same_drawn(first, c));
  SampleRecord beyond, last;
  EXPECT_THROW(read_drawn(reader, 2, {&last, &beyond}), WorkError);
}

TEST(DrawnColumns, OfAFileWithoutThemAreNone) {
  const TemporaryFolder folder;
  Hdf5Writer file(folder.path() / "a.h5", Hdf5Version::k18);
  create_drawn(file, {}, 3, 3);
  file.close();
  EXPECT_TRUE(read_drawn_keys(Hdf5Reader(folder.path() / "a.h5")).empty());
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
