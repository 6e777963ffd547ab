// SPDX-License-Identifier: BSD-3-Clause
// Figures, statistics of a motion, and planes that preserve neighbourhoods.
#include "tools/figure/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/shapes/generators.h"
#include "tools/figure/motion_figures.h"
#include "tools/figure/tsne.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class Figure : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("seaglint figure's " + std::to_string(::getpid()) +
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

Heatmap ripple(int columns, int rows) {
  Heatmap map;
  map.title = "it's a_test %d {x}";
  map.x.label = "range (m)";
  map.y.label = "velocity (m/s)";
  map.colour = {"level (dB)", AxisRange{-40, 0}, false};
  for (int i = 0; i < columns; ++i) map.x_cells.push_back(i * 0.75);
  for (int j = 0; j < rows; ++j) map.y_cells.push_back(j * 0.146 - 1);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) map.values.push_back(-20 + 20 * std::sin(0.3 * i) * std::cos(0.5 * j));
  }
  map.values[0] = std::numeric_limits<double>::quiet_NaN();
  map.markers = {{3, 0}, {6, -0.5}};
  map.marker_name = "centres";
  return map;
}

TEST_F(Figure, HeatmapsOfAnyShapeBecomePicturesWithoutOtherFiles) {
  std::size_t count = 0;
  for (const auto& [columns, rows] : {std::pair{40, 20}, {40, 1}, {1, 20}, {1, 1}}) {
    for (const char* extension : {"png", "svg"}) {
      const fs::path file = folder_ / (std::to_string(columns) + "x" + std::to_string(rows) + "." + extension);
      write_figure(ripple(columns, rows), file);
      EXPECT_GT(read_file(file).size(), 1000u) << file;
      EXPECT_EQ(files(), ++count);
    }
  }
}

// gnuplot opens names that begin with | or < as pipes, and runs what stands between backquotes in double quotes.
TEST_F(Figure, NamesAndTextThatAreCommandsToGnuplotRunNothing) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  fs::create_directory("<touch ran #");
  Heatmap map = ripple(4, 4);
  map.title = map.x.label = "`touch ran` @x '; system 'touch ran'; '";
  for (const char* file : {"|touch ran;.png", "<touch ran;.svg", "<touch ran #/f.png", "`touch ran`.png", "~x.svg",
                           "-.png", "$(touch ran).png"}) {
    write_figure(map, file);
    EXPECT_GT(read_file(file).size(), 1000u) << file;
    EXPECT_FALSE(fs::exists("ran")) << file;
  }
  EXPECT_EQ(files(), 7u);
  fs::current_path(before);
}

TEST_F(Figure, LinesPointsAndIntervalsBecomePictures) {
  LinePlot plot;
  plot.title = "accuracy";
  plot.x.label = "significant wave height (m)";
  plot.y = {"accuracy (%)", AxisRange{50, 100}, false};
  plot.series = {{"hand-made", {0.1, 1, 2}, {70, 80, 90}, {{65, 75}, {78, 83}, {85, 94}}, SeriesStyle::kLinesPoints},
                 {"network", {0.1, 1, 2}, {75, std::nan(""), 95}, {}, SeriesStyle::kLines},
                 {"", {0.5, 1.5}, {60, 65}, {}, SeriesStyle::kPoints},
                 {"empty", {}, {}, {}, SeriesStyle::kLines}};
  write_figure(plot, folder_ / "lines.svg");
  EXPECT_NE(read_file(folder_ / "lines.svg").find("hand-made"), std::string::npos);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Figure, RefusesOtherFormatsAndMissingFolders) {
  EXPECT_THROW(write_figure(ripple(4, 4), folder_ / "map.jpg"), InputError);
  EXPECT_THROW(write_figure(ripple(4, 4), folder_ / "missing" / "map.png"), WorkError);
  EXPECT_EQ(files(), 0u);
}

// During its lifetime no file grows beyond `bytes`; writes fail as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

// Script and data fit, the picture does not.
TEST_F(Figure, CutShortByAFullDiskIsAnErrorAndNoFile) {
  for (const char* name : {"map.png", "map.svg"}) {
    const FileSizeLimit limit(4096);
    EXPECT_THROW(write_figure(ripple(4, 4), folder_ / name), WorkError) << name;
    EXPECT_EQ(files(), 0u) << name;
  }
  write_figure(ripple(4, 4), folder_ / "map.png");
  EXPECT_GT(read_file(folder_ / "map.png").size(), 4096u);
}

TEST_F(Figure, ReportsAMissingGnuplot) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.c_str(), 1);
  try {
    write_figure(ripple(4, 4), folder_ / "map.png");
    ADD_FAILURE() << "no error";
  } catch (const WorkError& error) {
    EXPECT_NE(std::string(error.what()).find("gnuplot-nox"), std::string::npos) << error.what();
  }
  EXPECT_THROW(require_figure(folder_ / "map.png"), WorkError);
  EXPECT_NO_THROW(require_figure(""));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NO_THROW(require_figure(folder_ / "map.png"));
  EXPECT_EQ(files(), 0u);
}

// A ship that moves with a wave's phase speed is at rest in the wave: all its snapshots equal the first.
TEST(MotionFrames, DrawTheWaterAtAShipsPosition) {
  const double omega = 30, wavenumber = omega * omega / kGravity;
  const WaveField sea({{omega, 0.1, 0.2, wavenumber}}, 1, 0);
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("motion_frames_" + std::to_string(::getpid()) + ".svg");
  const auto picture = [&](double speed, double period_s) {
    write_motion_frames({{"ship", Trajectory(), make_plate(2, 2), speed}}, sea, period_s, "title", file);
    std::string text = read_file(file);
    std::filesystem::remove(file);
    return text;
  };
  // A period this short is 0.0 s in the titles of its snapshots.
  const double period = 0.05;
  EXPECT_EQ(picture(omega / wavenumber, period), picture(0, 0));
  EXPECT_NE(picture(0, period), picture(0, 0));
}

// A heading of 300 deg that oscillates by 10 deg (7.07 deg rms) about it every 8 s: rms and period do not include the
// mean. The samples, 0.1 s apart, are those of ten whole periods, the last without its end.
TEST(MotionStatistics, AreThoseAboutTheMean) {
  constexpr double kStep = 0.1, kPeriod = 8, kDuration = 79.9;
  const double omega = 2 * kPi / kPeriod, swing = radians(10);
  std::vector<MotionSample> samples;
  for (int n = 0; n * kStep <= kDuration + 1e-9; ++n) {
    const double angle = omega * n * kStep;
    samples.push_back({{0, 0, radians(300) + swing * std::sin(angle)}, {0, 0, swing * omega * std::cos(angle)}});
  }
  const Trajectory trajectory(0, kStep, samples, Vec3::Zero(), Vec3::Zero());
  const std::string text = motion_statistics({{"float", trajectory, {}, 0}}, kDuration);
  EXPECT_THAT(text, testing::HasSubstr("yaw mean 300 deg, rms about it 7.07 deg, largest 310 deg, mean period 8 s"));
  EXPECT_THAT(text, testing::HasSubstr("roll mean 0 deg, rms about it 0 deg, largest 0 deg;"));
}

TEST(Tsne, KeepsSeparateClustersApart) {
  FeatureMatrix features{{"a", "b", "c"}, {}};
  Random random({6, Stream::kTest, 0});
  for (int i = 0; i < 80; ++i) {
    for (int k = 0; k < 3; ++k) features.values.push_back(static_cast<float>((i % 2 == 0 ? 0 : 20) + random.normal()));
  }
  const auto points = tsne(features, 15, 300, 1);
  // Every point's nearest neighbour is of its own cluster.
  for (int i = 0; i < 80; ++i) {
    int nearest = -1;
    double best = 1e300;
    for (int j = 0; j < 80; ++j) {
      const double distance = std::hypot(points[i][0] - points[j][0], points[i][1] - points[j][1]);
      if (j != i && distance < best) {
        best = distance;
        nearest = j;
      }
    }
    EXPECT_EQ(nearest % 2, i % 2) << "point " << i;
  }
  EXPECT_EQ(points, tsne(features, 15, 300, 1));
}

TEST(Tsne, AcceptsAnyInput) {
  EXPECT_EQ(tsne(FeatureMatrix{{"a"}, {1, 2, 3}}, 30, 10, 1).size(), 3u);
  for (const auto& point : tsne(FeatureMatrix{{"a"}, std::vector<float>(20, 1.0f)}, 30, 50, 1)) {
    EXPECT_TRUE(std::isfinite(point[0]) && std::isfinite(point[1]));
  }
}

}  // namespace
}  // namespace seaglint
