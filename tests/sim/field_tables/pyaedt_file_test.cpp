// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/field_tables/field_formats.h"
#include "sim/field_tables/field_table.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

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
  EXPECT_THAT(refused(json_with("\"../a.h5\"", "\"GHz\"")), HasSubstr("must be the name of a file in the same folder"));
  EXPECT_THAT(refused(json_with("\"\"", "\"GHz\"")), HasSubstr("must be the name of a file in the same folder"));
  EXPECT_THAT(refused(json_with("7", "\"GHz\"")), HasSubstr("monostatic_file 7: must be"));
  EXPECT_THAT(refused(json_with("null", "\"GHz\"")), HasSubstr("only the geometry was exported"));
  EXPECT_THAT(refused(json_with("\"a.h5\"", "\"GHz\"")), HasSubstr("'a.h5': no such HDF5 file beside it"));
  EXPECT_THAT(refused(R"({"monostatic_file": "a.h5")"), HasSubstr("a.json: no valid JSON from byte"));
  std::filesystem::copy_file(kPyaedtFolder / "pyaedt_VV.h5", folder.path() / "a.h5");
  EXPECT_THAT(refused(json_with("\"a.h5\"", "\"GHz\"")), HasSubstr("a.json: does not say its polarisation"));
  EXPECT_THAT(refused(R"({"monostatic_file": "a.h5"})"), HasSubstr("does not say its polarisation"));
}

TEST(PyaedtFile, TakesItsPolarisationFromTheSettingsAndItsUnitFromTheJson) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(kPyaedtFolder / "pyaedt_VV.h5", folder.path() / "a.h5");
  FieldTableSettings hh;
  hh.elements = {Polarisation::kHh};
  EXPECT_THAT(refusal(folder.path() / "a.h5", hh), HasSubstr("a JSON beside it whose monostatic_file is 'a.h5'"));
  write_file(folder.path() / "a.json", json_with("\"other.h5\"", "\"GHz\""));
  write_file(folder.path() / "b.json", json_with("\"a.h5\"", "\"cycles\""));
  EXPECT_THAT(refusal(folder.path() / "a.h5", hh), HasSubstr("b.json: frequency_units \"cycles\": must be GHz"));
  write_file(folder.path() / "b.json", json_with("\"a.h5\"", "\"Hz\""));
  const FieldTable table = read_field_table(folder.path() / "a.h5", hh);
  EXPECT_EQ(table.cuts.at(0).element, Polarisation::kHh);
  EXPECT_EQ(table.cuts[0].values.at(0).frequency_hz, 9.5);
  FieldTableSettings vv;
  vv.elements = {Polarisation::kVv};
  EXPECT_THAT(refusal(kPyaedtFolder / "pyaedt_VH.json", vv), HasSubstr("is vh by its name, which is not wanted"));
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
  EXPECT_THAT(reading_of(missing), HasSubstr("its geometry is not used: 'hull': no file 'hull.obj' beside the JSON"));
  std::filesystem::create_directory(folder.path() / "geometry");
  write_file(folder.path() / "geometry/hull.obj", "");
  EXPECT_THAT(read(model).geometry, testing::IsEmpty()) << "the hull alone is another model";
  write_file(folder.path() / "mast.obj", "");
  const FieldTable table = read(model);
  ASSERT_EQ(table.geometry.size(), 2u);
  EXPECT_EQ(table.geometry[0], (GeometryFile{folder.path() / "geometry/hull.obj", "mm"}));
  EXPECT_EQ(table.geometry[1], (GeometryFile{folder.path() / "mast.obj", "m"}));
  EXPECT_EQ(read_field_table(folder.path() / "VV_data_x.h5", {}).geometry, table.geometry);
  EXPECT_THAT(reading_of(read(R"({"hull": ["hull.obj", [1, 2, 3], 1.0, "acre"]})")),
              HasSubstr("'hull': unit \"acre\": must be meter, mm, cm, km, in or ft"));
  EXPECT_THAT(reading_of(read(R"({"hull": ["../hull.obj", [1, 2, 3], 1.0, "mm"]})")),
              HasSubstr("'hull': must be [mesh file, colour, opacity, unit]"));
  EXPECT_THAT(reading_of(read("[]")), testing::Not(HasSubstr("geometry")));
}

TEST(PyaedtFile, ThatIsCutOffIsRefused) {
  const TemporaryFolder folder;
  const std::string whole = read_file(kPyaedtFolder / "pyaedt_VV.h5");
  write_file(folder.path() / "pyaedt_VV.json", read_file(kPyaedtFolder / "pyaedt_VV.json"));
  for (std::size_t bytes = 8; bytes < whole.size(); bytes += 97) {
    write_file(folder.path() / "pyaedt_VV.h5", whole.substr(0, bytes));
    EXPECT_THAT(refusal(folder.path() / "pyaedt_VV.json"), HasSubstr("pyaedt_VV.h5: not a whole HDF5 file"));
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
      EXPECT_THAT(error.what(), HasSubstr("pyaedt_VV"));
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
