// SPDX-License-Identifier: BSD-3-Clause
// Figures, statistics of a motion, and planes that preserve neighbourhoods.
#include "tools/figure/map_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <tuple>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/shapes/generators.h"
#include "tools/figure/motion_figures.h"
#include "tools/figure/sea_figures.h"
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
  for (int i = 0; i < columns; ++i) map.map.x.push_back(i * 0.75);
  for (int j = 0; j < rows; ++j) map.map.y.push_back(j * 0.146 - 1);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) map.map.values.push_back(-20 + 20 * std::sin(0.3 * i) * std::cos(0.5 * j));
  }
  map.map.values[0] = std::numeric_limits<double>::quiet_NaN();
  map.rings = {{3, 0}, {6, -0.5}};
  map.ring_name = "centres";
  return map;
}

// The text of a figure as an SVG has it.
std::string svg_of(const Heatmap& figure, const fs::path& folder, FigureSize size = {}) {
  write_figure(figure, folder / "text.svg", size);
  return read_file(folder / "text.svg");
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST_F(Figure, HeatmapsOfAnyShapeBecomePicturesWithoutOtherFiles) {
  std::size_t count = 0;
  for (const auto& [columns, rows] : {std::pair{40, 20}, {40, 1}, {1, 20}, {1, 1}}) {
    for (const char* extension : {"png", "svg", "pdf"}) {
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

// Panels with equal ranges have the axes' labels once.
TEST_F(Figure, OfSeveralMapsHasOneColourBarAndTheTextsOfEach) {
  HeatmapPanels panels{.maps = {ripple(20, 10), ripple(20, 10), ripple(20, 10)}, .columns = 2, .notes = {"seed 42"}};
  for (std::size_t i = 0; i < panels.maps.size(); ++i) {
    panels.maps[i].title = "map " + std::to_string(i);
    panels.maps[i].notes = {"Hs " + std::to_string(i) + " m", "azimuth 80 deg"};
  }
  for (const FigureStyle style : {FigureStyle::kScreen, FigureStyle::kPaper, FigureStyle::kPaperWide}) {
    panels.style = style;
    const fs::path file = folder_ / "panels.svg";
    write_figure(panels, file);
    const std::string text = read_file(file);
    for (const char* word : {"map 0", "map 2", "Hs 1 m", "seed 42"})
      EXPECT_NE(text.find(word), std::string::npos) << word;
    for (const char* once : {"level (dB)", "range (m)", "velocity (m/s)"}) EXPECT_EQ(count_of(text, once), 1u) << once;
    EXPECT_EQ(count_of(text, "data:image/png"), 3u);
  }
  const fs::path file = folder_ / "panels.png";
  panels.maps.resize(1);  // of one cell
  panels.maps[0] = ripple(1, 1);
  write_figure(panels, file);
  EXPECT_GT(read_file(file).size(), 1000u);
}

TEST_F(Figure, OfAlignedPlotsHasLabelsAtItsEdgesAndOneLegend) {
  LinePlot plot;
  plot.x = {"time (s)", AxisRange{0, 10}};
  plot.y = {"roll (deg)", AxisRange{-1, 1}};
  plot.series = {{"ship", {0, 10}, {0, 1}, {}}, {"float", {0, 10}, {1, 0}, {}}};
  PlotPanels panels{.plots = {plot, plot, plot, plot}, .columns = 2, .notes = {"seed 42"}, .aligned = 0.5};
  for (std::size_t i = 0; i < 4; ++i) panels.plots[i].title = "state " + std::to_string(i);
  for (const FigureStyle style : {FigureStyle::kScreen, FigureStyle::kPaper}) {
    panels.size.style = style;
    write_figure(panels, folder_ / "aligned.svg");
    const std::string text = read_file(folder_ / "aligned.svg");
    EXPECT_EQ(count_of(text, ">ship<"), 1u);
    EXPECT_EQ(count_of(text, "time (s)"), 2u);
    EXPECT_EQ(count_of(text, "roll (deg)"), 2u);
    EXPECT_EQ(count_of(text, "state 3"), 1u);
    EXPECT_EQ(count_of(text, "seed 42"), 1u);
  }
}

TEST(SeaStates, AreNamedByWhatDiffers) {
  SeaState one, two;
  two.significant_wave_height_m = 2;
  two.propagation_rad = radians(60);
  EXPECT_EQ(state_names(std::array{one}), std::vector<std::string>{""});
  EXPECT_EQ(state_names(std::array{one, two}),
            (std::vector<std::string>{"Hs 1 m, towards 0 deg", "Hs 2 m, towards 60 deg"}));
  EXPECT_EQ(common_of(std::array{one, two}).quantities, (std::vector<std::string>{"Tp 8 s", "gamma 3.3"}));
  EXPECT_EQ(common_of(std::array{one, two}).depth, "deep water");
  EXPECT_EQ(state_names(std::array{one, one}), (std::vector<std::string>{"state 0", "state 1"}));
  EXPECT_EQ(with_left_out({"seed 1"}, 8, 6), (std::vector<std::string>{"seed 1", "2 more sea states not drawn"}));
}

TEST_F(Figure, RefusesOtherFormatsAndMissingFolders) {
  EXPECT_THROW(write_figure(ripple(4, 4), folder_ / "map.jpg"), InputError);
  EXPECT_THROW(write_figure(ripple(4, 4), folder_ / "missing" / "map.png"), WorkError);
  EXPECT_EQ(files(), 0u);
}

// A map of 128 x 64 cells of 0.75 m and 0.15 m/s with three centres of a target, its pedestal over all velocities of
// their ranges, and clutter.
struct MapWithTarget {
  Sample sample;
  StoredAxes axes;

  explicit MapWithTarget(float target_m = 1, float clutter_m = 0.01f) {
    for (int i = 0; i < 128; ++i) axes.range_m.push_back(0.75 * (i - 64));
    for (int j = 0; j < 64; ++j) axes.velocity_mps.push_back(0.15 * (j - 32));
    sample.magnitude.assign(axes.cells(), clutter_m);
    for (const auto& [i, j] : {std::pair{54, 31}, {64, 32}, {74, 33}}) {
      for (std::size_t v = 0; v < 64; ++v) sample.magnitude[v * 128 + static_cast<std::size_t>(i)] = 0.1f * target_m;
      sample.magnitude[static_cast<std::size_t>(j * 128 + i)] = target_m;
      sample.centre_list.push_back({static_cast<float>(axes.range_m[static_cast<std::size_t>(i)]),
                                    static_cast<float>(axes.velocity_mps[static_cast<std::size_t>(j)]), target_m});
    }
    sample.record.target_name = "ship";
    sample.record.azimuth_deg = 80;
    sample.record.significant_wave_height_m = 1;
    sample.record.peak_period_s = 8;
    sample.record.sample = 3;
    sample.record.mwr = 0.004;
  }
};

TEST(MapWindow, IsThatOfTheCentresAndNotOfTheirPedestal) {
  MapWithTarget map;
  const TargetWindow target = target_window(map.sample, map.axes);
  ASSERT_TRUE(target.window);
  EXPECT_EQ(target.reason, "");
  // Margins of four and two cells beyond the centres at -7.5 to 7.5 m and -0.15 to 0.15 m/s, on edges of cells; at
  // least nine cells of velocity.
  EXPECT_NEAR(target.window->x.first, -10.5 - 0.375, 1e-9);
  EXPECT_NEAR(target.window->x.second, 10.5 + 0.375, 1e-9);
  EXPECT_NEAR(target.window->y.first, -0.675, 1e-9);
  EXPECT_NEAR(target.window->y.second, 0.675, 1e-9);
  // A centre 40 dB below the strongest is none of the window's.
  map.sample.centre_list.push_back({40, 4, 0.01f});
  EXPECT_EQ(target_window(map.sample, map.axes).window, target.window);
  // One at the edge of the map: the window ends there.
  map.sample.centre_list.push_back({47.25f, 4.65f, 0.5f});
  const TargetWindow wide = target_window(map.sample, map.axes);
  ASSERT_TRUE(wide.window);
  EXPECT_NEAR(wide.window->x.second, 47.25 + 0.375, 1e-9);
  EXPECT_NEAR(wide.window->y.second, 4.65 + 0.075, 1e-9);
}

TEST(MapWindow, IsTheWholeMapWhereClutterDominates) {
  MapWithTarget map;
  map.sample.magnitude[0] = 2;
  EXPECT_FALSE(target_window(map.sample, map.axes).window);
  EXPECT_NE(target_window(map.sample, map.axes).reason, "");
  map.sample.centre_list.clear();
  EXPECT_FALSE(target_window(map.sample, map.axes).window);
  EXPECT_NE(rv_figure({.sample = map.sample, .axes = map.axes, .line = {}}).notes.front().find("whole map: "),
            std::string::npos);
}

TEST_F(Figure, OfAMapShowsTheWindowTheWholeTheRingsAndTheLine) {
  const MapWithTarget map;
  const RvFigureRequest request{.sample = map.sample, .axes = map.axes, .line = {0.02, 0}};
  const Heatmap figure = rv_figure(request);
  EXPECT_EQ(figure.rings.size(), 3u);
  ASSERT_EQ(figure.line.size(), 2u);
  EXPECT_NEAR(figure.line[1][1], 0.02 * 7.5, 1e-6);
  ASSERT_TRUE(figure.whole);
  EXPECT_EQ(figure.whole->values.size(), map.axes.cells());
  EXPECT_EQ(figure.map.x.size(), 29u);
  EXPECT_EQ(figure.map.y.size(), 9u);
  EXPECT_EQ(figure.colour.range, (AxisRange{-40, 0}));
  EXPECT_NEAR(figure.map.values[4 * 29 + 4 + 10], 0, 1e-6);  // the middle centre
  const std::string text = svg_of(figure, folder_);
  for (const char* word : {"whole map", "3 scattering centres", "fitted line, MWR 0.004 (m/s)^2", "range (m)",
                           "velocity (m/s)", "ship, azimuth 80 deg, Hs 1 m"})
    EXPECT_NE(text.find(word), std::string::npos) << word;
  EXPECT_EQ(count_of(text, "data:image/png"), 2u);

  RvFigureRequest plain = request;
  plain.whole = true;
  plain.centres = false;
  const std::string whole = svg_of(rv_figure(plain), folder_);
  EXPECT_EQ(count_of(whole, "data:image/png"), 1u);
  EXPECT_EQ(whole.find("whole map"), std::string::npos);
  EXPECT_EQ(whole.find("scattering centre"), std::string::npos);
}

TEST_F(Figure, OfPaperHasItsWidthDotsAndSmallPrint) {
  const MapWithTarget map;
  Heatmap figure = rv_figure({.sample = map.sample, .axes = map.axes, .line = {}});
  Scenario scenario;
  scenario.name = "quick";
  scenario.seed = 42;
  figure.notes = small_print(scenario, scenario.radar, map.sample.record);
  for (const auto& [style, dots, pixels] :
       {std::tuple{FigureStyle::kPaper, 1039, 333}, {FigureStyle::kPaperWide, 2126, 680}}) {
    const fs::path file = folder_ / "paper.png";
    write_figure(figure, file, map_size(style));
    const std::string png = read_file(file);
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png[at + i]);
      return value;
    };
    EXPECT_EQ(number(16), static_cast<std::uint32_t>(dots));
    EXPECT_EQ(png.substr(37, 4), "pHYs");
    EXPECT_EQ(number(41), 11811u);  // dots per metre
    const std::string text = svg_of(figure, folder_, map_size(style));
    EXPECT_NE(text.find("width=\"" + std::to_string(pixels) + "\""), std::string::npos);
    for (const char* word : {"carrier 16 GHz + 8 x 25 MHz", "azimuth 80 deg, elevation 0 deg", "Hs 1 m, Tp 8 s",
                             "quick, sample 3, seed 42"})
      EXPECT_NE(text.find(word), std::string::npos) << word;
  }
  const fs::path file = folder_ / "paper.pdf";
  write_figure(figure, file, map_size(FigureStyle::kPaper));
  const std::string pdf = read_file(file);
  write_figure(figure, file, map_size(FigureStyle::kPaper));
  EXPECT_EQ(read_file(file), pdf);
  EXPECT_NE(pdf.find("(D:19700101000000"), std::string::npos);
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
  for (const char* name : {"map.png", "map.svg", "map.pdf"}) {
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
    const MotionCase one{"", {{"ship", Trajectory(), make_plate(2, 2), speed}}, sea, period_s};
    write_motion_frames(std::span(&one, 1), 100, {.title = "title", .notes = {}}, file);
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
