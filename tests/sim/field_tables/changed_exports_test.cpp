// SPDX-License-Identifier: BSD-3-Clause
// Exports that are cut off, have their columns in another order or a digit changed: refused with the file's line, or
// read as they stand. SEAGLINT_MUTATIONS changes of each kind and file (300).
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/field_tables/read_field_table.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(SEAGLINT_SOURCE_DIR) / "tests/cases/exports";

// Without waiting for the disk, as write_file() does.
void overwrite(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

int mutations() {
  const char* text = std::getenv("SEAGLINT_MUTATIONS");
  return text == nullptr ? 300 : std::atoi(text);
}

// Values by element, incident wave and line: level and amplitude.
using Values = std::map<std::tuple<int, double, int, double>, std::pair<double, Complex>>;

Values values_of(const FieldTable& table) {
  Values values;
  for (const RcsCut& cut : table.cuts) {
    for (const FieldValue& v : cut.values) {
      const double incident = cut.transmitter->is_monostatic ? -1 : cut.transmitter->phi_deg;
      values[{static_cast<int>(cut.element), incident, v.line, v.frequency_hz + v.theta_deg + v.phi_deg}] = {
          v.level_dbsm, v.amplitude_m.value_or(0)};
    }
  }
  return values;
}

class ChangedExports : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    settings_.elements = {Polarisation::kVv, Polarisation::kHv};
    if (name().find("HH") != std::string::npos) settings_.elements = {Polarisation::kHh};
    if (name().find("HP") != std::string::npos) settings_.elements = {Polarisation::kHh};
    if (name().find("curves") != std::string::npos) settings_.elements = {Polarisation::kVv};
    if (name().starts_with("ludwig") || name().starts_with("chamber")) settings_.frequency_hz = 10e9;
    if (name().starts_with("chamber")) settings_.elements = {Polarisation::kHh, Polarisation::kVv};
    if (name().ends_with(".ffs")) settings_.transmitter = DeclaredTransmitter{false, 90, 0};
    if (name().starts_with("ludwig") || name().starts_with("curve")) settings_.transmitter.emplace();
    text_ = read_file(kFolder / name());
    original_ = values_of(read_field_table(kFolder / name(), settings_));
  }
  static std::string name() { return GetParam(); }

  // Empty where it is refused, with the file's name and, unless nothing is left of it, a line.
  std::optional<FieldTable> read(const std::string& text) const {
    overwrite(folder_.path() / name(), text);
    try {
      return read_field_table(folder_.path() / name(), settings_);
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_THAT(what, testing::HasSubstr(name()));
      return std::nullopt;
    }
  }

  FieldTableSettings settings_;
  std::string text_;
  Values original_;
  TemporaryFolder folder_;
};

TEST_P(ChangedExports, ThatAreCutOffAreRefusedOrReadUpToThere) {
  Random random({11, Stream::kTest, 0});
  for (int n = 0; n < mutations(); ++n) {
    const std::size_t length = random.below(static_cast<std::uint32_t>(text_.size()));
    const std::optional<FieldTable> table = read(text_.substr(0, length));
    if (!table) continue;
    const bool warned = std::any_of(table->notes.begin(), table->notes.end(), [](const std::string& note) {
      return note.find("the last line has no end") != std::string::npos;
    });
    const Values values = values_of(*table);
    const int last =
        static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(length), '\n')) + 1;
    for (const auto& [place, value] : values) {
      if (warned && std::get<2>(place) == last) continue;
      const auto whole = original_.find(place);
      ASSERT_TRUE(whole != original_.end()) << "a value of its own after " << length << " bytes";
      EXPECT_EQ(whole->second, value) << length << " bytes";
    }
  }
}

TEST_P(ChangedExports, WithAnotherDigitAreReadAsTheyStand) {
  Random random({12, Stream::kTest, 0});
  for (int n = 0; n < mutations(); ++n) {
    std::string text = text_;
    std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
    while (at < text.size() && (text[at] < '0' || text[at] > '9')) ++at;
    if (at == text.size()) continue;
    text[at] = static_cast<char>('0' + random.below(10));
    const std::optional<FieldTable> table = read(text);
    if (!table) continue;
    // A row differs where the digit stands; what is above the rows may change all of them, but not their number.
    const int line =
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + 1;
    const bool in_rows = std::any_of(original_.begin(), original_.end(),
                                     [&](const auto& entry) { return std::get<2>(entry.first) == line; });
    std::size_t count = 0;
    for (const RcsCut& cut : table->cuts) count += cut.values.size();
    if (!in_rows) continue;
    EXPECT_EQ(count, original_.size());
    for (const auto& [place, value] : values_of(*table)) {
      if (std::get<2>(place) == line) continue;
      const auto same = original_.find(place);
      ASSERT_TRUE(same != original_.end());
      EXPECT_EQ(same->second, value);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Files, ChangedExports,
                         testing::Values("rcs (f = 9.5), theta = (85,85,1), phi = (0,30,10), VP (1) [pw].txt",
                                         "farfield (f=10) theta=90 phi=0 HP [pw].txt", "ludwig3.txt",
                                         "curves of two runs.txt", "curve f=9.5 theta=90 HH.txt", "source.ffs",
                                         "monostatic.ffe", "bistatic.ffe", "hfss VP.csv", "hfss families HP.csv",
                                         "hfss dBsm VP.csv", "hfss total VP.csv", "chamber_hh_vv.csv"),
                         [](const testing::TestParamInfo<const char*>& file) {
                           return std::regex_replace(std::string(file.param), std::regex("[^A-Za-z0-9]"), "_");
                         });

// Columns by name: in another order they are the same.
TEST(ShuffledColumns, AreReadByTheirNames) {
  const TemporaryFolder folder;
  const std::string file = "hfss VP.csv";
  const std::string text = read_file(kFolder / file);
  const Values original = values_of(read_field_table(kFolder / file, {}));
  Random random({13, Stream::kTest, 0});
  for (int n = 0; n < mutations(); ++n) {
    std::vector<std::size_t> order{0, 1, 2, 3, 4, 5};
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    std::string shuffled;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\n', begin);
      std::vector<std::string> cells;
      for (std::size_t at = begin; at <= end;) {
        const std::size_t comma = std::min(text.find(',', at), end);
        cells.push_back(text.substr(at, comma - at));
        at = comma + 1;
      }
      std::vector<std::string> row;
      for (const std::size_t column : order) row.push_back(cells.at(column));
      shuffled += fmt::format("{}\n", fmt::join(row, ","));
      begin = end + 1;
    }
    overwrite(folder.path() / file, shuffled);
    EXPECT_EQ(values_of(read_field_table(folder.path() / file, {})), original);
  }
}

}  // namespace
}  // namespace seaglint
