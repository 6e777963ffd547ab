// SPDX-License-Identifier: BSD-3-Clause
// Models fitted once more to all maps that are not held out (learning.refit).
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

class Refit : public testing::Test {
 protected:
  void SetUp() override {
    const ProgramResult made =
        run_program({"generate", "scenarios/points.yaml", "-o", path("data"), "--set", "radar.pulses=64"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string path(const std::string& name) const { return folder_.path() / name; }
  std::string text(const std::string& name) const { return read_file(path(name)); }

  void train(const std::string& model, const Words& options) {
    Words words{"train", path("data"), "-o", path(model), "--set", "learning.epochs=2", "--set", "learning.trees=20"};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramResult result = run_program(words);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  TemporaryFolder folder_;
};

TEST_F(Refit, IsFittedToEveryMapWithTheAccuraciesOfTheSplits) {
  train("split", {});
  train("all", {"--set", "learning.refit=true"});
  const json split = json::parse(text("split/metrics.json")), all = json::parse(text("all/metrics.json"));
  for (const char* group : {"handmade", "cnn", "fused", "extended"}) EXPECT_EQ(all.at(group), split.at(group)) << group;
  const std::string rows = text("all/splits.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 41);
  std::size_t trained = 0;
  for (std::size_t at = 0; (at = rows.find(",train\n", at)) != std::string::npos; ++at) ++trained;
  EXPECT_EQ(trained, 40u);
  for (const char* file : {"network.bin", "handmade.json", "cnn.json", "fused.json", "extended.json"})
    EXPECT_NE(text(std::string("all/") + file), text(std::string("split/") + file)) << file;

  const ProgramResult none = run_program({"evaluate", path("all"), path("data"), "-o", path("evaluated")});
  EXPECT_EQ(none.code, 2) << none.out;
  const ProgramResult trained_rows =
      run_program({"evaluate", path("all"), path("data"), "-o", path("evaluated"), "--trained-rows"});
  EXPECT_EQ(trained_rows.code, 0) << trained_rows.err;
}

TEST_F(Refit, LeavesOutWhatIsHeldOut) {
  train("held", {"--set", "learning.refit=true", "--hold-out", "azimuth_deg=30"});
  std::istringstream rows(text("held/splits.csv"));
  std::size_t held = 0;
  for (std::string line; std::getline(rows, line);) {
    held += line.ends_with(",test") ? 1 : 0;
    EXPECT_FALSE(line.ends_with(",unused")) << line;
  }
  EXPECT_EQ(held, 20u);  // one of two azimuths, in every sea
  train("again", {"--set", "learning.refit=true", "--hold-out", "azimuth_deg=30"});
  EXPECT_EQ(text("again/network.bin"), text("held/network.bin"));
  EXPECT_EQ(text("again/fused.json"), text("held/fused.json"));
}

}  // namespace
}  // namespace seaglint
