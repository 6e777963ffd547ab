// SPDX-License-Identifier: BSD-3-Clause
// One point scatterer as other programs export it (tests/cases/exports/write_exports.py): every amplitude, direction
// and transmitter against its closed form.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/field_tables/field_table.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::filesystem::path kFolder = std::filesystem::path(SEAGLINT_SOURCE_DIR) / "tests/cases/exports";
const Vec3 kPlace(0.31, -0.2, 0.05);

Complex matrix_element(Polarisation element) {
  const Complex elements[] = {{1, 0}, {0, 0.2}, {0, 0.2}, {-0.5, 0.3}};
  return elements[static_cast<int>(element)];
}

Vec3 direction(double theta_deg, double phi_deg) {
  const double theta = radians(theta_deg), phi = radians(phi_deg);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// About the cut's phase origin.
Complex exact(const RcsCut& cut, const FieldValue& value) {
  const Vec3 receiver = direction(value.theta_deg, value.phi_deg);
  const Vec3 transmitter =
      cut.transmitter->is_monostatic ? receiver : direction(cut.transmitter->theta_deg, cut.transmitter->phi_deg);
  const double k = 2 * kPi * value.frequency_hz / kSpeedOfLight;
  return matrix_element(cut.element) * std::polar(1.0, k * (receiver + transmitter).dot(kPlace - cut.origin_m));
}

// relative: printed digits of magnitude and phase.
void expect_exact(const FieldTable& table, double relative) {
  for (const RcsCut& cut : table.cuts) {
    ASSERT_TRUE(cut.transmitter);
    for (const FieldValue& value : cut.values) {
      const Complex wanted = exact(cut, value);
      EXPECT_NEAR(value.level_dbsm, dbsm(wanted), 8.7 * relative) << table.name << ":" << value.line;
      const Complex amplitude = value.amplitude_m.value_or(wanted);
      EXPECT_LT(std::abs(amplitude - wanted), relative * std::abs(wanted)) << table.name << ":" << value.line;
    }
  }
}

FieldTable read(const char* name, const FieldTableSettings& settings = {}) {
  return read_field_table(kFolder / name, settings);
}

FieldTableSettings monostatic(std::vector<Polarisation> elements) {
  FieldTableSettings settings;
  settings.elements = std::move(elements);
  settings.transmitter.emplace();
  return settings;
}

std::vector<Polarisation> elements_of(const FieldTable& table) {
  std::vector<Polarisation> elements;
  for (const RcsCut& cut : table.cuts) elements.push_back(cut.element);
  return elements;
}

TEST(Exports, OfCstTakeFrequencySweepAndPolarisationFromTheirName) {
  const FieldTable table = read("rcs (f = 9.5), theta = (85,85,1), phi = (0,30,10), VP (1) [pw].txt");
  EXPECT_THAT(elements_of(table), ElementsAre(Polarisation::kVv, Polarisation::kHv));
  EXPECT_EQ(
      reading_of(table),
      "rcs (f = 9.5), theta = (85,85,1), phi = (0,30,10), VP (1) [pw].txt: read as a CST farfield table; frequency "
      "9.5 GHz by the file's name; monostatic: the file's name has a sweep of the incident wave; VP in the file's "
      "name: v transmitted; e^{+jwt}; theta^ = -v, phi^ = h");
  ASSERT_EQ(table.cuts[0].values.size(), 4u);
  EXPECT_EQ(table.cuts[0].values[2].line, 5);
  EXPECT_TRUE(table.cuts[0].transmitter->is_monostatic);
  expect_exact(table, 2e-3);  // 0.005 dB of four digits, 6e-4, and 0.0005 deg
}

TEST(Exports, OfCstFieldsAreBistaticAndFoldedAtThePole) {
  const FieldTable table = read("farfield (f=10) theta=90 phi=0 HP [pw].txt");
  EXPECT_THAT(elements_of(table), ElementsAre(Polarisation::kVh, Polarisation::kHh));
  EXPECT_FALSE(table.cuts[0].transmitter->is_monostatic);
  EXPECT_EQ(table.cuts[0].transmitter->theta_deg, 90);
  EXPECT_EQ(table.cuts[0].values[0].phi_deg, 200);
  expect_exact(table, 1e-4);
}

TEST(Exports, OfCstInLudwigsDefinition) {
  FieldTableSettings settings = monostatic({Polarisation::kVv, Polarisation::kHv});
  settings.frequency_hz = 10e9;
  expect_exact(read("ludwig3.txt", settings), 1e-5);
}

TEST(Exports, OfCstCurvesHaveTheirPlaceInParametersAndNames) {
  const FieldTable runs = read("curves of two runs.txt", monostatic({}));
  ASSERT_THAT(elements_of(runs), ElementsAre(Polarisation::kVv));
  ASSERT_EQ(runs.cuts[0].values.size(), 6u);
  EXPECT_EQ(runs.cuts[0].values[5].theta_deg, 90);
  EXPECT_EQ(runs.cuts[0].values[5].frequency_hz, 10e9);
  expect_exact(runs, 1e-12);
  const FieldTable older = read("curve f=9.5 theta=90 HH.txt", monostatic({}));
  ASSERT_THAT(elements_of(older), ElementsAre(Polarisation::kHh));
  EXPECT_EQ(older.cuts[0].values[4].phi_deg, 40);
  expect_exact(older, 1e-8);
}

TEST(Exports, OfCstSourcesAreAboutTheirPosition) {
  FieldTableSettings settings;
  settings.elements = {Polarisation::kVv, Polarisation::kHv};
  settings.transmitter = DeclaredTransmitter{false, 90, 0};
  const FieldTable table = read("source.ffs", settings);
  ASSERT_EQ(table.cuts.size(), 2u);
  ASSERT_EQ(table.cuts[0].values.size(), 12u);
  EXPECT_EQ(table.cuts[0].origin_m, Vec3(0.1, 0, 0.02));
  expect_exact(table, 1e-7);
}

TEST(Exports, OfFekoAreMonostaticOrBistaticByTheirBlocks) {
  const FieldTable mono = read("monostatic.ffe");
  EXPECT_THAT(elements_of(mono), ElementsAre(Polarisation::kVv, Polarisation::kHv));
  EXPECT_EQ(mono.cuts[0].values.size(), 6u);
  EXPECT_TRUE(mono.cuts[0].transmitter->is_monostatic);
  expect_exact(mono, 1e-7);
  const FieldTable bistatic = read("bistatic.ffe");
  EXPECT_EQ(bistatic.cuts.size(), 4u);
  EXPECT_EQ(bistatic.cuts[2].transmitter->phi_deg, 40);
  expect_exact(bistatic, 1e-7);
}

TEST(Exports, OfHfssHaveColumnsOrFamilies) {
  const FieldTable table = read("hfss VP.csv");
  EXPECT_THAT(elements_of(table), ElementsAre(Polarisation::kVv, Polarisation::kHv));
  EXPECT_TRUE(table.cuts[0].has_phase());
  EXPECT_FALSE(table.cuts[1].has_phase());
  expect_exact(table, 1e-12);
  FieldTableSettings hh;
  hh.elements = {Polarisation::kHh};
  const FieldTable families = read("hfss families HP.csv", hh);
  ASSERT_EQ(families.cuts[0].values.size(), 6u);
  EXPECT_EQ(families.cuts[0].values[3].theta_deg, 90);
  expect_exact(families, 1e-12);
}

TEST(Exports, OfPyaedtAreReadByEitherFile) {
  const FieldTable vv = read("pyaedt_VV.json");
  EXPECT_EQ(reading_of(vv),
            "pyaedt_VV.json: read as an export of PyAEDT; e^{+jwt}; theta^ = -v, phi^ = h; monostatic; vv by the "
            "file's name (received, transmitted)");
  ASSERT_THAT(elements_of(vv), ElementsAre(Polarisation::kVv));
  ASSERT_EQ(vv.cuts[0].values.size(), 12u);
  EXPECT_EQ(vv.cuts[0].values[11].frequency_hz, 10e9);
  EXPECT_EQ(vv.cuts[0].values[11].phi_deg, 200);
  EXPECT_EQ(vv.cuts[0].values[11].theta_deg, 90);
  expect_exact(vv, 1e-12);
  const FieldTable vh = read("pyaedt_VH.h5");  // MHz
  ASSERT_THAT(elements_of(vh), ElementsAre(Polarisation::kVh));
  EXPECT_EQ(vh.cuts[0].values[0].frequency_hz, 9.5e9);
  expect_exact(vh, 1e-12);
}

TEST(Exports, ThatContradictTheSettingsAreRefused) {
  FieldTableSettings settings;
  settings.frequency_hz = 5e9;
  EXPECT_THROW(read("monostatic.ffe", settings), InputError);
  settings = {};
  settings.transmitter = DeclaredTransmitter{false, 90, 0};
  EXPECT_THAT(refusal_of([&] { read("monostatic.ffe", settings); }),
              HasSubstr("monostatic.ffe: is monostatic: remove --incidence"));
}

// Exports that are cut off, have their columns in another order or a digit changed: refused with the file's line, or
// read as they stand. SEAGLINT_MUTATIONS changes of each kind and file (300).

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
