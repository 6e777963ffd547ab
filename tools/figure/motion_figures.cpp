// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/motion_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dispersion.h"
#include "sim/motion/ship/rao_files.h"
#include "sim/motion/ship/responses.h"
#include "sim/motion/ship/ship.h"
#include "sim/motion/statistics.h"
#include "tools/figure/figure.h"

namespace seaglint {

namespace {

constexpr std::array<const char*, 3> kAngles{"roll", "pitch", "yaw"};

std::vector<double> angle_deg(const std::vector<MotionSample>& samples, int axis) {
  std::vector<double> values;
  for (const MotionSample& sample : samples) values.push_back(degrees(sample.angles[axis]));
  return values;
}

}  // namespace

std::string motion_statistics(const std::vector<NamedTrajectory>& bodies, double duration_s) {
  std::string text;
  for (const NamedTrajectory& body : bodies) {
    const std::array<AngleStatistics, 3> statistics = angle_statistics(body.trajectory, duration_s);
    text += body.body + ":";
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const AngleStatistics& angle = statistics[axis];
      fmt::format_to(std::back_inserter(text), " {} mean {:.3g} deg, rms about it {:.3g} deg, largest {:.3g} deg",
                     kAngles[axis], degrees(angle.mean), degrees(angle.rms), degrees(angle.largest));
      if (angle.mean_period_s > 0)
        fmt::format_to(std::back_inserter(text), ", mean period {:.3g} s", angle.mean_period_s);
      text += axis < 2 ? ";" : "\n";
    }
  }
  return text;
}

std::string spectrum_csv(const std::vector<NamedTrajectory>& bodies, double duration_s) {
  std::string text = "omega_rad_s,body,roll_deg2s,pitch_deg2s,yaw_deg2s\n";
  for (const NamedTrajectory& body : bodies) {
    const AngleSpectra spectra = angle_spectra(body.trajectory, duration_s);
    for (std::size_t n = 0; n < spectra.omega.size(); ++n) {
      fmt::format_to(std::back_inserter(text), "{:.6g},{}", spectra.omega[n], body.body);
      for (const std::vector<double>& density : spectra.density)
        fmt::format_to(std::back_inserter(text), ",{:.6g}", degrees(degrees(density[n])));
      text += '\n';
    }
  }
  return text;
}

void write_motion_figure(const std::vector<NamedTrajectory>& bodies, double duration_s, const std::string& title,
                         const std::filesystem::path& file) {
  constexpr double kLongest = 100;
  constexpr std::size_t kMaxBodies = 6;
  std::vector<LinePlot> plots(3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    plots[axis].x.label = "time (s)";
    plots[axis].y.label = fmt::format("{} (deg)", kAngles[axis]);
    plots[axis].legend_above = axis == 0;
    for (std::size_t i = 0; i < std::min(bodies.size(), kMaxBodies); ++i) {
      const std::vector<MotionSample> samples = uniform_samples(bodies[i].trajectory, std::min(duration_s, kLongest));
      Series series;
      if (axis == 0) series.name = bodies[i].body;
      for (std::size_t n = 0; n < samples.size(); ++n) series.x.push_back(kStatisticsStep_s * static_cast<double>(n));
      series.y = angle_deg(samples, static_cast<int>(axis));
      plots[axis].series.push_back(series);
    }
  }
  write_figure({.plots = plots, .size = {1000, 900}, .title = title}, file);
}

namespace {

// Silhouette of the mesh along y, in a pose: highest and lowest vertex over bins of the body's x.
Series silhouette(const TriangleMesh& mesh, const Pose& pose) {
  constexpr int kBins = 80;
  const Bounds box = bounds(mesh);
  const double width = (box.upper.x() - box.lower.x()) / kBins;
  std::vector<double> high(kBins, box.lower.z()), low(kBins, box.upper.z());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      const Vec3& a = mesh.vertices[triangle[e]];
      const Vec3& b = mesh.vertices[triangle[(e + 1) % 3]];
      const auto bin = [&](double x) {
        return width > 0 ? std::clamp(static_cast<int>((x - box.lower.x()) / width), 0, kBins - 1) : 0;
      };
      const int first = bin(std::min(a.x(), b.x())), last = bin(std::max(a.x(), b.x()));
      for (int i = first; i <= last; ++i) {
        const double x = std::clamp(box.lower.x() + width * (i + 0.5), std::min(a.x(), b.x()), std::max(a.x(), b.x()));
        const double u = a.x() == b.x() ? 0 : (x - a.x()) / (b.x() - a.x());
        for (const double z : {a.z() + u * (b.z() - a.z()), a.x() == b.x() ? b.z() : a.z() + u * (b.z() - a.z())}) {
          high[static_cast<std::size_t>(i)] = std::max(high[static_cast<std::size_t>(i)], z);
          low[static_cast<std::size_t>(i)] = std::min(low[static_cast<std::size_t>(i)], z);
        }
      }
    }
  }
  Series outline;
  const auto add = [&](int i, double z) {
    const Vec3 p = pose.R * Vec3(box.lower.x() + width * (i + 0.5), 0, z) + pose.p;
    outline.x.push_back(p.x());
    outline.y.push_back(p.z());
  };
  for (int i = 0; i < kBins; ++i) add(i, high[static_cast<std::size_t>(i)]);
  for (int i = kBins - 1; i >= 0; --i) add(i, low[static_cast<std::size_t>(i)]);
  outline.x.push_back(outline.x.front());
  outline.y.push_back(outline.y.front());
  return outline;
}

// Snapshot of the water surface around a body, over an interval of x that moves with the body's mean velocity.
LinePlot frame(const NamedTrajectory& body, const WaveField& sea, double t) {
  const Pose pose = body.trajectory.pose(std::min(t, body.trajectory.end_s()));
  const Bounds box = bounds(body.mesh);
  const double reach = std::max(2.0, 0.65 * (box.upper.x() - box.lower.x()));
  const auto elevation = [&](double x) {
    return sea.surface(x + body.speed * t, pose.p.y(), t, SurfaceQuantities::kElevationAndSlope).elevation;
  };
  const double level = elevation(pose.p.x());
  const double lowest = std::min(level, pose.p.z() + box.lower.z());
  LinePlot plot;
  plot.title = fmt::format("{}, {:.1f} s", body.body, t);
  plot.x = {"x (m)", AxisRange{pose.p.x() - reach, pose.p.x() + reach}};
  plot.y = {"z (m)", AxisRange{lowest - 0.2 * reach, pose.p.z() + box.upper.z() + 0.2 * reach}};
  plot.equal_axes = true;
  Series water;
  constexpr int kPoints = 200;
  for (int i = 0; i <= kPoints; ++i) {
    water.x.push_back(pose.p.x() + reach * (2.0 * i / kPoints - 1));
    water.y.push_back(elevation(water.x.back()));
  }
  plot.series = {water, silhouette(body.mesh, pose)};
  return plot;
}

}  // namespace

void write_motion_frames(const std::vector<NamedTrajectory>& bodies, const WaveField& sea, double period_s,
                         const std::string& title, const std::filesystem::path& file) {
  constexpr int kMoments = 5;
  std::vector<LinePlot> plots;
  const std::size_t rows = bodies.size() > 1 ? 2 : 1;
  for (std::size_t row = 0; row < rows; ++row) {
    for (int n = 0; n < kMoments; ++n) {
      plots.push_back(frame(row == 0 ? bodies.front() : bodies.back(), sea, period_s * n / kMoments));
    }
  }
  write_figure({.plots = plots, .columns = kMoments, .size = {2000, rows == 2 ? 800 : 420}, .title = title}, file);
}

void write_rao_figure(const ShipParticulars& ship, double mu, double depth, const RaoReference& reference,
                      const std::string& title, const std::filesystem::path& file) {
  constexpr int kPoints = 150;
  constexpr double kHighest = 2;
  std::vector<LinePlot> plots(3);
  std::array<Series, 3> computed;
  for (int i = 1; i <= kPoints; ++i) {
    const double omega = kHighest * i / kPoints;
    const MotionRao r = ship_rao(ship, {omega, wavenumber_at(omega, depth), mu});
    const std::array<Complex, 3> angles{r.roll, r.pitch, r.yaw};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      computed[axis].x.push_back(omega);
      computed[axis].y.push_back(degrees(std::abs(angles[axis])));
    }
  }
  std::array<Series, 3> published;
  if (!reference.file.empty()) {
    const RaoTable table = reference.file.extension() == ".4"
                               ? read_wamit_rao(reference.file, reference.conventions)
                               : read_veres_rao(reference.file, ship.speed, reference.conventions);
    for (const double omega : table.omegas()) {
      if (omega > kHighest) break;
      const MotionRao r = table.at(omega, wavenumber_at(omega, depth), mu);
      const std::array<Complex, 3> angles{r.roll, r.pitch, r.yaw};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        published[axis].x.push_back(omega);
        published[axis].y.push_back(degrees(std::abs(angles[axis])));
      }
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    plots[axis].x.label = "wave frequency (rad/s)";
    plots[axis].y.label = fmt::format("{} (deg/m)", kAngles[axis]);
    plots[axis].legend_above = axis == 0;
    if (axis == 0) computed[axis].name = "seaglint";
    plots[axis].series.push_back(computed[axis]);
    if (reference.file.empty()) continue;
    if (axis == 0) published[axis].name = reference.file.filename().string();
    published[axis].style = SeriesStyle::kPoints;
    plots[axis].series.push_back(published[axis]);
    // The axis is limited, as a resonance of unknown damping would compress the other curves.
    double largest = 0;
    for (const double y : published[axis].y) largest = std::max(largest, y);
    plots[axis].y.range = AxisRange{0, 1.3 * largest};
  }
  write_figure({.plots = plots, .size = {900, 1000}, .title = title}, file);
}

}  // namespace seaglint
