// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/field_tables/field_formats.h"
#include "sim/field_tables/field_table.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// One point scatterer as other programs export it (tests/cases/exports/write_exports.py): every amplitude, direction
// and transmitter against its closed form.

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
  EXPECT_HAS(refusal_of([&] { read("monostatic.ffe", settings); }),
             "monostatic.ffe: is monostatic: remove --incidence");
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
      EXPECT_HAS(what, name());
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
  const std::string file = "hfss VP.csv", text = read_file(kFolder / file);
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

const std::filesystem::path kPyaedtFolder = std::filesystem::path(SEAGLINT_SOURCE_DIR) / "tests/cases/exports";

// The message with which a file is refused, which is all that is said.
std::string refusal(const std::filesystem::path& file, const FieldTableSettings& settings = {}) {
  testing::internal::CaptureStderr();
  std::string message = "read";
  try {
    read_field_table(file, settings);
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return message;
}

std::string json_with(const std::string& file, const std::string& unit) {
  return R"({"monostatic_file": )" + file + R"(, "frequency_units": )" + unit + "}";
}

TEST(PyaedtFile, IsRefusedWithWhatIsWrongInItsJson) {
  const TemporaryFolder folder;
  const std::filesystem::path json = folder.path() / "a.json";
  const auto refused = [&](const std::string& text) {
    write_file(json, text);
    return refusal(json);
  };
  EXPECT_HAS(refused(json_with("\"../a.h5\"", "\"GHz\"")), "must be the name of a file in the same folder");
  EXPECT_HAS(refused(json_with("\"\"", "\"GHz\"")), "must be the name of a file in the same folder");
  EXPECT_HAS(refused(json_with("7", "\"GHz\"")), "monostatic_file 7: must be");
  EXPECT_HAS(refused(json_with("null", "\"GHz\"")), "only the geometry was exported");
  EXPECT_HAS(refused(json_with("\"a.h5\"", "\"GHz\"")), "'a.h5': no such HDF5 file beside it");
  EXPECT_HAS(refused(R"({"monostatic_file": "a.h5")"), "a.json: no valid JSON from byte");
  std::filesystem::copy_file(kPyaedtFolder / "pyaedt_VV.h5", folder.path() / "a.h5");
  EXPECT_HAS(refused(json_with("\"a.h5\"", "\"GHz\"")), "a.json: does not say its polarisation");
  EXPECT_HAS(refused(R"({"monostatic_file": "a.h5"})"), "does not say its polarisation");
}

TEST(PyaedtFile, TakesItsPolarisationFromTheSettingsAndItsUnitFromTheJson) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(kPyaedtFolder / "pyaedt_VV.h5", folder.path() / "a.h5");
  FieldTableSettings hh;
  hh.elements = {Polarisation::kHh};
  EXPECT_HAS(refusal(folder.path() / "a.h5", hh), "a JSON beside it whose monostatic_file is 'a.h5'");
  write_file(folder.path() / "a.json", json_with("\"other.h5\"", "\"GHz\""));
  write_file(folder.path() / "b.json", json_with("\"a.h5\"", "\"cycles\""));
  EXPECT_HAS(refusal(folder.path() / "a.h5", hh), "b.json: frequency_units \"cycles\": must be GHz");
  write_file(folder.path() / "b.json", json_with("\"a.h5\"", "\"Hz\""));
  const FieldTable table = read_field_table(folder.path() / "a.h5", hh);
  EXPECT_EQ(table.cuts.at(0).element, Polarisation::kHh);
  EXPECT_EQ(table.cuts[0].values.at(0).frequency_hz, 9.5);
  FieldTableSettings vv;
  vv.elements = {Polarisation::kVv};
  EXPECT_HAS(refusal(kPyaedtFolder / "pyaedt_VH.json", vv), "is vh by its name, which is not wanted");
}

// PyAEDT puts the meshes of model_info into the folder geometry beside the JSON.
TEST(PyaedtFile, NamesItsGeometryWithUnits) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(kPyaedtFolder / "pyaedt_VV.h5", folder.path() / "VV_data_x.h5");
  const auto read = [&](const std::string& model) {
    write_file(folder.path() / "VV_x.json",
               R"({"solution": "x", "monostatic_file": "VV_data_x.h5", "model_units": "mm", "frequency_units": "GHz",)"
               R"( "model_info": )" +
                   model + "}");
    return read_field_table(folder.path() / "VV_x.json", {});
  };
  const std::string model =
      R"({"hull": ["hull.obj", [143, 175, 143], 1.0, "mm"], "mast": ["mast.obj", [143, 0, 0], 0.5, "meter"]})";
  const FieldTable missing = read(model);
  EXPECT_THAT(missing.geometry, testing::IsEmpty());
  EXPECT_HAS(reading_of(missing), "its geometry is not used: 'hull': no file 'hull.obj' beside the JSON");
  std::filesystem::create_directory(folder.path() / "geometry");
  write_file(folder.path() / "geometry/hull.obj", "");
  EXPECT_THAT(read(model).geometry, testing::IsEmpty()) << "the hull alone is another model";
  write_file(folder.path() / "mast.obj", "");
  const FieldTable table = read(model);
  ASSERT_EQ(table.geometry.size(), 2u);
  EXPECT_EQ(table.geometry[0], (GeometryFile{folder.path() / "geometry/hull.obj", "mm"}));
  EXPECT_EQ(table.geometry[1], (GeometryFile{folder.path() / "mast.obj", "m"}));
  EXPECT_EQ(read_field_table(folder.path() / "VV_data_x.h5", {}).geometry, table.geometry);
  EXPECT_HAS(reading_of(read(R"({"hull": ["hull.obj", [1, 2, 3], 1.0, "acre"]})")),
             "'hull': unit \"acre\": must be meter, mm, cm, km, in or ft");
  EXPECT_HAS(reading_of(read(R"({"hull": ["../hull.obj", [1, 2, 3], 1.0, "mm"]})")),
             "'hull': must be [mesh file, colour, opacity, unit]");
  EXPECT_THAT(reading_of(read("[]")), testing::Not(HasSubstr("geometry")));
}

TEST(PyaedtFile, ThatIsCutOffIsRefused) {
  const TemporaryFolder folder;
  const std::string whole = read_file(kPyaedtFolder / "pyaedt_VV.h5");
  write_file(folder.path() / "pyaedt_VV.json", read_file(kPyaedtFolder / "pyaedt_VV.json"));
  for (std::size_t bytes = 8; bytes < whole.size(); bytes += 97) {
    write_file(folder.path() / "pyaedt_VV.h5", whole.substr(0, bytes));
    EXPECT_HAS(refusal(folder.path() / "pyaedt_VV.json"), "pyaedt_VV.h5: not a whole HDF5 file");
  }
}

// Bytes anywhere in the table: refused in one message, or read with all rows, at most one of which differs where the
// byte belongs to a value. SEAGLINT_MUTATIONS changes (300).
TEST(PyaedtFile, WithAChangedByteIsRefusedOrReadAsItStands) {
  const char* count = std::getenv("SEAGLINT_MUTATIONS");
  const TemporaryFolder folder;
  const std::string whole = read_file(kPyaedtFolder / "pyaedt_VV.h5");
  write_file(folder.path() / "pyaedt_VV.json", read_file(kPyaedtFolder / "pyaedt_VV.json"));
  const std::vector<FieldValue> original = read_field_table(kPyaedtFolder / "pyaedt_VV.json", {}).cuts.at(0).values;
  Random random({14, Stream::kTest, 0});
  int refused = 0, changed = 0;
  for (int n = 0; n < (count == nullptr ? 300 : std::atoi(count)); ++n) {
    std::string bytes = whole;
    bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] = static_cast<char>(random.below(256));
    std::ofstream(folder.path() / "pyaedt_VV.h5", std::ios::binary | std::ios::trunc) << bytes;
    std::optional<FieldTable> table;
    try {
      table = read_field_table(folder.path() / "pyaedt_VV.json", {});
    } catch (const InputError& error) {
      EXPECT_HAS(error.what(), "pyaedt_VV");
      ++refused;
      continue;
    }
    const std::vector<FieldValue>& values = table->cuts.at(0).values;
    ASSERT_EQ(values.size(), original.size());
    int differing = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_TRUE(std::isfinite(values[i].level_dbsm));
      differing += values[i].amplitude_m != original[i].amplitude_m || values[i].theta_deg != original[i].theta_deg ||
                   values[i].phi_deg != original[i].phi_deg || values[i].frequency_hz != original[i].frequency_hz;
    }
    EXPECT_LE(differing, 1);
    changed += differing;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(changed, 0);
}

// HDF5 1.10 follows the list of the second file without end.
TEST(LocalHeaps, WhoseFreeListIsACircleAreFound) {
  EXPECT_TRUE(has_sound_heaps(kPyaedtFolder / "pyaedt_VH.h5"));
  EXPECT_TRUE(has_sound_heaps(kPyaedtFolder / "pyaedt_VV.h5"));
  EXPECT_FALSE(has_sound_heaps(SEAGLINT_SOURCE_DIR "/tests/fuzz/inputs/pyaedt/heap_circle.h5"));
}

}  // namespace
}  // namespace seaglint
