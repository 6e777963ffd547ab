// SPDX-License-Identifier: BSD-3-Clause
// `seaglint mesh sensitivity`: the echo on other meshes of the same surface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

// Numbers of the table, one row per view.
std::vector<std::vector<double>> rows_of(const std::string& table) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#") || line.find("azimuth_deg") != std::string::npos) continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (double cell; cells >> cell;) rows.back().push_back(cell);
  }
  return rows;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

enum Column { kAzimuth, kElevation, kHh, kVv, kCut, kCutFloat, kRenumbered, kTurned, kMoved, kNoise, kFlat, kColumns };

class MeshSensitivityCommand : public testing::Test {
 protected:
  std::string made(const std::string& what) const {
    std::string file = folder_.path() / "mesh.glb";
    EXPECT_EQ(run_program(words("mesh make " + what + " -o " + file)).code, 0);
    return file;
  }
  ProgramResult sensitivity(const std::string& file, const std::string& more) const {
    return run_program(words("mesh sensitivity --target " + file + " --frequency-ghz 10 " + more));
  }

  TemporaryFolder folder_;
};

// A trihedral has no smooth facets. Noise of sigma on a plate changes the phase by 2 k sigma / sqrt(2) and less: at
// most three reflections by planes through noisy corners, 6 k sigma.
TEST_F(MeshSensitivityCommand, OfATrihedralIsThatOfTheNoise) {
  const std::string file = made("trihedral --leg-m 0.4");
  const ProgramResult result = sensitivity(file, "--azimuth-deg 30:60:15 --elevation-deg 35 --noise-um 20");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = rows_of(result.out);
  ASSERT_EQ(rows.size(), 3u);
  constexpr double kNoisePhase = 6 * 209.6 * 20e-6;  // k at 10 GHz
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), static_cast<std::size_t>(kColumns));
    for (const Column column : {kCut, kCutFloat, kRenumbered, kTurned, kMoved, kFlat}) EXPECT_LT(row[column], 1e-3);
    EXPECT_GT(row[kNoise], 0);
    EXPECT_LT(row[kNoise], kNoisePhase);
  }
  EXPECT_EQ(rows[1][kAzimuth], 45);
  EXPECT_EQ(rows[1][kElevation], 35);
}

// Flat facets of 1.7 cm on a sphere of 0.3 m: 1.5 dB at ka 63.
TEST_F(MeshSensitivityCommand, ShowsWhereSmoothAndFlatFacetsDiffer) {
  const std::string file = made("sphere --radius-m 0.3 --subdivisions 3");
  const ProgramResult result = sensitivity(file, "--azimuth-deg 11 --elevation-deg 23");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = rows_of(result.out);
  ASSERT_EQ(rows.size(), 1u);
  for (const Column column : {kCut, kRenumbered, kTurned, kMoved}) EXPECT_LT(rows[0][column], 0.02);
  EXPECT_GT(rows[0][kFlat], 0.1);
}

TEST_F(MeshSensitivityCommand, IsTheSameForOneAndTwoThreads) {
  const std::string file = made("reflector");
  const auto table = [&](const char* threads) {
    return sensitivity(file, "--azimuth-deg 0:40:20 --threads " + std::string(threads)).out;
  };
  EXPECT_FALSE(rows_of(table("1")).empty());
  EXPECT_EQ(table("1"), table("2"));
}

}  // namespace
}  // namespace seaglint
