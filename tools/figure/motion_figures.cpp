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
#include "tools/figure/sea_figures.h"

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

void write_motion_figure(std::span<const MotionCase> cases, double duration_s, const FigureText& text,
                         const std::filesystem::path& file) {
  constexpr double kLongest = 100;
  constexpr std::size_t kMaxBodies = 6, kMostInColumn = 3;
  const std::size_t most = text.style == FigureStyle::kPaper ? kMostInColumn : kMostStates;
  const std::size_t states = std::min(cases.size(), most);
  PlotPanels figure{.plots = std::vector<LinePlot>(3 * states),
                    .columns = static_cast<int>(states),
                    .size = {std::max(1000, 180 + 260 * static_cast<int>(states)), 900, text.style},
                    .title = text.title,
                    .notes = with_left_out(text.notes, cases.size(), states),
                    .aligned = {}};
  if (states > 1) figure.aligned = states > 3 ? 0.85 : text.style == FigureStyle::kPaper ? 0.75 : 0.6;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double largest = 0;
    for (std::size_t state = 0; state < states; ++state) {
      const std::vector<NamedTrajectory>& bodies = cases[state].bodies;
      LinePlot& plot = figure.plots[axis * states + state];
      plot.title = axis == 0 ? cases[state].name : "";
      plot.x.label = "time (s)";
      plot.y.label = fmt::format("{} (deg)", kAngles[axis]);
      for (std::size_t i = 0; i < std::min(bodies.size(), kMaxBodies); ++i) {
        const std::vector<MotionSample> samples = uniform_samples(bodies[i].trajectory, std::min(duration_s, kLongest));
        Series series;
        if (axis == 0) series.name = bodies[i].body;
        if (states > 1) series.width = 1;
        for (std::size_t n = 0; n < samples.size(); ++n) series.x.push_back(kStatisticsStep_s * static_cast<double>(n));
        series.y = angle_deg(samples, static_cast<int>(axis));
        for (const double y : series.y) largest = std::max(largest, std::abs(y));
        plot.series.push_back(std::move(series));
      }
    }
    if (states < 2) continue;
    for (std::size_t state = 0; state < states; ++state) {
      LinePlot& plot = figure.plots[axis * states + state];
      plot.x.range = AxisRange{0, std::min(duration_s, kLongest)};
      if (largest > 0) plot.y.range = AxisRange{-1.05 * largest, 1.05 * largest};
    }
  }
  write_figure(figure, file);
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

void write_motion_frames(std::span<const MotionCase> cases, double duration_s, const FigureText& text,
                         const std::filesystem::path& file) {
  const int moments = text.style == FigureStyle::kPaper ? 3 : 5;
  constexpr std::size_t kMostOnPaper = 3;
  const std::size_t states = std::min(cases.size(), text.style == FigureStyle::kScreen ? kMostStates : kMostOnPaper);
  PlotPanels figure{.plots = {},
                    .columns = moments,
                    .size = {1600, 0, text.style},
                    .title = text.title,
                    .notes = with_left_out(text.notes, cases.size(), states),
                    .aligned = 0.3};
  for (const MotionCase& one : cases.first(states)) {
    const double period = std::min(one.peak_period_s, duration_s);
    for (std::size_t row = 0; row < std::min<std::size_t>(one.bodies.size(), 2); ++row) {
      const NamedTrajectory& body = row == 0 ? one.bodies.front() : one.bodies.back();
      for (int n = 0; n < moments; ++n) {
        figure.plots.push_back(frame(body, one.sea, period * n / moments));
        LinePlot& plot = figure.plots.back();
        if (!one.name.empty()) plot.title = one.name + "; " + plot.title;
      }
      // One range for the row.
      const auto first = figure.plots.end() - moments;
      AxisRange z = *first->y.range;
      for (auto plot = first; plot != figure.plots.end(); ++plot)
        z = {std::min(z.first, plot->y.range->first), std::max(z.second, plot->y.range->second)};
      for (auto plot = first; plot != figure.plots.end(); ++plot) plot->y.range = z;
      *figure.aligned =
          std::max(*figure.aligned, (z.second - z.first) / (first->x.range->second - first->x.range->first));
    }
  }
  figure.plots.front().series.front().name = "water";
  figure.plots.front().series.back().name = "outline of the body";
  write_figure(figure, file);
}

void write_rao_figure(const RaoRequest& request, const FigureText& text, const std::filesystem::path& file) {
  constexpr int kPoints = 150;
  constexpr double kHighest = 2;
  const std::size_t count = std::min(request.directions.size(), kMostStates);
  const RaoReference& reference = request.reference;
  std::vector<LinePlot> plots(3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    plots[axis].x.label = "wave frequency (rad/s)";
    plots[axis].y.label = fmt::format("{} (deg/m)", kAngles[axis]);
  }
  const auto named = [&](const std::string& name, double mu) {
    return count == 1 ? name : fmt::format("{}, towards {:.4g} deg", name, degrees(mu));
  };
  const auto curves = [&](const std::vector<double>& omegas, std::size_t i, const auto& rao, SeriesStyle style,
                          const std::string& name) {
    std::array<Series, 3> series;
    for (const double omega : omegas) {
      const MotionRao r = rao(omega);
      const std::array<Complex, 3> angles{r.roll, r.pitch, r.yaw};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        series[axis].x.push_back(omega);
        series[axis].y.push_back(degrees(std::abs(angles[axis])));
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axis == 0) series[axis].name = name;
      series[axis].style = style;
      if (count > 1) series[axis].colour = series_colour(i);
      plots[axis].series.push_back(series[axis]);
    }
    return series;
  };
  std::vector<double> omegas;
  for (int i = 1; i <= kPoints; ++i) omegas.push_back(kHighest * i / kPoints);
  for (std::size_t i = 0; i < count; ++i) {
    const double mu = request.directions[i];
    const auto own = [&](double omega) {
      return ship_rao(request.ship, {omega, wavenumber_at(omega, request.depth), mu});
    };
    curves(omegas, i, own, SeriesStyle::kLines, named("seaglint", mu));
  }
  if (!reference.file.empty()) {
    const RaoTable table = reference.file.extension() == ".4"
                               ? read_wamit_rao(reference.file, reference.conventions)
                               : read_veres_rao(reference.file, request.ship.speed, reference.conventions);
    std::vector<double> tabled = table.omegas();
    std::erase_if(tabled, [](double omega) { return omega > kHighest; });
    std::array<double, 3> largest{};
    for (std::size_t i = 0; i < count; ++i) {
      const double mu = request.directions[i];
      const auto published = [&](double omega) { return table.at(omega, wavenumber_at(omega, request.depth), mu); };
      const std::array<Series, 3> series =
          curves(tabled, i, published, SeriesStyle::kPoints, named(reference.file.filename().string(), mu));
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double y : series[axis].y) largest[axis] = std::max(largest[axis], y);
    }
    // The axes are limited, as a resonance of unknown damping would compress the other curves.
    for (std::size_t axis = 0; axis < 3; ++axis) plots[axis].y.range = AxisRange{0, 1.3 * largest[axis]};
  }
  write_figure({.plots = plots,
                .size = {900, 1000, text.style},
                .title = text.title,
                .notes = with_left_out(text.notes, request.directions.size(), count, "direction")},
               file);
}

}  // namespace seaglint
